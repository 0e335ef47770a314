/* SPDX-License-Identifier: MIT */
/* Appends to a source, for readers that do not know how much there will be. */
#ifndef LIMNI_SOURCE_BUILDER_H
#define LIMNI_SOURCE_BUILDER_H

#include "source.h"

typedef struct limni_channel_room {
    size_t values, corners;
} limni_channel_room;

typedef struct limni_source_builder {
    limni_context *context;
    limni_source *source;
    uint32_t corner_count; ///< of all faces, with the one that is being built
    size_t positions_room, faces_room, corners_room; ///< in items, as the next ones
    size_t creases_room, sharp_vertices_room, holes_room;
    size_t channels_room, channel_rooms_room;
    limni_channel_room *channel_rooms; ///< [channel_count]
} limni_source_builder;

/// Starts with an empty source, but for its name and path.
limni_source_builder limni_builder_begin(limni_context *context, limni_source *source);

/// Frees what the builder needed; the source stays.
void limni_builder_end(limni_source_builder *builder);

/// Each fails with LIMN_BAKE_MEMORY only. Counts must stay below 2^32: files are shorter.
limn_bake_status limni_builder_add_position(limni_source_builder *builder, const float position[3],
                                            uint32_t line);
limn_bake_status limni_builder_add_crease(limni_source_builder *builder, limni_crease crease);
limn_bake_status limni_builder_add_sharp_vertex(limni_source_builder *builder,
                                                limni_sharp_vertex vertex);
limn_bake_status limni_builder_add_hole(limni_source_builder *builder, limni_hole hole);

/// A face is built of its corners, in order, and then ended.
limn_bake_status limni_builder_add_corner(limni_source_builder *builder, uint32_t position);
limn_bake_status limni_builder_end_face(limni_source_builder *builder, uint32_t line);

/// Appends a channel without values: it is the last of the source.
///
/// name  must outlive the source
limn_bake_status limni_builder_add_channel(limni_source_builder *builder, const char *name,
                                           limn_channel_kind kind, uint32_t component_count);
limn_bake_status limni_builder_add_value(limni_source_builder *builder, uint32_t channel,
                                         const float value[3]);
/// The value of the corner that was added last. Every corner needs one in each channel.
/// LIMNI_NO_VALUE may stand for it until all have been added.
#define LIMNI_NO_VALUE 0xffffffffu
limn_bake_status limni_builder_set_corner_value(limni_source_builder *builder, uint32_t channel,
                                                uint32_t value);

/// `items` with room for at least one more than `count`, or NULL when out of memory. room: how many
/// there is room for, which grows
void *limni_make_room(limni_context *context, void *items, size_t count, size_t *room, size_t size);

/// Corners since the last face was ended.
uint32_t limni_builder_face_size(const limni_source_builder *builder);

#endif
