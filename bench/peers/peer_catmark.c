/* SPDX-License-Identifier: MIT */
/*
 * Plain recursive Catmull-Clark subdivision, as peer_loop.c is for Loop's: index tables for every
 * level are made beforehand, vertices are four floats, and almost all vertices are regular. The
 * middles of faces come first, so that edges and vertices take them from there.
 */
#include "peer.h"

#include "../bench.h"
#include "allocate.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REGULAR_VALENCE = 4, LEVEL_MAX = LIMN_LEVEL_MAX + 1 };

/// A mask for each vertex: itself, its neighbours, and as many middles of faces or, in the limit,
/// opposite corners of faces.
typedef struct vertex_masks {
    float regular_weights[3];
    uint32_t regular_count, other_count, other_side_count, other_face_count;
    uint32_t *regular;                              ///< [regular_count] vertices
    uint32_t (*regular_rings)[2 * REGULAR_VALENCE]; ///< [regular_count] neighbours, then faces
    uint32_t *others;                               ///< [other_count] vertices
    uint32_t (*other_ends)[2];                      ///< [other_count] into the next two
    uint32_t *other_sides, *other_faces;
    float (*other_weights)[3]; ///< [other_count]
} vertex_masks;

/// From one level to the next.
typedef struct level_step {
    vertex_masks vertices;
    uint32_t (*edges)[4]; ///< [edge_count] two ends, two faces
    uint32_t *boundary;   ///< [boundary_count] edges
    uint32_t *face_ends;  ///< [face_count] into face_corners; NULL: all are quads
    uint32_t *face_corners;
    uint32_t edge_count, vertex_count, face_count, boundary_count, corner_count;
} level_step;

typedef struct state {
    const peer_scene *scene;
    uint32_t step_count;
    level_step steps[LEVEL_MAX];
    vertex_masks limit;
    vector *points[LEVEL_MAX + 1]; ///< of each level
    vector *limit_points;
} state;

// -------------------------------------------------------------------------------------------------
// A frame

static void apply_face_masks(const level_step *step, const vector *restrict src,
                             vector *restrict dst) {
    const uint32_t *corner = step->face_corners;
    for (uint32_t f = 0; f < step->face_count && !step->face_ends; f++, corner += 4)
        dst[f] = 0.25f * ((src[corner[0]] + src[corner[1]]) + (src[corner[2]] + src[corner[3]]));
    for (uint32_t f = 0; f < step->face_count && step->face_ends; f++) {
        const uint32_t *const begin = corner, *const end = step->face_corners + step->face_ends[f];
        vector sum = {0};
        for (; corner < end; corner++)
            sum += src[*corner];
        dst[f] = sum / (float)(end - begin);
    }
}

static void apply_edge_masks(const level_step *step, const vector *restrict src,
                             const vector *faces, vector *restrict dst) {
    for (uint32_t e = 0; e < step->edge_count; e++) {
        const uint32_t *const edge = step->edges[e];
        dst[e] = 0.25f * ((src[edge[0]] + src[edge[1]]) + (faces[edge[2]] + faces[edge[3]]));
    }
    for (uint32_t b = 0; b < step->boundary_count; b++) {
        const uint32_t *const edge = step->edges[step->boundary[b]];
        dst[step->boundary[b]] = 0.5f * (src[edge[0]] + src[edge[1]]);
    }
}

/// faces  where the middles of faces are, or the opposite corners
static void apply_vertex_masks(const vertex_masks *masks, const vector *restrict src,
                               const vector *faces, vector *restrict dst) {
    const float *const weights = masks->regular_weights;
    for (uint32_t i = 0; i < masks->regular_count; i++) {
        const uint32_t v = masks->regular[i];
        const uint32_t *const ring = masks->regular_rings[i];
        const vector sides = (src[ring[0]] + src[ring[1]]) + (src[ring[2]] + src[ring[3]]);
        const vector middles =
            (faces[ring[4]] + faces[ring[5]]) + (faces[ring[6]] + faces[ring[7]]);
        dst[v] = weights[0] * src[v] + weights[1] * sides + weights[2] * middles;
    }
    uint32_t side = 0, face = 0;
    for (uint32_t i = 0; i < masks->other_count; i++) {
        vector sides = {0}, middles = {0};
        for (; side < masks->other_ends[i][0]; side++)
            sides += src[masks->other_sides[side]];
        for (; face < masks->other_ends[i][1]; face++)
            middles += faces[masks->other_faces[face]];
        const float *const own = masks->other_weights[i];
        dst[masks->others[i]] = own[0] * src[masks->others[i]] + own[1] * sides + own[2] * middles;
    }
}

static void run(void *self_state) {
    state *const self = self_state;
    for (uint32_t level = 0; level < self->step_count; level++) {
        const level_step *const step = &self->steps[level];
        const vector *const src = self->points[level];
        vector *const dst = self->points[level + 1];
        vector *const edges = dst + step->vertex_count, *const faces = edges + step->edge_count;
        apply_face_masks(step, src, faces);
        apply_edge_masks(step, src, faces, edges);
        apply_vertex_masks(&step->vertices, src, faces, dst);
    }
    const vector *const last = self->points[self->step_count];
    apply_vertex_masks(&self->limit, last, last, self->limit_points);
}

// -------------------------------------------------------------------------------------------------
// Preparation

/// Corners of faces by vertex: of vertex v, starts[v] to starts[v + 1].
typedef struct vertex_corners {
    uint32_t *starts; ///< [vertex_count + 1]
    uint32_t *faces;
    uint32_t *opposites; ///< the corner after the next one: of a quad that across it
} vertex_corners;

static vertex_corners find_corners(const topology *mesh) {
    const uint32_t corner_count = mesh->face_starts[mesh->face_count];
    vertex_corners found = {
        .starts = bench_allocate((size_t)mesh->vertex_count + 2, sizeof *found.starts),
        .faces = bench_allocate(corner_count, sizeof *found.faces),
        .opposites = bench_allocate(corner_count, sizeof *found.opposites),
    };
    uint32_t *const next = found.starts + 1; // see topology_find_rings()
    for (uint32_t c = 0; c < corner_count; c++)
        next[mesh->face_vertices[c] + 1]++;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        next[v + 1] += next[v];
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t begin = mesh->face_starts[f], size = mesh->face_starts[f + 1] - begin;
        for (uint32_t c = 0; c < size; c++) {
            const uint32_t at = next[mesh->face_vertices[begin + c]]++;
            found.faces[at] = f;
            found.opposites[at] = mesh->face_vertices[begin + (c + 2) % size];
        }
    }
    return found;
}

/// Weights of the centre, of each neighbour and of each face.
static void choose_weights(uint32_t valence, bool boundary, bool limit, float weights[3]) {
    const double n = valence;
    double centre = 1, side = 0, face = 0;
    if (boundary) {
        centre = limit ? 2.0 / 3 : 3.0 / 4;
        side = (1 - centre) / 2;
    } else if (valence > 0) {
        centre = limit ? n / (n + 5) : (n - 2) / n;
        side = limit ? 4 / (n * (n + 5)) : 1 / (n * n);
        face = limit ? 1 / (n * (n + 5)) : 1 / (n * n);
    }
    weights[0] = (float)centre;
    weights[1] = (float)side;
    weights[2] = (float)face;
}

static void add_regular(vertex_masks *masks, uint32_t vertex, const uint32_t *sides,
                        const uint32_t *faces) {
    uint32_t *const ring = masks->regular_rings[masks->regular_count];
    memcpy(ring, sides, REGULAR_VALENCE * sizeof *ring);
    memcpy(ring + REGULAR_VALENCE, faces, REGULAR_VALENCE * sizeof *ring);
    masks->regular[masks->regular_count++] = vertex;
}

static void add_other(vertex_masks *masks, const topology_rings *rings, uint32_t vertex,
                      const uint32_t *faces, uint32_t face_count, bool limit) {
    const uint32_t begin = rings->starts[vertex], end = rings->starts[vertex + 1];
    const bool boundary = topology_is_boundary(rings, vertex);
    for (uint32_t at = begin; at < end; at++) {
        if (!boundary || rings->boundary[at])
            masks->other_sides[masks->other_side_count++] = rings->neighbours[at];
    }
    for (uint32_t f = 0; f < face_count && !boundary; f++)
        masks->other_faces[masks->other_face_count++] = faces[f];
    const uint32_t other = masks->other_count++;
    choose_weights(end - begin, boundary, limit, masks->other_weights[other]);
    masks->others[other] = vertex;
    masks->other_ends[other][0] = masks->other_side_count;
    masks->other_ends[other][1] = masks->other_face_count;
}

static vertex_masks allocate_masks(const topology *mesh, bool limit) {
    const uint32_t count = mesh->vertex_count, corner_count = mesh->face_starts[mesh->face_count];
    vertex_masks masks = {
        .regular = bench_allocate(count, sizeof *masks.regular),
        .regular_rings = bench_allocate(count, sizeof *masks.regular_rings),
        .others = bench_allocate(count, sizeof *masks.others),
        .other_ends = bench_allocate(count, sizeof *masks.other_ends),
        .other_weights = bench_allocate(count, sizeof *masks.other_weights),
        .other_sides = bench_allocate(2 * (size_t)mesh->edge_count, sizeof *masks.other_sides),
        .other_faces = bench_allocate(corner_count, sizeof *masks.other_faces),
    };
    choose_weights(REGULAR_VALENCE, false, limit, masks.regular_weights);
    return masks;
}

static vertex_masks find_vertex_masks(const topology *mesh, bool limit) {
    topology_rings rings = topology_find_rings(mesh);
    const vertex_corners corners = find_corners(mesh);
    vertex_masks masks = allocate_masks(mesh, limit);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        const uint32_t valence = rings.starts[v + 1] - rings.starts[v];
        const uint32_t first = corners.starts[v], face_count = corners.starts[v + 1] - first;
        const uint32_t *const faces = (limit ? corners.opposites : corners.faces) + first;
        if (valence == REGULAR_VALENCE && face_count == REGULAR_VALENCE)
            add_regular(&masks, v, rings.neighbours + rings.starts[v], faces);
        else
            add_other(&masks, &rings, v, faces, face_count, limit);
    }
    topology_rings_destroy(&rings);
    free(corners.starts);
    free(corners.faces);
    free(corners.opposites);
    return masks;
}

static void add_faces(level_step *made, const topology *mesh) {
    bool quads = true;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        quads &= mesh->face_starts[f + 1] - mesh->face_starts[f] == 4;
    made->corner_count = mesh->face_starts[mesh->face_count];
    made->face_corners = bench_allocate(made->corner_count, sizeof *made->face_corners);
    memcpy(made->face_corners, mesh->face_vertices,
           made->corner_count * sizeof *made->face_corners);
    if (quads) return;
    made->face_ends = bench_allocate(mesh->face_count, sizeof *made->face_ends);
    memcpy(made->face_ends, mesh->face_starts + 1, mesh->face_count * sizeof *made->face_ends);
}

static level_step make_step(const topology *mesh) {
    level_step made = {
        .vertices = find_vertex_masks(mesh, false),
        .edges = bench_allocate(mesh->edge_count, sizeof *made.edges),
        .boundary = bench_allocate(mesh->edge_count, sizeof *made.boundary),
        .edge_count = mesh->edge_count,
        .vertex_count = mesh->vertex_count,
        .face_count = mesh->face_count,
    };
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        const uint32_t *const faces = mesh->edge_faces[e];
        const bool boundary = faces[1] == TOPOLOGY_NONE;
        memcpy(made.edges[e], mesh->edge_vertices[e], sizeof *mesh->edge_vertices);
        made.edges[e][2] = faces[0];
        made.edges[e][3] = faces[boundary ? 0 : 1];
        if (boundary) made.boundary[made.boundary_count++] = e;
    }
    add_faces(&made, mesh);
    return made;
}

static uint64_t count_mask_bytes(const vertex_masks *masks) {
    return (uint64_t)masks->regular_count *
               (sizeof *masks->regular + sizeof *masks->regular_rings) +
           (uint64_t)masks->other_count *
               (sizeof *masks->others + sizeof *masks->other_ends + sizeof *masks->other_weights) +
           ((uint64_t)masks->other_side_count + masks->other_face_count) * sizeof(uint32_t);
}

static uint64_t count_bytes(const state *self) {
    uint64_t bytes = count_mask_bytes(&self->limit);
    for (uint32_t level = 0; level < self->step_count; level++) {
        const level_step *const step = &self->steps[level];
        bytes += count_mask_bytes(&step->vertices) +
                 (uint64_t)step->edge_count * sizeof *step->edges +
                 ((uint64_t)step->corner_count + step->boundary_count +
                  (step->face_ends ? step->face_count : 0)) *
                     sizeof(uint32_t);
    }
    return bytes;
}

static void build(state *self) {
    const peer_scene *const scene = self->scene;
    topology mesh = scene_topology(scene);
    self->step_count = scene_refinement_count(scene);
    for (uint32_t level = 0; level < self->step_count; level++) {
        self->steps[level] = make_step(&mesh);
        self->points[level] = bench_allocate(mesh.vertex_count, sizeof(vector));
        topology fine = topology_refine_quads(&mesh);
        topology_destroy(&mesh);
        mesh = fine;
    }
    self->limit = find_vertex_masks(&mesh, true);
    self->points[self->step_count] = bench_allocate(mesh.vertex_count, sizeof(vector));
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
    free(masks->other_sides);
    free(masks->other_faces);
}

static void destroy(void *self_state) {
    state *const self = self_state;
    for (uint32_t level = 0; level < self->step_count; level++) {
        level_step *const step = &self->steps[level];
        free_masks(&step->vertices);
        free(step->edges);
        free(step->boundary);
        free(step->face_ends);
        free(step->face_corners);
    }
    for (uint32_t level = 0; level <= self->step_count; level++)
        free(self->points[level]);
    free_masks(&self->limit);
    free(self->limit_points);
    free(self);
}

bool peers_add_catmark(peer_list *list, const peer_scene *scene) {
    if (scene->scheme != LIMN_SCHEME_CATMARK) return true;
    state *const self = bench_allocate(1, sizeof *self);
    self->scene = scene;
    const double start = bench_seconds();
    build(self);
    *peer_append(list) = (peer){
        .name = "recursive catmark",
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
