/* SPDX-License-Identifier: MIT */
/* The benchmarks. Each returns the exit status of the program. */
#ifndef BENCH_H
#define BENCH_H

#include "output_file.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

int bench_bake(int argc, char **argv);
int bench_compare(int argc, char **argv);
int bench_dolly(int argc, char **argv);
int bench_frame_times(int argc, char **argv);
int bench_isolation(int argc, char **argv);
int bench_kernels(int argc, char **argv);
int bench_light(int argc, char **argv);
int bench_peers(int argc, char **argv);
int bench_plan(int argc, char **argv);
int bench_skin(int argc, char **argv);
int bench_weights(int argc, char **argv);

/// Seconds of a clock that only goes forward.
double bench_seconds(void);

/// Seconds that this thread ran: for samples of a millisecond or so, which others may interrupt.
double bench_thread_seconds(void);

/// The next of a fixed sequence of random numbers below `bound`.
uint32_t bench_random(uint64_t *state, uint32_t bound);

/// The median; reorders the values.
double bench_median(double *values, uint32_t count);

/// The value that a share of all values does not exceed, by the nearest rank; orders the values.
double bench_percentile(double *values, uint32_t count, double share);

/// A file for results, opened before they are measured and renamed when they are complete. Without
/// a path there is none, and no stream. Both say what went wrong.
///
/// good  false: what was at the path stays
/// Returns whether all is well.
bool bench_results_open(limni_output_file *file, const char *path);
bool bench_results_close(limni_output_file *file, const char *path, bool good);

/// For limn_bake_desc.note: what was repaired, on standard error.
void bench_note(void *user, const char *text);

/// One line on what ran where: version, compiler, flags, CPU.
void bench_print_conditions(FILE *stream);

/// The CPU's name for itself; "" where it cannot be had.
void bench_cpu_name(char *name, size_t size);

#ifdef __cplusplus
}
#endif

#endif
