/* SPDX-License-Identifier: MIT */
/* The tables of the domains, and how the rows of a domain lie in the columns of a stencil table. */
#ifndef LIMNI_DOMAIN_H
#define LIMNI_DOMAIN_H

#include "limn/limn.h"

enum { LIMNI_SEGMENT_MAX = 2, LIMNI_PAIR_BLOCK_MAX = 6 };

/// Consecutive rows of a column, and where in the patch their sums go. Sums of padding go there,
/// too, and are overwritten by pairs.
typedef struct limni_segment {
    uint16_t table_row; ///< first of the column, a multiple of 8
    uint16_t row;       ///< first of the patch
    uint16_t count;     ///< a multiple of 8
} limni_segment;

/// How a table is laid out. What a level reads is a prefix of each column.
///
/// Where a class is its own mirror image, most rows inside the patch are pairs: a row and its image
/// follow from one sum of even terms and one of odd ones (simd/sums.h).
typedef struct limni_layout {
    limni_segment segments[LIMN_LEVEL_COUNT][LIMNI_SEGMENT_MAX]; ///< count 0: none
    uint16_t pair_counts[LIMN_LEVEL_COUNT];                      ///< multiples of 8
    uint16_t pair_table_row;                                     ///< the first of the column
    uint16_t pair_rows[LIMNI_PAIR_BLOCK_MAX];   ///< where each block of 8 goes, one side,
    uint16_t mirror_rows[LIMNI_PAIR_BLOCK_MAX]; ///< and the other
    uint16_t row_stride;                        ///< rows of a column
} limni_layout;

extern const limn_domain limni_domain_triangle;
extern const limni_layout limni_layout_triangle;
extern const limni_layout limni_layout_triangle_mirrored;

/// Along an edge of that level, the place that a row at grid step `t` moves to: the nearest that
/// the edge keeps; of two as near, the one towards the start.
static inline uint32_t limni_kept_place(uint32_t t, uint32_t edge_level) {
    const uint32_t step = LIMN_GRID_SIZE >> edge_level, behind = t % step;
    return 2 * behind <= step ? t - behind : t - behind + step;
}

/// The layout of the tables of a class; `pair_count` is that of its record.
const limni_layout *limni_layout_get(limn_domain_kind kind, uint32_t pair_count);

#endif
