/* SPDX-License-Identifier: MIT */
/*
 * A subdivision scheme is a set of masks. It sees a vertex and its ring, and gives weights; it
 * knows nothing of classes, tables or files. What is sharp there is in the star.
 */
#ifndef LIMNI_SCHEME_H
#define LIMNI_SCHEME_H

#include "star.h"

/// The options that decide the masks. Meshes of one file may differ in what limn_bake_desc leaves to
/// them.
typedef struct limni_rules {
    limn_scheme scheme;
    limn_weights weights;
    limn_boundary boundary; ///< not the default, nor that of creasing
    limn_creases creases;
    limn_creasing creasing;
    limn_normals normals;
    limn_isolate isolate;
} limni_rules;

/// Weights of a mask: [0] of the vertex itself, [1 + r] of ring vertex r. They sum to exactly 1.
/// The limit is that of a star that does not decay.
void limni_loop_vertex_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights);
void limni_loop_limit_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights);

/// Weights of two tangents of the limit surface at a vertex, as above; they sum to 0. Their cross
/// product points to the side from which the ring is counter-clockwise. Where the star is smooth,
/// `along` points `half_steps` half steps from ring vertex 0 towards ring vertex 1, and starting
/// from the opposite side of an even ring negates both exactly. Otherwise they are those of the
/// side of the crease that starts at its edge half_steps / 2, along it and into that side; at a
/// corner, of the face that starts there.
void limni_loop_tangent_masks(const limni_star *star, uint32_t half_steps, limni_fixed *along,
                              limni_fixed *across);

/// Weights of the new vertex on an edge: of its two ends each, and of the two opposite vertices
/// each.
typedef struct limni_edge_mask {
    limni_fixed end;
    limni_fixed opposite; ///< 0 on a crease, and on a boundary, where there may be but one
} limni_edge_mask;

/// sharp  how much of a crease the edge is, from 0 to 1
limni_edge_mask limni_loop_edge_mask(limni_fixed sharp);

#endif
