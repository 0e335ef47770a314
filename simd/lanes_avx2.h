/* SPDX-License-Identifier: MIT */
/* With LANES_FUSED, lanes_multiply_add() is one instruction with one rounding, which needs FMA. */
#ifndef LANES_H
#define LANES_H

#include "quads_x86.h"

#include <immintrin.h>

typedef __m256 lanes;

#define LANES_WIDTH 8
#define LANES_PAIR_TILE 3 ///< 9 accumulators
#ifdef LANES_FUSED
#define LANES_TILE 4 ///< 12 accumulators, 3 splats and a column fill the 16 registers
#else
#define LANES_TILE 3 ///< products take a register more
#endif

/// Leaves the state that other code expects; the compiler would do so after every function, and
/// that costs more than storing a patch (Zen 5).
static inline void lanes_end(void) {
    _mm256_zeroupper();
}
static inline lanes lanes_zero(void) {
    return _mm256_setzero_ps();
}
static inline lanes lanes_splat(float value) {
    return _mm256_set1_ps(value);
}
/// src: aligned to 32 bytes.
static inline lanes lanes_load(const float *src) {
    return _mm256_load_ps(src);
}
/// src, dst: not aligned.
static inline lanes lanes_load_any(const float *src) {
    return _mm256_loadu_ps(src);
}
static inline void lanes_store(float *dst, lanes a) {
    _mm256_storeu_ps(dst, a);
}
/// Writes x y z, or x y, lane after lane. dst: not aligned.
static inline void lanes_store_xyz(float *dst, lanes x, lanes y, lanes z) {
    // Row r of x belongs to float 3r of the 24, row r of y to 3r + 1, row r of z to 3r + 2. Modulo
    // 8 each of the three takes every place once, so one permutation of each and blends are enough.
    x = _mm256_permutevar8x32_ps(x, _mm256_setr_epi32(0, 3, 6, 1, 4, 7, 2, 5));
    y = _mm256_permutevar8x32_ps(y, _mm256_setr_epi32(5, 0, 3, 6, 1, 4, 7, 2));
    z = _mm256_permutevar8x32_ps(z, _mm256_setr_epi32(2, 5, 0, 3, 6, 1, 4, 7));
    _mm256_storeu_ps(dst, _mm256_blend_ps(_mm256_blend_ps(x, y, 0x92), z, 0x24));
    _mm256_storeu_ps(dst + 8, _mm256_blend_ps(_mm256_blend_ps(y, z, 0x49), x, 0x92));
    _mm256_storeu_ps(dst + 16, _mm256_blend_ps(_mm256_blend_ps(x, y, 0x49), z, 0x92));
}
static inline void lanes_store_xy(float *dst, lanes x, lanes y) {
    const __m256 low = _mm256_unpacklo_ps(x, y), high = _mm256_unpackhi_ps(x, y);
    _mm256_storeu_ps(dst, _mm256_permute2f128_ps(low, high, 0x20));
    _mm256_storeu_ps(dst + 8, _mm256_permute2f128_ps(low, high, 0x31));
}
static inline lanes lanes_add(lanes a, lanes b) {
    return _mm256_add_ps(a, b);
}
static inline lanes lanes_subtract(lanes a, lanes b) {
    return _mm256_sub_ps(a, b);
}
static inline lanes lanes_multiply(lanes a, lanes b) {
    return _mm256_mul_ps(a, b);
}
static inline lanes lanes_divide(lanes a, lanes b) {
    return _mm256_div_ps(a, b);
}
#ifdef LANES_FUSED
/// a * b + c, rounded once.
static inline lanes lanes_multiply_add(lanes a, lanes b, lanes c) {
    return _mm256_fmadd_ps(a, b, c);
}
#else
/// a * b + c, rounded twice.
static inline lanes lanes_multiply_add(lanes a, lanes b, lanes c) {
    return _mm256_add_ps(_mm256_mul_ps(a, b), c);
}
#endif
/// Lane by lane: a > b ? a : b.
static inline lanes lanes_max(lanes a, lanes b) {
    return _mm256_max_ps(a, b);
}
/// Lane by lane: a < b ? a : b.
static inline lanes lanes_min(lanes a, lanes b) {
    return _mm256_min_ps(a, b);
}
/// Lane by lane: a > b ? x : y.
static inline lanes lanes_select_greater(lanes a, lanes b, lanes x, lanes y) {
    return _mm256_blendv_ps(y, x, _mm256_cmp_ps(a, b, _CMP_GT_OQ));
}
/// Lane by lane: a == 0 ? x : y.
static inline lanes lanes_select_zero(lanes a, lanes x, lanes y) {
    return _mm256_blendv_ps(y, x, _mm256_cmp_ps(a, _mm256_setzero_ps(), _CMP_EQ_OQ));
}
/// The magnitude of a with the sign of b.
static inline lanes lanes_copy_sign(lanes a, lanes b) {
    const __m256 sign = _mm256_set1_ps(-0.0f);
    return _mm256_or_ps(_mm256_andnot_ps(sign, a), _mm256_and_ps(sign, b));
}
/// On bit patterns: the lower `bits` bits of a, below all of b.
#define lanes_join(a, b, bits)                                                                     \
    _mm256_castsi256_ps(_mm256_or_si256(                                                           \
        _mm256_and_si256(_mm256_castps_si256(a), _mm256_set1_epi32((1 << (bits)) - 1)),            \
        _mm256_slli_epi32(_mm256_castps_si256(b), bits)))
/// On bit patterns: `from` less half of a.
static inline lanes lanes_less_half_bits(uint32_t from, lanes a) {
    return _mm256_castsi256_ps(_mm256_sub_epi32(_mm256_set1_epi32((int)from),
                                                _mm256_srli_epi32(_mm256_castps_si256(a), 1)));
}

#endif
