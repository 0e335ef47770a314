/* SPDX-License-Identifier: MIT */
/* The program `limn-bench`: arguments and exit codes only. */
#include "bench.h"
#include "limn/limn.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *summary;
} benches[] = {
    {"bake", bench_bake,
     "time to bake, peak memory, and stored bytes beside OpenSubdiv's stencils"},
    {"compare", bench_compare, "two results of frame: whether one is slower"},
    {"dolly", bench_dolly, "how far levels of detail move the surface, frame by frame, as CSV"},
    {"frame", bench_frame_times, "time of the frames of a scene, stage by stage"},
    {"isolation", bench_isolation, "bytes and time per face of isolated meshes beside dense ones"},
    {"kernels", bench_kernels,
     "time per patch of every kernel, and its share of what this core can do at most"},
    {"light", bench_light, "time to light vertices beside that to evaluate them"},
    {"peers", bench_peers,
     "time per face beside OpenSubdiv, recursive subdivision and dense skinning"},
    {"plan", bench_plan,
     "time to plan a frame beside that to evaluate it; mixed levels; two threads"},
    {"skin", bench_skin, "time to move control points beside that to evaluate their surface"},
    {"weights", bench_weights, "Loop's weights beside Warren's: shape, curvature and tables"},
};

enum { BENCH_COUNT = sizeof benches / sizeof *benches };

static int print_help(FILE *stream, int status) {
    fprintf(stream, "Usage: limn-bench NAME [OPTIONS]\n"
                    "  or:  limn-bench NAME --help\n"
                    "  or:  limn-bench --help | --version\n\n"
                    "Measures Limn, and what does the same.\n\n"
                    "Benchmarks:\n");
    for (int b = 0; b < BENCH_COUNT; b++)
        fprintf(stream, "  %-10s %s\n", benches[b].name, benches[b].summary);
    return status;
}

static int print_version(void) {
    const uint32_t version = limn_version();
    printf("limn-bench %u.%u.%u\n", version >> 16, version >> 8 & 255, version & 255);
    return 0;
}

int main(int argc, char **argv) {
    if (argc < 2) return print_help(stderr, 2);
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) return print_help(stdout, 0);
    if (strcmp(argv[1], "--version") == 0) return print_version();
    for (int b = 0; b < BENCH_COUNT; b++) {
        if (strcmp(argv[1], benches[b].name) == 0) return benches[b].run(argc - 1, argv + 1);
    }
    fprintf(stderr, "limn-bench: there is no benchmark '%s'; see limn-bench --help\n", argv[1]);
    return 2;
}
