/* SPDX-License-Identifier: MIT */
/*
 * One level of subdivision, explicitly. Point c of the refined mesh belongs to control point c;
 * behind those there is one for each edge, and in the domain of quads one for each face. Triangle f
 * becomes faces 4f + k, at its corners k, each of which starts with that corner's point, and 4f + 3
 * between the middles of its edges 0, 1 and 2. Other polygons become a quad for each half-edge h,
 * face h: the point at its start, those on h, in the face and on the half-edge before.
 */
#ifndef LIMNI_REFINE_H
#define LIMNI_REFINE_H

#include "limn/format.h"
#include "mesh_sharpness.h"

typedef struct limni_refined {
    limni_mesh mesh;                ///< without positions, which follow from the control points
    limni_mesh_sharpness sharpness; ///< what is left after the level
    uint32_t *edge_points;          ///< [half-edges of the mesh before] the point on each
    uint32_t *edges;                ///< [edge_count] a half-edge of each, in the order of points
    uint32_t edge_count;
    uint32_t first_face_point; ///< the end of the points on edges
} limni_refined;

/// The mesh after a level, and its sharpness. Control points without a first half-edge are those
/// that no face uses, or in a part of a mesh those whose stars are not whole: nothing is known of
/// their edges then.
limn_bake_status limni_refine(limni_context *context, const limni_mesh *mesh,
                              const limni_mesh_sharpness *sharpness, const limni_rules *rules,
                              limni_refined *refined);
void limni_refined_end(limni_context *context, limni_refined *refined);

/// The faces that one face becomes begin here.
static inline uint32_t limni_first_child(const limni_mesh *mesh, uint32_t face) {
    return mesh->domain == LIMN_DOMAIN_QUAD ? mesh->offsets[face] : 4 * face;
}

/// Points as sums of points before them, as the file has them.
typedef struct limni_stencils {
    uint32_t *offsets;     ///< [point count + 1] where the terms of a point begin
    limn_file_term *terms; ///< [offsets[point count]] by ascending controls
} limni_stencils;

/// The points of a refined mesh from those of the mesh before.
limn_bake_status limni_make_stencils(limni_context *context, const limni_mesh *mesh,
                                     const limni_mesh_sharpness *sharpness,
                                     const limni_rules *rules, const limni_refined *refined,
                                     limni_stencils *stencils);

#endif
