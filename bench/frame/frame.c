/* SPDX-License-Identifier: MIT */
/* limn-bench frame: how long the frames of a scene take, and which stages of them. */
#include "../arguments.h"
#include "../bench.h"
#include "../peers/allocate.h"
#include "find_crowd.h"
#include "report.h"

#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: limn-bench frame [OPTIONS]\n\n"
    "Makes the frames of a scene, with a camera and characters that move, and prints what each\n"
    "stage takes: p50, p95, p99 and the longest, in ms, and its share of all frames.\n\n"
    "  skin       clips, morph targets and skin: control points\n"
    "  refine     points behind the control points, where a mesh has any\n"
    "  normals    limit normals of the base vertices\n"
    "  plan       views, who is in view, and levels\n"
    "  evaluate   positions and unit normals, as floats\n"
    "  light      what colours add to that\n"
    "  pack       what packed formats add to that, which may be less than nothing\n"
    "  frame      all of it, as it is done: skin to plan, and one evaluation with light and "
    "packing\n\n"
    "Light and packing are part of evaluation, which is timed three times in each frame, in\n"
    "changing order: as the scene wants it, without packing, and without light.\n\n"
    "  --scene S      FILE, or hero, crowd, worst or terrain (default crowd)\n"
    "  --mesh FILE    in place of the scene's\n"
    "  --clip NAME    in place of the scene's\n"
    "  --count N      characters, in place of the scene's\n"
    "  --lod WAY:N    in place of the scene's: error:PX, length:PX or uniform:LEVEL\n"
    "  --isolate N    1: bake with small tables, in place of the scene's\n"
    "  --frames N     of the camera's path (default 120), 60 a second for what moves\n"
    "  --rounds N     times that the path is gone (default 3)\n"
    "  --quick        8 frames, 1 round\n"
    "  --budget MS    of a frame (default 16.6)\n"
    "  --threads N    1 to 64 (default 1)\n"
    "  --isa NAME     scalar, sse2, avx2 or neon (default: the best)\n"
    "  --family F     reproducible (default) or fast\n"
    "  --clock C      wall (default); thread: the time that the thread ran, where others use the\n"
    "                 machine, too; of one thread only\n"
    "  --peers LIST   the same frames by other ways: names with commas between, or all\n"
    "  --find-crowd   the largest crowd of each way that keeps the budget at p99, on the scene's "
    "area\n"
    "  --json FILE    all results, for limn-bench compare\n"
    "  --csv FILE     a line per frame\n"
    "  --html FILE    a page with pictures\n\n"
    "Peers write positions and normals as floats, without light. Who is out of view costs none of\n"
    "them anything. Each character is made by one thread, but those of Limn.\n\n"
    "  floats         Limn, writing that\n"
    "  dense          the mesh of level 4, or of the scene's level, skinned: AVX2 or SSE2, four\n"
    "                 bones a vertex\n"
    "  discrete       the meshes of levels 0 to 4 skinned: one for each character, the coarsest\n"
    "                 that keeps the tolerance at its distance\n"
    "  opensubdiv     limit stencils of the same levels, chosen likewise; two derivatives in "
    "place\n"
    "                 of normals\n\n"
    "Lines of a scene, lengths in diagonals of the mesh, from the middle of its "
    "bounds:\n" FRAME_SCRIPT_HELP;

enum { FRAMES_MAX = 10000, ROUNDS_MAX = 1000, THREADS_MAX = 64 };

typedef struct options {
    const char *scene, *mesh, *clip, *lod, *isolate, *clock;
    const char *json, *csv, *html;
    uint32_t count; ///< 0: the scene's
    frame_length length;
    float budget; ///< ms
    uint32_t threads, isa;
    limn_family family;
    uint32_t peers; ///< bit p: peers[p]
    bool finds_crowd;
} options;

static const struct {
    const char *name;
    frame_ways_add *add;
} peers[] = {
    {"floats", frame_ways_add_floats},     {"dense", frame_ways_add_dense},
    {"discrete", frame_ways_add_discrete},
#ifdef BENCH_WITH_OPENSUBDIV
    {"stencils", frame_ways_add_stencils}, {"bfr", frame_ways_add_bfr},
#endif
};

enum { PEER_COUNT = sizeof peers / sizeof *peers };

static bool find_peer(const char *name, size_t length, uint32_t *bit) {
    for (uint32_t p = 0; p < PEER_COUNT; p++) {
        if (strlen(peers[p].name) != length || strncmp(peers[p].name, name, length) != 0) continue;
        *bit = 1u << p;
        return true;
    }
    return false;
}

/// Names with commas between them, or "all".
static bool parse_peers(const char *list, uint32_t *chosen) {
    *chosen = strcmp(list, "all") == 0 ? (1u << PEER_COUNT) - 1 : 0;
    while (*list && *chosen != (1u << PEER_COUNT) - 1) {
        const size_t length = strcspn(list, ",");
        uint32_t bit;
        if (!find_peer(list, length, &bit)) return false;
        *chosen |= bit;
        list += length + (list[length] == ',');
    }
    return *chosen != 0;
}

static bool take(const char **to) {
    *to = optarg;
    return true;
}

static bool parse_family(limn_family *family) {
    const bool fast = strcmp(optarg, "fast") == 0;
    *family = fast ? LIMN_FAMILY_FAST : LIMN_FAMILY_REPRODUCIBLE;
    return fast || strcmp(optarg, "reproducible") == 0;
}

static bool parse_run(int option, options *to) {
    switch (option) {
    case 'n':
        return bench_parse_range(optarg, 1, FRAME_COUNT_MAX, &to->count);
    case 'f':
        return bench_parse_range(optarg, 1, FRAMES_MAX, &to->length.frames);
    case 'r':
        return bench_parse_range(optarg, 1, ROUNDS_MAX, &to->length.rounds);
    case 'q':
        to->length = (frame_length){8, 1};
        return true;
    case 'b':
        return limni_parse_real(optarg, 1e-3f, 1e6f, &to->budget);
    case 't':
        return bench_parse_range(optarg, 1, THREADS_MAX, &to->threads);
    case 'i':
        return bench_parse_isa(optarg, &to->isa);
    case 'y':
        return parse_family(&to->family);
    case 'k':
        take(&to->clock);
        return strcmp(optarg, "wall") == 0 || strcmp(optarg, "thread") == 0;
    default:
        return false;
    }
}

static bool parse_option(int option, void *parsed) {
    options *const to = parsed;
    switch (option) {
    case 's':
        return take(&to->scene);
    case 'm':
        return take(&to->mesh);
    case 'p':
        return take(&to->clip);
    case 'l':
        return take(&to->lod);
    case 'I':
        return take(&to->isolate);
    case 'j':
        return take(&to->json);
    case 'c':
        return take(&to->csv);
    case 'w':
        return take(&to->html);
    case 'o':
        return parse_peers(optarg, &to->peers);
    case 'F':
        return to->finds_crowd = true;
    default:
        return parse_run(option, to);
    }
}

static bool refuse(const char *option, const char *value) {
    fprintf(stderr, "limn-bench: --%s: '%s' is out of range or unknown\n", option, value);
    return false;
}

static bool override_lod(frame_script *script, const char *text) {
    char kind[32];
    const char *const colon = strchr(text, ':');
    if (!colon || (size_t)(colon - text) >= sizeof kind) return false;
    snprintf(kind, sizeof kind, "%.*s", (int)(colon - text), text);
    return frame_script_set_lod(script, kind, colon + 1);
}

/// The scene, with what the options put in its place.
static bool read_script(frame_script *script, const options *o) {
    if (!frame_script_read(script, o->scene)) return false;
    if (o->mesh &&
        (size_t)snprintf(script->mesh, sizeof script->mesh, "%s", o->mesh) >= sizeof script->mesh)
        return refuse("mesh", o->mesh);
    if (o->clip &&
        (size_t)snprintf(script->clip, sizeof script->clip, "%s", o->clip) >= sizeof script->clip)
        return refuse("clip", o->clip);
    if (o->lod && !override_lod(script, o->lod)) return refuse("lod", o->lod);
    if (o->isolate && !frame_script_set_isolate(script, o->isolate))
        return refuse("isolate", o->isolate);
    if (o->count) script->count = o->count;
    return true;
}

// -------------------------------------------------------------------------------------------------
// Files

typedef struct files {
    limni_output_file json, csv, html;
} files;

static bool close_files(files *f, const options *o, bool good) {
    good = bench_results_close(&f->json, o->json, good);
    good = bench_results_close(&f->csv, o->csv, good);
    return bench_results_close(&f->html, o->html, good);
}

static bool open_files(files *f, const options *o) {
    *f = (files){0};
    if (bench_results_open(&f->json, o->json) && bench_results_open(&f->csv, o->csv) &&
        bench_results_open(&f->html, o->html))
        return true;
    return close_files(f, o, false);
}

static bool report(const frame_result *result, const files *f) {
    frame_report_print(stdout, result);
    if (f->csv.stream) frame_report_csv(f->csv.stream, result);
    if (f->html.stream) frame_report_html(f->html.stream, result);
    return !f->json.stream || frame_report_json(f->json.stream, result);
}

// -------------------------------------------------------------------------------------------------
// Running

static bool add_ways(frame_ways *ways, const frame_host *host, const options *o) {
    bool good = frame_ways_add_limn(ways, host);
    for (uint32_t p = 0; p < PEER_COUNT && good; p++)
        good = !(o->peers & 1u << p) || peers[p].add(ways, host);
    return good;
}

static bool measure(const frame_host *host, const frame_ways *ways, const options *o,
                    const files *f) {
    frame_crowd_size crowds[FRAME_WAY_MAX];
    const size_t record_count = (size_t)o->length.frames * o->length.rounds * ways->count;
    frame_record *const records = bench_allocate(record_count, sizeof *records);
    frame_loop_run(host, ways, host->script->count, o->length, records);
    if (o->finds_crowd) frame_find_crowds(host, ways, o->length, 1e-3 * o->budget, crowds);
    const frame_result result = {.host = host,
                                 .ways = ways,
                                 .length = o->length,
                                 .count = host->script->count,
                                 .records = records,
                                 .budget = 1e-3 * o->budget,
                                 .clock = o->clock,
                                 .crowds = o->finds_crowd ? crowds : NULL};
    const bool good = report(&result, f);
    free(records);
    return good;
}

static bool run_script(const frame_script *script, const options *o, const files *f) {
    frame_actor actor;
    frame_ways ways = {.count = 0};
    frame_host host = {.script = script,
                       .actor = &actor,
                       .clock =
                           strcmp(o->clock, "wall") == 0 ? bench_seconds : bench_thread_seconds};
    bool good = frame_actor_create(&actor, script, limn_kernels_select(o->isa, o->family));
    if (good && o->threads > 1) host.threads = team_create(o->threads);
    good = good && add_ways(&ways, &host, o) && measure(&host, &ways, o, f);
    frame_ways_destroy(&ways);
    if (host.threads) team_destroy(host.threads);
    frame_actor_destroy(&actor);
    return good;
}

int bench_frame_times(int argc, char **argv) {
    static const struct option names[] = {{"scene", required_argument, NULL, 's'},
                                          {"mesh", required_argument, NULL, 'm'},
                                          {"clip", required_argument, NULL, 'p'},
                                          {"count", required_argument, NULL, 'n'},
                                          {"lod", required_argument, NULL, 'l'},
                                          {"isolate", required_argument, NULL, 'I'},
                                          {"frames", required_argument, NULL, 'f'},
                                          {"rounds", required_argument, NULL, 'r'},
                                          {"quick", no_argument, NULL, 'q'},
                                          {"budget", required_argument, NULL, 'b'},
                                          {"threads", required_argument, NULL, 't'},
                                          {"isa", required_argument, NULL, 'i'},
                                          {"family", required_argument, NULL, 'y'},
                                          {"clock", required_argument, NULL, 'k'},
                                          {"peers", required_argument, NULL, 'o'},
                                          {"find-crowd", no_argument, NULL, 'F'},
                                          {"json", required_argument, NULL, 'j'},
                                          {"csv", required_argument, NULL, 'c'},
                                          {"html", required_argument, NULL, 'w'},
                                          {"help", no_argument, NULL, 'h'},
                                          {0}};
    static frame_script script;
    options o = {.scene = "crowd",
                 .clock = "wall",
                 .length = {120, 3},
                 .budget = 16.6f,
                 .threads = 1,
                 .isa = LIMN_ISA_ALL};
    files f;
    const int status = bench_read_options(argc, argv, help, names, parse_option, &o);
    if (status >= 0) return status;
    if (optind < argc) {
        fprintf(stderr, "limn-bench: unexpected '%s'; see limn-bench frame --help\n", argv[optind]);
        return 2;
    }
    if (o.threads > 1 && strcmp(o.clock, "wall") != 0) {
        fputs("limn-bench: --clock thread is of one thread\n", stderr);
        return 2;
    }
    if (!read_script(&script, &o) || !open_files(&f, &o)) return 1;
    return close_files(&f, &o, run_script(&script, &o, &f)) ? 0 : 1;
}
