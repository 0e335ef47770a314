/* SPDX-License-Identifier: MIT */
/* What meshes share, as it is stored. */
#ifndef LIMNI_RECORDS_H
#define LIMNI_RECORDS_H

#include "classes.h"

typedef struct limni_records {
    limn_file_class *classes;
    limn_file_piece *pieces;
    uint16_t *columns;
    uint64_t tables_size, columns_size; ///< of the chunks, in bytes
} limni_records;

/// The records of all classes and pieces, with the places of their tables and columns; and columns.
limn_bake_status limni_records_make(limni_context *context, const limni_classes *classes,
                                    const limni_classes *pieces, limni_records *records);
void limni_records_release(limni_context *context, limni_records *records);

static inline uint64_t limni_align(uint64_t offset) {
    return (offset + LIMN_FORMAT_ALIGNMENT - 1) / LIMN_FORMAT_ALIGNMENT * LIMN_FORMAT_ALIGNMENT;
}

#endif
