/* SPDX-License-Identifier: MIT */
/* Symbolic subdivision against worked examples. */
#include "../baker/base.h"
#include "../baker/masks.h"
#include "../baker/subdivide.h"
#include "check.h"
#include "limn/limn.h"

#include <math.h>
#include <string.h>

static double value(limni_fixed a) {
    return ldexp((double)a, -LIMNI_FIXED_BITS);
}

enum { ROWS = 289, SLOTS = 16 };

static limni_fixed rows[ROWS * SLOTS], tangents[2 * ROWS * SLOTS];
static limni_context context;

static uint32_t row_at(int i, int j) {
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    uint32_t row = 0;
    while (domain->rows[row].i != i || domain->rows[row].j != j)
        row++;
    return row;
}

/// The corners of faces, one behind the other. Control points are all at the same place.
typedef struct face_list {
    uint32_t *corners, *offsets;
    uint32_t face_count, control_count;
} face_list;

static limni_mesh mesh_of(const face_list *faces) {
    static float positions[SLOTS][3];
    limni_mesh mesh = {0};
    limni_source source = {.name = "faces",
                           .positions = positions,
                           .position_count = faces->control_count,
                           .face_count = faces->face_count,
                           .face_offsets = faces->offsets,
                           .face_corners = faces->corners};
    CHECK(faces->control_count <= SLOTS);
    CHECK_EQUAL(limni_mesh_build(&context, &source, &mesh), LIMN_BAKE_OK);
    return mesh;
}

/// The first of some faces of `size` corners with those around it, its control points as slots.
static limni_neighbourhood neighbourhood_of(const limni_rules *rules, uint32_t *corners,
                                            uint32_t size, uint32_t face_count,
                                            uint32_t control_count) {
    static uint32_t offsets[32], controls[SLOTS];
    for (uint32_t f = 0; f <= face_count; f++)
        offsets[f] = size * f;
    for (uint32_t c = 0; c < control_count; c++)
        controls[c] = c;
    context.desc.scheme = rules->scheme;
    const face_list faces = {corners, offsets, face_count, control_count};
    const limni_mesh mesh = mesh_of(&faces);
    limni_mesh_sharpness sharpness;
    limni_neighbourhood made = {0};
    CHECK_EQUAL(limni_mesh_sharpness_begin(&context, &mesh, rules, &sharpness), LIMN_BAKE_OK);
    const limni_cutting cutting = {.mesh = &mesh,
                                   .sharpness = &sharpness,
                                   .controls = controls,
                                   .control_count = control_count,
                                   .inner_count = size,
                                   .with_edges = sharpness.edges};
    CHECK_EQUAL(limni_neighbourhood_begin(&context, &cutting, &made), LIMN_BAKE_OK);
    return made;
}

static const limni_rows out = {.positions = rows};

static void subdivide_to_limit(const limni_rules *rules, const limni_neighbourhood *neighbourhood,
                               const limni_rows *to) {
    CHECK_EQUAL(
        limni_subdivide(&context, rules, neighbourhood, LIMN_LEVEL_MAX, LIMNI_PROJECT_TO_LIMIT, to),
        LIMN_BAKE_OK);
}

/// Brickhill, equations (1) to (5): a face with a corner of valence 5. His C1, C2, C3 are slots 0,
/// 1, 2; around C1 follow C4, C5, C6, and C10 lies across the edge C2 C3. He uses Warren's weights.
static void test_brickhill_example(void) {
    enum { C1, C2, C3, C4, C5, C6, C10 = 8, COUNT = 11 };
    uint32_t triangles[][3] = {{C1, C2, C3},  {C1, C3, C4}, {C1, C4, C5}, {C1, C5, C6},
                               {C1, C6, C2},  {C2, C6, 6},  {C2, 6, 7},   {C2, 7, C10},
                               {C2, C10, C3}, {C3, C10, 9}, {C3, 9, 10},  {C3, 10, C4}};
    const limni_rules rules = {.weights = LIMN_WEIGHTS_WARREN};
    const limni_neighbourhood neighbourhood = neighbourhood_of(&rules, triangles[0], 3, 12, COUNT);
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

static limni_neighbourhood regular(const limni_rules *rules) {
    static uint32_t triangles[][3] = {{0, 1, 2},  {0, 2, 3},   {0, 3, 4}, {0, 4, 5}, {0, 5, 6},
                                      {0, 6, 1},  {1, 6, 7},   {1, 7, 8}, {1, 8, 9}, {1, 9, 2},
                                      {2, 9, 10}, {2, 10, 11}, {2, 11, 3}};
    return neighbourhood_of(rules, triangles[0], 3, 13, 12);
}

/// The regular patch is a quartic box spline: its limit at the corners is 1/2 and 1/12, in the
/// middle of an edge and at the centre it is known in closed form, and all rows sum to 1.
static void test_regular_limit(void) {
    const limni_rules rules = {0};
    const limni_neighbourhood neighbourhood = regular(&rules);
    subdivide_to_limit(&rules, &neighbourhood, &out);
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
    const limni_rules rules = {0};
    const limni_neighbourhood neighbourhood = regular(&rules);
    subdivide_to_limit(&rules, &neighbourhood, &out);
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    for (uint32_t row = 0; row < 153; row++) {
        const double v = domain->rows[row].i / 16., w = domain->rows[row].j / 16.;
        double expected[12];
        box_spline(1 - v - w, v, w, expected);
        for (uint32_t slot = 0; slot < 12; slot++)
            CHECK_NEAR(value(rows[row * 12 + slot]), expected[slot] / 12, 1e-15);
    }
}

// ---- Quads

/// Nine quads on a grid of 4 by 4 control points, the middle one first. Its corners are slots 0 to
/// 3, from (1, 1) counter-clockwise; the others follow row by row.
static const uint32_t grid[4][4] = {{4, 5, 6, 7}, {8, 0, 1, 9}, {10, 3, 2, 11}, {12, 13, 14, 15}};

static limni_neighbourhood regular_quad(const limni_rules *rules) {
    uint32_t quads[9][4];
    for (uint32_t q = 0; q < 9; q++) {
        const uint32_t face = q == 0 ? 4 : q <= 4 ? q - 1 : q, x = face % 3, y = face / 3;
        memcpy(quads[q],
               (uint32_t[]){grid[y][x], grid[y][x + 1], grid[y + 1][x + 1], grid[y + 1][x]},
               sizeof quads[q]);
    }
    return neighbourhood_of(rules, quads[0], 4, 9, 16);
}

/// The uniform cubic B-splines that matter between 0 and 1, and their derivatives.
static void cubic_splines(double t, double b[4], double d[4]) {
    const double s = 1 - t;
    b[0] = s * s * s / 6;
    b[1] = (3 * t * t * t - 6 * t * t + 4) / 6;
    b[2] = (3 * s * s * s - 6 * s * s + 4) / 6;
    b[3] = t * t * t / 6;
    d[0] = -s * s / 2;
    d[1] = (3 * t * t - 4 * t) / 2;
    d[2] = (-3 * s * s + 4 * s) / 2;
    d[3] = t * t / 2;
}

/// What a row of the regular quad has of one control point: the product of two B-splines, and its
/// derivatives by u and v.
typedef struct spline_product {
    double position, du, dv;
} spline_product;

static spline_product spline_of(limn_row row, uint32_t x, uint32_t y) {
    double u[4], v[4], du[4], dv[4];
    cubic_splines(row.i / 16., u, du);
    cubic_splines(row.j / 16., v, dv);
    return (spline_product){u[x] * v[y], du[x] * v[y], u[x] * dv[y]};
}

/// Three times the derivative for one step of the grid: along the edge, or inside halfway between u
/// and v.
static void expect_tangents(limn_row row, spline_product of, double expected[2]) {
    const double halfway = row.edges ? 0 : sqrt(0.5);
    const double by_edge[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    int edge = 0;
    while (row.edges && !(row.edges >> edge & 1))
        edge++;
    const double c = row.edges ? by_edge[edge][0] : halfway;
    const double s = row.edges ? by_edge[edge][1] : halfway;
    expected[0] = 3 / 16. * (c * of.du + s * of.dv);
    expected[1] = 3 / 16. * (c * of.dv - s * of.du);
}

static void test_regular_is_a_b_spline(void) {
    const limni_rules rules = {.scheme = LIMN_SCHEME_CATMARK};
    const limni_neighbourhood neighbourhood = regular_quad(&rules);
    const limni_rows both = {.positions = rows, .tangents = tangents};
    subdivide_to_limit(&rules, &neighbourhood, &both);
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_QUAD);
    for (uint32_t row = 0; row < ROWS; row++) {
        for (uint32_t c = 0; c < 16; c++) {
            const spline_product of = spline_of(domain->rows[row], c % 4, c / 4);
            const uint32_t at = row * 16 + grid[c / 4][c % 4];
            double expected[2];
            CHECK_NEAR(value(rows[at]), of.position, 1e-15);
            CHECK(rows[at] >= 0);
            if (row < 4) continue; // tangents of corners are those of control points
            expect_tangents(domain->rows[row], of, expected);
            CHECK_NEAR(value(tangents[at]), expected[0], 1e-15);
            CHECK_NEAR(value(tangents[ROWS * 16 + at]), expected[1], 1e-15);
        }
    }
}

/// Without a scheme a quad is bilinear, whatever is around it.
static void test_bilinear(void) {
    static const uint32_t corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const limni_rules rules = {.scheme = LIMN_SCHEME_NONE};
    const limni_neighbourhood neighbourhood = regular_quad(&rules);
    subdivide_to_limit(&rules, &neighbourhood, &out);
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_QUAD);
    for (uint32_t row = 0; row < ROWS; row++) {
        const double u = domain->rows[row].i / 16., v = domain->rows[row].j / 16.;
        for (uint32_t slot = 0; slot < 16; slot++) {
            const double expected =
                slot < 4 ? (corners[slot][0] ? u : 1 - u) * (corners[slot][1] ? v : 1 - v) : 0;
            CHECK_NEAR(value(rows[row * 16 + slot]), expected, 1e-16);
        }
    }
}

// ---- Polygons

/// A prism of five sides with a triangle put on one of them: faces of three, four and five corners.
static limni_mesh prism(void) {
    static uint32_t corners[] = {4, 3, 2, 1, 0, 5, 6, 7, 8, 9,  0, 1, 6,  5, 1, 2,  7, 6, 2,
                                 3, 8, 7, 3, 4, 9, 8, 4, 0, 10, 0, 5, 10, 5, 9, 10, 9, 4, 10};
    static uint32_t offsets[] = {0, 5, 10, 14, 18, 22, 26, 29, 32, 35, 38};
    context.desc.scheme = LIMN_SCHEME_CATMARK;
    return mesh_of(&(face_list){corners, offsets, 10, 11});
}

static void add_mean(const limni_mesh *mesh, uint32_t face, double weight, double *point) {
    for (uint32_t h = mesh->offsets[face]; h < mesh->offsets[face + 1]; h++)
        point[mesh->corners[h]] += weight / limni_face_size(mesh, face);
}

static void check_point(const limni_stencils *stencils, uint32_t point, const double *expected) {
    double given[SLOTS] = {0};
    for (uint32_t t = stencils->offsets[point]; t < stencils->offsets[point + 1]; t++) {
        CHECK(given[stencils->terms[t].point] == 0); // each once
        given[stencils->terms[t].point] = (double)stencils->terms[t].weight;
    }
    for (uint32_t c = 0; c < SLOTS; c++)
        CHECK_NEAR(given[c], expected[c], 0x1p-25);
}

/// What Catmull and Clark say of any polygons, in their words: a face point is the mean of its
/// corners; an edge point that of the ends and of both face points; and a vertex of valence n goes to
/// (Q + 2 R + (n - 3) S) / n, Q being the mean of the face points, R that of the middles of edges, S
/// the vertex.
static void test_polygons_divide(void) {
    const limni_mesh mesh = prism();
    const limni_rules rules = {.scheme = LIMN_SCHEME_CATMARK};
    limni_base base;
    CHECK_EQUAL(limni_base_begin(&context, &mesh, &rules, &base), LIMN_BAKE_OK);
    if (!CHECK(base.divided)) return;
    const limni_refined *const refined = &base.refined;
    CHECK_EQUAL(refined->mesh.face_count, mesh.half_edge_count);
    for (uint32_t f = 0; f < mesh.face_count; f++) {
        double expected[SLOTS] = {0};
        add_mean(&mesh, f, 1, expected);
        check_point(&base.stencils, refined->first_face_point + f, expected);
    }
    for (uint32_t h = 0; h < mesh.half_edge_count; h++) {
        double expected[SLOTS] = {0};
        expected[limni_half_edge_start(&mesh, h)] = expected[limni_half_edge_end(&mesh, h)] = 0.25;
        add_mean(&mesh, mesh.face_of[h], 0.25, expected);
        add_mean(&mesh, mesh.face_of[mesh.pairs[h]], 0.25, expected);
        check_point(&base.stencils, refined->edge_points[h], expected);
        const uint32_t quad[4] = {mesh.corners[h], refined->edge_points[h],
                                  refined->first_face_point + mesh.face_of[h],
                                  refined->edge_points[limni_half_edge_previous(&mesh, h)]};
        CHECK(memcmp(&refined->mesh.corners[4 * h], quad, sizeof quad) == 0);
    }
    for (uint32_t v = 0; v < mesh.control_count; v++) {
        const double n = mesh.valences[v];
        double expected[SLOTS] = {[0] = 0};
        expected[v] = (n - 3) / n;
        for (uint32_t h = 0; h < mesh.half_edge_count; h++) {
            if (mesh.corners[h] != v) continue;
            add_mean(&mesh, mesh.face_of[h], 1 / n / n, expected);
            expected[v] += 1 / n / n;
            expected[limni_half_edge_end(&mesh, h)] += 1 / n / n;
        }
        check_point(&base.stencils, v, expected);
    }
}

// ---- The butterfly's edges

/// What the vertex on the edge of half-edge h has of each vertex, seen from where h starts or from
/// the other end, whose star the masks then have. Returns the place of the edge in that.
static uint32_t edge_weights(limni_masks *masks, uint32_t h, bool from_end,
                             limni_fixed weights[SLOTS]) {
    const limni_mesh *const mesh = masks->mesh;
    const uint32_t end = from_end ? limni_half_edge_end(mesh, h) : mesh->corners[h];
    uint32_t r = 0;
    limni_masks_look(masks, end, LIMNI_NONE);
    while (masks->ring_edges[r] != h && masks->ring_edges[r] != mesh->pairs[h])
        r++;
    limni_masks_edge(masks, r);
    memset(weights, 0, SLOTS * sizeof *weights);
    for (uint32_t t = 0; t < masks->term_count; t++)
        weights[masks->terms[t].control] += masks->terms[t].weight;
    return r;
}

/// Adds what an extraordinary end inside gives the vertices around it (Zorin).
static void add_extraordinary(const limni_masks *masks, uint32_t r, double share, double *sums) {
    static const double of_3[] = {5 / 12., -1 / 12., -1 / 12.}, of_4[] = {3 / 8., 0, -1 / 8., 0};
    const uint32_t n = masks->star.count;
    for (uint32_t j = 0; j < n; j++) {
        const double turn = 6.283185307179586 * j / n;
        const double weight = n == 3   ? of_3[j]
                              : n == 4 ? of_4[j]
                                       : (0.25 + cos(turn) + cos(2 * turn) / 2) / n;
        sums[masks->star.ring[(r + j) % n]] += share * weight;
    }
    sums[masks->vertex] += share * 3 / 4;
}

/// Both ends say the same, to the last bit, and the weights sum to exactly 1. Of closed meshes whose
/// edges all have an extraordinary end, they are the mean of what those say.
static void check_butterfly_edges(const limni_rules *rules, const face_list *faces, bool closed) {
    context.desc.scheme = rules->scheme;
    const limni_mesh mesh = mesh_of(faces);
    limni_mesh_sharpness sharpness;
    limni_masks masks;
    CHECK_EQUAL(limni_mesh_sharpness_begin(&context, &mesh, rules, &sharpness), LIMN_BAKE_OK);
    CHECK_EQUAL(limni_masks_begin(&context, &masks, &mesh, &sharpness, rules), LIMN_BAKE_OK);
    for (uint32_t h = 0; h < mesh.half_edge_count; h++) {
        limni_fixed weights[2][SLOTS], sum = 0;
        double sums[SLOTS] = {0};
        const uint32_t valences[2] = {mesh.valences[mesh.corners[h]],
                                      mesh.valences[limni_half_edge_end(&mesh, h)]};
        const double share = valences[0] != 6 && valences[1] != 6 ? 0.5 : 1;
        for (int end = 0; end < 2; end++) {
            const uint32_t r = edge_weights(&masks, h, end == 1, weights[end]);
            if (closed && valences[end] != 6) add_extraordinary(&masks, r, share, sums);
        }
        CHECK(memcmp(weights[0], weights[1], sizeof weights[0]) == 0);
        for (uint32_t v = 0; v < mesh.control_count; v++) {
            sum += weights[0][v];
            if (closed) CHECK_NEAR(value(weights[0][v]), sums[v], 1e-15);
        }
        CHECK_EQUAL(sum, LIMNI_FIXED_ONE);
    }
    limni_masks_end(&context, &masks);
}

/// Two tips with n neighbours, which have four; or one with n - 1 faces around it, and a boundary.
static void test_butterfly_fans(void) {
    static const float tensions[] = {0, 1 / 32.f};
    uint32_t corners[2 * SLOTS][3], offsets[2 * SLOTS + 1];
    for (uint32_t f = 0; f <= 2 * SLOTS; f++)
        offsets[f] = 3 * f;
    for (uint32_t n = 3; n <= SLOTS - 2; n++) {
        const limni_rules rules = {.scheme = LIMN_SCHEME_BUTTERFLY,
                                   .tension = limni_fixed_from(tensions[n % 2])};
        for (uint32_t k = 0; k < n; k++) {
            const uint32_t a = 2 + k, b = 2 + (k + 1) % n;
            memcpy(corners[k], (uint32_t[]){0, a, b}, sizeof corners[k]);
            memcpy(corners[n + k], (uint32_t[]){1, b, a}, sizeof corners[k]);
        }
        const face_list tips = {corners[0], offsets, 2 * n, n + 2};
        check_butterfly_edges(&rules, &tips, true);
        const face_list fan = {corners[0], offsets, n - 1, n + 2};
        check_butterfly_edges(&rules, &fan, false);
    }
}

/// The regular patch: its inner edge has ten points, and around it there is a boundary.
static void test_butterfly_lattice(void) {
    const double w = 1 / 32.;
    const limni_rules rules = {.scheme = LIMN_SCHEME_BUTTERFLY,
                               .tension = limni_fixed_from((float)w)};
    const double expected[SLOTS] = {[0] = 0.5 - w,
                                    [1] = 0.5 - w,
                                    [2] = 1 / 8. + 2 * w,
                                    [6] = 1 / 8. + 2 * w,
                                    [3] = -1 / 16. - w,
                                    [5] = -1 / 16. - w,
                                    [7] = -1 / 16. - w,
                                    [9] = -1 / 16. - w,
                                    [4] = w,
                                    [8] = w};
    const limni_neighbourhood lattice = regular(&rules);
    limni_masks masks;
    limni_fixed weights[SLOTS];
    CHECK_EQUAL(limni_masks_begin(&context, &masks, &lattice.mesh, &lattice.sharpness, &rules),
                LIMN_BAKE_OK);
    edge_weights(&masks, 0, false, weights);
    for (uint32_t v = 0; v < SLOTS; v++)
        CHECK_NEAR(value(weights[v]), expected[v], 1e-17);
    limni_masks_end(&context, &masks);
    uint32_t offsets[14];
    for (uint32_t f = 0; f < 14; f++)
        offsets[f] = 3 * f;
    const face_list faces = {lattice.mesh.corners, offsets, 13, 12};
    check_butterfly_edges(&rules, &faces, false);
}

int main(void) {
    test_brickhill_example();
    test_regular_limit();
    test_regular_is_a_box_spline();
    test_regular_is_a_b_spline();
    test_bilinear();
    test_polygons_divide();
    test_butterfly_fans();
    test_butterfly_lattice();
    limni_release_all(&context);
    return check_report();
}
