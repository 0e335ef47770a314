/* SPDX-License-Identifier: MIT */
/*
 * OpenSubdiv's rules for creases: which masks a vertex and an edge take, and how much of each. What
 * is known beyond an edge is the sharpness that its half there has after a level: all that
 * Chaikin's method needs.
 */
#include "crease_rules.h"

static bool is_settled(const limni_star *star) {
    return !limni_star_decays(star);
}

/// Counts one edge of a feature; its rule is not known before the last.
static void add_edge(limni_feature *feature, uint32_t *sharp_count, limni_sharpness s, uint32_t r) {
    if (s == 0) return;
    feature->ends[*sharp_count > 0] = r;
    ++*sharp_count;
}

static limni_transition transition(const limni_rules *rules, const limni_star *star) {
    limni_transition t = {.now = limni_star_feature(rules, star), .weight = LIMNI_FIXED_ONE};
    if (!limni_star_decays(star)) return t;
    const limni_sharp_edges around = limni_star_sharp_edges(star);
    const limni_sharpness vertex = limni_sharpness_next(star->sharpness);
    const bool vertex_ends = star->sharpness > 0 && vertex == 0;
    // The average of what ends on this level.
    limni_wide sum = vertex_ends ? star->sharpness : 0;
    uint32_t ended = vertex_ends, sharp_count = 0;
    for (uint32_t r = 0; r < star->count; r++) {
        const limni_sharpness s = limni_star_edge(star, r);
        const limni_sharpness next = limni_edge_sharpness_next(rules->creasing, s, around);
        add_edge(&t.next, &sharp_count, next, r);
        if (s == 0 || next > 0) continue;
        sum += s;
        ended++;
    }
    t.next.rule = limni_vertex_rule_of(vertex > 0, sharp_count);
    if (t.next.rule == t.now.rule) return t;
    const limni_wide average =
        limni_wide_divide(sum << (LIMNI_FIXED_BITS - LIMNI_SHARPNESS_BITS), ended);
    if (average < LIMNI_FIXED_ONE) t.weight = (limni_fixed)average;
    return t;
}

/// How much of a crease an edge is: all if it stays sharp, and its sharpness on the level at which
/// that ends. With Chaikin's rule one half may end with a sharpness above 1, up to 4/3; OpenSubdiv
/// takes it as the weight all the same.
static limni_fixed edge_weight(const limni_rules *rules, const limni_star *star, uint32_t r) {
    const limni_sharpness s = limni_star_edge(star, r);
    if (!limni_is_semi_sharp(s)) return s > 0 ? LIMNI_FIXED_ONE : 0;
    if (limni_star_next_edge(rules, star, r) > 0 && star->beyond[r] > 0) return LIMNI_FIXED_ONE;
    return limni_sharpness_to_fixed(s);
}

static limni_edge_feature edge_feature(const limni_rules *rules, const limni_star *star,
                                       uint32_t r) {
    return (limni_edge_feature){.weight = edge_weight(rules, star, r), .ends = {4, 4}};
}

static void see(const limni_rules *rules, const limni_star *star, uint32_t first, uint32_t count,
                uint32_t *seen) {
    const limni_sharp_edges around = limni_star_sharp_edges(star);
    for (uint32_t r = 0; r < count; r++)
        seen[r] =
            limni_edge_sharpness_next(rules->creasing, limni_star_edge(star, first + r), around);
}

/// The two halves of an edge meet in its new vertex.
static uint32_t next_beyond(const limni_rules *rules, const limni_star *star, uint32_t r) {
    const limni_sharpness half = limni_star_next_edge(rules, star, r);
    limni_sharp_edges both = {0};
    limni_sharp_edges_add(&both, half);
    limni_sharp_edges_add(&both, star->beyond[r]);
    return limni_edge_sharpness_next(rules->creasing, half, both);
}

const limni_crease_rules limni_opensubdiv_creases = {
    .sharp_from = 1,
    .is_settled = is_settled,
    .transition = transition,
    .edge_feature = edge_feature,
    .see = see,
    .next_beyond = next_beyond,
};
