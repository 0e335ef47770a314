/* SPDX-License-Identifier: MIT */
/* AArch64. With LANES_FUSED, lanes_multiply_add() is one instruction with one rounding. */
#ifndef LANES_H
#define LANES_H

#include <arm_neon.h>
#include <stddef.h>

typedef float32x4_t lanes;

#define LANES_WIDTH 4
#define LANES_PAIR_TILE 6
#define LANES_TILE 8 ///< 24 accumulators, 3 splats and some columns of the 32 registers

/// Leaves the state that other code expects.
static inline void lanes_end(void) {}
static inline lanes lanes_zero(void) {
    return vdupq_n_f32(0.0f);
}
static inline lanes lanes_splat(float value) {
    return vdupq_n_f32(value);
}
static inline lanes lanes_load(const float *src) {
    return vld1q_f32(src);
}
static inline lanes lanes_load_any(const float *src) {
    return vld1q_f32(src);
}
static inline void lanes_store(float *dst, lanes a) {
    vst1q_f32(dst, a);
}
/// Writes x y z, or x y, lane after lane. dst: not aligned.
static inline void lanes_store_xyz(float *dst, lanes x, lanes y, lanes z) {
    const float32x4x3_t xyz = {{x, y, z}};
    vst3q_f32(dst, xyz);
}
static inline void lanes_store_xy(float *dst, lanes x, lanes y) {
    const float32x4x2_t xy = {{x, y}};
    vst2q_f32(dst, xy);
}
static inline lanes lanes_add(lanes a, lanes b) {
    return vaddq_f32(a, b);
}
static inline lanes lanes_subtract(lanes a, lanes b) {
    return vsubq_f32(a, b);
}
static inline lanes lanes_multiply(lanes a, lanes b) {
    return vmulq_f32(a, b);
}
static inline lanes lanes_divide(lanes a, lanes b) {
    return vdivq_f32(a, b);
}
#ifdef LANES_FUSED
/// a * b + c, rounded once.
static inline lanes lanes_multiply_add(lanes a, lanes b, lanes c) {
    return vfmaq_f32(c, a, b);
}
#else
/// a * b + c, rounded twice.
static inline lanes lanes_multiply_add(lanes a, lanes b, lanes c) {
    return vaddq_f32(vmulq_f32(a, b), c);
}
#endif
/// Lane by lane: a > b ? a : b.
static inline lanes lanes_max(lanes a, lanes b) {
    return vbslq_f32(vcgtq_f32(a, b), a, b);
}
/// Lane by lane: a < b ? a : b.
static inline lanes lanes_min(lanes a, lanes b) {
    return vbslq_f32(vcltq_f32(a, b), a, b);
}
/// Lane by lane: a > b ? x : y.
static inline lanes lanes_select_greater(lanes a, lanes b, lanes x, lanes y) {
    return vbslq_f32(vcgtq_f32(a, b), x, y);
}
/// Lane by lane: a == 0 ? x : y.
static inline lanes lanes_select_zero(lanes a, lanes x, lanes y) {
    return vbslq_f32(vceqzq_f32(a), x, y);
}
/// The magnitude of a with the sign of b.
static inline lanes lanes_copy_sign(lanes a, lanes b) {
    return vbslq_f32(vdupq_n_u32(0x80000000u), b, a);
}
/// On bit patterns: the lower `bits` bits of a, below all of b.
#define lanes_join(a, b, bits)                                                                     \
    vreinterpretq_f32_u32(vsliq_n_u32(vreinterpretq_u32_f32(a), vreinterpretq_u32_f32(b), bits))
/// On bit patterns: `from` less half of a.
static inline lanes lanes_less_half_bits(uint32_t from, lanes a) {
    return vreinterpretq_f32_u32(
        vsubq_u32(vdupq_n_u32(from), vshrq_n_u32(vreinterpretq_u32_f32(a), 1)));
}

typedef float32x4_t quad;

static inline quad quad_load(const float *src) {
    return vld1q_f32(src);
}
static inline void quad_store(void *dst, quad a) {
    vst1q_u8((uint8_t *)dst, vreinterpretq_u8_f32(a));
}
/// Three floats and 0; reads no more.
static inline quad quad_load_point(const float *src) {
    return vcombine_f32(vld1_f32(src), vld1_lane_f32(src + 2, vdup_n_f32(0.0f), 0));
}
static inline quad quad_splat(float value) {
    return vdupq_n_f32(value);
}
static inline quad quad_multiply(quad a, quad b) {
    return vmulq_f32(a, b);
}
static inline quad quad_add(quad a, quad b) {
    return vaddq_f32(a, b);
}
static inline quad quad_subtract(quad a, quad b) {
    return vsubq_f32(a, b);
}
/// The two quads a0 b0 a1 b1 and a2 b2 a3 b3.
static inline quad quad_zip_low(quad a, quad b) {
    return vzip1q_f32(a, b);
}
static inline quad quad_zip_high(quad a, quad b) {
    return vzip2q_f32(a, b);
}
/// Halves of a, then of b.
static inline quad quad_low_low(quad a, quad b) {
    return vcombine_f32(vget_low_f32(a), vget_low_f32(b));
}
static inline quad quad_low_high(quad a, quad b) {
    return vcombine_f32(vget_low_f32(a), vget_high_f32(b));
}
static inline quad quad_high_high(quad a, quad b) {
    return vcombine_f32(vget_high_f32(a), vget_high_f32(b));
}

/// C has no such stores here: a plain copy.
static inline void lanes_stream(void *dst, const void *src, size_t size) {
    __builtin_memcpy(dst, src, size);
}
static inline void lanes_stream_end(void) {}

#endif
