/* SPDX-License-Identifier: MIT */
#include "mesh_sharpness.h"

#include "scheme.h"

static bool any_above_zero(const float *values, size_t count) {
    bool any = false;
    for (size_t v = 0; values && v < count; v++)
        any |= values[v] > 0;
    return any;
}

bool limni_has_sharpness(const limni_mesh *mesh) {
    return any_above_zero(mesh->edge_sharpness, mesh->half_edge_count) ||
           any_above_zero(mesh->vertex_sharpness, mesh->control_count);
}

bool limni_has_boundary(const limni_mesh *mesh) {
    for (uint32_t h = 0; h < mesh->half_edge_count; h++) {
        if (mesh->pairs[h] == LIMNI_NONE) return true;
    }
    return false;
}

/// Whether a boundary edge at the control point is not sharp by a tag.
static bool has_open_boundary(const limni_mesh *mesh, uint32_t control) {
    const uint32_t first = mesh->first[control];
    uint32_t last = first;
    for (uint32_t h = first; h != LIMNI_NONE; h = limni_half_edge_turn(mesh, h))
        last = h;
    const float incoming = mesh->edge_sharpness[limni_half_edge_previous(mesh, last)];
    return mesh->edge_sharpness[first] < LIMNI_SHARP_FOR_EVER || incoming < LIMNI_SHARP_FOR_EVER;
}

static void open_fan(limni_mesh *mesh, uint32_t control) {
    uint32_t h = mesh->first[control];
    if (h == LIMNI_NONE) return;
    do {
        mesh->hole_count += !mesh->holes[mesh->face_of[h]];
        mesh->holes[mesh->face_of[h]] = true;
        h = limni_half_edge_turn(mesh, h);
    } while (h != LIMNI_NONE && h != mesh->first[control]);
}

/// Past the control points that were one.
static uint32_t end_of_split(const limni_mesh *mesh, uint32_t control) {
    uint32_t end = control + 1;
    while (mesh->origins && end < mesh->control_count &&
           mesh->origins[end] == mesh->origins[control])
        end++;
    return end;
}

/// Sheets that were one vertex open together.
void limni_mesh_open_boundary(limni_mesh *mesh) {
    for (uint32_t begin = 0, end; begin < mesh->control_count; begin = end) {
        bool open = false;
        end = end_of_split(mesh, begin);
        for (uint32_t c = begin; c < end; c++)
            open |= limni_is_boundary(mesh, c) && has_open_boundary(mesh, c);
        for (uint32_t c = begin; c < end && open; c++)
            open_fan(mesh, c);
    }
}

bool limni_is_flat(const limni_rules *rules) {
    return rules->scheme == LIMN_SCHEME_NONE;
}

/// Sharp things are smooth.
static bool is_ignored(const limni_rules *rules) {
    return !limni_scheme_has_creases(rules->scheme) && !limni_is_flat(rules);
}

/// Whether an edge is sharp, by its tag or to Lomont's rules as a boundary.
static bool has_sharp_edges(const limni_mesh *mesh, const limni_rules *rules) {
    if (is_ignored(rules)) return false;
    return limni_is_flat(rules) ||
           (rules->creases == LIMN_CREASES_LOMONT && limni_has_boundary(mesh)) ||
           any_above_zero(mesh->edge_sharpness, mesh->half_edge_count);
}

static limn_bake_status convert_edges(limni_context *context, const limni_mesh *mesh,
                                      const limni_rules *rules, limni_mesh_sharpness *sharpness) {
    const size_t count = mesh->half_edge_count;
    sharpness->edges = limni_allocate(context, count, sizeof *sharpness->edges);
    if (!sharpness->edges) return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < count; h++) {
        const bool forever = mesh->pairs[h] == LIMNI_NONE || limni_is_flat(rules);
        sharpness->edges[h] = forever ? LIMNI_SHARPNESS_INFINITE
                                      : limni_sharpness_from_float(mesh->edge_sharpness[h]);
    }
    return LIMN_BAKE_OK;
}

/// Writes what the neighbours of a control point have to know of it to the edges around it.
static void tell_neighbours(const limni_mesh *mesh, uint32_t control, const uint32_t *seen,
                            limni_mesh_sharpness *sharpness) {
    const uint32_t first = mesh->first[control];
    uint32_t h = first, last;
    do {
        const uint32_t pair = mesh->pairs[h];
        sharpness->seen[h][0] = *seen;
        if (pair != LIMNI_NONE) sharpness->seen[pair][1] = *seen;
        seen++;
        last = h;
        h = limni_half_edge_turn(mesh, h);
    } while (h != first && h != LIMNI_NONE);
    if (h == LIMNI_NONE) sharpness->seen[limni_half_edge_previous(mesh, last)][1] = *seen;
}

limn_bake_status limni_mesh_sharpness_see(limni_context *context, const limni_mesh *mesh,
                                          const limni_rules *rules,
                                          limni_mesh_sharpness *sharpness) {
    size_t valence_max = 0;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        valence_max = mesh->valences[c] > valence_max ? mesh->valences[c] : valence_max;
    sharpness->seen =
        limni_allocate_zeroed(context, mesh->half_edge_count, sizeof *sharpness->seen);
    uint32_t *const room = limni_allocate(context, 4 * valence_max, sizeof *room);
    if (!sharpness->seen || !room) return LIMN_BAKE_MEMORY;
    uint32_t *const seen = room + 3 * valence_max;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        limni_star star = {
            .ring = room, .edges = room + valence_max, .beyond = room + 2 * valence_max};
        if (mesh->first[c] == LIMNI_NONE) continue;
        limni_mesh_star(mesh, sharpness, mesh->first[c], &star);
        limni_star_see(rules, &star, 0, star.count, seen);
        tell_neighbours(mesh, c, seen, sharpness);
    }
    limni_release(context, room);
    return LIMN_BAKE_OK;
}

/// A boundary vertex with a single face on all its sheets.
static bool is_boundary_corner(const limni_mesh *mesh, uint32_t control) {
    return limni_is_boundary(mesh, control) && mesh->valences[control] == 2 &&
           !limni_is_split(mesh, control);
}

limn_bake_status limni_mesh_sharpness_begin(limni_context *context, const limni_mesh *mesh,
                                            const limni_rules *rules,
                                            limni_mesh_sharpness *sharpness) {
    *sharpness = (limni_mesh_sharpness){
        .vertices = limni_allocate(context, mesh->control_count, sizeof *sharpness->vertices)};
    if (!sharpness->vertices) return LIMN_BAKE_MEMORY;
    const bool sharpen = rules->boundary == LIMN_BOUNDARY_EDGE_AND_CORNER && !is_ignored(rules);
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        const bool tagged = mesh->vertex_sharpness && !is_ignored(rules);
        const float tag = tagged ? mesh->vertex_sharpness[c] : 0;
        sharpness->vertices[c] = limni_is_flat(rules) || (sharpen && is_boundary_corner(mesh, c))
                                     ? LIMNI_SHARPNESS_INFINITE
                                     : limni_sharpness_from_float(tag);
    }
    if (!has_sharp_edges(mesh, rules)) return LIMN_BAKE_OK;
    LIMNI_TRY(convert_edges(context, mesh, rules, sharpness));
    return limni_mesh_sharpness_see(context, mesh, rules, sharpness);
}

void limni_mesh_sharpness_end(limni_context *context, limni_mesh_sharpness *sharpness) {
    limni_release(context, sharpness->edges);
    limni_release(context, sharpness->vertices);
    limni_release(context, sharpness->seen);
}

/// Adds the neighbour at one end of half-edge h, 0: its start, the other being the star's vertex.
static void add_neighbour(const limni_mesh *mesh, const limni_mesh_sharpness *sharpness, uint32_t h,
                          int end, limni_star *star) {
    if (star->edges) {
        star->edges[star->count] = sharpness->edges[h];
        star->beyond[star->count] = sharpness->seen[h][end];
    }
    star->ring[star->count++] =
        end == 0 ? limni_half_edge_start(mesh, h) : limni_half_edge_end(mesh, h);
}

/// The vertex across the face of a half-edge from its start, if the face is a quad.
static uint32_t diagonal_of(const limni_mesh *mesh, uint32_t h) {
    if (limni_face_size(mesh, mesh->face_of[h]) != 4) return LIMNI_NONE;
    return limni_half_edge_end(mesh, limni_half_edge_next(mesh, h));
}

void limni_mesh_star(const limni_mesh *mesh, const limni_mesh_sharpness *sharpness, uint32_t h,
                     limni_star *star) {
    const uint32_t control = limni_half_edge_start(mesh, h);
    star->closed = !limni_is_boundary(mesh, control);
    star->count = 0;
    star->sharpness = sharpness->vertices[control];
    if (!sharpness->edges) star->edges = star->beyond = NULL;
    if (mesh->domain != LIMN_DOMAIN_QUAD) star->diagonals = NULL;
    const uint32_t start = star->closed ? h : mesh->first[control];
    uint32_t turning = start, last;
    do {
        if (star->diagonals) star->diagonals[star->count] = diagonal_of(mesh, turning);
        add_neighbour(mesh, sharpness, turning, 1, star);
        last = turning;
        turning = limni_half_edge_turn(mesh, turning);
    } while (turning != start && turning != LIMNI_NONE);
    if (star->closed) return;
    const uint32_t incoming = limni_half_edge_previous(mesh, last);
    add_neighbour(mesh, sharpness, incoming, 0, star);
}
