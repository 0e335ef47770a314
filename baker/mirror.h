/* SPDX-License-Identifier: MIT */
/*
 * Classes that are their own mirror images: exchanging corners 1 and 2 exchanges control points and
 * rows in pairs. The runtime then sums pairs of rows with half the work (simd/sums.h).
 */
#ifndef LIMNI_MIRROR_H
#define LIMNI_MIRROR_H

#include "fixed.h"

#include <stdbool.h>
#include <stddef.h>

/// The coefficients of a local base, all tables of it.
typedef struct limni_coefficients {
    const limni_fixed *rows; ///< [table_count][row_count][slot_count]
    uint32_t table_count, row_count, slot_count;
} limni_coefficients;

static inline limni_fixed limni_coefficient(const limni_coefficients *c, uint32_t table,
                                            uint32_t row, uint32_t slot) {
    return c->rows[((size_t)table * c->row_count + row) * c->slot_count + slot];
}

/// Finds the mirror image of each slot.
///
/// used    [slot_count] slots with a column; the others are left alone
/// images  out: [slot_count] the slot itself, if it lies on the mirror line
/// returns the number of pairs; 0 if the class is not its own image
uint32_t limni_find_mirror(const limni_coefficients *coefficients, const bool *used,
                           uint16_t *images);

#endif
