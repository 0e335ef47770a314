/* SPDX-License-Identifier: MIT */
#include "masks.h"

// ---- Memory

/// The most terms that a point can have.
static size_t find_term_max(const limni_mesh *mesh) {
    size_t most = 0;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        uint32_t h = mesh->first[c];
        if (h == LIMNI_NONE) continue;
        size_t count = 1 + (size_t)mesh->valences[c];
        do {
            const size_t size = limni_face_size(mesh, mesh->face_of[h]);
            most = 2 + 2 * size > most ? 2 + 2 * size : most; // an edge, as if both were as large
            count += size;
            h = limni_half_edge_turn(mesh, h);
        } while (h != LIMNI_NONE && h != mesh->first[c]);
        most = count > most ? count : most;
    }
    // The other side of an edge may be larger, or there is a face alone.
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const size_t size = limni_face_size(mesh, f);
        most = 2 + 2 * size > most ? 2 + 2 * size : most;
    }
    return most;
}

limn_bake_status limni_masks_begin(limni_context *context, limni_masks *masks,
                                   const limni_mesh *mesh, const limni_mesh_sharpness *sharpness,
                                   const limni_rules *rules) {
    const size_t widest = limni_valence_max(mesh);
    *masks = (limni_masks){
        .mesh = mesh,
        .sharpness = sharpness,
        .rules = rules,
        .scheme = limni_scheme_of(rules, mesh->domain),
        .widest = widest,
        .terms =
            limni_allocate(context, find_term_max(mesh) + 2 * widest + 32, sizeof *masks->terms),
        .room = limni_allocate(context, 7 * widest, sizeof *masks->room),
    };
    for (int w = 0; w < 2; w++)
        masks->weights[w] = limni_allocate(context, 1 + 2 * widest, sizeof *masks->weights[w]);
    if (!masks->terms || !masks->room || !masks->weights[0] || !masks->weights[1])
        return LIMN_BAKE_MEMORY;
    masks->star = (limni_star){.ring = masks->room,
                               .edges = masks->room + widest,
                               .beyond = masks->room + 2 * widest,
                               .diagonals = masks->room + 3 * widest};
    masks->ring_edges = masks->room + 4 * widest;
    masks->other = (limni_star){.ring = masks->room + 5 * widest};
    masks->other_edges = masks->room + 6 * widest;
    return LIMN_BAKE_OK;
}

void limni_masks_end(limni_context *context, limni_masks *masks) {
    limni_release(context, masks->terms);
    limni_release(context, masks->room);
    limni_release(context, masks->weights[0]);
    limni_release(context, masks->weights[1]);
}

// ---- Stars

/// A half-edge to each ring vertex.
static void list_edges(const limni_mesh *mesh, uint32_t h, uint32_t count, uint32_t *edges) {
    for (uint32_t r = 0; r < count; r++) {
        const uint32_t previous = limni_half_edge_previous(mesh, h);
        edges[r] = h;
        // Beyond the last face of an open star there is the edge that comes in.
        h = mesh->pairs[previous] == LIMNI_NONE ? previous : mesh->pairs[previous];
    }
}

void limni_masks_look(limni_masks *masks, uint32_t control, uint32_t h) {
    const limni_mesh *const mesh = masks->mesh;
    const bool given = h != LIMNI_NONE && !limni_is_boundary(mesh, control);
    const uint32_t first = given ? h : mesh->first[control];
    masks->vertex = control;
    limni_mesh_star(mesh, masks->sharpness, first, &masks->star);
    list_edges(mesh, first, masks->star.count, masks->ring_edges);
}

uint32_t limni_masks_look_beside(limni_masks *masks, uint32_t r) {
    const limni_mesh *const mesh = masks->mesh;
    const uint32_t first = mesh->first[masks->star.ring[r]];
    const uint32_t h = masks->ring_edges[r], pair = mesh->pairs[h];
    limni_mesh_star(mesh, masks->sharpness, first, &masks->other);
    list_edges(mesh, first, masks->other.count, masks->other_edges);
    uint32_t place = 0;
    while (masks->other_edges[place] != h && masks->other_edges[place] != pair)
        place++;
    return place;
}

// ---- Terms

void limni_masks_add(limni_masks *masks, uint32_t control, limni_fixed weight) {
    if (weight != 0) masks->terms[masks->term_count++] = (limni_term){control, weight};
}

/// The middle of a face is the mean of its corners.
static void add_middle(limni_masks *masks, uint32_t face, limni_fixed weight) {
    const limni_mesh *const mesh = masks->mesh;
    const limni_fixed share = (limni_fixed)limni_wide_divide(weight, limni_face_size(mesh, face));
    for (uint32_t h = mesh->offsets[face]; h < mesh->offsets[face + 1]; h++)
        limni_masks_add(masks, mesh->corners[h], share);
}

/// The vertex and its neighbours.
static void add_ring(limni_masks *masks, const limni_fixed *weights) {
    limni_masks_add(masks, masks->vertex, weights[0]);
    for (uint32_t r = 0; r < masks->star.count; r++)
        limni_masks_add(masks, masks->star.ring[r], weights[1 + r]);
}

void limni_masks_add_star(limni_masks *masks, const limni_fixed *weights) {
    const limni_star *const star = &masks->star;
    add_ring(masks, weights);
    for (uint32_t f = 0; star->diagonals && f < limni_star_face_count(star); f++)
        limni_masks_add(masks, star->diagonals[f], weights[1 + star->count + f]);
}

/// What an edge has of the face of one of its half-edges.
static void add_beside(limni_masks *masks, uint32_t h, limni_fixed weight) {
    const limni_mesh *const mesh = masks->mesh;
    if (h == LIMNI_NONE) return;
    if (masks->scheme->domain == LIMN_DOMAIN_QUAD) {
        add_middle(masks, mesh->face_of[h], weight);
    } else {
        limni_masks_add(masks, mesh->corners[limni_half_edge_previous(mesh, h)], weight);
    }
}

void limni_masks_add_edge(limni_masks *masks, uint32_t r, const limni_edge_mask *mask) {
    const uint32_t h = masks->ring_edges[r];
    limni_masks_add(masks, masks->vertex, mask->ends[0]);
    limni_masks_add(masks, masks->star.ring[r], mask->ends[1]);
    add_beside(masks, h, mask->beside);
    add_beside(masks, masks->mesh->pairs[h], mask->beside);
}

// ---- What a scheme says

void limni_masks_vertex(limni_masks *masks) {
    const limni_star *const star = &masks->star;
    limni_fixed *const weights = masks->weights[0];
    masks->scheme->vertex_mask(masks->rules, star, weights);
    masks->term_count = 0;
    add_ring(masks, weights);
    if (masks->scheme->domain != LIMN_DOMAIN_QUAD) return;
    for (uint32_t f = 0; f < limni_star_face_count(star); f++)
        add_middle(masks, masks->mesh->face_of[masks->ring_edges[f]], weights[1 + star->count + f]);
}

void limni_masks_edge(limni_masks *masks, uint32_t r) {
    masks->term_count = 0;
    masks->scheme->edge_terms(masks, r);
}

void limni_masks_face(limni_masks *masks, uint32_t face) {
    masks->term_count = 0;
    add_middle(masks, face, LIMNI_FIXED_ONE);
}

void limni_masks_limit(limni_masks *masks) {
    masks->scheme->limit_mask(masks->rules, &masks->star, masks->weights[0]);
    masks->term_count = 0;
    limni_masks_add_star(masks, masks->weights[0]);
}

void limni_masks_tangent(limni_masks *masks, uint32_t half_steps, int tangent) {
    masks->term_count = 0;
    masks->scheme->tangent_terms(masks, half_steps, tangent);
}
