/* SPDX-License-Identifier: MIT */
#include "patches.h"

#include "limn/limn.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// How the faces of a mesh become patches.
typedef struct arrangement {
    const limni_base *base;
    const limni_mesh *mesh; ///< of the base
    const limni_rules *rules;
    limni_classes *classes, *pieces;
    limni_classifier classifier;
    limni_assignment assigned; ///< its keys: without isolation
    uint32_t *class_indices;   ///< [face_count]; holes have none
    limni_isolation isolation; ///< empty without it
} arrangement;

static bool is_isolated(const arrangement *a) {
    return a->rules->isolate == LIMN_ISOLATE_ALWAYS;
}

static limn_bake_status begin_arrangement(limni_context *context, arrangement *a) {
    const limni_mesh *const mesh = a->mesh;
    LIMNI_TRY(limni_classifier_begin(context, &a->classifier, mesh, a->base->sharpness, a->rules));
    LIMNI_TRY(limni_check_valences(context, &a->classifier));
    LIMNI_TRY(limni_assignment_begin(context, mesh->face_count, &a->assigned));
    a->class_indices = limni_allocate(context, mesh->face_count, sizeof *a->class_indices);
    if (!a->class_indices) return LIMN_BAKE_MEMORY;
    return is_isolated(a)
               ? limni_isolation_begin(context, mesh, a->base->sharpness, a->rules, &a->isolation)
               : LIMN_BAKE_OK;
}

static void end_arrangement(limni_context *context, arrangement *a) {
    if (is_isolated(a)) limni_isolation_end(context, &a->isolation);
    limni_release(context, a->class_indices);
    limni_assignment_end(context, &a->assigned);
    limni_classifier_end(context, &a->classifier);
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

/// The material of a face, and 1; 0 where nothing is said.
static uint32_t material_key(const arrangement *a, uint32_t face) {
    const uint32_t *const materials = a->base->source->face_materials;
    return materials ? materials[a->mesh->polygons[face]] + 1 : 0; // LIMN_FORMAT_NONE + 1 is 0
}

/// Orders faces by their keys, those with the same key as they are.
///
/// keys  by face, below key_count
static limn_bake_status sort_faces(limni_context *context, const uint32_t *keys, uint32_t key_count,
                                   uint32_t *faces, uint32_t count) {
    uint32_t *const next = limni_allocate_zeroed(context, (size_t)key_count + 1, sizeof *next);
    uint32_t *const sorted = limni_allocate(context, count, sizeof *sorted);
    if (!next || !sorted) return LIMN_BAKE_MEMORY;
    for (uint32_t f = 0; f < count; f++)
        next[keys[faces[f]] + 1]++;
    for (uint32_t key = 0; key < key_count; key++)
        next[key + 1] += next[key];
    for (uint32_t f = 0; f < count; f++)
        sorted[next[keys[faces[f]]]++] = faces[f];
    memcpy(faces, sorted, count * sizeof *faces);
    limni_release(context, next);
    limni_release(context, sorted);
    return LIMN_BAKE_OK;
}

/// Orders the faces by material, class, and number. Their rotations are added later.
static limn_bake_status order_faces(limni_context *context, const arrangement *a,
                                    limni_patches *patches) {
    const limni_mesh *const mesh = a->mesh;
    uint32_t count = 0, material_count = 0;
    uint32_t *const materials = limni_allocate(context, mesh->face_count, sizeof *materials);
    patches->faces = limni_allocate(context, patches->record.patch_count, sizeof *patches->faces);
    if (!materials || !patches->faces) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        materials[face] = material_key(a, face);
        if (materials[face] >= material_count) material_count = materials[face] + 1;
        if (!mesh->holes[face]) patches->faces[count++] = face;
    }
    LIMNI_TRY(sort_faces(context, a->class_indices, a->classes->count, patches->faces, count));
    if (material_count > 1)
        LIMNI_TRY(sort_faces(context, materials, material_count, patches->faces, count));
    limni_release(context, materials);
    return LIMN_BAKE_OK;
}

/// Whether a run begins with the p-th of the ordered faces.
static bool begins_run(const arrangement *a, const uint32_t *faces, uint32_t p) {
    return p == 0 || a->class_indices[faces[p]] != a->class_indices[faces[p - 1]] ||
           material_key(a, faces[p]) != material_key(a, faces[p - 1]);
}

static limn_bake_status make_runs(limni_context *context, const arrangement *a,
                                  limni_patches *patches) {
    const uint32_t patch_count = patches->record.patch_count;
    for (uint32_t p = 0; p < patch_count; p++)
        patches->record.run_count += begins_run(a, patches->faces, p);
    patches->runs =
        limni_allocate_zeroed(context, patches->record.run_count, sizeof *patches->runs);
    if (!patches->runs) return LIMN_BAKE_MEMORY;
    limn_file_run *run = patches->runs;
    for (uint32_t p = 0; p < patch_count; p++) {
        const uint32_t class_index = a->class_indices[patches->faces[p]];
        const limni_class *const class = &a->classes->items[class_index];
        const limn_file_class record = limni_class_record(class);
        const uint32_t slot_size = limn_file_slot_size(&record);
        if (begins_run(a, patches->faces, p)) {
            patches->slots_size += patches->slots_size % slot_size;
            *run++ = (limn_file_run){.class_index = class_index,
                                     .first_patch = p,
                                     .first_index = patches->record.index_count,
                                     .first_slot = patches->slots_size};
        }
        run[-1].patch_count++;
        patches->record.index_count += class->control_count;
        patches->slots_size += class->control_count * slot_size;
    }
    return LIMN_BAKE_OK;
}

/// Where each material begins and ends, if there is one.
static limn_bake_status list_ranges(limni_context *context, const arrangement *a,
                                    limni_patches *patches) {
    const uint32_t patch_count = patches->record.patch_count;
    const uint32_t *const faces = patches->faces;
    if (patch_count == 0 || material_key(a, faces[patch_count - 1]) == 0) return LIMN_BAKE_OK;
    patches->ranges = limni_allocate(context, patch_count, sizeof *patches->ranges);
    if (!patches->ranges) return LIMN_BAKE_MEMORY;
    for (uint32_t p = 0; p < patch_count; p++) {
        const uint32_t key = material_key(a, faces[p]);
        if (p == 0 || key != material_key(a, faces[p - 1]))
            patches->ranges[patches->range_count++] = (limn_file_range){key - 1, p, 0};
        patches->ranges[patches->range_count - 1].patch_count++;
    }
    return LIMN_BAKE_OK;
}

/// What the file says of the ordered faces.
static void add_rotations(const arrangement *a, limni_patches *patches) {
    for (uint32_t p = 0; p < patches->record.patch_count; p++) {
        const uint32_t face = patches->faces[p];
        patches->faces[p] = face << 2 | a->assigned.rotations[face];
    }
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

/// The points of a patch: vertices of the base mesh, or of the level that isolates it, which follow
/// those. Returns how many.
static uint32_t list_points(arrangement *a, uint32_t face, uint32_t rotation, uint64_t *pairs) {
    if (is_isolated(a)) {
        const uint32_t count = limni_isolation_list(&a->isolation, a->pieces, face, rotation);
        const uint32_t first = a->base->first + a->mesh->control_count;
        for (uint32_t slot = 0; slot < count; slot++)
            pairs[slot] = (uint64_t)(first + a->isolation.points[slot]) << 32 | slot;
        return count;
    }
    const limni_local_base *const base = limni_local_base_at(&a->classifier, face, rotation);
    const limni_class_key *const key = &a->classes->keys[a->assigned.keys[face]];
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < base->control_count; slot++) {
        if (key->slots[slot] == LIMNI_SLOT_UNUSED) continue;
        pairs[count++] = (uint64_t)(a->base->first + base->controls[slot]) << 32 | key->slots[slot];
    }
    return count;
}

static limn_bake_status list_controls(limni_context *context, arrangement *a,
                                      limni_patches *patches) {
    patches->indices = limni_allocate(context, patches->record.index_count, sizeof(uint32_t));
    patches->slots = limni_allocate_zeroed(context, patches->slots_size, 1);
    uint64_t *const pairs = limni_allocate(context, LIMN_FORMAT_CONTROLS_MAX, sizeof *pairs);
    if (!patches->indices || !patches->slots || !pairs) return LIMN_BAKE_MEMORY;
    for (uint32_t r = 0; r < patches->record.run_count; r++) {
        const limn_file_run *const run = &patches->runs[r];
        const limn_file_class record = limni_class_record(&a->classes->items[run->class_index]);
        const uint32_t slot_size = limn_file_slot_size(&record);
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
    const uint32_t corner_count = limni_corner_count(patches);
    uint8_t *const creases = limni_allocate_zeroed(context, patch_count, 1);
    bool any = false;
    if (!creases) return LIMN_BAKE_MEMORY;
    for (uint32_t e = 0; e < corner_count * patch_count; e++) {
        const uint32_t patch = e / corner_count, edge = e % corner_count;
        const bool crease =
            limni_is_crease(sharpness, mesh, limni_patch_half_edge(patches, mesh, patch, edge));
        creases[patch] |= (uint8_t)(crease << edge);
        any |= crease;
    }
    if (any) patches->creases = creases;
    return LIMN_BAKE_OK;
}

static limn_bake_status list_corner_normals(limni_context *context, const limni_mesh *mesh,
                                            limni_patches *patches) {
    const uint32_t corner_count = limni_corner_count(patches);
    const size_t count = corner_count * (size_t)patches->record.patch_count;
    if (!patches->normals.corners) return LIMN_BAKE_OK;
    patches->corner_normals = limni_allocate(context, count, sizeof(uint32_t));
    if (!patches->corner_normals) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < count; c++)
        patches->corner_normals[c] =
            patches->normals
                .corners[limni_patch_half_edge(patches, mesh, c / corner_count, c % corner_count)];
    limni_release(context, patches->normals.corners);
    return LIMN_BAKE_OK;
}

static limn_bake_status make_normals(limni_context *context, const limni_base *base,
                                     const limni_rules *rules, limni_patches *patches) {
    if (rules->normals != LIMN_NORMALS_EXACT) return LIMN_BAKE_OK;
    LIMNI_TRY(limni_control_normals_build(context, base->mesh, base->sharpness, rules,
                                          &patches->normals));
    for (uint64_t r = 0; r < patches->normals.ring_size; r++)
        patches->normals.ring[r] += base->first;
    for (uint32_t side = 0; side < patches->normals.side_count; side++)
        patches->normals.sides[side].point += base->first;
    return list_corner_normals(context, base->mesh, patches);
}

// ---- Points

/// Appends points that follow from those from `first` on.
static limn_bake_status append_points(limni_context *context, const limni_stencils *added,
                                      uint32_t count, uint32_t first, limni_patches *patches) {
    limni_stencils *const all = &patches->stencils;
    const uint32_t before = patches->record.point_count;
    const uint32_t point = before - patches->record.control_count;
    const uint32_t term = all->offsets ? all->offsets[point] : 0, terms = added->offsets[count];
    if (terms > UINT32_MAX - term || count > UINT32_MAX - before)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: too many points", patches->name);
    float(*const controls)[3] =
        limni_resize(context, patches->controls, (size_t)before + count, sizeof *controls);
    if (!controls) return LIMN_BAKE_MEMORY;
    patches->controls = controls;
    all->offsets =
        limni_resize(context, all->offsets, (size_t)point + count + 1, sizeof *all->offsets);
    all->terms = limni_resize(context, all->terms, (size_t)term + terms, sizeof *all->terms);
    if (!all->offsets || !all->terms) return LIMN_BAKE_MEMORY;
    for (uint32_t p = 0; p <= count; p++)
        all->offsets[point + p] = term + added->offsets[p];
    for (uint32_t t = 0; t < terms; t++)
        all->terms[term + t] =
            (limn_file_term){first + added->terms[t].point, added->terms[t].weight};
    patches->record.point_count = before + count;
    limni_place_points(all, controls, patches->record.control_count, point + count);
    return LIMN_BAKE_OK;
}

/// Behind the control points, the vertices of a mesh that was divided, and those of the level that
/// isolates it.
static limn_bake_status place_points(limni_context *context, const arrangement *a,
                                     limni_patches *patches) {
    const limni_base *const base = a->base;
    const uint32_t count = base->source->control_count;
    if (!base->divided && !is_isolated(a)) return LIMN_BAKE_OK;
    patches->controls = limni_allocate(context, count, sizeof *patches->controls);
    if (!patches->controls) return LIMN_BAKE_MEMORY;
    memcpy(patches->controls, base->source->controls, count * sizeof *patches->controls);
    if (base->divided) {
        LIMNI_TRY(append_points(context, &base->stencils, base->mesh->control_count, 0, patches));
        patches->record.divided_count = base->mesh->control_count;
    }
    if (!is_isolated(a)) return LIMN_BAKE_OK;
    return append_points(context, &a->isolation.stencils, a->isolation.refined.mesh.control_count,
                         base->first, patches);
}

// ---- All steps

/// What sums are relative to: 0 where that is as good as any, so that most meshes do not depend on
/// their bounds. Where the surface goes through the control points it is the middle only if all are
/// within half and twice of it: their differences from it are exact then.
static float find_origin(const limni_rules *rules, float low, float high) {
    const float middle = low + (high - low) / 2;
    const float nearest = fminf(fabsf(low), fabsf(high));
    if (low <= 0 && high >= 0) return 0;
    if (rules->scheme == LIMN_SCHEME_BUTTERFLY && nearest < fabsf(middle) / 2) return 0;
    return middle;
}

/// Bounds of the control points that faces use.
static void find_bounds(const limni_mesh *mesh, const limni_rules *rules, limn_file_mesh *record) {
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
        record->origin[axis] = find_origin(rules, low, high);
    }
}

limn_bake_status limni_patches_build(limni_context *context, const limni_base *base,
                                     const limni_rules *rules, limni_classes *classes,
                                     limni_classes *pieces, limni_patches *patches) {
    const limni_mesh *const mesh = base->mesh;
    *patches = (limni_patches){
        .name = mesh->name,
        .controls = base->source->controls,
        .rules = *rules,
        .sharp = limni_has_sharpness(base->source),
        .record = {.control_count = base->source->control_count,
                   .point_count = base->source->control_count,
                   .domain = mesh->domain,
                   .patch_count = mesh->face_count - mesh->hole_count,
                   .hole_count = mesh->hole_count},
    };
    find_bounds(base->source, rules, &patches->record);
    arrangement a = {
        .base = base, .mesh = mesh, .rules = rules, .classes = classes, .pieces = pieces};
    LIMNI_TRY(begin_arrangement(context, &a));
    LIMNI_TRY(assign_classes(context, &a));
    LIMNI_TRY(order_faces(context, &a, patches));
    LIMNI_TRY(make_runs(context, &a, patches));
    LIMNI_TRY(list_ranges(context, &a, patches));
    add_rotations(&a, patches);
    LIMNI_TRY(list_controls(context, &a, patches));
    LIMNI_TRY(list_creases(context, mesh, base->sharpness, patches));
    LIMNI_TRY(make_normals(context, base, rules, patches));
    LIMNI_TRY(place_points(context, &a, patches));
    end_arrangement(context, &a);
    return LIMN_BAKE_OK;
}
