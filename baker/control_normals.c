/* SPDX-License-Identifier: MIT */
#include "control_normals.h"

#include "classes.h"
#include "hash.h"
#include "subdivide.h"

#include <string.h>

/// What builds them.
typedef struct builder {
    limni_context *context;
    const limni_mesh *mesh;
    const limni_mesh_sharpness *sharpness;
    const limni_rules *rules;
    limni_control_normals *normals;
    uint64_t weight_capacity, ring_capacity;
    uint32_t side_capacity;
    uint32_t *first_weights; ///< [rules][valence_max + 1] masks where no edge is sharp but the
                             ///< boundary; LIMNI_NONE where there is none yet
    uint32_t valence_max;
    limni_sharpness *edges;      ///< [valence_max] of a star
    uint32_t *beyond;            ///< likewise
    limni_fixed *along, *across; ///< [2 * valence_max + 1]
    limni_index_table by_masks;  ///< of wide normals: the first control point with these masks
} builder;

enum { RULE_COUNT = 3 };

static limn_bake_status begin(builder *b) {
    b->valence_max = limni_valence_max(b->mesh);
    const size_t count = (size_t)b->valence_max + 1;
    b->first_weights = limni_allocate(b->context, RULE_COUNT * count, sizeof *b->first_weights);
    b->edges = limni_allocate(b->context, count, sizeof *b->edges);
    b->beyond = limni_allocate(b->context, count, sizeof *b->beyond);
    b->along = limni_allocate(b->context, 2 * count, sizeof *b->along);
    b->across = limni_allocate(b->context, 2 * count, sizeof *b->across);
    b->by_masks.size = limni_hash_size(b->mesh->control_count);
    b->by_masks.indices = limni_allocate(b->context, b->by_masks.size, sizeof(uint32_t));
    if (!b->first_weights || !b->edges || !b->beyond || !b->along || !b->across ||
        !b->by_masks.indices)
        return LIMN_BAKE_MEMORY;
    memset(b->by_masks.indices, 0xff, b->by_masks.size * sizeof(uint32_t));
    memset(b->first_weights, 0xff, RULE_COUNT * count * sizeof *b->first_weights);
    return LIMN_BAKE_OK;
}

static void end(const builder *b) {
    limni_release(b->context, b->first_weights);
    limni_release(b->context, b->edges);
    limni_release(b->context, b->beyond);
    limni_release(b->context, b->along);
    limni_release(b->context, b->across);
    limni_release(b->context, b->by_masks.indices);
}

/// Neighbours, and in quads diagonals.
static uint32_t ring_size(const limni_star *star) {
    return star->count + (star->diagonals ? limni_star_face_count(star) : 0);
}

/// What records count has 32 bits.
static limn_bake_status check_count(const builder *b, uint64_t count) {
    if (count <= UINT32_MAX) return LIMN_BAKE_OK;
    return limni_fail(b->context, LIMN_BAKE_BAD_INPUT,
                      "%s: vertices have too many neighbours for exact normals",
                      limni_mesh_label(b->mesh));
}

/// Makes room for more weights.
static limn_bake_status reserve_weights(builder *b, uint64_t size) {
    limni_control_normals *const normals = b->normals;
    LIMNI_TRY(check_count(b, normals->weight_count + size));
    if (normals->weight_count + size > b->weight_capacity) {
        b->weight_capacity = 2 * (b->weight_capacity + size);
        float *const weights =
            limni_resize(b->context, normals->weights, b->weight_capacity, sizeof *weights);
        if (!weights) return LIMN_BAKE_MEMORY;
        normals->weights = weights;
    }
    return LIMN_BAKE_OK;
}

/// Appends the two masks of a star to the weights: those of the ring. Masks sum to zero, so sums
/// relative to the centre need no weight for it.
static limn_bake_status write_mask(builder *b, const limni_star *star, uint32_t half_steps) {
    limni_control_normals *const normals = b->normals;
    const uint32_t count = ring_size(star);
    const uint64_t size = 2 * (uint64_t)count;
    LIMNI_TRY(reserve_weights(b, size));
    LIMNI_TRY(limni_star_tangents(b->context, b->rules, star, half_steps, b->along, b->across));
    float *weight = normals->weights + normals->weight_count;
    for (uint32_t w = 0; w < count; w++) {
        weight[w] = limni_fixed_to_float(b->along[1 + w]);
        weight[count + w] = limni_fixed_to_float(b->across[1 + w]);
    }
    normals->weight_count += size;
    return LIMN_BAKE_OK;
}

static limn_bake_status append_side(builder *b, uint32_t control, const limn_file_normal *record) {
    limni_control_normals *const normals = b->normals;
    if (normals->side_count == b->side_capacity) {
        b->side_capacity += b->side_capacity / 2 + 16;
        limn_file_side *const sides =
            limni_resize(b->context, normals->sides, b->side_capacity, sizeof *sides);
        if (!sides) return LIMN_BAKE_MEMORY;
        normals->sides = sides;
    }
    normals->sides[normals->side_count++] = (limn_file_side){control, *record};
    return LIMN_BAKE_OK;
}

// ---- Sides

/// The parts of the surface around a control point that have normals of their own.
static uint32_t count_sides(const limni_star *star, const limni_feature *last) {
    if (last->rule == LIMNI_VERTEX_CORNER) return limni_star_face_count(star);
    return last->rule == LIMNI_VERTEX_CREASE && star->closed ? 2 : 1;
}

/// The place in the ring where a side starts.
static uint32_t side_start(const limni_feature *last, uint32_t side) {
    if (last->rule == LIMNI_VERTEX_CORNER) return side;
    return last->rule == LIMNI_VERTEX_CREASE ? last->ends[side] : 0;
}

/// The side of the face to the left of ring vertex r.
static uint32_t side_of(const limni_star *star, const limni_feature *last, uint32_t r) {
    if (count_sides(star, last) == 1) return 0;
    if (last->rule == LIMNI_VERTEX_CORNER) return r;
    return r >= last->ends[0] && r < last->ends[1] ? 0 : 1;
}

/// Gives the corners of all faces around a control point their normals: its own, and those of its
/// other sides, which come next.
static void set_corners(const builder *b, uint32_t control, const limni_star *star,
                        const limni_feature *last) {
    const uint32_t next = b->mesh->control_count + b->normals->side_count;
    const uint32_t face_count = limni_star_face_count(star);
    uint32_t h = b->mesh->first[control];
    for (uint32_t r = 0; r < face_count; r++) {
        const uint32_t side = side_of(star, last, r);
        b->normals->corners[h] = side == 0 ? control : next + side - 1;
        h = limni_half_edge_turn(b->mesh, h);
    }
}

// ---- Control points

/// Whether no edge is sharp but the boundary, nor the vertex beyond what valence decides.
static bool is_plain(const limni_rules *rules, const limni_star *star, const limni_feature *last) {
    if (!limni_star_is_settled(rules, star) || count_sides(star, last) > 1) return false;
    return last->rule != LIMNI_VERTEX_DART;
}

/// Writes the record of the first side, and appends those of others.
static limn_bake_status write_sides(builder *b, uint32_t control, const limni_star *star) {
    const limni_feature last = limni_star_last_feature(star);
    limn_file_normal record = {.first_ring = (uint32_t)b->normals->ring_size,
                               .ring_count = ring_size(star)};
    uint32_t scratch = LIMNI_NONE;
    uint32_t *const first = is_plain(b->rules, star, &last)
                                ? &b->first_weights[last.rule * (b->valence_max + 1) + star->count]
                                : &scratch;
    if (*first == LIMNI_NONE) {
        *first = (uint32_t)b->normals->weight_count;
        LIMNI_TRY(write_mask(b, star, 2 * side_start(&last, 0)));
    }
    record.first_weight = *first;
    b->normals->records[control] = record;
    if (b->normals->corners) set_corners(b, control, star, &last);
    for (uint32_t side = 1; side < count_sides(star, &last); side++) {
        record.first_weight = (uint32_t)b->normals->weight_count;
        LIMNI_TRY(write_mask(b, star, 2 * side_start(&last, side)));
        LIMNI_TRY(append_side(b, control, &record));
    }
    return LIMN_BAKE_OK;
}

/// Appends to a list what is not in it yet.
static void list_once(uint32_t *controls, uint32_t *count, uint32_t control) {
    for (uint32_t c = 0; c < *count; c++) {
        if (controls[c] == control) return;
    }
    controls[(*count)++] = control;
}

/// Appends the ring of a control point to a list, from half-edge `first` on.
static void list_ring(const limni_mesh *mesh, uint32_t first, uint32_t *controls, uint32_t *count) {
    uint32_t h = first;
    do {
        const uint32_t incoming = limni_half_edge_previous(mesh, h);
        list_once(controls, count, limni_half_edge_end(mesh, h));
        h = mesh->pairs[incoming];
        if (h == LIMNI_NONE) list_once(controls, count, mesh->corners[incoming]);
    } while (h != LIMNI_NONE && h != first);
}

/// Appends the rings of those around a control point, closed ones from the edge to it on.
static void list_second_rings(const limni_mesh *mesh, uint32_t control, uint32_t *controls,
                              uint32_t *count) {
    uint32_t h = mesh->first[control];
    do {
        const uint32_t neighbour = limni_half_edge_end(mesh, h);
        const uint32_t incoming = limni_half_edge_previous(mesh, h);
        const bool open = limni_is_boundary(mesh, neighbour);
        list_ring(mesh, open ? mesh->first[neighbour] : mesh->pairs[h], controls, count);
        h = mesh->pairs[incoming];
        if (h == LIMNI_NONE) list_ring(mesh, mesh->first[mesh->corners[incoming]], controls, count);
    } while (h != LIMNI_NONE && h != mesh->first[control]);
}

/// A control point, those around it, and those around them, in an order that follows from how they
/// are connected. The first *inner have whole stars.
static limn_bake_status list_two_rings(builder *b, uint32_t control, uint32_t **controls,
                                       uint32_t *count, uint32_t *inner) {
    const limni_mesh *const mesh = b->mesh;
    *controls = limni_allocate(b->context, (1 + (size_t)b->valence_max) * (1 + b->valence_max),
                               sizeof **controls);
    if (!*controls) return LIMN_BAKE_MEMORY;
    *count = 0;
    list_once(*controls, count, control);
    list_ring(mesh, mesh->first[control], *controls, count);
    *inner = *count;
    list_second_rings(mesh, control, *controls, count);
    return LIMN_BAKE_OK;
}

/// Makes room for more of a ring.
static limn_bake_status reserve_ring(builder *b, uint64_t size) {
    LIMNI_TRY(check_count(b, b->normals->ring_size + size));
    if (b->normals->ring_size + size <= b->ring_capacity) return LIMN_BAKE_OK;
    b->ring_capacity = 2 * (b->normals->ring_size + size);
    uint32_t *const ring =
        limni_resize(b->context, b->normals->ring, (size_t)b->ring_capacity, sizeof *ring);
    if (!ring) return LIMN_BAKE_MEMORY;
    b->normals->ring = ring;
    return LIMN_BAKE_OK;
}

/// Sets where the masks of a control point are that were written behind all others: there, or where
/// an equal pair is.
static void share_masks(builder *b, uint32_t control) {
    limni_control_normals *const normals = b->normals;
    limn_file_normal *const record = &normals->records[control];
    const float *const own = normals->weights + normals->weight_count;
    const size_t size = 2 * (size_t)record->ring_count * sizeof *own;
    uint64_t hash = record->ring_count;
    for (uint32_t w = 0; w < 2 * record->ring_count; w++) {
        uint32_t bits;
        memcpy(&bits, &own[w], sizeof bits);
        hash = limni_hash_mix(hash, bits);
    }
    const limni_index_table *const table = &b->by_masks;
    uint32_t at = (uint32_t)hash & (table->size - 1);
    for (; table->indices[at] != LIMNI_NONE; at = (at + 1) & (table->size - 1)) {
        const limn_file_normal *const other = &normals->records[table->indices[at]];
        if (other->ring_count != record->ring_count ||
            memcmp(normals->weights + other->first_weight, own, size) != 0)
            continue;
        record->first_weight = other->first_weight;
        return;
    }
    table->indices[at] = control;
    record->first_weight = (uint32_t)normals->weight_count;
    normals->weight_count += 2 * (uint64_t)record->ring_count;
}

/// Where the scheme reads two rings: those are the ring, each control point once.
static limn_bake_status write_wide_normal(builder *b, uint32_t control) {
    limni_control_normals *const normals = b->normals;
    uint32_t *controls, count, inner;
    limni_neighbourhood around;
    LIMNI_TRY(list_two_rings(b, control, &controls, &count, &inner));
    const limni_cutting cutting = {.mesh = b->mesh,
                                   .sharpness = b->sharpness,
                                   .controls = controls,
                                   .control_count = count,
                                   .inner_count = inner,
                                   .half_edge = b->mesh->first[control]};
    LIMNI_TRY(limni_neighbourhood_begin(b->context, &cutting, &around));
    limni_fixed *const along = limni_allocate(b->context, 2 * (size_t)count, sizeof *along);
    if (!along) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_vertex_tangents(b->context, b->rules, &around, along, along + count));
    LIMNI_TRY(reserve_weights(b, 2 * ((uint64_t)count - 1)));
    LIMNI_TRY(reserve_ring(b, count - 1));
    normals->records[control] =
        (limn_file_normal){.first_ring = (uint32_t)normals->ring_size, .ring_count = count - 1};
    float *weight = normals->weights + normals->weight_count;
    for (uint32_t t = 0; t < 2; t++) {
        for (uint32_t c = 1; c < count; c++)
            *weight++ = limni_fixed_to_float(along[t * count + c]);
    }
    share_masks(b, control);
    memcpy(normals->ring + normals->ring_size, controls + 1, (count - 1) * sizeof *controls);
    normals->ring_size += count - 1;
    limni_release(b->context, along);
    limni_release(b->context, controls);
    limni_neighbourhood_end(b->context, &around);
    return LIMN_BAKE_OK;
}

static limn_bake_status write_normal(builder *b, uint32_t control) {
    limni_control_normals *const normals = b->normals;
    if (b->mesh->first[control] == LIMNI_NONE) {
        normals->records[control] = (limn_file_normal){.first_ring = (uint32_t)normals->ring_size};
        return LIMN_BAKE_OK;
    }
    if (limni_scheme_of(b->rules, b->mesh->domain)->reach == 2)
        return write_wide_normal(b, control);
    LIMNI_TRY(reserve_ring(b, 2 * (uint64_t)b->mesh->valences[control]));
    uint32_t *const ring = normals->ring + normals->ring_size;
    limni_star star = {.ring = ring,
                       .edges = b->edges,
                       .beyond = b->beyond,
                       .diagonals = ring + b->mesh->valences[control]};
    limni_mesh_star(b->mesh, b->sharpness, b->mesh->first[control], &star);
    LIMNI_TRY(write_sides(b, control, &star));
    normals->ring_size += ring_size(&star);
    return LIMN_BAKE_OK;
}

static limn_bake_status allocate_normals(builder *b) {
    const limni_mesh *const mesh = b->mesh;
    bool tagged = b->sharpness->edges;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        tagged |= b->sharpness->vertices[c] > 0;
    *b->normals = (limni_control_normals){
        .records = limni_allocate(b->context, mesh->control_count, sizeof *b->normals->records),
        .corners =
            tagged ? limni_allocate(b->context, mesh->half_edge_count, sizeof(uint32_t)) : NULL,
    };
    return b->normals->records && (b->normals->corners || !tagged) ? LIMN_BAKE_OK
                                                                   : LIMN_BAKE_MEMORY;
}

limn_bake_status limni_control_normals_build(limni_context *context, const limni_mesh *mesh,
                                             const limni_mesh_sharpness *sharpness,
                                             const limni_rules *rules,
                                             limni_control_normals *normals) {
    builder b = {.context = context,
                 .mesh = mesh,
                 .sharpness = sharpness,
                 .rules = rules,
                 .normals = normals};
    LIMNI_TRY(allocate_normals(&b));
    LIMNI_TRY(begin(&b));
    for (uint32_t c = 0; c < mesh->control_count; c++)
        LIMNI_TRY(write_normal(&b, c));
    end(&b);
    if (normals->side_count == 0) {
        limni_release(context, normals->corners);
        normals->corners = NULL;
    }
    return LIMN_BAKE_OK;
}
