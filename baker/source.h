/* SPDX-License-Identifier: MIT */
/* A polygon mesh as it was read, with the line that everything came from. */
#ifndef LIMNI_SOURCE_H
#define LIMNI_SOURCE_H

#include "context.h"

typedef struct limni_source {
    uint32_t index_base;        ///< of the file's own numbering, for messages: 1 in OBJ, else 0
    const char *name;           ///< of the mesh: the file's name without folder and extension
    const char *path;           ///< as the user wrote it, for messages; NULL for a mesh from memory
    float (*positions)[3];      ///< [position_count], finite
    uint32_t *position_numbers; ///< [position_count] as read, from 0, after a weld; else NULL
    uint32_t *position_lines;   ///< [position_count], from 1; NULL for a mesh from memory
    uint32_t position_count;
    uint32_t face_count;
    uint32_t
        *face_offsets; ///< [face_count + 1] into face_corners; every face has at least 3 corners
    uint32_t *face_corners; ///< position indices from 0, each < position_count
    uint32_t *face_numbers; ///< [face_count] as read, from 0, set when faces are checked
    uint32_t *face_lines;   ///< [face_count], from 1; NULL for a mesh from memory
} limni_source;

/// Reads a mesh file by its extension, .obj or .off (in any case). The arrays belong to the
/// context.
limn_bake_status limni_read_file(limni_context *context, const char *path, limni_source *source);

/// Readers of one format: `text` is the whole file, text[size] == '\0', and may hold anything,
/// zeros included. `source->path` is set and names the file in errors.
limn_bake_status limni_read_obj(limni_context *context, const char *text, size_t size,
                                limni_source *source);
limn_bake_status limni_read_off(limni_context *context, const char *text, size_t size,
                                limni_source *source);

#endif
