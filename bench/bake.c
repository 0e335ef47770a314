/* SPDX-License-Identifier: MIT */
/*
 * limn-bench bake: how long a mesh takes to bake, from the file on disk to the blob in memory, and
 * what is stored. Every mesh is baked in a process of its own, so that the peak of its memory can
 * be seen.
 */
#include "arguments.h"
#include "bench.h"

#include "limn/bake.h"
#include "limn/format.h"
#include "limn/limn.h"

#ifdef BENCH_WITH_OPENSUBDIV
#include "opensubdiv.h"
#endif

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const char help[] =
    "Usage: limn-bench bake [--grid N] [MESH...]\n\n"
    "Bakes a grid of about a million faces and every MESH (.obj, .off), each three times in a "
    "process\n"
    "of its own, and prints medians: seconds from file to blob, peak memory, bytes per face of "
    "patch\n"
    "records and indices, with the stencil tables, and of OpenSubdiv's limit stencils for level 4 "
    "(one\n"
    "per distinct vertex, positions only; 0: built without OpenSubdiv, or the grid).\n\n"
    "Options:\n"
    "  --grid N   squares along an edge of the grid (default 707: 999,698 faces); 0: no grid\n";

enum { RUNS = 3, GRID_MAX = 6000 }; // squares: some 3 GiB of positions and indices

typedef struct outcome {
    double seconds;
    uint32_t face_count, class_count;
    uint64_t patch_size, table_size;
    uint64_t stencil_size; ///< of OpenSubdiv; 0 if it was not asked
} outcome;

/// A wavy grid of triangles, in memory.
static limn_bake_mesh make_grid(uint32_t squares) {
    const uint32_t points = squares + 1;
    float *const positions = malloc((size_t)points * points * 3 * sizeof *positions);
    uint32_t *const indices = malloc((size_t)squares * squares * 6 * sizeof *indices);
    float *position = positions;
    uint32_t *index = indices;
    for (uint32_t y = 0; y < points && positions && indices; y++) {
        for (uint32_t x = 0; x < points; x++) {
            *position++ = (float)x;
            *position++ = (float)y;
            *position++ = (float)(x * 7 % 13 + y * 5 % 11) / 8;
            if (x == squares || y == squares) continue;
            const uint32_t a = y * points + x;
            const uint32_t square[6] = {a, a + 1, a + points + 1, a, a + points + 1, a + points};
            memcpy(index, square, sizeof square);
            index += 6;
        }
    }
    return (limn_bake_mesh){.name = "grid",
                            .positions = positions,
                            .position_count = points * points,
                            .face_count = 2 * squares * squares,
                            .face_indices = indices};
}

/// What OpenSubdiv stores for the same surface: one limit stencil per distinct vertex of level 4.
static uint64_t measure_stencils(const limn_mesh *mesh) {
#ifdef BENCH_WITH_OPENSUBDIV
    uint32_t(*const faces)[3] = malloc(mesh->patch_count * sizeof *faces);
    char error[256];
    for (uint32_t patch = 0; patch < mesh->patch_count && faces; patch++) {
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(mesh, patch, corners);
        memcpy(faces[patch], corners, sizeof *faces);
    }
    const limni_opensubdiv_mesh same = {.positions = mesh->controls,
                                        .faces = faces[0],
                                        .position_count = mesh->control_count,
                                        .face_count = mesh->patch_count,
                                        .level = LIMN_LEVEL_MAX};
    limni_opensubdiv_stencils stencils = {0};
    if (!limni_opensubdiv_stencil_bytes(&same, true, &stencils, error, sizeof error))
        fprintf(stderr, "limn-bench: OpenSubdiv: %s\n", error);
    free(faces);
    return stencils.byte_count;
#else
    (void)mesh;
    return 0;
#endif
}

static void measure_sizes(const void *blob, size_t size, bool with_stencils, outcome *result) {
    limn_pack pack;
    if (limn_pack_open(&pack, blob, size) != LIMN_OK) exit(1);
    const limn_mesh mesh = limn_pack_mesh(&pack, 0);
    result->face_count = mesh.patch_count;
    result->class_count = pack.class_count;
    result->patch_size =
        mesh.run_count * sizeof(limn_file_run) + mesh.patch_count * sizeof(uint32_t);
    for (uint32_t c = 0; c < pack.class_count; c++)
        result->table_size += limn_file_table_size(&mesh.classes[c]) * sizeof(float);
    for (uint32_t r = 0; r < mesh.run_count; r++) {
        const limn_file_class *const class = &mesh.classes[mesh.runs[r].class_index];
        result->patch_size += (uint64_t)mesh.runs[r].patch_count * class->control_count *
                              (4 + limn_file_slot_size(class));
    }
    if (with_stencils) result->stencil_size = measure_stencils(&mesh);
}

/// One bake; `path` NULL means the grid. Runs in the child.
static outcome bake_once(const char *path, uint32_t squares, bool with_stencils) {
    outcome result = {0};
    const void *blob;
    size_t size;
    limn_bake_mesh grid = {0};
    if (!path) grid = make_grid(squares);
    const double start = bench_seconds();
    limn_baker *const baker = limn_baker_create(
        &(limn_bake_desc){.repair = LIMN_REPAIR_ALL, .non_manifold = LIMN_NON_MANIFOLD_SPLIT});
    if (!baker ||
        (path ? limn_baker_add_file(baker, path) : limn_baker_add_mesh(baker, &grid)) !=
            LIMN_BAKE_OK ||
        limn_baker_finish(baker, &blob, &size) != LIMN_BAKE_OK) {
        fprintf(stderr, "limn-bench: %s\n", baker ? limn_baker_error(baker) : "out of memory");
        exit(1);
    }
    result.seconds = bench_seconds() - start;
    measure_sizes(blob, size, with_stencils, &result);
    limn_baker_destroy(baker);
    return result;
}

/// Bakes in a child and reads back its outcome and its peak memory in KiB.
static bool bake_in_child(const char *path, uint32_t squares, bool with_stencils, outcome *result,
                          long *peak) {
    int ends[2], status;
    if (pipe(ends) != 0) return false;
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        const outcome made = bake_once(path, squares, with_stencils);
        _exit(write(ends[1], &made, sizeof made) == (ssize_t)sizeof made ? 0 : 1);
    }
    close(ends[1]);
    const bool got = read(ends[0], result, sizeof *result) == (ssize_t)sizeof *result;
    close(ends[0]);
    struct rusage usage;
    if (child < 0 || wait4(child, &status, 0, &usage) < 0) return false;
    *peak = usage.ru_maxrss;
    return got && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static bool bench_mesh(const char *path, uint32_t squares) {
    double seconds[RUNS];
    outcome result = {0};
    long peak = 0;
    for (int run = 0; run < RUNS; run++) {
        if (!bake_in_child(path, squares, false, &result, &peak)) return false;
        seconds[run] = result.seconds;
    }
    // OpenSubdiv takes some 60 KB a face, in a process of its own.
    outcome stencils = {0};
    long stencil_peak;
    if (path && !bake_in_child(path, squares, true, &stencils, &stencil_peak)) return false;
    const char *const slash = path ? strrchr(path, '/') : NULL;
    const double faces = result.face_count;
    printf("%-28s %9u %8u %9.3f %9.1f %12.1f %13llu %14.1f %14.1f\n",
           path ? (slash ? slash + 1 : path) : "grid", result.face_count, result.class_count,
           bench_median(seconds, RUNS), (double)peak / 1024, (double)result.patch_size / faces,
           (unsigned long long)result.table_size,
           (double)(result.patch_size + result.table_size) / faces,
           (double)stencils.stencil_size / faces);
    return true;
}

static bool parse_option(int option, void *squares) {
    return option == 'g' && bench_parse_range(optarg, 0, GRID_MAX, squares);
}

int bench_bake(int argc, char **argv) {
    static const struct option options[] = {
        {"grid", required_argument, NULL, 'g'}, {"help", no_argument, NULL, 'h'}, {0}};
    uint32_t squares = 707;
    const int status = bench_read_options(argc, argv, help, options, parse_option, &squares);
    if (status >= 0) return status;
    bench_print_conditions(stdout);
    printf("%-28s %9s %8s %9s %9s %12s %13s %14s %14s\n", "mesh", "faces", "classes", "seconds",
           "peak MiB", "patch B/face", "table bytes", "all B/face", "OpenSubdiv");
    bool good = squares == 0 || bench_mesh(NULL, squares);
    for (int i = optind; i < argc; i++)
        good &= bench_mesh(argv[i], 0);
    return good ? 0 : 1;
}
