/* SPDX-License-Identifier: MIT */
#include "classify.h"

#include <string.h>

enum {
    /// check_size() refuses faces whose rings have more entries in all.
    RING_MAX = LIMNI_LOCAL_BASE_MAX,
    KEY_MAX = 6 + 3 * RING_MAX
};

static limn_bake_status allocate_base(limni_context *context, limni_local_base *base) {
    base->controls = limni_allocate(context, 3 * RING_MAX + 3, sizeof *base->controls);
    base->key = limni_allocate(context, KEY_MAX, sizeof *base->key);
    if (!base->controls || !base->key) return LIMN_BAKE_MEMORY;
    for (int corner = 0; corner < 3; corner++) {
        limni_star *const star = &base->neighbourhood.corners[corner];
        star->ring = limni_allocate(context, RING_MAX, sizeof *star->ring);
        if (!star->ring) return LIMN_BAKE_MEMORY;
    }
    return LIMN_BAKE_OK;
}

limn_bake_status limni_classifier_begin(limni_context *context, limni_classifier *classifier,
                                        const limni_mesh *mesh, const limni_rules *rules) {
    *classifier = (limni_classifier){
        .mesh = mesh,
        .rules = rules,
        .slots = limni_allocate(context, mesh->control_count, sizeof(uint32_t)),
        .marks = limni_allocate_zeroed(context, mesh->control_count, sizeof(uint32_t)),
    };
    if (!classifier->slots || !classifier->marks) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(allocate_base(context, &classifier->bases[0]));
    return allocate_base(context, &classifier->bases[1]);
}

void limni_classifier_end(limni_context *context, limni_classifier *classifier) {
    limni_release(context, classifier->slots);
    limni_release(context, classifier->marks);
    for (int b = 0; b < 2; b++) {
        limni_release(context, classifier->bases[b].controls);
        limni_release(context, classifier->bases[b].key);
        for (int corner = 0; corner < 3; corner++)
            limni_release(context, classifier->bases[b].neighbourhood.corners[corner].ring);
    }
}

/// The slot of a control point in the local base that is being built, given when it is first met.
static uint32_t slot_of(limni_classifier *classifier, limni_local_base *base, uint32_t control) {
    if (classifier->marks[control] != classifier->mark) {
        classifier->marks[control] = classifier->mark;
        classifier->slots[control] = base->neighbourhood.control_count;
        base->controls[base->neighbourhood.control_count++] = control;
    }
    return classifier->slots[control];
}

/// Walks the ring of the face's corner. A closed ring starts at the face's own edge, an open one at
/// the boundary.
static void walk_ring(limni_classifier *classifier, limni_local_base *base, uint32_t half_edge,
                      limni_star *star) {
    const limni_mesh *const mesh = classifier->mesh;
    const uint32_t control = limni_half_edge_start(mesh, half_edge);
    star->closed = !limni_is_boundary(mesh, control);
    star->count = 0;
    uint32_t *const ring = star->ring;
    const uint32_t start = star->closed ? half_edge : mesh->first[control];
    uint32_t turning = start, last;
    do {
        ring[star->count++] = slot_of(classifier, base, limni_half_edge_end(mesh, turning));
        last = turning;
        turning = limni_half_edge_turn(mesh, turning);
    } while (turning != start && turning != LIMNI_NONE);
    if (!star->closed) {
        const uint32_t end = limni_half_edge_start(mesh, limni_half_edge_previous(last));
        ring[star->count++] = slot_of(classifier, base, end);
    }
    star->rule = limni_loop_rule(classifier->rules, star->closed, star->count);
}

static void write_key(limni_local_base *base) {
    const limni_star *const corners = base->neighbourhood.corners;
    uint32_t *key = base->key;
    for (int corner = 0; corner < 3; corner++)
        *key++ = corners[corner].count;
    for (int corner = 0; corner < 3; corner++)
        *key++ = (uint32_t)corners[corner].closed | (uint32_t)corners[corner].rule << 1;
    for (int corner = 0; corner < 3; corner++) {
        memcpy(key, corners[corner].ring, corners[corner].count * sizeof *key);
        key += corners[corner].count;
    }
    base->key_size = (uint32_t)(key - base->key);
}

static void build_base(limni_classifier *classifier, limni_local_base *base, uint32_t face,
                       uint32_t rotation) {
    if (++classifier->mark == 0) { // the marks have come round: forget them all
        memset(classifier->marks, 0, classifier->mesh->control_count * sizeof(uint32_t));
        classifier->mark = 1;
    }
    base->rotation = rotation;
    base->neighbourhood.control_count = 0;
    for (uint32_t corner = 0; corner < 3; corner++)
        slot_of(classifier, base, classifier->mesh->faces[face][(corner + rotation) % 3]);
    for (uint32_t corner = 0; corner < 3; corner++)
        walk_ring(classifier, base, 3 * face + (corner + rotation) % 3,
                  &base->neighbourhood.corners[corner]);
    write_key(base);
}

static int compare_keys(const limni_local_base *a, const limni_local_base *b) {
    // The valences come first, so keys of different size differ before the shorter one ends.
    for (uint32_t k = 0; k < a->key_size; k++) {
        if (a->key[k] != b->key[k]) return a->key[k] < b->key[k] ? -1 : 1;
    }
    return 0;
}

/// Whether the valences alone say that this rotation is not the canonical one.
static bool is_ruled_out(const limni_mesh *mesh, uint32_t face, uint32_t rotation) {
    const uint32_t *const corners = mesh->faces[face];
    const uint32_t first = mesh->valences[corners[rotation]];
    const uint32_t second = mesh->valences[corners[(rotation + 1) % 3]];
    const uint32_t third = mesh->valences[corners[(rotation + 2) % 3]];
    if (first == second || first == third || second == third)
        return second !=
               third; // all three are equal, or a mirror line would go through the odd one
    for (uint32_t other = 0; other < 3; other++) {
        for (uint32_t c = 0; c < 3; c++) {
            const uint32_t own = mesh->valences[corners[(c + rotation) % 3]];
            const uint32_t its = mesh->valences[corners[(c + other) % 3]];
            if (its < own) return true;
            if (its > own) break;
        }
    }
    return false;
}

static limn_bake_status check_size(limni_context *context, const limni_mesh *mesh, uint32_t face) {
    uint64_t sum = 0;
    uint32_t widest = mesh->faces[face][0];
    for (int c = 0; c < 3; c++) {
        const uint32_t control = mesh->faces[face][c];
        sum += mesh->valences[control];
        if (mesh->valences[control] > mesh->valences[widest]) widest = control;
    }
    if (sum <= LIMNI_LOCAL_BASE_MAX) return LIMN_BAKE_OK;
    limni_place control_text, face_text;
    return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                      "%s: %s has valence %u: the corners of %s have more than %u edges in all",
                      mesh->path ? mesh->path : mesh->name,
                      limni_control_place(mesh, widest, control_text), mesh->valences[widest],
                      limni_face_place(mesh, face, face_text), LIMNI_LOCAL_BASE_MAX);
}

const limni_local_base *limni_classify(limni_context *context, limni_classifier *classifier,
                                       uint32_t face) {
    if (check_size(context, classifier->mesh, face) != LIMN_BAKE_OK) return NULL;
    int best = -1;
    for (uint32_t rotation = 0; rotation < 3; rotation++) {
        if (is_ruled_out(classifier->mesh, face, rotation)) continue;
        const int tried = best == 0 ? 1 : 0;
        build_base(classifier, &classifier->bases[tried], face, rotation);
        if (best < 0 || compare_keys(&classifier->bases[tried], &classifier->bases[best]) < 0)
            best = tried;
    }
    return &classifier->bases[best];
}

const limni_local_base *limni_local_base_at(limni_classifier *classifier, uint32_t face,
                                            uint32_t rotation) {
    build_base(classifier, &classifier->bases[0], face, rotation);
    return &classifier->bases[0];
}
