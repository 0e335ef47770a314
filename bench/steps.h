/* SPDX-License-Identifier: MIT */
/* The command line of benchmarks that measure the steps of a frame, mesh by mesh: light and skin. */
#ifndef BENCH_STEPS_H
#define BENCH_STEPS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { BENCH_ROUND_MAX = 1000 };

typedef struct bench_steps_options {
    uint32_t isa;    ///< mask for limn_kernels_select()
    uint32_t rounds; ///< 1 to BENCH_ROUND_MAX
    double sample_seconds;
    const char *csv; ///< NULL: none
} bench_steps_options;

typedef struct bench_steps {
    const char *help;
    const char *columns; ///< of the CSV
    /// Measures and prints one mesh; false: it said why not.
    ///
    /// path  NULL: the benchmark's own mesh
    /// csv   NULL: none
    bool (*measure)(const char *path, const bench_steps_options *options, FILE *csv);
} bench_steps;

/// Reads the options --isa, --rounds, --quick, --csv and --help, and measures all meshes that are
/// named, or where none is, the benchmark's own. Returns the exit status.
int bench_steps_run(int argc, char **argv, const bench_steps *steps);

#endif
