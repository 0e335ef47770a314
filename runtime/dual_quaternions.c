/* SPDX-License-Identifier: MIT */
/*
 * Matrices of joints as a stretch and a rigid motion. In doubles, with nothing but exactly rounded
 * operations, so that every host gets the same bits.
 */
#include "require.h"
#include "rounding.h"

#include "limn/limn.h"

#include <math.h>

typedef struct matrix {
    double m[3][3];
} matrix;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double sum_squares(const matrix *a) {
    return dot(a->m[0], a->m[0]) + dot(a->m[1], a->m[1]) + dot(a->m[2], a->m[2]);
}

static matrix find_cofactors(const matrix *a) {
    matrix cofactors;
    for (int i = 0; i < 3; i++) {
        const double *const next = a->m[(i + 1) % 3], *const last = a->m[(i + 2) % 3];
        for (int j = 0; j < 3; j++) {
            const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            cofactors.m[i][j] = next[j1] * last[j2] - next[j2] * last[j1];
        }
    }
    return cofactors;
}

/// a x + b y
static matrix combine(double x, const matrix *a, double y, const matrix *b) {
    matrix sum;
    for (int k = 0; k < 9; k++)
        sum.m[k / 3][k % 3] = x * a->m[k / 3][k % 3] + y * b->m[k / 3][k % 3];
    return sum;
}

/// The rotation nearest to `a`: the average with the inverse transpose, again and again, both
/// scaled to one size (Higham, "Computing the polar decomposition - with applications", 1986). If
/// `a` mirrors, that of -a. Returns false where there is no volume to speak of.
static bool find_rotation(const matrix *a, matrix *rotation) {
    enum { STEPS = 20 };
    const double least_volume = 1e-12, least_change = 1e-12; // the error is then less
    matrix cofactors = find_cofactors(a);
    double volume = dot(a->m[0], cofactors.m[0]);
    const double squares = sum_squares(a);
    if (!(fabs(volume) > least_volume * squares * sqrt(squares))) return false;
    *rotation = combine(volume < 0 ? -1 : 1, a, 0, a);
    for (int step = 0; step < STEPS; step++) {
        cofactors = find_cofactors(rotation);
        volume = dot(rotation->m[0], cofactors.m[0]);
        const double scale = sqrt(sqrt(sum_squares(&cofactors) / sum_squares(rotation)) / volume);
        const matrix next = combine(0.5 * scale, rotation, 0.5 / (scale * volume), &cofactors);
        const matrix change = combine(1, &next, -1, rotation);
        *rotation = next;
        if (sum_squares(&change) < least_change) break;
    }
    return true;
}

/// From the largest of 4 x², 4 y², 4 z² and 4 w² (Shepperd, "Quaternion from rotation matrix",
/// 1978), of any length.
static void find_quaternion(const matrix *rotation, double q[4]) {
    const double(*const r)[3] = rotation->m;
    const double trace = r[0][0] + r[1][1] + r[2][2];
    const double turns[3] = {r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]};
    int largest = 3;
    for (int axis = 0; axis < 3; axis++) {
        if (r[axis][axis] > (largest == 3 ? trace : r[largest][largest])) largest = axis;
    }
    for (int axis = 0; axis < 3; axis++)
        q[axis] = largest == 3 ? turns[axis] : r[axis][largest] + r[largest][axis];
    q[3] = largest == 3 ? 1 + trace : turns[largest];
    if (largest < 3) q[largest] = 1 + 2 * r[largest][largest] - trace;
}

/// The rotation by a quaternion of any length but 0.
static matrix find_matrix(const float quaternion[4]) {
    const double x = (double)quaternion[0], y = (double)quaternion[1];
    const double z = (double)quaternion[2], w = (double)quaternion[3];
    const double k = 2 / (x * x + y * y + z * z + w * w);
    return (matrix){{{1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)},
                     {k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)},
                     {k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)}}};
}

static void set_real(const matrix *a, float real[4]) {
    matrix rotation;
    double q[4] = {0, 0, 0, 1};
    if (find_rotation(a, &rotation)) find_quaternion(&rotation, q);
    const double length = sqrt(dot(q, q) + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        real[i] = (float)(q[i] / length);
}

/// Half of the translation, as a quaternion without real part, times the rotation.
static void set_dual(const float *rows, const float q[4], float dual[4]) {
    const double x = 0.5 * (double)rows[3], y = 0.5 * (double)rows[7];
    const double z = 0.5 * (double)rows[11], w = (double)q[3];
    const double a = (double)q[0], b = (double)q[1], c = (double)q[2];
    dual[0] = (float)(w * x + (y * c - z * b));
    dual[1] = (float)(w * y + (z * a - x * c));
    dual[2] = (float)(w * z + (x * b - y * a));
    dual[3] = (float)-(x * a + y * b + z * c);
}

/// What the rotation, as it was rounded, leaves of the matrix: nothing of it is lost.
static void set_stretch(const matrix *a, const float real[4], float stretch[3][4]) {
    const matrix rotation = find_matrix(real);
    const double(*const r)[3] = rotation.m;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            stretch[i][j] =
                (float)(r[0][i] * a->m[0][j] + r[1][i] * a->m[1][j] + r[2][i] * a->m[2][j]);
        stretch[i][3] = 0;
    }
}

void limn_dual_quaternions_make(const float *matrices, uint32_t joint_count,
                                limn_dual_quaternion *quaternions) {
    LIMNI_REQUIRE(matrices && quaternions, );
    for (uint32_t joint = 0; joint < joint_count; joint++) {
        const float *const rows = matrices + 12 * (size_t)joint;
        limn_dual_quaternion *const to = &quaternions[joint];
        matrix a;
        for (int k = 0; k < 9; k++)
            a.m[k / 3][k % 3] = (double)rows[4 * (k / 3) + k % 3];
        set_real(&a, to->real);
        set_dual(rows, to->real, to->dual);
        set_stretch(&a, to->real, to->stretch);
    }
}
