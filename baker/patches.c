/* SPDX-License-Identifier: MIT */
#include "patches.h"

#include "limn/limn.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// How the faces of a mesh become patches.
typedef struct arrangement {
    const limni_mesh *mesh;
    const limni_rules *rules;
    limni_classes *classes, *pieces;
    limni_mesh_sharpness sharpness;
    limni_classifier classifier;
    limni_assignment assigned; ///< its keys: without isolation
    uint32_t *class_indices;   ///< [face_count]; holes have none
    limni_isolation isolation; ///< empty without it
} arrangement;

static bool is_isolated(const arrangement *a) {
    return a->rules->isolate == LIMN_ISOLATE_ALWAYS;
}

static uint32_t slot_size_of(const limni_class *class) {
    return class->control_count <= LIMN_FORMAT_NARROW_SLOTS ? 1 : 2;
}

static limn_bake_status begin_arrangement(limni_context *context, arrangement *a) {
    const limni_mesh *const mesh = a->mesh;
    LIMNI_TRY(limni_check_valences(context, mesh));
    LIMNI_TRY(limni_mesh_sharpness_begin(context, mesh, a->rules, &a->sharpness));
    LIMNI_TRY(limni_classifier_begin(context, &a->classifier, mesh, &a->sharpness, a->rules));
    LIMNI_TRY(limni_assignment_begin(context, mesh->face_count, &a->assigned));
    a->class_indices = limni_allocate(context, mesh->face_count, sizeof *a->class_indices);
    if (!a->class_indices) return LIMN_BAKE_MEMORY;
    return is_isolated(a)
               ? limni_isolation_begin(context, mesh, &a->sharpness, a->rules, &a->isolation)
               : LIMN_BAKE_OK;
}

static void end_arrangement(limni_context *context, arrangement *a) {
    if (is_isolated(a)) limni_isolation_end(context, &a->isolation);
    limni_release(context, a->class_indices);
    limni_assignment_end(context, &a->assigned);
    limni_classifier_end(context, &a->classifier);
    limni_mesh_sharpness_end(context, &a->sharpness);
}

static limn_bake_status assign_class(limni_context *context, arrangement *a, uint32_t face) {
    const limni_local_base *const base = limni_classify(&a->classifier, face);
    uint32_t *const key = &a->assigned.keys[face];
    a->assigned.rotations[face] = base->rotation;
    if (is_isolated(a))
        return limni_isolation_classify(context, &a->isolation, a->rules, face, base->rotation,
                                        a->pieces, a->classes, &a->class_indices[face]);
    LIMNI_TRY(limni_classes_find(context, a->classes, a->rules, base, LIMNI_TABLE_PATCH, key));
    a->class_indices[face] = a->classes->keys[*key].class_index;
    return LIMN_BAKE_OK;
}

static limn_bake_status assign_classes(limni_context *context, arrangement *a) {
    const uint32_t face_count = a->mesh->face_count, step = face_count / 200 + 1;
    for (uint32_t face = 0; face < face_count; face++) {
        if (face % step == 0) limni_progress(context, "classify", face, face_count);
        if (!a->mesh->holes[face]) LIMNI_TRY(assign_class(context, a, face));
    }
    limni_progress(context, "classify", face_count, face_count);
    return is_isolated(a)
               ? limni_check_agreement(context, &a->isolation.classifier, a->pieces,
                                       &a->isolation.assigned)
               : limni_check_agreement(context, &a->classifier, a->classes, &a->assigned);
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

static limn_bake_status make_runs(limni_context *context, const arrangement *a,
                                  limni_patches *patches) {
    const limni_mesh *const mesh = a->mesh;
    const limni_classes *const classes = a->classes;
    uint32_t *const counts = limni_allocate_zeroed(context, classes->count, sizeof *counts);
    if (!counts) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (!mesh->holes[face]) counts[a->class_indices[face]]++;
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
static limn_bake_status order_faces(limni_context *context, const arrangement *a,
                                    limni_patches *patches) {
    const limni_mesh *const mesh = a->mesh;
    uint32_t *const next = limni_allocate(context, a->classes->count, sizeof *next);
    patches->faces = limni_allocate(context, patches->record.patch_count, sizeof *patches->faces);
    if (!next || !patches->faces) return LIMN_BAKE_MEMORY;
    for (uint32_t r = 0; r < patches->record.run_count; r++)
        next[patches->runs[r].class_index] = patches->runs[r].first_patch;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (mesh->holes[face]) continue;
        patches->faces[next[a->class_indices[face]]++] = face << 2 | a->assigned.rotations[face];
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

/// Stores a patch's points by slot, and the slots in ascending order of the points: what makes two
/// patches add the terms of a shared vertex in the same order.
///
/// pairs  [count] point << 32 | slot
static void store_points(uint64_t *pairs, uint32_t count, uint32_t slot_size, uint32_t *indices,
                         uint8_t *slots) {
    sort_pairs(pairs, count);
    for (uint32_t k = 0; k < count; k++) {
        indices[(uint32_t)pairs[k]] = (uint32_t)(pairs[k] >> 32);
        // Little-endian, whatever the host.
        slots[k * slot_size] = (uint8_t)(pairs[k] & 0xff);
        if (slot_size == 2) slots[2 * k + 1] = (uint8_t)(pairs[k] >> 8 & 0xff);
    }
}

/// The points of a patch, which are control points, or of level 1 and then follow those. Returns
/// how many.
static uint32_t list_points(arrangement *a, uint32_t face, uint32_t rotation, uint64_t *pairs) {
    if (is_isolated(a)) {
        const uint32_t count = limni_isolation_list(&a->isolation, a->pieces, face, rotation);
        for (uint32_t slot = 0; slot < count; slot++)
            pairs[slot] =
                (uint64_t)(a->mesh->control_count + a->isolation.points[slot]) << 32 | slot;
        return count;
    }
    const limni_local_base *const base = limni_local_base_at(&a->classifier, face, rotation);
    const limni_class_key *const key = &a->classes->keys[a->assigned.keys[face]];
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < base->neighbourhood.control_count; slot++) {
        if (key->slots[slot] == LIMNI_SLOT_UNUSED) continue;
        pairs[count++] = (uint64_t)base->controls[slot] << 32 | key->slots[slot];
    }
    return count;
}

static limn_bake_status list_controls(limni_context *context, arrangement *a,
                                      limni_patches *patches) {
    patches->indices = limni_allocate(context, patches->record.index_count, sizeof(uint32_t));
    patches->slots = limni_allocate_zeroed(context, patches->slots_size, 1);
    uint64_t *const pairs = limni_allocate(context, LIMNI_LOCAL_BASE_MAX, sizeof *pairs);
    if (!patches->indices || !patches->slots || !pairs) return LIMN_BAKE_MEMORY;
    for (uint32_t r = 0; r < patches->record.run_count; r++) {
        const limn_file_run *const run = &patches->runs[r];
        const limni_class *const class = &a->classes->items[run->class_index];
        const uint32_t slot_size = slot_size_of(class);
        for (uint32_t p = 0; p < run->patch_count; p++) {
            const uint32_t packed = patches->faces[run->first_patch + p];
            const uint32_t count = list_points(a, packed >> 2, packed & 3, pairs);
            const uint64_t skipped = (uint64_t)p * count;
            store_points(pairs, count, slot_size, patches->indices + run->first_index + skipped,
                         patches->slots + run->first_slot + skipped * slot_size);
        }
    }
    limni_release(context, pairs);
    return LIMN_BAKE_OK;
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

/// The control points, and behind them in the bind pose those of level 1.
static limn_bake_status place_points(limni_context *context, const limni_mesh *mesh,
                                     const limni_refined *refined, limni_patches *patches) {
    const uint32_t count = mesh->control_count + refined->mesh.control_count;
    float(*const points)[3] = limni_allocate(context, count, sizeof *points);
    if (!points) return LIMN_BAKE_MEMORY;
    memcpy(points, mesh->controls, mesh->control_count * sizeof *points);
    limn_mesh view = {.control_count = mesh->control_count,
                      .point_count = count,
                      .stencils = refined->stencils,
                      .terms = refined->terms,
                      .kernels = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_REPRODUCIBLE)};
    memcpy(view.origin, patches->record.origin, sizeof view.origin);
    limn_mesh_refine(&view, points[0]);
    patches->controls = points;
    patches->record.point_count = count;
    patches->stencils = refined->stencils;
    patches->terms = refined->terms;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_patches_build(limni_context *context, const limni_mesh *mesh,
                                     const limni_rules *rules, limni_classes *classes,
                                     limni_classes *pieces, limni_patches *patches) {
    *patches = (limni_patches){
        .name = mesh->name,
        .controls = mesh->controls,
        .rules = *rules,
        .sharp = limni_has_sharpness(mesh),
        .record = {.control_count = mesh->control_count,
                   .point_count = mesh->control_count,
                   .patch_count = mesh->face_count - mesh->hole_count,
                   .hole_count = mesh->hole_count},
    };
    find_bounds(mesh, &patches->record);
    arrangement a = {.mesh = mesh, .rules = rules, .classes = classes, .pieces = pieces};
    LIMNI_TRY(begin_arrangement(context, &a));
    LIMNI_TRY(assign_classes(context, &a));
    LIMNI_TRY(make_runs(context, &a, patches));
    LIMNI_TRY(order_faces(context, &a, patches));
    LIMNI_TRY(list_controls(context, &a, patches));
    LIMNI_TRY(list_creases(context, mesh, &a.sharpness, patches));
    LIMNI_TRY(make_normals(context, mesh, &a.sharpness, rules, patches));
    if (is_isolated(&a)) LIMNI_TRY(place_points(context, mesh, &a.isolation.refined, patches));
    end_arrangement(context, &a);
    return LIMN_BAKE_OK;
}
