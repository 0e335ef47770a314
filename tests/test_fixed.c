/* SPDX-License-Identifier: MIT */
/* Fixed point and Loop's masks against libm and the formulas. */
#include "../baker/scheme.h"
#include "check.h"

#include <math.h>
#include <stdlib.h>

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

static limni_fixed weights[600];

static void check_sums_to_one(uint32_t count) {
    limni_fixed sum = 0;
    for (uint32_t w = 0; w <= count; w++)
        sum += weights[w];
    CHECK_EQUAL(sum, LIMNI_FIXED_ONE);
}

/// Loop's b(n), Warren's b(n), and the limit 3n / 8b against n neighbours.
static void test_smooth_masks(void) {
    for (uint32_t n = 2; n <= 500; n++) {
        const limni_star star = {.closed = true, .count = n};
        const double root = 3 + 2 * cos(6.283185307179586476925 / n);
        const double b[2] = {(40 - root * root) / 64, n == 3 ? 9.0 / 16 : 3.0 / 8};
        for (int choice = 0; choice < 2; choice++) {
            const limni_rules rules = {.weights = (limn_weights)choice};
            limni_scheme_loop.vertex_mask(&rules, &star, weights);
            CHECK_NEAR(value(weights[0]), 1 - b[choice], 1e-15);
            CHECK_NEAR(value(weights[n]), b[choice] / n, 1e-15);
            check_sums_to_one(n);
            const double centre = 3 * n / (8 * b[choice]);
            limni_scheme_loop.limit_mask(&rules, &star, weights);
            CHECK_NEAR(value(weights[0]), centre / (centre + n), 1e-15);
            CHECK_NEAR(value(weights[1]), 1 / (centre + n), 1e-15);
            check_sums_to_one(n);
        }
    }
}

static void test_boundary_masks(void) {
    const limni_rules rules = {0};
    limni_star star = {.count = 4};
    CHECK_EQUAL(limni_star_feature(&rules, &star).rule, LIMNI_VERTEX_CREASE);
    limni_scheme_loop.vertex_mask(&rules, &star, weights);
    CHECK(value(weights[0]) == 0.75 && value(weights[1]) == 0.125 && value(weights[4]) == 0.125);
    CHECK(weights[2] == 0 && weights[3] == 0);
    limni_scheme_loop.limit_mask(&rules, &star, weights);
    CHECK_NEAR(value(weights[0]), 2.0 / 3, 1e-17);
    CHECK_NEAR(value(weights[4]), 1.0 / 6, 1e-17);
    check_sums_to_one(4);

    star = (limni_star){.count = 2, .sharpness = LIMNI_SHARPNESS_INFINITE};
    CHECK_EQUAL(limni_star_feature(&rules, &star).rule, LIMNI_VERTEX_CORNER);
    limni_scheme_loop.limit_mask(&rules, &star, weights);
    CHECK(weights[0] == LIMNI_FIXED_ONE && weights[1] == 0 && weights[2] == 0);
}

/// Applies a mask after one subdivision step: the same in terms of the vertices before it.
static void step(const limni_rules *rules, const limni_star *star, const limni_fixed *mask,
                 double *stepped) {
    static limni_fixed vertex[600];
    const uint32_t n = star->count;
    limni_scheme_loop.vertex_mask(rules, star, vertex);
    for (uint32_t w = 0; w <= n; w++)
        stepped[w] = value(mask[0]) * value(vertex[w]);
    for (uint32_t r = 0; r < n; r++) { // the new vertex between the vertex and ring vertex r
        const limni_edge_feature feature = limni_star_edge_feature(rules, star, r);
        const limni_edge_mask edge = limni_scheme_loop.edge_mask(&feature);
        const double weight = value(mask[1 + r]);
        stepped[0] += weight * value(edge.ends[0]);
        stepped[1 + r] += weight * value(edge.ends[1]);
        stepped[1 + (r + 1) % n] += weight * value(edge.beside);
        stepped[1 + (r + n - 1) % n] += weight * value(edge.beside);
    }
}

/// A tangent mask that is a left eigenvector of the subdivision matrix gives the same direction at
/// every level: applied after one step, it is the mask before it times the eigenvalue.
static void check_is_eigenvector(const limni_rules *rules, const limni_star *star,
                                 const limni_fixed *mask) {
    static double stepped[600];
    const uint32_t n = star->count;
    step(rules, star, mask, stepped);
    double longest = 0, eigenvalue = 0;
    for (uint32_t w = 0; w <= n; w++) {
        if (fabs(value(mask[w])) <= longest) continue;
        longest = fabs(value(mask[w]));
        eigenvalue = stepped[w] / value(mask[w]);
    }
    CHECK(longest > 1e-6 && eigenvalue > 0.2 && eigenvalue < 0.7);
    for (uint32_t w = 0; w <= n; w++)
        CHECK_NEAR(stepped[w], eigenvalue * value(mask[w]), 1e-13);
}

/// The limit is the same before and after a step.
static void check_limit(const limni_rules *rules, const limni_star *star) {
    static double stepped[600];
    limni_scheme_loop.limit_mask(rules, star, weights);
    check_sums_to_one(star->count);
    step(rules, star, weights, stepped);
    for (uint32_t w = 0; w <= star->count; w++)
        CHECK_NEAR(stepped[w], value(weights[w]), 1e-13);
}

enum { SHARP = LIMNI_SHARPNESS_INFINITE, LEVEL = 1 << LIMNI_SHARPNESS_BITS };

/// With up to three edges that stay sharp, wherever they are.
static void test_limits(void) {
    static limni_sharpness edges[500];
    static uint32_t beyond[500];
    const limni_rules rules = {0};
    for (uint32_t n = 3; n <= 500; n += 1 + n / 8) {
        limni_star star = {.closed = true, .count = n, .edges = edges, .beyond = beyond};
        static const limni_vertex_rule by_count[] = {LIMNI_VERTEX_SMOOTH, LIMNI_VERTEX_DART,
                                                     LIMNI_VERTEX_CREASE, LIMNI_VERTEX_CORNER};
        for (uint32_t sharp = 0; sharp <= 3; sharp++) {
            CHECK_EQUAL(limni_star_feature(&rules, &star).rule, by_count[sharp]);
            check_limit(&rules, &star);
            if (sharp < 3) edges[(sharp + 1) * n / 3 - 1] = SHARP;
        }
        for (uint32_t r = 0; r < n; r++)
            edges[r] = 0;
    }
}

/// Side by side, the tangents on both sides of a crease are those of two boundaries.
static void test_crease_tangents(void) {
    limni_sharpness edges[9] = {[2] = SHARP, [6] = SHARP};
    uint32_t beyond[9] = {0};
    const limni_rules rules = {0};
    const limni_star star = {.closed = true, .count = 9, .edges = edges, .beyond = beyond};
    static const uint32_t starts[2] = {2, 6}, counts[2] = {5, 6};
    for (int side = 0; side < 2; side++) {
        limni_fixed along[2][10], across[2][10];
        const limni_star boundary = {.count = counts[side]};
        limni_scheme_loop.tangent_masks(&rules, &star, 2 * starts[side], along[0], across[0]);
        limni_scheme_loop.tangent_masks(&rules, &boundary, 0, along[1], across[1]);
        CHECK_EQUAL(across[0][0], across[1][0]);
        for (uint32_t r = 0; r < counts[side]; r++) {
            const uint32_t place = 1 + (starts[side] + r) % 9;
            CHECK_EQUAL(along[0][place], along[1][1 + r]);
            CHECK_EQUAL(across[0][place], across[1][1 + r]);
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
    check_sums_to_one(6);

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

static void test_tangent_masks(void) {
    static limni_fixed along[600], across[600];
    const limni_rules rules = {0};
    for (uint32_t n = 2; n <= 500; n++) {
        const limni_star boundary = {.count = n};
        limni_scheme_loop.tangent_masks(&rules, &boundary, 0, along, across);
        check_is_eigenvector(&rules, &boundary, along);
        check_is_eigenvector(&rules, &boundary, across);
        if (n == 2) continue; // two faces back to back have no tangent plane
        const limni_star inside = {.closed = true, .count = n};
        limni_scheme_loop.tangent_masks(&rules, &inside, 0, along, across);
        check_is_eigenvector(&rules, &inside, along);
        check_is_eigenvector(&rules, &inside, across);
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
    static limni_fixed along[600], across[600];
    static limni_sharpness edges[600];
    static uint32_t beyond[600];
    const limni_rules rules = {.creases = LIMN_CREASES_LOMONT, .creasing = LIMN_CREASING_UNIFORM};
    for (uint32_t n = 2; n <= 500; n++) {
        edges[0] = edges[n - 1] = SHARP;
        beyond[0] = beyond[n - 1] = lomont_regular(&rules);
        for (int closed = 0; closed <= (n > 2); closed++) {
            const limni_star star = {
                .closed = closed, .count = n + (uint32_t)closed, .edges = edges, .beyond = beyond};
            CHECK(limni_star_is_settled(&rules, &star));
            check_limit(&rules, &star);
            CHECK_NEAR(value(weights[1]), !closed && n == 4 ? 1.0 / 6 : 1.0 / 5, 1e-17);
            for (uint32_t side = 0; side <= (uint32_t)closed; side++) {
                limni_scheme_loop.tangent_masks(&rules, &star, 2 * side * (n - 1), along, across);
                check_is_eigenvector(&rules, &star, along);
                check_is_eigenvector(&rules, &star, across);
            }
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
        const limni_edge_mask mask = limni_scheme_loop.edge_mask(&feature);
        CHECK_NEAR(value(mask.ends[0]), cases[c].ends[0], 1e-17);
        CHECK_NEAR(value(mask.ends[1]), cases[c].ends[1], 1e-17);
        CHECK_NEAR(value(mask.beside), cases[c].opposite, 1e-17);
    }
}

/// From the opposite vertex of a ring of six, both tangents are negated exactly.
static void test_tangents_turn(void) {
    limni_fixed along[2][7], across[2][7];
    const limni_rules rules = {0};
    const limni_star star = {.closed = true, .count = 6};
    limni_scheme_loop.tangent_masks(&rules, &star, 2, along[0], across[0]);
    limni_scheme_loop.tangent_masks(&rules, &star, 8, along[1], across[1]);
    for (int w = 0; w < 7; w++)
        CHECK(along[0][w] == -along[1][w] && across[0][w] == -across[1][w]);
    CHECK(along[0][1 + 1] == LIMNI_FIXED_ONE && across[0][1 + 1] == 0);
}

int main(void) {
    test_rounding();
    test_cosine();
    test_turn();
    test_smooth_masks();
    test_boundary_masks();
    test_tangent_masks();
    test_tangents_turn();
    test_limits();
    test_crease_tangents();
    test_transitions();
    test_lomont_masks();
    test_lomont_edges();
    return check_report();
}
