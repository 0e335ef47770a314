/* SPDX-License-Identifier: MIT */
/* Texture coordinates and colours. Corners at one position that agree on a value share it. */
#include "model_vertices.h"

#include "mesh.h"

#include <stdio.h>
#include <string.h>

/// A channel at work.
typedef struct reading {
    const limni_model_vertices *vertices;
    limn_channel_kind kind;
    uint32_t set;
    const char *name;
    float (*values)[3];     ///< by vertex
    uint32_t missing_count; ///< parts without it
    bool has_alpha;
} reading;

/// The set of a part; NULL: it has none.
static const limni_model_set *find_set(const limni_model_part *part, limn_channel_kind kind,
                                       uint32_t set) {
    const bool uv = kind == LIMN_CHANNEL_UV;
    const limni_model_set *const sets = uv ? part->uvs : part->colours;
    const uint32_t count = uv ? part->uv_count : part->colour_count;
    return set < count && sets[set].values ? &sets[set] : NULL;
}

static void read_part(reading *r, const limni_model_part *part) {
    const limni_model_set *const set = find_set(part, r->kind, r->set);
    r->missing_count += !set;
    r->has_alpha |= set && set->has_alpha;
    for (uint32_t v = 0; set && v < part->vertex_count; v++) {
        for (int k = 0; k < 3; k++)
            r->values[part->first + v][k] = set->values[v][k] + 0.0f;
    }
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
    channel->value_count = limni_model_merge(context, records, sizeof *records, count, moved);
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
    const limni_model_reader *const reader = r->vertices->reader;
    const char *const path = reader->model->path, *const label = r->vertices->label;
    if (r->missing_count)
        limni_note(reader->context, "%s: %s: %u of its %u parts have no %s, and get 0", path, label,
                   r->missing_count, r->vertices->mesh->part_count, r->name);
    if (r->has_alpha)
        limni_note(reader->context, "%s: %s: the alpha of %s is dropped", path, label, r->name);
}

static bool is_anywhere(const limni_model_mesh *mesh, limn_channel_kind kind, uint32_t set) {
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        if (find_set(&mesh->parts[p], kind, set)) return true;
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

static limn_bake_status add_channel(reading *r, const uint32_t *corners, uint32_t corner_count,
                                    limni_source *source) {
    limni_context *const context = r->vertices->reader->context;
    const limni_model_mesh *const mesh = r->vertices->mesh;
    r->name = name_channel(context, r->kind, r->set);
    r->values = limni_allocate_zeroed(context, r->vertices->count, sizeof *r->values);
    limni_source_channel *const channels = limni_resize(
        context, source->channels, source->channel_count + UINT64_C(1), sizeof *channels);
    if (!r->name || !channels || !r->values) return LIMN_BAKE_MEMORY;
    source->channels = channels;
    limni_source_channel channel = {
        .name = r->name, .kind = r->kind, .component_count = r->kind == LIMN_CHANNEL_UV ? 2 : 3};
    for (uint32_t p = 0; p < mesh->part_count; p++)
        read_part(r, &mesh->parts[p]);
    LIMNI_TRY(make_channel(r, corners, corner_count, &channel));
    channels[source->channel_count++] = channel;
    note_incomplete(r);
    limni_release(context, r->values);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_model_read_channels(const limni_model_vertices *vertices,
                                           const uint32_t *corners, uint32_t corner_count,
                                           limni_source *source) {
    static const limn_channel_kind kinds[] = {LIMN_CHANNEL_UV, LIMN_CHANNEL_COLOUR};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        for (uint32_t set = 0; is_anywhere(vertices->mesh, kinds[k], set); set++) {
            reading r = {.vertices = vertices, .kind = kinds[k], .set = set};
            LIMNI_TRY(add_channel(&r, corners, corner_count, source));
        }
    }
    return LIMN_BAKE_OK;
}
