/* SPDX-License-Identifier: MIT */
#include "options.h"

#include "../arguments.h"

#include <stdio.h>
#include <string.h>

static const char help[] =
    "Usage: limn-bench frame [OPTIONS]\n\n"
    "Makes the frames of a scene, with a camera and characters that move, and prints what each\n"
    "stage takes: p50, p95, p99 and the longest, in ms, and its share of all frames.\n\n"
    "  skin       clips, morph targets and skin: control points\n"
    "  refine     points behind the control points, where a mesh has any\n"
    "  normals    limit normals of the base vertices\n"
    "  plan       views, who is in view, and levels\n"
    "  evaluate   positions and unit normals, as floats\n"
    "  light      what colours add to that\n"
    "  pack       what packed formats add to that, which may be less than nothing\n"
    "  draw       drawing, where there is --draw\n"
    "  frame      all of it, as it is done: skin to plan, and one evaluation with light and "
    "packing\n\n"
    "Light and packing are part of evaluation, which is timed three times in each frame, in\n"
    "changing order: as the scene wants it, without packing, and without light.\n\n"
    "Peers write positions and normals as floats, without light. Who is out of view costs none of\n"
    "them anything. Each character is made by one thread, but those of Limn.\n\n"
    "Lengths in a scene are in diagonals of the mesh, from the middle of its bounds.\n\n"
    "Options:\n"
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
    "  --draw         beside Limn, Limn as limn-view draws it: vertices of 48 bytes, written into\n"
    "                 what is drawn, and OpenGL in software, on all cores, until the picture is\n"
    "                 there; made by one thread\n"
    "  --find-crowd   the largest crowd of each way that keeps the budget at p99, on the scene's "
    "area\n"
    "  --json FILE    all results, for limn-bench compare\n"
    "  --csv FILE     a line per frame\n"
    "  --html FILE    a page with pictures\n"
    "  --png FILE     instead of all that, a picture of a frame: triangles, borders of patches, "
    "and\n"
    "                 a colour for each level, as with limn-view --colour levels --wireframe\n"
    "  --frame N      that frame, counted from 0 (default 0)\n"
    "  --size WxH     of the picture, whose levels are those of the scene's viewport, which is "
    "the\n"
    "                 default\n\n"
    "Peers:\n"
    "  floats         Limn, writing what they write\n"
    "  dense          the mesh of level 4, or of the scene's level, skinned: AVX2 or SSE2, four\n"
    "                 bones a vertex\n"
    "  discrete       the meshes of levels 0 to 4 skinned: one for each character, the coarsest\n"
    "                 that keeps the tolerance at its distance\n"
    "  stencils       OpenSubdiv's limit stencils of the same levels, chosen likewise; two\n"
    "                 derivatives in place of normals\n"
    "  bfr            OpenSubdiv's Bfr surfaces, likewise\n\n";

static const char scene_help[] = "Lines of a scene:\n" FRAME_SCRIPT_HELP;

enum { FRAMES_MAX = 10000, ROUNDS_MAX = 1000, THREADS_MAX = 64, PICTURE_SIDE_MAX = 8192 };

const frame_peer frame_peers[] = {
    {"floats", frame_ways_add_floats},     {"dense", frame_ways_add_dense},
    {"discrete", frame_ways_add_discrete},
#ifdef BENCH_WITH_OPENSUBDIV
    {"stencils", frame_ways_add_stencils}, {"bfr", frame_ways_add_bfr},
#endif
};

enum { PEER_COUNT = sizeof frame_peers / sizeof *frame_peers };

const uint32_t frame_peer_count = PEER_COUNT;

static bool find_peer(const char *name, size_t length, uint32_t *bit) {
    for (uint32_t p = 0; p < PEER_COUNT; p++) {
        if (strlen(frame_peers[p].name) != length ||
            strncmp(frame_peers[p].name, name, length) != 0)
            continue;
        *bit = 1u << p;
        return true;
    }
    return false;
}

/// Names with commas between them, or "all".
static bool parse_peers(const char *list, uint32_t *chosen) {
    *chosen = (1u << PEER_COUNT) - 1;
    if (strcmp(list, "all") == 0) return true;
    *chosen = 0;
    while (*list) {
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

static bool parse_run(int option, frame_options *to) {
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
    frame_options *const to = parsed;
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
    case 'd':
        return to->draws = true;
    case 'g':
        return take(&to->png);
    case 'N':
        return bench_parse_range(optarg, 0, FRAMES_MAX - 1, &to->frame);
    case 'z':
        return limni_parse_size(optarg, PICTURE_SIDE_MAX, &to->width, &to->height);
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

bool frame_options_script(const frame_options *o, frame_script *script) {
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

static bool check(const frame_options *o) {
    const char *wrong = NULL;
    if ((o->threads > 1 || o->draws) && strcmp(o->clock, "wall") != 0)
        wrong = "--clock thread is of one thread";
    if (o->frame >= o->length.frames) wrong = "--frame: there are not so many --frames";
    if (o->png && (o->json || o->csv || o->html || o->draws || o->finds_crowd))
        wrong = "a --png is made instead of measuring";
    if ((o->frame > 0 || o->width > 0) && !o->png) wrong = "--frame and --size are of a --png";
#ifndef BENCH_WITH_DRAWING
    if (o->draws || o->png) wrong = "--draw and --png: built without limn-view";
#endif
    if (wrong) fprintf(stderr, "limn-bench: %s\n", wrong);
    return !wrong;
}

int frame_options_read(frame_options *o, int argc, char **argv) {
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
                                          {"draw", no_argument, NULL, 'd'},
                                          {"png", required_argument, NULL, 'g'},
                                          {"frame", required_argument, NULL, 'N'},
                                          {"size", required_argument, NULL, 'z'},
                                          {"json", required_argument, NULL, 'j'},
                                          {"csv", required_argument, NULL, 'c'},
                                          {"html", required_argument, NULL, 'w'},
                                          {"help", no_argument, NULL, 'h'},
                                          {0}};
    *o = (frame_options){.scene = "crowd",
                         .clock = "wall",
                         .length = {120, 3},
                         .budget = 16.6f,
                         .threads = 1,
                         .isa = LIMN_ISA_ALL};
    char text[sizeof help + sizeof scene_help];
    snprintf(text, sizeof text, "%s%s", help, scene_help);
    const int status = bench_read_options(argc, argv, text, names, parse_option, o);
    if (status >= 0) return status;
    if (optind < argc) {
        fprintf(stderr, "limn-bench: unexpected '%s'; see limn-bench frame --help\n", argv[optind]);
        return 2;
    }
    return check(o) ? -1 : 2;
}
