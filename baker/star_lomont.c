/* SPDX-License-Identifier: MIT */
/*
 * Lomont's rules for creases ("High Performance Subdivision Surfaces", 2007), as
 * docs/mathematics.md has them. What is known beyond an edge is the type of the vertex there, which its mask depends on.
 */
#include "crease_rules.h"

/// From here on an edge or vertex is sharp, and below a fraction of that.
enum { SHARP = LIMNI_SHARPNESS_LEVEL };

typedef enum vertex_type {
    TYPE_SMOOTH,
    TYPE_DART,
    TYPE_REGULAR,     ///< on a crease
    TYPE_NON_REGULAR, ///< likewise
    TYPE_CORNER
} vertex_type;

/// Whether an edge is smooth but for a fraction. It sees all others of its kind as sharp.
static bool is_fractional(limni_sharpness edge) {
    return edge > 0 && edge < SHARP;
}

static vertex_type type_of(const limni_star *star, bool fractions_are_sharp) {
    const limni_feature feature =
        limni_star_find_feature(star, fractions_are_sharp ? 1 : SHARP, SHARP);
    switch (feature.rule) {
    case LIMNI_VERTEX_SMOOTH:
        return TYPE_SMOOTH;
    case LIMNI_VERTEX_DART:
        return TYPE_DART;
    case LIMNI_VERTEX_CREASE:
        return feature.regular ? TYPE_REGULAR : TYPE_NON_REGULAR;
    default:
        return TYPE_CORNER;
    }
}

/// The masks of creases, and the tangents of corners, are for regular neighbours along sharp edges:
/// all vertices have such from the level after their own on.
static bool is_settled(const limni_star *star) {
    const limni_vertex_rule rule = limni_star_find_feature(star, SHARP, SHARP).rule;
    const bool smooth = rule == LIMNI_VERTEX_SMOOTH || rule == LIMNI_VERTEX_DART;
    for (uint32_t r = 0; !smooth && star->beyond && r < star->count; r++) {
        if (limni_star_edge(star, r) > 0 && star->beyond[r] != TYPE_REGULAR) return false;
    }
    return !limni_star_decays(star);
}

/// A vertex that is sharp itself is a corner, or that fraction of one.
static limni_transition transition(const limni_rules *rules, const limni_star *star) {
    const limni_transition t = {
        .now = limni_star_feature(rules, star),
        .weight = LIMNI_FIXED_ONE,
    };
    if (!is_fractional(star->sharpness)) return t;
    return (limni_transition){
        .now = {.rule = LIMNI_VERTEX_CORNER},
        .next = t.now,
        .weight = limni_sharpness_to_fixed(star->sharpness),
    };
}

/// Table 2. Its text gives 3/8 to the corner, and so it is for any vertex that is not regular.
static limni_edge_feature edge_feature(const limni_rules *rules, const limni_star *star,
                                       uint32_t r) {
    (void)rules;
    const limni_sharpness s = limni_star_edge(star, r);
    limni_edge_feature feature = {.weight = 0, .ends = {4, 4}};
    if (s == 0) return feature;
    const vertex_type own = type_of(star, is_fractional(s)), other = (vertex_type)star->beyond[r];
    if (own == TYPE_DART || other == TYPE_DART) return feature;
    if ((own == TYPE_REGULAR) != (other == TYPE_REGULAR)) {
        feature.ends[0] = own == TYPE_REGULAR ? 5 : 3;
        feature.ends[1] = other == TYPE_REGULAR ? 5 : 3;
    }
    feature.weight = is_fractional(s) ? limni_sharpness_to_fixed(s) : LIMNI_FIXED_ONE;
    return feature;
}

static void see(const limni_rules *rules, const limni_star *star, uint32_t first, uint32_t count,
                uint32_t *seen) {
    (void)rules;
    const vertex_type whole = type_of(star, false), fractional = type_of(star, true);
    for (uint32_t r = 0; r < count; r++) {
        const limni_sharpness s = limni_star_edge(star, first + r);
        seen[r] = s == 0 ? 0 : is_fractional(s) ? fractional : whole;
    }
}

/// A new vertex has six neighbours, or four on a boundary.
static uint32_t next_beyond(const limni_rules *rules, const limni_star *star, uint32_t r) {
    return limni_star_next_edge(rules, star, r) > 0 ? TYPE_REGULAR : 0;
}

const limni_crease_rules limni_lomont_creases = {
    .sharp_from = SHARP,
    .is_settled = is_settled,
    .transition = transition,
    .edge_feature = edge_feature,
    .see = see,
    .next_beyond = next_beyond,
};
