/* SPDX-License-Identifier: MIT */
/* The tables of the domains, and how the rows of a domain lie in the columns of a stencil table. */
#ifndef LIMNI_DOMAIN_H
#define LIMNI_DOMAIN_H

#include "limn/format.h"
#include "limn/limn.h"

enum {
    LIMNI_ROWS_MAX = 289, ///< of the largest domain
    LIMNI_SEGMENT_MAX = 4,
    LIMNI_PAIR_BLOCK_MAX = 6,
    LIMNI_EDGE_ROWS = 16, ///< a tangent table's places for one edge
    LIMNI_NO_ROW = 0xffff
};

LIMN_STATIC_ASSERT(LIMN_FORMAT_QUAD == (unsigned)LIMN_DOMAIN_QUAD, "domains");

/// Consecutive places of a column, and where in the patch their sums go. Sums of padding go there,
/// too, and are overwritten by pairs or by edges.
typedef struct limni_segment {
    uint16_t table_row; ///< first place of the column, a multiple of 8
    uint16_t row;       ///< first of the patch
    uint16_t count;     ///< a multiple of 8
} limni_segment;

/// How a table is laid out. What a level reads of a segment, of the pairs and of an edge is a
/// prefix.
///
/// Where a class is its own mirror image, most rows inside the patch are pairs: a row and its image
/// follow from one sum of even terms and one of odd ones (simd/sums.h). Tangents have the rows of
/// each edge apart, because they are summed relative to a point of the edge. Quads have no pairs.
typedef struct limni_layout {
    uint16_t row_stride;  ///< places of a column
    const uint16_t *rows; ///< [row_stride] the row at each place; of a pair, that on one side;
                          ///< LIMNI_NO_ROW: padding
    limni_segment segments[LIMN_LEVEL_COUNT][LIMNI_SEGMENT_MAX]; ///< count 0: none
    uint16_t pair_counts[LIMN_LEVEL_COUNT];                      ///< multiples of 8
    uint16_t pair_table_row;                                     ///< their first place
    uint16_t pair_rows[LIMNI_PAIR_BLOCK_MAX];   ///< where each block of 8 goes, one side,
    uint16_t mirror_rows[LIMNI_PAIR_BLOCK_MAX]; ///< and the other
    /// Of tangents: rows of edge e, from place e * LIMNI_EDGE_ROWS on.
    uint16_t edge_counts[LIMN_LEVEL_COUNT];
    uint16_t inside_level; ///< the first whose rows inside are not among those of the edges
} limni_layout;

/// An isolated patch is evaluated in four pieces, the faces that one level of subdivision makes of
/// it: one at each corner, and of a triangle the one in the middle. Their rows are those of the
/// domain down to level 3. Of a triangle, rows between two pieces belong to the middle one; of a
/// quad, to the piece at whose corner the edge starts from which they lead to the middle of the
/// patch. All four have that middle, and the first gives it.
enum { LIMNI_PIECE_PLACES = 320 }; ///< of all pieces of a patch, at most

typedef enum limni_piece_kind {
    LIMNI_PIECE_CORNER, ///< its corner 0 is the patch's, its first and last edges halves of edges
    LIMNI_PIECE_MIDDLE  ///< its corner k is the middle of edge k of the patch
} limni_piece_kind;

/// How the table of a piece is laid out.
typedef struct limni_piece_layout {
    uint16_t row_stride;               ///< places of a column, a multiple of 8
    const uint16_t *rows;              ///< [row_stride] the row of the piece at each place;
                                       ///< LIMNI_NO_ROW: padding
    uint16_t counts[LIMN_LEVEL_COUNT]; ///< places that a level of the patch reads: whole blocks
} limni_piece_layout;

/// Up to four consecutive rows.
typedef struct limni_piece_copy {
    uint16_t from; ///< among the places of all pieces, one behind the other
    uint16_t to;   ///< row of the patch
} limni_piece_copy;

/// Sums of pieces go to places of their own, and from there to the rows of the patch. Copies are in
/// the order of the rows, and those of a level are a prefix: each may write four rows, of which the
/// last are overwritten. In a corner's tables of tangents, the first block has the rows of the half
/// edge that starts at the corner, its far end included, and the second those of the other one; of
/// a quad, in front of them, the middle of the patch.
typedef struct limni_pieces {
    limni_piece_layout positions[2], tangents[2]; ///< by limni_piece_kind
    const limni_piece_copy *position_copies, *normal_copies;
    uint16_t position_copy_counts[LIMN_LEVEL_COUNT], normal_copy_counts[LIMN_LEVEL_COUNT];
} limni_pieces;

static inline limni_piece_kind limni_piece_kind_of(const limn_domain *domain, uint32_t piece) {
    return piece < domain->corner_count ? LIMNI_PIECE_CORNER : LIMNI_PIECE_MIDDLE;
}

/// Grid coordinates of all rows, from 0 to 1, as vectors are computed with.
typedef struct limni_grid {
    const float *u, *v; ///< [limni_padded()]: i / 16 and j / 16
} limni_grid;

const limni_grid *limni_grid_get(limn_domain_kind kind);

extern const limni_grid limni_grid_triangle, limni_grid_quad;

extern const limn_domain limni_domain_triangle, limni_domain_quad;
extern const limni_pieces limni_pieces_triangle, limni_pieces_quad;

const limni_pieces *limni_pieces_get(limn_domain_kind kind);

/// The layout of a class's table of positions, or of each table of tangents; `pair_count` is that
/// of its record.
const limni_layout *limni_layout_get(limn_domain_kind kind, bool tangents, uint32_t pair_count);

/// What limni_layout_get() chooses from: without pairs, and with.
extern const limni_layout limni_positions_triangle[2], limni_tangents_triangle[2];
extern const limni_layout limni_positions_quad[1], limni_tangents_quad[1];

static inline size_t limni_padded(size_t row_count) {
    return (row_count + LIMN_FORMAT_ROW_BLOCK - 1) / LIMN_FORMAT_ROW_BLOCK * LIMN_FORMAT_ROW_BLOCK;
}

/// The first row inside that a level adds.
static inline uint32_t limni_first_inside(const limn_domain *domain, uint32_t level) {
    return domain->row_counts[level - 1] + domain->corner_count * (1u << (level - 1));
}

/// Along an edge, the place of the parent of the lower level of the row at grid step `t`; of two
/// corners, the start.
static inline uint32_t limni_elder_place(uint32_t t) {
    const uint32_t step = t & (0u - t);
    return (t - step) % (4 * step) == 0 ? t - step : t + step;
}

/// Along an edge of that level, the place that a row at grid step `t` is drawn at: of the rows that
/// the edge has, the nearest of its elders. As the edge loses a level, what was drawn at a row that
/// goes is then drawn at that row's elder, to which it has moved by then (simd/morph.h).
static inline uint32_t limni_kept_place(uint32_t t, uint32_t edge_level) {
    while (t % (LIMN_GRID_SIZE >> edge_level))
        t = limni_elder_place(t);
    return t;
}

#endif
