/* SPDX-License-Identifier: MIT */
/*
 * Meshes in motion: the meshes of the project with skeletons made up for them, isolated and not.
 * Control points are where double precision puts them, surfaces and normals stay watertight by
 * bits, and every kernel gives the same; rotated normals are wrong where Brickhill's Figure 6 says
 * so, and those of the moved mesh are right.
 */
#include "check.h"
#include "limn/bake.h"
#include "shared_edges.h"
#include "skin_reference.h"

#include <stdlib.h>

enum { JOINTS = 9 };

typedef struct subject {
    limn_baker *baker;
    limn_mesh mesh;
    double diagonal;
    limn_skin skin;
    uint16_t *joints;
    float *weights;
    joint motions[JOINTS];
    float matrices[JOINTS * 12];
    limn_dual_quaternion quaternions[JOINTS];
    float *controls;        ///< [point_count][3]
    float *control_normals; ///< [normal_count][3]
} subject;

static void *allocate(size_t count, size_t size) {
    void *const memory = calloc(count ? count : 1, size);
    if (!memory) abort();
    return memory;
}

static void create(subject *s, limn_isolate isolate) {
    s->baker =
        limn_baker_create(&(limn_bake_desc){.normals = LIMN_NORMALS_EXACT, .isolate = isolate});
    if (!s->baker) abort();
}

static bool open_baked(subject *s, limn_bake_status added) {
    const void *blob;
    size_t size;
    limn_pack pack;
    if (!CHECK_EQUAL(added, LIMN_BAKE_OK)) return false;
    if (!CHECK_EQUAL(limn_baker_finish(s->baker, &blob, &size), LIMN_BAKE_OK)) return false;
    if (!CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK)) return false;
    s->mesh = limn_pack_mesh(&pack, 0);
    double squares = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double extent = (double)s->mesh.bounds_max[axis] - (double)s->mesh.bounds_min[axis];
        squares += extent * extent;
    }
    s->diagonal = sqrt(squares);
    s->controls = allocate(s->mesh.point_count, sizeof(float[3]));
    s->control_normals = allocate(s->mesh.normal_count, sizeof(float[3]));
    return true;
}

static void destroy(subject *s) {
    limn_baker_destroy(s->baker);
    free(s->joints);
    free(s->weights);
    free(s->controls);
    free(s->control_normals);
}

// ---- Skeletons

static void turn_around(const double axis[3], double angle, quaternion q) {
    for (int i = 0; i < 3; i++)
        q[i] = axis[i] * sin(angle / 2);
    q[3] = cos(angle / 2);
}

/// Joints up the middle of the mesh, each of which turns by 0.35 radians more than the one below,
/// and grows a little.
static void make_skeleton(subject *s) {
    static const double axis[3] = {0.36, 0.48, 0.8};
    const double none[3] = {0};
    for (int j = 0; j < JOINTS; j++) {
        joint *const motion = &s->motions[j];
        double pivot[3];
        memset(motion, 0, sizeof *motion);
        for (int i = 0; i < 3; i++) {
            const double low = (double)s->mesh.bounds_min[i], high = (double)s->mesh.bounds_max[i];
            pivot[i] = i == 1 ? low + (high - low) * j / (JOINTS - 1) : (low + high) / 2;
            motion->stretch[i][i] = 1 + 0.02 * j;
        }
        turn_around(axis, 0.35 * j, motion->rotation);
        set_pivot(motion, pivot, none);
        joint_matrix(motion, s->matrices + 12 * j);
    }
    limn_dual_quaternions_make(s->matrices, JOINTS, s->quaternions);
}

/// All joints that move a point: the nearest ones, by the inverse square of the distance in height.
static void attach(subject *s, uint32_t point, uint32_t count) {
    const double low = (double)s->mesh.bounds_min[1], high = (double)s->mesh.bounds_max[1];
    const double height = ((double)s->mesh.controls[3 * point + 1] - low) / (high - low);
    bool taken[JOINTS] = {false};
    for (uint32_t i = 0; i < count; i++) {
        int nearest = 0;
        double least = INFINITY;
        for (int j = 0; j < JOINTS; j++) {
            const double distance = fabs(height - (double)j / (JOINTS - 1));
            if (!taken[j] && distance < least) nearest = j, least = distance;
        }
        taken[nearest] = true;
        s->joints[point * count + i] = (uint16_t)nearest;
        s->weights[point * count + i] = (float)(1 / (least * least + 0.001));
    }
}

static void make_skin(subject *s, uint32_t influence_count) {
    const uint32_t count = s->mesh.control_count;
    free(s->joints);
    free(s->weights);
    s->joints = allocate((size_t)count * influence_count, sizeof *s->joints);
    s->weights = allocate((size_t)count * influence_count, sizeof *s->weights);
    for (uint32_t point = 0; point < count; point++)
        attach(s, point, influence_count);
    CHECK_EQUAL(limn_skin_normalise(count, influence_count, s->joints, s->weights, NULL), LIMN_OK);
    s->skin = (limn_skin){.point_count = count,
                          .joint_count = JOINTS,
                          .influence_count = influence_count,
                          .joints = s->joints,
                          .weights = s->weights,
                          .kernels = s->mesh.kernels};
    CHECK_EQUAL(limn_skin_check(&s->skin, NULL), LIMN_OK);
}

static limn_pose pose_of(const subject *s, bool dual) {
    return (limn_pose){.skin = &s->skin,
                       .matrices = s->matrices,
                       .dual_quaternions = dual ? s->quaternions : NULL};
}

// ---- Where control points are

static double distance(const float *a, const double *b) {
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(square);
}

static double worst_error;

static void check_points(subject *s, bool dual) {
    const limn_pose pose = pose_of(s, dual);
    const float *const points = s->mesh.controls;
    limn_pose_points(&pose, points, 0, s->skin.point_count, s->controls);
    for (uint32_t p = 0; p < s->skin.point_count; p++) {
        double expected[3];
        if (dual) {
            blend_dual(&s->skin, s->motions, p, points + 3 * p, 1, expected);
        } else {
            blend_linear(&s->skin, s->matrices, p, points + 3 * p, 1, expected);
        }
        const double error = distance(s->controls + 3 * p, expected) / s->diagonal;
        CHECK_NEAR(error, 0, 1e-6);
        worst_error = fmax(worst_error, error);
    }
}

// ---- Watertight

/// One frame, as a game would make it, with given kernels.
static vertex *make_frame(subject *s, bool dual, const limn_kernels *kernels) {
    const limn_pose pose = pose_of(s, dual);
    s->mesh.kernels = s->skin.kernels = kernels;
    limn_pose_points(&pose, s->mesh.controls, 0, s->skin.point_count, s->controls);
    limn_mesh_refine(&s->mesh, s->controls);
    limn_mesh_control_normals(&s->mesh, s->controls, s->control_normals);
    const limn_plan plan = limn_plan_uniform(&s->mesh, LIMN_LEVEL_MAX);
    vertex *const vertices = allocate((size_t)plan.vertex_count, sizeof *vertices);
    limn_evaluate(&plan, s->controls, 0, plan.patch_count,
                  &(limn_output){.vertices = vertices,
                                 .stride = sizeof *vertices,
                                 .normals = vertices->normal,
                                 .normal_stride = sizeof *vertices,
                                 .control_normals = s->control_normals});
    return vertices;
}

static void check_frames(subject *s, bool dual) {
    const limn_plan plan = limn_plan_uniform(&s->mesh, LIMN_LEVEL_MAX);
    vertex *const expected =
        make_frame(s, dual, limn_kernels_select(LIMN_ISA_SCALAR, LIMN_FAMILY_REPRODUCIBLE));
    CHECK(check_shared_edges(&plan, expected) > s->mesh.patch_count);
    vertex *const same =
        make_frame(s, dual, limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_REPRODUCIBLE));
    CHECK(memcmp(expected, same, (size_t)plan.vertex_count * sizeof *same) == 0);
    vertex *const fast = make_frame(s, dual, limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_FAST));
    check_shared_edges(&plan, fast);
    free(expected);
    free(same);
    free(fast);
}

static void test_mesh(const char *name, limn_isolate isolate) {
    char path[4096];
    subject s = {0};
    snprintf(path, sizeof path, "%s/%s", getenv("LIMN_ASSETS"), name);
    create(&s, isolate);
    if (open_baked(&s, limn_baker_add_file(s.baker, path))) {
        make_skeleton(&s);
        for (uint32_t count = 1; count <= LIMN_INFLUENCE_MAX; count++) {
            make_skin(&s, count);
            check_points(&s, false);
            check_points(&s, true);
        }
        make_skin(&s, 4);
        check_frames(&s, false);
        check_frames(&s, true);
    }
    destroy(&s);
}

// ---- Figure 6

/// A tube along x with points at its ends.
enum { RINGS = 9, AROUND = 8, TUBE_POINTS = RINGS * AROUND + 2, TUBE_FACES = 2 * RINGS * AROUND };

static float tube_points[TUBE_POINTS][3];
static uint32_t tube_faces[TUBE_FACES][3];

static uint32_t tube_point(int ring, int around) {
    if (ring < 0) return TUBE_POINTS - 2;
    if (ring >= RINGS) return TUBE_POINTS - 1;
    return (uint32_t)(ring * AROUND + around % AROUND);
}

static void make_tube(void) {
    uint32_t face = 0;
    for (int ring = 0; ring < RINGS; ring++) {
        for (int k = 0; k < AROUND; k++) {
            const double angle = 6.283185307179586 * k / AROUND;
            float *const point = tube_points[tube_point(ring, k)];
            point[0] = (float)ring;
            point[1] = (float)cos(angle);
            point[2] = (float)sin(angle);
        }
    }
    tube_points[tube_point(-1, 0)][0] = -0.5f;
    tube_points[tube_point(RINGS, 0)][0] = RINGS - 0.5f;
    for (int ring = -1; ring < RINGS; ring++) {
        for (int k = 0; k < AROUND; k++) {
            const uint32_t a = tube_point(ring, k), b = tube_point(ring, k + 1);
            const uint32_t c = tube_point(ring + 1, k), d = tube_point(ring + 1, k + 1);
            if (ring >= 0) memcpy(tube_faces[face++], (uint32_t[]){a, b, c}, sizeof *tube_faces);
            if (ring + 1 < RINGS)
                memcpy(tube_faces[face++], (uint32_t[]){b, d, c}, sizeof *tube_faces);
        }
    }
    CHECK_EQUAL(face, (uint32_t)TUBE_FACES);
}

/// The neighbour of `centre` that follows `from` counter-clockwise.
static uint32_t next_around(uint32_t centre, uint32_t from) {
    for (uint32_t h = 0; h < 3 * TUBE_FACES; h++) {
        const uint32_t *const face = tube_faces[h / 3];
        if (face[h % 3] == centre && face[(h + 1) % 3] == from) return face[(h + 2) % 3];
    }
    return ~0u;
}

static uint32_t any_neighbour(uint32_t centre) {
    for (uint32_t h = 0; h < 3 * TUBE_FACES; h++) {
        if (tube_faces[h / 3][h % 3] == centre) return tube_faces[h / 3][(h + 1) % 3];
    }
    return ~0u;
}

/// The normal of the limit surface: Loop's tangents, in doubles.
static void true_normal(const float *controls, uint32_t centre, double normal[3]) {
    uint32_t ring[TUBE_POINTS], count = 0;
    double a[3] = {0}, b[3] = {0}, length = 0;
    for (uint32_t at = any_neighbour(centre); count == 0 || at != ring[0];) {
        ring[count++] = at;
        at = next_around(centre, at);
    }
    for (uint32_t k = 0; k < count; k++) {
        const double angle = 6.283185307179586 * k / count;
        for (int i = 0; i < 3; i++) {
            a[i] += cos(angle) * (double)controls[3 * ring[k] + (uint32_t)i];
            b[i] += sin(angle) * (double)controls[3 * ring[k] + (uint32_t)i];
        }
    }
    for (int i = 0; i < 3; i++) {
        normal[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
        length += normal[i] * normal[i];
    }
    for (int i = 0; i < 3; i++)
        normal[i] /= sqrt(length);
}

/// In radians.
static double worst_angle(const float *controls, const float *normals) {
    double worst = 0;
    for (uint32_t point = 0; point < TUBE_POINTS; point++) {
        double expected[3];
        true_normal(controls, point, expected);
        worst = fmax(worst, 2 * asin(fmin(1, distance(normals + 3 * point, expected) / 2)));
    }
    return worst;
}

/// Two joints: the second has the weights given and turns around z, at the middle, by `angle`.
static void attach_tube(subject *s, const float weights_of_rings[RINGS], double angle) {
    static const double z_axis[3] = {0, 0, 1}, pivot[3] = {4, 0, 0}, none[3] = {0};
    make_skin(s, 2);
    for (uint32_t p = 0; p < TUBE_POINTS; p++) {
        const uint32_t ring = p == tube_point(-1, 0) ? 0
                              : p / AROUND < RINGS   ? p / AROUND
                                                     : RINGS - 1;
        s->joints[2 * p] = 0, s->joints[2 * p + 1] = 1;
        s->weights[2 * p] = 1 - weights_of_rings[ring];
        s->weights[2 * p + 1] = weights_of_rings[ring];
    }
    for (int j = 0; j < 2; j++) {
        memset(&s->motions[j], 0, sizeof s->motions[j]);
        for (int i = 0; i < 3; i++)
            s->motions[j].stretch[i][i] = 1;
        turn_around(z_axis, j * angle, s->motions[j].rotation);
        set_pivot(&s->motions[j], pivot, none);
        joint_matrix(&s->motions[j], s->matrices + 12 * j);
    }
    limn_dual_quaternions_make(s->matrices, 2, s->quaternions);
}

/// By how many degrees normals are off that are rotated, at least, and that the others are not.
static void test_tube(const float weights_of_rings[RINGS], bool dual, double least) {
    const double degrees = 57.29577951308232;
    const limn_bake_mesh tube = {.name = "tube",
                                 .positions = tube_points[0],
                                 .position_count = TUBE_POINTS,
                                 .face_count = TUBE_FACES,
                                 .face_indices = tube_faces[0]};
    subject s = {0};
    create(&s, LIMN_ISOLATE_NEVER);
    if (!open_baked(&s, limn_baker_add_mesh(s.baker, &tube))) return;
    attach_tube(&s, weights_of_rings, 90 / degrees);
    const limn_pose pose = pose_of(&s, dual);
    limn_mesh_control_normals(&s.mesh, s.mesh.controls, s.control_normals);
    CHECK(worst_angle(s.mesh.controls, s.control_normals) < 1e-5);
    limn_pose_points(&pose, s.mesh.controls, 0, TUBE_POINTS, s.controls);
    limn_pose_normals(&pose, &s.mesh, s.control_normals, 0, s.mesh.normal_count, s.control_normals);
    const double rotated = worst_angle(s.controls, s.control_normals) * degrees;
    limn_mesh_control_normals(&s.mesh, s.controls, s.control_normals);
    const double recomputed = worst_angle(s.controls, s.control_normals) * degrees;
    printf("tube, %s: rotated normals are off by %.1f degrees, recomputed ones by %.2g\n",
           dual ? "dual quaternions" : "linear", rotated, recomputed);
    CHECK(rotated > least);
    CHECK(recomputed < 1e-3);
    destroy(&s);
}

int main(void) {
    static const char *const names[] = {"imp.obj", "torus32.obj"};
    for (int n = 0; n < 2; n++) {
        test_mesh(names[n], LIMN_ISOLATE_NEVER);
        test_mesh(names[n], LIMN_ISOLATE_ALWAYS);
    }
    printf("points off by %.2g of the diagonal\n", worst_error);
    make_tube();
    static const float of_a_ring[RINGS] = {0, 0, 0, 0, 1, 0, 0, 0, 0};
    static const float of_an_elbow[RINGS] = {0, 0, 0, 0.2f, 0.5f, 0.8f, 1, 1, 1};
    test_tube(of_a_ring, false, 60);
    test_tube(of_a_ring, true, 60);
    test_tube(of_an_elbow, false, 20);
    test_tube(of_an_elbow, true, 20);
    return check_report();
}
