/* SPDX-License-Identifier: MIT */
#ifndef LANES_H
#define LANES_H

#include "quads_x86.h"

typedef __m128 lanes;

#define LANES_WIDTH 4
/// 9 accumulators, 3 splats, a column and a product; with 12, one more than the 16 registers are
/// needed.
#define LANES_TILE 3
#define LANES_PAIR_TILE 2 ///< one block of 8 rows

/// Leaves the state that other code expects.
static inline void lanes_end(void) {}
static inline lanes lanes_zero(void) {
    return _mm_setzero_ps();
}
static inline lanes lanes_splat(float value) {
    return _mm_set1_ps(value);
}
/// src: aligned to 16 bytes.
static inline lanes lanes_load(const float *src) {
    return _mm_load_ps(src);
}
/// src, dst: not aligned.
static inline lanes lanes_load_any(const float *src) {
    return _mm_loadu_ps(src);
}
static inline void lanes_store(float *dst, lanes a) {
    _mm_storeu_ps(dst, a);
}
/// Writes x y z, or x y, lane after lane. dst: not aligned.
static inline void lanes_store_xyz(float *dst, lanes x, lanes y, lanes z) {
    const __m128 x0x2y0y2 = _mm_shuffle_ps(x, y, _MM_SHUFFLE(2, 0, 2, 0));
    const __m128 y1y3z1z3 = _mm_shuffle_ps(y, z, _MM_SHUFFLE(3, 1, 3, 1));
    const __m128 z0z2x1x3 = _mm_shuffle_ps(z, x, _MM_SHUFFLE(3, 1, 2, 0));
    const __m128 a = _mm_shuffle_ps(x0x2y0y2, z0z2x1x3, _MM_SHUFFLE(2, 0, 2, 0));
    const __m128 b = _mm_shuffle_ps(y1y3z1z3, x0x2y0y2, _MM_SHUFFLE(3, 1, 2, 0));
    const __m128 c = _mm_shuffle_ps(z0z2x1x3, y1y3z1z3, _MM_SHUFFLE(3, 1, 3, 1));
    _mm_storeu_ps(dst, a);
    _mm_storeu_ps(dst + 4, b);
    _mm_storeu_ps(dst + 8, c);
}
static inline void lanes_store_xy(float *dst, lanes x, lanes y) {
    _mm_storeu_ps(dst, _mm_unpacklo_ps(x, y));
    _mm_storeu_ps(dst + 4, _mm_unpackhi_ps(x, y));
}
static inline lanes lanes_add(lanes a, lanes b) {
    return _mm_add_ps(a, b);
}
static inline lanes lanes_subtract(lanes a, lanes b) {
    return _mm_sub_ps(a, b);
}
static inline lanes lanes_multiply(lanes a, lanes b) {
    return _mm_mul_ps(a, b);
}
static inline lanes lanes_divide(lanes a, lanes b) {
    return _mm_div_ps(a, b);
}
/// a * b + c, rounded twice.
static inline lanes lanes_multiply_add(lanes a, lanes b, lanes c) {
    return _mm_add_ps(_mm_mul_ps(a, b), c);
}
static inline lanes lanes_blend(__m128 mask, lanes x, lanes y) {
    return _mm_or_ps(_mm_and_ps(mask, x), _mm_andnot_ps(mask, y));
}
/// Lane by lane: a > b ? a : b.
static inline lanes lanes_max(lanes a, lanes b) {
    return _mm_max_ps(a, b);
}
/// Lane by lane: a < b ? a : b.
static inline lanes lanes_min(lanes a, lanes b) {
    return _mm_min_ps(a, b);
}
/// Lane by lane: a > b ? x : y.
static inline lanes lanes_select_greater(lanes a, lanes b, lanes x, lanes y) {
    return lanes_blend(_mm_cmpgt_ps(a, b), x, y);
}
/// Lane by lane: a == 0 ? x : y.
static inline lanes lanes_select_zero(lanes a, lanes x, lanes y) {
    return lanes_blend(_mm_cmpeq_ps(a, _mm_setzero_ps()), x, y);
}
/// The magnitude of a with the sign of b.
static inline lanes lanes_copy_sign(lanes a, lanes b) {
    return lanes_blend(_mm_set1_ps(-0.0f), b, a);
}
/// On bit patterns: the lower `bits` bits of a, below all of b.
#define lanes_join(a, b, bits)                                                                     \
    _mm_castsi128_ps(                                                                              \
        _mm_or_si128(_mm_and_si128(_mm_castps_si128(a), _mm_set1_epi32((1 << (bits)) - 1)),        \
                     _mm_slli_epi32(_mm_castps_si128(b), bits)))
/// On bit patterns: `from` less half of a.
static inline lanes lanes_less_half_bits(uint32_t from, lanes a) {
    return _mm_castsi128_ps(
        _mm_sub_epi32(_mm_set1_epi32((int)from), _mm_srli_epi32(_mm_castps_si128(a), 1)));
}

#endif
