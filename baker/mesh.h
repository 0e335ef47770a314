/* SPDX-License-Identifier: MIT */
/*
 * The control mesh: polygons and array-based half-edges, after Lomont's layout ("High Performance
 * Subdivision Surfaces", 2007). Half-edges offsets[f] + k run from corner k of face f to the next
 * corner; ends follow from the index, so only the pairs are stored.
 */
#ifndef LIMNI_MESH_H
#define LIMNI_MESH_H

#include "limn/limn.h"
#include "source.h"

#define LIMNI_NONE 0xffffffffu

/// Vertices, and corners of all faces, of a source: half-edges, and hash tables of twice as many,
/// fit in 32 bits, and faces in the 30 bits that the file has for them.
#define LIMNI_CORNERS_MAX (1u << 28)

typedef struct limni_mesh {
    const struct limni_mesh *divided; ///< the mesh that one level of subdivision made this of,
                                      ///< which has its first control points; NULL: of the source
    const char *name;
    const char *path;                ///< NULL for a mesh from memory
    const uint32_t *control_numbers; ///< of the source, as read, from 0; NULL: the index
    const uint32_t *control_lines;   ///< of the source, or NULL
    const uint32_t *face_numbers;    ///< by polygon, as read, from 0
    const uint32_t *face_lines;      ///< by polygon, or NULL
    const uint32_t *face_materials;  ///< by polygon, or NULL: see limni_source
    uint32_t index_base;
    limn_domain_kind domain; ///< what faces become patches of; polygons other than quads are
                             ///< divided first
    uint32_t control_count;
    uint32_t face_count;
    float (*controls)[3]; ///< [control_count]
    uint32_t *origins; ///< [control_count] where a mesh was split, the control point of the source
                       ///< that each is, ascending; NULL: the index
    uint32_t half_edge_count;
    uint32_t *offsets; ///< [face_count + 1] the first half-edge of each face
    uint32_t *corners; ///< [half_edge_count] control points, counter-clockwise around each face
    uint32_t *source_corners; ///< [half_edge_count] the corner of the source that each starts from
    uint32_t *face_of;        ///< [half_edge_count]
    uint32_t *polygons;       ///< [face_count] the source face that a face came from
    uint32_t *pairs;    ///< [half_edge_count] the opposite half-edge, or LIMNI_NONE on a boundary
    uint32_t *first;    ///< [control_count] a half-edge that starts here, or LIMNI_NONE if unused;
                        ///< on a boundary the clockwise-most one
    uint32_t *valences; ///< [control_count] edges
    float *
        edge_sharpness; ///< [half_edge_count] by half-edge, the same for both of a pair; 0: smooth;
                        ///< from LIMNI_SHARP_FOR_EVER on, infinity included, it does not fall.
                        ///< Diagonals of polygons are smooth. Boundaries count as boundaries
                        ///< alone, and have 0 too unless a tag names them
    float *vertex_sharpness; ///< [control_count] likewise
    bool *holes; ///< [face_count] faces that shape the surface around them but are not drawn
    uint32_t hole_count;
    limn_boundary boundary; ///< asked for by the mesh; LIMN_BOUNDARY_DEFAULT: it says nothing
    limn_creasing creasing; ///< likewise
} limni_mesh;

static inline uint32_t limni_face_size(const limni_mesh *mesh, uint32_t face) {
    return mesh->offsets[face + 1] - mesh->offsets[face];
}
static inline uint32_t limni_half_edge_next(const limni_mesh *mesh, uint32_t h) {
    const uint32_t face = mesh->face_of[h];
    return h + 1 < mesh->offsets[face + 1] ? h + 1 : mesh->offsets[face];
}
static inline uint32_t limni_half_edge_previous(const limni_mesh *mesh, uint32_t h) {
    const uint32_t face = mesh->face_of[h];
    return (h > mesh->offsets[face] ? h : mesh->offsets[face + 1]) - 1;
}
static inline uint32_t limni_half_edge_start(const limni_mesh *mesh, uint32_t h) {
    return mesh->corners[h];
}
static inline uint32_t limni_half_edge_end(const limni_mesh *mesh, uint32_t h) {
    return mesh->corners[limni_half_edge_next(mesh, h)];
}
/// The next half-edge counter-clockwise around the start of `h`; LIMNI_NONE past a boundary.
static inline uint32_t limni_half_edge_turn(const limni_mesh *mesh, uint32_t h) {
    return mesh->pairs[limni_half_edge_previous(mesh, h)];
}
static inline bool limni_is_boundary(const limni_mesh *mesh, uint32_t control) {
    const uint32_t h = mesh->first[control];
    return h != LIMNI_NONE && mesh->pairs[h] == LIMNI_NONE;
}

/// Edges of the vertex that has most.
static inline uint32_t limni_valence_max(const limni_mesh *mesh) {
    uint32_t most = 0;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        most = mesh->valences[c] > most ? mesh->valences[c] : most;
    return most;
}

/// What errors and notes call the mesh.
static inline const char *limni_mesh_label(const limni_mesh *mesh) {
    return mesh->path ? mesh->path : mesh->name;
}

/// The control point before the mesh was split.
static inline uint32_t limni_origin(const limni_mesh *mesh, uint32_t control) {
    return mesh->origins ? mesh->origins[control] : control;
}

/// Whether the control point is one of several that were one.
static inline bool limni_is_split(const limni_mesh *mesh, uint32_t control) {
    const uint32_t *const origins = mesh->origins;
    if (!origins) return false;
    return (control > 0 && origins[control - 1] == origins[control]) ||
           (control + 1 < mesh->control_count && origins[control + 1] == origins[control]);
}

/// "face 12 (line 40)", in the file's own numbering. Of a mesh that was divided "a part of face 12
/// (line 40)", and where a vertex is new, "a vertex of the divided mesh". Returns `text`.
typedef char limni_place[64];
const char *limni_face_place(const limni_mesh *mesh, uint32_t face, limni_place text);
const char *limni_control_place(const limni_mesh *mesh, uint32_t control, limni_place text);

/// Frees all but the positions.
void limni_mesh_end(limni_context *context, const limni_mesh *mesh);

/// Sets half_edge_count and face_of from the offsets.
limn_bake_status limni_index_half_edges(limni_context *context, limni_mesh *mesh);

/// The steps from a source to a mesh, in this order. Each fails with LIMN_BAKE_BAD_INPUT on what it
/// cannot take, unless context->desc allows it to mend or split it.
limn_bake_status limni_check_tags(limni_context *context, limni_source *source);
limn_bake_status limni_weld(limni_context *context, limni_source *source);
limn_bake_status limni_check_faces(limni_context *context, limni_source *source);
limn_bake_status limni_make_faces(limni_context *context, const limni_source *source,
                                  limni_mesh *mesh);
limn_bake_status limni_tag_mesh(limni_context *context, const limni_source *source,
                                limni_mesh *mesh);
/// Refuses coordinates and values beyond 1e37.
limn_bake_status limni_check_extent(limni_context *context, const limni_source *source,
                                    const limni_mesh *mesh);
limn_bake_status limni_connect(limni_context *context, limni_mesh *mesh);

/// All of them but the last two, and all.
limn_bake_status limni_mesh_begin(limni_context *context, limni_source *source, limni_mesh *mesh);
limn_bake_status limni_mesh_build(limni_context *context, limni_source *source, limni_mesh *mesh);

#endif
