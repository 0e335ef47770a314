/* SPDX-License-Identifier: MIT */
/* Affine maps in double precision, as joints and nodes place what hangs on them. */
#ifndef LIMNI_TRANSFORM_H
#define LIMNI_TRANSFORM_H

#include <math.h>

/// x' = rows[0][0] x + rows[0][1] y + rows[0][2] z + rows[0][3].
typedef struct limni_transform {
    double rows[3][4];
} limni_transform;

/// Makes a unit quaternion x, y, z, w; of 0 the one that turns nothing.
static inline void limni_quaternion_normalise(double q[4]) {
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        q[i] = length > 0 ? q[i] / length : i == 3;
}

/// Scales, turns and moves, in this order.
///
/// rotation  of any length
static inline limni_transform
limni_transform_make(const double translation[3], const double rotation[4], const double scale[3]) {
    double q[4] = {rotation[0], rotation[1], rotation[2], rotation[3]};
    limni_quaternion_normalise(q);
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double turned[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
        {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
        {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    limni_transform t;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            t.rows[row][column] = turned[row][column] * scale[column];
        t.rows[row][3] = translation[row];
    }
    return t;
}

/// First b, then a.
static inline limni_transform limni_transform_multiply(const limni_transform *a,
                                                       const limni_transform *b) {
    limni_transform t;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            t.rows[row][column] =
                a->rows[row][0] * b->rows[0][column] + a->rows[row][1] * b->rows[1][column] +
                a->rows[row][2] * b->rows[2][column] + (column == 3 ? a->rows[row][3] : 0);
    }
    return t;
}

#endif
