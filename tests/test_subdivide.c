/* SPDX-License-Identifier: MIT */
/* Symbolic subdivision against worked examples. */
#include "../baker/subdivide.h"
#include "check.h"
#include "limn/limn.h"

#include <math.h>

static double value(limni_fixed a) {
    return ldexp((double)a, -LIMNI_FIXED_BITS);
}

static limni_fixed rows[153 * 16];
static limni_context context;

static uint32_t row_at(int i, int j) {
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    uint32_t row = 0;
    while (domain->rows[row].i != i || domain->rows[row].j != j)
        row++;
    return row;
}

/// The first triangle of a list with those around it, its control points as slots.
static limni_neighbourhood neighbourhood_of(uint32_t (*triangles)[3], uint32_t triangle_count,
                                            uint32_t control_count) {
    static float positions[16][3];
    static uint32_t offsets[32], controls[16];
    for (uint32_t f = 0; f <= triangle_count; f++)
        offsets[f] = 3 * f;
    for (uint32_t c = 0; c < control_count; c++)
        controls[c] = c;
    limni_source source = {.name = "neighbourhood",
                           .positions = positions,
                           .position_count = control_count,
                           .face_count = triangle_count,
                           .face_offsets = offsets,
                           .face_corners = triangles[0]};
    const limni_rules rules = {.boundary = LIMN_BOUNDARY_EDGE_ONLY};
    limni_mesh mesh;
    limni_mesh_sharpness sharpness;
    limni_neighbourhood made = {0};
    CHECK_EQUAL(limni_mesh_build(&context, &source, &mesh), LIMN_BAKE_OK);
    CHECK_EQUAL(limni_mesh_sharpness_begin(&context, &mesh, &rules, &sharpness), LIMN_BAKE_OK);
    const limni_cutting cutting = {.mesh = &mesh,
                                   .sharpness = &sharpness,
                                   .controls = controls,
                                   .control_count = control_count,
                                   .inner_count = 3};
    CHECK_EQUAL(limni_neighbourhood_begin(&context, &cutting, &made), LIMN_BAKE_OK);
    return made;
}

static const limni_rows out = {.positions = rows};

/// Brickhill, equations (1) to (5): a face with a corner of valence 5. His C1, C2, C3 are slots 0,
/// 1, 2; around C1 follow C4, C5, C6, and C10 lies across the edge C2 C3. He uses Warren's weights.
static void test_brickhill_example(void) {
    enum { C1, C2, C3, C4, C5, C6, C10 = 8, COUNT = 11 };
    uint32_t triangles[][3] = {{C1, C2, C3},  {C1, C3, C4}, {C1, C4, C5}, {C1, C5, C6},
                               {C1, C6, C2},  {C2, C6, 6},  {C2, 6, 7},   {C2, 7, C10},
                               {C2, C10, C3}, {C3, C10, 9}, {C3, 9, 10},  {C3, 10, C4}};
    const limni_neighbourhood neighbourhood = neighbourhood_of(triangles, 12, COUNT);
    const limni_rules rules = {.weights = LIMN_WEIGHTS_WARREN};
    CHECK_EQUAL(limni_subdivide(&context, &rules, &neighbourhood, 2, LIMNI_PROJECT_NOT, &out),
                LIMN_BAKE_OK);

    const double v_1_2[COUNT] = {[C1] = 3 / 8., [C3] = 3 / 8., [C4] = 1 / 8., [C2] = 1 / 8.};
    const double v_1_4[COUNT] = {[C1] = 3 / 8., [C2] = 3 / 8., [C3] = 1 / 8., [C6] = 1 / 8.};
    const double v_1_1[COUNT] = {[C3] = 3 / 8., [C2] = 3 / 8., [C10] = 1 / 8., [C1] = 1 / 8.};
    const double v_1_5[COUNT] = {[C1] = 25 / 40., [C2] = 3 / 40., [C3] = 3 / 40.,
                                 [C4] = 3 / 40.,  [C5] = 3 / 40., [C6] = 3 / 40.};
    // v(2,8) is half-way along the level-1 edge from v(1,2), on C1 C3, to v(1,4), on C1 C2.
    const limni_fixed *const v_2_8 = rows + row_at(4, 4) * COUNT;
    for (int c = 0; c < COUNT; c++) {
        const double expected =
            3 / 8. * v_1_2[c] + 3 / 8. * v_1_4[c] + 1 / 8. * v_1_5[c] + 1 / 8. * v_1_1[c];
        CHECK_NEAR(value(v_2_8[c]), expected, 1e-17);
    }

    CHECK_EQUAL(limni_subdivide(&context, &rules, &neighbourhood, 1, LIMNI_PROJECT_NOT, &out),
                LIMN_BAKE_OK);
    for (int c = 0; c < COUNT; c++) {
        CHECK_NEAR(value(rows[row_at(0, 8) * COUNT + (uint32_t)c]), v_1_2[c], 1e-17);
        CHECK_NEAR(value(rows[row_at(8, 0) * COUNT + (uint32_t)c]), v_1_4[c], 1e-17);
        CHECK_NEAR(value(rows[row_at(8, 8) * COUNT + (uint32_t)c]), v_1_1[c], 1e-17);
        CHECK_NEAR(value(rows[row_at(0, 0) * COUNT + (uint32_t)c]), v_1_5[c], 1e-17);
    }
}

static const uint32_t rings[3][6] = {{1, 2, 3, 4, 5, 6}, {2, 0, 6, 7, 8, 9}, {0, 1, 9, 10, 11, 3}};

static limni_neighbourhood regular(void) {
    static uint32_t triangles[][3] = {{0, 1, 2},  {0, 2, 3},   {0, 3, 4}, {0, 4, 5}, {0, 5, 6},
                                      {0, 6, 1},  {1, 6, 7},   {1, 7, 8}, {1, 8, 9}, {1, 9, 2},
                                      {2, 9, 10}, {2, 10, 11}, {2, 11, 3}};
    return neighbourhood_of(triangles, 13, 12);
}

/// The regular patch is a quartic box spline: its limit at the corners is 1/2 and 1/12, in the
/// middle of an edge and at the centre it is known in closed form, and all rows sum to 1.
static void test_regular_limit(void) {
    const limni_neighbourhood neighbourhood = regular();
    const limni_rules rules = {0};
    CHECK_EQUAL(limni_subdivide(&context, &rules, &neighbourhood, LIMN_LEVEL_MAX,
                                LIMNI_PROJECT_TO_LIMIT, &out),
                LIMN_BAKE_OK);
    for (uint32_t corner = 0; corner < 3; corner++) {
        CHECK_NEAR(value(rows[corner * 12 + corner]), 1 / 2., 1e-16);
        for (uint32_t r = 0; r < 6; r++)
            CHECK_NEAR(value(rows[corner * 12 + rings[corner][r]]), 1 / 12., 1e-16);
    }
    for (uint32_t row = 0; row < 153; row++) {
        limni_fixed sum = 0;
        for (uint32_t slot = 0; slot < 12; slot++) {
            CHECK(rows[row * 12 + slot] >= 0);
            sum += rows[row * 12 + slot];
        }
        CHECK(sum - LIMNI_FIXED_ONE <= 64 && LIMNI_FIXED_ONE - sum <= 64);
    }
}

/// Stam's basis functions of the regular patch, in barycentric coordinates (u, v, w), numbered like
/// our slots ("Evaluation of Loop Subdivision Surfaces", 1999, appendix A).
static void box_spline(double u, double v, double w, double b[12]) {
    const double u2 = u * u, v2 = v * v, w2 = w * w, u3 = u2 * u, v3 = v2 * v, w3 = w2 * w;
    const double u4 = u2 * u2, v4 = v2 * v2, w4 = w2 * w2;
    const double corner_u = 6 * u4 + 24 * u3 * w + 24 * u2 * w2 + 8 * u * w3 + w4 + 24 * u3 * v +
                            60 * u2 * v * w + 36 * u * v * w2 + 6 * v * w3 + 24 * u2 * v2 +
                            36 * u * v2 * w + 12 * v2 * w2 + 8 * u * v3 + 6 * v3 * w + v4;
    const double corner_v = u4 + 6 * u3 * w + 12 * u2 * w2 + 6 * u * w3 + w4 + 8 * u3 * v +
                            36 * u2 * v * w + 36 * u * v * w2 + 8 * v * w3 + 24 * u2 * v2 +
                            60 * u * v2 * w + 24 * v2 * w2 + 24 * u * v3 + 24 * v3 * w + 6 * v4;
    const double corner_w = u4 + 8 * u3 * w + 24 * u2 * w2 + 24 * u * w3 + 6 * w4 + 6 * u3 * v +
                            36 * u2 * v * w + 60 * u * v * w2 + 24 * v * w3 + 12 * u2 * v2 +
                            36 * u * v2 * w + 24 * v2 * w2 + 6 * u * v3 + 8 * v3 * w + v4;
    b[0] = corner_u;
    b[1] = corner_v;
    b[2] = corner_w;
    b[3] = u4 + 6 * u3 * w + 12 * u2 * w2 + 6 * u * w3 + w4 + 2 * u3 * v + 6 * u2 * v * w +
           6 * u * v * w2 + 2 * v * w3; // across the edge from u to w
    b[4] = u4 + 2 * u3 * w;
    b[5] = u4 + 2 * u3 * v;
    b[6] = u4 + 2 * u3 * w + 6 * u3 * v + 6 * u2 * v * w + 12 * u2 * v2 + 6 * u * v2 * w +
           6 * u * v3 + 2 * v3 * w + v4; // across the edge from u to v
    b[7] = 2 * u * v3 + v4;
    b[8] = 2 * v3 * w + v4;
    b[9] = 2 * u * v3 + 6 * u * v2 * w + 6 * u * v * w2 + 2 * u * w3 + v4 + 6 * v3 * w +
           12 * v2 * w2 + 6 * v * w3 + w4; // across the edge from v to w
    b[10] = 2 * v * w3 + w4;
    b[11] = 2 * u * w3 + w4;
}

static void test_regular_is_a_box_spline(void) {
    const limni_neighbourhood neighbourhood = regular();
    const limni_rules rules = {0};
    CHECK_EQUAL(limni_subdivide(&context, &rules, &neighbourhood, LIMN_LEVEL_MAX,
                                LIMNI_PROJECT_TO_LIMIT, &out),
                LIMN_BAKE_OK);
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    for (uint32_t row = 0; row < 153; row++) {
        const double v = domain->rows[row].i / 16., w = domain->rows[row].j / 16.;
        double expected[12];
        box_spline(1 - v - w, v, w, expected);
        for (uint32_t slot = 0; slot < 12; slot++)
            CHECK_NEAR(value(rows[row * 12 + slot]), expected[slot] / 12, 1e-15);
    }
}

int main(void) {
    test_brickhill_example();
    test_regular_limit();
    test_regular_is_a_box_spline();
    limni_release_all(&context);
    return check_report();
}
