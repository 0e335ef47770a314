/* SPDX-License-Identifier: MIT */
/*
 * Evaluates one plan with several threads: OpenMP hands out ranges of patches, each of which is
 * written to a place of its own, so there is nothing to wait for and nothing to lock. Prints the
 * speed with 1 to N threads, and checks that the bytes do not depend on their number.
 *
 *     limn_example_threads FILE.limn
 */
#include <limn/limn.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RANGE = 64 }; ///< patches: a few microseconds

static void evaluate(const limn_plan *plan, const limn_output *output, int thread_count) {
#pragma omp parallel for num_threads(thread_count) schedule(dynamic)
    for (uint32_t begin = 0; begin < plan->patch_count; begin += RANGE) {
        const uint32_t left = plan->patch_count - begin;
        limn_evaluate(plan, plan->mesh->controls, begin, begin + (left < RANGE ? left : RANGE),
                      output);
    }
}

/// Vertices per second: the best of several frames.
static double measure(const limn_plan *plan, const limn_output *output, int thread_count) {
    double best = 1e9;
    for (int frame = 0; frame < 50; frame++) {
        const double start = omp_get_wtime();
        evaluate(plan, output, thread_count);
        const double elapsed = omp_get_wtime() - start;
        if (elapsed < best) best = elapsed;
    }
    return (double)plan->vertex_count / best;
}

/// False if the number of threads makes a difference.
static bool compare(const limn_plan *plan) {
    const size_t size = (size_t)plan->vertex_count * 3 * sizeof(float);
    limn_output alone = {.vertices = malloc(size)}, together = {.vertices = malloc(size)};
    bool equal = alone.vertices && together.vertices;
    if (equal) limn_evaluate(plan, plan->mesh->controls, 0, plan->patch_count, &alone);
    for (int threads = 1; threads <= omp_get_max_threads() && equal; threads++) {
        memset(together.vertices, 0xff, size);
        const double speed = measure(plan, &together, threads);
        equal = memcmp(alone.vertices, together.vertices, size) == 0;
        printf("%2d threads: %8.1f million vertices/s%s\n", threads, speed / 1e6,
               equal ? "" : ", DIFFERENT BYTES");
    }
    free(alone.vertices);
    free(together.vertices);
    return equal;
}

/// What a camera before the mesh sees of it: levels of detail by length on the screen.
static limn_plan plan_frame(const limn_mesh *mesh, void *memory) {
    float middle[3], eye[3];
    for (int axis = 0; axis < 3; axis++)
        middle[axis] = eye[axis] = (mesh->bounds_min[axis] + mesh->bounds_max[axis]) / 2;
    const float size = mesh->bounds_max[1] - mesh->bounds_min[1] + mesh->bounds_max[2] -
                       mesh->bounds_min[2]; // never 0 for a surface
    eye[2] += 2 * size;
    const limn_view view = limn_view_perspective(eye, middle, (const float[]){0, 1, 0}, 0.7f, 1280,
                                                 720, size / 100, size * 100);
    return limn_plan_build(mesh, mesh->controls, &view, 1, NULL, NULL, memory);
}

/// The whole file, on a multiple of 64 bytes; NULL if it cannot be read.
static void *read_file(const char *path, size_t *size) {
    FILE *const file = fopen(path, "rb");
    if (!file) return NULL;
    const long length = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    *size = length < 0 ? 0 : (size_t)length;
    void *const blob = aligned_alloc(64, *size / 64 * 64 + 64);
    rewind(file);
    const bool good = blob && fread(blob, 1, *size, file) == *size;
    fclose(file);
    if (good) return blob;
    free(blob);
    return NULL;
}

static bool run(const void *blob, size_t size) {
    limn_pack pack;
    const limn_result result = limn_pack_open(&pack, blob, size);
    if (result != LIMN_OK) {
        fprintf(stderr, "limn_example_threads: %s\n", limn_result_text(result));
        return false;
    }
    if (pack.mesh_count == 0) return true;
    const limn_mesh mesh = limn_pack_mesh(&pack, 0);
    const limn_plan uniform = limn_plan_uniform(&mesh, LIMN_LEVEL_MAX);
    void *const memory = malloc(limn_plan_size(&mesh));
    if (!memory) return false;
    const limn_plan mixed = plan_frame(&mesh, memory);
    printf("%u patches at level 4\n", uniform.patch_count);
    bool equal = compare(&uniform);
    printf("%u patches at levels up to %u\n", mixed.patch_count, mixed.level);
    equal = compare(&mixed) && equal;
    free(memory);
    return equal;
}

int main(int argc, char **argv) {
    size_t size;
    void *const blob = argc == 2 ? read_file(argv[1], &size) : NULL;
    if (!blob) {
        fprintf(stderr,
                argc == 2 ? "limn_example_threads: %s: cannot be read\n"
                          : "usage: limn_example_threads FILE.limn\n",
                argc == 2 ? argv[1] : "");
        return argc == 2 ? 1 : 2;
    }
    const bool good = run(blob, size);
    free(blob);
    return good ? 0 : 1;
}
