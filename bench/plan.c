/* SPDX-License-Identifier: MIT */
/*
 * limn-bench plan: what planning a frame costs beside evaluating it, mixed levels beside uniform
 * ones, and two threads beside one. Everything is measured in turn, round after round, in one
 * process.
 */
#include "arguments.h"
#include "bench.h"
#include "frames.h"
#include "lods.h"
#include "mixes.h"
#include "peers/allocate.h"
#include "peers/team.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: limn-bench plan [OPTIONS] [MESH...]\n\n"
    "Plans and evaluates frames of every MESH (.obj, .off: baked first; .limn: its first mesh), "
    "or\n"
    "of a regular torus of 8,192 faces, and prints medians:\n\n"
    "  level 0 to 4       all faces at one level, without planning\n"
    "  uniform, length …  levels chosen in that way for a near camera: 2.5, or as long edges are.\n"
    "                     No faces are left out, or (culled) those outside\n"
    "  crowd              64 of the mesh in eight rows, one camera, a plan for each of them,\n"
    "                     culled; with morphing and without\n\n"
    "  drawn         share of the faces\n"
    "  level         the mean of the patches that are drawn\n"
    "  plan          ns per face, drawn or not\n"
    "  evaluate      ns per patch that is drawn, and per vertex: positions\n"
    "  / evaluate    time to plan the frame, as a share of the time to evaluate it\n"
    "  / level 4     the same, of the time to evaluate all faces at level 4\n\n"
    "Vertices go to a small buffer that is used again and again, as a mapped ring buffer would\n"
    "be; each thread has its own. Draws are not made.\n\n"
    "Then two threads beside one: each takes every other buffer-full of patches.\n\n"
    "Options:\n"
    "  --pixels N     tolerance of levels (default 4)\n"
    "  --fast         kernels with fused multiply-add\n"
    "  --threads N    instead of 2\n"
    "  --rounds N     samples of each figure (default 15)\n"
    "  --quick        3 rounds of short samples\n"
    "  --buffer KIB   size of the buffer (default 64)\n"
    "  --csv FILE     writes all figures\n";

enum { ROUND_MAX = 1000, TORUS_SIDE = 64, FRAME_MAX = 32, JOB_MAX = 96, VERTEX_SIZE = 12 };

typedef struct options {
    float pixels;
    bool fast;
    uint32_t threads;
    uint32_t rounds;
    double sample_seconds;
    size_t buffer_size;
    const char *csv;
} options;

/// What is timed: planning a frame, or evaluating it as it was planned last.
typedef struct job {
    const bench_frame *frame;
    const struct session *in;
    team *threads; ///< NULL: this one only
    bool normals;
    bool plans;
    double *samples; ///< [rounds] seconds
} job;

/// A line of the report.
typedef struct figure {
    const job *plan; ///< NULL: it is not planned
    const job *evaluate;
    const job *beside; ///< level 4; or the same with one thread
    const char *mesh;
} figure;

typedef struct session {
    options options;
    team *threads;
    unsigned char **buffers; ///< [threads]
    bench_frame frames[FRAME_MAX];
    job jobs[JOB_MAX];
    figure figures[JOB_MAX];
    uint32_t frame_count, job_count, figure_count;
    FILE *csv; ///< NULL: none
} session;

// -------------------------------------------------------------------------------------------------
// Measuring

static uint64_t vertices_before(const limn_plan *plan, uint32_t patch) {
    return patch < plan->patch_count ? limn_plan_first_vertex(plan, patch) : plan->vertex_count;
}

/// The end of the patches from `begin` on whose vertices fit into the buffer.
static uint32_t find_end(const limn_plan *plan, uint32_t begin, uint64_t capacity) {
    const uint64_t last = vertices_before(plan, begin) + capacity;
    uint32_t low = begin + 1, high = plan->patch_count;
    while (low < high) {
        const uint32_t middle = high - (high - low) / 2;
        if (vertices_before(plan, middle) <= last) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

/// Normals have half of the buffer. An output begins with the first vertex of the plan.
static void evaluate_range(const job *j, const limn_plan *plan, uint32_t begin, uint32_t end,
                           unsigned char *buffer) {
    const uintptr_t first = (uintptr_t)vertices_before(plan, begin) * VERTEX_SIZE;
    limn_output output = {.vertices = (void *)((uintptr_t)buffer - first)};
    if (j->normals) {
        output.normals = (void *)((uintptr_t)buffer + j->in->options.buffer_size / 2 - first);
        output.control_normals = j->frame->mix->control_normals;
    }
    limn_evaluate(plan, plan->mesh->controls, begin, end, &output);
}

/// Every `part_count`th buffer-full, of all instances.
static void evaluate_part(void *state, uint32_t part, uint32_t part_count) {
    const job *const j = state;
    const uint64_t capacity = j->in->options.buffer_size / (j->normals ? 2 : 1) / VERTEX_SIZE;
    uint32_t turn = 0;
    for (uint32_t i = 0; i < j->frame->instance_count; i++) {
        const limn_plan *const plan = &j->frame->plans[i];
        for (uint32_t begin = 0, end; begin < plan->patch_count; begin = end) {
            end = find_end(plan, begin, capacity);
            if (turn++ % part_count == part)
                evaluate_range(j, plan, begin, end, j->in->buffers[part]);
        }
    }
}

static void run_job(job *j) {
    if (j->plans) {
        bench_frame_plan(j->frame);
    } else if (j->threads) {
        team_run(j->threads, evaluate_part, j);
    } else {
        evaluate_part(j, 0, 1);
    }
}

static double sample(job *j, double least_seconds) {
    uint32_t runs = 0;
    double elapsed;
    run_job(j); // the one before has emptied the caches
    const double start = bench_seconds();
    do {
        run_job(j);
        runs++;
        elapsed = bench_seconds() - start;
    } while (elapsed < least_seconds);
    return elapsed / runs;
}

static void measure(session *s) {
    for (uint32_t round = 0; round < s->options.rounds; round++) {
        for (uint32_t k = 0; k < s->job_count; k++)
            s->jobs[k].samples[round] = sample(&s->jobs[k], s->options.sample_seconds);
    }
}

/// Median of the ratio in each round, which passing loads disturb least.
static double ratio(const session *s, const job *of, const job *to) {
    double values[ROUND_MAX];
    for (uint32_t round = 0; round < s->options.rounds; round++)
        values[round] = of->samples[round] / to->samples[round];
    return bench_median(values, s->options.rounds);
}

static double nanoseconds(const session *s, const job *of) {
    double values[ROUND_MAX];
    memcpy(values, of->samples, s->options.rounds * sizeof *values);
    return 1e9 * bench_median(values, s->options.rounds);
}

// -------------------------------------------------------------------------------------------------
// Printing

static const char *output_name(const job *j) {
    return j->normals ? "position+normal" : "position";
}

static void print_frame(const session *s, const figure *f) {
    const bench_frame *const frame = f->evaluate->frame;
    const double faces = (double)bench_frame_faces(frame);
    const double drawn = (double)bench_frame_patches(frame);
    const double evaluate = nanoseconds(s, f->evaluate);
    printf("%-18s %5.0f%% %6.2f", frame->name, 100 * drawn / faces, bench_frame_level(frame));
    if (f->plan) {
        printf(" %8.2f", nanoseconds(s, f->plan) / faces);
    } else {
        printf(" %8s", "");
    }
    printf(" %9.1f %9.2f", evaluate / drawn, evaluate / (double)bench_frame_vertices(frame));
    if (f->plan) printf(" %11.3f", ratio(s, f->plan, f->evaluate));
    if (f->plan && frame->instance_count == 1) printf(" %10.3f", ratio(s, f->plan, f->beside));
    printf("\n");
}

static void print_threads(const session *s, const figure *f) {
    printf("%-18s %-16s %10.1f %10.1f %8.3f\n", f->evaluate->frame->name, output_name(f->evaluate),
           nanoseconds(s, f->beside) / (double)bench_frame_patches(f->beside->frame),
           nanoseconds(s, f->evaluate) / (double)bench_frame_patches(f->evaluate->frame),
           ratio(s, f->beside, f->evaluate));
}

static void print_figures(const session *s) {
    const bench_mix *const mix = s->frames[0].mix;
    printf("\n%s: %u faces\n%-18s %6s %6s %8s %9s %9s %11s %10s\n", mix->name,
           mix->mesh.patch_count, "frame", "drawn", "level", "plan", "evaluate", "a vertex",
           "/ evaluate", "/ level 4");
    for (uint32_t k = 0; k < s->figure_count; k++) {
        if (!s->figures[k].evaluate->threads) print_frame(s, &s->figures[k]);
    }
    printf("\n%-18s %-16s %10s %8u %s %8s\n", "ns per patch", "output", "1 thread",
           s->options.threads, "", "speed-up");
    for (uint32_t k = 0; k < s->figure_count; k++) {
        if (s->figures[k].evaluate->threads) print_threads(s, &s->figures[k]);
    }
}

static void write_figures(const session *s) {
    for (uint32_t k = 0; k < s->figure_count && s->csv; k++) {
        const figure *const f = &s->figures[k];
        const job *const j = f->evaluate;
        const double faces = (double)bench_frame_faces(j->frame);
        const double drawn = (double)bench_frame_patches(j->frame);
        const double vertices = (double)bench_frame_vertices(j->frame);
        const double evaluate = nanoseconds(s, j);
        fprintf(s->csv, "%s,\"%s\",%s,%u,%.0f,%.0f,%.4f,%.0f,%.3f,%.4f", j->frame->mix->name,
                j->frame->name, output_name(j), j->threads ? s->options.threads : 1, faces, drawn,
                bench_frame_level(j->frame), vertices, evaluate / drawn, evaluate / vertices);
        if (f->plan) {
            fprintf(s->csv, ",%.3f,%.4f", nanoseconds(s, f->plan) / faces,
                    ratio(s, f->plan, f->evaluate));
        } else {
            fprintf(s->csv, ",,");
        }
        if (j->threads) {
            fprintf(s->csv, ",%.4f\n", ratio(s, f->beside, j));
        } else {
            fprintf(s->csv, ",\n");
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Setting up

static job *add_job(session *s, const bench_frame *frame) {
    job *const j = &s->jobs[s->job_count++];
    *j = (job){
        .frame = frame, .in = s, .samples = bench_allocate(s->options.rounds, sizeof(double))};
    return j;
}

static const bench_frame *add_frame(session *s, bench_frame frame) {
    s->frames[s->frame_count] = frame;
    bench_frame_plan(&frame);
    return &s->frames[s->frame_count++];
}

/// A line for a frame. Returns what evaluates it.
static const job *add_figure(session *s, const bench_frame *frame, const job *level_4) {
    job *const plan = frame->is_planned ? add_job(s, frame) : NULL;
    if (plan) plan->plans = true;
    job *const evaluate = add_job(s, frame);
    s->figures[s->figure_count++] =
        (figure){.plan = plan, .evaluate = evaluate, .beside = level_4 ? level_4 : evaluate};
    return evaluate;
}

/// A line for a frame with one thread and with all.
static void add_threads(session *s, const bench_frame *frame) {
    for (int normals = 0; normals < (frame->mix->control_normals ? 2 : 1); normals++) {
        job *const alone = add_job(s, frame), *const together = add_job(s, frame);
        alone->normals = together->normals = normals == 1;
        together->threads = s->threads;
        s->figures[s->figure_count++] = (figure){.evaluate = together, .beside = alone};
    }
}

static void add_all(session *s, const bench_mix *mix) {
    const float pixels = s->options.pixels;
    const bench_frame *finest = NULL;
    const job *level_4 = NULL;
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        finest = add_frame(s, bench_frame_uniform(mix, level));
        level_4 = add_figure(s, finest, NULL);
    }
    for (uint32_t l = 0; l < bench_lod_count; l++) {
        add_figure(s, add_frame(s, bench_frame_near(mix, &bench_lods[l], pixels, false)), level_4);
        add_figure(s, add_frame(s, bench_frame_near(mix, &bench_lods[l], pixels, true)), level_4);
    }
    const bench_frame *const crowd = add_frame(s, bench_frame_crowd(mix, pixels, false));
    add_figure(s, crowd, level_4);
    add_figure(s, add_frame(s, bench_frame_crowd(mix, pixels, true)), level_4);
    add_threads(s, finest);
    add_threads(s, crowd);
}

static void remove_all(session *s) {
    for (uint32_t k = 0; k < s->job_count; k++)
        free(s->jobs[k].samples);
    for (uint32_t k = 0; k < s->frame_count; k++)
        bench_frame_destroy(&s->frames[k]);
    s->job_count = s->frame_count = s->figure_count = 0;
}

/// `path` NULL: a torus.
static bool bench_mesh(session *s, const char *path) {
    bench_mix mix;
    const bool good = path ? bench_mix_file(&mix, path, (bench_way){0})
                           : bench_mix_regular(&mix, TORUS_SIDE, (bench_way){0});
    if (good) {
        if (s->options.fast) mix.mesh.kernels = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_FAST);
        add_all(s, &mix);
        measure(s);
        print_figures(s);
        write_figures(s);
        remove_all(s);
    }
    bench_mix_destroy(&mix);
    return good;
}

static void write_head(FILE *csv) {
    fprintf(csv, "# ");
    bench_print_conditions(csv);
    fprintf(csv, "mesh,frame,output,threads,faces,drawn,level,vertices,evaluate_ns_per_patch,"
                 "evaluate_ns_per_vertex,plan_ns_per_face,plan_share,speed_up\n");
}

static void create_buffers(session *s) {
    s->threads = team_create(s->options.threads);
    s->buffers = bench_allocate(s->options.threads, sizeof *s->buffers);
    for (uint32_t t = 0; t < s->options.threads; t++)
        s->buffers[t] = bench_allocate(1, s->options.buffer_size);
}

static void destroy_buffers(session *s) {
    for (uint32_t t = 0; t < s->options.threads; t++)
        free(s->buffers[t]);
    free(s->buffers);
    team_destroy(s->threads);
}

static bool run(session *s, char **paths, int path_count) {
    limni_output_file csv;
    if (!bench_results_open(&csv, s->options.csv)) return false;
    s->csv = csv.stream;
    if (s->csv) write_head(s->csv);
    create_buffers(s);
    bench_print_conditions(stdout);
    printf("%u rounds; tolerance %g pixels; vertices go to buffers of %zu KiB\n", s->options.rounds,
           (double)s->options.pixels, s->options.buffer_size / 1024);
    bool good = path_count > 0 || bench_mesh(s, NULL);
    for (int p = 0; p < path_count; p++)
        good &= bench_mesh(s, paths[p]);
    destroy_buffers(s);
    return bench_results_close(&csv, s->options.csv, good);
}

static bool parse_option(int option, void *parsed) {
    options *const to = parsed;
    uint32_t kib;
    switch (option) {
    case 'p':
        return limni_parse_real(optarg, 1e-6f, 1e6f, &to->pixels);
    case 'f':
        to->fast = true;
        return true;
    case 't':
        return bench_parse_range(optarg, 2, 256, &to->threads);
    case 'r':
        return bench_parse_range(optarg, 1, ROUND_MAX, &to->rounds);
    case 'q':
        to->rounds = 3;
        to->sample_seconds = 3e-4;
        return true;
    case 'b':
        if (!bench_parse_range(optarg, 4, 1 << 20, &kib)) return false;
        to->buffer_size = 1024 * (size_t)kib;
        return true;
    case 'c':
        to->csv = optarg;
        return true;
    default:
        return false;
    }
}

int bench_plan(int argc, char **argv) {
    static const struct option names[] = {{"pixels", required_argument, NULL, 'p'},
                                          {"fast", no_argument, NULL, 'f'},
                                          {"threads", required_argument, NULL, 't'},
                                          {"rounds", required_argument, NULL, 'r'},
                                          {"quick", no_argument, NULL, 'q'},
                                          {"buffer", required_argument, NULL, 'b'},
                                          {"csv", required_argument, NULL, 'c'},
                                          {"help", no_argument, NULL, 'h'},
                                          {0}};
    static session s = {.options = {.pixels = 4,
                                    .threads = 2,
                                    .rounds = 15,
                                    .sample_seconds = 2e-3,
                                    .buffer_size = 64 * 1024}};
    const int status = bench_read_options(argc, argv, help, names, parse_option, &s.options);
    if (status >= 0) return status;
    return run(&s, argv + optind, argc - optind) ? 0 : 1;
}
