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
    term *buffer;   ///< [as many, and one] for the terms of a piece
} piece_points;

/// The terms of a piece, in ascending order. Returns how many.
static inline size_t list_terms(const piece_points *points, const uint16_t *columns,
                                uint32_t row_stride) {
    size_t count = 0;
    LIMNI_UNROLL_TWICE
    for (const term *k = points->relative.begin; k != points->relative.end; k++) {
        const uint32_t column = columns[k->column];
        term *const dst = &points->buffer[count];
        quad_store(dst, quad_load(k->point));
        dst->column = column * row_stride;
        count += column != LIMN_FORMAT_NO_COLUMN;
    }
    return count;
}

/// The same relative to some other point.
static inline size_t list_terms_from(const piece_points *points, const uint16_t *columns,
                                     uint32_t row_stride, quad origin) {
    size_t count = 0;
    for (const term *k = points->absolute.begin; k != points->absolute.end; k++) {
        const uint32_t column = columns[k->column];
        set_term(&points->buffer[count], quad_subtract(quad_load_point(k->point), origin),
                 column * row_stride);
        count += column != LIMN_FORMAT_NO_COLUMN;
    }
    return count;
}

static inline void sum_piece_positions(const limni_piece *piece, const piece_points *points,
                                       const float *origin, uint32_t level, vectors *staged) {
    const limni_segment segment = {.row = piece->first_place,
                                   .count = piece->positions->counts[level]};
    if (segment.count == 0) return;
    const size_t count = list_terms(points, piece->columns, piece->positions->row_stride);
    const patch p = {
        .table = piece->table, .origin = origin, .all = {points->buffer, points->buffer + count}};
    if (count > LIMNI_PLAIN_TERMS) {
        sum_long_rows(&p, &segment, staged);
    } else {
        sum_rows(&p, &segment, staged);
    }
}

/// Both tangents of places [first, end) of a piece, relative to `origin`.
static inline void sum_piece_tangents(const limni_piece *piece, const piece_points *points,
                                      const float *origin, uint32_t first, uint32_t end,
                                      vectors *const staged[2]) {
    static const float nowhere[3] = {0};
    if (first >= end) return;
    const size_t count = list_terms_from(points, piece->columns, piece->tangents->row_stride,
                                         quad_load_point(origin));
    const limni_segment segment = {.table_row = (uint16_t)first,
                                   .row = (uint16_t)(piece->first_place + first),
                                   .count = (uint16_t)(end - first)};
    patch p = {.table = piece->table + piece->table_stride,
               .origin = nowhere,
               .all = {points->buffer, points->buffer + count}};
    if (count > LIMNI_PLAIN_TERMS) {
        sum_long_rows(&p, &segment, staged[0]);
        p.table += piece->table_stride;
        sum_long_rows(&p, &segment, staged[1]);
    } else {
        const lanes none[3] = {lanes_zero(), lanes_zero(), lanes_zero()};
        sum_tangent_rows(&p, piece->table_stride, none, &segment, staged);
    }
}

static inline void place_rows(const limni_piece_copy *copies, size_t count, const vectors *staged,
                              vectors *rows) {
    for (size_t c = 0; c < count; c++)
        copy_four_rows(staged, copies[c].from, rows, copies[c].to);
}

#endif
