/* SPDX-License-Identifier: MIT */
/*
 * Coefficients and weights as 64-bit fixed point, Q4.60. Sums of products are exact in 128 bits and
 * rounded once, so a result does not depend on the order of its terms, nor on the host.
 */
#ifndef LIMNI_FIXED_H
#define LIMNI_FIXED_H

#include <stdint.h>

typedef int64_t limni_fixed;
__extension__ typedef __int128 limni_wide;

#define LIMNI_FIXED_BITS 60
#define LIMNI_FIXED_ONE ((limni_fixed)1 << LIMNI_FIXED_BITS)

/// Nearest, halves away from zero, so that negation is exact.
static inline limni_wide limni_wide_divide(limni_wide a, limni_wide positive_divisor) {
    const limni_wide half = positive_divisor / 2;
    return a >= 0 ? (a + half) / positive_divisor : -((-a + half) / positive_divisor);
}

/// A sum of products, Q8.120, back in Q4.60.
static inline limni_fixed limni_fixed_round(limni_wide sum) {
    const limni_wide half = (limni_wide)1 << (LIMNI_FIXED_BITS - 1);
    const limni_wide magnitude = (sum >= 0 ? sum : -sum) + half;
    const limni_fixed rounded = (limni_fixed)(magnitude >> LIMNI_FIXED_BITS);
    return sum >= 0 ? rounded : -rounded;
}

static inline limni_fixed limni_fixed_multiply(limni_fixed a, limni_fixed b) {
    return limni_fixed_round((limni_wide)a * b);
}

/// a / b in Q4.60; the result must be below 8.
static inline limni_fixed limni_fixed_divide(limni_fixed a, limni_fixed b) {
    const limni_wide scaled = (limni_wide)a * LIMNI_FIXED_ONE;
    return (limni_fixed)(b > 0 ? limni_wide_divide(scaled, b)
                               : -limni_wide_divide(scaled, -(limni_wide)b));
}

/// The root of a number in Q8.120, in Q4.60, rounded down: bit by bit, the same everywhere.
limni_fixed limni_fixed_root(limni_wide square);

/// The ratio of two integers; |numerator / denominator| < 8, denominator > 0.
static inline limni_fixed limni_fixed_ratio(int64_t numerator, int64_t denominator) {
    return (limni_fixed)limni_wide_divide((limni_wide)numerator * LIMNI_FIXED_ONE, denominator);
}

/// The point at j/n of a turn on the unit circle, n >= 1, to 1e-17. No libm: its last bit differs
/// between versions. Mirrored angles give mirrored numbers, exactly.
typedef struct limni_fixed_unit {
    limni_fixed cosine, sine;
} limni_fixed_unit;
limni_fixed_unit limni_fixed_turn(uint32_t j, uint32_t n);

/// A number below 8; exact from 2^-37 on.
static inline limni_fixed limni_fixed_from(float value) {
    return (limni_fixed)((double)value * (double)LIMNI_FIXED_ONE);
}

/// The nearest float; exact halves to even. Every host converts integers to floats alike.
static inline float limni_fixed_to_float(limni_fixed a) {
    return (float)a * 0x1p-60f;
}

#endif
