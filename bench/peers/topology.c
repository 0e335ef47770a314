/* SPDX-License-Identifier: MIT */
#include "topology.h"

#include "allocate.h"

#include <stdlib.h>

static topology allocate_topology(uint32_t vertex_count, uint32_t edge_count, uint32_t face_count,
                                  uint32_t corner_count) {
    topology mesh = {
        .vertex_count = vertex_count,
        .edge_count = edge_count,
        .face_count = face_count,
        .face_starts = bench_allocate((size_t)face_count + 1, sizeof *mesh.face_starts),
        .face_vertices = bench_allocate(corner_count, sizeof *mesh.face_vertices),
        .face_edges = bench_allocate(corner_count, sizeof *mesh.face_edges),
        .edge_vertices = bench_allocate(edge_count, sizeof *mesh.edge_vertices),
        .edge_faces = bench_allocate(edge_count, sizeof *mesh.edge_faces),
        .manifold_edges = true,
    };
    for (uint32_t e = 0; e < edge_count; e++)
        mesh.edge_faces[e][0] = mesh.edge_faces[e][1] = TOPOLOGY_NONE;
    return mesh;
}

static topology allocate_refined(const topology *coarse, uint32_t vertex_count, uint32_t edge_count,
                                 uint32_t face_count, uint32_t face_size) {
    topology mesh = allocate_topology(vertex_count, edge_count, face_count, face_count * face_size);
    for (uint32_t f = 0; f < face_count; f++)
        mesh.face_starts[f + 1] = mesh.face_starts[f] + face_size;
    for (uint32_t e = 0; e < coarse->edge_count; e++) {
        for (uint32_t end = 0; end < 2; end++) {
            mesh.edge_vertices[2 * e + end][0] = coarse->edge_vertices[e][end];
            mesh.edge_vertices[2 * e + end][1] = coarse->vertex_count + e;
        }
    }
    return mesh;
}

static void set_edge_faces(topology *mesh) {
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        for (uint32_t c = mesh->face_starts[f]; c < mesh->face_starts[f + 1]; c++) {
            uint32_t *const faces = mesh->edge_faces[mesh->face_edges[c]];
            if (faces[1] != TOPOLOGY_NONE) mesh->manifold_edges = false;
            faces[faces[0] != TOPOLOGY_NONE] = f;
        }
    }
}

/// The edge between two vertices, which is added if it is new. Open addressing in `table`.
static uint32_t find_edge(topology *mesh, uint32_t *table, uint32_t mask, uint32_t a, uint32_t b) {
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    uint32_t at = (low * 0x9e3779b1u ^ high * 0x85ebca77u) & mask;
    for (; table[at] != TOPOLOGY_NONE; at = (at + 1) & mask) {
        const uint32_t *const ends = mesh->edge_vertices[table[at]];
        if (ends[0] == low && ends[1] == high) return table[at];
    }
    mesh->edge_vertices[mesh->edge_count][0] = low;
    mesh->edge_vertices[mesh->edge_count][1] = high;
    return table[at] = mesh->edge_count++;
}

static void set_faces(topology *mesh, const uint32_t *corners) {
    const uint32_t corner_count = mesh->face_starts[mesh->face_count];
    uint32_t size = 16;
    while (size < 2 * corner_count)
        size *= 2;
    uint32_t *const table = bench_allocate(size, sizeof *table);
    for (uint32_t i = 0; i < size; i++)
        table[i] = TOPOLOGY_NONE;
    mesh->edge_count = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t begin = mesh->face_starts[f], end = mesh->face_starts[f + 1];
        for (uint32_t c = begin; c < end; c++) {
            mesh->face_vertices[c] = corners[c];
            mesh->face_edges[c] =
                find_edge(mesh, table, size - 1, corners[c], corners[c + 1 < end ? c + 1 : begin]);
        }
    }
    free(table);
}

topology topology_create(const uint32_t *face_sizes, const uint32_t *corners, uint32_t face_count,
                         uint32_t vertex_count) {
    uint32_t corner_count = 0;
    for (uint32_t f = 0; f < face_count; f++)
        corner_count += face_sizes ? face_sizes[f] : 3;
    topology mesh = allocate_topology(vertex_count, corner_count, face_count, corner_count);
    for (uint32_t f = 0; f < face_count; f++)
        mesh.face_starts[f + 1] = mesh.face_starts[f] + (face_sizes ? face_sizes[f] : 3);
    set_faces(&mesh, corners);
    set_edge_faces(&mesh);
    return mesh;
}

/// The half of a halved edge at one of its ends.
static uint32_t half_edge(const topology *coarse, uint32_t edge, uint32_t end) {
    return 2 * edge + (coarse->edge_vertices[edge][0] != end);
}

static void refine_triangle(const topology *coarse, uint32_t f, topology *fine) {
    const uint32_t *const edges = coarse->face_edges + 3 * f;
    // The edge that cuts off corner c runs between the middles of edges c and c - 1.
    const uint32_t first_cut = 2 * coarse->edge_count + 3 * f;
    for (uint32_t c = 0; c < 3; c++) {
        const uint32_t corner = coarse->face_vertices[3 * f + c], before = edges[(c + 2) % 3];
        const uint32_t middle = coarse->vertex_count + edges[c];
        uint32_t *const vertices = fine->face_vertices + 3 * (4 * f + c);
        vertices[0] = corner;
        vertices[1] = middle;
        vertices[2] = coarse->vertex_count + before;
        uint32_t *const sides = fine->face_edges + 3 * (4 * f + c);
        sides[0] = half_edge(coarse, edges[c], corner);
        sides[1] = first_cut + c;
        sides[2] = half_edge(coarse, before, corner);
        fine->edge_vertices[first_cut + c][0] = vertices[1];
        fine->edge_vertices[first_cut + c][1] = vertices[2];
        fine->face_vertices[3 * (4 * f + 3) + c] = middle;
        fine->face_edges[3 * (4 * f + 3) + c] = first_cut + (c + 1) % 3;
    }
}

topology topology_refine_triangles(const topology *coarse) {
    topology fine = allocate_refined(coarse, coarse->vertex_count + coarse->edge_count,
                                     2 * coarse->edge_count + 3 * coarse->face_count,
                                     4 * coarse->face_count, 3);
    for (uint32_t f = 0; f < coarse->face_count; f++)
        refine_triangle(coarse, f, &fine);
    set_edge_faces(&fine);
    return fine;
}

/// The quad at corner `c` of a face. An edge inside runs from the middle of each edge of the face to
/// the middle of the face.
static void refine_corner(const topology *coarse, uint32_t f, uint32_t c, topology *fine) {
    const uint32_t begin = coarse->face_starts[f], end = coarse->face_starts[f + 1];
    const uint32_t before = c > begin ? c - 1 : end - 1, first_inside = 2 * coarse->edge_count;
    const uint32_t corner = coarse->face_vertices[c];
    uint32_t *const vertices = fine->face_vertices + 4 * c, *const sides = fine->face_edges + 4 * c;
    vertices[0] = corner;
    vertices[1] = coarse->vertex_count + coarse->face_edges[c];
    vertices[2] = coarse->vertex_count + coarse->edge_count + f;
    vertices[3] = coarse->vertex_count + coarse->face_edges[before];
    sides[0] = half_edge(coarse, coarse->face_edges[c], corner);
    sides[1] = first_inside + c;
    sides[2] = first_inside + before;
    sides[3] = half_edge(coarse, coarse->face_edges[before], corner);
    fine->edge_vertices[first_inside + c][0] = vertices[1];
    fine->edge_vertices[first_inside + c][1] = vertices[2];
}

topology topology_refine_quads(const topology *coarse) {
    const uint32_t corner_count = coarse->face_starts[coarse->face_count];
    topology fine =
        allocate_refined(coarse, coarse->vertex_count + coarse->edge_count + coarse->face_count,
                         2 * coarse->edge_count + corner_count, corner_count, 4);
    for (uint32_t f = 0; f < coarse->face_count; f++) {
        for (uint32_t c = coarse->face_starts[f]; c < coarse->face_starts[f + 1]; c++)
            refine_corner(coarse, f, c, &fine);
    }
    set_edge_faces(&fine);
    return fine;
}

void topology_destroy(topology *mesh) {
    free(mesh->face_starts);
    free(mesh->face_vertices);
    free(mesh->face_edges);
    free(mesh->edge_vertices);
    free(mesh->edge_faces);
    *mesh = (topology){0};
}

// -------------------------------------------------------------------------------------------------
// Rings

topology_rings topology_find_rings(const topology *mesh) {
    const size_t side_count = 2 * (size_t)mesh->edge_count;
    topology_rings found = {
        .starts = bench_allocate((size_t)mesh->vertex_count + 2, sizeof *found.starts),
        .neighbours = bench_allocate(side_count, sizeof *found.neighbours),
        .boundary = bench_allocate(side_count, sizeof *found.boundary),
    };
    // Filling moves each start, which is one place too late, up to its end.
    uint32_t *const next = found.starts + 1;
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        for (int end = 0; end < 2; end++)
            next[mesh->edge_vertices[e][end] + 1]++;
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        next[v + 1] += next[v];
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        for (int end = 0; end < 2; end++) {
            const uint32_t at = next[mesh->edge_vertices[e][end]]++;
            found.neighbours[at] = mesh->edge_vertices[e][1 - end];
            found.boundary[at] = mesh->edge_faces[e][1] == TOPOLOGY_NONE;
        }
    }
    return found;
}

void topology_rings_destroy(topology_rings *rings) {
    free(rings->starts);
    free(rings->neighbours);
    free(rings->boundary);
    *rings = (topology_rings){0};
}

bool topology_is_boundary(const topology_rings *rings, uint32_t vertex) {
    bool boundary = false;
    for (uint32_t at = rings->starts[vertex]; at < rings->starts[vertex + 1]; at++)
        boundary |= rings->boundary[at];
    return boundary;
}
