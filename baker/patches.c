/* SPDX-License-Identifier: MIT */
#include "patches.h"

#include "edge_errors.h"
#include "hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// What is known of each face after the first pass.
typedef struct assignment {
    uint32_t *keys;      ///< [face_count] indices of class keys; holes have none
    uint32_t *rotations; ///< [face_count]
} assignment;

static uint32_t class_of(const limni_classes *classes, const assignment *assigned, uint32_t face) {
    return classes->keys[assigned->keys[face]].class_index;
}

static uint32_t slot_size_of(const limni_class *class) {
    return class->control_count <= LIMN_FORMAT_NARROW_SLOTS ? 1 : 2;
}

static limn_bake_status assign_classes(limni_context *context, const limni_mesh *mesh,
                                       const limni_rules *rules, limni_classes *classes,
                                       limni_classifier *classifier, const assignment *assigned) {
    const uint32_t step = mesh->face_count / 200 + 1;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (face % step == 0) limni_progress(context, "classify", face, mesh->face_count);
        if (mesh->holes[face]) continue;
        const limni_local_base *const base = limni_classify(context, classifier, face);
        if (!base) return LIMN_BAKE_BAD_INPUT;
        LIMNI_TRY(limni_classes_find(context, classes, rules, base, &assigned->keys[face]));
        assigned->rotations[face] = base->rotation;
    }
    limni_progress(context, "classify", mesh->face_count, mesh->face_count);
    return LIMN_BAKE_OK;
}

// ---- Runs

static void fill_runs(const limni_classes *classes, const uint32_t *counts,
                      limni_patches *patches) {
    uint64_t patch = 0, index = 0, slot = 0;
    limn_file_run *run = patches->runs;
    for (uint32_t c = 0; c < classes->count; c++) {
        if (counts[c] == 0) continue;
        const uint32_t slot_size = slot_size_of(&classes->items[c]);
        slot += slot % slot_size;
        *run++ = (limn_file_run){
            .class_index = c,
            .first_patch = (uint32_t)patch,
            .patch_count = counts[c],
            .first_index = index,
            .first_slot = slot,
        };
        const uint64_t count = (uint64_t)counts[c] * classes->items[c].control_count;
        patch += counts[c];
        index += count;
        slot += count * slot_size;
    }
    patches->record.index_count = index;
    patches->slots_size = slot;
}

static limn_bake_status make_runs(limni_context *context, const limni_mesh *mesh,
                                  const limni_classes *classes, const assignment *assigned,
                                  limni_patches *patches) {
    uint32_t *const counts = limni_allocate_zeroed(context, classes->count, sizeof *counts);
    if (!counts) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (!mesh->holes[face]) counts[class_of(classes, assigned, face)]++;
    }
    for (uint32_t c = 0; c < classes->count; c++)
        patches->record.run_count += counts[c] != 0;
    patches->runs =
        limni_allocate_zeroed(context, patches->record.run_count, sizeof *patches->runs);
    if (!patches->runs) return LIMN_BAKE_MEMORY;
    fill_runs(classes, counts, patches);
    limni_release(context, counts);
    return LIMN_BAKE_OK;
}

/// Orders the faces by class, and by number within a class.
static limn_bake_status order_faces(limni_context *context, const limni_mesh *mesh,
                                    const limni_classes *classes, const assignment *assigned,
                                    limni_patches *patches) {
    uint32_t *const next = limni_allocate(context, classes->count, sizeof *next);
    patches->faces = limni_allocate(context, patches->record.patch_count, sizeof *patches->faces);
    if (!next || !patches->faces) return LIMN_BAKE_MEMORY;
    for (uint32_t r = 0; r < patches->record.run_count; r++)
        next[patches->runs[r].class_index] = patches->runs[r].first_patch;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (mesh->holes[face]) continue;
        patches->faces[next[class_of(classes, assigned, face)]++] =
            face << 2 | assigned->rotations[face];
    }
    limni_release(context, next);
    return LIMN_BAKE_OK;
}

// ---- Control lists

static int compare_pairs(const void *a, const void *b) {
    const uint64_t left = *(const uint64_t *)a, right = *(const uint64_t *)b;
    return (left > right) - (left < right);
}

/// Few and nearly sorted, as a rule.
static void sort_pairs(uint64_t *pairs, uint32_t count) {
    if (count > 64) {
        qsort(pairs, count, sizeof *pairs, compare_pairs);
        return;
    }
    for (uint32_t k = 1; k < count; k++) {
        const uint64_t pair = pairs[k];
        uint32_t at = k;
        for (; at > 0 && pairs[at - 1] > pair; at--)
            pairs[at] = pairs[at - 1];
        pairs[at] = pair;
    }
}

/// Stores a patch's control points by slot, and the slots in ascending order of the control points:
/// what makes two patches add the terms of a shared vertex in the same order.
static void store_controls(const limni_local_base *base, const limni_class_key *key,
                           uint64_t *pairs, uint32_t slot_size, uint32_t *indices, uint8_t *slots) {
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < base->neighbourhood.control_count; slot++) {
        if (key->slots[slot] == LIMNI_SLOT_UNUSED) continue;
        pairs[count++] = (uint64_t)base->controls[slot] << 32 | key->slots[slot];
    }
    sort_pairs(pairs, count);
    for (uint32_t k = 0; k < count; k++) {
        indices[(uint32_t)pairs[k]] = (uint32_t)(pairs[k] >> 32);
        // Little-endian, whatever the host.
        slots[k * slot_size] = (uint8_t)(pairs[k] & 0xff);
        if (slot_size == 2) slots[2 * k + 1] = (uint8_t)(pairs[k] >> 8 & 0xff);
    }
}

static limn_bake_status list_controls(limni_context *context, const limni_classes *classes,
                                      const assignment *assigned, limni_classifier *classifier,
                                      limni_patches *patches) {
    patches->indices = limni_allocate(context, patches->record.index_count, sizeof(uint32_t));
    patches->slots = limni_allocate_zeroed(context, patches->slots_size, 1);
    uint64_t *const pairs = limni_allocate(context, LIMNI_LOCAL_BASE_MAX, sizeof *pairs);
    if (!patches->indices || !patches->slots || !pairs) return LIMN_BAKE_MEMORY;
    for (uint32_t r = 0; r < patches->record.run_count; r++) {
        const limn_file_run *const run = &patches->runs[r];
        const limni_class *const class = &classes->items[run->class_index];
        const uint32_t count = class->control_count, slot_size = slot_size_of(class);
        for (uint32_t p = 0; p < run->patch_count; p++) {
            const uint32_t packed = patches->faces[run->first_patch + p];
            const limni_local_base *const base =
                limni_local_base_at(classifier, packed >> 2, packed & 3);
            const uint64_t skipped = (uint64_t)p * count;
            const limni_class_key *const key = &classes->keys[assigned->keys[packed >> 2]];
            store_controls(base, key, pairs, slot_size,
                           patches->indices + run->first_index + skipped,
                           patches->slots + run->first_slot + skipped * slot_size);
        }
    }
    limni_release(context, pairs);
    return LIMN_BAKE_OK;
}

// ---- Agreement

/// Adds up what one side says about an edge: which control points move its rows, and how. The sum
/// does not depend on the order of the slots. On a crease both sides have tangents of their own.
static uint64_t sum_edge(const limni_classes *classes, const limni_class_key *key,
                         const limni_local_base *base, uint32_t edge, bool along, bool crease) {
    const limni_class *const class = &classes->items[key->class_index];
    uint64_t sum = 0;
    for (uint32_t slot = 0; slot < base->neighbourhood.control_count; slot++) {
        if (key->slots[slot] == LIMNI_SLOT_UNUSED) continue;
        const limni_edge_prints *const prints = &class->prints[key->slots[slot]];
        const limni_edge_print print = along ? prints->along[edge] : prints->against[edge];
        if (print.positions) sum += limni_hash_mix(print.positions, base->controls[slot]);
        if (print.tangents && !crease) sum -= limni_hash_mix(print.tangents, base->controls[slot]);
    }
    return sum;
}

/// Whether there is no patch on one side of a half-edge.
static bool is_open(const limni_mesh *mesh, uint32_t h) {
    return mesh->pairs[h] == LIMNI_NONE || mesh->holes[h / 3] || mesh->holes[mesh->pairs[h] / 3];
}

static void sum_edges(const limni_mesh *mesh, const limni_classes *classes,
                      const assignment *assigned, limni_classifier *classifier, uint64_t *sums) {
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (mesh->holes[face]) continue;
        const uint32_t rotation = assigned->rotations[face];
        const limni_local_base *const base = limni_local_base_at(classifier, face, rotation);
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            const uint32_t edge = (h % 3 + 3 - rotation) % 3;
            const bool along = mesh->pairs[h] == LIMNI_NONE || h < mesh->pairs[h];
            const bool crease = limni_is_crease(&classifier->sharpness, mesh, h);
            sums[h] =
                sum_edge(classes, &classes->keys[assigned->keys[face]], base, edge, along, crease);
        }
    }
}

/// Every pair of patches must give the rows of the edge they share the same coefficients of the
/// same control points; otherwise the surface would crack.
static limn_bake_status check_agreement(limni_context *context, const limni_mesh *mesh,
                                        const limni_classes *classes, const assignment *assigned,
                                        limni_classifier *classifier) {
    uint64_t *const sums = limni_allocate(context, 3 * (size_t)mesh->face_count, sizeof *sums);
    if (!sums) return LIMN_BAKE_MEMORY;
    sum_edges(mesh, classes, assigned, classifier, sums);
    limn_bake_status status = LIMN_BAKE_OK;
    for (uint32_t h = 0; h < 3 * mesh->face_count && status == LIMN_BAKE_OK; h++) {
        const uint32_t pair = mesh->pairs[h];
        if (is_open(mesh, h) || pair < h || sums[h] == sums[pair]) continue;
        limni_place a, b;
        status = limni_fail(context, LIMN_BAKE_INTERNAL,
                            "%s: defect in the baker: %s and %s disagree on their common edge",
                            mesh->path ? mesh->path : mesh->name, limni_face_place(mesh, h / 3, a),
                            limni_face_place(mesh, pair / 3, b));
    }
    limni_release(context, sums);
    return status;
}

// ---- Creases

/// Which edges stay sharp, so that the surface has a normal on each side.
static limn_bake_status list_creases(limni_context *context, const limni_mesh *mesh,
                                     const limni_mesh_sharpness *sharpness,
                                     limni_patches *patches) {
    const uint32_t patch_count = patches->record.patch_count;
    uint8_t *const creases = limni_allocate_zeroed(context, patch_count, 1);
    bool any = false;
    if (!creases) return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < 3 * patch_count; h++) {
        const uint32_t face = patches->faces[h / 3] >> 2, rotation = patches->faces[h / 3] & 3;
        const bool crease = limni_is_crease(sharpness, mesh, 3 * face + (h + rotation) % 3);
        creases[h / 3] |= (uint8_t)(crease << h % 3);
        any |= crease;
    }
    if (any) patches->creases = creases;
    return LIMN_BAKE_OK;
}

static limn_bake_status list_corner_normals(limni_context *context, limni_patches *patches) {
    const uint32_t corner_count = 3 * patches->record.patch_count;
    if (!patches->normals.corners) return LIMN_BAKE_OK;
    patches->corner_normals = limni_allocate(context, corner_count, sizeof(uint32_t));
    if (!patches->corner_normals) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < corner_count; c++) {
        const uint32_t face = patches->faces[c / 3] >> 2, rotation = patches->faces[c / 3] & 3;
        patches->corner_normals[c] = patches->normals.corners[3 * face + (c + rotation) % 3];
    }
    limni_release(context, patches->normals.corners);
    return LIMN_BAKE_OK;
}

static limn_bake_status make_normals(limni_context *context, const limni_mesh *mesh,
                                     const limni_mesh_sharpness *sharpness,
                                     const limni_rules *rules, limni_patches *patches) {
    if (rules->normals != LIMN_NORMALS_EXACT) return LIMN_BAKE_OK;
    LIMNI_TRY(limni_control_normals_build(context, mesh, sharpness, rules, &patches->normals));
    return list_corner_normals(context, patches);
}

// ---- All steps

/// Bounds of the control points that faces use. The origin is 0 where that is as good as any, so
/// that most meshes do not depend on their bounds.
static void find_bounds(const limni_mesh *mesh, limn_file_mesh *record) {
    for (int axis = 0; axis < 3; axis++) {
        float low = INFINITY, high = -INFINITY;
        for (uint32_t c = 0; c < mesh->control_count; c++) {
            if (mesh->first[c] == LIMNI_NONE) continue;
            const float value = mesh->controls[c][axis];
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
        record->bounds_min[axis] = low;
        record->bounds_max[axis] = high;
        record->origin[axis] = low <= 0 && high >= 0 ? 0 : low + (high - low) / 2;
    }
}

limn_bake_status limni_patches_build(limni_context *context, const limni_mesh *mesh,
                                     const limni_rules *rules, limni_classes *classes,
                                     limni_patches *patches) {
    const assignment assigned = {
        .keys = limni_allocate(context, mesh->face_count, sizeof(uint32_t)),
        .rotations = limni_allocate(context, mesh->face_count, sizeof(uint32_t)),
    };
    if (!assigned.keys || !assigned.rotations) return LIMN_BAKE_MEMORY;
    *patches = (limni_patches){
        .name = mesh->name,
        .controls = mesh->controls,
        .rules = *rules,
        .sharp = limni_has_sharpness(mesh),
        .record = {.control_count = mesh->control_count,
                   .patch_count = mesh->face_count - mesh->hole_count,
                   .hole_count = mesh->hole_count},
    };
    find_bounds(mesh, &patches->record);

    limni_classifier classifier;
    LIMNI_TRY(limni_classifier_begin(context, &classifier, mesh, rules));
    LIMNI_TRY(assign_classes(context, mesh, rules, classes, &classifier, &assigned));
    LIMNI_TRY(check_agreement(context, mesh, classes, &assigned, &classifier));
    LIMNI_TRY(make_runs(context, mesh, classes, &assigned, patches));
    LIMNI_TRY(order_faces(context, mesh, classes, &assigned, patches));
    LIMNI_TRY(list_controls(context, classes, &assigned, &classifier, patches));
    LIMNI_TRY(list_creases(context, mesh, &classifier.sharpness, patches));
    LIMNI_TRY(make_normals(context, mesh, &classifier.sharpness, rules, patches));
    limni_classifier_end(context, &classifier);
    LIMNI_TRY(limni_edge_errors_build(context, mesh, classes, patches));
    limni_release(context, assigned.keys);
    limni_release(context, assigned.rotations);
    return LIMN_BAKE_OK;
}
