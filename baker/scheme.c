/* SPDX-License-Identifier: MIT */
#include "scheme.h"

const limni_scheme *limni_scheme_of(const limni_rules *rules, limn_domain_kind domain) {
    if (rules->scheme == LIMN_SCHEME_BUTTERFLY) return &limni_scheme_butterfly;
    return domain == LIMN_DOMAIN_QUAD ? &limni_scheme_catmark : &limni_scheme_loop;
}

// ---- Masks

static limni_fixed weight_of(const limni_feature *feature, limni_ring_weights weights, uint32_t r) {
    const bool on_crease = r == feature->ends[0] || r == feature->ends[1];
    switch (feature->rule) {
    case LIMNI_VERTEX_CREASE:
        return on_crease ? weights.crease : 0;
    case LIMNI_VERTEX_CORNER:
        return 0;
    default:
        return weights.smooth;
    }
}

static limni_fixed face_weight_of(const limni_feature *feature, limni_ring_weights weights) {
    const bool smooth = feature->rule == LIMNI_VERTEX_SMOOTH || feature->rule == LIMNI_VERTEX_DART;
    return smooth ? weights.face : 0;
}

static limni_fixed blend(const limni_transition *transition, limni_fixed now, limni_fixed next) {
    if (transition->weight == LIMNI_FIXED_ONE) return now;
    return limni_fixed_multiply(transition->weight, now) +
           limni_fixed_multiply(LIMNI_FIXED_ONE - transition->weight, next);
}

void limni_fill_mask(const limni_transition *transition, limni_ring_weights given,
                     const limni_star *star, limn_domain_kind domain, limni_fixed *weights) {
    const limni_feature *const now = &transition->now, *const next = &transition->next;
    limni_fixed centre = LIMNI_FIXED_ONE;
    for (uint32_t r = 0; r < star->count; r++)
        centre -= weights[1 + r] =
            blend(transition, weight_of(now, given, r), weight_of(next, given, r));
    const limni_fixed face =
        blend(transition, face_weight_of(now, given), face_weight_of(next, given));
    const uint32_t face_count = domain == LIMN_DOMAIN_QUAD ? limni_star_face_count(star) : 0;
    for (uint32_t f = 0; f < face_count; f++)
        centre -= weights[1 + star->count + f] = face;
    weights[0] = centre;
}

limni_transition limni_star_forever(const limni_rules *rules, const limni_star *star) {
    return (limni_transition){.now = limni_star_feature(rules, star), .weight = LIMNI_FIXED_ONE};
}

static limni_fixed power_of(limni_fixed q, uint32_t exponent) {
    limni_fixed power = LIMNI_FIXED_ONE;
    for (; exponent > 0 && power > 0; exponent--)
        power = limni_fixed_multiply(power, q);
    return power;
}

limni_fixed limni_dart_profile(uint32_t j, uint32_t n, int k, limni_fixed q) {
    const limni_fixed powers =
        limni_fixed_divide(power_of(q, j) + power_of(q, n - j), LIMNI_FIXED_ONE + power_of(q, n));
    return limni_fixed_multiply(limni_fixed_ratio(1, k - 2), LIMNI_FIXED_ONE - powers);
}

// ---- Tangents

limni_sector limni_crease_side(const limni_star *star, uint32_t first) {
    limni_sector side = {.first = first, .count = 2};
    for (uint32_t r = limni_star_left(star, first); limni_star_edge(star, r) == 0;
         r = limni_star_left(star, r))
        side.count++;
    return side;
}

/// The part of a corner whose normal a face has: the face alone, which starts at ring vertex
/// `first`; with a smooth edge between two faces both. The tangents are then the sharp edges on
/// both sides of it: the eigenvalue of what it has apart from them is 3/8 against their 1/2.
/// Between more faces there is no tangent plane in the limit, as what the smooth edges have in
/// common outlasts the sharp ones.
static limni_sector corner_side(const limni_star *star, uint32_t first) {
    const uint32_t right = first, left = limni_star_left(star, first);
    const uint32_t beyond = limni_star_left(star, left), before = limni_star_right(star, right);
    const bool right_sharp = limni_star_edge(star, right) > 0;
    const bool left_sharp = limni_star_edge(star, left) > 0;
    if (right_sharp && !left_sharp && beyond != right && limni_star_edge(star, beyond) > 0)
        return (limni_sector){right, 3};
    if (left_sharp && !right_sharp && before != left && limni_star_edge(star, before) > 0)
        return (limni_sector){before, 3};
    return (limni_sector){right, 2};
}

/// After Lomont all faces between two sharp edges have the normal of these, whose eigenvalue of 5/8
/// no smooth edge exceeds. With fewer sharp edges each face has its own.
static limni_sector lomont_corner_side(const limni_star *star, uint32_t first) {
    uint32_t sharp_count = 0;
    for (uint32_t r = 0; r < star->count; r++)
        sharp_count += limni_star_edge(star, r) > 0;
    limni_sector side = {.first = first, .count = 2};
    if (sharp_count < 2) return side;
    for (; limni_star_edge(star, side.first) == 0; side.count++)
        side.first = limni_star_right(star, side.first);
    while (limni_star_edge(star, (side.first + side.count - 1) % star->count) == 0)
        side.count++;
    return side;
}

void limni_corner_tangents(const limni_rules *rules, const limni_star *star, uint32_t first,
                           limni_fixed *along, limni_fixed *across) {
    const bool lomont = rules->creases == LIMN_CREASES_LOMONT;
    const limni_sector s = lomont ? lomont_corner_side(star, first) : corner_side(star, first);
    along[0] = across[0] = -LIMNI_FIXED_ONE;
    *limni_in_sector(star, s, 0, along) = LIMNI_FIXED_ONE;
    *limni_in_sector(star, s, s.count - 1, across) = LIMNI_FIXED_ONE;
}
