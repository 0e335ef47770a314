/* SPDX-License-Identifier: MIT */
/* The oracle's answer for patches of the quad domain at level 4, and comparing it. */
#ifndef SURFACE_H
#define SURFACE_H

#include "../check.h"
#include "opensubdiv.h"

#include "limn/limn.h"

#include <math.h>
#include <stdlib.h>

typedef double point[3];

enum { ROW_COUNT = 289 };

static inline const limn_domain *domain(void) {
    return limn_domain_get(LIMN_DOMAIN_QUAD);
}

static inline void check_point(const point a, const point b, double tolerance) {
    for (int axis = 0; axis < 3; axis++)
        CHECK_NEAR(a[axis], b[axis], tolerance);
}

/// Limit positions, and tangents, of all patches at level 4; `limit` is NULL after a failure.
typedef struct surface {
    uint32_t patch_count;
    point *limit;         ///< [patch_count][289]
    point (*tangents)[2]; ///< [patch_count][289]
    char error[256];
} surface;

static inline surface evaluate(const limni_opensubdiv_mesh *mesh) {
    surface made = {.patch_count = limni_opensubdiv_patch_count(mesh)};
    const size_t count = (size_t)made.patch_count * ROW_COUNT;
    made.limit = malloc(count * sizeof *made.limit);
    made.tangents = malloc(count * sizeof *made.tangents);
    if (!made.limit || !made.tangents) abort();
    if (limni_opensubdiv_limit(mesh, made.limit, made.tangents, made.error, sizeof made.error))
        return made;
    free(made.limit);
    free(made.tangents);
    made.limit = NULL;
    return made;
}

static inline surface must_evaluate(const limni_opensubdiv_mesh *mesh) {
    const surface made = evaluate(mesh);
    if (!CHECK(made.limit)) {
        fprintf(stderr, "    %s\n", made.error);
        exit(check_report());
    }
    return made;
}

static inline void release(surface *made) {
    if (!made->limit) return;
    free(made->limit);
    free(made->tangents);
}

/// How far apart two planes are: the sine of the angle between their normals.
static inline double plane_difference(const point a[2], const point b[2]) {
    point normals[2];
    for (int which = 0; which < 2; which++) {
        const point *const t = which ? b : a;
        double squares = 0;
        for (int axis = 0; axis < 3; axis++) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            normals[which][axis] = t[0][u] * t[1][v] - t[0][v] * t[1][u];
            squares += normals[which][axis] * normals[which][axis];
        }
        for (int axis = 0; axis < 3; axis++)
            normals[which][axis] /= sqrt(squares);
    }
    double squares = 0;
    for (int axis = 0; axis < 3; axis++)
        squares += (normals[0][axis] - normals[1][axis]) * (normals[0][axis] - normals[1][axis]);
    return sqrt(squares);
}

#endif
