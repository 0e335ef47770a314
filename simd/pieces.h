/* SPDX-License-Identifier: MIT */
/*
 * Sums of isolated patches. Each of the four pieces has a table of its own, for some of the patch's
 * points; what it sums is staged and then goes to the rows of the patch (runtime/domain.h). A row
 * that patches share is still the sum of its points in ascending order: pieces on both sides have
 * the same table rows there.
 */
#ifndef PIECES_H
#define PIECES_H

#include "sums.h"

/// The points of one patch in ascending order; a point's `column` is its slot.
typedef struct piece_points {
    terms relative; ///< to the origin of the mesh
    terms absolute; ///< where there are normals
    term *buffer;   ///< [as many] for the terms of a piece
    term *moved;    ///< [as many] for the same relative to some other point
} piece_points;

/// The terms of a piece, in ascending order.
static inline terms list_terms(terms points, const uint16_t *columns, uint32_t row_stride,
                               term *buffer) {
    term *end = buffer;
    LIMNI_UNROLL_TWICE
    for (const term *k = points.begin; k != points.end; k++) {
        const uint32_t column = columns[k->column];
        set_term(end, quad_load(k->point), column * row_stride);
        end += column != LIMN_FORMAT_NO_COLUMN;
    }
    return (terms){buffer, end};
}

static inline bool is_long(terms of) {
    return of.end - of.begin > LIMNI_PLAIN_TERMS;
}

static inline void sum_piece_positions(const limni_piece *piece, const piece_points *points,
                                       const float *origin, uint32_t level, vectors *staged) {
    const limni_segment segment = {.row = piece->first_place,
                                   .count = piece->positions->counts[level]};
    if (segment.count == 0) return;
    const patch p = {.table = piece->table,
                     .origin = origin,
                     .all = list_terms(points->relative, piece->columns,
                                       piece->positions->row_stride, points->buffer)};
    if (is_long(p.all)) {
        sum_long_rows(&p, &segment, staged);
    } else {
        sum_rows(&p, &segment, staged);
    }
}

/// Terms relative to `origin`.
static inline terms move_terms(terms absolute, const float *origin, term *buffer) {
    term *end = buffer;
    for (const term *k = absolute.begin; k != absolute.end; k++)
        set_term(end++, quad_subtract(quad_load_point(k->point), quad_load_point(origin)),
                 k->column);
    return (terms){buffer, end};
}

/// Both tangents of places [first, end) of a piece, relative to `origin`.
///
/// absolute  terms of the piece
/// moved     [as many]
static inline void sum_piece_tangents(const limni_piece *piece, terms absolute, term *moved,
                                      const float *origin, uint32_t first, uint32_t end,
                                      vectors *const staged[2]) {
    static const float nowhere[3] = {0};
    if (first >= end) return;
    const limni_segment segment = {.table_row = (uint16_t)first,
                                   .row = (uint16_t)(piece->first_place + first),
                                   .count = (uint16_t)(end - first)};
    patch p = {.table = piece->table + piece->table_stride, .origin = nowhere, .all = absolute};
    if (is_long(absolute)) {
        p.all = move_terms(absolute, origin, moved);
        sum_long_rows(&p, &segment, staged[0]);
        p.table += piece->table_stride;
        sum_long_rows(&p, &segment, staged[1]);
    } else {
        const lanes from[3] = {lanes_splat(origin[0]), lanes_splat(origin[1]),
                               lanes_splat(origin[2])};
        sum_tangent_rows(&p, piece->table_stride, from, &segment, staged);
    }
}

/// Copies of fewer than four rows also take what an earlier patch, or nothing yet, has left behind
/// them: bits that go to rows that the next copy writes, or behind the last row, where they are
/// computed with but never stored.
static inline void place_rows(const limni_piece_copy *copies, size_t count, const vectors *staged,
                              vectors *rows) {
    for (size_t c = 0; c < count; c++)
        copy_four_rows(staged, copies[c].from, rows, copies[c].to);
}

#endif
