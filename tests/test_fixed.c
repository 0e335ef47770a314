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
    CHECK_EQUAL(limni_fixed_cosine(4), 0);
    CHECK_NEAR(value(limni_fixed_cosine(2)), -1.0, 4e-18);
    for (uint32_t n = 2; n <= 2000; n++)
        CHECK_NEAR(value(limni_fixed_cosine(n)), cos(two_pi / n), 4e-16);
    CHECK(llabs(limni_fixed_cosine(6) - LIMNI_FIXED_ONE / 2) <= 8); // to 2^-57
    CHECK(llabs(limni_fixed_cosine(3) + LIMNI_FIXED_ONE / 2) <= 8);
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

int main(void) {
    test_rounding();
    test_cosine();
    test_smooth_masks();
    test_boundary_masks();
    return check_report();
}
