/* SPDX-License-Identifier: MIT */
/* The tags of a mesh as the rules take them: per edge and vertex, with what the boundary adds. */
#ifndef LIMNI_MESH_SHARPNESS_H
#define LIMNI_MESH_SHARPNESS_H

#include "mesh.h"
#include "scheme.h"

typedef struct limni_mesh_sharpness {
    limni_sharpness *edges;    ///< [half_edge_count] by half-edge, infinite on the boundary; NULL:
                               ///< none is sharp, but a boundary if the rules need not see its ends
    uint32_t (*seen)[2];       ///< [half_edge_count] what there is to know at the start and at the
                               ///< end of each half-edge; NULL with `edges`
    limni_sharpness *vertices; ///< [control_count]
} limni_mesh_sharpness;

/// Whether any tag says so.
bool limni_has_sharpness(const limni_mesh *mesh);

bool limni_has_boundary(const limni_mesh *mesh);

/// LIMN_BOUNDARY_NONE: makes holes of the faces around boundary vertices, except where all boundary
/// edges are tagged as infinitely sharp.
void limni_mesh_open_boundary(limni_mesh *mesh);

limn_bake_status limni_mesh_sharpness_begin(limni_context *context, const limni_mesh *mesh,
                                            const limni_rules *rules,
                                            limni_mesh_sharpness *sharpness);

/// Fills in `seen` from the edges and the vertices, where there are edges.
limn_bake_status limni_mesh_sharpness_see(limni_context *context, const limni_mesh *mesh,
                                          const limni_rules *rules,
                                          limni_mesh_sharpness *sharpness);

void limni_mesh_sharpness_end(limni_context *context, limni_mesh_sharpness *sharpness);

/// Whether the surface may have two normals along the half-edge and its pair.
static inline bool limni_is_crease(const limni_mesh_sharpness *sharpness, const limni_mesh *mesh,
                                   uint32_t h) {
    return sharpness->edges && mesh->pairs[h] != LIMNI_NONE &&
           sharpness->edges[h] == LIMNI_SHARPNESS_INFINITE;
}

/// The star of a control point that faces use, in control points: counter-clockwise from half-edge
/// `h`, which starts there, or from the boundary.
///
/// star  ring, edges and beyond have room for its valence, and diagonals unless they are NULL; edges
///       and beyond become NULL where sharpness->edges is, diagonals where the domain is not quads
void limni_mesh_star(const limni_mesh *mesh, const limni_mesh_sharpness *sharpness, uint32_t h,
                     limni_star *star);

/// Whether everything is sharp for ever: the masks of corners and of sharp edges, and within a face
/// those of a regular mesh, leave triangles flat and evenly divided.
bool limni_is_flat(const limni_rules *rules);

#endif
