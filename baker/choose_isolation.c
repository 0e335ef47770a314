/* SPDX-License-Identifier: MIT */
#include "choose_isolation.h"

#include "sizes.h"

#include <string.h>

/// What the file would take.
static limn_bake_status measure(limni_context *context, const limni_classes *classes,
                                const limni_classes *pieces, const limni_patches *patches,
                                limni_footprint *footprint) {
    const limn_file_mesh *const record = &patches->record;
    limn_file_class *const class_records =
        limni_allocate(context, classes->count, sizeof *class_records);
    limn_file_piece *const piece_records =
        limni_allocate(context, pieces->count, sizeof *piece_records);
    if (!class_records || !piece_records) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < classes->count; c++)
        class_records[c] = limni_class_record(&classes->items[c]);
    for (uint32_t p = 0; p < pieces->count; p++)
        piece_records[p] = limni_piece_record(&pieces->items[p]);
    const limn_pack pack = {.classes = class_records,
                            .class_count = classes->count,
                            .pieces = piece_records,
                            .piece_count = pieces->count};
    const limn_mesh mesh = {.domain = limn_domain_get((limn_domain_kind)record->domain),
                            .control_count = record->control_count,
                            .point_count = record->point_count,
                            .patch_count = record->patch_count,
                            .run_count = record->run_count,
                            .runs = patches->runs,
                            .classes = class_records,
                            .stencils = patches->stencils.offsets};
    footprint->tables = limni_tables_size(&pack) + limni_columns_size(&pack);
    footprint->total = footprint->tables + limni_patches_size(&mesh) + limni_points_size(&mesh);
    return LIMN_BAKE_OK;
}

static limn_bake_status try_bake(limni_context *context, const limni_base *base, limni_rules rules,
                                 limn_isolate isolate, limni_footprint *footprint) {
    limni_classes classes = {0}, pieces = {0};
    limni_patches patches;
    rules.isolate = isolate;
    LIMNI_TRY(limni_patches_build(context, base, &rules, NULL, 0, &classes, &pieces, &patches));
    return measure(context, &classes, &pieces, &patches, footprint);
}

limn_bake_status limni_choose_isolation(limni_context *context, const limni_base *base,
                                        const limni_rules *rules, limni_footprint footprints[2],
                                        limn_isolate *isolate) {
    bool isolated = false;
    for (int way = 0; way < 2; way++) {
        limni_context scratch = {.desc = context->desc}; // all of the trial goes with it
        scratch.desc.progress = NULL;
        const limn_bake_status status =
            try_bake(&scratch, base, *rules, way ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER,
                     &footprints[way]);
        const bool too_large = way == 1 && status == LIMN_BAKE_BAD_INPUT; // to be isolated
        if (!too_large) memcpy(context->error, scratch.error, sizeof context->error);
        limni_release_all(&scratch);
        if (!too_large) LIMNI_TRY(status);
        isolated = status == LIMN_BAKE_OK && footprints[0].tables > LIMNI_TABLES_MAX &&
                   footprints[1].tables < footprints[0].tables;
    }
    *isolate = isolated ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER;
    return LIMN_BAKE_OK;
}
