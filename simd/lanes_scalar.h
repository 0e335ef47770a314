/* SPDX-License-Identifier: MIT */
/* The reference: one lane. What the other instruction sets must agree with, bit for bit. */
#ifndef LANES_H
#define LANES_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef float lanes;

#define LANES_WIDTH 1
#define LANES_TILE 8 ///< vectors per tile
#define LANES_PAIR_TILE 8

/// Leaves the state that other code expects.
static inline void lanes_end(void) {}
static inline lanes lanes_zero(void) {
    return 0.0f;
}
static inline lanes lanes_splat(float value) {
    return value;
}
static inline lanes lanes_load(const float *src) {
    return *src;
}
static inline lanes lanes_load_any(const float *src) {
    return *src;
}
static inline void lanes_store(float *dst, lanes a) {
    *dst = a;
}
/// Writes x y z, or x y, lane after lane.
static inline void lanes_store_xyz(float *dst, lanes x, lanes y, lanes z) {
    dst[0] = x;
    dst[1] = y;
    dst[2] = z;
}
static inline void lanes_store_xy(float *dst, lanes x, lanes y) {
    dst[0] = x;
    dst[1] = y;
}
static inline lanes lanes_add(lanes a, lanes b) {
    return a + b;
}
static inline lanes lanes_subtract(lanes a, lanes b) {
    return a - b;
}
static inline lanes lanes_multiply(lanes a, lanes b) {
    return a * b;
}
static inline lanes lanes_divide(lanes a, lanes b) {
    return a / b;
}
/// a * b + c, rounded twice.
static inline lanes lanes_multiply_add(lanes a, lanes b, lanes c) {
    return a * b + c;
}
/// Lane by lane: a > b ? a : b.
static inline lanes lanes_max(lanes a, lanes b) {
    return a > b ? a : b;
}
/// Lane by lane: a < b ? a : b.
static inline lanes lanes_min(lanes a, lanes b) {
    return a < b ? a : b;
}
/// Lane by lane: a > b ? x : y.
static inline lanes lanes_select_greater(lanes a, lanes b, lanes x, lanes y) {
    return a > b ? x : y;
}
/// Lane by lane: a == 0 ? x : y.
static inline lanes lanes_select_zero(lanes a, lanes x, lanes y) {
    return a == 0.0f ? x : y;
}
/// The magnitude of a with the sign of b.
static inline lanes lanes_copy_sign(lanes a, lanes b) {
    return copysignf(a, b);
}
static inline uint32_t lanes_bits(lanes a) {
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}
static inline lanes lanes_from_bits(uint32_t bits) {
    lanes a;
    memcpy(&a, &bits, sizeof a);
    return a;
}
/// On bit patterns: the lower `bits` bits of a, below all of b.
static inline lanes lanes_join(lanes a, lanes b, int bits) {
    return lanes_from_bits((lanes_bits(a) & ((1u << bits) - 1)) | lanes_bits(b) << bits);
}
/// On bit patterns: `from` less half of a.
static inline lanes lanes_less_half_bits(uint32_t from, lanes a) {
    return lanes_from_bits(from - (lanes_bits(a) >> 1));
}

typedef struct quad {
    float f[4];
} quad;

static inline quad quad_load(const float *src) {
    return (quad){{src[0], src[1], src[2], src[3]}};
}
static inline void quad_store(void *dst, quad a) {
    memcpy(dst, &a, sizeof a);
}
/// Three floats and 0; reads no more.
static inline quad quad_load_point(const float *src) {
    return (quad){{src[0], src[1], src[2], 0.0f}};
}
static inline quad quad_splat(float value) {
    return (quad){{value, value, value, value}};
}
static inline quad quad_multiply(quad a, quad b) {
    return (quad){{a.f[0] * b.f[0], a.f[1] * b.f[1], a.f[2] * b.f[2], a.f[3] * b.f[3]}};
}
static inline quad quad_add(quad a, quad b) {
    return (quad){{a.f[0] + b.f[0], a.f[1] + b.f[1], a.f[2] + b.f[2], a.f[3] + b.f[3]}};
}
static inline quad quad_subtract(quad a, quad b) {
    return (quad){{a.f[0] - b.f[0], a.f[1] - b.f[1], a.f[2] - b.f[2], a.f[3] - b.f[3]}};
}
/// The two quads a0 b0 a1 b1 and a2 b2 a3 b3.
static inline quad quad_zip_low(quad a, quad b) {
    return (quad){{a.f[0], b.f[0], a.f[1], b.f[1]}};
}
static inline quad quad_zip_high(quad a, quad b) {
    return (quad){{a.f[2], b.f[2], a.f[3], b.f[3]}};
}
/// Halves of a, then of b.
static inline quad quad_low_low(quad a, quad b) {
    return (quad){{a.f[0], a.f[1], b.f[0], b.f[1]}};
}
static inline quad quad_low_high(quad a, quad b) {
    return (quad){{a.f[0], a.f[1], b.f[2], b.f[3]}};
}
static inline quad quad_high_high(quad a, quad b) {
    return (quad){{a.f[2], a.f[3], b.f[2], b.f[3]}};
}

/// C has no such stores: a plain copy.
static inline void lanes_stream(void *dst, const void *src, size_t size) {
    memcpy(dst, src, size);
}
static inline void lanes_stream_end(void) {}

#endif
