/* SPDX-License-Identifier: MIT */
#include "fixed.h"

static const limni_fixed pi = 3622009729038561421;

/// sin(x) for 0 <= x <= pi/2 by its Taylor series, until a term vanishes.
static limni_fixed sine(limni_fixed x) {
    const limni_fixed square = limni_fixed_multiply(x, x);
    limni_fixed sum = 0, term = x;
    for (int k = 1; term != 0; k += 2) {
        sum += term;
        term = (limni_fixed)limni_wide_divide(-(limni_wide)limni_fixed_multiply(term, square),
                                              (limni_wide)(k + 1) * (k + 2));
    }
    return sum;
}

limni_fixed limni_fixed_cosine(uint32_t n) {
    // The half angle keeps the argument, and with it every term of the series, below 2.
    const limni_fixed s = sine((limni_fixed)limni_wide_divide(pi, n));
    return LIMNI_FIXED_ONE - 2 * limni_fixed_multiply(s, s);
}
