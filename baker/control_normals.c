/* SPDX-License-Identifier: MIT */
#include "control_normals.h"

#include <string.h>

/// The masks that have been written: by rule and valence.
typedef struct mask_list {
    uint32_t *first_weights; ///< [3][valence_max + 1], LIMNI_NONE where there is none yet
    uint32_t valence_max;
    uint64_t capacity; ///< of the weights
    limni_fixed *along, *across;
} mask_list;

static limn_bake_status begin_masks(limni_context *context, const limni_mesh *mesh,
                                    mask_list *masks) {
    *masks = (mask_list){0};
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        if (mesh->valences[c] > masks->valence_max) masks->valence_max = mesh->valences[c];
    }
    const size_t count = (size_t)masks->valence_max + 1;
    masks->first_weights = limni_allocate(context, 3 * count, sizeof *masks->first_weights);
    masks->along = limni_allocate(context, count, sizeof *masks->along);
    masks->across = limni_allocate(context, count, sizeof *masks->across);
    if (!masks->first_weights || !masks->along || !masks->across) return LIMN_BAKE_MEMORY;
    memset(masks->first_weights, 0xff, 3 * count * sizeof *masks->first_weights);
    return LIMN_BAKE_OK;
}

/// Appends the two masks of a star to the weights: those of the ring. Masks sum to zero, so sums
/// relative to the centre need no weight for it.
static limn_bake_status write_mask(limni_context *context, const limni_star *star, mask_list *masks,
                                   limni_control_normals *normals) {
    const uint64_t size = 2 * (uint64_t)star->count;
    if (normals->weight_count + size > masks->capacity) {
        masks->capacity = 2 * (masks->capacity + size);
        float *const weights =
            limni_resize(context, normals->weights, masks->capacity, sizeof *weights);
        if (!weights) return LIMN_BAKE_MEMORY;
        normals->weights = weights;
    }
    limni_loop_tangent_masks(star, 0, masks->along, masks->across);
    float *weight = normals->weights + normals->weight_count;
    for (uint32_t w = 0; w < star->count; w++) {
        weight[w] = limni_fixed_to_float(masks->along[1 + w]);
        weight[star->count + w] = limni_fixed_to_float(masks->across[1 + w]);
    }
    normals->weight_count += size;
    return LIMN_BAKE_OK;
}

/// The ring of a control point, counter-clockwise. Returns its size.
static uint32_t write_ring(const limni_mesh *mesh, uint32_t control, uint32_t *ring) {
    const uint32_t start = mesh->first[control];
    uint32_t count = 0, turning = start, last;
    do {
        ring[count++] = limni_half_edge_end(mesh, turning);
        last = turning;
        turning = limni_half_edge_turn(mesh, turning);
    } while (turning != start && turning != LIMNI_NONE);
    if (turning == LIMNI_NONE)
        ring[count++] = limni_half_edge_start(mesh, limni_half_edge_previous(last));
    return count;
}

static limn_bake_status write_normal(limni_context *context, const limni_mesh *mesh,
                                     const limni_rules *rules, uint32_t control, mask_list *masks,
                                     limni_control_normals *normals) {
    limn_file_normal *const record = &normals->records[control];
    *record = (limn_file_normal){.first_ring = (uint32_t)normals->ring_size};
    if (mesh->first[control] == LIMNI_NONE) return LIMN_BAKE_OK;

    limni_star star = {.closed = !limni_is_boundary(mesh, control)};
    star.ring = normals->ring + normals->ring_size;
    star.count = write_ring(mesh, control, star.ring);
    star.rule = limni_loop_rule(rules, star.closed, star.count);
    uint32_t *const first =
        &masks->first_weights[star.rule * (masks->valence_max + 1) + star.count];
    if (*first == LIMNI_NONE) {
        *first = (uint32_t)normals->weight_count;
        LIMNI_TRY(write_mask(context, &star, masks, normals));
    }
    record->ring_count = star.count;
    record->first_weight = *first;
    normals->ring_size += star.count;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_control_normals_build(limni_context *context, const limni_mesh *mesh,
                                             const limni_rules *rules,
                                             limni_control_normals *normals) {
    mask_list masks;
    uint64_t ring_size = 0;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        ring_size += mesh->valences[c];
    *normals = (limni_control_normals){
        .records = limni_allocate(context, mesh->control_count, sizeof *normals->records),
        .ring = limni_allocate(context, (size_t)ring_size, sizeof *normals->ring),
    };
    if (!normals->records || !normals->ring) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(begin_masks(context, mesh, &masks));
    for (uint32_t c = 0; c < mesh->control_count; c++)
        LIMNI_TRY(write_normal(context, mesh, rules, c, &masks, normals));
    limni_release(context, masks.first_weights);
    limni_release(context, masks.along);
    limni_release(context, masks.across);
    return LIMN_BAKE_OK;
}
