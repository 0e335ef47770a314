/* SPDX-License-Identifier: MIT */
/*
 * Skinning in double precision, point by point, without any of the runtime's code: joints are made
 * from a stretch, a quaternion and a translation, from which follow both their matrices and what
 * dual quaternion blending shall do.
 */
#ifndef SKIN_REFERENCE_H
#define SKIN_REFERENCE_H

#include "limn/limn.h"

#include <math.h>
#include <string.h>

typedef double quaternion[4]; ///< x, y, z, w

typedef struct joint {
    double stretch[3][3];
    quaternion rotation; ///< unit, of either sign
    double translation[3];
} joint;

static inline void multiply(const quaternion a, const quaternion b, quaternion product) {
    const quaternion result = {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
                               a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
                               a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0],
                               a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
    memcpy(product, result, sizeof result);
}

static inline void conjugate(const quaternion q, quaternion result) {
    for (int i = 0; i < 4; i++)
        result[i] = i == 3 ? q[i] : -q[i];
}

/// q p q* for a unit quaternion.
static inline void rotate(const quaternion q, const double p[3], double out[3]) {
    quaternion point = {p[0], p[1], p[2], 0}, back;
    conjugate(q, back);
    multiply(q, point, point);
    multiply(point, back, point);
    memcpy(out, point, 3 * sizeof *out);
}

static inline void apply_stretch(const joint *j, const double p[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = j->stretch[i][0] * p[0] + j->stretch[i][1] * p[1] + j->stretch[i][2] * p[2];
}

/// Makes a joint turn and stretch around `pivot`, and then move it by `way`.
static inline void set_pivot(joint *j, const double pivot[3], const double way[3]) {
    double moved[3];
    apply_stretch(j, pivot, moved);
    rotate(j->rotation, moved, moved);
    for (int i = 0; i < 3; i++)
        j->translation[i] = pivot[i] + way[i] - moved[i];
}

static inline void joint_matrix(const joint *j, float matrix[12]) {
    for (int column = 0; column < 3; column++) {
        const double axis[3] = {column == 0, column == 1, column == 2};
        double p[3];
        apply_stretch(j, axis, p);
        rotate(j->rotation, p, p);
        for (int row = 0; row < 3; row++)
            matrix[4 * row + column] = (float)p[row];
    }
    for (int row = 0; row < 3; row++)
        matrix[4 * row + 3] = (float)j->translation[row];
}

/// Of a vector with a fourth component: 1 for a point, 0 for a normal.
static inline void blend_linear(const limn_skin *skin, const float *matrices, uint32_t point,
                                const float p[3], double fourth, double out[3]) {
    const uint32_t count = skin->influence_count;
    memset(out, 0, 3 * sizeof *out);
    for (uint32_t i = 0; i < count; i++) {
        const float *const m = matrices + 12 * (size_t)skin->joints[point * count + i];
        const double weight = (double)skin->weights[point * count + i];
        for (int row = 0; row < 3; row++)
            out[row] += weight *
                        ((double)m[4 * row] * (double)p[0] + (double)m[4 * row + 1] * (double)p[1] +
                         (double)m[4 * row + 2] * (double)p[2] + (double)m[4 * row + 3] * fourth);
    }
}

/// The same with dual quaternions.
static inline void blend_dual(const limn_skin *skin, const joint *joints, uint32_t point,
                              const float p[3], double fourth, double out[3]) {
    const uint32_t count = skin->influence_count;
    const uint16_t *const indices = skin->joints + (size_t)point * count;
    const double *const first = joints[indices[0]].rotation;
    const double from[3] = {(double)p[0], (double)p[1], (double)p[2]};
    double stretched[3] = {0};
    quaternion real = {0}, dual = {0};
    for (uint32_t i = 0; i < count; i++) {
        const joint *const j = &joints[indices[i]];
        const double weight = (double)skin->weights[point * count + i];
        const double *const q = j->rotation, *const t = j->translation;
        const double cosine = q[0] * first[0] + q[1] * first[1] + q[2] * first[2] + q[3] * first[3];
        quaternion e = {t[0] / 2, t[1] / 2, t[2] / 2, 0};
        double part[3];
        multiply(e, q, e);
        apply_stretch(j, from, part);
        for (int k = 0; k < 4; k++) {
            real[k] += (cosine < 0 ? -weight : weight) * q[k];
            dual[k] += (cosine < 0 ? -weight : weight) * e[k];
            if (k < 3) stretched[k] += weight * part[k];
        }
    }
    const double length =
        sqrt(real[0] * real[0] + real[1] * real[1] + real[2] * real[2] + real[3] * real[3]);
    quaternion back, way;
    for (int k = 0; k < 4; k++)
        real[k] /= length, dual[k] /= length;
    conjugate(real, back);
    multiply(dual, back, way);
    rotate(real, stretched, out);
    for (int k = 0; k < 3; k++)
        out[k] += 2 * fourth * way[k];
}

#endif
