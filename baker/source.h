/* SPDX-License-Identifier: MIT */
/* A polygon mesh and its tags as they were read, with the line that everything came from. */
#ifndef LIMNI_SOURCE_H
#define LIMNI_SOURCE_H

#include "context.h"
#include "limn/format.h"

/// Sharpness is not negative; from LIMNI_SHARP_FOR_EVER on, infinity included, it does not fall.
/// Vertices and faces are numbered from 0 as read, and need not be there. `line` is from 1; 0 for a
/// mesh from memory.
typedef struct limni_crease {
    uint32_t a, b; ///< positions
    float sharpness;
    uint32_t line;
} limni_crease;

typedef struct limni_sharp_vertex {
    uint32_t position;
    float sharpness;
    uint32_t line;
} limni_sharp_vertex;

typedef struct limni_hole {
    uint32_t face;
    uint32_t line;
} limni_hole;

#define LIMNI_SHARP_FOR_EVER 10.0f

/// What is said about a mesh beyond its polygons, in the order of the file: of two tags of one
/// thing the later counts.
typedef struct limni_tags {
    limni_crease *creases;
    limni_sharp_vertex *sharp_vertices;
    limni_hole *holes;
    uint32_t crease_count, sharp_vertex_count, hole_count;
    limn_boundary boundary; ///< LIMN_BOUNDARY_DEFAULT: nothing is said
    limn_creasing creasing; ///< LIMN_CREASING_DEFAULT: nothing is said
    bool is_lomont;         ///< whether the format is Lomont's, and tags meant for his rules
} limni_tags;

/// Values that belong to the corners of faces, such as texture coordinates: vertices on a seam have
/// several. Faces that share a value at a vertex are smooth across their edge there.
typedef struct limni_source_channel {
    const char *name; ///< such as "uv"
    limn_channel_kind kind;
    uint32_t component_count; ///< 1 to 3
    float (*values)[3];       ///< [value_count], finite; further components are 0
    uint32_t value_count;
    uint32_t *corner_values; ///< parallel to face_corners, each < value_count
} limni_source_channel;

/// What moves the positions of a source, beside the program.
typedef struct limni_rig {
    uint32_t influence_count; ///< on each position; 0: no joints move them
    uint16_t *joints;         ///< [position_count][influence_count] of the file's skeleton
    float *weights;           ///< likewise; as limn_skin_normalise() leaves them
    uint32_t target_count;
    limn_file_target *targets; ///< [target_count]
    float (*deltas)[3];        ///< [position_count][target_count]
} limni_rig;

typedef struct limni_source {
    uint32_t index_base;        ///< of the file's own numbering, for messages: 1 in OBJ, else 0
    const char *name;           ///< of the mesh: the file's name without folder and extension
    const char *path;           ///< as the user wrote it, for messages; NULL for a mesh from memory
    float (*positions)[3];      ///< [position_count], finite
    uint32_t *position_numbers; ///< [position_count] as read, from 0, after a weld; else NULL
    uint32_t
        *position_lines; ///< [position_count], from 1; NULL for a mesh from memory, or in binary
    uint32_t position_count;
    uint32_t face_count;
    uint32_t
        *face_offsets; ///< [face_count + 1] into face_corners; every face has at least 3 corners
    uint32_t *face_corners;         ///< position indices from 0, each < position_count
    uint32_t *face_numbers;         ///< [face_count] as read, from 0, set when faces are checked
    uint32_t *face_lines;           ///< [face_count], from 1; NULL likewise
    uint32_t *face_materials;       ///< [face_count] of the file, or LIMN_FORMAT_NONE; NULL: none
    limni_source_channel *channels; ///< [channel_count]
    uint32_t channel_count;
    limni_rig rig;
    limni_tags tags;
} limni_source;

/// Reads the mesh of a file by its extension, as limni_read_scene() does. Fails where there are
/// several. The arrays belong to the context.
limn_bake_status limni_read_file(limni_context *context, const char *path, limni_source *source);

/// The same, but of several meshes the first with this name.
limn_bake_status limni_read_mesh(limni_context *context, const char *path, const char *name,
                                 limni_source *source);

/// Makes values that are equal the same, each the first of them, and 0 of -0.
///
/// values   [*count] those that are left move up
/// moved    out: [*count] the new index of each
/// numbers  out: [the new count] the old index of those that are left; or NULL
limn_bake_status limni_merge_equal(limni_context *context, float (*values)[3], uint32_t *count,
                                   uint32_t *moved, uint32_t *numbers);

/// The same for the values of a channel.
///
/// corner_count  of all faces
limn_bake_status limni_weld_channel(limni_context *context, limni_source_channel *channel,
                                    uint32_t corner_count);

/// Whether the path ends with an extension, in any case. lower: with its dot, in lower case
bool limni_has_extension(const char *path, const char *lower);

/// Readers of one format: `text` is the whole file, text[size] == '\0', and may hold anything,
/// zeros included. `source->path` is set and names the file in errors. An OBJ that begins as
/// Lomont's does (read_lomont.h) is read as such.
limn_bake_status limni_read_obj(limni_context *context, const char *text, size_t size,
                                limni_source *source);
limn_bake_status limni_read_off(limni_context *context, const char *text, size_t size,
                                limni_source *source);
limn_bake_status limni_read_ply(limni_context *context, const char *text, size_t size,
                                limni_source *source);

#endif
