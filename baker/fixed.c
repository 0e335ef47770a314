/* SPDX-License-Identifier: MIT */
#include "fixed.h"

static const limni_fixed pi = 3622009729038561421;

/// The nearest, halves away from zero.
static limni_fixed divide(limni_fixed a, limni_fixed positive_divisor) {
    const limni_fixed half = positive_divisor / 2;
    return (a >= 0 ? a + half : a - half) / positive_divisor;
}

/// The Taylor series that starts with `term`, the one of degree `degree`, until a term vanishes.
static limni_fixed taylor(limni_fixed term, int degree, limni_fixed x) {
    const limni_fixed square = limni_fixed_multiply(x, x);
    limni_fixed sum = 0;
    for (; term != 0; degree += 2) {
        sum += term;
        term =
            divide(-limni_fixed_multiply(term, square), (limni_fixed)(degree + 1) * (degree + 2));
    }
    return sum;
}

/// The first quadrant: r / 4n of a turn, 0 <= r <= n. Beyond an eighth of a turn, mirrored.
static limni_fixed_unit quadrant(uint64_t r, uint32_t n) {
    if (2 * r > n) {
        const limni_fixed_unit mirrored = quadrant(n - r, n);
        return (limni_fixed_unit){.cosine = mirrored.sine, .sine = mirrored.cosine};
    }
    const limni_fixed x = (limni_fixed)limni_wide_divide((limni_wide)pi * r, 2 * (limni_wide)n);
    return (limni_fixed_unit){.cosine = taylor(LIMNI_FIXED_ONE, 0, x), .sine = taylor(x, 1, x)};
}

static limni_fixed_unit turn(uint32_t j, uint32_t n) {
    const uint64_t fourfold = 4 * (uint64_t)(j % n);
    const limni_fixed_unit unit = quadrant(fourfold % n, n);
    switch (fourfold / n) {
    case 0:
        return unit;
    case 1:
        return (limni_fixed_unit){.cosine = -unit.sine, .sine = unit.cosine};
    case 2:
        return (limni_fixed_unit){.cosine = -unit.cosine, .sine = -unit.sine};
    default:
        return (limni_fixed_unit){.cosine = unit.sine, .sine = -unit.cosine};
    }
}

limni_fixed_unit limni_fixed_turn(uint32_t j, uint32_t n) {
    enum { KEPT_MAX = 16 }; // masks ask for the same few again and again
    static _Thread_local limni_fixed_unit kept[KEPT_MAX + 1][KEPT_MAX];
    if (n > KEPT_MAX) return turn(j, n);
    limni_fixed_unit *const unit = &kept[n][j % n];
    if (unit->cosine == 0 && unit->sine == 0) *unit = turn(j, n);
    return *unit;
}

limni_fixed limni_fixed_root(limni_wide square) {
    limni_wide root = 0;
    for (limni_wide bit = (limni_wide)1 << 62; bit > 0; bit >>= 1) {
        if ((root + bit) * (root + bit) <= square) root += bit;
    }
    return (limni_fixed)root;
}
