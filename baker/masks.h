/* SPDX-License-Identifier: MIT */
/* What one level of subdivision makes of a mesh: each point as a sum of vertices of the mesh. */
#ifndef LIMNI_MASKS_H
#define LIMNI_MASKS_H

#include "mesh_sharpness.h"
#include "scheme.h"

typedef struct limni_term {
    uint32_t control;
    limni_fixed weight;
} limni_term;

typedef struct limni_masks {
    const limni_mesh *mesh;
    const limni_mesh_sharpness *sharpness;
    const limni_rules *rules;
    const limni_scheme *scheme;
    uint32_t vertex; ///< that was looked at
    limni_star star; ///< its star
    uint32_t
        *ring_edges; ///< [star.count] a half-edge to each ring vertex, which leaves the vertex;
                     ///< in open stars the last leads to it
    limni_fixed *weights[2]; ///< [1 + star.count + face count]
    limni_term *terms;       ///< [term_count] of the point that was asked for; a vertex may occur
                             ///< several times
    uint32_t term_count;
    size_t widest;         ///< the highest valence
    limni_star other;      ///< of a vertex next to it, see limni_masks_look_beside()
    uint32_t *other_edges; ///< as ring_edges
    uint32_t *room;        ///< what the stars point into
} limni_masks;

limn_bake_status limni_masks_begin(limni_context *context, limni_masks *masks,
                                   const limni_mesh *mesh, const limni_mesh_sharpness *sharpness,
                                   const limni_rules *rules);
void limni_masks_end(limni_context *context, limni_masks *masks);

/// Sets the star to that of a vertex with a first half-edge; closed ones start at half-edge `h` if
/// it is given.
void limni_masks_look(limni_masks *masks, uint32_t control, uint32_t h);

/// Sets `other` to the star of ring vertex r, and returns the place of the vertex in it.
uint32_t limni_masks_look_beside(limni_masks *masks, uint32_t r);

// ---- For schemes

void limni_masks_add(limni_masks *masks, uint32_t control, limni_fixed weight);

/// Of the star, with the weights of a limni_mask_fn other than a vertex mask.
void limni_masks_add_star(limni_masks *masks, const limni_fixed *weights);

/// Of the edge to ring vertex r.
void limni_masks_add_edge(limni_masks *masks, uint32_t r, const limni_edge_mask *mask);

// ---- What a scheme says

/// Set the terms: of the vertex that was looked at; of the middle of the edge from it to ring vertex
/// r; of the middle of a face; and of the limit of the vertex and a tangent there, if its star is
/// settled: see limni_scheme.
void limni_masks_vertex(limni_masks *masks);
void limni_masks_edge(limni_masks *masks, uint32_t r);
void limni_masks_face(limni_masks *masks, uint32_t face);
void limni_masks_limit(limni_masks *masks);
void limni_masks_tangent(limni_masks *masks, uint32_t half_steps, int tangent);

#endif
