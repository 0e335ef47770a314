/* SPDX-License-Identifier: MIT */
/* The vertices of a base mesh, a block of them at a time in the place of the rows of a patch. */
#ifndef BASE_BODY_H
#define BASE_BODY_H

#include "evaluate_body.h"

enum { BASE_BLOCK = 256 };
LIMN_STATIC_ASSERT(BASE_BLOCK + LANES_WIDTH <= LIMNI_PADDED_ROWS_MAX,
                   "a block is no more than the rows of a patch");

/// The same sum as that of the corner of a patch, whose table has zeros besides.
static inline void sum_base_vertex(const limn_base *base, const limn_base_vertex *vertex,
                                   const float *controls, quad origin, size_t row, vectors *out) {
    const limn_file_term *const at = base->terms + vertex->first_term;
    const limn_file_term *const end = at + vertex->term_count;
    const quad sum = vertex->term_count > LIMNI_PLAIN_TERMS
                         ? sum_long_stencil(at, end, controls, origin)
                         : sum_stencil(at, end, controls, origin);
    _Alignas(16) float stored[4];
    quad_store(stored, quad_add(sum, origin));
    for (int axis = 0; axis < 3; axis++)
        out->axes[axis][row] = stored[axis];
}

/// Reproducible in both families, as the points that a mesh is refined to.
static void evaluate_base(const limn_base *base, const limni_points *from, uint32_t begin,
                          uint32_t end, const limni_target *target) {
    const quad origin = quad_load_point(from->origin);
    parts to;
    scratch rows;
    arrange_parts(target, &to);
    for (uint32_t first = begin, count; first < end; first += count) {
        count = end - first < BASE_BLOCK ? end - first : BASE_BLOCK;
        const limn_base_vertex *const vertices = base->vertices + first;
        for (size_t i = 0; i < count; i++)
            sum_base_vertex(base, &vertices[i], from->controls, origin, i, &rows.positions);
        for (size_t i = 0; i < count && from->normals; i++) {
            const float *const normal = from->normals + 3 * (size_t)vertices[i].normal;
            for (size_t axis = 0; axis < 3; axis++)
                rows.along.axes[axis][i] = normal[axis];
        }
        clear_rows(&rows, count);
        if (target->colours) light_rows(target, count, count, &rows);
        to.first = first;
        pack_and_store(target, &to, count, &rows);
    }
    if (target->streaming) lanes_stream_end();
    lanes_end();
}

#endif
