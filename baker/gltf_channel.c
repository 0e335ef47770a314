/* SPDX-License-Identifier: MIT */
/* Texture coordinates and colours. Corners at one position that agree on a value share it. */
#include "gltf_vertices.h"

#include "mesh.h"

#include <stdio.h>
#include <string.h>

/// A channel at work.
typedef struct reading {
    const limni_gltf_vertices *vertices;
    limn_channel_kind kind;
    char attribute[32];
    float (*values)[3];                  ///< by vertex
    uint32_t missing_count, alpha_count; ///< parts without it; vertices whose alpha is not 1
} reading;

/// The values of a part. Colours may have an alpha, which is dropped.
static limn_bake_status read_part(reading *r, const limni_gltf_part *part) {
    limni_gltf_reader *const reader = r->vertices->reader;
    const int index = limni_gltf_attribute_of(&part->primitive->attributes, r->attribute);
    const limni_gltf_accessor *accessor;
    char what[192];
    if (index < 0) {
        r->missing_count++;
        return LIMN_BAKE_OK;
    }
    snprintf(what, sizeof what, "%s of %s", r->attribute, part->label);
    LIMNI_TRY(limni_gltf_find_accessor(reader, index, what, &accessor));
    const uint32_t least = r->kind == LIMN_CHANNEL_UV ? 2 : 3;
    const bool alpha = least == 3 && accessor->component_count == 4;
    const uint32_t width = alpha ? 4 : least;
    float *const values =
        limni_allocate(reader->context, (size_t)part->count * width, sizeof *values);
    if (!values) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_gltf_read_floats(reader, index, what, part->count, width, values));
    for (uint32_t i = 0; i < part->count; i++) {
        for (uint32_t k = 0; k < least; k++)
            r->values[part->first + i][k] = values[(size_t)i * width + k] + 0.0f;
        r->alpha_count += alpha && values[(size_t)i * width + 3] != 1;
    }
    limni_release(reader->context, values);
    return LIMN_BAKE_OK;
}

/// Values that are equal at one position are one.
static limn_bake_status make_channel(const reading *r, const uint32_t *corners,
                                     uint32_t corner_count, limni_source_channel *channel) {
    limni_context *const context = r->vertices->reader->context;
    const uint32_t count = r->vertices->count;
    typedef struct placed {
        uint32_t position;
        float value[3];
    } placed;
    placed *const records = limni_allocate(context, count, sizeof *records);
    uint32_t *const moved = limni_allocate(context, count, sizeof *moved);
    channel->corner_values = limni_allocate(context, corner_count, sizeof(uint32_t));
    if (!records || !moved || !channel->corner_values) return LIMN_BAKE_MEMORY;
    for (uint32_t v = 0; v < count; v++) {
        records[v].position = r->vertices->moved[v];
        memcpy(records[v].value, r->values[v], sizeof *r->values);
    }
    channel->value_count = limni_gltf_merge(context, records, sizeof *records, count, moved);
    if (channel->value_count == UINT32_MAX) return LIMN_BAKE_MEMORY;
    channel->values = limni_allocate(context, channel->value_count, sizeof *channel->values);
    if (!channel->values) return LIMN_BAKE_MEMORY;
    for (uint32_t v = 0; v < count; v++)
        memcpy(channel->values[moved[v]], r->values[v], sizeof *channel->values);
    for (uint32_t c = 0; c < corner_count; c++)
        channel->corner_values[c] = moved[corners[c]];
    limni_release(context, records);
    limni_release(context, moved);
    return LIMN_BAKE_OK;
}

static void note_incomplete(const reading *r) {
    const limni_gltf_reader *const reader = r->vertices->reader;
    const char *const path = reader->document->path, *const label = r->vertices->label;
    if (r->missing_count)
        limni_note(reader->context, "%s: %s: %u primitives have no %s, and get 0", path, label,
                   r->missing_count, r->attribute);
    if (r->alpha_count)
        limni_note(reader->context, "%s: %s: the alpha of %s is dropped", path, label,
                   r->attribute);
}

static bool is_anywhere(const limni_gltf_vertices *vertices, const char *attribute) {
    for (uint32_t p = 0; p < vertices->part_count; p++) {
        if (limni_gltf_attribute_of(&vertices->parts[p].primitive->attributes, attribute) >= 0)
            return true;
    }
    return false;
}

/// "uv", "uv1" and so on. The name belongs to the context.
static char *name_channel(limni_context *context, limn_channel_kind kind, uint32_t set) {
    char *const name = limni_allocate(context, 32, 1);
    const char *const stem = kind == LIMN_CHANNEL_UV ? "uv" : "colour";
    if (name) snprintf(name, 32, set ? "%s%u" : "%s", stem, set);
    return name;
}

static limn_bake_status add_channel(reading *r, uint32_t set, const uint32_t *corners,
                                    uint32_t corner_count, limni_source *source) {
    limni_context *const context = r->vertices->reader->context;
    limni_source_channel channel = {.name = name_channel(context, r->kind, set),
                                    .kind = r->kind,
                                    .component_count = r->kind == LIMN_CHANNEL_UV ? 2 : 3};
    limni_source_channel *const channels = limni_resize(
        context, source->channels, source->channel_count + UINT64_C(1), sizeof *channels);
    r->values = limni_allocate_zeroed(context, r->vertices->count, sizeof *r->values);
    if (!channel.name || !channels || !r->values) return LIMN_BAKE_MEMORY;
    source->channels = channels;
    for (uint32_t p = 0; p < r->vertices->part_count; p++)
        LIMNI_TRY(read_part(r, &r->vertices->parts[p]));
    LIMNI_TRY(make_channel(r, corners, corner_count, &channel));
    channels[source->channel_count++] = channel;
    note_incomplete(r);
    limni_release(context, r->values);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_channels(const limni_gltf_vertices *vertices,
                                          const uint32_t *corners, uint32_t corner_count,
                                          limni_source *source) {
    static const char *const stems[] = {
        [LIMN_CHANNEL_UV] = "TEXCOORD", [LIMN_CHANNEL_COLOUR] = "COLOR"};
    for (uint32_t kind = 0; kind < sizeof stems / sizeof *stems; kind++) {
        for (uint32_t set = 0;; set++) {
            reading r = {.vertices = vertices, .kind = (limn_channel_kind)kind};
            snprintf(r.attribute, sizeof r.attribute, "%s_%u", stems[kind], set);
            if (!is_anywhere(vertices, r.attribute)) break;
            LIMNI_TRY(add_channel(&r, set, corners, corner_count, source));
        }
    }
    return LIMN_BAKE_OK;
}
