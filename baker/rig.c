/* SPDX-License-Identifier: MIT */
#include "rig.h"

#include <string.h>

static limn_bake_status copy_influences(limni_context *context, const limni_rig *from,
                                        const limni_mesh *mesh, limni_control_rig *rig) {
    const size_t count = from->influence_count;
    rig->influence_count = from->influence_count;
    rig->joints = limni_allocate(context, mesh->control_count * count, sizeof *rig->joints);
    rig->weights = limni_allocate(context, mesh->control_count * count, sizeof *rig->weights);
    if (!rig->joints || !rig->weights) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        const size_t position = limni_origin(mesh, c);
        memcpy(rig->joints + c * count, from->joints + position * count,
               count * sizeof *rig->joints);
        memcpy(rig->weights + c * count, from->weights + position * count,
               count * sizeof *rig->weights);
    }
    return LIMN_BAKE_OK;
}

static const float *delta_of(const limni_rig *rig, const limni_mesh *mesh, uint32_t control,
                             uint32_t target) {
    return rig->deltas[(size_t)limni_origin(mesh, control) * rig->target_count + target];
}

static bool moves(const float delta[3]) {
    return delta[0] != 0 || delta[1] != 0 || delta[2] != 0;
}

static limn_bake_status list_targets(limni_context *context, const limni_rig *from,
                                     const limni_mesh *mesh, limni_control_rig *rig) {
    const uint32_t count = from->target_count;
    uint64_t entries = 0;
    rig->target_count = count;
    rig->targets = from->targets;
    rig->first = limni_allocate(context, (size_t)count + 1, sizeof *rig->first);
    if (!rig->first) return LIMN_BAKE_MEMORY;
    for (uint32_t t = 0; t < count; t++) {
        for (uint32_t c = 0; c < mesh->control_count; c++)
            entries += moves(delta_of(from, mesh, c, t));
    }
    if (entries > UINT32_MAX)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: morph targets move too many points",
                          limni_mesh_label(mesh));
    rig->points = limni_allocate(context, (size_t)entries, sizeof *rig->points);
    rig->deltas = limni_allocate(context, (size_t)entries, sizeof *rig->deltas);
    if (!rig->points || !rig->deltas) return LIMN_BAKE_MEMORY;
    uint32_t entry = 0;
    for (uint32_t t = 0; t < count; t++) {
        rig->first[t] = entry;
        for (uint32_t c = 0; c < mesh->control_count; c++) {
            const float *const delta = delta_of(from, mesh, c, t);
            if (!moves(delta)) continue;
            rig->points[entry] = c;
            memcpy(rig->deltas[entry++], delta, sizeof *rig->deltas);
        }
    }
    rig->first[count] = entry;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_rig_build(limni_context *context, const limni_source *source,
                                 const limni_mesh *mesh, limni_control_rig *rig) {
    *rig = (limni_control_rig){0};
    if (source->rig.influence_count) LIMNI_TRY(copy_influences(context, &source->rig, mesh, rig));
    return source->rig.target_count ? list_targets(context, &source->rig, mesh, rig) : LIMN_BAKE_OK;
}

void limni_rig_keep(limni_rig *rig, const uint32_t *numbers, uint32_t count) {
    const size_t influences = rig->influence_count, targets = rig->target_count;
    for (uint32_t p = 0; p < count; p++) {
        const size_t from = numbers[p];
        if (influences) {
            memmove(rig->joints + p * influences, rig->joints + from * influences,
                    influences * sizeof *rig->joints);
            memmove(rig->weights + p * influences, rig->weights + from * influences,
                    influences * sizeof *rig->weights);
        }
        if (targets)
            memmove(rig->deltas + p * targets, rig->deltas + from * targets,
                    targets * sizeof *rig->deltas);
    }
}

/// But for the targets, which go on into the file.
void limni_rig_release(limni_context *context, const limni_rig *rig) {
    limni_release(context, rig->joints);
    limni_release(context, rig->weights);
    limni_release(context, rig->deltas);
}
