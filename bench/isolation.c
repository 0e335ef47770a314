/* SPDX-License-Identifier: MIT */
/*
 * limn-bench isolation: what isolated meshes cost beside dense ones, in bytes and in time. All is
 * measured in turn, round after round, in one process.
 */
#include "arguments.h"
#include "bench.h"

#include "../baker/sizes.h"
#include "sampler.h"

#include "limn/limn.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: limn-bench isolation [OPTIONS] [MESH...]\n\n"
    "Bakes every MESH (.obj, .off) dense and isolated, and beside it a regular torus of about as\n"
    "many patches, and the same torus with edges turned at random (\"worst\"), and prints\n\n"
    "  bytes           of the tables of positions (with normals three times as many), of columns,\n"
    "                  of patches, and of the points of level 1, as `limn info` counts them; and "
    "of\n"
    "                  all MESHes isolated in one file\n"
    "  ns per patch    medians, by level 0 to 4, dense and isolated, tables warm and cold; and of\n"
    "                  limn_mesh_refine(), which isolated meshes take once a frame\n"
    "  isolated/dense  without limn_mesh_refine() and with it\n"
    "  % of regular    how fast the isolated mesh is at level 4 beside the isolated regular "
    "torus,\n"
    "                  without limn_mesh_refine() and with it\n\n"
    "The kernels are the best of this CPU, of both families. limn-bench kernels --help says what\n"
    "warm and cold mean, and where vertices go.\n\n"
    "Options:\n"
    "  --scheme S     loop: of triangles (default); catmark: Catmull-Clark, tori of quads; no "
    "other,\n"
    "                 as the butterfly's patches are others when it is isolated\n"
    "  --rounds N     samples of each figure (default 9)\n"
    "  --quick        3 rounds of short samples\n"
    "  --csv FILE     writes all figures\n";

enum { TORUS_SIDE = 64, TORUS_SIDE_MIN = 8, ROUND_MAX = 1000, BUFFER_SIZE = 64 * 1024 };
enum { DENSE, ISOLATED, WAY_COUNT };
enum { FAMILY_COUNT = 2, OUTPUT_COUNT = 2, TABLES_COUNT = 2 };

static const char *const way_names[WAY_COUNT] = {"dense", "isolated"};
static const char *const family_names[FAMILY_COUNT] = {"reproducible", "fast"};
static const char *const tables_names[TABLES_COUNT] = {"warm", "cold"};

/// Seconds per patch.
typedef struct figure {
    double samples[ROUND_MAX];
    double median;
} figure;

/// A mesh, dense and isolated.
typedef struct subject {
    bench_mix mixes[WAY_COUNT];
    float *points;    ///< [point_count][3] for limn_mesh_refine()
    uint32_t regular; ///< index of the regular torus of its size
    figure refining;
    figure (*evaluating)[WAY_COUNT][FAMILY_COUNT][OUTPUT_COUNT][TABLES_COUNT][LIMN_LEVEL_COUNT];
} subject;

typedef struct session {
    uint32_t rounds;
    const char *csv;
    limn_scheme scheme;
    bench_sampler sampler;
    const limn_kernels *kernels[FAMILY_COUNT];
    subject *subjects;
    uint32_t subject_count;
    limn_baker *together; ///< all meshes, isolated
} session;

/// One line of the tables of times.
typedef struct line {
    int family, output, tables;
} line;

// ---- Measuring

static double sample_refining(const session *s, const subject *one) {
    limn_mesh mesh = one->mixes[ISOLATED].mesh;
    mesh.kernels = s->kernels[0];
    limn_mesh_refine(&mesh, one->points);
    uint32_t passes = 0;
    double elapsed;
    const double start = bench_thread_seconds();
    do {
        limn_mesh_refine(&mesh, one->points);
        passes++;
        elapsed = bench_thread_seconds() - start;
    } while (elapsed < s->sampler.seconds);
    return elapsed / ((double)passes * mesh.patch_count);
}

static void measure_line(session *s, subject *one, const line *which, uint32_t round) {
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        for (int way = 0; way < WAY_COUNT; way++) {
            bench_load load = {.mix = &one->mixes[way],
                               .kernels = s->kernels[which->family],
                               .output = &bench_outputs[which->output],
                               .level = level};
            (*one->evaluating)[way][which->family][which->output][which->tables][level]
                .samples[round] = which->tables ? bench_sample_cold(&s->sampler, &load)
                                                : bench_sample_warm(&s->sampler, &load);
        }
    }
}

/// Calls `visit` for all lines.
static void for_lines(session *s, void (*visit)(session *s, const line *which, void *data),
                      void *data) {
    for (int output = 0; output < OUTPUT_COUNT; output++) {
        for (int family = 0; family < FAMILY_COUNT; family++) {
            for (int tables = 0; tables < TABLES_COUNT; tables++)
                visit(s, &(line){family, output, tables}, data);
        }
    }
}

static void measure_subjects(session *s, const line *which, void *round) {
    for (uint32_t i = 0; i < s->subject_count; i++)
        measure_line(s, &s->subjects[i], which, *(const uint32_t *)round);
}

static void find_median(const session *s, figure *f) {
    f->median = bench_median(f->samples, s->rounds);
}

static void find_medians(session *s, const line *which, void *data) {
    (void)data;
    for (uint32_t i = 0; i < s->subject_count; i++) {
        for (int way = 0; way < WAY_COUNT; way++) {
            figure *const levels =
                (*s->subjects[i].evaluating)[way][which->family][which->output][which->tables];
            for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
                find_median(s, &levels[level]);
        }
    }
}

static void measure(session *s) {
    for (uint32_t round = 0; round < s->rounds; round++) {
        for (uint32_t i = 0; i < s->subject_count; i++)
            s->subjects[i].refining.samples[round] = sample_refining(s, &s->subjects[i]);
        for_lines(s, measure_subjects, &round);
    }
    for (uint32_t i = 0; i < s->subject_count; i++)
        find_median(s, &s->subjects[i].refining);
    for_lines(s, find_medians, NULL);
}

// ---- Printing

/// Nanoseconds per patch.
static double ns_of(const subject *one, int way, const line *which, uint32_t level) {
    return 1e9 * (*one->evaluating)[way][which->family][which->output][which->tables][level].median;
}

static double refining_ns(const subject *one) {
    return 1e9 * one->refining.median;
}

static double tables_size(const limn_pack *pack) {
    return (double)limni_tables_size(pack) / 3; // all have normals
}

static void print_size(const char *name, uint32_t patch_count, const char *way,
                       const limn_pack *pack) {
    uint64_t patches = 0, points = 0;
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(pack, m);
        patches += limni_patches_size(&mesh);
        points += limni_points_size(&mesh);
    }
    printf("%-28s %7u %-8s %8u %7u %9.0f %9llu %10llu %10llu\n", name, patch_count, way,
           pack->class_count, pack->piece_count, tables_size(pack),
           (unsigned long long)limni_columns_size(pack), (unsigned long long)patches,
           (unsigned long long)points);
}

static bool print_sizes(session *s) {
    printf("\n%-28s %7s %-8s %8s %7s %9s %9s %10s %10s\n", "bytes", "patches", "", "classes",
           "pieces", "tables", "columns", "patches", "points");
    uint32_t patch_count = 0;
    for (uint32_t i = 0; i < s->subject_count; i++) {
        const bench_mix *const mixes = s->subjects[i].mixes;
        for (int way = 0; way < WAY_COUNT; way++)
            print_size(mixes[way].name, mixes[way].mesh.patch_count, way_names[way],
                       &mixes[way].pack);
    }
    if (!s->together) return true;
    limn_pack pack;
    const void *blob;
    size_t size;
    if (limn_baker_finish(s->together, &blob, &size) != LIMN_BAKE_OK ||
        limn_pack_open(&pack, blob, size) != LIMN_OK) {
        fprintf(stderr, "limn-bench: %s\n", limn_baker_error(s->together));
        return false;
    }
    for (uint32_t m = 0; m < pack.mesh_count; m++)
        patch_count += limn_pack_mesh(&pack, m).patch_count;
    print_size("all in one file", patch_count, way_names[ISOLATED], &pack);
    return true;
}

static void print_subject(const session *s, const subject *one, const line *which) {
    const subject *const torus = &s->subjects[one->regular];
    const double refining = refining_ns(one), torus_refining = refining_ns(torus);
    printf("%-24.24s", one->mixes[0].name);
    for (int way = 0; way < WAY_COUNT; way++) {
        for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
            printf(" %6.1f", ns_of(one, way, which, level));
        printf("  ");
    }
    printf("%6.1f  ", refining);
    for (int with = 0; with < 2; with++) {
        for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
            printf(" %5.2f", (ns_of(one, ISOLATED, which, level) + with * refining) /
                                 ns_of(one, DENSE, which, level));
        printf("  ");
    }
    for (int with = 0; with < 2; with++)
        printf(" %4.0f",
               100 * (ns_of(torus, ISOLATED, which, LIMN_LEVEL_MAX) + with * torus_refining) /
                   (ns_of(one, ISOLATED, which, LIMN_LEVEL_MAX) + with * refining));
    printf("\n");
}

static void print_line(session *s, const line *which, void *data) {
    (void)data;
    printf("\n%s, %s %s, tables %s\n", bench_outputs[which->output].name,
           limn_kernels_name(s->kernels[which->family]), family_names[which->family],
           tables_names[which->tables]);
    printf("%-24s %34s   %34s  %6s   %29s   %29s   %9s\n", "ns per patch, levels 0 to 4", "dense",
           "isolated", "refine", "isolated/dense", "with refine", "% of reg.");
    for (uint32_t i = 0; i < s->subject_count; i++)
        print_subject(s, &s->subjects[i], which);
}

static void write_line(session *s, const line *which, void *file) {
    for (uint32_t i = 0; i < s->subject_count; i++) {
        const subject *const one = &s->subjects[i];
        for (int way = 0; way < WAY_COUNT; way++) {
            const bench_mix *const mix = &one->mixes[way];
            for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
                fprintf(file, "%s,%u,%s,%u,%u,%.0f,%llu,%llu,%llu,%s,%s,%s,%s,%u,%.3f,%.3f\n",
                        mix->name, mix->mesh.patch_count, way_names[way], mix->pack.class_count,
                        mix->pack.piece_count, tables_size(&mix->pack),
                        (unsigned long long)limni_columns_size(&mix->pack),
                        (unsigned long long)limni_patches_size(&mix->mesh),
                        (unsigned long long)limni_points_size(&mix->mesh),
                        bench_outputs[which->output].name,
                        limn_kernels_name(s->kernels[which->family]), family_names[which->family],
                        tables_names[which->tables], level, ns_of(one, way, which, level),
                        way == ISOLATED ? refining_ns(one) : 0);
        }
    }
}

static void write_csv(session *s, FILE *file) {
    fprintf(file, "# ");
    bench_print_conditions(file);
    fprintf(file, "mesh,patches,way,classes,pieces,position_table_bytes,column_bytes,patch_bytes,"
                  "point_bytes,output,isa,family,tables,level,ns_per_patch,refine_ns_per_patch\n");
    for_lines(s, write_line, file);
}

// ---- Setting up

static bool out_of_memory(void) {
    fprintf(stderr, "limn-bench: out of memory\n");
    return false;
}

/// Of a subject whose meshes are baked.
static bool complete(session *s, uint32_t regular) {
    subject *const one = &s->subjects[s->subject_count++];
    const limn_mesh *const mesh = &one->mixes[ISOLATED].mesh;
    const size_t size = 3 * (size_t)mesh->point_count * sizeof(float);
    one->regular = regular;
    one->points = malloc(size);
    one->evaluating = calloc(1, sizeof *one->evaluating);
    if (!one->points || !one->evaluating) return out_of_memory();
    memcpy(one->points, mesh->controls, size);
    return true;
}

typedef bool make_torus(bench_mix *mix, uint32_t side, bench_way way);

static bench_way way_of(const session *s, int way) {
    return (bench_way){s->scheme, way == DENSE ? LIMN_ISOLATE_NEVER : LIMN_ISOLATE_ALWAYS};
}

static bool add_torus(session *s, make_torus *make, uint32_t side, uint32_t regular) {
    bench_mix *const mixes = s->subjects[s->subject_count].mixes;
    if (make(&mixes[DENSE], side, way_of(s, DENSE)) &&
        make(&mixes[ISOLATED], side, way_of(s, ISOLATED)))
        return complete(s, regular);
    s->subject_count++; // for destroy()
    return false;
}

/// Both of a size, unless they are there; `regular`: which they are.
static bool add_tori(session *s, uint32_t side, uint32_t *regular) {
    const uint32_t faces = bench_mix_torus_faces(side, s->scheme);
    for (uint32_t i = 0; i < s->subject_count; i++) {
        *regular = i;
        if (s->subjects[i].regular == i && s->subjects[i].mixes[DENSE].mesh.patch_count == faces)
            return true;
    }
    *regular = s->subject_count;
    return add_torus(s, bench_mix_regular, side, *regular) &&
           add_torus(s, bench_mix_worst, side, *regular);
}

static bool add_file(session *s, const char *path) {
    bench_mix mixes[WAY_COUNT];
    uint32_t regular = 0;
    bool good = bench_mix_file(&mixes[DENSE], path, way_of(s, DENSE));
    mixes[ISOLATED] = (bench_mix){0};
    if (good && !mixes[DENSE].baker) {
        fprintf(stderr, "limn-bench: %s: a mesh is needed that is not yet baked\n", path);
        good = false;
    }
    good = good && bench_mix_file(&mixes[ISOLATED], path, way_of(s, ISOLATED));
    if (good) {
        const double faces = bench_mix_torus_faces(1, s->scheme);
        const double side = sqrt(mixes[DENSE].mesh.patch_count / faces);
        good =
            add_tori(s, side < TORUS_SIDE_MIN ? TORUS_SIDE_MIN : (uint32_t)lround(side), &regular);
    }
    memcpy(s->subjects[s->subject_count].mixes, mixes, sizeof mixes);
    if (!good) s->subject_count++; // for destroy()
    return good && complete(s, regular) && limn_baker_add_file(s->together, path) == LIMN_BAKE_OK;
}

static bool set_up(session *s, char **paths, int path_count) {
    uint32_t regular;
    for (int family = 0; family < FAMILY_COUNT; family++)
        s->kernels[family] = limn_kernels_select(LIMN_ISA_ALL, (limn_family)family);
    s->subjects = calloc(3 * (size_t)path_count + 3, sizeof *s->subjects);
    s->sampler.buffer = aligned_alloc(4096, s->sampler.buffer_size);
    if (!s->subjects || !s->sampler.buffer) return out_of_memory();
    if (path_count == 0) return add_tori(s, TORUS_SIDE, &regular);
    s->together = bench_baker(way_of(s, ISOLATED));
    if (!s->together) return out_of_memory();
    bool good = true;
    for (int p = 0; p < path_count && good; p++)
        good = add_file(s, paths[p]);
    return good;
}

static void destroy(session *s) {
    for (uint32_t i = 0; i < s->subject_count; i++) {
        for (int way = 0; way < WAY_COUNT; way++)
            bench_mix_destroy(&s->subjects[i].mixes[way]);
        free(s->subjects[i].points);
        free(s->subjects[i].evaluating);
    }
    limn_baker_destroy(s->together);
    free(s->subjects);
    free(s->sampler.buffer);
}

/// csv  NULL: none
static bool run(session *s, char **paths, int path_count, FILE *csv) {
    if (!set_up(s, paths, path_count)) return false;
    bench_print_conditions(stdout);
    if (!print_sizes(s)) return false;
    measure(s);
    printf("\n%u rounds; vertices go to a buffer of %zu KiB\n", s->rounds,
           s->sampler.buffer_size / 1024);
    for_lines(s, print_line, NULL);
    if (csv) write_csv(s, csv);
    return true;
}

static bool parse_option(int option, void *parsed) {
    session *const s = parsed;
    switch (option) {
    case 's':
        return bench_parse_scheme(optarg, &s->scheme);
    case 'r':
        return bench_parse_range(optarg, 1, ROUND_MAX, &s->rounds);
    case 'q':
        s->rounds = 3;
        s->sampler.seconds = 3e-4;
        return true;
    case 'c':
        s->csv = optarg;
        return true;
    default:
        return false;
    }
}

int bench_isolation(int argc, char **argv) {
    static const struct option names[] = {
        {"scheme", required_argument, NULL, 's'}, {"rounds", required_argument, NULL, 'r'},
        {"quick", no_argument, NULL, 'q'},        {"csv", required_argument, NULL, 'c'},
        {"help", no_argument, NULL, 'h'},         {0}};
    session s = {.rounds = 9, .sampler = {.buffer_size = BUFFER_SIZE, .seconds = 1e-3}};
    const int status = bench_read_options(argc, argv, help, names, parse_option, &s);
    if (status >= 0) return status;
    limni_output_file csv;
    if (!bench_results_open(&csv, s.csv)) return 1;
    const bool good = run(&s, argv + optind, argc - optind, csv.stream);
    destroy(&s);
    return bench_results_close(&csv, s.csv, good) ? 0 : 1;
}
