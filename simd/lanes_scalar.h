/* SPDX-License-Identifier: MIT */
/* The reference: one lane. What the other instruction sets must agree with, bit for bit. */
#ifndef LANES_H
#define LANES_H

#include <math.h>

typedef float lanes;

#define LANES_WIDTH 1
#define LANES_TILE 8 ///< vectors per tile

static inline lanes lanes_zero(void) {
    return 0.0f;
}
static inline lanes lanes_splat(float value) {
    return value;
}
static inline lanes lanes_load(const float *src) {
    return *src;
}
static inline void lanes_store(float *dst, lanes a) {
    *dst = a;
}
/// Writes a - b, three floats and one more of any value. dst: aligned to 16 bytes.
static inline void lanes_subtract_point(float *dst, const float *a, const float *b) {
    for (int axis = 0; axis < 3; axis++)
        dst[axis] = a[axis] - b[axis];
}
/// Writes x y z, lane after lane. dst: aligned to 4 bytes.
static inline void lanes_store_xyz(float *dst, lanes x, lanes y, lanes z) {
    dst[0] = x;
    dst[1] = y;
    dst[2] = z;
}
static inline lanes lanes_add(lanes a, lanes b) {
    return a + b;
}
static inline lanes lanes_subtract(lanes a, lanes b) {
    return a - b;
}
static inline lanes lanes_divide(lanes a, lanes b) {
    return a / b;
}
static inline lanes lanes_square_root(lanes a) {
    return sqrtf(a);
}
static inline lanes lanes_multiply(lanes a, lanes b) {
    return a * b;
}
/// a * b + c, rounded twice.
static inline lanes lanes_multiply_add(lanes a, lanes b, lanes c) {
    return a * b + c;
}
/// Lane by lane: a > b ? x : y.
static inline lanes lanes_select_greater(lanes a, lanes b, lanes x, lanes y) {
    return a > b ? x : y;
}
/// Lane by lane: a == 0 ? x : y.
static inline lanes lanes_select_zero(lanes a, lanes x, lanes y) {
    return a == 0.0f ? x : y;
}

#endif
