/* SPDX-License-Identifier: MIT */
/* OpenSubdiv's rules for creases: which masks a vertex and an edge take, and how much of each. */
#include "star.h"

bool limni_star_decays(const limni_star *star) {
    bool decays = limni_is_semi_sharp(star->sharpness);
    for (uint32_t r = 0; star->edges && r < star->count; r++)
        decays |= limni_is_semi_sharp(star->edges[r]);
    return decays;
}

static limni_sharp_edges sharp_edges_of(const limni_star *star) {
    limni_sharp_edges edges = {0};
    for (uint32_t r = 0; star->edges && r < star->count; r++)
        limni_sharp_edges_add(&edges, star->edges[r]);
    return edges;
}

limni_sharpness limni_star_next_edge(limn_creasing creasing, const limni_star *star, uint32_t r) {
    return limni_edge_sharpness_next(creasing, limni_star_edge(star, r), sharp_edges_of(star));
}

uint32_t limni_star_opposite(const limni_star *star, uint32_t r) {
    return star->closed ? 2 * ((r + star->count / 2) % star->count) : 0;
}

static limni_vertex_rule rule_of(limni_sharpness vertex, uint32_t sharp_count) {
    static const limni_vertex_rule by_count[] = {LIMNI_VERTEX_SMOOTH, LIMNI_VERTEX_DART,
                                                 LIMNI_VERTEX_CREASE};
    return vertex > 0 || sharp_count > 2 ? LIMNI_VERTEX_CORNER : by_count[sharp_count];
}

/// Counts one edge of a feature; its rule is not known before the last.
static void add_edge(limni_feature *feature, uint32_t *sharp_count, limni_sharpness s, uint32_t r) {
    if (s == 0) return;
    feature->ends[*sharp_count > 0] = r;
    ++*sharp_count;
}

/// The feature of what is at least as sharp as `least`.
static limni_feature find_feature(const limni_star *star, limni_sharpness least) {
    limni_feature feature = {0};
    uint32_t sharp_count = 0;
    for (uint32_t r = 0; r < star->count; r++) {
        const limni_sharpness s = limni_star_edge(star, r);
        add_edge(&feature, &sharp_count, s >= least ? s : 0, r);
    }
    feature.rule = rule_of(star->sharpness >= least ? star->sharpness : 0, sharp_count);
    return feature;
}

limni_feature limni_star_feature(const limni_star *star) {
    return find_feature(star, 1);
}

limni_feature limni_star_last_feature(const limni_star *star) {
    return find_feature(star, LIMNI_SHARPNESS_INFINITE);
}

limni_transition limni_star_transition(limn_creasing creasing, const limni_star *star) {
    limni_transition t = {.now = limni_star_feature(star), .weight = LIMNI_FIXED_ONE};
    if (!limni_star_decays(star)) return t;
    const limni_sharp_edges around = sharp_edges_of(star);
    const limni_sharpness vertex = limni_sharpness_next(star->sharpness);
    const bool vertex_ends = star->sharpness > 0 && vertex == 0;
    // The average of what ends on this level.
    limni_wide sum = vertex_ends ? star->sharpness : 0;
    uint32_t ended = vertex_ends, sharp_count = 0;
    for (uint32_t r = 0; r < star->count; r++) {
        const limni_sharpness s = limni_star_edge(star, r);
        const limni_sharpness next = limni_edge_sharpness_next(creasing, s, around);
        add_edge(&t.next, &sharp_count, next, r);
        if (s == 0 || next > 0) continue;
        sum += s;
        ended++;
    }
    t.next.rule = rule_of(vertex, sharp_count);
    if (t.next.rule == t.now.rule) return t;
    const limni_wide average =
        limni_wide_divide(sum << (LIMNI_FIXED_BITS - LIMNI_SHARPNESS_BITS), ended);
    if (average < LIMNI_FIXED_ONE) t.weight = (limni_fixed)average;
    return t;
}

/// With Chaikin's rule one half may end with a sharpness above 1, up to 4/3; OpenSubdiv takes it as
/// the weight all the same.
limni_fixed limni_star_edge_weight(limn_creasing creasing, const limni_star *star, uint32_t r) {
    const limni_sharpness s = limni_star_edge(star, r);
    if (!limni_is_semi_sharp(s)) return s > 0 ? LIMNI_FIXED_ONE : 0;
    if (limni_star_next_edge(creasing, star, r) > 0 && star->beyond[r] > 0) return LIMNI_FIXED_ONE;
    return limni_sharpness_to_fixed(s);
}
