/* SPDX-License-Identifier: MIT */
/*
 * Plain recursive Loop subdivision, as one would write it: index tables for every level are made
 * beforehand; a frame is the arithmetic, level by level, and the projection to the limit at the
 * end. Vertices are four floats, one vector each, since what costs time is fetching neighbours;
 * almost all vertices are regular and have tables and masks of their own.
 */
#include "peer.h"

#include "../bench.h"
#include "allocate.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REGULAR_VALENCE = 6 };

/// A mask for each vertex: itself and its ring.
typedef struct vertex_masks {
    float regular_centre, regular_side;
    uint32_t regular_count, other_count, other_side_count;
    uint32_t *regular;                          ///< [regular_count] vertices
    uint32_t (*regular_rings)[REGULAR_VALENCE]; ///< [regular_count]
    uint32_t *others;                           ///< [other_count] vertices
    uint32_t *other_ends;                       ///< [other_count] into other_rings
    float (*other_weights)[2]; ///< [other_count] of the centre and of each neighbour
    uint32_t *other_rings;
} vertex_masks;

/// From one level to the next.
typedef struct level_step {
    vertex_masks vertices;
    uint32_t (*edges)[4]; ///< [edge_count] two ends, two opposites
    uint32_t edge_count, vertex_count;
} level_step;

typedef struct state {
    const peer_scene *scene;
    level_step steps[LIMN_LEVEL_MAX];
    vertex_masks limit;
    vector *points[LIMN_LEVEL_COUNT]; ///< of each level
    vector *limit_points;
} state;

// -------------------------------------------------------------------------------------------------
// A frame

static void apply_vertex_masks(const vertex_masks *masks, const vector *restrict src,
                               vector *restrict dst) {
    const float centre = masks->regular_centre, side = masks->regular_side;
    for (uint32_t i = 0; i < masks->regular_count; i++) {
        const uint32_t v = masks->regular[i];
        const uint32_t *const ring = masks->regular_rings[i];
        const vector sum = ((src[ring[0]] + src[ring[1]]) + (src[ring[2]] + src[ring[3]])) +
                           (src[ring[4]] + src[ring[5]]);
        dst[v] = centre * src[v] + side * sum;
    }
    uint32_t at = 0;
    for (uint32_t i = 0; i < masks->other_count; i++) {
        vector sum = {0};
        for (; at < masks->other_ends[i]; at++)
            sum += src[masks->other_rings[at]];
        const uint32_t v = masks->others[i];
        dst[v] = masks->other_weights[i][0] * src[v] + masks->other_weights[i][1] * sum;
    }
}

static void apply_edge_masks(const level_step *step, const vector *restrict src,
                             vector *restrict dst) {
    for (uint32_t e = 0; e < step->edge_count; e++) {
        const uint32_t *const edge = step->edges[e];
        dst[e] = 0.375f * (src[edge[0]] + src[edge[1]]) + 0.125f * (src[edge[2]] + src[edge[3]]);
    }
}

static void run(void *self_state) {
    state *const self = self_state;
    for (uint32_t level = 0; level < self->scene->level; level++) {
        const level_step *const step = &self->steps[level];
        apply_vertex_masks(&step->vertices, self->points[level], self->points[level + 1]);
        apply_edge_masks(step, self->points[level], self->points[level + 1] + step->vertex_count);
    }
    apply_vertex_masks(&self->limit, self->points[self->scene->level], self->limit_points);
}

// -------------------------------------------------------------------------------------------------
// Preparation

/// Loop's weight of all neighbours together.
static double side_weight(uint32_t valence) {
    const double ring = 3.0 + 2.0 * cos(2.0 * acos(-1.0) / valence);
    return (40.0 - ring * ring) / 64.0;
}

/// Weights of the centre and of each of the neighbours that count.
static void choose_weights(uint32_t valence, bool boundary, bool limit, float weights[2]) {
    if (valence == 0) {
        weights[0] = 1.0f;
        weights[1] = 0.0f;
        return;
    }
    double centre = 1.0 - side_weight(valence);
    if (limit) {
        const double inverse = 3.0 * valence / (8.0 * side_weight(valence));
        centre = inverse / (inverse + valence);
    }
    if (boundary) {
        valence = 2;
        centre = limit ? 2.0 / 3.0 : 3.0 / 4.0;
    }
    weights[0] = (float)centre;
    weights[1] = (float)((1.0 - centre) / valence);
}

static void add_regular(vertex_masks *masks, uint32_t vertex, const uint32_t *ring) {
    memcpy(masks->regular_rings[masks->regular_count], ring, sizeof *masks->regular_rings);
    masks->regular[masks->regular_count++] = vertex;
}

static void add_other(vertex_masks *masks, const topology_rings *rings, uint32_t vertex,
                      bool limit) {
    const uint32_t begin = rings->starts[vertex], end = rings->starts[vertex + 1];
    const bool boundary = topology_is_boundary(rings, vertex);
    for (uint32_t at = begin; at < end; at++) {
        if (!boundary || rings->boundary[at])
            masks->other_rings[masks->other_side_count++] = rings->neighbours[at];
    }
    const uint32_t other = masks->other_count++;
    choose_weights(end - begin, boundary, limit, masks->other_weights[other]);
    masks->others[other] = vertex;
    masks->other_ends[other] = masks->other_side_count;
}

static bool is_regular(const topology_rings *rings, uint32_t vertex) {
    return rings->starts[vertex + 1] - rings->starts[vertex] == REGULAR_VALENCE &&
           !topology_is_boundary(rings, vertex);
}

static vertex_masks find_vertex_masks(const topology *mesh, bool limit) {
    topology_rings rings = topology_find_rings(mesh);
    const uint32_t count = mesh->vertex_count;
    vertex_masks masks = {
        .regular_centre = limit ? 0.5f : 0.625f,
        .regular_side = limit ? 1.0f / 12.0f : 0.0625f,
        .regular = bench_allocate(count, sizeof *masks.regular),
        .regular_rings = bench_allocate(count, sizeof *masks.regular_rings),
        .others = bench_allocate(count, sizeof *masks.others),
        .other_ends = bench_allocate(count, sizeof *masks.other_ends),
        .other_weights = bench_allocate(count, sizeof *masks.other_weights),
        .other_rings = bench_allocate(2 * (size_t)mesh->edge_count, sizeof *masks.other_rings),
    };
    for (uint32_t v = 0; v < count; v++) {
        if (is_regular(&rings, v))
            add_regular(&masks, v, rings.neighbours + rings.starts[v]);
        else
            add_other(&masks, &rings, v, limit);
    }
    topology_rings_destroy(&rings);
    return masks;
}

/// The vertex of a triangle that is not an end of its edge.
static uint32_t find_opposite(const topology *mesh, uint32_t face, const uint32_t ends[2]) {
    const uint32_t *corner = mesh->face_vertices + mesh->face_starts[face];
    while (*corner == ends[0] || *corner == ends[1])
        corner++;
    return *corner;
}

/// On a boundary the opposites are the ends, which makes the same mask that of the middle.
static level_step make_step(const topology *mesh) {
    level_step made = {
        .vertices = find_vertex_masks(mesh, false),
        .edges = bench_allocate(mesh->edge_count, sizeof *made.edges),
        .edge_count = mesh->edge_count,
        .vertex_count = mesh->vertex_count,
    };
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        const uint32_t *const ends = mesh->edge_vertices[e], *const faces = mesh->edge_faces[e];
        const bool boundary = faces[1] == TOPOLOGY_NONE;
        for (int k = 0; k < 2; k++) {
            made.edges[e][k] = ends[k];
            made.edges[e][2 + k] = boundary ? ends[k] : find_opposite(mesh, faces[k], ends);
        }
    }
    return made;
}

static uint64_t count_mask_bytes(const vertex_masks *masks) {
    return (uint64_t)masks->regular_count *
               (sizeof *masks->regular + sizeof *masks->regular_rings) +
           (uint64_t)masks->other_count *
               (sizeof *masks->others + sizeof *masks->other_ends + sizeof *masks->other_weights) +
           (uint64_t)masks->other_side_count * sizeof *masks->other_rings;
}

static uint64_t count_bytes(const state *self) {
    uint64_t bytes = count_mask_bytes(&self->limit);
    for (uint32_t level = 0; level < self->scene->level; level++)
        bytes += count_mask_bytes(&self->steps[level].vertices) +
                 (uint64_t)self->steps[level].edge_count * sizeof *self->steps[level].edges;
    return bytes;
}

static void build(state *self) {
    const peer_scene *const scene = self->scene;
    topology mesh = scene_topology(scene);
    for (uint32_t level = 0; level < scene->level; level++) {
        self->steps[level] = make_step(&mesh);
        self->points[level] = bench_allocate(mesh.vertex_count, sizeof(vector));
        topology fine = topology_refine_triangles(&mesh);
        topology_destroy(&mesh);
        mesh = fine;
    }
    self->limit = find_vertex_masks(&mesh, true);
    self->points[scene->level] = bench_allocate(mesh.vertex_count, sizeof(vector));
    self->limit_points = bench_allocate(mesh.vertex_count, sizeof(vector));
    topology_destroy(&mesh);
    for (uint32_t v = 0; v < scene->control_count; v++)
        memcpy(&self->points[0][v], scene->controls[v], sizeof *scene->controls);
}

static const float *position(const void *self_state, uint32_t patch, uint32_t row) {
    const state *const self = self_state;
    const uint32_t vertex = self->scene->refined[(size_t)patch * self->scene->row_count + row];
    return (const float *)&self->limit_points[vertex];
}

static void free_masks(vertex_masks *masks) {
    free(masks->regular);
    free(masks->regular_rings);
    free(masks->others);
    free(masks->other_ends);
    free(masks->other_weights);
    free(masks->other_rings);
}

static void destroy(void *self_state) {
    state *const self = self_state;
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX; level++) {
        free_masks(&self->steps[level].vertices);
        free(self->steps[level].edges);
    }
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
        free(self->points[level]);
    free_masks(&self->limit);
    free(self->limit_points);
    free(self);
}

bool peers_add_loop(peer_list *list, const peer_scene *scene) {
    if (scene->scheme != LIMN_SCHEME_LOOP) return true;
    state *const self = bench_allocate(1, sizeof *self);
    self->scene = scene;
    const double start = bench_seconds();
    build(self);
    *peer_append(list) = (peer){
        .name = "recursive loop",
        .points = PEER_UNIQUE_POINTS,
        .isa = VECTOR_ISA,
        .family = "",
        .threads = 1,
        .build_ms = 1e3 * (bench_seconds() - start),
        .load_ms = (double)NAN,
        .byte_count = count_bytes(self),
        .state = self,
        .run = run,
        .position = position,
        .destroy = destroy,
    };
    return true;
}
