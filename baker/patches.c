/* SPDX-License-Identifier: MIT */
#include "patches.h"

#include "arrangement.h"
#include "limn/limn.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- Order

/// The material of a face, and 1; 0 where nothing is said.
static uint32_t material_key(const limni_base *base, uint32_t face) {
    const uint32_t *const materials = base->source->face_materials;
    return materials ? materials[base->mesh->polygons[face]] + 1 : 0; // LIMN_FORMAT_NONE + 1 is 0
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

static limn_bake_status sort_by_material(limni_context *context, const limni_base *base,
                                         uint32_t *faces, uint32_t count) {
    const uint32_t face_count = base->mesh->face_count;
    uint32_t *const keys = limni_allocate(context, face_count, sizeof *keys);
    uint32_t key_count = 0;
    if (!keys) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face < face_count; face++) {
        keys[face] = material_key(base, face);
        if (keys[face] >= key_count) key_count = keys[face] + 1;
    }
    if (key_count > 1) LIMNI_TRY(sort_faces(context, keys, key_count, faces, count));
    limni_release(context, keys);
    return LIMN_BAKE_OK;
}

/// Orders the faces that are drawn by material, within one by class, then by the classes that they
/// have in the channels, and last by number.
///
/// all  [1 + channel_count] the mesh and its channels
static limn_bake_status order_faces(limni_context *context, const limni_arrangement *all,
                                    uint32_t channel_count, limni_patches *patches) {
    const limni_mesh *const mesh = all[0].mesh;
    const uint32_t count = patches->record.patch_count;
    uint32_t *const faces = limni_allocate(context, count, sizeof *faces);
    if (!faces) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0, f = 0; face < mesh->face_count; face++) {
        if (!mesh->holes[face]) faces[f++] = face;
    }
    for (uint32_t a = channel_count + 1; a-- > 0;)
        LIMNI_TRY(sort_faces(context, all[a].class_indices, all[a].classes->count, faces, count));
    LIMNI_TRY(sort_by_material(context, all[0].base, faces, count));
    for (uint32_t f = 0; f < count; f++)
        faces[f] = faces[f] << 2 | all[0].assigned.rotations[faces[f]];
    patches->faces = faces;
    return LIMN_BAKE_OK;
}

/// Where each material begins and ends, if there is one.
static limn_bake_status list_ranges(limni_context *context, const limni_base *base,
                                    limni_patches *patches) {
    const uint32_t patch_count = patches->record.patch_count;
    const uint32_t *const faces = patches->faces;
    if (patch_count == 0 || material_key(base, faces[patch_count - 1] >> 2) == 0)
        return LIMN_BAKE_OK;
    patches->ranges = limni_allocate(context, patch_count, sizeof *patches->ranges);
    if (!patches->ranges) return LIMN_BAKE_MEMORY;
    for (uint32_t p = 0; p < patch_count; p++) {
        const uint32_t key = material_key(base, faces[p] >> 2);
        if (p == 0 || key != material_key(base, faces[p - 1] >> 2))
            patches->ranges[patches->range_count++] = (limn_file_range){key - 1, p, 0};
        patches->ranges[patches->range_count - 1].patch_count++;
    }
    return LIMN_BAKE_OK;
}

// ---- Runs

static uint32_t class_at(const limni_arrangement *a, const limni_patches *patches, uint32_t patch) {
    return a->class_indices[patches->faces[patch] >> 2];
}

/// Patches up to the next of another class.
static uint32_t run_end(const limni_arrangement *a, const limni_patches *patches, uint32_t begin) {
    uint32_t end = begin + 1;
    while (end < patches->record.patch_count &&
           class_at(a, patches, end) == class_at(a, patches, begin))
        end++;
    return end;
}

static limn_bake_status make_runs(limni_context *context, const limni_arrangement *a,
                                  limni_patches *patches) {
    limn_file_mesh *const record = &patches->record;
    for (uint32_t p = 0; p < record->patch_count; p = run_end(a, patches, p))
        record->run_count++;
    patches->runs = limni_allocate_zeroed(context, record->run_count, sizeof *patches->runs);
    if (!patches->runs) return LIMN_BAKE_MEMORY;
    limn_file_run *run = patches->runs;
    for (uint32_t p = 0, end; p < record->patch_count; p = end) {
        const uint32_t class_index = class_at(a, patches, p);
        const limn_file_class class = limni_class_record(&a->classes->items[class_index]);
        const uint32_t slot_size = limn_file_slot_size(&class);
        end = run_end(a, patches, p);
        patches->slots_size += patches->slots_size % slot_size;
        *run++ = (limn_file_run){.class_index = class_index,
                                 .first_patch = p,
                                 .patch_count = end - p,
                                 .first_index = record->index_count,
                                 .first_slot = patches->slots_size};
        const uint64_t count = (uint64_t)(end - p) * class.control_count;
        record->index_count += count;
        patches->slots_size += count * slot_size;
    }
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

static limn_bake_status list_controls(limni_context *context, limni_arrangement *a,
                                      limni_patches *patches) {
    patches->indices = limni_allocate(context, patches->record.index_count, sizeof(uint32_t));
    patches->slots = limni_allocate_zeroed(context, patches->slots_size, 1);
    uint64_t *const pairs = limni_allocate(context, LIMN_FORMAT_CONTROLS_MAX, sizeof *pairs);
    if (!patches->indices || !patches->slots || !pairs) return LIMN_BAKE_MEMORY;
    for (uint32_t r = 0; r < patches->record.run_count; r++) {
        const limn_file_run *const run = &patches->runs[r];
        const limn_file_class class = limni_class_record(&a->classes->items[run->class_index]);
        const uint32_t slot_size = limn_file_slot_size(&class);
        for (uint32_t p = 0; p < run->patch_count; p++) {
            const uint32_t face = patches->faces[run->first_patch + p] >> 2;
            const uint32_t count = limni_arrangement_list(a, face, pairs);
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
static limn_bake_status place_points(limni_context *context, const limni_arrangement *a,
                                     limni_patches *patches) {
    const limni_base *const base = a->base;
    const uint32_t count = base->source->control_count;
    const bool isolated = a->rules->isolate == LIMN_ISOLATE_ALWAYS;
    if (!base->divided && !isolated) return LIMN_BAKE_OK;
    patches->controls = limni_allocate(context, count, sizeof *patches->controls);
    if (!patches->controls) return LIMN_BAKE_MEMORY;
    memcpy(patches->controls, base->source->controls, count * sizeof *patches->controls);
    if (base->divided) {
        LIMNI_TRY(append_points(context, &base->stencils, base->mesh->control_count, 0, patches));
        patches->record.divided_count = base->mesh->control_count;
    }
    if (!isolated) return LIMN_BAKE_OK;
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

static limni_patches describe(const limni_base *base, const limni_rules *rules, const char *name) {
    const limni_mesh *const mesh = base->mesh;
    limni_patches patches = {
        .name = name,
        .controls = base->source->controls,
        .rules = *rules,
        .sharp = limni_has_sharpness(base->source),
        .record = {.control_count = base->source->control_count,
                   .point_count = base->source->control_count,
                   .domain = mesh->domain,
                   .patch_count = mesh->face_count - mesh->hole_count,
                   .hole_count = mesh->hole_count},
    };
    find_bounds(base->source, rules, &patches.record);
    return patches;
}

/// The patches whose faces are ordered.
static limn_bake_status list_patches(limni_context *context, limni_arrangement *a,
                                     limni_patches *patches) {
    LIMNI_TRY(make_runs(context, a, patches));
    LIMNI_TRY(list_controls(context, a, patches));
    return place_points(context, a, patches);
}

static limn_bake_status arrange(limni_context *context, const limni_base *base,
                                const limni_channel *channels, uint32_t channel_count,
                                limni_classes *classes, limni_classes *pieces,
                                const limni_patches *patches, limni_arrangement *all) {
    LIMNI_TRY(limni_arrangement_begin(context, base, &patches->rules, NULL, classes, pieces, all));
    for (uint32_t c = 0; c < channel_count; c++)
        LIMNI_TRY(limni_arrangement_begin(context, &channels[c].base, &channels[c].rules,
                                          all[0].assigned.rotations, classes, pieces, &all[1 + c]));
    return LIMN_BAKE_OK;
}

static limn_bake_status list_channel(limni_context *context, const limni_channel *channel,
                                     limni_arrangement *a, uint32_t *faces,
                                     limni_patches *patches) {
    *patches = describe(&channel->base, &channel->rules, channel->name);
    patches->channel_record = channel->record;
    patches->faces = faces;
    return list_patches(context, a, patches);
}

limn_bake_status limni_patches_build(limni_context *context, const limni_base *base,
                                     const limni_rules *rules, const limni_channel *channels,
                                     uint32_t channel_count, limni_classes *classes,
                                     limni_classes *pieces, limni_patches *patches) {
    *patches = describe(base, rules, base->mesh->name);
    patches->record.channel_count = channel_count;
    patches->channels = limni_allocate(context, channel_count, sizeof *patches->channels);
    limni_arrangement *const all = limni_allocate(context, 1 + (size_t)channel_count, sizeof *all);
    if (!patches->channels || !all) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(arrange(context, base, channels, channel_count, classes, pieces, patches, all));
    LIMNI_TRY(order_faces(context, all, channel_count, patches));
    LIMNI_TRY(list_patches(context, &all[0], patches));
    LIMNI_TRY(list_ranges(context, base, patches));
    LIMNI_TRY(list_creases(context, base->mesh, base->sharpness, patches));
    LIMNI_TRY(make_normals(context, base, rules, patches));
    for (uint32_t c = 0; c < channel_count; c++)
        LIMNI_TRY(list_channel(context, &channels[c], &all[1 + c], patches->faces,
                               &patches->channels[c]));
    for (uint32_t a = 0; a <= channel_count; a++)
        limni_arrangement_end(context, &all[a]);
    limni_release(context, all);
    return LIMN_BAKE_OK;
}
