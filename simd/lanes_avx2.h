/* SPDX-License-Identifier: MIT */
/* With LANES_FUSED, lanes_multiply_add() is one instruction with one rounding, which needs FMA. */
#ifndef LANES_H
#define LANES_H

#include <immintrin.h>

typedef __m256 lanes;

#define LANES_WIDTH 8
#ifdef LANES_FUSED
#define LANES_TILE 4 ///< 12 accumulators, 3 splats and a column fill the 16 registers
#else
#define LANES_TILE 3 ///< products take a register more
#endif

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
static inline void lanes_store(float *dst, lanes a) {
    _mm256_store_ps(dst, a);
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
    // As for SSE2 in each half; then the halves go behind one another.
    const __m256 x0x2y0y2 = _mm256_shuffle_ps(x, y, _MM_SHUFFLE(2, 0, 2, 0));
    const __m256 y1y3z1z3 = _mm256_shuffle_ps(y, z, _MM_SHUFFLE(3, 1, 3, 1));
    const __m256 z0z2x1x3 = _mm256_shuffle_ps(z, x, _MM_SHUFFLE(3, 1, 2, 0));
    const __m256 a = _mm256_shuffle_ps(x0x2y0y2, z0z2x1x3, _MM_SHUFFLE(2, 0, 2, 0));
    const __m256 b = _mm256_shuffle_ps(y1y3z1z3, x0x2y0y2, _MM_SHUFFLE(3, 1, 2, 0));
    const __m256 c = _mm256_shuffle_ps(z0z2x1x3, y1y3z1z3, _MM_SHUFFLE(3, 1, 3, 1));
    _mm256_storeu_ps(dst, _mm256_permute2f128_ps(a, b, 0x20));
    _mm256_storeu_ps(dst + 8, _mm256_permute2f128_ps(c, a, 0x30));
    _mm256_storeu_ps(dst + 16, _mm256_permute2f128_ps(b, c, 0x31));
}
static inline lanes lanes_add(lanes a, lanes b) {
    return _mm256_add_ps(a, b);
}
static inline lanes lanes_subtract(lanes a, lanes b) {
    return _mm256_sub_ps(a, b);
}
static inline lanes lanes_divide(lanes a, lanes b) {
    return _mm256_div_ps(a, b);
}
static inline lanes lanes_square_root(lanes a) {
    return _mm256_sqrt_ps(a);
}
static inline lanes lanes_multiply(lanes a, lanes b) {
    return _mm256_mul_ps(a, b);
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
/// Lane by lane: a > b ? x : y.
static inline lanes lanes_select_greater(lanes a, lanes b, lanes x, lanes y) {
    return _mm256_blendv_ps(y, x, _mm256_cmp_ps(a, b, _CMP_GT_OQ));
}
/// Lane by lane: a == 0 ? x : y.
static inline lanes lanes_select_zero(lanes a, lanes x, lanes y) {
    return _mm256_blendv_ps(y, x, _mm256_cmp_ps(a, _mm256_setzero_ps(), _CMP_EQ_OQ));
}

#endif
