/* SPDX-License-Identifier: MIT */
/*
 * Control points, or the normals at them, moved by the joints of a skin. Joints are gathered and
 * blended in quads, point by point; the rest is done in lanes across a block of points. No step
 * sums across lanes in an order of its own, or fuses, so both families give the same bits.
 */
#ifndef SKIN_BODY_H
#define SKIN_BODY_H

#include "formats.h"

#include <string.h>

enum { SKIN_BLOCK = 64, SKIN_GROUP = 4 };

LIMN_STATIC_ASSERT(SKIN_BLOCK % SKIN_GROUP == 0 && SKIN_BLOCK % LANES_WIDTH == 0,
                   "a block has no tail");
LIMN_STATIC_ASSERT(sizeof(limn_dual_quaternion) == 5 * sizeof(float[4]),
                   "a joint is two quaternions and three rows");

/// A block of points between steps, structure of arrays.
typedef struct skin_block {
    _Alignas(64) float vectors[3][SKIN_BLOCK];
    float unused[SKIN_BLOCK]; ///< the fourth component of vectors
    float real[4][SKIN_BLOCK], dual[4][SKIN_BLOCK];
} skin_block;

/// The influences on one point.
typedef struct influences {
    const uint16_t *joints;
    const float *weights;
    uint32_t count;
} influences;

static inline influences influences_of(const limn_skin *skin, uint32_t point) {
    const size_t first = (size_t)point * skin->influence_count;
    return (influences){skin->joints + first, skin->weights + first, skin->influence_count};
}

/// The weighted sums of `count` quads of every joint.
///
/// first   of joint 0
/// stride  floats from joint to joint
static LIMNI_INLINE void blend_joints(const influences *of, const float *weights,
                                      const float *first, size_t stride, int count, quad *sums) {
    const float *joint = first + stride * of->joints[0];
    quad weight = quad_splat(weights[0]);
    LIMNI_UNROLL
    for (int q = 0; q < count; q++)
        sums[q] = quad_multiply(weight, quad_load(joint + 4 * q));
    for (uint32_t i = 1; i < of->count; i++) {
        joint = first + stride * of->joints[i];
        weight = quad_splat(weights[i]);
        LIMNI_UNROLL
        for (int q = 0; q < count; q++)
            sums[q] = quad_add(sums[q], quad_multiply(weight, quad_load(joint + 4 * q)));
    }
}

/// A matrix times a vector: x', y', z' and 0, each as (x + z) + (y + w).
static inline quad transform(const quad rows[3], quad vector) {
    const quad x = quad_multiply(rows[0], vector), y = quad_multiply(rows[1], vector);
    const quad z = quad_multiply(rows[2], vector), zero = quad_splat(0);
    const quad xy = quad_add(quad_zip_low(x, y), quad_zip_high(x, y));
    const quad z0 = quad_add(quad_zip_low(z, zero), quad_zip_high(z, zero));
    return quad_add(quad_low_low(xy, z0), quad_high_high(xy, z0));
}

/// Four quads, transposed into four planes from `place` on.
static inline void store_planes(const quad quads[SKIN_GROUP], float *place) {
    const quad xy01 = quad_zip_low(quads[0], quads[1]), xy23 = quad_zip_low(quads[2], quads[3]);
    const quad zw01 = quad_zip_high(quads[0], quads[1]), zw23 = quad_zip_high(quads[2], quads[3]);
    quad_store(place, quad_low_low(xy01, xy23));
    quad_store(place + SKIN_BLOCK, quad_high_high(xy01, xy23));
    quad_store(place + 2 * SKIN_BLOCK, quad_low_low(zw01, zw23));
    quad_store(place + 3 * SKIN_BLOCK, quad_high_high(zw01, zw23));
}

/// Weights of quaternions: q and -q are one rotation, of which all take the one on the side of the
/// first. Else a blend would go the long way around.
static inline void sign_weights(const influences *of, const limn_dual_quaternion *joints,
                                float weights[LIMN_INFLUENCE_MAX]) {
    const float *const a = joints[of->joints[0]].real;
    weights[0] = of->weights[0];
    for (uint32_t i = 1; i < of->count; i++) {
        const float *const b = joints[of->joints[i]].real;
        const float cosine = (a[0] * b[0] + a[2] * b[2]) + (a[1] * b[1] + a[3] * b[3]);
        weights[i] = cosine < 0 ? -of->weights[i] : of->weights[i];
    }
}

/// What moves a point, in `quads`: its vector, transformed or stretched; with dual quaternions,
/// these as well, blended.
static LIMNI_INLINE void blend_point(const limn_pose *pose, bool dual, uint32_t point, quad vector,
                                     quad quads[3]) {
    const influences of = influences_of(pose->skin, point);
    quad rows[3];
    if (!dual) {
        blend_joints(&of, of.weights, pose->matrices, 12, 3, rows);
    } else {
        const limn_dual_quaternion *const joints = pose->dual_quaternions;
        const size_t stride = sizeof *joints / sizeof(float);
        float weights[LIMN_INFLUENCE_MAX];
        blend_joints(&of, of.weights, joints->stretch[0], stride, 3, rows);
        sign_weights(&of, joints, weights);
        blend_joints(&of, weights, joints->real, stride, 2, quads + 1);
    }
    quads[0] = transform(rows, vector);
}

/// Fills a block from `count` points; up to the end of a vector it repeats the last.
static LIMNI_INLINE void fill_block(const limn_pose *pose, bool dual, const limn_mesh *mesh,
                                    const float *src, uint32_t first, uint32_t count,
                                    skin_block *block) {
    static const float place_of_point[4] = {0, 0, 0, 1};
    const quad fourth = mesh ? quad_splat(0) : quad_load(place_of_point);
    for (uint32_t at = 0; at < count || at % LANES_WIDTH != 0; at += SKIN_GROUP) {
        quad moved[SKIN_GROUP], real[SKIN_GROUP], both[SKIN_GROUP];
        for (uint32_t i = 0; i < SKIN_GROUP; i++) {
            const uint32_t index = first + (at + i < count ? at + i : count - 1);
            const quad vector = quad_add(quad_load_point(src + 3 * (size_t)index), fourth);
            quad quads[3];
            blend_point(pose, dual, mesh ? limni_point_of(mesh, index) : index, vector, quads);
            moved[i] = quads[0];
            if (dual) real[i] = quads[1], both[i] = quads[2];
        }
        store_planes(moved, &block->vectors[0][at]);
        if (!dual) continue;
        store_planes(real, &block->real[0][at]);
        store_planes(both, &block->dual[0][at]);
    }
}

static inline lanes cross_axis(const lanes a[3], const lanes b[3], int axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    return lanes_subtract(lanes_multiply(a[next], b[last]), lanes_multiply(a[last], b[next]));
}

/// With q = (v, w) the blended real part and e = (d, s) the dual one, a vector p goes to
/// p + k (v x (v x p + w p + d) + w d - s v), k = 2 / q.q (Kavan and others, "Geometric skinning
/// with approximate dual quaternion blending", 2008). For normals d and s are 0.
static LIMNI_INLINE void turn_block(bool normals, uint32_t count, skin_block *block) {
    for (uint32_t at = 0; at < count; at += LANES_WIDTH) {
        lanes p[3], v[3], d[3], inner[3];
        const lanes w = lanes_load_any(&block->real[3][at]);
        const lanes s = lanes_load_any(&block->dual[3][at]);
        lanes square = lanes_multiply(w, w);
        for (int axis = 0; axis < 3; axis++) {
            p[axis] = lanes_load_any(&block->vectors[axis][at]);
            v[axis] = lanes_load_any(&block->real[axis][at]);
            d[axis] = lanes_load_any(&block->dual[axis][at]);
            square = lanes_add(square, lanes_multiply(v[axis], v[axis]));
        }
        for (int axis = 0; axis < 3; axis++) {
            inner[axis] = lanes_add(cross_axis(v, p, axis), lanes_multiply(w, p[axis]));
            if (!normals) inner[axis] = lanes_add(inner[axis], d[axis]);
        }
        const lanes k = lanes_divide(lanes_splat(2.0f), square);
        for (int axis = 0; axis < 3; axis++) {
            lanes way = cross_axis(v, inner, axis);
            if (!normals)
                way = lanes_add(
                    way, lanes_subtract(lanes_multiply(w, d[axis]), lanes_multiply(s, v[axis])));
            lanes_store(&block->vectors[axis][at], lanes_add(p[axis], lanes_multiply(k, way)));
        }
    }
}

static LIMNI_INLINE void write_block(bool normals, uint32_t count, const skin_block *block,
                                     float *dst) {
    float packed[3 * SKIN_BLOCK];
    for (uint32_t at = 0; at < count; at += LANES_WIDTH) {
        lanes x = lanes_load_any(&block->vectors[0][at]);
        lanes y = lanes_load_any(&block->vectors[1][at]);
        lanes z = lanes_load_any(&block->vectors[2][at]);
        if (normals) make_unit_normals(&x, &y, &z);
        lanes_store_xyz(packed + 3 * (size_t)at, x, y, z);
    }
    memcpy(dst, packed, count * sizeof(float[3]));
}

static LIMNI_INLINE void skin_blocks(const limn_pose *pose, bool dual, const limn_mesh *mesh,
                                     const float *src, uint32_t begin, uint32_t end, float *dst) {
    skin_block block;
    for (uint32_t first = begin, count; first < end; first += count) {
        count = end - first < SKIN_BLOCK ? end - first : SKIN_BLOCK;
        fill_block(pose, dual, mesh, src, first, count, &block);
        if (dual) turn_block(mesh != NULL, count, &block);
        write_block(mesh != NULL, count, &block, dst + 3 * (size_t)first);
    }
}

static void skin_range(const limn_pose *pose, const limn_mesh *mesh, const float *src,
                       uint32_t begin, uint32_t end, float *dst) {
    if (pose->dual_quaternions) {
        skin_blocks(pose, true, mesh, src, begin, end, dst);
    } else {
        skin_blocks(pose, false, mesh, src, begin, end, dst);
    }
    lanes_end();
}

#endif
