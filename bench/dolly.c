/* SPDX-License-Identifier: MIT */
/*
 * limn-bench dolly: how far levels of detail move the surface while a camera comes nearer, with
 * morphing and without.
 */
#include "arguments.h"
#include "bench.h"
#include "drawn.h"
#include "lods.h"
#include "mixes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char help[] =
    "Usage: limn-bench dolly [OPTIONS] MESH\n\n"
    "Moves a camera towards the middle of MESH (.obj, .off or .limn), and from frame to frame\n"
    "compares the surface that is drawn, at the parameters of all rows of level 4. Prints CSV to\n"
    "standard output; lengths in pixels of a picture 720 pixels high, with a field of view of\n"
    "40 degrees:\n\n"
    "  frame, distance  in diagonals of the mesh's bounds\n"
    "  vertices         of the frame\n"
    "  movement         the largest of all points but those of the last\n"
    "  bound            step of the edges' levels, times how far a vertex is from the middle of\n"
    "                   its parents: the largest that such a patch may move by\n"
    "  seams            the largest movement of points of patches of which an edge comes to\n"
    "                   level 0 or from there\n"
    "  no_morph         the largest movement of all points when morphing is off\n\n"
    "Options:\n"
    "  --lod NAME        how levels are chosen: length (default) or another of limn-bench plan\n"
    "  --pixels N        tolerance (default 8)\n"
    "  --min-level N     of all edges (default 0)\n"
    "  --from D, --to D  distances of the first and the last frame (default 16 and 1)\n"
    "  --frames N        (default 600) steps are equal shares of the distance\n";

typedef struct options {
    limn_lod_desc desc;
    float from, to;
    uint32_t frames;
} options;

/// A mesh and two frames of it, in turn the newer one.
typedef struct dolly {
    drawn_mesh drawn;
    drawn_frame frames[2];
} dolly;

static bool create(dolly *d, const limn_mesh *mesh) {
    const bool good = drawn_mesh_create(&d->drawn, mesh);
    return good && drawn_frame_create(&d->frames[0], &d->drawn) &&
           drawn_frame_create(&d->frames[1], &d->drawn);
}

static void destroy(dolly *d) {
    drawn_frame_destroy(&d->frames[0]);
    drawn_frame_destroy(&d->frames[1]);
    drawn_mesh_destroy(&d->drawn);
}

static limn_view view_from(const limn_mesh *mesh, double diagonals) {
    static const float direction[3] = {0.546f, 0.309f, 0.779f}, up[3] = {0, 1, 0};
    float middle[3], eye[3], diagonal = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float low = mesh->bounds_min[axis], high = mesh->bounds_max[axis];
        middle[axis] = (low + high) / 2;
        diagonal = hypotf(diagonal, high - low);
    }
    for (int axis = 0; axis < 3; axis++)
        eye[axis] = middle[axis] + direction[axis] * diagonal * (float)diagonals;
    return limn_view_perspective(eye, middle, up, 0.698f, 1280, 720, diagonal / 1000,
                                 diagonal * 1000);
}

/// One frame with and without morphing, compared with the one before.
static void print_frame(dolly with[2], const options *o, uint32_t frame) {
    const double along = (double)frame / (double)(o->frames - 1);
    const double diagonals = (double)o->from * pow((double)o->to / (double)o->from, along);
    const limn_view view = view_from(&with[0].drawn.mesh, diagonals);
    drawn_motion motions[2];
    for (int k = 0; k < 2; k++) {
        drawn_frame *const now = &with[k].frames[frame % 2];
        limn_lod_desc desc = o->desc;
        desc.no_morph = k == 1;
        drawn_frame_make(now, &view, &desc);
        if (frame > 0) motions[k] = drawn_move(&with[k].frames[1 - frame % 2], now);
    }
    if (frame == 0) return;
    printf("%u,%.5g,%llu,%.5f,%.5f,%.5f,%.5f\n", frame, diagonals,
           (unsigned long long)with[0].frames[frame % 2].plan.vertex_count, motions[0].pixels,
           motions[0].bound, motions[0].seam_pixels,
           fmax(motions[1].pixels, motions[1].seam_pixels));
}

static bool run(const options *o, const char *path) {
    bench_mix mix;
    dolly with[2] = {0};
    bool good = bench_mix_file(&mix, path, (bench_way){0});
    if (good) {
        good = create(&with[0], &mix.mesh) && create(&with[1], &mix.mesh);
        if (!good) fputs("limn-bench: out of memory\n", stderr);
    }
    if (good) {
        printf("# ");
        bench_print_conditions(stdout);
        puts("frame,distance,vertices,movement,bound,seams,no_morph");
    }
    for (uint32_t frame = 0; frame < o->frames && good; frame++)
        print_frame(with, o, frame);
    destroy(&with[0]);
    destroy(&with[1]);
    bench_mix_destroy(&mix);
    return good && fflush(stdout) == 0;
}

static bool parse_option(int option, void *parsed) {
    options *const to = parsed;
    const bench_lod *lod;
    switch (option) {
    case 'l':
        lod = bench_lod_find(optarg);
        if (lod) to->desc.lod = lod->desc.lod;
        return lod != NULL;
    case 'p':
        return limni_parse_real(optarg, 1e-6f, 1e6f, &to->desc.pixels);
    case 'm':
        return limni_parse_real(optarg, 0, LIMN_LEVEL_MAX, &to->desc.min_level);
    case 'f':
        return limni_parse_real(optarg, 1e-3f, 1e6f, &to->from);
    case 't':
        return limni_parse_real(optarg, 1e-3f, 1e6f, &to->to);
    case 'n':
        return bench_parse_range(optarg, 2, 1000000, &to->frames);
    default:
        return false;
    }
}

int bench_dolly(int argc, char **argv) {
    static const struct option names[] = {{"lod", required_argument, NULL, 'l'},
                                          {"pixels", required_argument, NULL, 'p'},
                                          {"min-level", required_argument, NULL, 'm'},
                                          {"from", required_argument, NULL, 'f'},
                                          {"to", required_argument, NULL, 't'},
                                          {"frames", required_argument, NULL, 'n'},
                                          {"help", no_argument, NULL, 'h'},
                                          {0}};
    options o = {.desc = {.lod = LIMN_LOD_LENGTH, .pixels = 8}, .from = 16, .to = 1, .frames = 600};
    const int status = bench_read_options(argc, argv, help, names, parse_option, &o);
    if (status >= 0) return status;
    if (optind + 1 != argc) {
        fputs("limn-bench: one mesh; see limn-bench dolly --help\n", stderr);
        return 2;
    }
    return run(&o, argv[optind]) ? 0 : 1;
}
