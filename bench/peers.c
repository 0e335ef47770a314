/* SPDX-License-Identifier: MIT */
/*
 * limn-bench peers: Limn beside what one would otherwise use, on the same mesh, at the same points,
 * in interleaved rounds within one process.
 */
#include "arguments.h"
#include "bench.h"
#include "peers/allocate.h"
#include "peers/peer.h"
#include "peers/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char help[] =
    "Usage: limn-bench peers [OPTIONS] MESH...\n\n"
    "Computes the same points of every MESH (.obj, .off) with Limn, with OpenSubdiv's limit "
    "stencils and\n"
    "its Bfr surfaces, with Embree's rtcInterpolateN() (Catmull-Clark only), with plain recursive\n"
    "subdivision, and by skinning the refined mesh itself.\n"
    "Everything that does not depend on the frame is prepared beforehand. All must give the same "
    "points.\n\n"
    "With catmark, a patch is a face; where any face is not a quad, one for each corner of each "
    "face, and\n"
    "figures per face are still those of the faces of MESH. Embree's points are of the limit "
    "surface. It\n"
    "refines near extraordinary vertices for itself and keeps what it derives from the control "
    "points of a\n"
    "face in a cache, which each frame empties by committing the geometry, as points have moved. "
    "It\n"
    "is left out where a boundary has a vertex of a single face, which it rounds otherwise.\n\n"
    "Options:\n"
    "  --scheme S    loop: polygons are cut into triangles (default); catmark: Catmull-Clark, of "
    "polygons\n"
    "                as they are\n"
    "  --isolate N   1: Limn with small tables, and limn_mesh_refine() in each frame (default 0)\n"
    "  --rounds N    rounds, of all peers in turn; medians are shown (default 15)\n"
    "  --level N     of subdivision, 0 to 4 (default 4)\n"
    "  --threads N   for the rows with threads; 1: no such rows (default: one per processor, 8 at "
    "most)\n"
    "  --json FILE   results and conditions as JSON\n"
    "  --csv FILE    the same as CSV\n";

/// Of the diagonal. Float stencils and Bfr stay well below.
#define DIFFERENCE_MAX 1e-4

/// A peer works this long at least in each round, after one frame that is not timed.
#define ROUND_SECONDS 1e-3

typedef struct peers_options {
    const char *json_path, *csv_path;
    uint32_t rounds;
    scene_desc scene;
} peers_options;

peer *peer_append(peer_list *list) {
    if (list->count == PEER_MAX) abort();
    return &list->peers[list->count++];
}

static bool add_peers(peer_list *list, const peer_scene *scene) {
    bool good = peers_add_limn(list, scene);
#ifdef BENCH_WITH_OPENSUBDIV
    good = good && peers_add_stencils(list, scene) && peers_add_bfr(list, scene);
#endif
#ifdef BENCH_WITH_EMBREE
    good = good && peers_add_embree(list, scene);
#endif
    return good && peers_add_loop(list, scene) && peers_add_catmark(list, scene) &&
           peers_add_dense(list, scene);
}

static void destroy_peers(peer_list *list) {
    for (uint32_t p = 0; p < list->count; p++)
        list->peers[p].destroy(list->peers[p].state);
}

// -------------------------------------------------------------------------------------------------
// The same points

static double find_diagonal(const peer_scene *scene) {
    double squares = 0;
    for (int axis = 0; axis < 3; axis++) {
        float low = INFINITY, high = -INFINITY;
        for (uint32_t v = 0; v < scene->control_count; v++) {
            low = fminf(low, scene->controls[v][axis]);
            high = fmaxf(high, scene->controls[v][axis]);
        }
        squares += (double)(high - low) * (double)(high - low);
    }
    return sqrt(squares);
}

/// The position of a row of a patch.
typedef struct vertex {
    double at[3];
} vertex;

static vertex read_vertex(const peer *source, uint32_t patch, uint32_t row) {
    const float *const position = source->position(source->state, patch, row);
    const uint32_t stride = peer_axis_stride(source);
    return (vertex){{position[0], position[stride], position[2 * (size_t)stride]}};
}

static vertex move_by_bone(vertex v, const float *bone) {
    vertex moved;
    for (int axis = 0; axis < 3; axis++)
        moved.at[axis] = (double)bone[axis] * v.at[0] + (double)bone[4 + axis] * v.at[1] +
                         (double)bone[8 + axis] * v.at[2] + (double)bone[12 + axis];
    return moved;
}

/// The largest distance to the first peer's points, over the diagonal; what is skinned starts from
/// bones that all move alike.
static double find_difference(const peer_scene *scene, const peer *first, const peer *other) {
    double largest = 0;
    for (uint32_t patch = 0; patch < scene->patch_count; patch++) {
        for (uint32_t row = 0; row < scene->row_count; row++) {
            const vertex found = read_vertex(other, patch, row);
            vertex expected = read_vertex(first, patch, row);
            if (other->skinned) expected = move_by_bone(expected, scene->bones[0]);
            double squares = 0;
            for (int axis = 0; axis < 3; axis++)
                squares +=
                    (found.at[axis] - expected.at[axis]) * (found.at[axis] - expected.at[axis]);
            // Not a number is a difference, too.
            if (!(squares <= largest)) largest = squares;
        }
    }
    return sqrt(largest) / find_diagonal(scene);
}

static bool check_points(peer_scene *scene, const peer_list *list, peer_result *results) {
    scene_set_bones(scene, true);
    bool good = true;
    for (uint32_t p = 0; p < list->count; p++) {
        const peer *const other = &list->peers[p];
        other->run(other->state);
        results[p].difference = find_difference(scene, &list->peers[0], other);
        if (results[p].difference <= DIFFERENCE_MAX) continue;
        fprintf(stderr, "limn-bench: %s: %s (%s, %u threads) differs by %.2g of the diagonal\n",
                scene->name, other->name, other->isa, other->threads, results[p].difference);
        good = false;
    }
    scene_set_bones(scene, false);
    return good;
}

// -------------------------------------------------------------------------------------------------
// Rounds

static double time_frames(const peer *timed, uint32_t frames) {
    const double start = bench_seconds();
    for (uint32_t frame = 0; frame < frames; frame++)
        timed->run(timed->state);
    return bench_seconds() - start;
}

/// times: [peer][round], seconds per frame.
static void run_rounds(const peer_list *list, uint32_t rounds, double *times) {
    uint32_t frames[PEER_MAX];
    for (uint32_t p = 0; p < list->count; p++)
        frames[p] = 1 + (uint32_t)(ROUND_SECONDS / time_frames(&list->peers[p], 1));
    for (uint32_t round = 0; round < rounds; round++) {
        for (uint32_t p = 0; p < list->count; p++) {
            time_frames(&list->peers[p], 1); // the one before has emptied the caches
            times[p * rounds + round] = time_frames(&list->peers[p], frames[p]) / frames[p];
        }
    }
}

/// Limn doing the same, or NULL.
static const peer *find_limn(const peer_list *list, const peer *other) {
    for (uint32_t p = 0; p < list->count; p++) {
        const peer *const limn = &list->peers[p];
        const bool same_output =
            (limn->output == PEER_POSITION) == (other->output == PEER_POSITION);
        if (limn->best_limn && same_output && limn->threads == other->threads &&
            limn->skinned == other->skinned)
            return limn;
    }
    return NULL;
}

/// The median over the rounds of the ratio in each round, which passing loads disturb least.
static double find_ratio(const double *times, const double *limn_times, uint32_t rounds) {
    double *const ratios = bench_allocate(rounds, sizeof *ratios);
    for (uint32_t round = 0; round < rounds; round++)
        ratios[round] = times[round] / limn_times[round];
    const double ratio = bench_median(ratios, rounds);
    free(ratios);
    return ratio;
}

static void summarize(const peer_scene *scene, const peer_list *list, uint32_t rounds,
                      double *times, peer_result *results) {
    for (uint32_t p = 0; p < list->count; p++) {
        const peer *const what = &list->peers[p];
        const peer *const limn = find_limn(list, what);
        results[p].what = *what;
        memcpy(results[p].mesh, scene->name, sizeof scene->name);
        results[p].scheme = bench_scheme_name(scene->scheme);
        results[p].level = scene->level;
        const double points = what->points == PEER_PATCH_POINTS
                                  ? (double)scene->patch_count * scene->row_count
                                  : scene->unique_count;
        results[p].points_per_face = points / scene->face_count;
        results[p].bytes_per_face = (double)what->byte_count / scene->face_count;
        results[p].ratio_to_limn =
            limn ? find_ratio(times + p * rounds, times + (limn - list->peers) * rounds, rounds)
                 : (double)NAN;
    }
    for (uint32_t p = 0; p < list->count; p++) // last: it reorders the rounds
        results[p].ns_per_face = 1e9 * bench_median(times + p * rounds, rounds) / scene->face_count;
}

static bool compare(peer_scene *scene, const peer_list *list, uint32_t rounds,
                    peer_result *results) {
    if (!check_points(scene, list, results)) return false;
    double *const times = bench_allocate((size_t)list->count * rounds, sizeof *times);
    run_rounds(list, rounds, times);
    summarize(scene, list, rounds, times, results);
    free(times);
    return true;
}

static void print_scene(const peer_scene *scene, bool isolated) {
    printf("\n%s: %s, %u faces, %u patches, %u control points, level %u: %u vertices a patch%s\n",
           scene->name, bench_scheme_name(scene->scheme), scene->face_count, scene->patch_count,
           scene->control_count, scene->level, scene->row_count, isolated ? "; limn isolated" : "");
    report_print_head();
}

/// Appends the results of one mesh, and prints them.
static bool bench_mesh(const char *path, const peers_options *options, peer_result *results,
                       uint32_t *result_count) {
    peer_scene scene;
    peer_list list = {.count = 0};
    const bool good = scene_create(&scene, path, &options->scene) && add_peers(&list, &scene) &&
                      compare(&scene, &list, options->rounds, results + *result_count);
    if (good) {
        print_scene(&scene, options->scene.isolated);
        for (uint32_t p = 0; p < list.count; p++) {
            results[*result_count + p].isolated = options->scene.isolated;
            report_print(&results[*result_count + p]);
        }
        *result_count += list.count;
    }
    destroy_peers(&list);
    scene_destroy(&scene);
    return good;
}

// -------------------------------------------------------------------------------------------------
// The command

static uint32_t count_processors(void) {
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > 8 ? 8 : (uint32_t)count;
}

static bool parse_option(int option, void *parsed) {
    peers_options *const to = parsed;
    uint32_t number;
    switch (option) {
    case 's':
        return bench_parse_scheme(optarg, &to->scene.scheme);
    case 'i':
        if (!bench_parse_range(optarg, 0, 1, &number)) return false;
        to->scene.isolated = number == 1;
        return true;
    case 'r':
        return bench_parse_range(optarg, 1, 10000, &to->rounds);
    case 'l':
        return bench_parse_range(optarg, 0, LIMN_LEVEL_MAX, &to->scene.level);
    case 't':
        return bench_parse_range(optarg, 1, 256, &to->scene.thread_count);
    case 'j':
        to->json_path = optarg;
        return true;
    case 'c':
        to->csv_path = optarg;
        return true;
    default:
        return false;
    }
}

int bench_peers(int argc, char **argv) {
    static const struct option names[] = {{"scheme", required_argument, NULL, 's'},
                                          {"isolate", required_argument, NULL, 'i'},
                                          {"rounds", required_argument, NULL, 'r'},
                                          {"level", required_argument, NULL, 'l'},
                                          {"threads", required_argument, NULL, 't'},
                                          {"json", required_argument, NULL, 'j'},
                                          {"csv", required_argument, NULL, 'c'},
                                          {"help", no_argument, NULL, 'h'},
                                          {0}};
    peers_options options = {
        .rounds = 15, .scene = {.level = LIMN_LEVEL_MAX, .thread_count = count_processors()}};
    const int status = bench_read_options(argc, argv, help, names, parse_option, &options);
    if (status >= 0) return status;
    if (optind == argc) {
        fputs("limn-bench: no mesh; see limn-bench peers --help\n", stderr);
        return 2;
    }
    limni_output_file json, csv;
    if (!bench_results_open(&json, options.json_path)) return 1;
    if (!bench_results_open(&csv, options.csv_path)) {
        bench_results_close(&json, options.json_path, false);
        return 1;
    }

    bench_print_conditions(stdout);
    peer_result *const results =
        bench_allocate((size_t)(argc - optind) * PEER_MAX, sizeof *results);
    uint32_t count = 0;
    bool good = true;
    for (int i = optind; i < argc; i++)
        good &= bench_mesh(argv[i], &options, results, &count);
    report_print_notes();
    if (json.stream) good &= report_write_json(json.stream, results, count, options.rounds);
    if (csv.stream) report_write_csv(csv.stream, results, count, options.rounds);
    good = bench_results_close(&json, options.json_path, good);
    good = bench_results_close(&csv, options.csv_path, good);
    free(results);
    return good ? 0 : 1;
}
