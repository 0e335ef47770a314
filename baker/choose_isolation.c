/* SPDX-License-Identifier: MIT */
#include "choose_isolation.h"

#include "records.h"
#include "sizes.h"

#include <stdio.h>
#include <string.h>

static limn_mesh view(const limni_patches *patches, const limni_records *records) {
    const limn_file_mesh *const record = &patches->record;
    return (limn_mesh){.domain = limn_domain_get((limn_domain_kind)record->domain),
                       .control_count = record->control_count,
                       .point_count = record->point_count,
                       .patch_count = record->patch_count,
                       .run_count = record->run_count,
                       .runs = patches->runs,
                       .classes = records->classes,
                       .pieces = records->pieces,
                       .columns = records->columns,
                       .stencils = patches->stencils.offsets};
}

/// What the file would take, channels included; and the time of positions alone.
static limn_bake_status measure(limni_context *context, const limni_classes *classes,
                                const limni_classes *pieces, const limni_patches *patches,
                                limni_footprint *footprint) {
    limni_records records;
    LIMNI_TRY(limni_records_make(context, classes, pieces, &records));
    const limn_pack pack = {.classes = records.classes,
                            .class_count = classes->count,
                            .pieces = records.pieces,
                            .piece_count = pieces->count};
    const limn_mesh mesh = view(patches, &records);
    footprint->tables = limni_tables_size(&pack) + limni_columns_size(&pack);
    footprint->total = footprint->tables + limni_patches_size(&mesh) + limni_points_size(&mesh);
    for (uint32_t c = 0; c < patches->record.channel_count; c++) {
        const limn_mesh channel = view(&patches->channels[c], &records);
        footprint->total += limni_lists_size(&channel) + limni_points_size(&channel);
    }
    limni_cost_count(&pack, &mesh, &footprint->cost);
    return LIMN_BAKE_OK;
}

static limn_bake_status try_bake(limni_context *context, const limni_source *source,
                                 const limni_base *base, limni_rules rules, limn_isolate isolate,
                                 limni_footprint *footprint) {
    limni_classes classes = {0}, pieces = {0};
    limni_channel *channels;
    limni_patches patches;
    rules.isolate = isolate;
    LIMNI_TRY(limni_channels_begin(context, source, base, &rules, &channels));
    LIMNI_TRY(limni_patches_build(context, base, &rules, channels, source->channel_count, &classes,
                                  &pieces, &patches));
    return measure(context, &classes, &pieces, &patches, footprint);
}

static limn_bake_status try_both(limni_context *context, const limni_source *source,
                                 const limni_base *base, const limni_rules *rules,
                                 limni_footprint footprints[2]) {
    for (int way = 0; way < 2; way++) {
        limni_context scratch = {.desc = context->desc}; // all of the trial goes with it
        scratch.desc.progress = NULL;
        const limn_bake_status status =
            try_bake(&scratch, source, base, *rules, way ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER,
                     &footprints[way]);
        const bool too_large = way == 1 && status == LIMN_BAKE_BAD_INPUT; // to be isolated
        if (!too_large) memcpy(context->error, scratch.error, sizeof context->error);
        limni_release_all(&scratch);
        if (!too_large) LIMNI_TRY(status);
    }
    return LIMN_BAKE_OK;
}

/// How isolation compares, and what follows.
typedef struct choice {
    bool possible, large;            ///< whether it can be done, and the tables are worth it
    double byte_factor, time_factor; ///< isolated to not isolated
    bool isolated;
} choice;

static choice choose(const limni_footprint footprints[2]) {
    double times[2];
    for (int way = 0; way < 2; way++)
        times[way] = (double)limni_cost_frame(&footprints[way].cost, LIMNI_COST_LEVEL);
    choice c = {.possible = footprints[1].total > 0,
                .large = footprints[0].tables > LIMNI_TABLES_MAX,
                .byte_factor = (double)footprints[1].total / (double)footprints[0].total,
                .time_factor = times[1] / times[0]};
    c.isolated = c.possible && c.large && c.byte_factor * c.time_factor < 1;
    return c;
}

static void explain(const choice *c, char *reason, size_t size) {
    if (!c->possible) {
        snprintf(reason, size, "it cannot be");
    } else if (!c->large) {
        snprintf(reason, size, "its tables take at most %u KB", LIMNI_TABLES_MAX >> 10);
    } else {
        snprintf(reason, size, "%.2f times the bytes in %.2f times the time", c->byte_factor,
                 c->time_factor);
    }
}

/// As text.
static void describe(const limni_footprint *footprint, uint32_t patch_count, char *text,
                     size_t size) {
    snprintf(
        text, size, "%llu bytes, of which %llu are tables, and %.1f ns per face at level %d",
        (unsigned long long)footprint->total, (unsigned long long)footprint->tables,
        limni_cost_per_patch(limni_cost_frame(&footprint->cost, LIMNI_COST_LEVEL), patch_count),
        LIMNI_COST_LEVEL);
}

static void note_choice(limni_context *context, const limni_mesh *mesh,
                        const limni_footprint footprints[2], const choice *c) {
    const uint32_t patch_count = mesh->face_count - mesh->hole_count;
    char reason[64], ways[2][128];
    explain(c, reason, sizeof reason);
    for (int way = 0; way < 2; way++)
        describe(&footprints[way], patch_count, ways[way], sizeof ways[way]);
    limni_note(context, "%s: %s: %s: %s%s%s", mesh->name, c->isolated ? "isolated" : "not isolated",
               reason, ways[0], c->possible ? "; isolated " : "", c->possible ? ways[1] : "");
}

limn_bake_status limni_choose_isolation(limni_context *context, const limni_source *source,
                                        const limni_base *base, limni_rules *rules,
                                        limni_footprint footprints[2]) {
    if (rules->isolate != LIMN_ISOLATE_AUTO) return LIMN_BAKE_OK;
    LIMNI_TRY(try_both(context, source, base, rules, footprints));
    const choice c = choose(footprints);
    note_choice(context, base->mesh, footprints, &c);
    rules->isolate = c.isolated ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER;
    return LIMN_BAKE_OK;
}
