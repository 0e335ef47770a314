/* SPDX-License-Identifier: MIT */
#include "arrangement.h"

#include <string.h>

static bool is_isolated(const limni_arrangement *a) {
    return a->rules->isolate == LIMN_ISOLATE_ALWAYS;
}

// ---- Faces apart

/// A mesh of the same faces, none of which share anything: its vertices are its half-edges.
static limn_bake_status set_apart(limni_context *context, limni_arrangement *a) {
    const limni_mesh *const mesh = a->base->mesh;
    const uint32_t count = mesh->half_edge_count;
    limni_mesh *const made = &a->apart_mesh;
    *made = *mesh;
    made->control_count = count;
    made->origins = NULL;
    made->corners = limni_allocate(context, count, sizeof *made->corners);
    made->pairs = limni_allocate(context, count, sizeof *made->pairs);
    made->first = limni_allocate(context, count, sizeof *made->first);
    made->valences = limni_allocate(context, count, sizeof *made->valences);
    if (!made->corners || !made->pairs || !made->first || !made->valences) return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < count; h++) {
        made->corners[h] = made->first[h] = h;
        made->pairs[h] = LIMNI_NONE;
        made->valences[h] = 2;
    }
    a->mesh = made;
    a->sharpness = &a->apart_sharpness;
    return limni_mesh_sharpness_begin(context, made, a->rules, &a->apart_sharpness);
}

static void end_apart(limni_context *context, limni_arrangement *a) {
    limni_release(context, a->apart_mesh.corners);
    limni_release(context, a->apart_mesh.pairs);
    limni_release(context, a->apart_mesh.first);
    limni_release(context, a->apart_mesh.valences);
    limni_mesh_sharpness_end(context, &a->apart_sharpness);
}

// ---- Classes

static limn_bake_status begin(limni_context *context, limni_arrangement *a) {
    a->mesh = a->base->mesh;
    a->sharpness = a->base->sharpness;
    if (a->apart) LIMNI_TRY(set_apart(context, a));
    const uint32_t face_count = a->mesh->face_count;
    LIMNI_TRY(limni_classifier_begin(context, &a->classifier, a->mesh, a->sharpness, a->rules));
    LIMNI_TRY(limni_assignment_begin(context, face_count, &a->assigned));
    a->class_indices = limni_allocate(context, face_count, sizeof *a->class_indices);
    if (!a->class_indices) return LIMN_BAKE_MEMORY;
    return is_isolated(a)
               ? limni_isolation_begin(context, a->mesh, a->sharpness, a->rules, &a->isolation)
               : LIMN_BAKE_OK;
}

static limn_bake_status assign_class(limni_context *context, limni_arrangement *a,
                                     const uint32_t *rotations, uint32_t face) {
    const limni_local_base *const base =
        rotations ? limni_local_base_at(&a->classifier, face, rotations[face])
                  : limni_classify(&a->classifier, face);
    uint32_t *const key = &a->assigned.keys[face];
    a->assigned.rotations[face] = base->rotation;
    if (is_isolated(a))
        return limni_isolation_classify(context, &a->isolation, a->rules, face, base->rotation,
                                        a->pieces, a->classes, &a->class_indices[face]);
    LIMNI_TRY(limni_classes_find(context, a->classes, a->rules, base, LIMNI_TABLE_PATCH, key));
    a->class_indices[face] = a->classes->keys[*key].class_index;
    return LIMN_BAKE_OK;
}

static limn_bake_status assign_classes(limni_context *context, limni_arrangement *a,
                                       const uint32_t *rotations) {
    const uint32_t face_count = a->mesh->face_count, step = face_count / 200 + 1;
    for (uint32_t face = 0; face < face_count; face++) {
        if (face % step == 0) limni_progress(context, "classify", face, face_count);
        if (!a->mesh->holes[face]) LIMNI_TRY(assign_class(context, a, rotations, face));
    }
    limni_progress(context, "classify", face_count, face_count);
    return is_isolated(a)
               ? limni_check_agreement(context, &a->isolation.classifier, a->pieces,
                                       &a->isolation.assigned)
               : limni_check_agreement(context, &a->classifier, a->classes, &a->assigned);
}

limn_bake_status limni_arrangement_begin(limni_context *context, const limni_base *base,
                                         const limni_rules *rules, const uint32_t *rotations,
                                         limni_classes *classes, limni_classes *pieces,
                                         limni_arrangement *arrangement) {
    *arrangement = (limni_arrangement){
        .base = base,
        .rules = rules,
        .classes = classes,
        .pieces = pieces,
        // A linear channel depends on the corners of the face alone: one class for all.
        .apart = rotations && rules->scheme == LIMN_SCHEME_NONE,
    };
    LIMNI_TRY(begin(context, arrangement));
    return assign_classes(context, arrangement, rotations);
}

void limni_arrangement_end(limni_context *context, limni_arrangement *arrangement) {
    if (is_isolated(arrangement)) limni_isolation_end(context, &arrangement->isolation);
    limni_release(context, arrangement->class_indices);
    limni_assignment_end(context, &arrangement->assigned);
    limni_classifier_end(context, &arrangement->classifier);
    if (arrangement->apart) end_apart(context, arrangement);
}

// ---- Points

static uint32_t list_isolated(limni_arrangement *a, uint32_t face, uint64_t *pairs) {
    const uint32_t count =
        limni_isolation_list(&a->isolation, a->pieces, face, a->assigned.rotations[face]);
    const uint32_t first = a->base->first + a->mesh->control_count;
    for (uint32_t slot = 0; slot < count; slot++)
        pairs[slot] = (uint64_t)(first + a->isolation.points[slot]) << 32 | slot;
    return count;
}

uint32_t limni_arrangement_list(limni_arrangement *a, uint32_t face, uint64_t *pairs) {
    if (is_isolated(a)) return list_isolated(a, face, pairs);
    const limni_local_base *const base =
        limni_local_base_at(&a->classifier, face, a->assigned.rotations[face]);
    const limni_class_key *const key = &a->classes->keys[a->assigned.keys[face]];
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < base->control_count; slot++) {
        const uint32_t control = base->controls[slot];
        const uint32_t vertex = a->apart ? a->base->mesh->corners[control] : control;
        if (key->slots[slot] == LIMNI_SLOT_UNUSED) continue;
        pairs[count++] = (uint64_t)(a->base->first + vertex) << 32 | key->slots[slot];
    }
    return count;
}
