/* SPDX-License-Identifier: MIT */
#include "classify.h"

#include <string.h>

/// The most that a local base takes.
typedef struct extent {
    size_t edges; ///< of the corners
    size_t rings; ///< words of limni_local_base: here of all vertices next to each corner
    size_t slots;
} extent;

/// What the stars of the vertices next to a control point take.
static size_t sum_second_rings(const limni_mesh *mesh, uint32_t control) {
    size_t sum = 0;
    uint32_t h = mesh->first[control];
    do {
        sum += 2 + (size_t)mesh->valences[limni_half_edge_end(mesh, h)];
        const uint32_t incoming = limni_half_edge_previous(mesh, h);
        h = mesh->pairs[incoming];
        if (h == LIMNI_NONE) sum += 2 + (size_t)mesh->valences[mesh->corners[incoming]];
    } while (h != LIMNI_NONE && h != mesh->first[control]);
    return sum;
}

static extent find_extent(const limni_mesh *mesh, uint32_t reach) {
    extent most = {0};
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        size_t edges = 0, rings = 0;
        if (mesh->holes[face]) continue;
        for (uint32_t h = mesh->offsets[face]; h < mesh->offsets[face + 1]; h++) {
            edges += mesh->valences[mesh->corners[h]];
            if (reach == 2) rings += sum_second_rings(mesh, mesh->corners[h]);
        }
        most.edges = edges > most.edges ? edges : most.edges;
        most.rings = rings > most.rings ? rings : most.rings;
    }
    const size_t slots = LIMN_CORNER_MAX + 2 * most.edges + most.rings;
    most.slots = slots < mesh->control_count ? slots : mesh->control_count;
    return most;
}

static limn_bake_status allocate_base(limni_context *context, const extent *most,
                                      limni_local_base *base) {
    const size_t key_size = 3 * LIMN_CORNER_MAX + 6 * most->edges + most->rings + 2 * most->slots;
    base->controls = limni_allocate(context, most->slots, sizeof *base->controls);
    base->twins = limni_allocate(context, most->slots, sizeof *base->twins);
    base->key = limni_allocate(context, key_size, sizeof *base->key);
    base->room = limni_allocate(context, 4 * most->edges, sizeof *base->room);
    base->spokes = limni_allocate(context, most->slots, sizeof *base->spokes);
    base->rings = limni_allocate(context, most->rings, sizeof *base->rings);
    base->edges_max = most->edges;
    return base->controls && base->twins && base->key && base->room && base->spokes && base->rings
               ? LIMN_BAKE_OK
               : LIMN_BAKE_MEMORY;
}

limn_bake_status limni_classifier_begin(limni_context *context, limni_classifier *classifier,
                                        const limni_mesh *mesh,
                                        const limni_mesh_sharpness *sharpness,
                                        const limni_rules *rules) {
    const extent most = find_extent(mesh, limni_scheme_of(rules, mesh->domain)->reach);
    *classifier = (limni_classifier){
        .mesh = mesh,
        .sharpness = sharpness,
        .rules = rules,
        .slots = limni_allocate(context, mesh->control_count, sizeof(uint32_t)),
        .marks = limni_allocate_zeroed(context, mesh->control_count, sizeof(uint32_t)),
        .slots_max = most.slots,
    };
    if (!classifier->slots || !classifier->marks) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(allocate_base(context, &most, &classifier->bases[0]));
    return allocate_base(context, &most, &classifier->bases[1]);
}

void limni_classifier_end(limni_context *context, limni_classifier *classifier) {
    limni_release(context, classifier->slots);
    limni_release(context, classifier->marks);
    for (int b = 0; b < 2; b++) {
        limni_release(context, classifier->bases[b].controls);
        limni_release(context, classifier->bases[b].twins);
        limni_release(context, classifier->bases[b].key);
        limni_release(context, classifier->bases[b].room);
        limni_release(context, classifier->bases[b].spokes);
        limni_release(context, classifier->bases[b].rings);
    }
}

/// The first slot of the control points that were one with this, which has none yet; LIMNI_NONE: it
/// is the first.
static uint32_t find_twin(const limni_classifier *classifier, const limni_local_base *base,
                          uint32_t control) {
    const limni_mesh *const mesh = classifier->mesh;
    if (!limni_is_split(mesh, control)) return LIMNI_NONE;
    const uint32_t origin = mesh->origins[control];
    uint32_t other = control;
    while (other > 0 && mesh->origins[other - 1] == origin)
        other--;
    for (; other < mesh->control_count && mesh->origins[other] == origin; other++) {
        if (classifier->marks[other] == classifier->mark)
            return base->twins[classifier->slots[other]];
    }
    return LIMNI_NONE;
}

/// The slot of a control point in the local base that is being built, given when it is first met.
static uint32_t slot_of(limni_classifier *classifier, limni_local_base *base, uint32_t control) {
    if (classifier->marks[control] != classifier->mark) {
        const uint32_t slot = base->control_count++;
        const uint32_t twin = find_twin(classifier, base, control);
        classifier->marks[control] = classifier->mark;
        classifier->slots[control] = slot;
        base->controls[slot] = control;
        base->twins[slot] = twin == LIMNI_NONE ? slot : twin;
        base->twin_count += twin != LIMNI_NONE;
    }
    return classifier->slots[control];
}

/// The ring of the face's corner in slots. A closed ring starts at the face's own edge, an open one
/// at the boundary.
static void walk_ring(limni_classifier *classifier, limni_local_base *base, uint32_t half_edge,
                      limni_star *star) {
    limni_mesh_star(classifier->mesh, classifier->sharpness, half_edge, star);
    for (uint32_t r = 0; r < star->count; r++) {
        star->ring[r] = slot_of(classifier, base, star->ring[r]);
        if (star->diagonals && r < limni_star_face_count(star))
            star->diagonals[r] = slot_of(classifier, base, star->diagonals[r]);
    }
}

/// Half-edges that leave the ring vertices of a corner, to the corner where stars are closed.
static void find_spokes(const limni_mesh *mesh, uint32_t half_edge, limni_local_base *base,
                        const limni_classifier *classifier) {
    const uint32_t corner = mesh->corners[half_edge], first = mesh->first[corner];
    uint32_t h = limni_is_boundary(mesh, corner) ? first : half_edge;
    const uint32_t start = h;
    do {
        const uint32_t incoming = limni_half_edge_previous(mesh, h);
        base->spokes[classifier->slots[mesh->corners[incoming]]] = incoming;
        if (mesh->pairs[h] == LIMNI_NONE) { // an open star begins: any half-edge will do
            const uint32_t next = limni_half_edge_next(mesh, h);
            base->spokes[classifier->slots[mesh->corners[next]]] = next;
        }
        h = mesh->pairs[incoming];
    } while (h != LIMNI_NONE && h != start);
}

/// Walks the rings of the vertices next to the corners. Open ones start at their boundary, closed
/// ones at a corner of the face, the last that they are next to.
static void walk_second_rings(limni_classifier *classifier, limni_local_base *base) {
    const limni_mesh *const mesh = classifier->mesh;
    const uint32_t begin = mesh->offsets[base->face];
    base->inner_count = base->control_count;
    base->rings_size = 0;
    for (uint32_t corner = 0; corner < base->corner_count; corner++)
        find_spokes(mesh, begin + (corner + base->rotation) % base->corner_count, base, classifier);
    for (uint32_t slot = base->corner_count; slot < base->inner_count; slot++) {
        uint32_t *const words = base->rings + base->rings_size;
        limni_star star = {.ring = words + 2};
        limni_mesh_star(mesh, classifier->sharpness, base->spokes[slot], &star);
        words[0] = star.count;
        words[1] = star.closed;
        for (uint32_t r = 0; r < star.count; r++)
            star.ring[r] = slot_of(classifier, base, star.ring[r]);
        base->rings_size += 2 + star.count;
    }
}

/// Whether an edge is sharp, other than on a boundary whose ends are all alike to the rules.
static bool has_creases(const limni_rules *rules, const limni_local_base *base) {
    const bool boundaries = rules->creases == LIMN_CREASES_LOMONT;
    bool any = false;
    for (uint32_t corner = 0; corner < base->corner_count; corner++) {
        const limni_star *const star = &base->corners[corner];
        for (uint32_t r = 0; star->edges && r < star->count; r++) {
            const bool inside = limni_star_has_left(star, r) && limni_star_has_right(star, r);
            any |= (inside || boundaries) && star->edges[r] > 0;
        }
    }
    return any;
}

/// Walks all rings.
static void walk_rings(limni_classifier *classifier, limni_local_base *base) {
    const uint32_t begin = base->mesh->offsets[base->face];
    size_t first = 0;
    for (uint32_t corner = 0; corner < base->corner_count; corner++) {
        limni_star *const star = &base->corners[corner];
        *star = (limni_star){.ring = base->room + first,
                             .edges = base->room + base->edges_max + first,
                             .beyond = base->room + 2 * base->edges_max + first,
                             .diagonals = base->room + 3 * base->edges_max + first};
        walk_ring(classifier, base, begin + (corner + base->rotation) % base->corner_count, star);
        first += star->count;
    }
    base->inner_count = base->corner_count;
    base->rings_size = 0;
    if (limni_scheme_of(classifier->rules, base->mesh->domain)->reach == 2)
        walk_second_rings(classifier, base);
    if (has_creases(classifier->rules, base)) return;
    for (uint32_t corner = 0; corner < base->corner_count; corner++)
        base->corners[corner].edges = base->corners[corner].beyond = NULL;
}

enum { KEY_RULE = 1, KEY_CREASES = 3, KEY_CHAIKIN = 4, KEY_TWINS = 5 }; // bits

/// What there is at a corner, without the sharpness.
static uint32_t key_flags(const limni_star *star, const limni_rules *rules, bool tagged) {
    const limni_vertex_rule rule = limni_star_feature(rules, star).rule;
    const bool chaikin = rules->creasing == LIMN_CREASING_CHAIKIN;
    return (uint32_t)star->closed | (uint32_t)rule << KEY_RULE | (uint32_t)tagged << KEY_CREASES |
           (uint32_t)(tagged && chaikin) << KEY_CHAIKIN;
}

static uint32_t *append(uint32_t *key, const uint32_t *words, uint32_t count) {
    memcpy(key, words, count * sizeof *key);
    return key + count;
}

static void write_key(limni_local_base *base, const limni_rules *rules) {
    const limni_star *const corners = base->corners, *const end = corners + base->corner_count;
    uint32_t *key = base->key;
    bool tagged = corners[0].edges;
    for (const limni_star *star = corners; star < end; star++)
        tagged |= limni_is_semi_sharp(star->sharpness);
    for (const limni_star *star = corners; star < end; star++)
        *key++ = star->count;
    for (const limni_star *star = corners; star < end; star++)
        *key++ = key_flags(star, rules, tagged) | (uint32_t)(base->twin_count > 0) << KEY_TWINS;
    for (const limni_star *star = corners; star < end; star++) {
        key = append(key, star->ring, star->count);
        if (star->diagonals) key = append(key, star->diagonals, limni_star_face_count(star));
    }
    key = append(key, base->rings, base->rings_size);
    for (const limni_star *star = corners; star < end && tagged; star++) {
        *key++ = star->sharpness;
        if (!star->edges) continue;
        key = append(key, star->edges, star->count);
        key = append(key, star->beyond, star->count);
    }
    for (uint32_t slot = 0; slot < base->control_count && base->twin_count; slot++) {
        if (base->twins[slot] != slot) key = append(key, (uint32_t[]){slot, base->twins[slot]}, 2);
    }
    base->key_size = (uint32_t)(key - base->key);
}

static void build_base(limni_classifier *classifier, limni_local_base *base, uint32_t face,
                       uint32_t rotation) {
    const limni_mesh *const mesh = classifier->mesh;
    if (++classifier->mark == 0) { // the marks have come round: forget them all
        memset(classifier->marks, 0, mesh->control_count * sizeof(uint32_t));
        classifier->mark = 1;
    }
    base->mesh = mesh;
    base->sharpness = classifier->sharpness;
    base->face = face;
    base->rotation = rotation;
    base->corner_count = limni_face_size(mesh, face);
    base->control_count = base->twin_count = 0;
    for (uint32_t corner = 0; corner < base->corner_count; corner++)
        slot_of(classifier, base,
                mesh->corners[mesh->offsets[face] + (corner + rotation) % base->corner_count]);
    walk_rings(classifier, base);
    write_key(base, classifier->rules);
}

static int compare_keys(const limni_local_base *a, const limni_local_base *b) {
    // Keys of different size differ before the shorter one ends: in the valences, or in the flags.
    for (uint32_t k = 0; k < a->key_size; k++) {
        if (a->key[k] != b->key[k]) return a->key[k] < b->key[k] ? -1 : 1;
    }
    return 0;
}

/// Whether in another rotation the valences would be smaller, at the first that differ.
static bool is_larger(const uint32_t *valences, uint32_t count, uint32_t rotation) {
    for (uint32_t other = 0; other < count; other++) {
        for (uint32_t c = 0; c < count; c++) {
            const uint32_t own = valences[(c + rotation) % count];
            const uint32_t its = valences[(c + other) % count];
            if (its < own) return true;
            if (its > own) break;
        }
    }
    return false;
}

/// Whether the valences alone say that this rotation is not the canonical one.
static bool is_ruled_out(const limni_mesh *mesh, uint32_t face, uint32_t rotation) {
    uint32_t valences[LIMN_CORNER_MAX];
    const uint32_t count = limni_face_size(mesh, face);
    for (uint32_t c = 0; c < count; c++)
        valences[c] = mesh->valences[mesh->corners[mesh->offsets[face] + c]];
    if (count != 3) return is_larger(valences, count, rotation);
    const uint32_t first = valences[rotation];
    const uint32_t second = valences[(rotation + 1) % 3], third = valences[(rotation + 2) % 3];
    if (first == second || first == third || second == third)
        return second !=
               third; // all three are equal, or a mirror line would go through the odd one
    return is_larger(valences, count, rotation);
}

const limni_local_base *limni_classify(limni_classifier *classifier, uint32_t face) {
    const uint32_t corner_count = limni_face_size(classifier->mesh, face);
    limni_local_base *best = NULL, *tried = &classifier->bases[0];
    for (uint32_t rotation = 0; rotation < corner_count; rotation++) {
        if (is_ruled_out(classifier->mesh, face, rotation)) continue;
        build_base(classifier, tried, face, rotation);
        if (best && compare_keys(tried, best) >= 0) continue;
        best = tried;
        tried = &classifier->bases[best == &classifier->bases[0]];
    }
    return best;
}

const limni_local_base *limni_local_base_at(limni_classifier *classifier, uint32_t face,
                                            uint32_t rotation) {
    build_base(classifier, &classifier->bases[0], face, rotation);
    return &classifier->bases[0];
}

limn_bake_status limni_local_neighbourhood(limni_context *context, const limni_local_base *base,
                                           limni_neighbourhood *neighbourhood) {
    const limni_cutting cutting = {.mesh = base->mesh,
                                   .sharpness = base->sharpness,
                                   .controls = base->controls,
                                   .control_count = base->control_count,
                                   .inner_count = base->inner_count,
                                   .half_edge = base->mesh->offsets[base->face] + base->rotation,
                                   .with_edges = base->corners[0].edges};
    LIMNI_TRY(limni_neighbourhood_begin(context, &cutting, neighbourhood));
    neighbourhood->twins = base->twin_count ? base->twins : NULL;
    return LIMN_BAKE_OK;
}

// ---- Limits

/// That of `count` vertices with the most edges.
static uint32_t find_widest(const limni_mesh *mesh, const uint32_t *controls, uint32_t count) {
    uint32_t widest = controls[0];
    for (uint32_t c = 1; c < count; c++) {
        if (mesh->valences[controls[c]] > mesh->valences[widest]) widest = controls[c];
    }
    return widest;
}

static limn_bake_status check_corners(limni_context *context, const limni_mesh *mesh,
                                      uint32_t face) {
    const uint32_t size = limni_face_size(mesh, face);
    const uint32_t most = LIMN_FORMAT_CONTROLS_MAX / (size == 3 ? 1 : 2);
    const uint32_t *const corners = mesh->corners + mesh->offsets[face];
    uint64_t sum = 0;
    for (uint32_t c = 0; c < size; c++)
        sum += mesh->valences[corners[c]];
    if (sum <= most) return LIMN_BAKE_OK;
    const uint32_t widest = find_widest(mesh, corners, size);
    limni_place control_text, face_text;
    return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                      "%s: %s has valence %u: the corners of %s have more than %u edges in all",
                      limni_mesh_label(mesh), limni_control_place(mesh, widest, control_text),
                      mesh->valences[widest], limni_face_place(mesh, face, face_text), most);
}

static limn_bake_status check_count(limni_context *context, const limni_local_base *base) {
    const limni_mesh *const mesh = base->mesh;
    if (base->control_count <= LIMN_FORMAT_CONTROLS_MAX) return LIMN_BAKE_OK;
    const uint32_t widest = find_widest(mesh, base->controls, base->inner_count);
    limni_place control_text, face_text;
    return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                      "%s: %s has valence %u: around %s there are more than %u control points",
                      limni_mesh_label(mesh), limni_control_place(mesh, widest, control_text),
                      mesh->valences[widest], limni_face_place(mesh, base->face, face_text),
                      LIMN_FORMAT_CONTROLS_MAX);
}

static limn_bake_status check_counts(limni_context *context, const limni_mesh *mesh,
                                     const limni_mesh_sharpness *sharpness,
                                     const limni_rules *rules) {
    limni_classifier classifier;
    LIMNI_TRY(limni_classifier_begin(context, &classifier, mesh, sharpness, rules));
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (!mesh->holes[face])
            LIMNI_TRY(check_count(context, limni_local_base_at(&classifier, face, 0)));
    }
    limni_classifier_end(context, &classifier);
    return LIMN_BAKE_OK;
}

/// The points that a patch depends on are no more than the edges of its corners, and of a quad
/// twice as many; with a reach of 2, those are counted.
limn_bake_status limni_check_valences(limni_context *context, const limni_mesh *mesh,
                                      const limni_mesh_sharpness *sharpness,
                                      const limni_rules *rules) {
    if (limni_scheme_of(rules, mesh->domain)->reach == 2)
        return check_counts(context, mesh, sharpness, rules);
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (!mesh->holes[face]) LIMNI_TRY(check_corners(context, mesh, face));
    }
    return LIMN_BAKE_OK;
}
