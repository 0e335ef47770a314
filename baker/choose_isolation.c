/* SPDX-License-Identifier: MIT */
#include "choose_isolation.h"

#include <string.h>

/// Half of what a core of a console has as its second cache. Larger tables compete with the points
/// and vertices of a frame; smaller ones stay there, and patches with one table are quicker.
#define TABLES_MAX ((uint64_t)256 << 10)

static uint64_t size_of_tables(const limni_classes *classes) {
    uint64_t size = 0;
    for (uint32_t c = 0; c < classes->count; c++) {
        const limni_class *const class = &classes->items[c];
        size += class->parts ? limni_class_parts_size(class) : limni_class_table_size(class);
    }
    return size;
}

static uint64_t size_of_patches(const limni_patches *patches) {
    const limn_file_mesh *const record = &patches->record;
    const uint64_t points = record->point_count - record->control_count;
    uint64_t size = record->index_count * sizeof *patches->indices + patches->slots_size;
    if (points)
        size += points * sizeof *patches->controls + (1 + points) * sizeof(uint32_t) +
                patches->stencils.offsets[points] * sizeof(limn_file_term);
    return size;
}

static limn_bake_status try_bake(limni_context *context, const limni_base *base, limni_rules rules,
                                 limn_isolate isolate, limni_footprint *footprint) {
    limni_classes classes = {0}, pieces = {0};
    limni_patches patches;
    rules.isolate = isolate;
    LIMNI_TRY(limni_patches_build(context, base, &rules, &classes, &pieces, &patches));
    footprint->tables = size_of_tables(&classes) + size_of_tables(&pieces);
    footprint->total = footprint->tables + size_of_patches(&patches);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_choose_isolation(limni_context *context, const limni_base *base,
                                        const limni_rules *rules, limni_footprint footprints[2],
                                        limn_isolate *isolate) {
    limn_bake_status status[2] = {LIMN_BAKE_OK};
    for (int way = 0; way < 2; way++) {
        limni_context scratch = {.desc = context->desc}; // all of the trial goes with it
        scratch.desc.progress = NULL;
        status[way] = try_bake(&scratch, base, *rules,
                               way ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER, &footprints[way]);
        if (way == 0) memcpy(context->error, scratch.error, sizeof context->error);
        limni_release_all(&scratch);
        LIMNI_TRY(status[0]);
    }
    const bool isolated = status[1] == LIMN_BAKE_OK && footprints[0].tables > TABLES_MAX &&
                          footprints[1].tables < footprints[0].tables;
    *isolate = isolated ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER;
    return LIMN_BAKE_OK;
}
