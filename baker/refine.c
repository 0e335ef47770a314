/* SPDX-License-Identifier: MIT */
#include "refine.h"

#include "hash.h"
#include "topology.h"

typedef struct refiner {
    limni_context *context;
    const limni_mesh *mesh;
    const limni_mesh_sharpness *sharpness;
    const limni_rules *rules;
    uint32_t *points;        ///< [3 * face_count] of half-edges: the point on the edge
    uint32_t *origins;       ///< [point_count] see limni_mesh
    limni_keyed_edge *edges; ///< [edge_count] in the order of their points
    uint32_t edge_count, point_count;
    limni_refined *made;
    uint32_t widest;      ///< valence
    limni_star star;      ///< of one control point, in `room`
    uint32_t *room;       ///< [3][widest]
    uint32_t *ring_edges; ///< [widest] a half-edge to each ring vertex
    limni_fixed *weights; ///< [1 + widest]
    uint32_t term_count;
} refiner;

// ---- Points

/// The edges in the order of their points. Where the mesh was split, those that were one edge are
/// side by side, so that each sheet has their points in the same order (baker/split.c).
static uint32_t list_edges(const limni_mesh *mesh, limni_keyed_edge *edges) {
    uint32_t count = 0;
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        if (mesh->pairs[h] != LIMNI_NONE && mesh->pairs[h] < h) continue;
        const uint32_t a = limni_half_edge_start(mesh, h), b = limni_half_edge_end(mesh, h);
        edges[count++] =
            (limni_keyed_edge){limni_edge_key(limni_origin(mesh, a), limni_origin(mesh, b)), h};
    }
    if (mesh->origins) limni_sort_edges(edges, count);
    return count;
}

/// Whether two edges were one: with both ends on several sheets.
static bool were_one(const limni_mesh *mesh, const limni_keyed_edge *a, const limni_keyed_edge *b) {
    return a->key == b->key && limni_is_split(mesh, limni_half_edge_start(mesh, a->half_edge)) &&
           limni_is_split(mesh, limni_half_edge_end(mesh, a->half_edge));
}

/// Of points that were one, the first.
static void find_origins(const limni_mesh *mesh, const limni_keyed_edge *edges, uint32_t edge_count,
                         uint32_t *origins) {
    for (uint32_t c = 0; c < mesh->control_count; c++)
        origins[c] = c > 0 && mesh->origins[c - 1] == mesh->origins[c] ? origins[c - 1] : c;
    for (uint32_t e = 0; e < edge_count; e++) {
        uint32_t *const origin = &origins[mesh->control_count + e];
        *origin = e > 0 && were_one(mesh, &edges[e - 1], &edges[e]) ? origin[-1]
                                                                    : mesh->control_count + e;
    }
}

static limn_bake_status number_points(refiner *r) {
    const limni_mesh *const mesh = r->mesh;
    r->edges = limni_allocate(r->context, 3 * (size_t)mesh->face_count, sizeof *r->edges);
    if (!r->edges) return LIMN_BAKE_MEMORY;
    r->edge_count = list_edges(mesh, r->edges);
    for (uint32_t e = 0; e < r->edge_count; e++) {
        const uint32_t h = r->edges[e].half_edge, point = mesh->control_count + e;
        r->points[h] = point;
        if (mesh->pairs[h] != LIMNI_NONE) r->points[mesh->pairs[h]] = point;
    }
    r->point_count = mesh->control_count + r->edge_count;
    if (!mesh->origins) return LIMN_BAKE_OK;
    r->origins = limni_allocate(r->context, r->point_count, sizeof *r->origins);
    if (!r->origins) return LIMN_BAKE_MEMORY;
    find_origins(mesh, r->edges, r->edge_count, r->origins);
    return LIMN_BAKE_OK;
}

// ---- Faces

static uint32_t child(uint32_t face, uint32_t piece, uint32_t edge) {
    return 3 * (4 * face + piece) + edge;
}
/// The halves of half-edge h.
static uint32_t first_half(uint32_t h) {
    return child(h / 3, h % 3, 0);
}
static uint32_t second_half(uint32_t h) {
    return child(h / 3, (h + 1) % 3, 2);
}

static void split_face(const refiner *r, uint32_t f) {
    const limni_mesh *const mesh = r->mesh;
    limni_mesh *const made = &r->made->mesh;
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t before = (k + 2) % 3, h = 3 * f + k, pair = mesh->pairs[h];
        uint32_t *const corners = made->faces[4 * f + k];
        corners[0] = mesh->faces[f][k];
        corners[1] = r->points[h];
        corners[2] = r->points[3 * f + before];
        made->faces[4 * f + 3][k] = r->points[h];
        made->pairs[first_half(h)] = pair == LIMNI_NONE ? LIMNI_NONE : second_half(pair);
        made->pairs[second_half(h)] = pair == LIMNI_NONE ? LIMNI_NONE : first_half(pair);
        made->pairs[child(f, k, 1)] = child(f, 3, before);
        made->pairs[child(f, 3, before)] = child(f, k, 1);
    }
    for (uint32_t piece = 0; piece < 4; piece++) {
        made->polygons[4 * f + piece] = mesh->polygons[f];
        made->holes[4 * f + piece] = mesh->holes[f];
    }
}

static void find_first(const refiner *r) {
    const limni_mesh *const mesh = r->mesh;
    limni_mesh *const made = &r->made->mesh;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        made->valences[c] = mesh->valences[c];
        made->first[c] = mesh->first[c] == LIMNI_NONE ? LIMNI_NONE : first_half(mesh->first[c]);
    }
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        const bool boundary = mesh->pairs[h] == LIMNI_NONE;
        if (!boundary && mesh->pairs[h] < h) continue;
        made->valences[r->points[h]] = boundary ? 4 : 6;
        made->first[r->points[h]] = second_half(h);
    }
}

// ---- Stars

/// The star of a control point, with the half-edges and the points to its ring.
static void look_around(refiner *r, uint32_t control) {
    const limni_mesh *const mesh = r->mesh;
    uint32_t h = mesh->first[control];
    limni_star *const star = &r->star;
    *star = (limni_star){.ring = r->room, .edges = r->room + r->widest};
    star->beyond = star->edges + r->widest;
    limni_mesh_star(mesh, r->sharpness, h, star);
    for (uint32_t k = 0; k < star->count; k++) {
        r->ring_edges[k] = h;
        const uint32_t previous = limni_half_edge_previous(h);
        // Beyond the last face of an open star there is the edge that comes in.
        h = mesh->pairs[previous] == LIMNI_NONE ? previous : mesh->pairs[previous];
    }
}

static limn_bake_status begin_stars(refiner *r) {
    for (uint32_t c = 0; c < r->mesh->control_count; c++)
        r->widest = r->mesh->valences[c] > r->widest ? r->mesh->valences[c] : r->widest;
    r->room = limni_allocate(r->context, 3 * (size_t)r->widest, sizeof *r->room);
    r->ring_edges = limni_allocate(r->context, r->widest, sizeof *r->ring_edges);
    r->weights = limni_allocate(r->context, 1 + (size_t)r->widest, sizeof *r->weights);
    return r->room && r->ring_edges && r->weights ? LIMN_BAKE_OK : LIMN_BAKE_MEMORY;
}

// ---- Sharpness

/// The half of a half-edge that is next to a control point, which it leaves or leads to.
static uint32_t half_at(const refiner *r, uint32_t h, uint32_t control) {
    return limni_half_edge_start(r->mesh, h) == control ? first_half(h) : second_half(h);
}

/// Halves of edges have what is left at their ends.
static void sharpen_edges(refiner *r, uint32_t control) {
    limni_sharpness *const edges = r->made->sharpness.edges;
    look_around(r, control);
    for (uint32_t k = 0; k < r->star.count; k++) {
        const uint32_t half = half_at(r, r->ring_edges[k], control);
        const uint32_t pair = r->made->mesh.pairs[half];
        edges[half] = limni_star_next_edge(r->rules, &r->star, k);
        if (pair != LIMNI_NONE) edges[pair] = edges[half];
    }
}

static limn_bake_status sharpen(refiner *r) {
    const limni_mesh *const mesh = r->mesh;
    limni_mesh_sharpness *const made = &r->made->sharpness;
    made->vertices = limni_allocate_zeroed(r->context, r->point_count, sizeof *made->vertices);
    if (!made->vertices) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        made->vertices[c] = limni_sharpness_next(r->sharpness->vertices[c]);
    if (!r->sharpness->edges) return LIMN_BAKE_OK;
    made->edges =
        limni_allocate_zeroed(r->context, 12 * (size_t)mesh->face_count, sizeof *made->edges);
    if (!made->edges) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        if (mesh->first[c] != LIMNI_NONE) sharpen_edges(r, c);
    }
    return limni_mesh_sharpness_see(r->context, &r->made->mesh, r->rules, made);
}

// ---- Stencils

static void add_term(refiner *r, uint32_t control, limni_fixed weight) {
    if (weight == 0) return;
    r->made->terms[r->term_count++] =
        (limn_file_term){.control = control, .weight = limni_fixed_to_float(weight)};
}

/// By ascending control points: so sheets, whose rings start anywhere, add theirs in the same
/// order.
static void end_stencil(const refiner *r, uint32_t point) {
    limn_file_term *const terms = r->made->terms + r->made->stencils[point];
    for (uint32_t k = 1; k < r->term_count - r->made->stencils[point]; k++) {
        const limn_file_term term = terms[k];
        uint32_t at = k;
        for (; at > 0 && terms[at - 1].control > term.control; at--)
            terms[at] = terms[at - 1];
        terms[at] = term;
    }
}

static void add_vertex_stencil(refiner *r, uint32_t control) {
    if (r->mesh->first[control] == LIMNI_NONE) {
        add_term(r, control, LIMNI_FIXED_ONE);
        return;
    }
    look_around(r, control);
    limni_loop_vertex_mask(r->rules, &r->star, r->weights);
    add_term(r, control, r->weights[0]);
    for (uint32_t k = 0; k < r->star.count; k++)
        add_term(r, r->star.ring[k], r->weights[1 + k]);
}

/// Of the edge from a control point to ring vertex k of its star.
static void add_edge_stencil(refiner *r, uint32_t control, uint32_t k) {
    const limni_star *const star = &r->star;
    const limni_edge_feature feature = limni_star_edge_feature(r->rules, star, k);
    const limni_edge_mask mask = limni_loop_edge_mask(&feature);
    add_term(r, control, mask.ends[0]);
    add_term(r, star->ring[k], mask.ends[1]);
    add_term(r, star->ring[limni_star_left(star, k)], mask.opposite);
    add_term(r, star->ring[limni_star_right(star, k)], mask.opposite);
}

static void add_edge_stencils(refiner *r) {
    const limni_mesh *const mesh = r->mesh;
    for (uint32_t e = 0; e < r->edge_count; e++) {
        const uint32_t point = mesh->control_count + e;
        const uint32_t start = limni_half_edge_start(mesh, r->edges[e].half_edge);
        look_around(r, start);
        uint32_t k = 0;
        while (r->points[r->ring_edges[k]] != point)
            k++;
        r->made->stencils[point] = r->term_count;
        add_edge_stencil(r, start, k);
        end_stencil(r, point);
    }
}

static limn_bake_status make_stencils(refiner *r) {
    const limni_mesh *const mesh = r->mesh;
    const uint32_t point_count = r->made->mesh.control_count;
    uint64_t room = 4 * (uint64_t)r->edge_count;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        room += 1 + (uint64_t)mesh->valences[c];
    r->made->stencils = limni_allocate(r->context, 1 + (size_t)point_count, sizeof(uint32_t));
    r->made->terms = limni_allocate(r->context, (size_t)room, sizeof *r->made->terms);
    if (!r->made->stencils || !r->made->terms) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        r->made->stencils[c] = r->term_count;
        add_vertex_stencil(r, c);
        end_stencil(r, c);
    }
    add_edge_stencils(r);
    r->made->stencils[point_count] = r->term_count;
    return LIMN_BAKE_OK;
}

// ---- All of it

static limn_bake_status begin_mesh(const refiner *r) {
    const uint32_t point_count = r->point_count;
    limni_context *const context = r->context;
    const size_t face_count = 4 * (size_t)r->mesh->face_count;
    limni_mesh *const made = &r->made->mesh;
    *made = *r->mesh;
    made->control_count = point_count;
    made->face_count = (uint32_t)face_count;
    made->hole_count = 4 * r->mesh->hole_count;
    made->controls = NULL;
    made->origins = r->origins;
    made->edge_sharpness = made->vertex_sharpness = NULL;
    made->faces = limni_allocate(context, face_count, sizeof *made->faces);
    made->polygons = limni_allocate(context, face_count, sizeof *made->polygons);
    made->holes = limni_allocate(context, face_count, sizeof *made->holes);
    made->pairs = limni_allocate(context, 3 * face_count, sizeof *made->pairs);
    made->first = limni_allocate(context, point_count, sizeof *made->first);
    made->valences = limni_allocate(context, point_count, sizeof *made->valences);
    return made->faces && made->polygons && made->holes && made->pairs && made->first &&
                   made->valences
               ? LIMN_BAKE_OK
               : LIMN_BAKE_MEMORY;
}

limn_bake_status limni_refine(limni_context *context, const limni_mesh *mesh,
                              const limni_mesh_sharpness *sharpness, const limni_rules *rules,
                              limni_refined *refined) {
    refiner r = {.context = context,
                 .mesh = mesh,
                 .sharpness = sharpness,
                 .rules = rules,
                 .points = limni_allocate(context, 3 * (size_t)mesh->face_count, sizeof *r.points),
                 .made = refined};
    *refined = (limni_refined){0};
    if (!r.points) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(number_points(&r));
    LIMNI_TRY(begin_mesh(&r));
    for (uint32_t face = 0; face < mesh->face_count; face++)
        split_face(&r, face);
    find_first(&r);
    LIMNI_TRY(begin_stars(&r));
    LIMNI_TRY(sharpen(&r));
    LIMNI_TRY(make_stencils(&r));
    limni_release(context, r.points);
    limni_release(context, r.edges);
    limni_release(context, r.room);
    limni_release(context, r.ring_edges);
    limni_release(context, r.weights);
    return LIMN_BAKE_OK;
}

void limni_refined_end(limni_context *context, limni_refined *refined) {
    limni_mesh_sharpness_end(context, &refined->sharpness);
    limni_release(context, refined->mesh.faces);
    limni_release(context, refined->mesh.polygons);
    limni_release(context, refined->mesh.holes);
    limni_release(context, refined->mesh.pairs);
    limni_release(context, refined->mesh.first);
    limni_release(context, refined->mesh.valences);
    limni_release(context, refined->mesh.origins);
}
