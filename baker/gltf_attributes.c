/* SPDX-License-Identifier: MIT */
/* The attributes of primitives. */
#include "gltf_reader.h"

#include <stdio.h>

/// A primitive at work.
typedef struct reading {
    const limni_gltf_reader *reader;
    const limni_gltf_primitive *primitive;
    limni_model_part *part;
} reading;

typedef char attribute_name[32];

/// Returns the accessor of an attribute such as TEXCOORD_1, or -1.
static int find(const reading *r, attribute_name name, const char *stem, uint32_t set) {
    snprintf(name, sizeof(attribute_name), "%s_%u", stem, set);
    return limni_gltf_attribute_of(&r->primitive->attributes, name);
}

static limn_bake_status read_places(const reading *r, const limni_gltf_attributes *attributes,
                                    const char *of, float (**places)[3]) {
    const int accessor = limni_gltf_attribute_of(attributes, "POSITION");
    char what[224];
    *places = NULL;
    if (accessor < 0) return LIMN_BAKE_OK;
    snprintf(what, sizeof what, "POSITION of %s%s", of, r->part->label);
    *places = limni_allocate(r->reader->context, r->part->vertex_count, sizeof **places);
    if (!*places) return LIMN_BAKE_MEMORY;
    return limni_gltf_read_floats(r->reader, accessor, what, r->part->vertex_count, 3,
                                  (*places)[0]);
}

// ---- Texture coordinates and colours

/// What colours must be multiplied with that are integers, but not normalised as they should be.
static limn_bake_status find_colour_scale(const reading *r, const limni_gltf_accessor *accessor,
                                          const char *what, float *scale) {
    const int type = accessor->component_type;
    *scale = 1;
    if (type == LIMNI_GLTF_FLOAT || accessor->normalised) return LIMN_BAKE_OK;
    if (type != LIMNI_GLTF_UBYTE && type != LIMNI_GLTF_USHORT)
        return limni_fail(r->reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: %s: component type %d is not that of colours",
                          r->reader->model->path, what, type);
    *scale = type == LIMNI_GLTF_UBYTE ? 1 / 255.0f : 1 / 65535.0f;
    limni_note(r->reader->context,
               "%s: %s: mended: its integers are taken as normalised, though it does not say so",
               r->reader->model->path, what);
    return LIMN_BAKE_OK;
}

/// Colours may have an alpha, which is dropped.
static limn_bake_status read_set(const reading *r, int index, const char *name, uint32_t width,
                                 limni_model_set *set) {
    limni_context *const context = r->reader->context;
    const uint32_t count = r->part->vertex_count;
    const limni_gltf_accessor *accessor;
    char what[192];
    snprintf(what, sizeof what, "%s of %s", name, r->part->label);
    LIMNI_TRY(limni_gltf_find_accessor(r->reader, index, what, &accessor));
    float scale = 1;
    if (width == 3) LIMNI_TRY(find_colour_scale(r, accessor, what, &scale));
    const uint32_t given = width == 3 && accessor->component_count == 4 ? 4 : width;
    float *const values = limni_allocate(context, (size_t)count * given, sizeof *values);
    set->values = limni_allocate_zeroed(context, count, sizeof *set->values);
    if (!values || !set->values) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_gltf_read_floats(r->reader, index, what, count, given, values));
    for (size_t v = 0; v < count; v++) {
        for (uint32_t k = 0; k < width; k++)
            set->values[v][k] = values[v * given + k] * scale;
        set->has_alpha |= given == 4 && values[v * given + 3] * scale != 1;
    }
    limni_release(context, values);
    return LIMN_BAKE_OK;
}

/// TEXCOORD_n or COLOR_n, from 0 on.
static limn_bake_status read_sets(const reading *r, const char *stem, uint32_t width,
                                  limni_model_set **sets, uint32_t *count) {
    attribute_name name;
    while (find(r, name, stem, *count) >= 0)
        ++*count;
    *sets = limni_allocate_zeroed(r->reader->context, *count, sizeof **sets);
    if (!*sets) return LIMN_BAKE_MEMORY;
    for (uint32_t set = 0; set < *count; set++) {
        const int index = find(r, name, stem, set);
        LIMNI_TRY(read_set(r, index, name, width, &(*sets)[set]));
    }
    return LIMN_BAKE_OK;
}

// ---- Influences

enum { INFLUENCES_OF_SET = 4 };

/// JOINTS_n and WEIGHTS_n.
static limn_bake_status read_influence_set(const reading *r, uint32_t set) {
    limni_context *const context = r->reader->context;
    limni_model_part *const part = r->part;
    const uint32_t count = INFLUENCES_OF_SET * part->vertex_count;
    attribute_name names[2];
    const int accessors[2] = {find(r, names[0], "JOINTS", set), find(r, names[1], "WEIGHTS", set)};
    char what[2][192];
    uint32_t *const joints = limni_allocate(context, count, sizeof *joints);
    float *const weights = limni_allocate(context, count, sizeof *weights);
    if (!joints || !weights) return LIMN_BAKE_MEMORY;
    for (int k = 0; k < 2; k++)
        snprintf(what[k], sizeof what[k], "%s of %s", names[k], part->label);
    LIMNI_TRY(limni_gltf_read_integers(r->reader, accessors[0], what[0], part->vertex_count,
                                       INFLUENCES_OF_SET, joints));
    LIMNI_TRY(limni_gltf_read_floats(r->reader, accessors[1], what[1], part->vertex_count,
                                     INFLUENCES_OF_SET, weights));
    for (uint32_t i = 0; i < count; i++) {
        if (weights[i] == 0) continue;
        part->influences[part->influence_count++] =
            (limni_model_influence){i / INFLUENCES_OF_SET, joints[i], weights[i]};
    }
    limni_release(context, joints);
    limni_release(context, weights);
    return LIMN_BAKE_OK;
}

static limn_bake_status read_influences(const reading *r) {
    limni_model_part *const part = r->part;
    attribute_name name;
    uint32_t sets = 0;
    while (find(r, name, "JOINTS", sets) >= 0 && find(r, name, "WEIGHTS", sets) >= 0)
        sets++;
    if ((find(r, name, "JOINTS", sets) >= 0) != (find(r, name, "WEIGHTS", sets) >= 0))
        limni_note(r->reader->context,
                   "%s: %s: it has JOINTS_%u or WEIGHTS_%u, but not both; they are passed over",
                   r->reader->model->path, part->label, sets, sets);
    if ((uint64_t)INFLUENCES_OF_SET * sets * part->vertex_count > UINT32_MAX)
        return limni_fail(r->reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: too many influences",
                          r->reader->model->path, part->label);
    part->influences =
        limni_allocate(r->reader->context, (size_t)INFLUENCES_OF_SET * sets * part->vertex_count,
                       sizeof *part->influences);
    if (!part->influences) return LIMN_BAKE_MEMORY;
    for (uint32_t set = 0; set < sets; set++)
        LIMNI_TRY(read_influence_set(r, set));
    return LIMN_BAKE_OK;
}

// ---- Morph targets

static limn_bake_status read_targets(const reading *r) {
    limni_model_part *const part = r->part;
    part->target_count = r->primitive->target_count;
    part->targets =
        limni_allocate_zeroed(r->reader->context, part->target_count, sizeof *part->targets);
    if (!part->targets) return LIMN_BAKE_MEMORY;
    for (uint32_t t = 0; t < part->target_count; t++) {
        char of[48];
        snprintf(of, sizeof of, "morph target %u of ", t);
        LIMNI_TRY(read_places(r, &r->primitive->targets[t], of, &part->targets[t]));
    }
    return LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_attributes(const limni_gltf_reader *reader,
                                            const limni_gltf_primitive *primitive,
                                            limni_model_part *part) {
    const reading r = {reader, primitive, part};
    LIMNI_TRY(read_places(&r, &primitive->attributes, "", &part->positions));
    LIMNI_TRY(read_sets(&r, "TEXCOORD", 2, &part->uvs, &part->uv_count));
    LIMNI_TRY(read_sets(&r, "COLOR", 3, &part->colours, &part->colour_count));
    LIMNI_TRY(read_influences(&r));
    return read_targets(&r);
}
