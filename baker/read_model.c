/* SPDX-License-Identifier: MIT */
/* Meshes with what moves and colours them, out of any format. docs/meshes.md says how. */
#include "read_model.h"

#include "model_reader.h"

#include <string.h>

static uint32_t *make_indices(limni_context *context, uint32_t count) {
    uint32_t *const indices = limni_allocate(context, count, sizeof *indices);
    if (indices) memset(indices, 0xff, count * sizeof *indices);
    return indices;
}

static void release_sets(limni_context *context, limni_model_set *sets, uint32_t count) {
    for (uint32_t s = 0; s < count; s++)
        limni_release(context, sets[s].values);
}

static void release_part(limni_context *context, limni_model_part *part) {
    limni_release(context, part->positions);
    limni_release(context, part->face_offsets);
    limni_release(context, part->corners);
    limni_release(context, part->influences);
    release_sets(context, part->uvs, part->uv_count);
    release_sets(context, part->colours, part->colour_count);
    for (uint32_t t = 0; t < part->target_count; t++)
        limni_release(context, part->targets[t]);
}

static void release(limni_context *context, const limni_model *model) {
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        for (uint32_t p = 0; p < model->meshes[m].part_count; p++)
            release_part(context, &model->meshes[m].parts[p]);
    }
    for (uint32_t a = 0; a < model->animation_count; a++) {
        for (uint32_t c = 0; c < model->animations[a].channel_count; c++) {
            limni_release(context, model->animations[a].channels[c].times);
            limni_release(context, model->animations[a].channels[c].values);
        }
    }
}

limn_bake_status limni_read_model(limni_context *context, limni_model *model, const char *name,
                                  limni_scene *scene) {
    limni_model_reader reader = {.context = context,
                                 .model = model,
                                 .file_name = name,
                                 .scene = scene,
                                 .materials = make_indices(context, model->material_count),
                                 .images = make_indices(context, model->image_count)};
    if (!reader.materials || !reader.images) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_model_read_nodes(&reader));
    LIMNI_TRY(limni_model_read_skeleton(&reader));
    LIMNI_TRY(limni_model_read_meshes(&reader));
    if (scene->source_count == 0)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: its scene has no mesh with faces",
                          model->path);
    LIMNI_TRY(limni_model_read_clips(&reader));
    release(context, model);
    return LIMN_BAKE_OK;
}
