/* SPDX-License-Identifier: MIT */
/* Skins: their joints, and matrices out of accessors. */
#include "gltf_reader.h"

#include <stdio.h>
#include <string.h>

/// Columns of a matrix of 4 by 4, of which the last row must be 0, 0, 0, 1.
static bool take_matrix(const float *columns, float rows[3][4]) {
    for (int i = 0; i < 12; i++)
        rows[i / 4][i % 4] = columns[4 * (i % 4) + i / 4];
    return columns[3] == 0 && columns[7] == 0 && columns[11] == 0 && columns[15] == 1;
}

static limn_bake_status read_matrices(const limni_gltf_reader *reader, const limni_gltf_skin *from,
                                      const char *label, float (**matrices)[16]) {
    char what[128];
    snprintf(what, sizeof what, "inverse bind matrices of %s", label);
    const limni_gltf_accessor *accessor;
    LIMNI_TRY(limni_gltf_find_accessor(reader, from->inverse_binds, what, &accessor));
    // There may be more than joints.
    const uint64_t most = UINT16_MAX + 1u, given = accessor->count < most ? accessor->count : most;
    const uint64_t count = given > from->joint_count ? given : from->joint_count;
    *matrices = limni_allocate(reader->context, (size_t)count, sizeof **matrices);
    if (!*matrices) return LIMN_BAKE_MEMORY;
    return limni_gltf_read_floats(reader, from->inverse_binds, what, count, 16, (*matrices)[0]);
}

static limn_bake_status read_skin(const limni_gltf_reader *reader, uint32_t index) {
    limni_context *const context = reader->context;
    const limni_gltf_skin *const from = &reader->document->skins[index];
    limni_model_skin *const skin = &reader->model->skins[index];
    limni_label label;
    float(*matrices)[16] = NULL;
    limni_label_make(label, "skin", index, from->name);
    *skin = (limni_model_skin){
        .name = from->name, .joints = from->joints, .joint_count = from->joint_count};
    if (from->inverse_binds < 0) return LIMN_BAKE_OK;
    LIMNI_TRY(read_matrices(reader, from, label, &matrices));
    skin->inverse_binds = limni_allocate(context, skin->joint_count, sizeof *skin->inverse_binds);
    if (!skin->inverse_binds) return LIMN_BAKE_MEMORY;
    for (uint32_t j = 0; j < skin->joint_count; j++) {
        if (!take_matrix(matrices[j], skin->inverse_binds[j]))
            return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: the last row of inverse bind matrix %u is not 0, 0, 0, 1",
                              reader->model->path, label, j);
    }
    limni_release(context, matrices);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_skins(const limni_gltf_reader *reader) {
    limni_model *const model = reader->model;
    model->skin_count = reader->document->skin_count;
    model->skins = limni_allocate_zeroed(reader->context, model->skin_count, sizeof *model->skins);
    if (!model->skins) return LIMN_BAKE_MEMORY;
    for (uint32_t n = 0; n < model->node_count; n++) {
        const int skin = model->nodes[n].skin;
        if (skin >= 0 && (uint32_t)skin < model->skin_count && !model->skins[skin].name)
            LIMNI_TRY(read_skin(reader, (uint32_t)skin));
    }
    return LIMN_BAKE_OK;
}
