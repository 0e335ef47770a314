/* SPDX-License-Identifier: MIT */
/*
 * A subdivision scheme is a set of masks. It sees a vertex and its ring, and gives weights; it
 * knows nothing of classes, tables or files. Rules for creases belong here and into
 * limni_vertex_rule.
 */
#ifndef LIMNI_SCHEME_H
#define LIMNI_SCHEME_H

#include "fixed.h"
#include "limn/bake.h"

/// The options that decide the masks. Meshes of one file may differ in what limn_bake_desc leaves to
/// them.
typedef struct limni_rules {
    limn_weights weights;
    limn_boundary boundary; ///< LIMN_BOUNDARY_DEFAULT and LIMN_BOUNDARY_NONE: as edge-only
    limn_normals normals;
} limni_rules;

typedef enum limni_vertex_rule {
    LIMNI_VERTEX_SMOOTH,
    LIMNI_VERTEX_CREASE, ///< on a boundary curve: its two neighbours are the ends of the ring
    LIMNI_VERTEX_CORNER  ///< stays where it is
} limni_vertex_rule;

/// A vertex with its neighbours, counter-clockwise. In an open ring the boundary runs through the
/// first and the last neighbour.
typedef struct limni_star {
    limni_vertex_rule rule;
    bool closed;
    uint32_t count; ///< neighbours
    uint32_t *ring; ///< [count]
} limni_star;

/// The rule for a control point, from its place in the mesh.
limni_vertex_rule limni_loop_rule(const limni_rules *rules, bool closed, uint32_t valence);

/// Weights of a mask: [0] of the vertex itself, [1 + r] of ring vertex r. They sum to exactly 1.
void limni_loop_vertex_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights);
void limni_loop_limit_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights);

/// Weights of two tangents of the limit surface at a vertex, as above; they sum to 0. Their cross
/// product points to the side from which the ring is counter-clockwise. In a closed ring `along`
/// points `half_steps` half steps from ring vertex 0 towards ring vertex 1, and starting from the
/// opposite side of an even ring negates both exactly; in an open ring `along` follows the
/// boundary.
void limni_loop_tangent_masks(const limni_star *star, uint32_t half_steps, limni_fixed *along,
                              limni_fixed *across);

/// Weights of the new vertex on an edge: of its two ends each, and of the two opposite vertices
/// each.
typedef struct limni_edge_mask {
    limni_fixed end;
    limni_fixed opposite; ///< 0 on a boundary, where there may be but one
} limni_edge_mask;
limni_edge_mask limni_loop_edge_mask(bool boundary);

#endif
