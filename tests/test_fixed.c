/* SPDX-License-Identifier: MIT */
/* Fixed point, and the masks of both schemes, against libm and the formulas. */
#include "../baker/masks.h"
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double value(limni_fixed a) {
    return ldexp((double)a, -LIMNI_FIXED_BITS);
}

static void test_rounding(void) {
    const limni_fixed half_unit = LIMNI_FIXED_ONE / 2;
    CHECK_EQUAL(limni_fixed_multiply(3, half_unit), 2); // 1.5 away from zero
    CHECK_EQUAL(limni_fixed_multiply(-3, half_unit), -2);
    CHECK_EQUAL(limni_fixed_multiply(1, half_unit - 1), 0);
    CHECK_EQUAL(limni_fixed_ratio(1, 3), (limni_fixed)(LIMNI_FIXED_ONE / 3));
    CHECK_EQUAL(limni_fixed_ratio(-2, 3), -(limni_fixed)((2 * LIMNI_FIXED_ONE + 1) / 3));
    CHECK(limni_fixed_to_float(LIMNI_FIXED_ONE) == 1.0f);
    CHECK(limni_fixed_to_float(LIMNI_FIXED_ONE + ((limni_fixed)1 << 36)) == 1.0f); // a tie: to even
    CHECK(limni_fixed_to_float(LIMNI_FIXED_ONE + ((limni_fixed)3 << 36)) == 1.0f + 0x1p-22f);
}

static void test_cosine(void) {
    const double two_pi = 6.283185307179586476925;
    CHECK_EQUAL(limni_fixed_turn(1, 4).cosine, 0);
    CHECK_NEAR(value(limni_fixed_turn(1, 2).cosine), -1.0, 4e-18);
    for (uint32_t n = 2; n <= 2000; n++)
        CHECK_NEAR(value(limni_fixed_turn(1, n).cosine), cos(two_pi / n), 4e-16);
    CHECK(llabs(limni_fixed_turn(1, 6).cosine - LIMNI_FIXED_ONE / 2) <= 8); // to 2^-57
    CHECK(llabs(limni_fixed_turn(1, 3).cosine + LIMNI_FIXED_ONE / 2) <= 8);
}

/// Opposite and mirrored angles give the same digits.
static void test_turn(void) {
    const double two_pi = 6.283185307179586476925;
    for (uint32_t n = 1; n <= 64; n++) {
        for (uint32_t j = 0; j < 2 * n; j++) {
            const limni_fixed_unit unit = limni_fixed_turn(j, n);
            CHECK_NEAR(value(unit.cosine), cos(two_pi * j / n), 1e-14);
            CHECK_NEAR(value(unit.sine), sin(two_pi * j / n), 1e-14);
            const limni_fixed_unit mirrored = limni_fixed_turn(2 * n - j, n);
            CHECK(mirrored.cosine == unit.cosine && mirrored.sine == -unit.sine);
            const limni_fixed_unit opposite = limni_fixed_turn(2 * j + n, 2 * n);
            CHECK(opposite.cosine == -unit.cosine && opposite.sine == -unit.sine);
        }
    }
}

static const limni_scheme *const schemes[] = {&limni_scheme_loop, &limni_scheme_catmark};

enum { SCHEME_COUNT = 2, VALENCE_MAX = 500, MASK_MAX = 2 * (VALENCE_MAX + 1) + 1 };

static limni_fixed weights[MASK_MAX];

/// The vertex itself, its neighbours, and in quads the diagonals.
static uint32_t mask_size(const limni_scheme *scheme, const limni_star *star) {
    const uint32_t faces = scheme->domain == LIMN_DOMAIN_QUAD ? limni_star_face_count(star) : 0;
    return 1 + star->count + faces;
}

static limni_edge_mask edge_mask(const limni_scheme *scheme, const limni_edge_feature *feature) {
    return scheme == &limni_scheme_loop ? limni_loop_edge_mask(feature)
                                        : limni_catmark_edge_mask(feature);
}

/// The terms of both tangents, as weights: the star's vertices are numbered as its weights are.
static void tangent_masks(const limni_scheme *scheme, const limni_rules *rules,
                          const limni_star *star, uint32_t half_steps, limni_fixed *along,
                          limni_fixed *across) {
    static uint32_t vertices[MASK_MAX];
    static limni_fixed room[2][MASK_MAX];
    static limni_term terms[MASK_MAX];
    for (uint32_t v = 0; v < MASK_MAX; v++)
        vertices[v] = v;
    limni_masks masks = {
        .rules = rules, .star = *star, .weights = {room[0], room[1]}, .terms = terms};
    masks.star.ring = vertices + 1;
    if (scheme->domain == LIMN_DOMAIN_QUAD) masks.star.diagonals = vertices + 1 + star->count;
    for (int tangent = 0; tangent < 2; tangent++) {
        limni_fixed *const mask = tangent == 0 ? along : across;
        memset(mask, 0, mask_size(scheme, star) * sizeof *mask);
        masks.term_count = 0;
        scheme->tangent_terms(&masks, half_steps, tangent);
        for (uint32_t t = 0; t < masks.term_count; t++)
            mask[terms[t].control] += terms[t].weight;
    }
}

static void check_sums_to_one(const limni_scheme *scheme, const limni_star *star) {
    limni_fixed sum = 0;
    for (uint32_t w = 0; w < mask_size(scheme, star); w++)
        sum += weights[w];
    CHECK_EQUAL(sum, LIMNI_FIXED_ONE);
}

/// Loop's b(n), Warren's b(n), and the limit 3n / 8b against n neighbours.
static void test_loop_masks(void) {
    for (uint32_t n = 2; n <= VALENCE_MAX; n++) {
        const limni_star star = {.closed = true, .count = n};
        const double root = 3 + 2 * cos(6.283185307179586476925 / n);
        const double b[2] = {(40 - root * root) / 64, n == 3 ? 9.0 / 16 : 3.0 / 8};
        for (int choice = 0; choice < 2; choice++) {
            const limni_rules rules = {.weights = (limn_weights)choice};
            limni_scheme_loop.vertex_mask(&rules, &star, weights);
            CHECK_NEAR(value(weights[0]), 1 - b[choice], 1e-15);
            CHECK_NEAR(value(weights[n]), b[choice] / n, 1e-15);
            check_sums_to_one(&limni_scheme_loop, &star);
            const double centre = 3 * n / (8 * b[choice]);
            limni_scheme_loop.limit_mask(&rules, &star, weights);
            CHECK_NEAR(value(weights[0]), centre / (centre + n), 1e-15);
            CHECK_NEAR(value(weights[1]), 1 / (centre + n), 1e-15);
            check_sums_to_one(&limni_scheme_loop, &star);
        }
    }
}

/// Catmull and Clark's 1 - 2/n, 1/n^2 of each neighbour and of each face's middle; and the limit
/// n^2, 4 and 1.
static void test_catmark_masks(void) {
    const limni_rules rules = {0};
    for (uint32_t n = 2; n <= VALENCE_MAX; n++) {
        const limni_star star = {.closed = true, .count = n};
        limni_scheme_catmark.vertex_mask(&rules, &star, weights);
        CHECK_NEAR(value(weights[0]), 1 - 2.0 / n, 2e-15); // what the others leave
        CHECK_NEAR(value(weights[1]), 1.0 / n / n, 1e-17);
        CHECK_NEAR(value(weights[2 * n]), 1.0 / n / n, 1e-17);
        CHECK_EQUAL(weights[2 * n] % 4, 0); // each corner of a quad gets a quarter exactly
        check_sums_to_one(&limni_scheme_catmark, &star);
        limni_scheme_catmark.limit_mask(&rules, &star, weights);
        CHECK_NEAR(value(weights[0]), n / (n + 5.0), 1e-15);
        CHECK_NEAR(value(weights[1]), 4 / (n * (n + 5.0)), 1e-17);
        CHECK_NEAR(value(weights[2 * n]), 1 / (n * (n + 5.0)), 1e-17);
        check_sums_to_one(&limni_scheme_catmark, &star);
    }
    const limni_edge_mask smooth = limni_catmark_edge_mask(&(limni_edge_feature){0});
    CHECK(value(smooth.ends[0]) == 0.25 && value(smooth.ends[1]) == 0.25);
    CHECK(value(smooth.beside) == 0.25);
}

static void test_boundary_masks(const limni_scheme *scheme) {
    const limni_rules rules = {0};
    limni_star star = {.count = 4};
    CHECK_EQUAL(limni_star_feature(&rules, &star).rule, LIMNI_VERTEX_CREASE);
    scheme->vertex_mask(&rules, &star, weights);
    CHECK(value(weights[0]) == 0.75 && value(weights[1]) == 0.125 && value(weights[4]) == 0.125);
    CHECK(weights[2] == 0 && weights[3] == 0);
    check_sums_to_one(scheme, &star);
    scheme->limit_mask(&rules, &star, weights);
    CHECK_NEAR(value(weights[0]), 2.0 / 3, 1e-17);
    CHECK_NEAR(value(weights[4]), 1.0 / 6, 1e-17);
    check_sums_to_one(scheme, &star);
    const limni_edge_mask edge =
        edge_mask(scheme, &(limni_edge_feature){.weight = LIMNI_FIXED_ONE, .ends = {4, 4}});
    CHECK(value(edge.ends[0]) == 0.5 && value(edge.ends[1]) == 0.5 && edge.beside == 0);

    star = (limni_star){.count = 2, .sharpness = LIMNI_SHARPNESS_INFINITE};
    CHECK_EQUAL(limni_star_feature(&rules, &star).rule, LIMNI_VERTEX_CORNER);
    scheme->limit_mask(&rules, &star, weights);
    CHECK(weights[0] == LIMNI_FIXED_ONE && weights[1] == 0 && weights[2] == 0);
}

// ---- A step, as a matrix

/// What the face to the left of ring vertex `face` has: of triangles, `opposite` an edge; of quads,
/// its middle.
static void add_face(const limni_scheme *scheme, const limni_star *star, uint32_t face,
                     uint32_t opposite, double weight, double *stepped) {
    if (scheme->domain != LIMN_DOMAIN_QUAD) {
        stepped[1 + opposite] += weight;
        return;
    }
    stepped[0] += weight / 4;
    stepped[1 + face] += weight / 4;
    stepped[1 + limni_star_left(star, face)] += weight / 4;
    stepped[1 + star->count + face] += weight / 4;
}

/// Applies a mask after one subdivision step: the same in terms of the vertices before it.
static void step(const limni_scheme *scheme, const limni_rules *rules, const limni_star *star,
                 const limni_fixed *mask, double *stepped) {
    static limni_fixed vertex[MASK_MAX];
    const uint32_t n = star->count;
    scheme->vertex_mask(rules, star, vertex);
    for (uint32_t w = 0; w < mask_size(scheme, star); w++)
        stepped[w] = w <= n ? value(mask[0]) * value(vertex[w]) : 0;
    for (uint32_t w = 1 + n; w < mask_size(scheme, star); w++) // diagonals become middles of faces
        add_face(scheme, star, w - 1 - n, 0, value(mask[0]) * value(vertex[w]) + value(mask[w]),
                 stepped);
    for (uint32_t r = 0; r < n; r++) { // the new vertex between the vertex and ring vertex r
        const limni_edge_feature feature = limni_star_edge_feature(rules, star, r);
        const limni_edge_mask edge = edge_mask(scheme, &feature);
        const uint32_t left = limni_star_left(star, r), right = limni_star_right(star, r);
        const double weight = value(mask[1 + r]), beside = weight * value(edge.beside);
        stepped[0] += weight * value(edge.ends[0]);
        stepped[1 + r] += weight * value(edge.ends[1]);
        if (limni_star_has_left(star, r)) add_face(scheme, star, r, left, beside, stepped);
        if (limni_star_has_right(star, r)) add_face(scheme, star, right, right, beside, stepped);
    }
}

/// A tangent mask that is a left eigenvector of the subdivision matrix gives the same direction at
/// every level: applied after one step, it is the mask before it times the eigenvalue.
static void check_is_eigenvector(const limni_scheme *scheme, const limni_rules *rules,
                                 const limni_star *star, const limni_fixed *mask) {
    static double stepped[MASK_MAX];
    const uint32_t size = mask_size(scheme, star);
    step(scheme, rules, star, mask, stepped);
    double longest = 0, eigenvalue = 0;
    limni_wide sum = 0;
    for (uint32_t w = 0; w < size; w++) {
        sum += mask[w];
        if (fabs(value(mask[w])) <= longest) continue;
        longest = fabs(value(mask[w]));
        eigenvalue = stepped[w] / value(mask[w]);
    }
    CHECK(longest > 1e-6 && eigenvalue > 0.2 && eigenvalue < 0.7);
    const double rounding = 1e-13 + 1e-15 * size; // of a sum of all weights
    CHECK_NEAR(value((limni_fixed)sum), 0, rounding);
    for (uint32_t w = 0; w < size; w++)
        CHECK_NEAR(stepped[w], eigenvalue * value(mask[w]), w == 0 ? rounding : 1e-13);
}

/// Both tangents of a star, or of the side of a crease that starts at `half_steps`.
static void check_tangents(const limni_scheme *scheme, const limni_rules *rules,
                           const limni_star *star, uint32_t half_steps) {
    static limni_fixed along[MASK_MAX], across[MASK_MAX];
    tangent_masks(scheme, rules, star, half_steps, along, across);
    check_is_eigenvector(scheme, rules, star, along);
    check_is_eigenvector(scheme, rules, star, across);
}

/// The limit is the same before and after a step.
static void check_limit(const limni_scheme *scheme, const limni_rules *rules,
                        const limni_star *star) {
    static double stepped[MASK_MAX];
    scheme->limit_mask(rules, star, weights);
    check_sums_to_one(scheme, star);
    step(scheme, rules, star, weights, stepped);
    for (uint32_t w = 0; w < mask_size(scheme, star); w++)
        CHECK_NEAR(stepped[w], value(weights[w]), 1e-13);
}

enum { SHARP = LIMNI_SHARPNESS_INFINITE, LEVEL = 1 << LIMNI_SHARPNESS_BITS };

/// At a dart, whose tangents are the smooth ones, the edge of the crease moves along it alone.
static void check_dart(const limni_scheme *scheme, const limni_rules *rules, const limni_star *star,
                       uint32_t crease) {
    static limni_fixed along[MASK_MAX], across[MASK_MAX];
    tangent_masks(scheme, rules, star, 2 * crease, along, across);
    check_is_eigenvector(scheme, rules, star, across);
}

/// With up to three edges that stay sharp, wherever they are; and the tangents on both sides of
/// two.
static void test_sharp_edges(const limni_scheme *scheme) {
    static limni_sharpness edges[VALENCE_MAX];
    static uint32_t beyond[VALENCE_MAX];
    const limni_rules rules = {0};
    for (uint32_t n = 3; n <= VALENCE_MAX; n += 1 + n / 8) {
        limni_star star = {.closed = true, .count = n, .edges = edges, .beyond = beyond};
        static const limni_vertex_rule by_count[] = {LIMNI_VERTEX_SMOOTH, LIMNI_VERTEX_DART,
                                                     LIMNI_VERTEX_CREASE, LIMNI_VERTEX_CORNER};
        for (uint32_t sharp = 0; sharp <= 3; sharp++) {
            CHECK_EQUAL(limni_star_feature(&rules, &star).rule, by_count[sharp]);
            check_limit(scheme, &rules, &star);
            if (sharp == 1) check_dart(scheme, &rules, &star, n / 3 - 1);
            for (uint32_t side = 1; sharp == 2 && side <= 2; side++)
                check_tangents(scheme, &rules, &star, 2 * (side * n / 3 - 1));
            if (sharp < 3) edges[(sharp + 1) * n / 3 - 1] = SHARP;
        }
        for (uint32_t r = 0; r < n; r++)
            edges[r] = 0;
    }
}

/// Side by side, the tangents on both sides of a crease are those of two boundaries.
static void test_crease_tangents(const limni_scheme *scheme) {
    limni_sharpness edges[9] = {[2] = SHARP, [6] = SHARP};
    uint32_t beyond[9] = {0};
    const limni_rules rules = {0};
    const limni_star star = {.closed = true, .count = 9, .edges = edges, .beyond = beyond};
    static const uint32_t starts[2] = {2, 6}, counts[2] = {5, 6};
    for (int side = 0; side < 2; side++) {
        limni_fixed along[2][19], across[2][19];
        const limni_star boundary = {.count = counts[side]};
        tangent_masks(scheme, &rules, &star, 2 * starts[side], along[0], across[0]);
        tangent_masks(scheme, &rules, &boundary, 0, along[1], across[1]);
        CHECK_EQUAL(across[0][0], across[1][0]);
        for (uint32_t w = 1; w < mask_size(scheme, &boundary); w++) {
            const bool diagonal = w > counts[side];
            const uint32_t r = diagonal ? w - 1 - counts[side] : w - 1;
            const uint32_t place = (diagonal ? 10 : 1) + (starts[side] + r) % 9;
            CHECK_EQUAL(along[0][place], along[1][w]);
            CHECK_EQUAL(across[0][place], across[1][w]);
        }
    }
}

/// What ends on a level has a say by its sharpness.
static void test_transitions(void) {
    limni_sharpness edges[6] = {0};
    uint32_t beyond[6] = {0};
    const limni_rules rules = {.creasing = LIMN_CREASING_UNIFORM};
    const limni_rules chaikin = {.creasing = LIMN_CREASING_CHAIKIN};
    limni_star star = {.closed = true, .count = 6, .edges = edges, .beyond = beyond};
    edges[0] = edges[3] = LEVEL / 4;
    limni_transition t = limni_star_transition(&rules, &star);
    CHECK(t.now.rule == LIMNI_VERTEX_CREASE && t.next.rule == LIMNI_VERTEX_SMOOTH);
    CHECK(value(t.weight) == 0.25);
    CHECK(value(limni_star_edge_feature(&rules, &star, 3).weight) == 0.25);
    limni_scheme_loop.vertex_mask(&rules, &star, weights);
    CHECK_NEAR(value(weights[1]), 0.25 / 8 + 0.75 / 16, 1e-17);
    CHECK_NEAR(value(weights[2]), 0.75 / 16, 1e-17);
    check_sums_to_one(&limni_scheme_loop, &star);
    limni_scheme_catmark.vertex_mask(&rules, &star, weights);
    CHECK_NEAR(value(weights[1]), 0.25 / 8 + 0.75 / 36, 1e-17);
    CHECK_NEAR(value(weights[2]), 0.75 / 36, 1e-17);
    CHECK_NEAR(value(weights[12]), 0.75 / 36, 1e-17);
    check_sums_to_one(&limni_scheme_catmark, &star);
    const limni_edge_feature quarter = limni_star_edge_feature(&rules, &star, 3);
    const limni_edge_mask edge = limni_catmark_edge_mask(&quarter);
    CHECK(value(edge.ends[0]) == 5 / 16. && value(edge.beside) == 3 / 16.);

    // A third edge and the vertex end, a crease stays.
    edges[0] = SHARP;
    edges[3] = 3 * LEVEL;
    edges[4] = LEVEL / 2;
    star.sharpness = LEVEL;
    t = limni_star_transition(&rules, &star);
    CHECK(t.now.rule == LIMNI_VERTEX_CORNER && t.next.rule == LIMNI_VERTEX_CREASE);
    CHECK(t.next.ends[0] == 0 && t.next.ends[1] == 3 && value(t.weight) == 0.75);

    // Chaikin's method takes from 3 and gives to 1/2.
    CHECK_EQUAL(limni_star_next_edge(&chaikin, &star, 3), 11 * LEVEL / 8);
    CHECK_EQUAL(limni_star_next_edge(&chaikin, &star, 4), LEVEL / 8);
    CHECK_EQUAL(limni_star_next_edge(&chaikin, &star, 0), SHARP);
    CHECK_EQUAL(limni_sharpness_next(limni_sharpness_from_float(9.99999905f)), 9 * LEVEL - 16);
    CHECK_EQUAL(limni_sharpness_from_float(1e30f), SHARP);
}

static void test_tangent_masks(const limni_scheme *scheme) {
    const limni_rules rules = {0};
    for (uint32_t n = 2; n <= VALENCE_MAX; n++) {
        const limni_star boundary = {.count = n}, inside = {.closed = true, .count = n};
        check_tangents(scheme, &rules, &boundary, 0);
        check_limit(scheme, &rules, &boundary);
        if (n == 2) continue; // two faces back to back have no tangent plane
        check_tangents(scheme, &rules, &inside, 0);
    }
}

/// Lomont's masks hold where the neighbours along a crease are regular, as one with three faces on
/// a boundary is.
static uint32_t lomont_regular(const limni_rules *rules) {
    limni_sharpness edges[4] = {SHARP, 0, 0, SHARP};
    uint32_t beyond[4] = {0}, seen;
    const limni_star regular = {.count = 4, .edges = edges, .beyond = beyond};
    limni_star_see(rules, &regular, 0, 1, &seen);
    return seen;
}

/// His masks on boundaries and beside a crease of n - 1 faces on one side and two on the other.
static void test_lomont_masks(void) {
    const limni_scheme *const scheme = &limni_scheme_loop;
    static limni_sharpness edges[VALENCE_MAX + 1];
    static uint32_t beyond[VALENCE_MAX + 1];
    const limni_rules rules = {.creases = LIMN_CREASES_LOMONT, .creasing = LIMN_CREASING_UNIFORM};
    for (uint32_t n = 2; n <= VALENCE_MAX; n++) {
        edges[0] = edges[n - 1] = SHARP;
        beyond[0] = beyond[n - 1] = lomont_regular(&rules);
        for (int closed = 0; closed <= (n > 2); closed++) {
            const limni_star star = {
                .closed = closed, .count = n + (uint32_t)closed, .edges = edges, .beyond = beyond};
            CHECK(limni_star_is_settled(&rules, &star));
            check_limit(scheme, &rules, &star);
            CHECK_NEAR(value(weights[1]), !closed && n == 4 ? 1.0 / 6 : 1.0 / 5, 1e-17);
            for (uint32_t side = 0; side <= (uint32_t)closed; side++)
                check_tangents(scheme, &rules, &star, 2 * side * (n - 1));
        }
        edges[n - 1] = beyond[n - 1] = 0;
    }
}

/// Table 2, and fractions of it. The vertex is regular.
static void test_lomont_edges(void) {
    limni_sharpness edges[6] = {[0] = LEVEL, [3] = SHARP};
    uint32_t beyond[6] = {0};
    const limni_rules rules = {.creases = LIMN_CREASES_LOMONT, .creasing = LIMN_CREASING_UNIFORM};
    limni_star star = {.closed = true, .count = 6, .edges = edges, .beyond = beyond};
    static const struct {
        limni_sharpness far_edges[6];
        limni_sharpness far_vertex;
        double ends[2], opposite;
    } cases[] = {
        {{LEVEL, 0, 0, LEVEL}, 0, {1 / 2., 1 / 2.}, 0},         // regular
        {{LEVEL, 0, LEVEL}, 0, {5 / 8., 3 / 8.}, 0},            // non-regular
        {{LEVEL, LEVEL - 1, 0, LEVEL}, 0, {1 / 2., 1 / 2.}, 0}, // regular, as fractions are smooth
        {{LEVEL, 0, 0, LEVEL}, LEVEL - 1, {1 / 2., 1 / 2.}, 0}, // likewise
        {{LEVEL, 0, 0, LEVEL}, LEVEL, {5 / 8., 3 / 8.}, 0},     // corner
        {{LEVEL, LEVEL, 0, LEVEL}, 0, {5 / 8., 3 / 8.}, 0},     // corner
        {{LEVEL}, 0, {3 / 8., 3 / 8.}, 1 / 8.},                 // dart
        {{LEVEL / 2, 0, 0, LEVEL}, 0, {7 / 16., 7 / 16.}, 1 / 16.}, // half of a regular one
        {{LEVEL / 2, 0, 1}, 0, {1 / 2., 3 / 8.}, 1 / 16.},          // half of a non-regular one
        {{LEVEL / 2}, 0, {3 / 8., 3 / 8.}, 1 / 8.},                 // half of a dart
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        limni_sharpness far_edges[6];
        memcpy(far_edges, cases[c].far_edges, sizeof far_edges);
        const limni_star far_end = {.closed = true,
                                    .count = 6,
                                    .edges = far_edges,
                                    .beyond = beyond,
                                    .sharpness = cases[c].far_vertex};
        limni_star_see(&rules, &far_end, 0, 1, &beyond[0]);
        edges[0] = far_edges[0];
        const limni_edge_feature feature = limni_star_edge_feature(&rules, &star, 0);
        const limni_edge_mask mask = limni_loop_edge_mask(&feature);
        CHECK_NEAR(value(mask.ends[0]), cases[c].ends[0], 1e-17);
        CHECK_NEAR(value(mask.ends[1]), cases[c].ends[1], 1e-17);
        CHECK_NEAR(value(mask.beside), cases[c].opposite, 1e-17);
    }
}

/// From the opposite vertex of a regular ring, both tangents are negated exactly.
static void test_tangents_turn(const limni_scheme *scheme) {
    limni_fixed along[2][9], across[2][9];
    const limni_rules rules = {0};
    const uint32_t n = scheme->domain == LIMN_DOMAIN_QUAD ? 4 : 6;
    const limni_star star = {.closed = true, .count = n};
    for (uint32_t start = 0; start <= 2; start++) {
        tangent_masks(scheme, &rules, &star, start, along[0], across[0]);
        tangent_masks(scheme, &rules, &star, start + n, along[1], across[1]);
        for (uint32_t w = 0; w < mask_size(scheme, &star); w++)
            CHECK(along[0][w] == -along[1][w] && across[0][w] == -across[1][w]);
    }
    CHECK_NEAR(value(along[0][1 + 1]), 1, 1e-17);
    CHECK_EQUAL(across[0][1 + 1], 0);
}

int main(void) {
    test_rounding();
    test_cosine();
    test_turn();
    test_loop_masks();
    test_catmark_masks();
    for (int s = 0; s < SCHEME_COUNT; s++) {
        test_boundary_masks(schemes[s]);
        test_tangent_masks(schemes[s]);
        test_tangents_turn(schemes[s]);
        test_sharp_edges(schemes[s]);
        test_crease_tangents(schemes[s]);
    }
    test_transitions();
    test_lomont_masks();
    test_lomont_edges();
    return check_report();
}
