/* SPDX-License-Identifier: MIT */
/*
 * Several threads evaluate ranges of one plan, plan from one mesh, and move ranges of its control
 * points: the bytes are those of one thread. tests/threads_test.sh runs this under ThreadSanitizer, for which threads are plain
 * pthreads: OpenMP's library is not made for it.
 *
 *     test_threads FILE.limn            a mesh with normals
 *     test_threads FILE.limn overlap    ranges overlap: a race that must be seen
 */
#include "blob_file.h"
#include "check.h"
#include "limn/limn.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { THREADS = 4, VERTEX_SIZE = 24 };

// ---- A parallel loop

typedef struct loop {
    void (*body)(void *state, uint32_t begin, uint32_t end);
    void *state;
    uint32_t count, step, overlap;
    atomic_uint next;
} loop;

static void *take_ranges(void *argument) {
    loop *const l = argument;
    for (;;) {
        // Relaxed, so that it orders nothing and hides no race.
        const uint32_t begin = atomic_fetch_add_explicit(&l->next, l->step, memory_order_relaxed);
        if (begin >= l->count) return NULL;
        const uint32_t step = l->step + l->overlap, left = l->count - begin;
        l->body(l->state, begin, begin + (step < left ? step : left));
    }
}

static void run_loop(loop *l) {
    pthread_t threads[THREADS];
    atomic_init(&l->next, 0);
    for (int t = 0; t < THREADS; t++) {
        if (pthread_create(&threads[t], NULL, take_ranges, l) != 0) abort();
    }
    for (int t = 0; t < THREADS; t++)
        pthread_join(threads[t], NULL);
}

// ---- Evaluating

static limn_mesh mesh;
static float *control_normals;
static uint32_t overlap;

/// Positions alone; with normals, in a stream or inside; packed.
static const limn_output forms[] = {
    {.stride = 12},
    {.stride = 12, .normal_stride = 12},
    {.stride = 24, .normal_stride = 24},
    {.stride = 12,
     .normal_stride = 12,
     .position_format = LIMN_POSITION_UNORM16X4,
     .normal_format = LIMN_NORMAL_OCT16X2},
    {.stride = 12, .streaming = true},
};

enum { FORM_COUNT = sizeof forms / sizeof *forms };

static limn_output output_to(const limn_plan *plan, int form, unsigned char *bytes) {
    limn_output output = forms[form];
    output.vertices = bytes;
    if (output.normal_stride == 0) return output;
    const bool packed = output.position_format == LIMN_POSITION_UNORM16X4;
    const size_t behind = output.stride == 24 ? 12 : packed ? 8 : 12 * plan->vertex_count;
    output.normals = bytes + behind;
    output.control_normals = control_normals;
    return output;
}

typedef struct work {
    const limn_plan *plan;
    limn_output output;
} work;

static void evaluate_range(void *state, uint32_t begin, uint32_t end) {
    const work *const w = state;
    limn_evaluate(w->plan, mesh.controls, begin, end, &w->output);
}

static void test_plan(const limn_plan *plan) {
    static const uint32_t steps[] = {1, 7};
    const size_t size = (size_t)plan->vertex_count * VERTEX_SIZE;
    unsigned char *const alone = malloc(size + 1), *const together = malloc(size + 1);
    if (!alone || !together) abort();
    for (int form = 0; form < FORM_COUNT; form++) {
        memset(alone, 0, size);
        const limn_output output = output_to(plan, form, alone);
        limn_evaluate(plan, mesh.controls, 0, plan->patch_count, &output);
        for (int s = 0; s < 2; s++) {
            work w = {.plan = plan, .output = output_to(plan, form, together)};
            memset(together, 0, size);
            run_loop(&(loop){.body = evaluate_range,
                             .state = &w,
                             .count = plan->patch_count,
                             .step = steps[s],
                             .overlap = overlap});
            CHECK(memcmp(alone, together, size) == 0);
        }
    }
    free(alone);
    free(together);
}

// ---- Planning

static limn_view view_from(float away) {
    float eye[3], middle[3];
    for (int axis = 0; axis < 3; axis++) {
        middle[axis] = (mesh.bounds_min[axis] + mesh.bounds_max[axis]) / 2;
        eye[axis] = middle[axis] + away * (mesh.bounds_max[axis] - mesh.bounds_min[axis]);
    }
    return limn_view_perspective(eye, middle, (const float[]){0, 1, 0}, 0.6f, 1280, 720, 1e-3f,
                                 1e3f);
}

static void *memories[THREADS * 2];
static limn_plan plans[THREADS * 2];

static void build_plans(void *state, uint32_t begin, uint32_t end) {
    const limn_view view = view_from(1.5f);
    (void)state;
    for (uint32_t p = begin; p < end; p++)
        plans[p] = limn_plan_build(&mesh, mesh.controls, &view, 1, NULL, NULL, memories[p]);
}

/// All threads plan the same frame, each in memory of its own, of which nothing shows in the plan.
static void test_planning(void) {
    const uint32_t count = sizeof plans / sizeof *plans;
    for (uint32_t p = 0; p < count; p++)
        memset(memories[p], (int)(0x55 * p), limn_plan_size(&mesh));
    run_loop(&(loop){.body = build_plans, .count = count, .step = 1});
    const size_t size = plans[0].patch_count * sizeof *plans[0].patches;
    for (uint32_t p = 0; p < count; p++) {
        CHECK_EQUAL(plans[p].patch_count, plans[0].patch_count);
        CHECK(memcmp(plans[p].patches, plans[0].patches, size) == 0);
    }
    CHECK(plans[0].level > plans[0].patches[0].level || plans[0].level > 1);
}

// ---- Moving control points

/// Morph targets and a skin, point by point.
typedef struct motion {
    const limn_morph_targets *targets;
    const limn_pose *pose;
    float *points, *normals; ///< out
} motion;

static void move_range(void *state, uint32_t begin, uint32_t end) {
    static const float weights[1] = {0.5f};
    const motion *const m = state;
    limn_morph_points(m->targets, weights, mesh.controls, begin, end, m->points);
    limn_pose_points(m->pose, m->points, begin, end, m->points);
    limn_pose_normals(m->pose, &mesh, control_normals, begin, end, m->normals);
}

static void compare_motion(const limn_morph_targets *targets, const limn_pose *pose) {
    const uint32_t count = mesh.control_count;
    float *const arrays = calloc(count, 4 * sizeof(float[3]));
    if (!arrays) abort();
    motion alone = {targets, pose, arrays, arrays + 3 * count};
    motion together = {targets, pose, arrays + 6 * count, arrays + 9 * count};
    move_range(&alone, 0, count);
    run_loop(&(loop){.body = move_range, .state = &together, .count = count, .step = 5});
    CHECK(memcmp(alone.points, together.points, 2 * count * sizeof(float[3])) == 0);
    free(arrays);
}

/// The one target moves all points, and the one joint, too.
static void test_motion(void) {
    static const float matrix[12] = {0, -1, 0, 2, 1, 0, 0, 3, 0, 0, 1, 4};
    const uint32_t count = mesh.control_count, first[2] = {0, count};
    uint32_t *const points = calloc(count, sizeof *points);
    uint16_t *const joints = calloc(count, sizeof *joints);
    float *const weights = calloc(count, sizeof *weights);
    if (!points || !joints || !weights) abort();
    for (uint32_t p = 0; p < count; p++)
        points[p] = p, weights[p] = 1;
    const limn_morph_targets targets = {count, 1, first, points, mesh.controls};
    const limn_skin skin = {count, 1, 1, joints, weights, mesh.kernels};
    limn_dual_quaternion quaternion;
    limn_dual_quaternions_make(matrix, 1, &quaternion);
    compare_motion(&targets, &(limn_pose){.skin = &skin, .matrices = matrix});
    compare_motion(&targets, &(limn_pose){.skin = &skin, .dual_quaternions = &quaternion});
    free(points);
    free(joints);
    free(weights);
}

// ---- All kernels

static void test_kernels(uint32_t isa, limn_family family) {
    mesh.kernels = limn_kernels_select(isa, family);
    const limn_plan uniform = limn_plan_uniform(&mesh, 3);
    test_plan(&uniform);
    test_plan(&plans[0]);
    test_motion();
}

static bool open_mesh(const char *path, limni_blob_file *file) {
    char error[512];
    limn_pack pack;
    if (!limni_blob_file_open(file, path, error, sizeof error)) return false;
    if (limn_pack_open(&pack, file->bytes, file->size) != LIMN_OK) return false;
    mesh = limn_pack_mesh(&pack, 0);
    control_normals = malloc(mesh.normal_count * 3 * sizeof(float));
    for (uint32_t p = 0; p < sizeof plans / sizeof *plans; p++) {
        memories[p] = malloc(limn_plan_size(&mesh));
        if (!memories[p]) return false;
    }
    if (!control_normals || !mesh.normals) return false;
    limn_mesh_control_normals(&mesh, mesh.controls, control_normals);
    return true;
}

int main(int argc, char **argv) {
    limni_blob_file file = {0};
    if (!CHECK(argc >= 2 && open_mesh(argv[1], &file))) return check_report();
    overlap = argc > 2 && strcmp(argv[2], "overlap") == 0;
    test_planning();
    for (uint32_t isa = 1; isa <= LIMN_ISA_NEON; isa *= 2) {
        if (!(limn_isa_supported() & isa)) continue;
        test_kernels(isa, LIMN_FAMILY_REPRODUCIBLE);
        test_kernels(isa, LIMN_FAMILY_FAST);
    }
    for (uint32_t p = 0; p < sizeof plans / sizeof *plans; p++)
        free(memories[p]);
    free(control_normals);
    limni_blob_file_close(&file);
    return check_report();
}
