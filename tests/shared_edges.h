/* SPDX-License-Identifier: MIT */
/* Bitwise watertight: what two patches write along an edge between the same base vertices. */
#ifndef SHARED_EDGES_H
#define SHARED_EDGES_H

#include "check.h"
#include "limn/limn.h"

#include <stdlib.h>

typedef struct vertex {
    float position[3], normal[3];
} vertex;

/// An edge of a patch, from its lower base vertex to the higher one.
typedef struct side {
    uint32_t ends[2];
    uint32_t patch;
    uint8_t edge;
    bool reversed;
} side;

static inline int compare_sides(const void *a, const void *b) {
    return memcmp(a, b, sizeof(uint32_t[2])); // any order that brings equal ones together
}

static inline side side_of(const limn_mesh *mesh, uint32_t patch, uint32_t edge) {
    uint32_t corners[LIMN_CORNER_MAX];
    limn_mesh_corners(mesh, patch, corners);
    const uint32_t a = corners[edge], b = corners[(edge + 1) % mesh->domain->corner_count];
    return (side){{a < b ? a : b, a < b ? b : a}, patch, (uint8_t)edge, a > b};
}

static inline const vertex *vertex_at(const limn_plan *plan, const vertex *vertices, const side *at,
                                      uint32_t t) {
    const uint32_t along = at->reversed ? LIMN_GRID_SIZE - t : t;
    const uint16_t row = plan->mesh->domain->edge_rows[at->edge][along];
    return &vertices[limn_plan_first_vertex(plan, at->patch) + row];
}

/// Compares positions and normals along all edges that two patches share, of a mesh without sharp
/// creases. Returns how many there are.
///
/// vertices  of a uniform plan
static inline uint32_t check_shared_edges(const limn_plan *plan, const vertex *vertices) {
    const uint32_t corner_count = plan->mesh->domain->corner_count;
    const uint32_t count = plan->patch_count * corner_count, step = LIMN_GRID_SIZE >> plan->level;
    side *const sides = malloc(count * sizeof *sides);
    uint32_t pairs = 0, differences = 0;
    if (!CHECK(sides != NULL)) return 0;
    for (uint32_t k = 0; k < count; k++)
        sides[k] = side_of(plan->mesh, k / corner_count, k % corner_count);
    qsort(sides, count, sizeof *sides, compare_sides);
    for (uint32_t k = 0; k + 1 < count; k++) {
        if (compare_sides(&sides[k], &sides[k + 1]) != 0) continue;
        pairs++;
        for (uint32_t t = 0; t <= LIMN_GRID_SIZE; t += step)
            differences += memcmp(vertex_at(plan, vertices, &sides[k], t),
                                  vertex_at(plan, vertices, &sides[k + 1], t), sizeof(vertex)) != 0;
    }
    CHECK_EQUAL(differences, 0u);
    free(sides);
    return pairs;
}

#endif
