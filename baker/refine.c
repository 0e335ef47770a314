/* SPDX-License-Identifier: MIT */
#include "refine.h"

#include "hash.h"
#include "masks.h"
#include "topology.h"

#include <stdlib.h>

typedef struct refiner {
    limni_context *context;
    const limni_mesh *mesh;
    const limni_mesh_sharpness *sharpness;
    const limni_rules *rules;
    bool quads;
    uint32_t *origins; ///< [point_count] see limni_mesh
    uint32_t point_count;
    limni_refined *made;
} refiner;

// ---- Points

/// The edges in the order of their points. Where the mesh was split, those that were one edge are
/// side by side, so that each sheet has their points in the same order (baker/split.c).
static uint32_t list_edges(const limni_mesh *mesh, limni_keyed_edge *edges) {
    uint32_t count = 0;
    for (uint32_t h = 0; h < mesh->half_edge_count; h++) {
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

/// Of points that were one, the first. Those in faces are alone.
static void find_origins(const limni_mesh *mesh, const limni_keyed_edge *edges, uint32_t edge_count,
                         uint32_t point_count, uint32_t *origins) {
    for (uint32_t c = 0; c < mesh->control_count; c++)
        origins[c] = c > 0 && mesh->origins[c - 1] == mesh->origins[c] ? origins[c - 1] : c;
    for (uint32_t p = mesh->control_count; p < point_count; p++)
        origins[p] = p;
    for (uint32_t e = 1; e < edge_count; e++) {
        uint32_t *const origin = &origins[mesh->control_count + e];
        if (were_one(mesh, &edges[e - 1], &edges[e])) *origin = origin[-1];
    }
}

static void number_edges(refiner *r, const limni_keyed_edge *edges) {
    const limni_mesh *const mesh = r->mesh;
    for (uint32_t e = 0; e < r->made->edge_count; e++) {
        const uint32_t h = edges[e].half_edge, point = mesh->control_count + e;
        r->made->edges[e] = h;
        r->made->edge_points[h] = point;
        if (mesh->pairs[h] != LIMNI_NONE) r->made->edge_points[mesh->pairs[h]] = point;
    }
}

static limn_bake_status number_points(refiner *r) {
    const limni_mesh *const mesh = r->mesh;
    limni_refined *const made = r->made;
    limni_keyed_edge *const edges =
        limni_allocate(r->context, mesh->half_edge_count, sizeof *edges);
    made->edge_points =
        limni_allocate(r->context, mesh->half_edge_count, sizeof *made->edge_points);
    made->edges = limni_allocate(r->context, mesh->half_edge_count, sizeof *made->edges);
    if (!edges || !made->edge_points || !made->edges) return LIMN_BAKE_MEMORY;
    made->edge_count = list_edges(mesh, edges);
    number_edges(r, edges);
    made->first_face_point = mesh->control_count + made->edge_count;
    r->point_count =
        made->first_face_point + (mesh->domain == LIMN_DOMAIN_QUAD ? mesh->face_count : 0);
    if (mesh->origins) {
        r->origins = limni_allocate(r->context, r->point_count, sizeof *r->origins);
        if (!r->origins) return LIMN_BAKE_MEMORY;
        find_origins(mesh, edges, made->edge_count, r->point_count, r->origins);
    }
    limni_release(r->context, edges);
    return LIMN_BAKE_OK;
}

// ---- Faces

/// Half-edge `edge` of face `piece` of those that triangle f becomes.
static uint32_t triangle_child(uint32_t face, uint32_t piece, uint32_t edge) {
    return 3 * (4 * face + piece) + edge;
}

/// The halves of half-edge h. Of triangles, its place is that of its corner.
static uint32_t first_half(const refiner *r, uint32_t h) {
    return r->quads ? 4 * h : triangle_child(h / 3, h % 3, 0);
}
static uint32_t second_half(const refiner *r, uint32_t h) {
    return r->quads ? 4 * limni_half_edge_next(r->mesh, h) + 3
                    : triangle_child(h / 3, (h + 1) % 3, 2);
}

static void pair(limni_mesh *mesh, uint32_t a, uint32_t b) {
    mesh->pairs[a] = b;
    mesh->pairs[b] = a;
}

static void split_triangle(const refiner *r, uint32_t f) {
    limni_mesh *const made = &r->made->mesh;
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t before = (k + 2) % 3, h = 3 * f + k;
        uint32_t *const corners = made->corners + triangle_child(f, k, 0);
        corners[0] = r->mesh->corners[h];
        corners[1] = r->made->edge_points[h];
        corners[2] = r->made->edge_points[3 * f + before];
        made->corners[triangle_child(f, 3, k)] = r->made->edge_points[h];
        pair(made, triangle_child(f, k, 1), triangle_child(f, 3, before));
    }
}

static void split_polygon(const refiner *r, uint32_t f) {
    const limni_mesh *const mesh = r->mesh;
    limni_mesh *const made = &r->made->mesh;
    for (uint32_t h = mesh->offsets[f]; h < mesh->offsets[f + 1]; h++) {
        uint32_t *const corners = made->corners + 4 * h;
        corners[0] = mesh->corners[h];
        corners[1] = r->made->edge_points[h];
        corners[2] = r->made->first_face_point + f;
        corners[3] = r->made->edge_points[limni_half_edge_previous(mesh, h)];
        pair(made, 4 * h + 1, 4 * limni_half_edge_next(mesh, h) + 2);
    }
}

static void split_face(const refiner *r, uint32_t f) {
    const limni_mesh *const mesh = r->mesh;
    limni_mesh *const made = &r->made->mesh;
    if (r->quads)
        split_polygon(r, f);
    else
        split_triangle(r, f);
    for (uint32_t h = mesh->offsets[f]; h < mesh->offsets[f + 1]; h++) {
        const uint32_t other = mesh->pairs[h];
        made->pairs[first_half(r, h)] = other == LIMNI_NONE ? LIMNI_NONE : second_half(r, other);
        made->pairs[second_half(r, h)] = other == LIMNI_NONE ? LIMNI_NONE : first_half(r, other);
    }
    const uint32_t first = limni_first_child(mesh, f), end = limni_first_child(mesh, f + 1);
    for (uint32_t child = first; child < end; child++) {
        made->polygons[child] = mesh->polygons[f];
        made->holes[child] = mesh->holes[f];
    }
}

/// New points have whole stars where the edge or face has.
static void find_first(const refiner *r) {
    const limni_mesh *const mesh = r->mesh;
    limni_mesh *const made = &r->made->mesh;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        const uint32_t first = mesh->first[c];
        made->valences[c] = mesh->valences[c];
        made->first[c] = first == LIMNI_NONE ? LIMNI_NONE : first_half(r, first);
    }
    for (uint32_t e = 0; e < r->made->edge_count; e++) {
        const uint32_t h = r->made->edges[e], point = r->made->edge_points[h];
        const bool boundary = mesh->pairs[h] == LIMNI_NONE;
        made->valences[point] = r->quads ? (boundary ? 3u : 4u) : (boundary ? 4u : 6u);
        made->first[point] = second_half(r, h);
    }
    for (uint32_t f = 0; r->quads && f < mesh->face_count; f++) {
        made->valences[r->made->first_face_point + f] = limni_face_size(mesh, f);
        made->first[r->made->first_face_point + f] = 4 * mesh->offsets[f] + 2;
    }
}

static limn_bake_status begin_mesh(const refiner *r) {
    limni_context *const context = r->context;
    const uint32_t face_count = limni_first_child(r->mesh, r->mesh->face_count);
    const uint32_t size = r->quads ? 4 : 3;
    limni_mesh *const made = &r->made->mesh;
    *made = *r->mesh;
    made->divided = r->mesh;
    made->control_count = r->point_count;
    made->face_count = face_count;
    made->controls = NULL;
    made->source_corners = NULL;
    made->origins = r->origins;
    made->edge_sharpness = made->vertex_sharpness = NULL;
    made->offsets = limni_allocate(context, (size_t)face_count + 1, sizeof *made->offsets);
    made->corners = limni_allocate(context, size * (size_t)face_count, sizeof *made->corners);
    made->polygons = limni_allocate(context, face_count, sizeof *made->polygons);
    made->holes = limni_allocate(context, face_count, sizeof *made->holes);
    made->pairs = limni_allocate(context, size * (size_t)face_count, sizeof *made->pairs);
    made->first = limni_allocate(context, r->point_count, sizeof *made->first);
    made->valences = limni_allocate(context, r->point_count, sizeof *made->valences);
    if (!made->offsets || !made->corners || !made->polygons || !made->holes || !made->pairs ||
        !made->first || !made->valences)
        return LIMN_BAKE_MEMORY;
    for (uint32_t f = 0; f <= face_count; f++)
        made->offsets[f] = size * f;
    return limni_index_half_edges(context, made);
}

static limn_bake_status split_faces(refiner *r) {
    LIMNI_TRY(begin_mesh(r));
    limni_mesh *const made = &r->made->mesh;
    for (uint32_t f = 0; f < r->mesh->face_count; f++)
        split_face(r, f);
    find_first(r);
    made->hole_count = 0;
    for (uint32_t f = 0; f < made->face_count; f++)
        made->hole_count += made->holes[f];
    return LIMN_BAKE_OK;
}

// ---- Sharpness

/// What there is to know at both ends of a half-edge, and of its pair.
static void tell(const refiner *r, uint32_t h, uint32_t at_start, uint32_t at_end) {
    uint32_t(*const seen)[2] = r->made->sharpness.seen;
    const uint32_t other = r->made->mesh.pairs[h];
    seen[h][0] = at_start;
    seen[h][1] = at_end;
    if (other == LIMNI_NONE) return;
    seen[other][0] = at_end;
    seen[other][1] = at_start;
}

/// Halves of edges have what is left at their ends. Their other ends are new, and so is what is
/// known of those beyond them.
static void sharpen_edges(refiner *r, limni_masks *masks, uint32_t control, uint32_t *left,
                          uint32_t *seen) {
    limni_sharpness *const edges = r->made->sharpness.edges;
    limni_masks_look(masks, control, LIMNI_NONE);
    const limni_star *const star = &masks->star;
    for (uint32_t k = 0; k < star->count; k++)
        left[k] = limni_star_next_edge(r->rules, star, k);
    const limni_star next = {.closed = star->closed,
                             .count = star->count,
                             .ring = star->ring,
                             .sharpness = r->made->sharpness.vertices[control],
                             .edges = left,
                             .beyond = star->beyond};
    limni_star_see(r->rules, &next, 0, star->count, seen);
    for (uint32_t k = 0; k < star->count; k++) {
        const uint32_t h = masks->ring_edges[k], beyond = limni_star_next_beyond(r->rules, star, k);
        const bool leaves = r->mesh->corners[h] == control;
        const uint32_t half = leaves ? first_half(r, h) : second_half(r, h);
        const uint32_t other = r->made->mesh.pairs[half];
        edges[half] = left[k];
        if (other != LIMNI_NONE) edges[other] = left[k];
        tell(r, half, leaves ? seen[k] : beyond, leaves ? beyond : seen[k]);
    }
}

static limn_bake_status sharpen(refiner *r) {
    const limni_mesh *const mesh = r->mesh;
    limni_mesh_sharpness *const made = &r->made->sharpness;
    const size_t half_edge_count = r->made->mesh.half_edge_count;
    made->vertices = limni_allocate_zeroed(r->context, r->point_count, sizeof *made->vertices);
    if (!made->vertices) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        made->vertices[c] = limni_sharpness_next(r->sharpness->vertices[c]);
    if (!r->sharpness->edges) return LIMN_BAKE_OK;
    made->edges = limni_allocate_zeroed(r->context, half_edge_count, sizeof *made->edges);
    made->seen = limni_allocate_zeroed(r->context, half_edge_count, sizeof *made->seen);
    if (!made->edges || !made->seen) return LIMN_BAKE_MEMORY;
    limni_masks masks;
    LIMNI_TRY(limni_masks_begin(r->context, &masks, mesh, r->sharpness, r->rules));
    uint32_t *const room = limni_allocate(r->context, 2 * masks.widest, sizeof *room);
    if (!room) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        if (mesh->first[c] != LIMNI_NONE) sharpen_edges(r, &masks, c, room, room + masks.widest);
    }
    limni_release(r->context, room);
    limni_masks_end(r->context, &masks);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_refine(limni_context *context, const limni_mesh *mesh,
                              const limni_mesh_sharpness *sharpness, const limni_rules *rules,
                              limni_refined *refined) {
    refiner r = {.context = context,
                 .mesh = mesh,
                 .sharpness = sharpness,
                 .rules = rules,
                 .quads = mesh->domain == LIMN_DOMAIN_QUAD,
                 .made = refined};
    *refined = (limni_refined){0};
    if (mesh->half_edge_count > LIMNI_CORNERS_MAX) // there will be four times as many
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: more than %u corners of faces to subdivide", limni_mesh_label(mesh),
                          LIMNI_CORNERS_MAX);
    LIMNI_TRY(number_points(&r));
    LIMNI_TRY(split_faces(&r));
    return sharpen(&r);
}

void limni_refined_end(limni_context *context, limni_refined *refined) {
    limni_mesh_sharpness_end(context, &refined->sharpness);
    limni_mesh_end(context, &refined->mesh);
    limni_release(context, refined->edge_points);
    limni_release(context, refined->edges);
}

// ---- Stencils

/// What makes them.
typedef struct writer {
    limni_context *context;
    limni_masks masks;
    limni_stencils *stencils;
    uint32_t count, capacity; ///< of terms
} writer;

static int compare_terms(const void *a, const void *b) {
    const limni_term *const left = a, *const right = b;
    return (left->control > right->control) - (left->control < right->control);
}

/// By ascending controls: so sheets, whose rings start anywhere, add theirs in the same order.
static void sort_terms(limni_term *terms, uint32_t count) {
    if (count > 32) {
        qsort(terms, count, sizeof *terms, compare_terms);
        return;
    }
    for (uint32_t k = 1; k < count; k++) {
        const limni_term term = terms[k];
        uint32_t at = k;
        for (; at > 0 && terms[at - 1].control > term.control; at--)
            terms[at] = terms[at - 1];
        terms[at] = term;
    }
}

/// Appends what the masks say of one point, each vertex once.
static limn_bake_status write_point(writer *w, uint32_t point) {
    limni_term *const terms = w->masks.terms;
    const uint32_t count = w->masks.term_count;
    w->stencils->offsets[point] = w->count;
    if (w->count + (uint64_t)count > w->capacity) {
        const uint64_t capacity = 2 * ((uint64_t)w->count + count);
        if (capacity > UINT32_MAX)
            return limni_fail(w->context, LIMN_BAKE_BAD_INPUT, "too many terms");
        limn_file_term *const grown =
            limni_resize(w->context, w->stencils->terms, (size_t)capacity, sizeof *grown);
        if (!grown) return LIMN_BAKE_MEMORY;
        w->stencils->terms = grown;
        w->capacity = (uint32_t)capacity;
    }
    sort_terms(terms, count);
    for (uint32_t k = 0, next; k < count; k = next) {
        limni_fixed weight = 0;
        for (next = k; next < count && terms[next].control == terms[k].control; next++)
            weight += terms[next].weight;
        if (weight != 0)
            w->stencils->terms[w->count++] =
                (limn_file_term){.point = terms[k].control, .weight = limni_fixed_to_float(weight)};
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status write_vertices(writer *w) {
    for (uint32_t c = 0; c < w->masks.mesh->control_count; c++) {
        if (w->masks.mesh->first[c] == LIMNI_NONE) { // no face uses it
            w->masks.terms[0] = (limni_term){c, LIMNI_FIXED_ONE};
            w->masks.term_count = 1;
        } else {
            limni_masks_look(&w->masks, c, LIMNI_NONE);
            limni_masks_vertex(&w->masks);
        }
        LIMNI_TRY(write_point(w, c));
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status write_edges(writer *w, const limni_refined *refined) {
    const limni_mesh *const mesh = w->masks.mesh;
    for (uint32_t e = 0; e < refined->edge_count; e++) {
        const uint32_t h = refined->edges[e], point = refined->edge_points[h];
        const uint32_t start = mesh->corners[h];
        uint32_t r = 0;
        limni_masks_look(&w->masks, start, h);
        while (refined->edge_points[w->masks.ring_edges[r]] != point)
            r++;
        limni_masks_edge(&w->masks, r);
        LIMNI_TRY(write_point(w, point));
    }
    return LIMN_BAKE_OK;
}

limn_bake_status limni_make_stencils(limni_context *context, const limni_mesh *mesh,
                                     const limni_mesh_sharpness *sharpness,
                                     const limni_rules *rules, const limni_refined *refined,
                                     limni_stencils *stencils) {
    const uint32_t point_count = refined->mesh.control_count;
    writer w = {.context = context, .stencils = stencils};
    *stencils = (limni_stencils){
        .offsets = limni_allocate(context, 1 + (size_t)point_count, sizeof(uint32_t))};
    if (!stencils->offsets) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_masks_begin(context, &w.masks, mesh, sharpness, rules));
    LIMNI_TRY(write_vertices(&w));
    LIMNI_TRY(write_edges(&w, refined));
    for (uint32_t point = refined->first_face_point; point < point_count; point++) {
        limni_masks_face(&w.masks, point - refined->first_face_point);
        LIMNI_TRY(write_point(&w, point));
    }
    stencils->offsets[point_count] = w.count;
    limni_masks_end(context, &w.masks);
    return LIMN_BAKE_OK;
}
