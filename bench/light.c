/* SPDX-License-Identifier: MIT */
/* Light on vertices, beside their evaluation. */
#include "bench.h"
#include "mixes.h"
#include "steps.h"

#include <stdlib.h>

static const char help[] =
    "Usage: limn-bench light [OPTIONS] [MESH]...\n\n"
    "Evaluates all faces of a mesh, one by one into the same memory, with light and without, at\n"
    "levels 4, 2 and 0: meshes to bake or .limn files with normals, or without any a torus of\n"
    "valence 6. Each figure is the median of --rounds samples, and each share the median of the\n"
    "shares in them.\n\n"
    "  ns           per vertex, of position and colour, 16 bytes\n"
    "  / positions  of the time for positions alone\n\n"
    "Options:\n"
    "  --isa NAME     scalar, sse2, avx2 or neon (default: the best)\n"
    "  --rounds N     samples of each figure (default 15)\n"
    "  --quick        3 rounds of short samples\n"
    "  --csv FILE     writes all figures\n";

enum { TORUS_SIDE = 64, LIGHT_MAX = 8 };

/// What is measured; with normals, those are written, too.
typedef struct step {
    const char *name;
    bool normals, colours;
    limn_light_mode mode;
    uint32_t light_count;
    limn_light_kind kind; ///< of all lights
} step;

static const step steps[] = {
    {.name = "positions"},
    {.name = "and normals", .normals = true},
    {.name = "ambient", .colours = true},
    {"1 directional", false, true, LIMN_LIGHT_INTERPOLATED, 1, LIMN_LIGHT_DIRECTIONAL},
    {"1 point", false, true, LIMN_LIGHT_INTERPOLATED, 1, LIMN_LIGHT_POINT},
    {"1 spot", false, true, LIMN_LIGHT_INTERPOLATED, 1, LIMN_LIGHT_SPOT},
    {"4 spots", false, true, LIMN_LIGHT_INTERPOLATED, 4, LIMN_LIGHT_SPOT},
    {"8 spots", false, true, LIMN_LIGHT_INTERPOLATED, 8, LIMN_LIGHT_SPOT},
    {"1 directional, exact", false, true, LIMN_LIGHT_EXACT, 1, LIMN_LIGHT_DIRECTIONAL},
    {"1 point, exact", false, true, LIMN_LIGHT_EXACT, 1, LIMN_LIGHT_POINT},
    {"1 spot, exact", false, true, LIMN_LIGHT_EXACT, 1, LIMN_LIGHT_SPOT},
    {"4 spots, exact", false, true, LIMN_LIGHT_EXACT, 4, LIMN_LIGHT_SPOT},
    {"8 spots, exact", false, true, LIMN_LIGHT_EXACT, 8, LIMN_LIGHT_SPOT},
};

enum { STEP_COUNT = sizeof steps / sizeof *steps };

/// A mesh, and memory for one patch of it.
typedef struct subject {
    bench_mix mix;
    float *vertices; ///< [row_count][7]
    limn_light lights[LIGHT_MAX];
} subject;

/// Around the middle of the mesh, with attenuation and a range.
static void place_lights(subject *s, limn_light_kind kind) {
    const limn_mesh *const mesh = &s->mix.mesh;
    for (int i = 0; i < LIGHT_MAX; i++) {
        const int axis = i % 3;
        const float side = i % 2 ? 1.0f : -1.0f;
        const float size = mesh->bounds_max[axis] - mesh->bounds_min[axis] + 1e-3f;
        limn_light light = {.kind = kind,
                            .colour = {0.3f, 0.2f, 0.1f},
                            .attenuation = {1, 1 / size, 1 / (size * size)},
                            .range = 4 * size,
                            .inner_cosine = 0.95f,
                            .outer_cosine = 0.8f};
        for (int k = 0; k < 3; k++)
            light.position[k] = (mesh->bounds_min[k] + mesh->bounds_max[k]) / 2;
        light.position[axis] += side * size;
        light.direction[axis] = -side;
        s->lights[i] = light;
    }
}

static void run(const subject *s, const step *which, uint32_t level) {
    const limn_mesh *const mesh = &s->mix.mesh;
    const limn_plan plan = limn_plan_uniform(mesh, level);
    const uint32_t words = 3 + (which->colours ? 1u : 0u) + (which->normals ? 3u : 0u);
    const limn_lighting lighting = {.mode = which->mode,
                                    .ambient = {0.1f, 0.1f, 0.1f},
                                    .lights = s->lights,
                                    .light_count = which->light_count};
    for (uint32_t patch = 0; patch < plan.patch_count; patch++) {
        const uintptr_t skipped = (uintptr_t)limn_plan_first_vertex(&plan, patch) * words * 4;
        float *const vertices = (float *)((uintptr_t)s->vertices - skipped);
        limn_evaluate(&plan, mesh->controls, patch, patch + 1,
                      &(limn_output){.vertices = vertices,
                                     .stride = words * 4,
                                     .normals = which->normals ? vertices + 3 : NULL,
                                     .normal_stride = words * 4,
                                     .colours = which->colours ? vertices + 3 : NULL,
                                     .colour_stride = words * 4,
                                     .lighting = &lighting,
                                     .control_normals = s->mix.control_normals});
    }
}

/// Seconds that one step takes.
static double sample(subject *s, const step *which, uint32_t level, double least_seconds) {
    uint32_t runs = 0;
    double elapsed;
    place_lights(s, which->kind);
    run(s, which, level); // the one before has emptied the caches
    const double start = bench_thread_seconds();
    do {
        run(s, which, level);
        runs++;
        elapsed = bench_thread_seconds() - start;
    } while (elapsed < least_seconds);
    return elapsed / runs;
}

/// Prints one step, and reorders its samples.
static void print_step(const subject *s, const step *which, uint32_t level, double *samples,
                       const double *positions, uint32_t rounds, FILE *csv) {
    const limn_mesh *const mesh = &s->mix.mesh;
    const double vertex_count = (double)limn_plan_uniform(mesh, level).vertex_count;
    double shares[BENCH_ROUND_MAX];
    for (uint32_t round = 0; round < rounds; round++)
        shares[round] = samples[round] / positions[round];
    const double share = bench_median(shares, rounds);
    const double ns = 1e9 * bench_median(samples, rounds) / vertex_count;
    printf("%-24s %10.3f %12.3f\n", which->name, ns, share);
    if (csv)
        fprintf(csv, "%s,%s,%u,\"%s\",%.4f,%.4f\n", s->mix.name, limn_kernels_name(mesh->kernels),
                level, which->name, ns, share);
}

static void measure(subject *s, uint32_t level, const bench_steps_options *o, FILE *csv) {
    static double samples[STEP_COUNT][BENCH_ROUND_MAX], positions[BENCH_ROUND_MAX];
    for (uint32_t round = 0; round < o->rounds; round++) {
        for (int i = 0; i < STEP_COUNT; i++)
            samples[i][round] = sample(s, &steps[i], level, o->sample_seconds);
        positions[round] = samples[0][round];
    }
    printf("\n%s: %u faces, level %u, %s\n%-24s %10s %12s\n", s->mix.name, s->mix.mesh.patch_count,
           level, limn_kernels_name(s->mix.mesh.kernels), "step", "ns", "/ positions");
    for (int i = 0; i < STEP_COUNT; i++)
        print_step(s, &steps[i], level, samples[i], positions, o->rounds, csv);
}

/// `path` NULL: a torus.
static bool bench_mesh(const char *path, const bench_steps_options *o, FILE *csv) {
    static subject s;
    s = (subject){0};
    if (!(path ? bench_mix_file(&s.mix, path, (bench_way){0})
               : bench_mix_regular(&s.mix, TORUS_SIDE, (bench_way){0})))
        return false;
    limn_mesh *const mesh = &s.mix.mesh;
    mesh->kernels = limn_kernels_select(o->isa, LIMN_FAMILY_REPRODUCIBLE);
    s.vertices = malloc(mesh->domain->row_counts[LIMN_LEVEL_MAX] * sizeof(float[7]));
    const bool good = s.vertices && mesh->normals;
    if (good) {
        for (int level = LIMN_LEVEL_MAX; level >= 0; level -= 2)
            measure(&s, (uint32_t)level, o, csv);
    } else {
        fprintf(stderr, "limn-bench: %s: %s\n", s.mix.name,
                mesh->normals ? "out of memory" : "bake it with --normals exact");
    }
    free(s.vertices);
    bench_mix_destroy(&s.mix);
    return good;
}

int bench_light(int argc, char **argv) {
    static const bench_steps these = {
        .help = help, .columns = "mesh,isa,level,step,ns_per_vertex,share", .measure = bench_mesh};
    return bench_steps_run(argc, argv, &these);
}
