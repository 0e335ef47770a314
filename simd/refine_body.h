/* SPDX-License-Identifier: MIT */
/*
 * The points of further levels of subdivision, one by one: they belong to no patch, and may be made
 * of those before them. Sums are relative to a point of their own, so that what is lost does not
 * grow with the mesh.
 */
#ifndef REFINE_BODY_H
#define REFINE_BODY_H

#include "sums.h"

#include <string.h>

/// A point relative to the origin, times its weight.
static inline quad weigh(const limn_file_term *at, const float *controls, quad origin) {
    const quad place = quad_load_point(controls + 3 * (size_t)at->point);
    return quad_multiply(quad_splat(at->weight), quad_subtract(place, origin));
}

static inline quad sum_stencil(const limn_file_term *at, const limn_file_term *end,
                               const float *controls, quad origin) {
    quad sum = quad_splat(0);
    for (; at < end; at++)
        sum = quad_add(sum, weigh(at, controls, origin));
    return sum;
}

/// With Kahan's compensation, as long rows have it (simd/sums.h): the corners of a large polygon
/// have equal weights, whose roundings would all go the same way.
static inline quad sum_long_stencil(const limn_file_term *at, const limn_file_term *end,
                                    const float *controls, quad origin) {
    quad sum = quad_splat(0), lost = quad_splat(0);
    for (; at < end; at++) {
        const quad added = quad_subtract(weigh(at, controls, origin), lost);
        const quad next = quad_add(sum, added);
        lost = quad_subtract(quad_subtract(next, sum), added);
        sum = next;
    }
    return sum;
}

/// Reproducible in both families, as patches of either take the same points.
static void refine_mesh(const limn_mesh *mesh, float *controls) {
    const uint32_t count = mesh->point_count - mesh->control_count;
    const limn_file_term *at = mesh->terms;
    float *dst = controls + 3 * (size_t)mesh->control_count;
    for (uint32_t point = 0; point < count; point++, dst += 3) {
        const limn_file_term *const end = mesh->terms + mesh->stencils[point + 1];
        const float *const first = at < end ? controls + 3 * (size_t)at->point : mesh->origin;
        const quad origin = quad_load_point(first);
        const quad sum = end - at > LIMNI_PLAIN_TERMS ? sum_long_stencil(at, end, controls, origin)
                                                      : sum_stencil(at, end, controls, origin);
        float stored[4];
        quad_store(stored, quad_add(sum, origin));
        memcpy(dst, stored, 3 * sizeof(float));
        at = end;
    }
    lanes_end();
}

#endif
