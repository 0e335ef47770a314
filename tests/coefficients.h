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
    for (uint32_t b = 0; b < layout->pair_counts[LIMN_LEVEL_MAX] / LIMN_FORMAT_ROW_BLOCK; b++) {
        const uint32_t first = layout->pair_table_row + b * LIMN_FORMAT_ROW_BLOCK;
        const uint32_t own = row - layout->pair_rows[b], image = row - layout->mirror_rows[b];
        if (own < LIMN_FORMAT_ROW_BLOCK) return (column_place){first + own, true, false};
        if (image < LIMN_FORMAT_ROW_BLOCK) return (column_place){first + image, true, true};
    }
    const limni_segment *segment = &layout->segments[LIMN_LEVEL_MAX][0];
    if (row - segment->row >= segment->count) segment++;
    return (column_place){segment->table_row + row - segment->row, false, false};
}

/// The coefficient of the control point in `slot` for `row`, from one of the tables of a class. Of
/// paired rows, it is a sum of two.
static inline double coefficient_at(const limn_file_class *class, const float *table, uint32_t row,
                                    uint32_t slot) {
    const limni_layout *const layout =
        limni_layout_get((limn_domain_kind) class->domain, class->pair_count);
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
