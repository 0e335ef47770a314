/* SPDX-License-Identifier: MIT */
/*
 * Loop subdivision (Loop 1987) with Loop's or Warren's weights, and cubic B-spline creases and
 * boundaries: all of them, as OpenSubdiv does, or only at regular vertices, as Hoppe et al. (1994)
 * and Lomont do.
 * docs/design.md compares the formulas in print; several do not sum to 1.
 */
#include "scheme.h"

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

/// What the masks of a feature give the ring.
typedef struct ring_weights {
    limni_fixed smooth; ///< every neighbour
    limni_fixed crease; ///< both neighbours along it
} ring_weights;

static limni_fixed weight_of(const limni_feature *feature, ring_weights weights, uint32_t r) {
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

static void fill_mask(const limni_transition *transition, ring_weights given, uint32_t count,
                      limni_fixed *weights) {
    const limni_fixed rest = LIMNI_FIXED_ONE - transition->weight;
    limni_fixed centre = LIMNI_FIXED_ONE;
    for (uint32_t r = 0; r < count; r++) {
        limni_fixed weight = weight_of(&transition->now, given, r);
        if (rest != 0)
            weight = limni_fixed_multiply(transition->weight, weight) +
                     limni_fixed_multiply(rest, weight_of(&transition->next, given, r));
        weights[1 + r] = weight;
        centre -= weight;
    }
    weights[0] = centre;
}

void limni_loop_vertex_mask(const limni_rules *rules, const limni_star *star,
                            limni_fixed *weights) {
    const limni_transition transition = limni_star_transition(rules, star);
    const ring_weights given = {ring_weight(rules, star->count), limni_fixed_ratio(1, 8)};
    fill_mask(&transition, given, star->count, weights);
}

/// Whether a crease is a cubic B-spline where it passes through a vertex: after Lomont, who has
/// Hoppe's rules, only if the vertex is regular.
static bool is_spline(const limni_rules *rules, const limni_feature *feature) {
    return rules->creases != LIMN_CREASES_LOMONT || feature->regular;
}

/// Powers of (5 - sqrt(21)) / 2, the smaller root of q^2 - 5 q + 1 = 0.
static limni_fixed dart_power(uint32_t exponent) {
    static const limni_fixed q = 240628728915490202;
    limni_fixed power = LIMNI_FIXED_ONE;
    for (; exponent > 0 && power > 0; exponent--)
        power = limni_fixed_multiply(power, q);
    return power;
}

/// Where a crease ends for ever, by OpenSubdiv's rules. Its edge has the mask of a crease, so the
/// smooth limit is not the limit: that is the left eigenvector for the eigenvalue 1. With the
/// vertex's weight 1, neighbour j from the crease on has 8 w z(j), where 5 z(j) - z(j - 1) - z(j +
/// 1) = 1 between z(0) = z(n) = 0, which z(j) = (1 - (q^j + q^(n - j)) / (1 + q^n)) / 3 solves; and
/// the crease 2 w (1 + 2 z(1)).
static void fill_dart_limit(const limni_rules *rules, const limni_star *star, uint32_t crease,
                            limni_fixed *weights) {
    const uint32_t n = star->count;
    const limni_fixed w = ring_weight(rules, n), third = limni_fixed_ratio(1, 3);
    limni_fixed sum = LIMNI_FIXED_ONE, centre = LIMNI_FIXED_ONE, first = 0;
    for (uint32_t j = n; j-- > 0;) {
        const limni_fixed powers =
            limni_fixed_divide(dart_power(j) + dart_power(n - j), LIMNI_FIXED_ONE + dart_power(n));
        const limni_fixed z = limni_fixed_multiply(third, LIMNI_FIXED_ONE - powers);
        if (j == 1) first = z;
        const limni_fixed share = j == 0 ? LIMNI_FIXED_ONE / 4 + first / 2 : z;
        sum += weights[1 + (crease + j) % n] = limni_fixed_multiply(8 * w, share);
    }
    for (uint32_t r = 0; r < n; r++)
        centre -= weights[1 + r] = limni_fixed_divide(weights[1 + r], sum);
    weights[0] = centre;
}

void limni_loop_limit_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights) {
    const limni_transition forever = {.now = limni_star_feature(rules, star),
                                      .weight = LIMNI_FIXED_ONE};
    const bool spline = is_spline(rules, &forever.now);
    const ring_weights given = {limit_ring_weight(rules, star->count),
                                limni_fixed_ratio(1, spline ? 6 : 5)};
    if (forever.now.rule == LIMNI_VERTEX_DART && rules->creases != LIMN_CREASES_LOMONT) {
        fill_dart_limit(rules, star, forever.now.ends[0], weights);
        return;
    }
    fill_mask(&forever, given, star->count, weights);
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

/// Places in a ring from `first` on, counter-clockwise.
typedef struct sector {
    uint32_t first, count;
} sector;

/// The side of a crease that starts at its edge `first`.
static sector crease_side(const limni_star *star, uint32_t first) {
    sector side = {.first = first, .count = 2};
    for (uint32_t r = limni_star_left(star, first); limni_star_edge(star, r) == 0;
         r = limni_star_left(star, r))
        side.count++;
    return side;
}

/// The weight of its vertex k.
static limni_fixed *in_sector(const limni_star *star, sector s, uint32_t k, limni_fixed *weights) {
    return &weights[1 + (s.first + k) % star->count];
}

/// Across a crease, pointing into its sector: the left eigenvector of the boundary vertex's
/// subdivision matrix that is symmetric and sin(k z), z = pi / (n - 1), on the inner neighbours k.
/// Its eigenvalue is 3/8 + cos(z) / 4; the weights of the ends and of the vertex solve the two
/// equations that are left. For n = 3 and 4 these are the masks (-1; 0 1 0) and (-2; -1 2 2 -1).
/// All times sin(z), so that no term is large.
static void spline_tangent(const limni_star *star, sector s, limni_fixed *across) {
    const limni_fixed one = LIMNI_FIXED_ONE;
    const uint32_t n = s.count;
    if (n == 2) { // no inner neighbours: eigenvalue 1/4
        across[0] = -2 * one;
        *in_sector(star, s, 0, across) = *in_sector(star, s, 1, across) = one;
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
    *in_sector(star, s, 0, across) = *in_sector(star, s, n - 1, across) =
        limni_fixed_divide(end, determinant);
    for (uint32_t k = 1; k < n - 1; k++)
        *in_sector(star, s, k, across) =
            limni_fixed_multiply(z.sine, limni_fixed_turn(k, 2 * (n - 1)).sine);
}

/// The same with Hoppe's rules, for n >= 4: -sin z at the ends and (2 - 2 cos z) sin(k z) inside,
/// divided by sin z. The eigenvalue is the same.
static void hoppe_tangent(const limni_star *star, sector s, limni_fixed *across) {
    const uint32_t n = s.count;
    const limni_fixed_unit z = limni_fixed_turn(1, 2 * (n - 1));
    const limni_fixed scale = 2 * limni_fixed_divide(z.sine, LIMNI_FIXED_ONE + z.cosine);
    *in_sector(star, s, 0, across) = *in_sector(star, s, n - 1, across) = -LIMNI_FIXED_ONE;
    for (uint32_t k = 1; k < n - 1; k++)
        *in_sector(star, s, k, across) =
            limni_fixed_multiply(scale, limni_fixed_turn(k, 2 * (n - 1)).sine);
}

/// The part of a corner whose normal a face has: the face alone, which starts at ring vertex
/// `first`; with a smooth edge between two faces both. The tangents are then the sharp edges on
/// both sides of it: the eigenvalue of what it has apart from them is 3/8 against their 1/2.
/// Between more faces there is no tangent plane in the limit, as what the smooth edges have in
/// common outlasts the sharp ones.
static sector corner_side(const limni_star *star, uint32_t first) {
    const uint32_t right = first, left = limni_star_left(star, first);
    const uint32_t beyond = limni_star_left(star, left), before = limni_star_right(star, right);
    const bool right_sharp = limni_star_edge(star, right) > 0;
    const bool left_sharp = limni_star_edge(star, left) > 0;
    if (right_sharp && !left_sharp && beyond != right && limni_star_edge(star, beyond) > 0)
        return (sector){right, 3};
    if (left_sharp && !right_sharp && before != left && limni_star_edge(star, before) > 0)
        return (sector){before, 3};
    return (sector){right, 2};
}

/// After Lomont all faces between two sharp edges have the normal of these, whose eigenvalue of 5/8
/// no smooth edge exceeds. With fewer sharp edges each face has its own.
static sector lomont_corner_side(const limni_star *star, uint32_t first) {
    uint32_t sharp_count = 0;
    for (uint32_t r = 0; r < star->count; r++)
        sharp_count += limni_star_edge(star, r) > 0;
    sector side = {.first = first, .count = 2};
    if (sharp_count < 2) return side;
    for (; limni_star_edge(star, side.first) == 0; side.count++)
        side.first = limni_star_right(star, side.first);
    while (limni_star_edge(star, (side.first + side.count - 1) % star->count) == 0)
        side.count++;
    return side;
}

/// The tangents are the edges on both sides.
static void corner_tangents(const limni_star *star, sector s, limni_fixed *along,
                            limni_fixed *across) {
    along[0] = across[0] = -LIMNI_FIXED_ONE;
    *in_sector(star, s, 0, along) = *in_sector(star, s, s.count - 1, across) = LIMNI_FIXED_ONE;
}

void limni_loop_tangent_masks(const limni_rules *rules, const limni_star *star, uint32_t half_steps,
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
        const bool lomont = rules->creases == LIMN_CREASES_LOMONT;
        corner_tangents(star, lomont ? lomont_corner_side(star, first) : corner_side(star, first),
                        along, across);
        return;
    }
    const sector side = crease_side(star, first);
    along[1 + first] = LIMNI_FIXED_ONE;
    *in_sector(star, side, side.count - 1, along) = -LIMNI_FIXED_ONE;
    if (side.count < 4 || is_spline(rules, &feature))
        spline_tangent(star, side, across);
    else
        hoppe_tangent(star, side, across);
}

limni_edge_mask limni_loop_edge_mask(const limni_edge_feature *feature) {
    // A smooth edge has 3/8 and 1/8; in sharpness, eighths are exact.
    const limni_fixed eighth = feature->weight / 8;
    return (limni_edge_mask){.ends = {3 * (LIMNI_FIXED_ONE / 8) + (feature->ends[0] - 3) * eighth,
                                      3 * (LIMNI_FIXED_ONE / 8) + (feature->ends[1] - 3) * eighth},
                             .opposite = (LIMNI_FIXED_ONE - feature->weight) / 8};
}
