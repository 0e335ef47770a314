/* SPDX-License-Identifier: MIT */
/* What moving the control points of a character costs beside evaluating it. */
#include "bench.h"
#include "mixes.h"
#include "rig.h"
#include "steps.h"

#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: limn-bench skin [OPTIONS] [MESH...]\n\n"
    "Moves the control points of every MESH (.obj, .off, .ply: baked first; .limn: its first "
    "mesh),\n"
    "or of a regular torus of 8,192 faces, and prints for each step of a frame the median\n\n"
    "  ns          per control point\n"
    "  / level 4   of the time to evaluate positions and normals of all faces at level 4\n\n"
    "60 joints; those of a control point are near in the list of joints, as they are in a body.\n"
    "Targets move a tenth of the control points each.\n\n"
    "Options:\n"
    "  --isa NAME     scalar, sse2, avx2 or neon (default: the best)\n"
    "  --rounds N     samples of each figure (default 15)\n"
    "  --quick        3 rounds of short samples\n"
    "  --csv FILE     writes all figures\n";

enum { TORUS_SIDE = 64, JOINT_COUNT = 60, TARGET_COUNT = 10, TARGET_PART = 10 };

/// A character, and what a frame of it is made with.
typedef struct character {
    bench_mix mix;
    limn_skin skins[4]; ///< with 1, 2, 4 and 8 influences
    float matrices[JOINT_COUNT * 12];
    limn_dual_quaternion quaternions[JOINT_COUNT];
    limn_morph_targets targets;
    float target_weights[TARGET_COUNT];
    float *controls, *normals; ///< of the frame
    float *vertices;           ///< [row_count][6]: patches go to the same place, one by one
    uint32_t influences;       ///< index of the skin that is used
    bool dual;
} character;

typedef void step_fn(character *c);

typedef struct step {
    const char *name;
    step_fn *run;
    uint32_t influences;
    bool dual, when_isolated;
} step;

// -------------------------------------------------------------------------------------------------
// Steps of a frame

static limn_pose pose_of(const character *c) {
    return (limn_pose){.skin = &c->skins[c->influences],
                       .matrices = c->matrices,
                       .dual_quaternions = c->dual ? c->quaternions : NULL};
}

static void run_morphs(character *c) {
    limn_morph_points(&c->targets, c->target_weights, c->mix.mesh.controls, 0,
                      c->mix.mesh.control_count, c->controls);
}

static void run_skin(character *c) {
    const limn_pose pose = pose_of(c);
    if (c->dual) limn_dual_quaternions_make(c->matrices, JOINT_COUNT, c->quaternions);
    limn_pose_points(&pose, c->mix.mesh.controls, 0, c->mix.mesh.control_count, c->controls);
}

static void run_rotated(character *c) {
    const limn_pose pose = pose_of(c);
    limn_pose_normals(&pose, &c->mix.mesh, c->mix.control_normals, 0, c->mix.mesh.normal_count,
                      c->normals);
}

static void run_refine(character *c) {
    limn_mesh_refine(&c->mix.mesh, c->controls);
}

static void run_normals(character *c) {
    limn_mesh_control_normals(&c->mix.mesh, c->controls, c->normals);
}

static void run_evaluate(character *c) {
    const limn_plan plan = limn_plan_uniform(&c->mix.mesh, LIMN_LEVEL_MAX);
    const uint32_t row_count = c->mix.mesh.domain->row_counts[LIMN_LEVEL_MAX];
    for (uint32_t patch = 0; patch < plan.patch_count; patch++) {
        const uintptr_t skipped = (uintptr_t)patch * row_count * 6 * sizeof(float);
        float *const vertices = (float *)((uintptr_t)c->vertices - skipped);
        limn_evaluate(&plan, c->controls, patch, patch + 1,
                      &(limn_output){.vertices = vertices,
                                     .stride = 6 * sizeof(float),
                                     .normals = vertices + 3,
                                     .normal_stride = 6 * sizeof(float),
                                     .control_normals = c->normals});
    }
}

static const step steps[] = {
    {"10 morph targets", run_morphs, 4, false, false},
    {"linear, 1 influence", run_skin, 1, false, false},
    {"linear, 2 influences", run_skin, 2, false, false},
    {"linear, 4 influences", run_skin, 4, false, false},
    {"linear, 8 influences", run_skin, 8, false, false},
    {"dual, 1 influence", run_skin, 1, true, false},
    {"dual, 2 influences", run_skin, 2, true, false},
    {"dual, 4 influences", run_skin, 4, true, false},
    {"dual, 8 influences", run_skin, 8, true, false},
    {"level 1", run_refine, 4, false, true},
    {"exact control normals", run_normals, 4, false, false},
    {"rotated ones, linear", run_rotated, 4, false, false},
    {"rotated ones, dual", run_rotated, 4, true, false},
    {"evaluate, level 4", run_evaluate, 4, false, false}, // what the others are compared with
};

enum { STEP_COUNT = sizeof steps / sizeof *steps };

// -------------------------------------------------------------------------------------------------
// Characters

static bool make_targets(character *c) {
    const uint32_t points = c->mix.mesh.control_count;
    const uint32_t moved = (points + TARGET_PART - 1) / TARGET_PART;
    uint32_t *const first = malloc((TARGET_COUNT + 1) * sizeof *first);
    uint32_t *const indices = malloc((size_t)TARGET_COUNT * moved * sizeof *indices);
    float *const deltas = calloc((size_t)TARGET_COUNT * moved, sizeof(float[3]));
    c->targets = (limn_morph_targets){points, TARGET_COUNT, first, indices, deltas};
    if (!first || !indices || !deltas) return false;
    for (uint32_t t = 0; t <= TARGET_COUNT; t++)
        first[t] = t * moved;
    for (uint32_t e = 0; e < TARGET_COUNT * moved; e++)
        indices[e] = e % moved + e / moved * (points - moved) / TARGET_COUNT;
    for (int t = 0; t < TARGET_COUNT; t++)
        c->target_weights[t] = 0.5f;
    return limn_morph_check(&c->targets, TARGET_COUNT * moved, NULL) == LIMN_OK;
}

static bool create_character(character *c, const char *path, uint32_t isa) {
    *c = (character){0};
    const bool opened = path ? bench_mix_file(&c->mix, path, (bench_way){0})
                             : bench_mix_regular(&c->mix, TORUS_SIDE, (bench_way){0});
    if (!opened) return false;
    limn_mesh *const mesh = &c->mix.mesh;
    if (!mesh->normals) {
        fprintf(stderr, "limn-bench: %s: bake it with --normals exact\n", c->mix.name);
        return false;
    }
    mesh->kernels = limn_kernels_select(isa, LIMN_FAMILY_REPRODUCIBLE);
    c->controls = malloc(mesh->point_count * sizeof(float[3]));
    c->normals = malloc(mesh->normal_count * sizeof(float[3]));
    c->vertices = malloc(mesh->domain->row_counts[LIMN_LEVEL_MAX] * sizeof(float[6]));
    bool good = c->controls && c->normals && c->vertices && make_targets(c);
    for (uint32_t s = 0; s < 4 && good; s++)
        good = bench_rig_attach(&c->skins[s], mesh, JOINT_COUNT, 1u << s);
    if (!good) return false;
    memcpy(c->controls, mesh->controls, mesh->point_count * sizeof(float[3]));
    memcpy(c->normals, c->mix.control_normals, mesh->normal_count * sizeof(float[3]));
    bench_rig_wobble(mesh, JOINT_COUNT, 1, c->matrices);
    limn_dual_quaternions_make(c->matrices, JOINT_COUNT, c->quaternions);
    return true;
}

/// The arrays of targets are this file's own.
static void destroy_character(character *c) {
    for (int s = 0; s < 4; s++)
        bench_rig_free(&c->skins[s]);
    free((void *)(uintptr_t)c->targets.first);
    free((void *)(uintptr_t)c->targets.points);
    free((void *)(uintptr_t)c->targets.deltas);
    free(c->controls);
    free(c->normals);
    free(c->vertices);
    bench_mix_destroy(&c->mix);
}

// -------------------------------------------------------------------------------------------------
// Measuring

/// Seconds that one step takes.
static double sample(character *c, const step *s, double least_seconds) {
    uint32_t runs = 0;
    double elapsed;
    c->dual = s->dual;
    for (c->influences = 0; 1u << c->influences < s->influences;)
        c->influences++;
    s->run(c); // the one before has emptied the caches
    const double start = bench_seconds();
    do {
        s->run(c);
        runs++;
        elapsed = bench_seconds() - start;
    } while (elapsed < least_seconds);
    return elapsed / runs;
}

/// Prints one step, and reorders its samples.
static void print_step(const character *c, const step *s, double *samples, const double *level_4,
                       uint32_t rounds, FILE *csv) {
    const limn_mesh *const mesh = &c->mix.mesh;
    double shares[BENCH_ROUND_MAX];
    for (uint32_t round = 0; round < rounds; round++)
        shares[round] = samples[round] / level_4[round];
    const double share = bench_median(shares, rounds);
    const double ns = 1e9 * bench_median(samples, rounds) / mesh->control_count;
    printf("%-24s %10.2f %10.4f\n", s->name, ns, share);
    if (csv)
        fprintf(csv, "%s,%s,%u,%u,\"%s\",%.3f,%.5f\n", c->mix.name,
                limn_kernels_name(mesh->kernels), mesh->control_count, mesh->patch_count, s->name,
                ns, share);
}

static void measure(character *c, const bench_steps_options *o, FILE *csv) {
    static double samples[STEP_COUNT][BENCH_ROUND_MAX];
    const limn_mesh *const mesh = &c->mix.mesh;
    const bool isolated = mesh->point_count > mesh->control_count;
    for (uint32_t round = 0; round < o->rounds; round++) {
        for (int s = 0; s < STEP_COUNT; s++)
            samples[s][round] = sample(c, &steps[s], o->sample_seconds);
    }
    printf("\n%s: %u control points, %u faces, %s\n%-24s %10s %10s\n", c->mix.name,
           mesh->control_count, mesh->patch_count, limn_kernels_name(mesh->kernels), "step", "ns",
           "/ level 4");
    for (int s = 0; s < STEP_COUNT; s++) {
        if (isolated || !steps[s].when_isolated)
            print_step(c, &steps[s], samples[s], samples[STEP_COUNT - 1], o->rounds, csv);
    }
}

/// `path` NULL: a torus.
static bool bench_character(const char *path, const bench_steps_options *o, FILE *csv) {
    static character c;
    const bool good = create_character(&c, path, o->isa);
    if (good) measure(&c, o, csv);
    destroy_character(&c);
    return good;
}

int bench_skin(int argc, char **argv) {
    static const bench_steps these = {
        .help = help,
        .columns = "mesh,isa,control_points,faces,step,ns_per_control_point,share",
        .measure = bench_character};
    return bench_steps_run(argc, argv, &these);
}
