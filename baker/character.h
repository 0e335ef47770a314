/* SPDX-License-Identifier: MIT */
/*
 * What a file has for its characters beside their meshes, as the records that are written: joints,
 * clips and materials of all that is baked, appended as they are read.
 */
#ifndef LIMNI_BAKER_CHARACTER_H
#define LIMNI_BAKER_CHARACTER_H

#include "context.h"
#include "limn/format.h"

/// Items that are appended to, and how many there is room for.
typedef struct limni_list {
    void *items;
    uint32_t count;
    size_t room;
} limni_list;

/// All zero is an empty one.
typedef struct limni_character {
    limni_list strings;     ///< char
    limni_list joints;      ///< limn_file_joint
    limni_list clips;       ///< limn_file_clip
    limni_list tracks;      ///< limn_file_track
    limni_list keys;        ///< float
    limni_list materials;   ///< limn_file_material
    limni_list images;      ///< limn_file_image
    limni_list image_bytes; ///< unsigned char
} limni_character;

/// Appends `count` items; fails where there would be more than 32 bits can count.
limn_bake_status limni_list_add(limni_context *context, limni_list *list, const void *items,
                                size_t count, size_t size);

/// Appends a text and says where it starts; the same text may be there several times.
limn_bake_status limni_character_add_text(limni_context *context, limni_character *character,
                                          const char *text, uint32_t *offset);

#endif
