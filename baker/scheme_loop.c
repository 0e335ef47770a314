/* SPDX-License-Identifier: MIT */
/*
 * Loop subdivision (Loop 1987) with Loop's or Warren's weights, and cubic B-spline boundaries.
 * docs/design.md compares the formulas in print; several do not sum to 1.
 */
#include "scheme.h"

limni_vertex_rule limni_loop_rule(const limni_rules *rules, bool closed, uint32_t valence) {
    if (closed) return LIMNI_VERTEX_SMOOTH;
    if (rules->boundary == LIMN_BOUNDARY_EDGE_AND_CORNER && valence == 2)
        return LIMNI_VERTEX_CORNER;
    return LIMNI_VERTEX_CREASE;
}

/// Loop: b(n) / n with b(n) = (40 - (3 + 2 cos(2 pi / n))^2) / 64.
static limni_fixed loop_weight(uint32_t n) {
    const limni_fixed root = 3 * LIMNI_FIXED_ONE + 2 * limni_fixed_cosine(n);
    const limni_wide square =
        ((limni_wide)root * root) >> LIMNI_FIXED_BITS; // up to 25: too wide for Q4.60
    return (limni_fixed)limni_wide_divide(40 * (limni_wide)LIMNI_FIXED_ONE - square,
                                          64 * (limni_wide)n);
}

/// Warren: 3/16 for n = 3, otherwise 3/(8n); for n = 2 the two agree.
static limni_fixed warren_weight(uint32_t n) {
    return n == 3 ? limni_fixed_ratio(3, 16) : limni_fixed_ratio(3, 8 * (int64_t)n);
}

static limni_fixed ring_weight(const limni_rules *rules, uint32_t n) {
    return rules->weights == LIMN_WEIGHTS_WARREN ? warren_weight(n) : loop_weight(n);
}

/// The limit gives the ring 1 against n + 3 / (8 w) in all, where w is the ring's weight in the
/// vertex mask: 8w / (8wn + 3).
static limni_fixed limit_ring_weight(const limni_rules *rules, uint32_t n) {
    const limni_wide eight_w = 8 * (limni_wide)ring_weight(rules, n);
    const limni_wide divisor = eight_w * n + 3 * (limni_wide)LIMNI_FIXED_ONE;
    return (limni_fixed)limni_wide_divide(eight_w << LIMNI_FIXED_BITS, divisor);
}

static void fill_mask(const limni_star *star, limni_fixed smooth, limni_fixed crease,
                      limni_fixed *weights) {
    limni_fixed centre = LIMNI_FIXED_ONE;
    for (uint32_t r = 0; r < star->count; r++) {
        const bool on_crease = r == 0 || r == star->count - 1;
        limni_fixed weight = 0;
        if (star->rule == LIMNI_VERTEX_SMOOTH) weight = smooth;
        if (star->rule == LIMNI_VERTEX_CREASE && on_crease) weight = crease;
        weights[1 + r] = weight;
        centre -= weight;
    }
    weights[0] = centre;
}

void limni_loop_vertex_mask(const limni_rules *rules, const limni_star *star,
                            limni_fixed *weights) {
    fill_mask(star, ring_weight(rules, star->count), limni_fixed_ratio(1, 8), weights);
}

void limni_loop_limit_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights) {
    fill_mask(star, limit_ring_weight(rules, star->count), limni_fixed_ratio(1, 6), weights);
}

limni_edge_mask limni_loop_edge_mask(bool boundary) {
    if (boundary) return (limni_edge_mask){.end = LIMNI_FIXED_ONE / 2};
    return (limni_edge_mask){.end = 3 * (LIMNI_FIXED_ONE / 8), .opposite = LIMNI_FIXED_ONE / 8};
}
