/* SPDX-License-Identifier: MIT */
/*
 * Geo-morphing (Brickhill): a row that is new at its level moves from the middle of its parents to
 * its place as the level goes up. Rows on edges follow the level of the edge, so that both sides
 * agree; sums of two parents do not depend on their order.
 *
 * From level 2 on, a row on an edge comes from one parent, its elder, not from the middle of both:
 * rows inside of a finer patch are sewn to it, and if it appeared in the middle, they would jump
 * there from the elder. The row of level 1 has no elder that both patches could agree on.
 */
#ifndef MORPH_H
#define MORPH_H

#include "formats.h"

#include <string.h>

/// (1 - weight) (a + b) / 2 + weight v, for each axis.
static inline void morph_row(vectors *rows, const uint16_t sources[2], uint32_t row, float weight) {
    for (int axis = 0; axis < 3; axis++) {
        float *const values = rows->axes[axis];
        const float middle = (values[sources[0]] + values[sources[1]]) * 0.5f;
        values[row] = (1 - weight) * middle + weight * values[row];
    }
}

/// The same, and of unit length again. Written for one row: rows that are not new must keep their
/// bits.
static inline void morph_normal(vectors *rows, const uint16_t sources[2], uint32_t row,
                                float weight) {
    morph_row(rows, sources, row, weight);
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

static inline void move_row(vectors *rows, bool normals, const uint16_t sources[2], uint32_t row,
                            float weight) {
    if (normals) {
        morph_normal(rows, sources, row, weight);
    } else {
        morph_row(rows, sources, row, weight);
    }
}

/// The rows of an edge that is coarser than its patch: those that are new at its level move. One by
/// one: they are few, and as vectors they would wait for what was gathered for them (a tenth of a
/// frame of mean level 2).
static inline void morph_edge(const limn_row *of, const uint16_t *along, uint32_t edge_level,
                              float weight, bool normals, vectors *rows) {
    const uint32_t step = LIMN_GRID_SIZE >> edge_level;
    if (edge_level == 0 || weight == 1) return;
    for (uint32_t t = step; t < LIMN_GRID_SIZE; t += 2 * step)
        move_row(rows, normals, of[along[t]].sources, along[t], weight);
}

/// Those that it does not have, though the patch has them below its own level, go to where the
/// template moves them, for the sake of their children inside.
static inline void close_edge(const uint16_t *along, uint32_t edge_level, uint32_t level,
                              vectors *rows) {
    const uint32_t step = LIMN_GRID_SIZE >> edge_level, coarse = 2u * LIMN_GRID_SIZE >> level;
    for (uint32_t t = coarse; t < LIMN_GRID_SIZE; t += coarse) {
        if (t % step) copy_row(rows, along[limni_kept_place(t, edge_level)], along[t]);
    }
}

/// Stands for the weight of rows that keep all their bits.
#define KEPT 2.0f

static inline void fill_weights(float *weights, size_t row, size_t count, float weight) {
    const lanes filled = lanes_splat(weight == 1 ? KEPT : weight);
    for (size_t at = 0; at < count; at += LANES_WIDTH)
        lanes_store(weights + row + at, filled);
}

/// The weights of rows from `begin` on, of which those move that are new at the level of the patch.
/// By ascending rows: each store goes on to the end of a vector. Returns whether any row moves.
static inline bool set_weights(const limn_domain *domain, const limn_plan_patch *item, size_t begin,
                               float *weights) {
    const uint32_t level = item->level;
    const size_t new_count = (size_t)1 << (level - 1), inside = limni_first_inside(domain, level);
    size_t row = domain->row_counts[level - 1];
    bool moves = item->morph != 1;
    fill_weights(weights, begin, row - begin, 1);
    for (uint32_t edge = 0; edge < domain->corner_count; edge++, row += new_count) {
        const float weight = item->edge_levels[edge] < level ? 1 : item->edge_morphs[edge];
        fill_weights(weights, row, new_count, weight);
        moves |= weight != 1;
    }
    fill_weights(weights, inside, domain->row_counts[level] - inside, item->morph);
    return moves;
}

/// The sums of the two sources of rows [row, end).
static inline void add_sources(const limn_domain *domain, const vectors *rows, size_t row,
                               size_t end, vectors *sums) {
    const limn_row *const of = domain->rows;
    LIMNI_UNROLL_TWICE
    for (; row < end; row++) {
        const size_t a = of[row].sources[0], b = of[row].sources[1];
        sums->axes[0][row] = rows->axes[0][a] + rows->axes[0][b];
        sums->axes[1][row] = rows->axes[1][a] + rows->axes[1][b];
        sums->axes[2][row] = rows->axes[2][a] + rows->axes[2][b];
    }
}

/// morph_row() for the rows of a vector.
static inline void blend(const vectors *sums, const lanes weight, size_t row, const vectors *rows,
                         lanes blended[3]) {
    const lanes rest = lanes_subtract(lanes_splat(1.0f), weight);
    for (int axis = 0; axis < 3; axis++) {
        const lanes sum = lanes_load_any(&sums->axes[axis][row]);
        const lanes middle = lanes_multiply(sum, lanes_splat(0.5f));
        const lanes value = lanes_load_any(&rows->axes[axis][row]);
        blended[axis] = lanes_add(lanes_multiply(rest, middle), lanes_multiply(weight, value));
    }
}

/// The rest of morph_normal().
static inline void make_unit(lanes n[3]) {
    const lanes square =
        lanes_add(lanes_add(lanes_multiply(n[0], n[0]), lanes_multiply(n[1], n[1])),
                  lanes_multiply(n[2], n[2]));
    const lanes root = inverse_root(square), least = lanes_splat(LEAST_SQUARE);
    for (int axis = 0; axis < 3; axis++) {
        const lanes unit = lanes_add(lanes_multiply(n[axis], root), lanes_zero());
        n[axis] = lanes_select_greater(square, least, unit, n[axis]);
    }
}

/// Moves the rows that are new at the level of the patch, in the vectors that they are stored in:
/// loading parts of two vectors would wait for both.
static inline void morph_level(const limn_domain *domain, const limn_plan_patch *item, bool normals,
                               vectors *rows) {
    float weights[PLANE];
    vectors sums;
    const size_t begin = domain->row_counts[item->level - 1] / LANES_WIDTH * LANES_WIDTH;
    const size_t end = domain->row_counts[item->level];
    if (!set_weights(domain, item, begin, weights)) return;
    for (int axis = 0; axis < 3; axis++)
        lanes_store(&sums.axes[axis][(end - 1) / LANES_WIDTH * LANES_WIDTH], lanes_zero());
    add_sources(domain, rows, begin, end, &sums);
    for (size_t row = begin; row < end; row += LANES_WIDTH) {
        const lanes weight = lanes_load_any(weights + row), one = lanes_splat(1.0f);
        lanes blended[3];
        blend(&sums, weight, row, rows, blended);
        if (normals) make_unit(blended);
        for (int axis = 0; axis < 3; axis++) {
            float *const place = &rows->axes[axis][row];
            const lanes kept = lanes_load_any(place);
            lanes_store(place, lanes_select_greater(weight, one, kept, blended[axis]));
        }
    }
}

/// Positions or normals of a patch, as its plan wants them: first along coarser edges, as parents
/// are taken where they are drawn.
static inline void morph_patch(const limn_domain *domain, const limn_plan_patch *item, bool normals,
                               vectors *rows) {
    const uint32_t level = item->level;
    if (level == 0) return;
    for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
        const uint16_t *const along = domain->edge_rows[edge];
        const uint32_t edge_level = item->edge_levels[edge];
        if (edge_level == level) continue;
        morph_edge(domain->rows, along, edge_level, item->edge_morphs[edge], normals, rows);
        if (item->morph != 1) close_edge(along, edge_level, level, rows);
    }
    morph_level(domain, item, normals, rows);
}

#endif
