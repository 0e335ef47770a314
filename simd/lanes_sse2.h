/* SPDX-License-Identifier: MIT */
#ifndef LANES_H
#define LANES_H

#include <emmintrin.h>

typedef __m128 lanes;

#define LANES_WIDTH 4
/// 9 accumulators, 3 splats, a column and a product; with 12, one more than the 16 registers are
/// needed.
#define LANES_TILE 3

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
static inline void lanes_store(float *dst, lanes a) {
    _mm_store_ps(dst, a);
}
/// Writes a - b, three floats and one more of any value. dst: aligned to 16 bytes.
static inline void lanes_subtract_point(float *dst, const float *a, const float *b) {
    const __m128 ax = _mm_loadl_pi(_mm_setzero_ps(), (const __m64 *)(const void *)a);
    const __m128 bx = _mm_loadl_pi(_mm_setzero_ps(), (const __m64 *)(const void *)b);
    const __m128 az = _mm_load_ss(a + 2), bz = _mm_load_ss(b + 2);
    _mm_store_ps(dst, _mm_sub_ps(_mm_movelh_ps(ax, az), _mm_movelh_ps(bx, bz)));
}
/// Writes x y z, lane after lane. dst: aligned to 4 bytes.
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
static inline lanes lanes_add(lanes a, lanes b) {
    return _mm_add_ps(a, b);
}
static inline lanes lanes_subtract(lanes a, lanes b) {
    return _mm_sub_ps(a, b);
}
static inline lanes lanes_divide(lanes a, lanes b) {
    return _mm_div_ps(a, b);
}
static inline lanes lanes_square_root(lanes a) {
    return _mm_sqrt_ps(a);
}
static inline lanes lanes_multiply(lanes a, lanes b) {
    return _mm_mul_ps(a, b);
}
/// a * b + c, rounded twice.
static inline lanes lanes_multiply_add(lanes a, lanes b, lanes c) {
    return _mm_add_ps(_mm_mul_ps(a, b), c);
}
static inline lanes lanes_blend(__m128 mask, lanes x, lanes y) {
    return _mm_or_ps(_mm_and_ps(mask, x), _mm_andnot_ps(mask, y));
}
/// Lane by lane: a > b ? x : y.
static inline lanes lanes_select_greater(lanes a, lanes b, lanes x, lanes y) {
    return lanes_blend(_mm_cmpgt_ps(a, b), x, y);
}
/// Lane by lane: a == 0 ? x : y.
static inline lanes lanes_select_zero(lanes a, lanes x, lanes y) {
    return lanes_blend(_mm_cmpeq_ps(a, _mm_setzero_ps()), x, y);
}

#endif
