/* SPDX-License-Identifier: MIT */
/* The connectivity of a polygon mesh and of its refinements, by Loop and by Catmull and Clark. */
#ifndef TOPOLOGY_H
#define TOPOLOGY_H

#include <stdbool.h>
#include <stdint.h>

#define TOPOLOGY_NONE 0xffffffffu

typedef struct topology {
    uint32_t vertex_count, edge_count, face_count;
    uint32_t *face_starts;        ///< [face_count + 1] the first corner of each face
    uint32_t *face_vertices;      ///< by corner
    uint32_t *face_edges;         ///< by corner: the edge to the next corner
    uint32_t (*edge_vertices)[2]; ///< [edge_count]
    uint32_t (*edge_faces)[2];    ///< [edge_count] the second is TOPOLOGY_NONE on a boundary
    bool manifold_edges;          ///< whether no edge has more than two faces
} topology;

/// Exits when out of memory, as all functions here do.
///
/// face_sizes  [face_count] corners of each face; NULL: triangles
topology topology_create(const uint32_t *face_sizes, const uint32_t *corners, uint32_t face_count,
                         uint32_t vertex_count);

/// Of triangles: each edge is halved, each triangle becomes four. Vertex v stays vertex v, and the
/// middle of edge e becomes vertex vertex_count + e. Face f becomes 4f + c at corner c, which is its
/// corner 0, and 4f + 3 between the middles of edges 0, 1 and 2.
topology topology_refine_triangles(const topology *coarse);

/// Each edge is halved, and each corner becomes a quad, number face_starts[f] + c, with corner c as
/// its corner 0, the middle of edge c, the middle of the face and the middle of edge c - 1. Vertex v
/// stays vertex v, the middle of edge e becomes vertex vertex_count + e, and that of face f vertex
/// vertex_count + edge_count + f.
topology topology_refine_quads(const topology *coarse);

void topology_destroy(topology *mesh);

/// Edges by vertex: those of vertex v are starts[v] to starts[v + 1].
typedef struct topology_rings {
    uint32_t *starts;     ///< [vertex_count + 1]
    uint32_t *neighbours; ///< [2 * edge_count]
    bool *boundary;       ///< [2 * edge_count] whether the edge to the neighbour is on a boundary
} topology_rings;

topology_rings topology_find_rings(const topology *mesh);
void topology_rings_destroy(topology_rings *rings);

/// Whether the vertex is on a boundary.
bool topology_is_boundary(const topology_rings *rings, uint32_t vertex);

#endif
