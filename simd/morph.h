/* SPDX-License-Identifier: MIT */
/*
 * Geo-morphing (Brickhill): a row that is new at its level moves from the middle of its parents to
 * its place as the level goes up. Rows on edges follow the level of the edge, so that both sides
 * agree; sums of two parents do not depend on their order.
 */
#ifndef MORPH_H
#define MORPH_H

#include "formats.h"

#include <string.h>

/// (1 - weight) (a + b) / 2 + weight v, for each axis.
static inline void morph_row(vectors *rows, const uint16_t parents[2], uint32_t row, float weight) {
    for (int axis = 0; axis < 3; axis++) {
        float *const values = rows->axes[axis];
        const float middle = (values[parents[0]] + values[parents[1]]) * 0.5f;
        values[row] = (1 - weight) * middle + weight * values[row];
    }
}

/// The same, and of unit length again. Written for one row: rows that are not new must keep their
/// bits.
static inline void morph_normal(vectors *rows, const uint16_t parents[2], uint32_t row,
                                float weight) {
    morph_row(rows, parents, row, weight);
    const float x = rows->axes[0][row], y = rows->axes[1][row], z = rows->axes[2][row];
    const float square = x * x + y * y + z * z, half = square * 0.5f;
    if (!(square > LEAST_SQUARE)) return; // opposite normals: any direction is as good
    uint32_t bits;
    float root;
    memcpy(&bits, &square, sizeof bits);
    bits = INVERSE_ROOT_BITS - (bits >> 1);
    memcpy(&root, &bits, sizeof root);
    for (int step = 0; step < INVERSE_ROOT_STEPS; step++)
        root = root * (1.5f - half * (root * root));
    for (int axis = 0; axis < 3; axis++)
        rows->axes[axis][row] = rows->axes[axis][row] * root + 0.0f;
}

static inline void move_row(vectors *rows, bool normals, const uint16_t parents[2], uint32_t row,
                            float weight) {
    if (normals) {
        morph_normal(rows, parents, row, weight);
    } else {
        morph_row(rows, parents, row, weight);
    }
}

/// The rows of one edge: new ones move, and those that the edge does not have go to where the
/// template moves them, for the sake of their children inside.
static inline void morph_edge(const limn_domain *domain, uint32_t edge, uint32_t level,
                              uint32_t edge_level, float weight, bool normals, vectors *rows) {
    const uint16_t *const along = domain->edge_rows[edge];
    const uint32_t step = LIMN_GRID_SIZE >> edge_level, finest = LIMN_GRID_SIZE >> level;
    for (uint32_t t = step; t < LIMN_GRID_SIZE && edge_level > 0; t += 2 * step)
        move_row(rows, normals, (const uint16_t[]){along[t - step], along[t + step]}, along[t],
                 weight);
    for (uint32_t t = finest; t < LIMN_GRID_SIZE; t += finest) {
        if (t % step) copy_row(rows, along[limni_kept_place(t, edge_level)], along[t]);
    }
}

/// Positions or normals of a patch, as its plan wants them.
static inline void morph_patch(const limn_domain *domain, const limn_plan_patch *item, bool normals,
                               vectors *rows) {
    const uint32_t level = item->level;
    if (level == 0) return;
    for (uint32_t edge = 0; edge < domain->corner_count; edge++)
        morph_edge(domain, edge, level, item->edge_levels[edge], item->edge_morphs[edge], normals,
                   rows);
    if (item->morph == 1) return;
    for (uint32_t row = limni_first_inside(domain, level); row < domain->row_counts[level]; row++)
        move_row(rows, normals, domain->rows[row].parents, row, item->morph);
}

#endif
