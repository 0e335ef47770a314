/* SPDX-License-Identifier: MIT */
#include "isolation.h"

#include <string.h>

limn_bake_status limni_isolation_begin(limni_context *context, const limni_mesh *mesh,
                                       const limni_mesh_sharpness *sharpness,
                                       const limni_rules *rules, limni_isolation *isolation) {
    *isolation = (limni_isolation){.mesh = mesh};
    LIMNI_TRY(limni_refine(context, mesh, sharpness, rules, &isolation->refined));
    LIMNI_TRY(limni_make_stencils(context, mesh, sharpness, rules, &isolation->refined,
                                  &isolation->stencils));
    const limni_mesh *const refined = &isolation->refined.mesh;
    LIMNI_TRY(limni_classifier_begin(context, &isolation->classifier, refined,
                                     &isolation->refined.sharpness, rules));
    LIMNI_TRY(limni_assignment_begin(context, refined->face_count, &isolation->assigned));
    const size_t most = LIMN_CORNER_MAX + LIMN_FORMAT_PIECE_COUNT * isolation->classifier.slots_max;
    isolation->points_max = most;
    isolation->slots = limni_allocate(context, refined->control_count, sizeof(uint32_t));
    isolation->marks = limni_allocate_zeroed(context, refined->control_count, sizeof(uint32_t));
    isolation->points = limni_allocate(context, most, sizeof(uint32_t));
    isolation->columns = limni_allocate(context, LIMN_FORMAT_PIECE_COUNT * most, sizeof(uint16_t));
    isolation->parts =
        limni_allocate(context, LIMN_FORMAT_PIECE_COUNT * (1 + most), sizeof(uint16_t));
    return isolation->slots && isolation->marks && isolation->points && isolation->columns &&
                   isolation->parts
               ? LIMN_BAKE_OK
               : LIMN_BAKE_MEMORY;
}

void limni_isolation_end(limni_context *context, limni_isolation *isolation) {
    limni_classifier_end(context, &isolation->classifier);
    limni_assignment_end(context, &isolation->assigned);
    limni_refined_end(context, &isolation->refined);
    limni_release(context, isolation->stencils.offsets);
    limni_release(context, isolation->stencils.terms);
    limni_release(context, isolation->slots);
    limni_release(context, isolation->marks);
    limni_release(context, isolation->points);
    limni_release(context, isolation->columns);
    limni_release(context, isolation->parts);
}

// ---- Pieces

static bool is_corner(const limni_isolation *isolation, uint32_t piece) {
    return piece < limn_domain_get(isolation->mesh->domain)->corner_count;
}

/// The face of the refined mesh that is a piece of a patch.
static uint32_t piece_face(const limni_isolation *isolation, uint32_t face, uint32_t rotation,
                           uint32_t piece) {
    const uint32_t size = limni_face_size(isolation->mesh, face);
    return limni_first_child(isolation->mesh, face) +
           (is_corner(isolation, piece) ? (piece + rotation) % size : piece);
}

/// Finds the table of each piece. A corner's piece starts with that corner, as the refined mesh has
/// it; the middle one of a triangle turns with the patch.
static limn_bake_status find_pieces(limni_context *context, limni_isolation *isolation,
                                    const limni_rules *rules, uint32_t face, uint32_t rotation,
                                    limni_classes *pieces) {
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++) {
        const uint32_t own = piece_face(isolation, face, rotation, p);
        const bool corner = is_corner(isolation, p);
        const uint32_t turned = corner ? 0 : rotation;
        const limni_local_base *const base =
            limni_local_base_at(&isolation->classifier, own, turned);
        isolation->assigned.rotations[own] = turned;
        LIMNI_TRY(limni_classes_find(context, pieces, rules, base,
                                     corner ? LIMNI_TABLE_CORNER : LIMNI_TABLE_MIDDLE,
                                     &isolation->assigned.keys[own]));
    }
    return LIMN_BAKE_OK;
}

// ---- Points

/// The slot of a point in the patch that is being listed, given when it is first met.
static uint32_t slot_of(limni_isolation *isolation, uint32_t point, uint32_t *count) {
    if (isolation->marks[point] != isolation->mark) {
        isolation->marks[point] = isolation->mark;
        isolation->slots[point] = *count;
        for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++)
            isolation->columns[p * isolation->points_max + *count] = LIMN_FORMAT_NO_COLUMN;
        isolation->points[(*count)++] = point;
    }
    return isolation->slots[point];
}

static void list_piece(limni_isolation *isolation, const limni_classes *pieces, uint32_t piece,
                       uint32_t own, uint32_t *count) {
    const limni_local_base *const base =
        limni_local_base_at(&isolation->classifier, own, isolation->assigned.rotations[own]);
    const limni_class_key *const key = &pieces->keys[isolation->assigned.keys[own]];
    for (uint32_t s = 0; s < base->control_count; s++) {
        if (key->slots[s] == LIMNI_SLOT_UNUSED) continue;
        const uint32_t slot = slot_of(isolation, base->controls[s], count);
        isolation->columns[piece * isolation->points_max + slot] = key->slots[s];
    }
}

uint32_t limni_isolation_list(limni_isolation *isolation, const limni_classes *pieces,
                              uint32_t face, uint32_t rotation) {
    uint32_t count = 0;
    if (++isolation->mark == 0) { // the marks have come round: forget them all
        memset(isolation->marks, 0, isolation->refined.mesh.control_count * sizeof(uint32_t));
        isolation->mark = 1;
    }
    const limni_mesh *const mesh = isolation->mesh;
    const uint32_t size = limni_face_size(mesh, face), first = mesh->offsets[face];
    for (uint32_t corner = 0; corner < size; corner++)
        slot_of(isolation, mesh->corners[first + (corner + rotation) % size], &count);
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++)
        list_piece(isolation, pieces, p, piece_face(isolation, face, rotation, p), &count);
    return count;
}

// ---- Classes

/// What the class of a face is that was listed. Its parts are those of the isolation.
static limni_class describe_class(const limni_isolation *isolation, const limni_classes *pieces,
                                  uint32_t face, uint32_t rotation, uint32_t count) {
    const limni_mesh *const mesh = isolation->mesh;
    const uint32_t size = limni_face_size(mesh, face), first = mesh->offsets[face];
    limni_class class = {.domain = mesh->domain,
                         .control_count = count,
                         .table_count = 3,
                         .parts = isolation->parts};
    for (uint32_t corner = 0; corner < size; corner++) {
        const uint32_t control = mesh->corners[first + (corner + rotation) % size];
        class.valences[corner] = mesh->valences[control];
        class.boundary_corners |= (uint32_t)limni_is_boundary(mesh, control) << corner;
    }
    uint16_t *columns = class.parts + LIMN_FORMAT_PIECE_COUNT;
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++, columns += count) {
        const uint32_t key = isolation->assigned.keys[piece_face(isolation, face, rotation, p)];
        class.parts[p] = (uint16_t)pieces->keys[key].class_index;
        const limni_class *const piece = &pieces->items[class.parts[p]];
        class.negative = piece->negative > class.negative ? piece->negative : class.negative;
        if (piece->table_count < class.table_count) class.table_count = piece->table_count;
        memcpy(columns, isolation->columns + p * isolation->points_max, count * sizeof *columns);
    }
    return class;
}

limn_bake_status limni_isolation_classify(limni_context *context, limni_isolation *isolation,
                                          const limni_rules *rules, uint32_t face,
                                          uint32_t rotation, limni_classes *pieces,
                                          limni_classes *classes, uint32_t *class_index) {
    LIMNI_TRY(find_pieces(context, isolation, rules, face, rotation, pieces));
    if (pieces->count > LIMN_FORMAT_PIECES_MAX)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "the file has more than %u tables of pieces", LIMN_FORMAT_PIECES_MAX);
    const uint32_t count = limni_isolation_list(isolation, pieces, face, rotation);
    if (count > LIMN_FORMAT_CONTROLS_MAX) {
        limni_place place;
        return limni_fail(
            context, LIMN_BAKE_BAD_INPUT,
            "%s: around %s there are more than %u points of the level that isolates it",
            limni_mesh_label(isolation->mesh), limni_face_place(isolation->mesh, face, place),
            LIMN_FORMAT_CONTROLS_MAX);
    }
    const limni_class class = describe_class(isolation, pieces, face, rotation, count);
    return limni_classes_find_parts(context, classes, &class, class_index);
}
