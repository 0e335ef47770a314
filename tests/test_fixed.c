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
        const limni_star star = {.rule = LIMNI_VERTEX_SMOOTH, .closed = true, .count = n};
        const double root = 3 + 2 * cos(6.283185307179586476925 / n);
        const double b[2] = {(40 - root * root) / 64, n == 3 ? 9.0 / 16 : 3.0 / 8};
        for (int choice = 0; choice < 2; choice++) {
            const limni_rules rules = {.weights = (limn_weights)choice};
            limni_loop_vertex_mask(&rules, &star, weights);
            CHECK_NEAR(value(weights[0]), 1 - b[choice], 1e-15);
            CHECK_NEAR(value(weights[n]), b[choice] / n, 1e-15);
            check_sums_to_one(n);
            const double centre = 3 * n / (8 * b[choice]);
            limni_loop_limit_mask(&rules, &star, weights);
            CHECK_NEAR(value(weights[0]), centre / (centre + n), 1e-15);
            CHECK_NEAR(value(weights[1]), 1 / (centre + n), 1e-15);
            check_sums_to_one(n);
        }
    }
}

static void test_boundary_masks(void) {
    const limni_rules rules = {.boundary = LIMN_BOUNDARY_EDGE_AND_CORNER};
    limni_star star = {.rule = limni_loop_rule(&rules, false, 4), .count = 4};
    CHECK_EQUAL(star.rule, LIMNI_VERTEX_CREASE);
    limni_loop_vertex_mask(&rules, &star, weights);
    CHECK(value(weights[0]) == 0.75 && value(weights[1]) == 0.125 && value(weights[4]) == 0.125);
    CHECK(weights[2] == 0 && weights[3] == 0);
    limni_loop_limit_mask(&rules, &star, weights);
    CHECK_NEAR(value(weights[0]), 2.0 / 3, 1e-17);
    CHECK_NEAR(value(weights[4]), 1.0 / 6, 1e-17);
    check_sums_to_one(4);

    star = (limni_star){.rule = limni_loop_rule(&rules, false, 2), .count = 2};
    CHECK_EQUAL(star.rule, LIMNI_VERTEX_CORNER);
    limni_loop_limit_mask(&rules, &star, weights);
    CHECK(weights[0] == LIMNI_FIXED_ONE && weights[1] == 0 && weights[2] == 0);
    const limni_rules rounded = {.boundary = LIMN_BOUNDARY_EDGE_ONLY};
    CHECK_EQUAL(limni_loop_rule(&rounded, false, 2), LIMNI_VERTEX_CREASE);
    CHECK_EQUAL(limni_loop_rule(&rounded, true, 2), LIMNI_VERTEX_SMOOTH);
}

/// A tangent mask that is a left eigenvector of the subdivision matrix gives the same direction at
/// every level: applied after one step, it is the mask before it times the eigenvalue.
static void check_is_eigenvector(const limni_rules *rules, const limni_star *star,
                                 const limni_fixed *mask) {
    static limni_fixed vertex[600];
    static double stepped[600];
    const uint32_t n = star->count;
    for (uint32_t w = 0; w <= n; w++)
        stepped[w] = 0;
    limni_loop_vertex_mask(rules, star, vertex);
    for (uint32_t w = 0; w <= n; w++)
        stepped[w] += value(mask[0]) * value(vertex[w]);
    for (uint32_t r = 0; r < n; r++) { // the new vertex between the vertex and ring vertex r
        const bool boundary = !star->closed && (r == 0 || r == n - 1);
        const limni_edge_mask edge = limni_loop_edge_mask(boundary);
        const double weight = value(mask[1 + r]);
        stepped[0] += weight * value(edge.end);
        stepped[1 + r] += weight * value(edge.end);
        stepped[1 + (r + 1) % n] += weight * value(edge.opposite);
        stepped[1 + (r + n - 1) % n] += weight * value(edge.opposite);
    }
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

static void test_tangent_masks(void) {
    static limni_fixed along[600], across[600];
    const limni_rules rules = {0};
    for (uint32_t n = 2; n <= 500; n++) {
        const limni_star boundary = {.rule = LIMNI_VERTEX_CREASE, .count = n};
        limni_loop_tangent_masks(&boundary, 0, along, across);
        check_is_eigenvector(&rules, &boundary, along);
        check_is_eigenvector(&rules, &boundary, across);
        if (n == 2) continue; // two faces back to back have no tangent plane
        const limni_star inside = {.rule = LIMNI_VERTEX_SMOOTH, .closed = true, .count = n};
        limni_loop_tangent_masks(&inside, 0, along, across);
        check_is_eigenvector(&rules, &inside, along);
        check_is_eigenvector(&rules, &inside, across);
    }
}

/// From the opposite vertex of a ring of six, both tangents are negated exactly.
static void test_tangents_turn(void) {
    limni_fixed along[2][7], across[2][7];
    const limni_star star = {.rule = LIMNI_VERTEX_SMOOTH, .closed = true, .count = 6};
    limni_loop_tangent_masks(&star, 2, along[0], across[0]);
    limni_loop_tangent_masks(&star, 8, along[1], across[1]);
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
    return check_report();
}
