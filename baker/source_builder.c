/* SPDX-License-Identifier: MIT */
#include "source_builder.h"

#include <string.h>

limni_source_builder limni_builder_begin(limni_context *context, limni_source *source) {
    *source = (limni_source){.name = source->name, .path = source->path};
    return (limni_source_builder){.context = context, .source = source};
}

void limni_builder_end(limni_source_builder *builder) {
    limni_release(builder->context, builder->channel_rooms);
    builder->channel_rooms = NULL;
}

void *limni_make_room(limni_context *context, void *items, size_t count, size_t *room,
                      size_t size) {
    if (count < *room) return items;
    const size_t larger = *room == 0 ? 256 : 2 * *room;
    void *const moved = limni_resize(context, items, larger, size);
    if (moved) *room = larger;
    return moved;
}

limn_bake_status limni_builder_add_position(limni_source_builder *builder, const float position[3],
                                            uint32_t line) {
    limni_source *const source = builder->source;
    const uint32_t count = source->position_count;
    size_t lines_room = builder->positions_room;
    void *const positions = limni_make_room(builder->context, source->positions, count,
                                            &builder->positions_room, sizeof *source->positions);
    if (!positions) return LIMN_BAKE_MEMORY;
    source->positions = positions;
    uint32_t *const lines = limni_make_room(builder->context, source->position_lines, count,
                                            &lines_room, sizeof *source->position_lines);
    if (!lines) return LIMN_BAKE_MEMORY;
    source->position_lines = lines;
    memcpy(source->positions[count], position, sizeof *source->positions);
    lines[count] = line;
    source->position_count++;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_builder_add_corner(limni_source_builder *builder, uint32_t position) {
    uint32_t *const corners =
        limni_make_room(builder->context, builder->source->face_corners, builder->corner_count,
                        &builder->corners_room, sizeof *corners);
    if (!corners) return LIMN_BAKE_MEMORY;
    builder->source->face_corners = corners;
    corners[builder->corner_count++] = position;
    return LIMN_BAKE_OK;
}

uint32_t limni_builder_face_size(const limni_source_builder *builder) {
    const limni_source *const source = builder->source;
    return builder->corner_count -
           (source->face_offsets ? source->face_offsets[source->face_count] : 0);
}

limn_bake_status limni_builder_end_face(limni_source_builder *builder, uint32_t line) {
    limni_source *const source = builder->source;
    const uint32_t count = source->face_count;
    size_t lines_room = builder->faces_room;
    // One offset more than faces.
    uint32_t *const offsets = limni_make_room(builder->context, source->face_offsets, count + 1,
                                              &builder->faces_room, sizeof *offsets);
    if (!offsets) return LIMN_BAKE_MEMORY;
    source->face_offsets = offsets;
    uint32_t *const lines = limni_make_room(builder->context, source->face_lines, count + 1,
                                            &lines_room, sizeof *lines);
    if (!lines) return LIMN_BAKE_MEMORY;
    source->face_lines = lines;
    if (count == 0) offsets[0] = 0;
    offsets[count + 1] = builder->corner_count;
    lines[count] = line;
    source->face_count++;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_builder_add_crease(limni_source_builder *builder, limni_crease crease) {
    limni_tags *const tags = &builder->source->tags;
    limni_crease *const creases =
        limni_make_room(builder->context, tags->creases, tags->crease_count, &builder->creases_room,
                        sizeof *creases);
    if (!creases) return LIMN_BAKE_MEMORY;
    tags->creases = creases;
    creases[tags->crease_count++] = crease;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_builder_add_sharp_vertex(limni_source_builder *builder,
                                                limni_sharp_vertex vertex) {
    limni_tags *const tags = &builder->source->tags;
    limni_sharp_vertex *const vertices =
        limni_make_room(builder->context, tags->sharp_vertices, tags->sharp_vertex_count,
                        &builder->sharp_vertices_room, sizeof *vertices);
    if (!vertices) return LIMN_BAKE_MEMORY;
    tags->sharp_vertices = vertices;
    vertices[tags->sharp_vertex_count++] = vertex;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_builder_add_hole(limni_source_builder *builder, limni_hole hole) {
    limni_tags *const tags = &builder->source->tags;
    limni_hole *const holes = limni_make_room(builder->context, tags->holes, tags->hole_count,
                                              &builder->holes_room, sizeof *holes);
    if (!holes) return LIMN_BAKE_MEMORY;
    tags->holes = holes;
    holes[tags->hole_count++] = hole;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_builder_add_channel(limni_source_builder *builder, const char *name,
                                           limn_channel_kind kind, uint32_t component_count) {
    limni_source *const source = builder->source;
    limni_source_channel *const channels =
        limni_make_room(builder->context, source->channels, source->channel_count,
                        &builder->channels_room, sizeof *channels);
    if (!channels) return LIMN_BAKE_MEMORY;
    source->channels = channels;
    limni_channel_room *const rooms =
        limni_make_room(builder->context, builder->channel_rooms, source->channel_count,
                        &builder->channel_rooms_room, sizeof *rooms);
    if (!rooms) return LIMN_BAKE_MEMORY;
    builder->channel_rooms = rooms;
    rooms[source->channel_count] = (limni_channel_room){0};
    channels[source->channel_count++] =
        (limni_source_channel){.name = name, .kind = kind, .component_count = component_count};
    return LIMN_BAKE_OK;
}

limn_bake_status limni_builder_add_value(limni_source_builder *builder, uint32_t channel,
                                         const float value[3]) {
    limni_source_channel *const to = &builder->source->channels[channel];
    void *const values =
        limni_make_room(builder->context, to->values, to->value_count,
                        &builder->channel_rooms[channel].values, sizeof *to->values);
    if (!values) return LIMN_BAKE_MEMORY;
    to->values = values;
    memcpy(to->values[to->value_count++], value, sizeof *to->values);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_builder_set_corner_value(limni_source_builder *builder, uint32_t channel,
                                                uint32_t value) {
    limni_source_channel *const to = &builder->source->channels[channel];
    const uint32_t corner = builder->corner_count - 1;
    uint32_t *const corner_values =
        limni_make_room(builder->context, to->corner_values, corner,
                        &builder->channel_rooms[channel].corners, sizeof *corner_values);
    if (!corner_values) return LIMN_BAKE_MEMORY;
    to->corner_values = corner_values;
    corner_values[corner] = value;
    return LIMN_BAKE_OK;
}
