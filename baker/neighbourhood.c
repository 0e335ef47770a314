/* SPDX-License-Identifier: MIT */
#include "neighbourhood.h"

#include "hash.h"

#include <string.h>

/// Numbers of the mesh, and what they become: a hash table.
typedef struct renaming {
    uint64_t *pairs; ///< [size] number << 32 | new number, or FREE
    uint32_t size, count;
} renaming;
#define FREE UINT64_MAX

typedef struct cutter {
    limni_context *context;
    const limni_cutting *from;
    renaming slots, faces;
    uint32_t *half_edges; ///< [half_edge_count] of the mesh, by those of the part
    limni_neighbourhood *made;
} cutter;

static limn_bake_status begin_renaming(limni_context *context, size_t most, renaming *names) {
    names->size = limni_hash_size((uint32_t)most);
    names->pairs = limni_allocate(context, names->size, sizeof *names->pairs);
    if (!names->pairs) return LIMN_BAKE_MEMORY;
    memset(names->pairs, 0xff, names->size * sizeof *names->pairs);
    return LIMN_BAKE_OK;
}

/// Where a number is, or where it would go.
static uint64_t *find_name(const renaming *names, uint32_t number) {
    uint32_t at = (uint32_t)limni_hash_mix(0, number) & (names->size - 1);
    while (names->pairs[at] != FREE && names->pairs[at] >> 32 != number)
        at = (at + 1) & (names->size - 1);
    return &names->pairs[at];
}

/// Gives a number the next name. False: it has one.
static bool give_name(renaming *names, uint32_t number) {
    uint64_t *const place = find_name(names, number);
    if (*place != FREE) return false;
    *place = (uint64_t)number << 32 | names->count++;
    return true;
}

static uint32_t rename_of(const renaming *names, uint32_t number) {
    return (uint32_t)*find_name(names, number); // of FREE, LIMNI_NONE
}

static limn_bake_status name_slots(cutter *c) {
    LIMNI_TRY(begin_renaming(c->context, c->from->control_count, &c->slots));
    for (uint32_t slot = 0; slot < c->from->control_count; slot++)
        give_name(&c->slots, c->from->controls[slot]);
    return LIMN_BAKE_OK;
}

static void name_face(cutter *c, uint32_t face) {
    if (give_name(&c->faces, face)) c->made->faces[c->faces.count - 1] = face;
}

/// The face itself, and those around all inner vertices.
static limn_bake_status name_faces(cutter *c) {
    const limni_mesh *const mesh = c->from->mesh;
    size_t room = 1;
    for (uint32_t slot = 0; slot < c->from->inner_count; slot++)
        room += mesh->valences[c->from->controls[slot]];
    LIMNI_TRY(begin_renaming(c->context, room, &c->faces));
    c->made->faces = limni_allocate(c->context, room, sizeof *c->made->faces);
    if (!c->made->faces) return LIMN_BAKE_MEMORY;
    name_face(c, mesh->face_of[c->from->half_edge]);
    for (uint32_t slot = 0; slot < c->from->inner_count; slot++) {
        const uint32_t first = mesh->first[c->from->controls[slot]];
        uint32_t h = first;
        do {
            name_face(c, mesh->face_of[h]);
            h = limni_half_edge_turn(mesh, h);
        } while (h != LIMNI_NONE && h != first);
    }
    return LIMN_BAKE_OK;
}

/// Copies the half-edges of all faces.
static limn_bake_status copy_faces(cutter *c) {
    const limni_mesh *const mesh = c->from->mesh;
    limni_mesh *const made = &c->made->mesh;
    made->offsets = limni_allocate(c->context, (size_t)made->face_count + 1, sizeof *made->offsets);
    if (!made->offsets) return LIMN_BAKE_MEMORY;
    made->offsets[0] = 0;
    for (uint32_t f = 0; f < made->face_count; f++)
        made->offsets[f + 1] = made->offsets[f] + limni_face_size(mesh, c->made->faces[f]);
    LIMNI_TRY(limni_index_half_edges(c->context, made));
    made->corners = limni_allocate(c->context, made->half_edge_count, sizeof *made->corners);
    c->half_edges = limni_allocate(c->context, made->half_edge_count, sizeof *c->half_edges);
    if (!made->corners || !c->half_edges) return LIMN_BAKE_MEMORY;
    for (uint32_t f = 0; f < made->face_count; f++) {
        uint32_t h = f == 0 ? c->from->half_edge : mesh->offsets[c->made->faces[f]];
        for (uint32_t own = made->offsets[f]; own < made->offsets[f + 1]; own++) {
            c->half_edges[own] = h;
            made->corners[own] = rename_of(&c->slots, mesh->corners[h]);
            h = limni_half_edge_next(mesh, h);
        }
    }
    return LIMN_BAKE_OK;
}

/// The half-edge of the part that is this one of the mesh, or LIMNI_NONE.
static uint32_t find_half_edge(const cutter *c, uint32_t h) {
    const uint32_t face =
        h == LIMNI_NONE ? LIMNI_NONE : rename_of(&c->faces, c->from->mesh->face_of[h]);
    if (face == LIMNI_NONE) return LIMNI_NONE;
    uint32_t own = c->made->mesh.offsets[face];
    while (c->half_edges[own] != h)
        own++;
    return own;
}

static limn_bake_status connect(cutter *c) {
    const limni_mesh *const mesh = c->from->mesh;
    limni_mesh *const made = &c->made->mesh;
    made->pairs = limni_allocate(c->context, made->half_edge_count, sizeof *made->pairs);
    made->first = limni_allocate(c->context, made->control_count, sizeof *made->first);
    made->valences = limni_allocate_zeroed(c->context, made->control_count, sizeof *made->valences);
    made->polygons = limni_allocate_zeroed(c->context, made->face_count, sizeof *made->polygons);
    made->holes = limni_allocate_zeroed(c->context, made->face_count, sizeof *made->holes);
    if (!made->pairs || !made->first || !made->valences || !made->polygons || !made->holes)
        return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < made->half_edge_count; h++)
        made->pairs[h] = find_half_edge(c, mesh->pairs[c->half_edges[h]]);
    for (uint32_t slot = 0; slot < made->control_count; slot++) {
        const uint32_t control = c->from->controls[slot];
        made->first[slot] = LIMNI_NONE;
        if (slot >= c->from->inner_count) continue;
        made->first[slot] = find_half_edge(c, mesh->first[control]);
        made->valences[slot] = mesh->valences[control];
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status copy_sharpness(cutter *c) {
    const limni_mesh_sharpness *const from = c->from->sharpness;
    limni_mesh_sharpness *const made = &c->made->sharpness;
    const uint32_t count = c->made->mesh.half_edge_count;
    made->vertices =
        limni_allocate_zeroed(c->context, c->from->control_count, sizeof *made->vertices);
    if (!made->vertices) return LIMN_BAKE_MEMORY;
    for (uint32_t slot = 0; slot < c->from->inner_count; slot++)
        made->vertices[slot] = from->vertices[c->from->controls[slot]];
    if (!from->edges || !c->from->with_edges) return LIMN_BAKE_OK;
    made->edges = limni_allocate(c->context, count, sizeof *made->edges);
    made->seen = limni_allocate(c->context, count, sizeof *made->seen);
    if (!made->edges || !made->seen) return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < count; h++) {
        made->edges[h] = from->edges[c->half_edges[h]];
        made->seen[h][0] = from->seen[c->half_edges[h]][0];
        made->seen[h][1] = from->seen[c->half_edges[h]][1];
    }
    return LIMN_BAKE_OK;
}

limn_bake_status limni_neighbourhood_begin(limni_context *context, const limni_cutting *cutting,
                                           limni_neighbourhood *neighbourhood) {
    cutter c = {.context = context, .from = cutting, .made = neighbourhood};
    *neighbourhood = (limni_neighbourhood){0};
    LIMNI_TRY(name_slots(&c));
    LIMNI_TRY(name_faces(&c));
    neighbourhood->mesh = (limni_mesh){.domain = cutting->mesh->domain,
                                       .control_count = cutting->control_count,
                                       .face_count = c.faces.count};
    LIMNI_TRY(copy_faces(&c));
    LIMNI_TRY(connect(&c));
    LIMNI_TRY(copy_sharpness(&c));
    limni_release(context, c.slots.pairs);
    limni_release(context, c.faces.pairs);
    limni_release(context, c.half_edges);
    return LIMN_BAKE_OK;
}

// ---- Fans

static limn_bake_status allocate_fan(limni_context *context, const limni_star *star,
                                     limni_neighbourhood *fan) {
    limni_mesh *const mesh = &fan->mesh;
    const uint32_t faces = limni_star_face_count(star), size = star->diagonals ? 4 : 3;
    const size_t vertices = 1 + (size_t)star->count + (star->diagonals ? faces : 0);
    *fan = (limni_neighbourhood){0};
    *mesh = (limni_mesh){
        .domain = star->diagonals ? LIMN_DOMAIN_QUAD : LIMN_DOMAIN_TRIANGLE,
        .control_count = (uint32_t)vertices,
        .face_count = faces,
        .offsets = limni_allocate(context, 1 + (size_t)faces, sizeof *mesh->offsets),
        .corners = limni_allocate(context, size * (size_t)faces, sizeof *mesh->corners),
        .pairs = limni_allocate(context, size * (size_t)faces, sizeof *mesh->pairs),
        .polygons = limni_allocate_zeroed(context, faces, sizeof *mesh->polygons),
        .holes = limni_allocate_zeroed(context, faces, sizeof *mesh->holes),
        .first = limni_allocate(context, vertices, sizeof *mesh->first),
        .valences = limni_allocate_zeroed(context, vertices, sizeof *mesh->valences),
    };
    fan->sharpness.vertices = limni_allocate_zeroed(context, vertices, sizeof(limni_sharpness));
    if (!mesh->offsets || !mesh->corners || !mesh->pairs || !mesh->polygons || !mesh->holes ||
        !mesh->first || !mesh->valences || !fan->sharpness.vertices)
        return LIMN_BAKE_MEMORY;
    for (uint32_t f = 0; f <= faces; f++)
        mesh->offsets[f] = size * f;
    memset(mesh->pairs, 0xff, size * (size_t)faces * sizeof *mesh->pairs);
    memset(mesh->first, 0xff, vertices * sizeof *mesh->first);
    return limni_index_half_edges(context, mesh);
}

static limn_bake_status sharpen_fan(limni_context *context, const limni_star *star,
                                    limni_neighbourhood *fan) {
    const uint32_t count = fan->mesh.half_edge_count, size = star->diagonals ? 4 : 3;
    limni_mesh_sharpness *const made = &fan->sharpness;
    made->vertices[0] = star->sharpness;
    if (!star->edges) return LIMN_BAKE_OK;
    made->edges = limni_allocate_zeroed(context, count, sizeof *made->edges);
    made->seen = limni_allocate_zeroed(context, count, sizeof *made->seen);
    if (!made->edges || !made->seen) return LIMN_BAKE_MEMORY;
    for (uint32_t f = 0; f < fan->mesh.face_count; f++) {
        const uint32_t next = limni_star_left(star, f), last = size * f + size - 1;
        made->edges[size * f] = star->edges[f];
        made->seen[size * f][1] = star->beyond[f];
        made->edges[last] = star->edges[next];
        made->seen[last][0] = star->beyond[next];
    }
    return LIMN_BAKE_OK;
}

limn_bake_status limni_fan_begin(limni_context *context, const limni_star *star,
                                 limni_neighbourhood *fan) {
    LIMNI_TRY(allocate_fan(context, star, fan));
    limni_mesh *const mesh = &fan->mesh;
    const uint32_t size = star->diagonals ? 4 : 3;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t next = limni_star_left(star, f);
        uint32_t *const corners = mesh->corners + size * f;
        corners[0] = 0;
        corners[1] = 1 + f;
        corners[2] = 1 + star->count + f;
        corners[size - 1] = 1 + next;
        if (f + 1 == mesh->face_count && !star->closed) continue;
        mesh->pairs[size * f + size - 1] = size * next;
        mesh->pairs[size * next] = size * f + size - 1;
    }
    mesh->first[0] = 0;
    mesh->valences[0] = star->count;
    return sharpen_fan(context, star, fan);
}

void limni_neighbourhood_end(limni_context *context, limni_neighbourhood *neighbourhood) {
    limni_mesh_end(context, &neighbourhood->mesh);
    limni_mesh_sharpness_end(context, &neighbourhood->sharpness);
    limni_release(context, neighbourhood->faces);
}
