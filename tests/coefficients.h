/* SPDX-License-Identifier: MIT */
/* Reads single coefficients back out of a table, whatever its layout. */
#ifndef COEFFICIENTS_H
#define COEFFICIENTS_H

#include "../runtime/domain.h"
#include "limn/format.h"

/// Where a row is in the columns of a table: one of a pair, or alone.
typedef struct column_place {
    uint32_t at, stride, pair_count;
    bool paired, image;
} column_place;

/// In the table of positions of a class, or in those of tangents.
static inline column_place place_of_row(const limn_file_class *class, bool tangents, uint32_t row) {
    const limni_layout *const layout =
        limni_layout_get((limn_domain_kind) class->domain, tangents, class->pair_count);
    column_place place = {.stride = layout->row_stride, .pair_count = class->pair_count};
    for (; place.at < layout->row_stride; place.at++) {
        const uint32_t pair = place.at - layout->pair_table_row;
        place.paired = pair < layout->pair_counts[LIMN_LEVEL_MAX];
        place.image = place.paired && layout->mirror_rows[pair / 8] + pair % 8 == row;
        if (place.image || layout->rows[place.at] == row) break;
    }
    return place;
}

/// The coefficient of the control point in `slot`. Of paired rows, it is a sum of two.
static inline double coefficient_at(const float *table, const column_place *place, uint32_t slot) {
    const float *const rows = table + place->at;
    const double own = (double)rows[(size_t)slot * place->stride];
    if (!place->paired || slot == 0 || slot > 2 * place->pair_count) return own;
    const bool first = slot % 2 == 1;
    const double other = (double)rows[(size_t)(first ? slot + 1 : slot - 1) * place->stride];
    const double even = first ? own : other, odd = first ? other : own;
    return first == place->image ? even - odd : even + odd;
}

#endif
