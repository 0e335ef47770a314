/* SPDX-License-Identifier: MIT */
/* AArch64. With LANES_FUSED, lanes_multiply_add() is one instruction with one rounding. */
#ifndef LANES_H
#define LANES_H

#include <arm_neon.h>

typedef float32x4_t lanes;

#define LANES_WIDTH 4
#define LANES_TILE 8 ///< 24 accumulators, 3 splats and some columns of the 32 registers

static inline lanes lanes_zero(void) {
    return vdupq_n_f32(0.0f);
}
static inline lanes lanes_splat(float value) {
    return vdupq_n_f32(value);
}
static inline lanes lanes_load(const float *src) {
    return vld1q_f32(src);
}
static inline void lanes_store(float *dst, lanes a) {
    vst1q_f32(dst, a);
}
/// Writes a - b, three floats and one more of any value. dst: aligned to 16 bytes.
static inline void lanes_subtract_point(float *dst, const float *a, const float *b) {
    const float32x2_t az = vld1_lane_f32(a + 2, vdup_n_f32(0.0f), 0);
    const float32x2_t bz = vld1_lane_f32(b + 2, vdup_n_f32(0.0f), 0);
    vst1q_f32(dst, vsubq_f32(vcombine_f32(vld1_f32(a), az), vcombine_f32(vld1_f32(b), bz)));
}
/// Writes x y z, lane after lane. dst: aligned to 4 bytes.
static inline void lanes_store_xyz(float *dst, lanes x, lanes y, lanes z) {
    const float32x4x3_t xyz = {{x, y, z}};
    vst3q_f32(dst, xyz);
}
static inline lanes lanes_add(lanes a, lanes b) {
    return vaddq_f32(a, b);
}
static inline lanes lanes_subtract(lanes a, lanes b) {
    return vsubq_f32(a, b);
}
static inline lanes lanes_divide(lanes a, lanes b) {
    return vdivq_f32(a, b);
}
static inline lanes lanes_square_root(lanes a) {
    return vsqrtq_f32(a);
}
static inline lanes lanes_multiply(lanes a, lanes b) {
    return vmulq_f32(a, b);
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
/// Lane by lane: a > b ? x : y.
static inline lanes lanes_select_greater(lanes a, lanes b, lanes x, lanes y) {
    return vbslq_f32(vcgtq_f32(a, b), x, y);
}
/// Lane by lane: a == 0 ? x : y.
static inline lanes lanes_select_zero(lanes a, lanes x, lanes y) {
    return vbslq_f32(vceqzq_f32(a), x, y);
}

#endif
