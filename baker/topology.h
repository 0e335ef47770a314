/* SPDX-License-Identifier: MIT */
/* How the faces of a control mesh lie at its edges and vertices, manifold or not. */
#ifndef LIMNI_TOPOLOGY_H
#define LIMNI_TOPOLOGY_H

#include "mesh.h"

/// Sets mesh->pairs. An edge is not manifold if two faces run along it in the same direction.
///
/// cut  [half_edge_count], zero; out: 1 for the half-edges of edges that are not manifold, which stay
///      open. NULL: such an edge is an error
limn_bake_status limni_pair_half_edges(limni_context *context, limni_mesh *mesh,
                                       unsigned char *cut);

/// Faces around a vertex, from neighbour to neighbour.
typedef struct limni_fan {
    uint32_t first;   ///< its clockwise-most half-edge; of a closed fan any
    uint32_t last;    ///< its counter-clockwise-most half-edge; the fan ends with its previous one
    uint32_t valence; ///< edges
    bool closed;
} limni_fan;

/// The fan that half-edge `h` starts in, in pairs. Marks its outgoing half-edges.
limni_fan limni_walk_fan(const limni_mesh *mesh, uint32_t h, unsigned char *seen);

/// A half-edge of an edge, by limni_edge_key() of the control points that its ends are, or were
/// before the mesh was split.
typedef struct limni_keyed_edge {
    uint64_t key;
    uint32_t half_edge;
} limni_keyed_edge;

/// By key, then by half-edge.
void limni_sort_edges(limni_keyed_edge *edges, size_t count);

/// Makes a manifold of a mesh as OpenSubdiv treats it, and says so: edges that are not manifold are
/// sharp for ever, and vertices that are not become corners, with a control point for each of their
/// fans. See docs/design.md. Changes faces, controls, sharpness and origins; uses pairs.
limn_bake_status limni_split(limni_context *context, limni_mesh *mesh);

#endif
