/* SPDX-License-Identifier: MIT */
#include "records.h"

#include <string.h>

static void place_classes(const limni_classes *classes, limni_records *r) {
    for (uint32_t c = 0; c < classes->count; c++) {
        const limni_class *const class = &classes->items[c];
        uint64_t *const size = class->parts ? &r->columns_size : &r->tables_size;
        r->classes[c] = limni_class_record(class);
        r->classes[c].table_offset = *size;
        *size += class->parts ? limni_class_parts_size(class)
                              : limni_align(limni_class_table_size(class));
    }
}

static void place_pieces(const limni_classes *pieces, limni_records *r) {
    for (uint32_t p = 0; p < pieces->count; p++) {
        r->pieces[p] = limni_piece_record(&pieces->items[p]);
        r->pieces[p].table_offset = r->tables_size;
        r->tables_size += limni_align(limni_class_table_size(&pieces->items[p]));
    }
}

static void copy_columns(const limni_classes *classes, limni_records *r) {
    for (uint32_t c = 0; c < classes->count; c++) {
        const limni_class *const class = &classes->items[c];
        if (class->parts)
            memcpy((unsigned char *)r->columns + r->classes[c].table_offset, class->parts,
                   limni_class_parts_size(class));
    }
}

limn_bake_status limni_records_make(limni_context *context, const limni_classes *classes,
                                    const limni_classes *pieces, limni_records *records) {
    *records = (limni_records){
        .classes = limni_allocate_zeroed(context, classes->count, sizeof *records->classes),
        .pieces = limni_allocate_zeroed(context, pieces->count, sizeof *records->pieces)};
    if (!records->classes || !records->pieces) return LIMN_BAKE_MEMORY;
    place_classes(classes, records);
    place_pieces(pieces, records);
    records->columns = limni_allocate(context, (size_t)records->columns_size, 1);
    if (!records->columns) return LIMN_BAKE_MEMORY;
    copy_columns(classes, records);
    return LIMN_BAKE_OK;
}

void limni_records_release(limni_context *context, limni_records *records) {
    limni_release(context, records->classes);
    limni_release(context, records->pieces);
    limni_release(context, records->columns);
    *records = (limni_records){0};
}
