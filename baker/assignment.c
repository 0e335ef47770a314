/* SPDX-License-Identifier: MIT */
#include "assignment.h"

#include "hash.h"

limn_bake_status limni_assignment_begin(limni_context *context, uint32_t face_count,
                                        limni_assignment *assigned) {
    *assigned = (limni_assignment){
        .keys = limni_allocate(context, face_count, sizeof *assigned->keys),
        .rotations = limni_allocate_zeroed(context, face_count, sizeof *assigned->rotations)};
    return assigned->keys && assigned->rotations ? LIMN_BAKE_OK : LIMN_BAKE_MEMORY;
}

void limni_assignment_end(limni_context *context, const limni_assignment *assigned) {
    limni_release(context, assigned->keys);
    limni_release(context, assigned->rotations);
}

/// Adds up what one side says about an edge: which control points move its rows, and how. The sum
/// does not depend on the order of the slots.
static uint64_t sum_edge(const limni_mesh *mesh, const limni_classes *classes,
                         const limni_class_key *key, const limni_local_base *base, uint32_t edge,
                         bool along, bool tangents) {
    const limni_class *const class = &classes->items[key->class_index];
    uint64_t sum = 0;
    for (uint32_t slot = 0; slot < base->control_count; slot++) {
        if (key->slots[slot] == LIMNI_SLOT_UNUSED) continue;
        const limni_edge_prints *const prints = &class->prints[key->slots[slot]];
        const limni_edge_print print = along ? prints->along[edge] : prints->against[edge];
        const uint32_t control = limni_origin(mesh, base->controls[slot]);
        if (print.positions) sum += limni_hash_mix(print.positions, control);
        if (print.tangents && tangents) sum -= limni_hash_mix(print.tangents, control);
    }
    return sum;
}

/// Whether there is no patch on one side of a half-edge.
static bool is_open(const limni_mesh *mesh, uint32_t h) {
    return mesh->pairs[h] == LIMNI_NONE || mesh->holes[mesh->face_of[h]] ||
           mesh->holes[mesh->face_of[mesh->pairs[h]]];
}

static void sum_edges(limni_classifier *classifier, const limni_classes *classes,
                      const limni_assignment *assigned, uint64_t *sums) {
    const limni_mesh *const mesh = classifier->mesh;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (mesh->holes[face]) continue;
        const uint32_t rotation = assigned->rotations[face];
        const limni_local_base *const base = limni_local_base_at(classifier, face, rotation);
        const uint32_t first = mesh->offsets[face], size = limni_face_size(mesh, face);
        for (uint32_t h = first; h < first + size; h++) {
            const uint32_t edge = (h - first + size - rotation) % size;
            const bool along = mesh->pairs[h] == LIMNI_NONE || h < mesh->pairs[h];
            // On a crease both sides have tangents of their own.
            const bool tangents = classifier->rules->normals == LIMN_NORMALS_EXACT &&
                                  !limni_is_crease(classifier->sharpness, mesh, h);
            sums[h] = sum_edge(mesh, classes, &classes->keys[assigned->keys[face]], base, edge,
                               along, tangents);
        }
    }
}

limn_bake_status limni_check_agreement(limni_context *context, limni_classifier *classifier,
                                       const limni_classes *classes,
                                       const limni_assignment *assigned) {
    const limni_mesh *const mesh = classifier->mesh;
    uint64_t *const sums = limni_allocate(context, mesh->half_edge_count, sizeof *sums);
    if (!sums) return LIMN_BAKE_MEMORY;
    sum_edges(classifier, classes, assigned, sums);
    limn_bake_status status = LIMN_BAKE_OK;
    for (uint32_t h = 0; h < mesh->half_edge_count && status == LIMN_BAKE_OK; h++) {
        const uint32_t pair = mesh->pairs[h];
        if (is_open(mesh, h) || pair < h || sums[h] == sums[pair]) continue;
        limni_place a, b;
        status = limni_fail(context, LIMN_BAKE_INTERNAL,
                            "%s: defect in the baker: %s and %s disagree on their common edge",
                            limni_mesh_label(mesh), limni_face_place(mesh, mesh->face_of[h], a),
                            limni_face_place(mesh, mesh->face_of[pair], b));
    }
    limni_release(context, sums);
    return status;
}
