/* SPDX-License-Identifier: MIT */
/*
 * A subdivision scheme is a set of masks. It sees a vertex and its ring, and gives weights; it
 * knows nothing of classes, tables or files. What is sharp there is in the star.
 */
#ifndef LIMNI_SCHEME_H
#define LIMNI_SCHEME_H

#include "star.h"

/// Weights of a mask: [0] of the vertex itself, [1 + r] of ring vertex r. They sum to exactly 1.
/// The limit is that of a settled star.
void limni_loop_vertex_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights);
void limni_loop_limit_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights);

/// Weights of two tangents of the limit surface at a settled star, as above; they sum to 0. Their
/// cross product points to the side from which the ring is counter-clockwise. Where the star is
/// smooth, `along` points `half_steps` half steps from ring vertex 0 towards ring vertex 1, and
/// starting from the opposite side of an even ring negates both exactly. Otherwise they are those
/// of the side of the crease that starts at its edge half_steps / 2, along it and into that side;
/// at a corner, of the face that starts there.
void limni_loop_tangent_masks(const limni_rules *rules, const limni_star *star, uint32_t half_steps,
                              limni_fixed *along, limni_fixed *across);

/// Weights of the new vertex on an edge.
typedef struct limni_edge_mask {
    limni_fixed ends[2];  ///< of the vertex itself and of the other end
    limni_fixed opposite; ///< of the two opposite vertices each; 0 on a crease, and on a boundary,
                          ///< where there may be but one
} limni_edge_mask;

limni_edge_mask limni_loop_edge_mask(const limni_edge_feature *feature);

#endif
