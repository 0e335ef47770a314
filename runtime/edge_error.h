/* SPDX-License-Identifier: MIT */
/*
 * How far the surface drawn at levels 0 to 3 is from its limit around an edge, in lengths of the
 * edge, as 16 bits. From bit 0 on: 7 bits, the error at level 0; 3 times 3 bits, the factors from
 * each level to the next.
 */
#ifndef LIMNI_EDGE_ERROR_H
#define LIMNI_EDGE_ERROR_H

#include "rounding.h"

#include "limn/limn.h"

#include <math.h>
#include <string.h>

enum {
    LIMNI_ERROR_FIRST_BITS = 7,
    LIMNI_ERROR_FIRST_MAX = (1 << LIMNI_ERROR_FIRST_BITS) - 1,
    LIMNI_ERROR_FACTOR_BITS = 3,
    LIMNI_ERROR_FACTOR_COUNT = 1 << LIMNI_ERROR_FACTOR_BITS,
};

/// Of 64ths, rising; all below 1, so that errors fall with every level. A smooth surface has 1/4.
#define LIMNI_ERROR_FACTORS(X)                                                                     \
    { X(14), X(16), X(17), X(18), X(20), X(23), X(29), X(48) }
#define LIMNI_ERROR_FACTOR(n) (n) / 64.0f
#define LIMNI_ERROR_INVERSE(n) 64.0f / (n)
#define LIMNI_ERROR_SLOPE(n) 64.0f / (64.0f - (n))

static const float limni_error_factors[LIMNI_ERROR_FACTOR_COUNT] =
    LIMNI_ERROR_FACTORS(LIMNI_ERROR_FACTOR);

/// The error at level 0. Code 0 is 0; the others are (1 + (code mod 4) / 4) 2^(code / 4 - 20).
static inline float limni_error_first(uint32_t code) {
    const uint32_t bits = code ? (code + ((127 - 20) << 2)) << 21 : 0;
    float first;
    memcpy(&first, &bits, sizeof first);
    return first;
}

/// The code of the factor from `level` to the next. What comes after level 3 is never drawn; its
/// factor is taken to be that of the level before.
static inline uint32_t limni_error_factor_code(uint32_t packed, uint32_t level) {
    const uint32_t stored = level < LIMN_LEVEL_MAX - 1 ? level : LIMN_LEVEL_MAX - 2;
    return packed >> (LIMNI_ERROR_FIRST_BITS + LIMNI_ERROR_FACTOR_BITS * stored) &
           (LIMNI_ERROR_FACTOR_COUNT - 1);
}

/// The error at a level, 0 to LIMN_LEVEL_MAX.
static inline float limni_error_at(uint32_t packed, uint32_t level) {
    float error = limni_error_first(packed & LIMNI_ERROR_FIRST_MAX);
    for (uint32_t n = 0; n < level; n++)
        error *= limni_error_factors[limni_error_factor_code(packed, n)];
    return error;
}

/// log2 within 0.008: continuous and rising, which is all that levels need, and quicker than
/// libm's. x: not negative.
static inline float limni_log2(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const float exponent = (float)((int32_t)(bits >> 23) - 127);
    bits = (bits & 0x7fffffu) | 0x3f800000u;
    float mantissa;
    memcpy(&mantissa, &bits, sizeof mantissa);
    const float t = mantissa - 1.0f;
    return exponent + t + 0.3466f * t * (1.0f - t);
}

/// What levels follow from: the error at level 0; 1 / factor and 1 / (1 - factor) for each level
/// and the next but the last.
typedef struct limni_error_curve {
    float first, inverses[LIMN_LEVEL_MAX - 1], slopes[LIMN_LEVEL_MAX - 1];
} limni_error_curve;

static inline limni_error_curve limni_error_unpack(uint32_t packed) {
    static const float inverses[] = LIMNI_ERROR_FACTORS(LIMNI_ERROR_INVERSE);
    static const float slopes[] = LIMNI_ERROR_FACTORS(LIMNI_ERROR_SLOPE);
    limni_error_curve curve = {.first = limni_error_first(packed & LIMNI_ERROR_FIRST_MAX)};
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX - 1; level++) {
        const uint32_t code = limni_error_factor_code(packed, level);
        curve.inverses[level] = inverses[code];
        curve.slopes[level] = slopes[code];
    }
    return curve;
}

/// Of the error that falls from one level to the next, the part that must have fallen, 0 to 1.
static inline float limni_error_fallen(float allowed, float slope) {
    const float fallen = (1 - allowed) * slope;
    const float above = fallen > 0 ? fallen : 0; // also where it is not a number
    return above < 1 ? above : 1;
}

/// The level at which an edge of that length has the error `tolerance` > 0, in the same unit: 0 or
/// more, continuous. Beyond LIMN_LEVEL_MAX, where the error is taken to fall 4 times a level, it
/// says what would be needed, so that levels that are then lowered stay in proportion. Without
/// branches, as it is computed for vectors of edges.
///
/// Part f of the way from one level to the next, a row on an edge is f/2 of the way from its elder
/// to the other end, on a chord. Of the error that falls, about (2 f + f^2) / 3 has fallen then, if
/// the curve is a parabola (1 % less at most); inside the patch it is f, which is more.
static inline float limni_error_level(const limni_error_curve *curve, float length,
                                      float tolerance) {
    const float at_0 = tolerance / (length * curve->first);
    const float at_1 = at_0 * curve->inverses[0];
    const float at_2 = at_1 * curve->inverses[1];
    const float at_3 = at_2 * curve->inverses[2];
    const float at_4 = at_3 * curve->inverses[2];
    const float fallen =
        limni_error_fallen(at_0, curve->slopes[0]) + limni_error_fallen(at_1, curve->slopes[1]) +
        limni_error_fallen(at_2, curve->slopes[2]) + limni_error_fallen(at_3, curve->slopes[2]);
    const float whole = (float)(int32_t)fallen;
    const float beyond = at_4 < 1 ? -0.5f * limni_log2(at_4) : 0;
    return whole + sqrtf(1 + 3 * (fallen - whole)) - 1 + beyond;
}

#endif
