/* SPDX-License-Identifier: MIT */
/*
 * Catmull-Clark subdivision (1978), with cubic B-spline creases and boundaries as OpenSubdiv has
 * them. Limits and tangents are those of meshes of quads. docs/mathematics.md has them.
 */
#include "masks.h"

/// The middle of a face is the mean of its corners, and a smooth vertex of valence n gets 1/n^2 of
/// each neighbour and of each face. Faces get a multiple of 4, so that quads share it out exactly.
static void vertex_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights) {
    const limni_transition transition = limni_star_transition(rules, star);
    const limni_fixed quarter = limni_fixed_ratio(1, 4 * (int64_t)star->count * star->count);
    const limni_ring_weights given = {
        .smooth = 4 * quarter, .crease = limni_fixed_ratio(1, 8), .face = 4 * quarter};
    limni_fill_mask(&transition, given, star, LIMN_DOMAIN_QUAD, weights);
}

/// A smooth edge has a quarter of both ends and of both faces.
limni_edge_mask limni_catmark_edge_mask(const limni_edge_feature *feature) {
    const limni_fixed smooth = (LIMNI_FIXED_ONE - feature->weight) / 4;
    const limni_fixed eighth = feature->weight / 8;
    return (limni_edge_mask){
        .ends = {smooth + feature->ends[0] * eighth, smooth + feature->ends[1] * eighth},
        .beside = smooth};
}

static void edge_terms(limni_masks *masks, uint32_t r) {
    const limni_edge_feature feature = limni_star_edge_feature(masks->rules, &masks->star, r);
    const limni_edge_mask mask = limni_catmark_edge_mask(&feature);
    limni_masks_add_edge(masks, r, &mask);
}

// ---- Limits

/// Where a crease ends for ever: the left eigenvector for the eigenvalue 1, see fill_dart_limit() of
/// Loop's. With the vertex's weight 1 and w = 1/n^2, neighbour j from the crease on has a(j) = 20 w
/// z(j), where 7 z(j) - z(j - 1) - z(j + 1) = 1; diagonal j has (4 w + a(j) + a(j + 1)) / 12 = w (1 +
/// 5 z(j) + 5 z(j + 1)) / 3; and the crease twice the sum of w and of both diagonals beside it.
static void fill_dart_limit(const limni_star *star, uint32_t crease, limni_fixed *weights) {
    static const limni_fixed q = 168208980590594236; // (7 - sqrt(45)) / 2
    const uint32_t n = star->count;
    const limni_fixed one = LIMNI_FIXED_ONE, w = limni_fixed_ratio(1, (int64_t)n * n);
    limni_fixed *const ring = weights + 1, *const diagonals = ring + n;
    limni_fixed sum = one, centre = one, z = 0;
    for (uint32_t j = 0; j < n; j++) {
        const limni_fixed after = j + 1 < n ? limni_dart_profile(j + 1, n, 7, q) : 0;
        const limni_fixed share = (limni_fixed)limni_wide_divide(
            (limni_wide)one + 5 * (limni_wide)z + 5 * (limni_wide)after, 3);
        diagonals[(crease + j) % n] = limni_fixed_multiply(w, share);
        ring[(crease + j) % n] = limni_fixed_multiply(20 * w, z);
        z = after;
    }
    ring[crease] = 2 * (w + diagonals[crease] + diagonals[(crease + n - 1) % n]);
    for (uint32_t r = 0; r < 2 * n; r++)
        sum += ring[r];
    for (uint32_t r = 0; r < 2 * n; r++)
        centre -= ring[r] = limni_fixed_divide(ring[r], sum);
    weights[0] = centre;
}

/// A smooth vertex: n^2 against 4 for each neighbour and 1 for each diagonal.
static void limit_mask(const limni_rules *rules, const limni_star *star, limni_fixed *weights) {
    const limni_transition forever = limni_star_forever(rules, star);
    const int64_t n = star->count;
    const limni_ring_weights given = {.smooth = limni_fixed_ratio(4, n * (n + 5)),
                                      .crease = limni_fixed_ratio(1, 6),
                                      .face = limni_fixed_ratio(1, n * (n + 5))};
    if (forever.now.rule == LIMNI_VERTEX_DART) {
        fill_dart_limit(star, forever.now.ends[0], weights);
    } else {
        limni_fill_mask(&forever, given, star, LIMN_DOMAIN_QUAD, weights);
    }
}

// ---- Tangents

/// After OpenSubdiv and others, all divided by 4: neighbour j has A cos t(j), t(j) = 2 pi j / n, and
/// diagonal j cos t(j) + cos t(j + 1), where A = 1 + cos(2 pi / n) + cos(pi / n) sqrt(2 (9 + cos(2
/// pi / n))).
static void smooth_tangents(const limni_star *star, uint32_t half_steps, limni_fixed *along,
                            limni_fixed *across) {
    const uint32_t n = star->count;
    const limni_fixed c = limni_fixed_turn(1, n).cosine, half = limni_fixed_turn(1, 2 * n).cosine;
    const limni_wide square = 2 * (9 * (limni_wide)LIMNI_FIXED_ONE + c);
    const limni_fixed root = limni_fixed_root(square << LIMNI_FIXED_BITS);
    const limni_fixed a = (LIMNI_FIXED_ONE + c) / 4 + limni_fixed_multiply(half, root / 4);
    along[0] = across[0] = 0;
    for (uint32_t r = 0; r < n; r++) {
        const uint32_t turned = 2 * (r + n) - half_steps;
        const limni_fixed_unit here = limni_fixed_turn(turned, 2 * n);
        const limni_fixed_unit next = limni_fixed_turn(turned + 2, 2 * n);
        along[1 + r] = limni_fixed_multiply(a, here.cosine);
        across[1 + r] = limni_fixed_multiply(a, here.sine);
        along[1 + n + r] = here.cosine / 4 + next.cosine / 4;
        across[1 + n + r] = here.sine / 4 + next.sine / 4;
    }
}

/// Across a crease, pointing into a sector of k faces, z = pi / k: the left eigenvector that has
/// sin(j z) on neighbour j inside and (sin(j z) + sin((j + 1) z)) / (4 (4 L - 1)) on diagonal j, for
/// the eigenvalue L = (5 + cos z + sqrt((cos z + 9) (cos z + 1))) / 16; the weights of the ends and
/// of the vertex solve the two equations that are left. All times sin z, so that no term is large.
static void spline_tangent(const limni_star *star, limni_sector s, limni_fixed *across) {
    const limni_fixed one = LIMNI_FIXED_ONE;
    const uint32_t faces = s.count - 1;
    limni_fixed *const first = limni_in_sector(star, s, 0, across);
    limni_fixed *const last = limni_in_sector(star, s, faces, across);
    if (faces == 1) { // no neighbours inside: where the crease bends to
        across[0] = -2 * one;
        *first = *last = one;
        return;
    }
    const limni_fixed_unit z = limni_fixed_turn(1, 2 * faces);
    const limni_wide c = z.cosine;
    const limni_fixed root = limni_fixed_root((c + 9 * (limni_wide)one) * (c + one));
    const limni_fixed eigenvalue =
        (limni_fixed)limni_wide_divide(5 * (limni_wide)one + c + root, 16);
    const limni_fixed divisor = 4 * (4 * eigenvalue - one);
    const limni_fixed sum = one + z.cosine; // of the neighbours inside: sin(z) cot(z / 2)
    const limni_fixed diagonal =
        limni_fixed_divide(limni_fixed_multiply(z.sine, z.sine), divisor); // the first, and last
    const limni_fixed from_half = 8 * (eigenvalue - one / 2);
    const limni_fixed beyond = limni_fixed_multiply(8 * eigenvalue, diagonal);
    const limni_fixed rest = limni_fixed_multiply(eigenvalue, limni_fixed_divide(2 * sum, divisor));
    const limni_fixed known =
        sum / 4 + rest + limni_fixed_multiply(beyond, eigenvalue - 3 * (one / 4));
    const limni_fixed end = limni_fixed_divide(
        known, limni_fixed_multiply(from_half, eigenvalue - 3 * (one / 4)) - one);
    across[0] = limni_fixed_multiply(from_half, end) - beyond;
    *first = *last = end;
    limni_fixed before = 0;
    for (uint32_t j = 0; j < faces; j++) {
        const limni_fixed here =
            j + 1 < faces ? limni_fixed_multiply(z.sine, limni_fixed_turn(j + 1, 2 * faces).sine)
                          : 0;
        if (j + 1 < faces) *limni_in_sector(star, s, j + 1, across) = here;
        across[1 + star->count + (s.first + j) % star->count] =
            limni_fixed_divide(before + here, divisor);
        before = here;
    }
}

static void tangent_masks(const limni_rules *rules, const limni_star *star, uint32_t half_steps,
                          limni_fixed *along, limni_fixed *across) {
    const limni_feature feature = limni_star_feature(rules, star);
    if (feature.rule == LIMNI_VERTEX_SMOOTH || feature.rule == LIMNI_VERTEX_DART) {
        smooth_tangents(star, half_steps, along, across);
        return;
    }
    for (uint32_t w = 0; w <= star->count + limni_star_face_count(star); w++)
        along[w] = across[w] = 0;
    const uint32_t first = half_steps / 2;
    if (feature.rule == LIMNI_VERTEX_CORNER) {
        limni_corner_tangents(rules, star, first, along, across);
        return;
    }
    const limni_sector side = limni_crease_side(star, first);
    along[1 + first] = LIMNI_FIXED_ONE;
    *limni_in_sector(star, side, side.count - 1, along) = -LIMNI_FIXED_ONE;
    spline_tangent(star, side, across);
}

static void tangent_terms(limni_masks *masks, uint32_t half_steps, int tangent) {
    limni_fixed *const *const weights = masks->weights;
    tangent_masks(masks->rules, &masks->star, half_steps, weights[0], weights[1]);
    limni_masks_add_star(masks, weights[tangent]);
}

const limni_scheme limni_scheme_catmark = {
    .domain = LIMN_DOMAIN_QUAD,
    .reach = 1,
    .vertex_mask = vertex_mask,
    .limit_mask = limit_mask,
    .edge_terms = edge_terms,
    .tangent_terms = tangent_terms,
};
