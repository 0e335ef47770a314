/* SPDX-License-Identifier: MIT */
/* Reads single coefficients back out of a table, whatever its layout. */
#ifndef COEFFICIENTS_H
#define COEFFICIENTS_H

#include "../runtime/domain.h"
#include "limn/format.h"

/// Where a row is in a column: one of a pair, or alone.
typedef struct column_place {
    uint32_t at;
    bool paired, image;
} column_place;

static inline column_place place_of_row(const limni_layout *layout, uint32_t row) {
    column_place place = {UINT32_MAX, false, false};
    for (uint32_t at = 0; at < layout->row_stride; at++) {
        const uint32_t pair = at - layout->pair_table_row;
        const bool paired = pair < layout->pair_counts[LIMN_LEVEL_MAX];
        if (layout->rows[at] == row) place = (column_place){at, paired, false};
        if (paired && layout->mirror_rows[pair / 8] + pair % 8 == row)
            place = (column_place){at, true, true};
    }
    return place;
}

/// The coefficient of the control point in `slot` for `row`, from the table of positions of a class
/// or one of tangents. Of paired rows, it is a sum of two.
static inline double coefficient_at(const limn_file_class *class, bool tangents, const float *table,
                                    uint32_t row, uint32_t slot) {
    const limni_layout *const layout =
        limni_layout_get((limn_domain_kind) class->domain, tangents, class->pair_count);
    const column_place place = place_of_row(layout, row);
    const float *const rows = table + place.at;
    const double own = (double)rows[(size_t)slot * layout->row_stride];
    if (!place.paired || slot == 0 || slot > 2u * class->pair_count) return own;
    const bool first = slot % 2 == 1;
    const double other = (double)rows[(size_t)(first ? slot + 1 : slot - 1) * layout->row_stride];
    const double even = first ? own : other, odd = first ? other : own;
    return first == place.image ? even - odd : even + odd;
}

#endif
