/* SPDX-License-Identifier: MIT */
#include "normals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t no_vertex = UINT32_MAX;

static uint64_t hash_position(const float position[3]) {
    uint64_t hash = 0;
    for (int axis = 0; axis < 3; axis++) {
        uint32_t bits;
        memcpy(&bits, &position[axis], sizeof bits);
        hash = (hash ^ bits) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 32;
    }
    return hash;
}

/// For every vertex the first one at the same position, by open addressing.
static void find_representatives(const view_vertex *vertices, size_t vertex_count, uint32_t *table,
                                 size_t table_size, uint32_t *representatives) {
    for (size_t cell = 0; cell < table_size; cell++)
        table[cell] = no_vertex;
    for (size_t vertex = 0; vertex < vertex_count; vertex++) {
        const float *const position = vertices[vertex].position;
        size_t cell = (size_t)hash_position(position) & (table_size - 1);
        while (table[cell] != no_vertex &&
               memcmp(vertices[table[cell]].position, position, sizeof(float[3])) != 0) {
            cell = (cell + 1) & (table_size - 1);
        }
        if (table[cell] == no_vertex) table[cell] = (uint32_t)vertex;
        representatives[vertex] = table[cell];
    }
}

/// The cross product of two sides is as long as the triangle's doubled area: that is its weight.
static void add_triangle(view_vertex *vertices, const uint32_t corners[3]) {
    const float *const a = vertices[corners[0]].position;
    const float *const b = vertices[corners[1]].position;
    const float *const c = vertices[corners[2]].position;
    const float u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const float v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const float normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                             u[0] * v[1] - u[1] * v[0]};
    for (int corner = 0; corner < 3; corner++) {
        float *const sum = vertices[corners[corner]].normal;
        for (int axis = 0; axis < 3; axis++)
            sum[axis] += normal[axis];
    }
}

static void accumulate(const limn_plan *plan, const uint16_t *indices, view_vertex *vertices,
                       const uint32_t *representatives) {
    for (uint32_t d = 0; d < plan->patch_count; d++) {
        const limn_draw *const draw = &plan->draws[d];
        const uint32_t *const first = representatives + draw->base_vertex;
        const uint16_t *const triangles = indices + draw->first_index;
        for (uint32_t i = 0; i < draw->index_count; i += 3) {
            const uint32_t corners[3] = {first[triangles[i]], first[triangles[i + 1]],
                                         first[triangles[i + 2]]};
            add_triangle(vertices, corners);
        }
    }
}

static void normalize(float vector[3]) {
    // In double, where the squares of a small mesh's areas do not underflow.
    const double x = vector[0], y = vector[1], z = vector[2];
    const double length = sqrt(x * x + y * y + z * z);
    for (int axis = 0; axis < 3; axis++)
        vector[axis] = length > 0 ? (float)(vector[axis] / length) : 0;
}

bool view_normals_compute(const limn_plan *plan, const uint16_t *indices, view_vertex *vertices) {
    const size_t vertex_count = (size_t)plan->vertex_count;
    size_t table_size = 2;
    while (table_size < vertex_count * 2)
        table_size *= 2;
    uint32_t *const table = malloc(table_size * sizeof *table);
    uint32_t *const representatives = malloc((vertex_count + 1) * sizeof *representatives);
    const bool allocated = table && representatives;
    if (allocated) {
        find_representatives(vertices, vertex_count, table, table_size, representatives);
        accumulate(plan, indices, vertices, representatives);
        for (size_t vertex = 0; vertex < vertex_count; vertex++) {
            if (representatives[vertex] == vertex) normalize(vertices[vertex].normal);
            // A representative comes before all the others.
            memcpy(vertices[vertex].normal, vertices[representatives[vertex]].normal,
                   sizeof vertices[vertex].normal);
        }
    }
    free(table);
    free(representatives);
    return allocated;
}
