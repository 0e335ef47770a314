/* SPDX-License-Identifier: MIT */
/* Reads single coefficients back out of the tables of a class, whatever their layout. */
#ifndef COEFFICIENTS_H
#define COEFFICIENTS_H

#include "../runtime/mesh.h"

/// Where a row is in the columns of a table: one of a pair, or alone.
typedef struct column_place {
    const float *table;
    uint32_t at, stride, pair_count;
    uint32_t column_count;
    uint32_t edge; ///< of tangents, whose block it is in; or else as many as there are
    bool paired, image;
    const uint16_t *columns; ///< of the slots; NULL: the slots themselves
} column_place;

/// In one table of a class: 0 of positions, 1 and 2 of tangents.
static inline column_place place_in_table(const limni_run *run, uint32_t corner_count,
                                          uint32_t table, uint32_t row) {
    const limni_layout *const layout = table ? run->tangent_layout : run->layout;
    column_place place = {.table = run->table + table * run->table_stride,
                          .stride = layout->row_stride,
                          .pair_count = run->pair_count,
                          .column_count = run->control_count};
    for (; place.at < layout->row_stride; place.at++) {
        const uint32_t pair = place.at - layout->pair_table_row;
        place.paired = pair < layout->pair_counts[LIMN_LEVEL_MAX];
        place.image = place.paired && layout->mirror_rows[pair / 8] + pair % 8 == row;
        if (place.image || layout->rows[place.at] == row) break;
    }
    place.edge = table && place.at / LIMNI_EDGE_ROWS < corner_count ? place.at / LIMNI_EDGE_ROWS
                                                                    : corner_count;
    return place;
}

/// In the tables of the pieces of a class. Found by the copy that takes it to its place.
static inline column_place place_in_pieces(const limni_run *run, uint32_t corner_count,
                                           uint32_t table, uint32_t row) {
    const limni_piece_copy *copy =
        table ? run->pieces->normal_copies : run->pieces->position_copies;
    const limni_piece_copy *const end =
        copy + (table ? run->pieces->normal_copy_counts
                      : run->pieces->position_copy_counts)[LIMN_LEVEL_MAX];
    while (copy + 1 < end && copy[1].to <= row)
        copy++;
    const uint32_t staged = copy->from + row - copy->to;
    uint32_t p = LIMN_FORMAT_PIECE_COUNT - 1;
    while (limni_piece_of(run, p).first_place > staged)
        p--;
    const limni_piece piece = limni_piece_of(run, p);
    column_place place = {.table = piece.table + table * piece.table_stride,
                          .at = staged - piece.first_place,
                          .stride = piece.positions->row_stride,
                          .column_count = run->records[run->parts[p]].control_count,
                          .edge = corner_count,
                          .columns = piece.columns};
    if (table && p < corner_count && place.at < 16)
        place.edge = (p + (place.at < 8 ? 0 : corner_count - 1)) % corner_count;
    return place;
}

/// In table 0 of positions, or 1 and 2 of tangents; there, not of a corner.
static inline column_place place_of_row(const limn_mesh *mesh, uint32_t run_index, uint32_t table,
                                        uint32_t row) {
    const limni_run part = limni_run_part(mesh, &mesh->runs[run_index], 0, 1);
    const uint32_t corner_count = mesh->domain->corner_count;
    return part.pieces ? place_in_pieces(&part, corner_count, table, row)
                       : place_in_table(&part, corner_count, table, row);
}

/// The coefficient of the point in `slot`. Of paired rows, it is a sum of two.
static inline double coefficient_at(const column_place *place, uint32_t slot) {
    const float *const rows = place->table + place->at;
    const uint32_t column = place->columns ? place->columns[slot] : slot;
    if (column == LIMN_FORMAT_NO_COLUMN && place->columns) return 0;
    const double own = (double)rows[(size_t)column * place->stride];
    if (!place->paired || slot == 0 || slot > 2 * place->pair_count) return own;
    const bool first = slot % 2 == 1;
    const double other = (double)rows[(size_t)(first ? slot + 1 : slot - 1) * place->stride];
    const double even = first ? own : other, odd = first ? other : own;
    return first == place->image ? even - odd : even + odd;
}

#endif
