/* SPDX-License-Identifier: MIT */
#include "cost.h"

#include "../runtime/domain.h"
#include "../runtime/kernels.h"
#include "sizes.h"

/// Picoseconds. Fitted to what `limn-bench isolation` measures of the reproducible AVX2 kernel.
enum {
    PATCH = 18000,           ///< for each patch,
    ROW = 350,               ///< and for each of its vertices: storing
    BLOCK = 500,             ///< a control point's share in eight rows: three multiply-adds
    LONG = 7,                ///< times as much where sums are compensated
    LISTED = 1250,           ///< a control point that is looked at for a piece
    CHANGE = 80000,          ///< of the class: a table that is in the second cache,
    CHANGE_OUTSIDE = 235000, ///< or is not
    POINT = 750,             ///< of the level that isolates,
    TERM = 500               ///< and of its stencil
};

static uint64_t cost_of_rows(uint64_t control_count, uint64_t row_count) {
    const uint64_t blocks = control_count * row_count / LIMN_FORMAT_ROW_BLOCK;
    return blocks * BLOCK * (control_count > LIMNI_PLAIN_TERMS ? LONG : 1);
}

static uint64_t cost_of_table(const limn_file_class *class, uint32_t level) {
    const limni_layout *const layout =
        limni_layout_get((limn_domain_kind) class->domain, false, class->pair_count);
    uint64_t rows = 0;
    for (int s = 0; s < LIMNI_SEGMENT_MAX; s++)
        rows += layout->segments[level][s].count;
    return cost_of_rows(class->control_count, rows) +
           cost_of_rows(class->control_count - 1, layout->pair_counts[level]);
}

static uint64_t cost_of_pieces(const limn_mesh *mesh, const limn_file_class *class,
                               uint32_t level) {
    const limni_pieces *const pieces = limni_pieces_get(mesh->domain->kind);
    const uint16_t *const parts = mesh->columns + class->table_offset / sizeof *parts;
    uint64_t cost = 0;
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++) {
        const limn_file_piece *const piece = &mesh->pieces[parts[p]];
        const uint32_t rows = pieces->positions[piece->kind].counts[level];
        if (rows)
            cost +=
                (uint64_t)LISTED * class->control_count + cost_of_rows(piece->control_count, rows);
    }
    return cost;
}

static uint64_t cost_of_patch(const limn_mesh *mesh, const limn_file_class *class, uint32_t level) {
    const uint64_t own = class->depth == LIMN_FORMAT_DEPTH ? cost_of_table(class, level)
                                                           : cost_of_pieces(mesh, class, level);
    const uint64_t rows = mesh->domain->row_counts[level];
    return PATCH + ROW * rows + own;
}

void limni_cost_count(const limn_pack *pack, const limn_mesh *mesh, limni_cost *cost) {
    const uint64_t change = limni_tables_size(pack) > LIMNI_TABLES_MAX ? CHANGE_OUTSIDE : CHANGE;
    const uint32_t point_count = mesh->point_count - mesh->control_count;
    *cost = (limni_cost){0};
    if (point_count)
        cost->points = (uint64_t)POINT * point_count + (uint64_t)TERM * mesh->stencils[point_count];
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        const limn_file_run *const run = &mesh->runs[r];
        for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
            cost->levels[level] +=
                change +
                run->patch_count * cost_of_patch(mesh, &mesh->classes[run->class_index], level);
    }
}
