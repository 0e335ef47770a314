/* SPDX-License-Identifier: MIT */
/*
 * Skinning and morph targets on made-up points: beside double precision, every kernel beside the
 * scalar one bit for bit, ranges, and what is refused. Links the runtime alone.
 */
#include "../runtime/kernels.h"
#include "check.h"
#include "skin_reference.h"

#include <stdlib.h>

enum { POINTS = 203, SIDES = 30, NORMALS = POINTS + SIDES, JOINTS = 23 };

static const double SIZE = 3.4641016; ///< the diagonal of the points' box

static uint32_t state = 4711;

static double random_number(double low, double high) {
    state = state * 1664525u + 1013904223u;
    return low + (high - low) * (state >> 8) / 16777216.0;
}

static uint32_t random_index(uint32_t count) {
    return (uint32_t)random_number(0, count);
}

/// A skin of made-up points and joints.
typedef struct made {
    limn_skin skin;
    limn_mesh mesh; ///< for its normals
    uint16_t joints[POINTS * LIMN_INFLUENCE_MAX];
    float weights[POINTS * LIMN_INFLUENCE_MAX];
    joint motions[JOINTS];
    float matrices[JOINTS * 12];
    limn_dual_quaternion quaternions[JOINTS];
    float points[POINTS * 3];
    float normals[NORMALS * 3];
    limn_file_normal none;
    limn_file_side sides[SIDES];
} made;

static void make_quaternion(double angle, quaternion q) {
    double axis[3], length = 0;
    for (int i = 0; i < 3; i++) {
        axis[i] = random_number(-1, 1);
        length += axis[i] * axis[i];
    }
    for (int i = 0; i < 3; i++)
        q[i] = axis[i] / sqrt(length) * sin(angle / 2);
    q[3] = cos(angle / 2);
}

/// A turn of up to 1.4 radians and what all have in common, as a quaternion of either sign; a
/// stretch of up to a third, along any axes.
static void make_motion(joint *j, const quaternion common) {
    double pivot[3], way[3];
    make_quaternion(random_number(0, 1.4), j->rotation);
    multiply(j->rotation, common, j->rotation);
    const double sign = random_index(2) ? 1 : -1;
    for (int i = 0; i < 4; i++)
        j->rotation[i] *= sign;
    for (int i = 0; i < 3; i++) {
        pivot[i] = random_number(-1, 1);
        way[i] = random_number(-0.2, 0.2);
        for (int k = 0; k <= i; k++)
            j->stretch[i][k] = j->stretch[k][i] = (i == k) + random_number(-0.15, 0.15);
    }
    set_pivot(j, pivot, way);
}

static void make_normals(made *m) {
    for (uint32_t n = 0; n < NORMALS; n++) {
        quaternion q;
        make_quaternion(3.14159265358979, q);
        for (int i = 0; i < 3; i++)
            m->normals[3 * n + (uint32_t)i] = (float)q[i];
    }
    for (uint32_t s = 0; s < SIDES; s++)
        m->sides[s].point = random_index(POINTS);
    m->mesh = (limn_mesh){.control_count = POINTS,
                          .base_count = POINTS,
                          .normal_count = NORMALS,
                          .normals = &m->none,
                          .sides = m->sides};
}

static void make(made *m, uint32_t influence_count) {
    quaternion common;
    memset(m, 0, sizeof *m);
    make_quaternion(random_number(0, 6), common);
    for (uint32_t j = 0; j < JOINTS; j++) {
        make_motion(&m->motions[j], common);
        joint_matrix(&m->motions[j], m->matrices + 12 * j);
    }
    for (uint32_t i = 0; i < POINTS * influence_count; i++) {
        m->joints[i] = (uint16_t)random_index(JOINTS);
        m->weights[i] = random_index(4) ? (float)random_number(0, 1) : 0;
        if (i % influence_count == 0) m->weights[i] += 0.5f;
    }
    for (uint32_t i = 0; i < 3 * POINTS; i++)
        m->points[i] = (float)random_number(-1, 1);
    m->skin = (limn_skin){.point_count = POINTS,
                          .joint_count = JOINTS,
                          .influence_count = influence_count,
                          .joints = m->joints,
                          .weights = m->weights};
    CHECK_EQUAL(limn_skin_normalise(POINTS, influence_count, m->joints, m->weights, NULL), LIMN_OK);
    CHECK_EQUAL(limn_skin_check(&m->skin, NULL), LIMN_OK);
    limn_dual_quaternions_make(m->matrices, JOINTS, m->quaternions);
    make_normals(m);
}

static limn_pose pose_of(const made *m, bool dual) {
    return (limn_pose){.skin = &m->skin,
                       .matrices = dual ? NULL : m->matrices,
                       .dual_quaternions = dual ? m->quaternions : NULL};
}

static const limn_kernels *scalar_kernels(void) {
    return limn_kernels_select(LIMN_ISA_SCALAR, LIMN_FAMILY_REPRODUCIBLE);
}

// ---- Beside double precision

static double distance(const float *a, const double *b) {
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(square);
}

static double worst_point(const made *m, bool dual, const float *points) {
    double error = 0;
    for (uint32_t p = 0; p < POINTS; p++) {
        double expected[3];
        if (dual) {
            blend_dual(&m->skin, m->motions, p, m->points + 3 * p, 1, expected);
        } else {
            blend_linear(&m->skin, m->matrices, p, m->points + 3 * p, 1, expected);
        }
        error = fmax(error, distance(points + 3 * p, expected));
    }
    return error;
}

static double worst_normal(const made *m, bool dual, const float *normals) {
    double error = 0;
    for (uint32_t n = 0; n < NORMALS; n++) {
        const uint32_t point = n < POINTS ? n : m->sides[n - POINTS].point;
        double expected[3];
        if (dual) {
            blend_dual(&m->skin, m->motions, point, m->normals + 3 * n, 0, expected);
        } else {
            blend_linear(&m->skin, m->matrices, point, m->normals + 3 * n, 0, expected);
        }
        const double length =
            sqrt(expected[0] * expected[0] + expected[1] * expected[1] + expected[2] * expected[2]);
        for (int i = 0; i < 3; i++)
            expected[i] /= length;
        error = fmax(error, distance(normals + 3 * n, expected));
    }
    return error;
}

static double worst[2][2]; ///< of points and normals, with linear blending and dual quaternions

/// Points to 1e-6 of the size, normals to 1e-6 radians.
static void test_reference(made *m, bool dual) {
    float points[POINTS * 3], normals[NORMALS * 3];
    const limn_pose pose = pose_of(m, dual);
    m->skin.kernels = scalar_kernels();
    limn_pose_points(&pose, m->points, 0, POINTS, points);
    limn_pose_normals(&pose, &m->mesh, m->normals, 0, NORMALS, normals);
    const double point_error = worst_point(m, dual, points) / SIZE;
    const double normal_error = worst_normal(m, dual, normals);
    CHECK(point_error < 1e-6);
    CHECK(normal_error < 1e-6);
    worst[dual][0] = fmax(worst[dual][0], point_error);
    worst[dual][1] = fmax(worst[dual][1], normal_error);
}

// ---- Every kernel, every range

/// Whether kernels write the expected bits in [begin, end) and nothing else; in place, too.
static bool same_range(const limn_pose *pose, const limn_mesh *mesh, const float *src,
                       const float *expected, uint32_t begin, uint32_t end) {
    float actual[NORMALS * 3], in_place[NORMALS * 3];
    const uint32_t count = mesh ? NORMALS : POINTS;
    const size_t first = 3 * (size_t)begin, size = (end - begin) * sizeof(float[3]);
    memset(actual, 0xa5, sizeof actual);
    memcpy(in_place, src, count * sizeof(float[3]));
    if (mesh) {
        limn_pose_normals(pose, mesh, src, begin, end, actual);
        limn_pose_normals(pose, mesh, in_place, begin, end, in_place);
    } else {
        limn_pose_points(pose, src, begin, end, actual);
        limn_pose_points(pose, in_place, begin, end, in_place);
    }
    bool same = memcmp(actual + first, expected + first, size) == 0;
    same &= memcmp(in_place + first, expected + first, size) == 0;
    memset(actual + first, 0xa5, size);
    memcpy(in_place + first, src + first, size);
    for (size_t b = 0; b < sizeof actual; b++)
        same &= ((unsigned char *)actual)[b] == 0xa5;
    return same && memcmp(in_place, src, count * sizeof(float[3])) == 0;
}

static void test_kernels(made *m, const limn_kernels *kernels, bool dual) {
    float points[POINTS * 3], normals[NORMALS * 3];
    const limn_pose pose = pose_of(m, dual);
    m->skin.kernels = scalar_kernels();
    limn_pose_points(&pose, m->points, 0, POINTS, points);
    limn_pose_normals(&pose, &m->mesh, m->normals, 0, NORMALS, normals);
    m->skin.kernels = kernels;
    for (uint32_t begin = 0; begin <= POINTS; begin += 1 + random_index(40)) {
        const uint32_t end = begin + random_index(POINTS - begin + 1);
        CHECK(same_range(&pose, NULL, m->points, points, begin, end));
        CHECK(same_range(&pose, &m->mesh, m->normals, normals, begin + SIDES, end + SIDES));
    }
    for (uint32_t count = 0; count <= 17; count++)
        CHECK(same_range(&pose, NULL, m->points, points, 5, 5 + count));
    CHECK(same_range(&pose, NULL, m->points, points, 0, POINTS));
    CHECK(same_range(&pose, &m->mesh, m->normals, normals, 0, NORMALS));
}

static void test_all_kernels(made *m) {
    for (uint32_t isa = LIMN_ISA_SCALAR; isa <= limn_isa_supported(); isa <<= 1) {
        if (!(limn_isa_supported() & isa)) continue;
        for (int family = LIMN_FAMILY_REPRODUCIBLE; family <= LIMN_FAMILY_FAST; family++) {
            const limn_kernels *const kernels = limn_kernels_select(isa, (limn_family)family);
            test_kernels(m, kernels, false);
            test_kernels(m, kernels, true);
        }
    }
}

/// Wherever points with the same data are, they stay together in every bit.
static void test_twins(made *m, bool dual) {
    float points[POINTS * 3];
    const uint32_t count = m->skin.influence_count, half = POINTS / 2;
    const limn_pose pose = pose_of(m, dual);
    m->skin.kernels = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_FAST);
    memcpy(m->points + 3 * half, m->points, half * sizeof(float[3]));
    memcpy(m->joints + half * count, m->joints, half * count * sizeof *m->joints);
    memcpy(m->weights + half * count, m->weights, half * count * sizeof *m->weights);
    limn_pose_points(&pose, m->points, 0, POINTS, points);
    CHECK(memcmp(points, points + 3 * half, half * sizeof(float[3])) == 0);
}

// ---- Dual quaternions

/// q and -q are the same rotation.
static void test_signs(made *m) {
    float expected[POINTS * 3], actual[POINTS * 3];
    const limn_pose pose = pose_of(m, true);
    m->skin.kernels = scalar_kernels();
    limn_pose_points(&pose, m->points, 0, POINTS, expected);
    for (uint32_t j = 0; j < JOINTS; j += 1 + random_index(3)) {
        for (int i = 0; i < 4; i++) {
            m->quaternions[j].real[i] = -m->quaternions[j].real[i];
            m->quaternions[j].dual[i] = -m->quaternions[j].dual[i];
        }
    }
    limn_pose_points(&pose, m->points, 0, POINTS, actual);
    CHECK(memcmp(expected, actual, sizeof actual) == 0);
}

/// With a single influence the result is that of the matrix, whatever it does: turn by any angle,
/// mirror, flatten, or be 0.
static void test_any_matrix(void) {
    static const uint16_t joints[1] = {0};
    static const float weights[1] = {1}, point[3] = {0.5f, -0.75f, 0.25f};
    const limn_skin skin = {1, 1, 1, joints, weights, scalar_kernels()};
    for (int k = 0; k < 400; k++) {
        float matrix[12], moved[3];
        double expected[3];
        limn_dual_quaternion quaternions[1];
        const double range = pow(10, random_number(-3, 3)), squeeze = k % 4 ? 1 : 1e-5;
        for (int i = 0; i < 12; i++)
            matrix[i] = (float)(random_number(-1, 1) * (i < 4 ? range : range * squeeze));
        if (k % 5 == 1) memset(matrix, 0, 4 * sizeof *matrix);
        if (k % 25 == 1) memset(matrix, 0, sizeof matrix);
        if (k % 5 == 2) memcpy(matrix + 4, matrix, 4 * sizeof *matrix);
        limn_dual_quaternions_make(matrix, 1, quaternions);
        limn_pose_points(&(limn_pose){.skin = &skin, .dual_quaternions = quaternions}, point, 0, 1,
                         moved);
        blend_linear(&skin, matrix, 0, point, 1, expected);
        CHECK_NEAR(distance(moved, expected) / range, 0, 1e-6);
    }
}

/// Every half turn and quarter turn, for which other ways to find a quaternion lose digits or
/// divide by 0.
static void test_turns(void) {
    for (int k = 0; k < 64; k++) {
        const double signs[3] = {k & 1 ? -1 : 1, k & 2 ? -1 : 1, k & 4 ? -1 : 1};
        const int turn = k / 8 % 3;
        float matrix[12] = {0};
        limn_dual_quaternion q;
        const bool odd = k >= 32;
        for (int i = 0; i < 3; i++) {
            const int column = odd ? (turn - i + 3) % 3 : (i + turn) % 3;
            matrix[4 * i + column] = (float)signs[i];
        }
        limn_dual_quaternions_make(matrix, 1, &q);
        const double length = sqrt((double)q.real[0] * q.real[0] + (double)q.real[1] * q.real[1] +
                                   (double)q.real[2] * q.real[2] + (double)q.real[3] * q.real[3]);
        CHECK_NEAR(length, 1, 1e-6);
        const bool mirrors = (signs[0] * signs[1] * signs[2] < 0) != odd;
        for (int i = 0; i < 9; i++)
            CHECK_NEAR(q.stretch[i / 3][i % 3], (i % 4 == 0) * (mirrors ? -1.0f : 1.0f), 1e-6f);
    }
}

/// A point halfway between two joints, of which one twists by 170 degrees, stays at its distance
/// from the axis; blended matrices bring it to cos(85 degrees) of that.
static void test_twist(void) {
    static const uint16_t joints[2] = {0, 1};
    static const float weights[2] = {0.5f, 0.5f}, point[3] = {0, 1, 0};
    const limn_skin skin = {1, 2, 2, joints, weights, scalar_kernels()};
    const double angle = 170 / 57.29577951308232;
    const float c = (float)cos(angle), s = (float)sin(angle);
    const float matrices[24] = {1, 0, 0, 0, 0, 1, 0,  0, 0, 0, 1, 0,
                                1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0};
    limn_dual_quaternion quaternions[2];
    float linear[3], dual[3];
    limn_dual_quaternions_make(matrices, 2, quaternions);
    limn_pose_points(&(limn_pose){.skin = &skin, .matrices = matrices}, point, 0, 1, linear);
    limn_pose_points(&(limn_pose){.skin = &skin, .dual_quaternions = quaternions}, point, 0, 1,
                     dual);
    CHECK_NEAR(hypot((double)linear[1], (double)linear[2]), cos(angle / 2), 1e-6);
    CHECK_NEAR(hypot((double)dual[1], (double)dual[2]), 1, 1e-6);
    CHECK_NEAR((double)dual[1], cos(angle / 2), 1e-6);
}

// ---- What cannot be turned, and what is not finite

static void test_no_direction(void) {
    static const uint16_t joints[2] = {0, 1};
    static const float weights[2] = {0.5f, 0.5f}, normal[3] = {0, 1, 0};
    static const float matrices[24] = {1, 0, 0, 0, 0, 1,  0, 0, 0, 0, 1,  0,
                                       1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0};
    const limn_file_normal none = {0};
    const limn_mesh mesh = {
        .control_count = 1, .base_count = 1, .normal_count = 1, .normals = &none};
    const limn_skin skin = {1, 2, 2, joints, weights, scalar_kernels()};
    float turned[3];
    limn_pose_normals(&(limn_pose){.skin = &skin, .matrices = matrices}, &mesh, normal, 0, 1,
                      turned);
    CHECK(turned[0] == 0 && turned[1] == 0 && turned[2] == 1);
}

static bool names_joint(const limn_skin *skin, uint32_t point, uint32_t joint_index) {
    bool any = false;
    for (uint32_t i = 0; i < skin->influence_count; i++)
        any |= skin->joints[point * skin->influence_count + i] == joint_index;
    return any;
}

/// A matrix that is not a number spoils the points that name its joint, and no others.
static void test_not_finite(made *m, bool dual) {
    float points[POINTS * 3];
    const limn_pose pose = pose_of(m, dual);
    m->skin.kernels = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_REPRODUCIBLE);
    m->matrices[12 * 3 + 5] = NAN;
    limn_dual_quaternions_make(m->matrices, JOINTS, m->quaternions);
    limn_pose_points(&pose, m->points, 0, POINTS, points);
    for (uint32_t p = 0; p < POINTS; p++) {
        const bool finite =
            isfinite(points[3 * p]) && isfinite(points[3 * p + 1]) && isfinite(points[3 * p + 2]);
        CHECK(finite == !names_joint(&m->skin, p, 3));
    }
}

// ---- Morph targets

enum { TARGETS = 6, ENTRIES = 400 };

typedef struct morphs {
    limn_morph_targets targets;
    uint32_t first[TARGETS + 1];
    uint32_t points[ENTRIES];
    float deltas[ENTRIES * 3];
    float weights[TARGETS];
} morphs;

/// Target 2 is empty and target 4 has weight 0.
static void make_morphs(morphs *m) {
    uint32_t entry = 0;
    for (uint32_t t = 0; t < TARGETS; t++) {
        m->first[t] = entry;
        m->weights[t] = t == 4 ? 0 : (float)random_number(-0.5, 1);
        for (uint32_t p = random_index(9); p < POINTS && t != 2; p += 1 + random_index(5))
            m->points[entry++] = p;
    }
    m->first[TARGETS] = entry;
    for (uint32_t i = 0; i < 3 * entry; i++)
        m->deltas[i] = (float)random_number(-0.1, 0.1);
    m->targets = (limn_morph_targets){POINTS, TARGETS, m->first, m->points, m->deltas};
}

static void test_morphs(const made *with) {
    morphs m;
    float all[POINTS * 3], parts[POINTS * 3];
    double expected[POINTS * 3];
    make_morphs(&m);
    CHECK_EQUAL(limn_morph_check(&m.targets, m.first[TARGETS], NULL), LIMN_OK);
    for (uint32_t i = 0; i < 3 * POINTS; i++)
        expected[i] = (double)with->points[i];
    for (uint32_t t = 0; t < TARGETS; t++) {
        for (uint32_t e = m.first[t]; e < m.first[t + 1]; e++) {
            for (uint32_t i = 0; i < 3; i++)
                expected[3 * m.points[e] + i] += (double)m.weights[t] * (double)m.deltas[3 * e + i];
        }
    }
    limn_morph_points(&m.targets, m.weights, with->points, 0, POINTS, all);
    for (uint32_t p = 0; p < POINTS; p++)
        CHECK_NEAR(distance(all + 3 * p, expected + 3 * p) / SIZE, 0, 1e-7);
    memset(parts, 0xa5, sizeof parts);
    for (uint32_t begin = 0, end; begin < POINTS; begin = end) {
        end = begin + 1 + random_index(20);
        if (end > POINTS) end = POINTS;
        limn_morph_points(&m.targets, m.weights, with->points, begin, end, parts);
        for (size_t b = 12 * (size_t)end; b < sizeof parts; b++)
            CHECK(((unsigned char *)parts)[b] == 0xa5);
    }
    CHECK(memcmp(all, parts, sizeof all) == 0);
}

static void expect_morph(const morphs *m, uint32_t entry_count, limn_result result, uint32_t target,
                         uint32_t entry) {
    limn_morph_place place = {~0u, ~0u};
    CHECK_EQUAL(limn_morph_check(&m->targets, entry_count, &place), result);
    CHECK_EQUAL(place.target, target);
    CHECK_EQUAL(place.entry, entry);
}

static void test_morph_check(void) {
    morphs good, m;
    make_morphs(&good);
    const uint32_t count = good.first[TARGETS];
    expect_morph(&good, count - 1, LIMN_ERROR_MORPH_POINT, TARGETS - 1, good.first[TARGETS - 1]);
#define DAMAGED(damage, result, target, entry)                                                     \
    m = good, m.targets.first = m.first, m.targets.points = m.points, m.targets.deltas = m.deltas; \
    damage;                                                                                        \
    expect_morph(&m, count, result, target, entry)
    DAMAGED(m.points[m.first[3] + 4] = POINTS, LIMN_ERROR_MORPH_POINT, 3, m.first[3] + 4);
    DAMAGED(m.points[7] = m.points[6], LIMN_ERROR_MORPH_POINT, 0, 7);
    DAMAGED(m.points[m.first[1]] = POINTS - 1, LIMN_ERROR_MORPH_POINT, 1, m.first[1] + 1);
    DAMAGED(m.first[0] = 1, LIMN_ERROR_MORPH_POINT, 0, 0);
    DAMAGED(m.first[2] = m.first[1] - 1, LIMN_ERROR_MORPH_POINT, 1, m.first[1]);
    DAMAGED(m.first[4] = 0xffffffff, LIMN_ERROR_MORPH_POINT, 3, m.first[3]);
    DAMAGED(m.deltas[3 * 11 + 2] = INFINITY, LIMN_ERROR_MORPH_DELTA, 0, 11);
#undef DAMAGED
}

// ---- What is refused

static void expect_skin(const made *m, limn_result result, uint32_t point, uint32_t influence) {
    limn_skin_place place = {~0u, ~0u};
    CHECK_EQUAL(limn_skin_check(&m->skin, &place), result);
    CHECK_EQUAL(limn_skin_check(&m->skin, NULL), result);
    CHECK_EQUAL(place.point, point);
    CHECK_EQUAL(place.influence, influence);
}

static void test_skin_check(const made *good) {
    static made m;
    const uint32_t count = good->skin.influence_count;
#define DAMAGED(damage, result, point, influence)                                                  \
    m = *good, m.skin.joints = m.joints, m.skin.weights = m.weights;                               \
    damage;                                                                                        \
    expect_skin(&m, result, point, influence)
    DAMAGED(m.skin.influence_count = 0, LIMN_ERROR_SKIN, 0, 0);
    DAMAGED(m.skin.influence_count = 9, LIMN_ERROR_SKIN, 0, 0);
    DAMAGED(m.skin.joint_count = 0, LIMN_ERROR_SKIN, 0, 0);
    DAMAGED(m.joints[17 * count + 2] = JOINTS, LIMN_ERROR_JOINT, 17, 2);
    DAMAGED(m.weights[17 * count + 1] = NAN, LIMN_ERROR_WEIGHT, 17, 1);
    DAMAGED(m.weights[17 * count + 3] = -0.25f, LIMN_ERROR_WEIGHT, 17, 3);
    DAMAGED(m.weights[17 * count] += 1e-5f, LIMN_ERROR_WEIGHT_SUM, 17, 0);
    DAMAGED(memset(m.weights + 20 * count, 0, count * sizeof(float)), LIMN_ERROR_WEIGHT_SUM, 20, 0);
#undef DAMAGED
}

static void test_normalise(void) {
    uint16_t joints[8] = {9, 4, 7, 2, 1, 1, 3, 3};
    float weights[8] = {0, 1, 3, 1, 0.25f, 0, 0.75f, 0};
    limn_skin_place place;
    CHECK_EQUAL(limn_skin_normalise(2, 4, joints, weights, NULL), LIMN_OK);
    static const uint16_t expected_joints[8] = {7, 2, 4, 7, 3, 1, 3, 3};
    static const float expected_weights[8] = {0.6f, 0.2f, 0.2f, 0, 0.75f, 0.25f, 0, 0};
    CHECK(memcmp(joints, expected_joints, sizeof joints) == 0);
    CHECK(memcmp(weights, expected_weights, sizeof weights) == 0);
    weights[4] = weights[5] = 0;
    CHECK_EQUAL(limn_skin_normalise(2, 4, joints, weights, &place), LIMN_ERROR_WEIGHT_SUM);
    CHECK(place.point == 1 && place.influence == 0);
    weights[6] = INFINITY;
    CHECK_EQUAL(limn_skin_normalise(2, 4, joints, weights, &place), LIMN_ERROR_WEIGHT);
    CHECK(place.point == 1 && place.influence == 2);
    CHECK_EQUAL(limn_skin_normalise(2, 9, joints, weights, &place), LIMN_ERROR_SKIN);
    float large[2] = {3e38f, 3e38f}, small[2] = {1e-45f, 1e-45f};
    CHECK_EQUAL(limn_skin_normalise(1, 2, joints, large, NULL), LIMN_OK);
    CHECK_EQUAL(limn_skin_normalise(1, 2, joints, small, NULL), LIMN_OK);
    CHECK(large[0] == 0.5f && small[1] == 0.5f);
}

int main(void) {
    static made m;
    for (uint32_t count = 1; count <= LIMN_INFLUENCE_MAX; count++) {
        make(&m, count);
        test_reference(&m, false);
        test_reference(&m, true);
        test_all_kernels(&m);
        test_signs(&m);
        test_not_finite(&m, count % 2);
        make(&m, count);
        test_twins(&m, false);
        test_twins(&m, true);
    }
    test_any_matrix();
    test_turns();
    test_twist();
    test_no_direction();
    test_morphs(&m);
    test_morph_check();
    make(&m, 5);
    test_skin_check(&m);
    test_normalise();
    for (int dual = 0; dual < 2; dual++)
        printf("%s: points off by %.2g of their size, normals by %.2g radians\n",
               dual ? "dual quaternions" : "linear", worst[dual][0], worst[dual][1]);
    return check_report();
}
