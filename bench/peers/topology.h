/* SPDX-License-Identifier: MIT */
/* The connectivity of a triangle mesh and of its refinements: each edge is halved, each triangle
 * becomes four. */
#ifndef TOPOLOGY_H
#define TOPOLOGY_H

#include <stdint.h>

#define TOPOLOGY_NONE 0xffffffffu

typedef struct topology {
    uint32_t vertex_count, edge_count, face_count;
    uint32_t (*face_vertices)[3];  ///< [face_count]
    uint32_t (*face_edges)[3];     ///< [face_count] edge e runs from corner e to corner e + 1
    uint32_t (*edge_vertices)[2];  ///< [edge_count]
    uint32_t (*edge_opposites)[2]; ///< [edge_count] the third vertices of its faces; the second is
                                   ///< TOPOLOGY_NONE on a boundary
} topology;

/// Of a manifold mesh. Exits when out of memory, as all functions here do.
topology topology_create(const uint32_t (*faces)[3], uint32_t face_count, uint32_t vertex_count);

/// Vertex v stays vertex v, and the middle of edge e becomes vertex vertex_count + e. Face f
/// becomes 4f + c at corner c, which is its corner 0, and 4f + 3 between the middles of edges 0, 1
/// and 2.
topology topology_refine(const topology *coarse);

void topology_destroy(topology *mesh);

#endif
