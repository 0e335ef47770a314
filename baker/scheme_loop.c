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
    const limni_fixed root = 3 * LIMNI_FIXED_ONE + 2 * limni_fixed_turn(1, n).cosine;
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

// ---- Tangents

static void smooth_tangents(const limni_star *star, uint32_t half_steps, limni_fixed *along,
                            limni_fixed *across) {
    along[0] = across[0] = 0;
    for (uint32_t r = 0; r < star->count; r++) {
        const uint32_t turned = 2 * (r + star->count) - half_steps;
        const limni_fixed_unit unit = limni_fixed_turn(turned, 2 * star->count);
        along[1 + r] = unit.cosine;
        across[1 + r] = unit.sine;
    }
}

/// Across a boundary, pointing into the surface: the left eigenvector of the boundary vertex's
/// subdivision matrix that is symmetric and sin(k z), z = pi / (n - 1), on the inner neighbours k.
/// Its eigenvalue is 3/8 + cos(z) / 4; the weights of the ends and of the vertex solve the two
/// equations that are left. For n = 3 and 4 these are the masks (-1; 0 1 0) and (-2; -1 2 2 -1).
/// The mask in print for n >= 5 (Hoppe, Lomont) belongs to Hoppe's boundary rules and not to the
/// cubic B-spline's. All times sin(z), so that no term is large.
static void boundary_tangent(const limni_star *star, limni_fixed *across) {
    const limni_fixed one = LIMNI_FIXED_ONE;
    const uint32_t n = star->count;
    if (n == 2) { // no inner neighbours: eigenvalue 1/4
        across[0] = -2 * one;
        across[1] = across[2] = one;
        return;
    }
    const limni_fixed_unit z = limni_fixed_turn(1, 2 * (n - 1));
    const limni_fixed eigenvalue = 3 * (one / 8) + z.cosine / 4;
    const limni_fixed square = limni_fixed_multiply(z.sine, z.sine);
    const limni_fixed sum = one + z.cosine; // of the inner weights: sin(z) cot(z / 2)
    const limni_fixed determinant =
        limni_fixed_multiply(eigenvalue - one / 2, eigenvalue - 3 * (one / 4)) - one / 8;
    const limni_fixed end =
        limni_fixed_multiply(square, eigenvalue - 3 * (one / 4)) / 8 + 3 * (sum / 64);
    const limni_fixed centre =
        limni_fixed_multiply(3 * (sum / 8), eigenvalue - one / 2) + square / 8;
    across[0] = limni_fixed_divide(centre, determinant);
    across[1] = across[n] = limni_fixed_divide(end, determinant);
    for (uint32_t k = 1; k < n - 1; k++)
        across[1 + k] = limni_fixed_multiply(z.sine, limni_fixed_turn(k, 2 * (n - 1)).sine);
}

void limni_loop_tangent_masks(const limni_star *star, uint32_t half_steps, limni_fixed *along,
                              limni_fixed *across) {
    if (star->rule == LIMNI_VERTEX_SMOOTH) {
        smooth_tangents(star, half_steps, along, across);
        return;
    }
    for (uint32_t w = 0; w <= star->count; w++)
        along[w] = across[w] = 0;
    along[1] = LIMNI_FIXED_ONE;
    if (star->rule == LIMNI_VERTEX_CORNER) {
        along[0] = across[0] = -LIMNI_FIXED_ONE;
        across[star->count] = LIMNI_FIXED_ONE;
    } else {
        along[star->count] = -LIMNI_FIXED_ONE;
        boundary_tangent(star, across);
    }
}

limni_edge_mask limni_loop_edge_mask(bool boundary) {
    if (boundary) return (limni_edge_mask){.end = LIMNI_FIXED_ONE / 2};
    return (limni_edge_mask){.end = 3 * (LIMNI_FIXED_ONE / 8), .opposite = LIMNI_FIXED_ONE / 8};
}
