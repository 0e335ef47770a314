/* SPDX-License-Identifier: MIT */
/* Animations: their channels with the keys of the samplers. */
#include "gltf_reader.h"

#include "limn/format.h"

#include <stdio.h>
#include <string.h>

/// A channel at work.
typedef struct reading {
    const limni_gltf_reader *reader;
    const limni_gltf_channel *from;
    limni_model_channel *to;
} reading;

static limn_bake_status refuse(const reading *r, const char *text) {
    return limni_fail(r->reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: %s", r->reader->model->path,
                      r->to->label, text);
}

static bool find_index(const char *const *names, uint32_t count, const char *name, uint8_t *index) {
    for (uint32_t n = 0; n < count; n++) {
        if (strcmp(names[n], name) != 0) continue;
        *index = (uint8_t)n;
        return true;
    }
    return false;
}

/// As many as the mesh of a node has morph targets.
static uint32_t count_weights(const limni_model *model, int node) {
    const int mesh = model->nodes[node].mesh;
    if (mesh < 0 || (uint32_t)mesh >= model->mesh_count || model->meshes[mesh].part_count == 0)
        return 0;
    return model->meshes[mesh].parts[0].target_count;
}

static limn_bake_status read_keys(const reading *r) {
    limni_context *const context = r->reader->context;
    limni_model_channel *const to = r->to;
    const bool weights = to->path == LIMN_FORMAT_TARGET_WEIGHTS;
    const limni_gltf_accessor *times;
    char what[224];
    snprintf(what, sizeof what, "%s, times", to->label);
    LIMNI_TRY(limni_gltf_find_accessor(r->reader, r->from->input, what, &times));
    if (times->count >= 1u << 24) return refuse(r, "it has too many keys");
    to->key_count = (uint32_t)times->count;
    const uint64_t parts = to->interpolation == LIMN_FORMAT_CUBIC ? 3 : 1;
    const uint64_t elements = to->key_count * parts * (weights ? to->width : 1);
    to->times = limni_allocate(context, to->key_count, sizeof *to->times);
    to->values = limni_allocate(context, to->key_count * parts * to->width, sizeof *to->values);
    if (!to->times || !to->values) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_gltf_read_floats(r->reader, r->from->input, what, to->key_count, 1, to->times));
    snprintf(what, sizeof what, "%s, values", to->label);
    return limni_gltf_read_floats(r->reader, r->from->output, what, elements,
                                  weights ? 1 : to->width, to->values);
}

/// Returns in *known whether the channel moves something that is known; otherwise it is noted.
static limn_bake_status read_channel(const reading *r, bool *known) {
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    static const char *const interpolations[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    limni_model_channel *const to = r->to;
    to->node = r->from->node;
    if (to->node < 0 || (uint32_t)to->node >= r->reader->model->node_count)
        return refuse(r, "there is no such node");
    *known = find_index(paths, 4, r->from->path, &to->path);
    if (!*known) {
        limni_note(r->reader->context, "%s: %s: it moves something unknown; it is passed over",
                   r->reader->model->path, to->label);
        return LIMN_BAKE_OK;
    }
    if (!find_index(interpolations, 3, r->from->interpolation, &to->interpolation))
        return refuse(r, "its sampler does not exist, or interpolates in an unknown way");
    to->width = to->path == LIMN_FORMAT_ROTATION         ? 4
                : to->path == LIMN_FORMAT_TARGET_WEIGHTS ? count_weights(r->reader->model, to->node)
                                                         : 3;
    return to->width ? read_keys(r) : LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_animations(const limni_gltf_reader *reader) {
    limni_context *const context = reader->context;
    limni_model *const model = reader->model;
    model->animation_count = reader->document->animation_count;
    model->animations =
        limni_allocate_zeroed(context, model->animation_count, sizeof *model->animations);
    if (!model->animations) return LIMN_BAKE_MEMORY;
    for (uint32_t a = 0; a < model->animation_count; a++) {
        const limni_gltf_animation *const from = &reader->document->animations[a];
        limni_model_animation *const to = &model->animations[a];
        limni_label label;
        limni_label_make(label, "animation", a, from->name);
        to->name = from->name;
        to->channels = limni_allocate_zeroed(context, from->channel_count, sizeof *to->channels);
        if (!to->channels) return LIMN_BAKE_MEMORY;
        for (uint32_t c = 0; c < from->channel_count; c++) {
            const reading r = {reader, &from->channels[c], &to->channels[to->channel_count]};
            bool known = false;
            snprintf(r.to->label, sizeof r.to->label, "%s, channel %u", label, c);
            LIMNI_TRY(read_channel(&r, &known));
            to->channel_count += known;
        }
    }
    return LIMN_BAKE_OK;
}
