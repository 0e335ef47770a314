/* SPDX-License-Identifier: MIT */
#include "topology.h"

#include "allocate.h"

#include <stdlib.h>

static topology allocate_topology(uint32_t vertex_count, uint32_t edge_count, uint32_t face_count) {
    topology mesh = {
        .vertex_count = vertex_count,
        .edge_count = edge_count,
        .face_count = face_count,
        .face_vertices = bench_allocate(face_count, sizeof *mesh.face_vertices),
        .face_edges = bench_allocate(face_count, sizeof *mesh.face_edges),
        .edge_vertices = bench_allocate(edge_count, sizeof *mesh.edge_vertices),
        .edge_opposites = bench_allocate(edge_count, sizeof *mesh.edge_opposites),
    };
    for (uint32_t e = 0; e < edge_count; e++)
        mesh.edge_opposites[e][0] = mesh.edge_opposites[e][1] = TOPOLOGY_NONE;
    return mesh;
}

static void set_opposites(topology *mesh) {
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        for (int c = 0; c < 3; c++) {
            uint32_t *const opposites = mesh->edge_opposites[mesh->face_edges[f][c]];
            opposites[opposites[0] != TOPOLOGY_NONE] = mesh->face_vertices[f][(c + 2) % 3];
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

topology topology_create(const uint32_t (*faces)[3], uint32_t face_count, uint32_t vertex_count) {
    topology mesh = allocate_topology(vertex_count, 3 * face_count, face_count);
    uint32_t size = 16;
    while (size < 6 * face_count)
        size *= 2;
    uint32_t *const table = bench_allocate(size, sizeof *table);
    for (uint32_t i = 0; i < size; i++)
        table[i] = TOPOLOGY_NONE;
    mesh.edge_count = 0;
    for (uint32_t f = 0; f < face_count; f++) {
        for (int c = 0; c < 3; c++) {
            mesh.face_vertices[f][c] = faces[f][c];
            mesh.face_edges[f][c] =
                find_edge(&mesh, table, size - 1, faces[f][c], faces[f][(c + 1) % 3]);
        }
    }
    free(table);
    set_opposites(&mesh);
    return mesh;
}

/// The half of a halved edge at one of its ends.
static uint32_t half_edge(const topology *coarse, uint32_t edge, uint32_t end) {
    return 2 * edge + (coarse->edge_vertices[edge][0] != end);
}

static void refine_face(const topology *coarse, uint32_t f, topology *fine) {
    const uint32_t *const edges = coarse->face_edges[f];
    // The edge that cuts off corner c runs between the middles of edges c and c - 1.
    const uint32_t first_cut = 2 * coarse->edge_count + 3 * f;
    for (uint32_t c = 0; c < 3; c++) {
        const uint32_t corner = coarse->face_vertices[f][c], before = edges[(c + 2) % 3];
        const uint32_t middle = coarse->vertex_count + edges[c];
        uint32_t *const vertices = fine->face_vertices[4 * f + c];
        vertices[0] = corner;
        vertices[1] = middle;
        vertices[2] = coarse->vertex_count + before;
        uint32_t *const sides = fine->face_edges[4 * f + c];
        sides[0] = half_edge(coarse, edges[c], corner);
        sides[1] = first_cut + c;
        sides[2] = half_edge(coarse, before, corner);
        fine->edge_vertices[first_cut + c][0] = vertices[1];
        fine->edge_vertices[first_cut + c][1] = vertices[2];
        fine->face_vertices[4 * f + 3][c] = middle;
        fine->face_edges[4 * f + 3][c] = first_cut + (c + 1) % 3;
    }
}

topology topology_refine(const topology *coarse) {
    topology fine =
        allocate_topology(coarse->vertex_count + coarse->edge_count,
                          2 * coarse->edge_count + 3 * coarse->face_count, 4 * coarse->face_count);
    for (uint32_t e = 0; e < coarse->edge_count; e++) {
        for (uint32_t end = 0; end < 2; end++) {
            fine.edge_vertices[2 * e + end][0] = coarse->edge_vertices[e][end];
            fine.edge_vertices[2 * e + end][1] = coarse->vertex_count + e;
        }
    }
    for (uint32_t f = 0; f < coarse->face_count; f++)
        refine_face(coarse, f, &fine);
    set_opposites(&fine);
    return fine;
}

void topology_destroy(topology *mesh) {
    free(mesh->face_vertices);
    free(mesh->face_edges);
    free(mesh->edge_vertices);
    free(mesh->edge_opposites);
    *mesh = (topology){0};
}
