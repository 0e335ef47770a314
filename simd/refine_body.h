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

/// Reproducible in both families, as patches of either take the same points.
static void refine_mesh(const limn_mesh *mesh, float *controls) {
    const uint32_t count = mesh->point_count - mesh->control_count;
    const limn_file_term *at = mesh->terms;
    float *dst = controls + 3 * (size_t)mesh->control_count;
    for (uint32_t point = 0; point < count; point++, dst += 3) {
        const limn_file_term *const end = mesh->terms + mesh->stencils[point + 1];
        const float *const first = at < end ? controls + 3 * (size_t)at->point : mesh->origin;
        const quad origin = quad_load_point(first);
        quad sum = quad_splat(0);
        for (; at < end; at++) {
            const quad place = quad_load_point(controls + 3 * (size_t)at->point);
            const quad weighted =
                quad_multiply(quad_splat(at->weight), quad_subtract(place, origin));
            sum = quad_add(sum, weighted);
        }
        float stored[4];
        quad_store(stored, quad_add(sum, origin));
        memcpy(dst, stored, 3 * sizeof(float));
    }
    lanes_end();
}

#endif
