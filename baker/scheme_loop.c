/* SPDX-License-Identifier: MIT */
/*
 * Loop subdivision (Loop 1987) with Loop's or Warren's weights, and cubic B-spline creases and
 * boundaries: all of them, as OpenSubdiv does, or only at regular vertices, as Hoppe et al. (1994)
 * and Lomont do.
 * docs/mathematics.md compares the formulas in print; several do not sum to 1.
 */
#include "masks.h"

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

static void vertex_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights) {
    const limni_transition transition = limni_star_transition(rules, star);
    const limni_ring_weights given = {.smooth = ring_weight(rules, star->count),
                                      .crease = limni_fixed_ratio(1, 8)};
    limni_fill_mask(&transition, given, star, LIMN_DOMAIN_TRIANGLE, weights);
}

limni_edge_mask limni_loop_edge_mask(const limni_edge_feature *feature) {
    // A smooth edge has 3/8 and 1/8; in sharpness, eighths are exact.
    const limni_fixed eighth = feature->weight / 8;
    return (limni_edge_mask){.ends = {3 * (LIMNI_FIXED_ONE / 8) + (feature->ends[0] - 3) * eighth,
                                      3 * (LIMNI_FIXED_ONE / 8) + (feature->ends[1] - 3) * eighth},
                             .beside = (LIMNI_FIXED_ONE - feature->weight) / 8};
}

static void edge_terms(limni_masks *masks, uint32_t r) {
    const limni_edge_feature feature = limni_star_edge_feature(masks->rules, &masks->star, r);
    const limni_edge_mask mask = limni_loop_edge_mask(&feature);
    limni_masks_add_edge(masks, r, &mask);
}

/// Whether a crease is a cubic B-spline where it passes through a vertex: after Lomont, who has
/// Hoppe's rules, only if the vertex is regular.
static bool is_spline(const limni_rules *rules, const limni_feature *feature) {
    return rules->creases != LIMN_CREASES_LOMONT || feature->regular;
}

/// Where a crease ends for ever, by OpenSubdiv's rules. Its edge has the mask of a crease, so the
/// smooth limit is not the limit: that is the left eigenvector for the eigenvalue 1. With the
/// vertex's weight 1, neighbour j from the crease on has 8 w z(j), where 5 z(j) - z(j - 1) - z(j +
/// 1) = 1 between z(0) = z(n) = 0; and the crease 2 w (1 + 2 z(1)).
static void fill_dart_limit(const limni_rules *rules, const limni_star *star, uint32_t crease,
                            limni_fixed *weights) {
    static const limni_fixed q = 240628728915490202; // (5 - sqrt(21)) / 2
    const uint32_t n = star->count;
    const limni_fixed w = ring_weight(rules, n);
    limni_fixed sum = LIMNI_FIXED_ONE, centre = LIMNI_FIXED_ONE;
    for (uint32_t j = 0; j < n; j++) {
        const limni_fixed share = j == 0 ? LIMNI_FIXED_ONE / 4 + limni_dart_profile(1, n, 5, q) / 2
                                         : limni_dart_profile(j, n, 5, q);
        sum += weights[1 + (crease + j) % n] = limni_fixed_multiply(8 * w, share);
    }
    for (uint32_t r = 0; r < n; r++)
        centre -= weights[1 + r] = limni_fixed_divide(weights[1 + r], sum);
    weights[0] = centre;
}

static void limit_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights) {
    const limni_transition forever = limni_star_forever(rules, star);
    const bool spline = is_spline(rules, &forever.now);
    const limni_ring_weights given = {.smooth = limit_ring_weight(rules, star->count),
                                      .crease = limni_fixed_ratio(1, spline ? 6 : 5)};
    if (forever.now.rule == LIMNI_VERTEX_DART && rules->creases != LIMN_CREASES_LOMONT) {
        fill_dart_limit(rules, star, forever.now.ends[0], weights);
        return;
    }
    limni_fill_mask(&forever, given, star, LIMN_DOMAIN_TRIANGLE, weights);
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

/// Across a crease, pointing into its sector: the left eigenvector of the boundary vertex's
/// subdivision matrix that is symmetric and sin(k z), z = pi / (n - 1), on the inner neighbours k.
/// Its eigenvalue is 3/8 + cos(z) / 4; the weights of the ends and of the vertex solve the two
/// equations that are left. For n = 3 and 4 these are the masks (-1; 0 1 0) and (-2; -1 2 2 -1).
/// All times sin(z), so that no term is large.
static void spline_tangent(const limni_star *star, limni_sector s, limni_fixed *across) {
    const limni_fixed one = LIMNI_FIXED_ONE;
    const uint32_t n = s.count;
    if (n == 2) { // no inner neighbours: eigenvalue 1/4
        across[0] = -2 * one;
        *limni_in_sector(star, s, 0, across) = *limni_in_sector(star, s, 1, across) = one;
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
    *limni_in_sector(star, s, 0, across) = *limni_in_sector(star, s, n - 1, across) =
        limni_fixed_divide(end, determinant);
    for (uint32_t k = 1; k < n - 1; k++)
        *limni_in_sector(star, s, k, across) =
            limni_fixed_multiply(z.sine, limni_fixed_turn(k, 2 * (n - 1)).sine);
}

/// The same with Hoppe's rules, for n >= 4: -sin z at the ends and (2 - 2 cos z) sin(k z) inside,
/// divided by sin z. The eigenvalue is the same.
static void hoppe_tangent(const limni_star *star, limni_sector s, limni_fixed *across) {
    const uint32_t n = s.count;
    const limni_fixed_unit z = limni_fixed_turn(1, 2 * (n - 1));
    const limni_fixed scale = 2 * limni_fixed_divide(z.sine, LIMNI_FIXED_ONE + z.cosine);
    *limni_in_sector(star, s, 0, across) = *limni_in_sector(star, s, n - 1, across) =
        -LIMNI_FIXED_ONE;
    for (uint32_t k = 1; k < n - 1; k++)
        *limni_in_sector(star, s, k, across) =
            limni_fixed_multiply(scale, limni_fixed_turn(k, 2 * (n - 1)).sine);
}

static void tangent_masks(const limni_rules *rules, const limni_star *star, uint32_t half_steps,
                          limni_fixed *along, limni_fixed *across) {
    const limni_feature feature = limni_star_feature(rules, star);
    if (feature.rule == LIMNI_VERTEX_SMOOTH || feature.rule == LIMNI_VERTEX_DART) {
        smooth_tangents(star, half_steps, along, across);
        return;
    }
    for (uint32_t w = 0; w <= star->count; w++)
        along[w] = across[w] = 0;
    const uint32_t first = half_steps / 2;
    if (feature.rule == LIMNI_VERTEX_CORNER) {
        limni_corner_tangents(rules, star, first, along, across);
        return;
    }
    const limni_sector side = limni_crease_side(star, first);
    along[1 + first] = LIMNI_FIXED_ONE;
    *limni_in_sector(star, side, side.count - 1, along) = -LIMNI_FIXED_ONE;
    if (side.count < 4 || is_spline(rules, &feature))
        spline_tangent(star, side, across);
    else
        hoppe_tangent(star, side, across);
}

static void tangent_terms(limni_masks *masks, uint32_t half_steps, int tangent) {
    limni_fixed *const *const weights = masks->weights;
    tangent_masks(masks->rules, &masks->star, half_steps, weights[0], weights[1]);
    limni_masks_add_star(masks, weights[tangent]);
}

const limni_scheme limni_scheme_loop = {
    .domain = LIMN_DOMAIN_TRIANGLE,
    .reach = 1,
    .vertex_mask = vertex_mask,
    .limit_mask = limit_mask,
    .edge_terms = edge_terms,
    .tangent_terms = tangent_terms,
};
