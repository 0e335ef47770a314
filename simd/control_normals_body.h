/* SPDX-License-Identifier: MIT */
/* The limit normals of base vertices, a block of them at a time. */
#ifndef CONTROL_NORMALS_BODY_H
#define CONTROL_NORMALS_BODY_H

#include "formats.h"

enum { CONTROL_BLOCK = 64 };

/// Two weighted sums of the ring of a base vertex, relative to it, into place i.
static inline void sum_ring(const limni_ring *ring, const float *controls, size_t i, vectors *along,
                            vectors *across) {
    const float *const first = ring->weights, *const second = first + ring->count;
    const quad centre = quad_load_point(controls + 3 * (size_t)ring->point);
    quad a = quad_splat(0), b = quad_splat(0);
    for (uint32_t r = 0; r < ring->count; r++) {
        const size_t other = ring->points[r];
        const quad point = quad_subtract(quad_load_point(controls + 3 * other), centre);
        a = quad_add(a, quad_multiply(quad_splat(first[r]), point));
        b = quad_add(b, quad_multiply(quad_splat(second[r]), point));
    }
    _Alignas(16) float tangents[2][4];
    quad_store(tangents[0], a);
    quad_store(tangents[1], b);
    for (int axis = 0; axis < 3; axis++) {
        along->axes[axis][i] = tangents[0][axis];
        across->axes[axis][i] = tangents[1][axis];
    }
}

/// Reproducible in both families: patches of either take them for their corners.
static void find_control_normals(const limn_mesh *mesh, const float *controls, float *normals) {
    vectors along, across;
    for (uint32_t first = 0; first < mesh->normal_count; first += CONTROL_BLOCK) {
        const uint32_t left = mesh->normal_count - first;
        const uint32_t count = left < CONTROL_BLOCK ? left : CONTROL_BLOCK;
        for (int axis = 0; axis < 3; axis++) {
            lanes_store(&along.axes[axis][count], lanes_zero());
            lanes_store(&across.axes[axis][count], lanes_zero());
        }
        for (uint32_t i = 0; i < count; i++) {
            const limni_ring ring = limni_ring_of(mesh, first + i);
            sum_ring(&ring, controls, i, &along, &across);
        }
        find_normals(&across, 0, count, &along);
        for (uint32_t i = 0; i < count; i++) {
            for (size_t axis = 0; axis < 3; axis++)
                normals[3 * ((size_t)first + i) + axis] = along.axes[axis][i];
        }
    }
    lanes_end();
}

#endif
