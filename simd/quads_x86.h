/* SPDX-License-Identifier: MIT */
/* Four floats at a time, with SSE2: what the lanes of SSE2 and AVX2 have in common. */
#ifndef QUADS_X86_H
#define QUADS_X86_H

#ifdef __AVX__
#include <immintrin.h>
#else
#include <emmintrin.h>
#endif
#include <stddef.h>
#include <stdint.h>

typedef __m128 quad;

static inline quad quad_load(const float *src) {
    return _mm_loadu_ps(src);
}
static inline void quad_store(void *dst, quad a) {
    _mm_storeu_ps((float *)dst, a);
}
/// Three floats and 0; reads no more.
static inline quad quad_load_point(const float *src) {
#ifdef __AVX__
    return _mm_maskload_ps(src, _mm_setr_epi32(-1, -1, -1, 0));
#else
    const __m128 xy = _mm_castsi128_ps(_mm_loadl_epi64((const __m128i *)(const void *)src));
    return _mm_movelh_ps(xy, _mm_load_ss(src + 2));
#endif
}
static inline quad quad_splat(float value) {
    return _mm_set1_ps(value);
}
static inline quad quad_multiply(quad a, quad b) {
    return _mm_mul_ps(a, b);
}
static inline quad quad_add(quad a, quad b) {
    return _mm_add_ps(a, b);
}
static inline quad quad_subtract(quad a, quad b) {
    return _mm_sub_ps(a, b);
}
/// The two quads a0 b0 a1 b1 and a2 b2 a3 b3.
static inline quad quad_zip_low(quad a, quad b) {
    return _mm_unpacklo_ps(a, b);
}
static inline quad quad_zip_high(quad a, quad b) {
    return _mm_unpackhi_ps(a, b);
}
/// Halves of a, then of b.
static inline quad quad_low_low(quad a, quad b) {
    return _mm_movelh_ps(a, b);
}
static inline quad quad_low_high(quad a, quad b) {
    return _mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 2, 1, 0));
}
static inline quad quad_high_high(quad a, quad b) {
    return _mm_movehl_ps(b, a);
}

static inline void stream_word(char *dst, const char *src) {
    int word;
    __builtin_memcpy(&word, src, sizeof word);
    _mm_stream_si32((int *)(void *)dst, word);
}
/// Copies `size` bytes past the caches. dst: aligned to 4 bytes.
static inline void lanes_stream(void *dst, const void *src, size_t size) {
    char *to = dst;
    const char *from = src;
    const char *const end = from + size;
    for (; (uintptr_t)to % 16 != 0 && end - from >= 4; to += 4, from += 4)
        stream_word(to, from);
    for (; end - from >= 16; to += 16, from += 16)
        _mm_stream_ps((float *)(void *)to, _mm_loadu_ps((const float *)(const void *)from));
    for (; end - from >= 4; to += 4, from += 4)
        stream_word(to, from);
}
/// After the last lanes_stream().
static inline void lanes_stream_end(void) {
    _mm_sfence();
}

#endif
