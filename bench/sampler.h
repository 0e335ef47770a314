/* SPDX-License-Identifier: MIT */
/* How long patches take, with the tables in the caches and out of them. */
#ifndef BENCH_SAMPLER_H
#define BENCH_SAMPLER_H

#include "mixes.h"

/// What is written.
typedef struct bench_output {
    const char *name;
    uint32_t vertex_size;   ///< bytes
    uint32_t sums;          ///< multiply-adds per row and control point
    bool all_modes;         ///< else only in class order and warm
    uint32_t normal_offset; ///< of the normal in its vertex; 0: normals have half of the buffer
    limn_output form;       ///< without addresses; normal_stride 0: no normals
} bench_output;

/// A further output is one entry.
enum { BENCH_POSITION, BENCH_POSITION_NORMAL, BENCH_OUTPUT_COUNT = 5 };
extern const bench_output bench_outputs[BENCH_OUTPUT_COUNT];

/// What is evaluated, and how.
typedef struct bench_load {
    const bench_mix *mix;
    const limn_kernels *kernels;
    const bench_output *output;
    uint32_t level;
    const uint32_t *order; ///< [patch_count] ranges of one patch; NULL: in file order, ranges of as
                           ///< many as the buffer holds
    double patch_count, control_count; ///< of all samples up to now
} bench_load;

/// Vertices go to a buffer that is used again and again.
typedef struct bench_sampler {
    unsigned char *buffer;
    size_t buffer_size; ///< bytes, a multiple of 4096
    double seconds;     ///< that a sample takes, at least
    uint64_t random;
} bench_sampler;

/// The record of the class of a patch.
const struct limn_file_class *bench_class_of(const bench_mix *mix, uint32_t patch);

/// Seconds per patch: of the whole mesh, again and again.
double bench_sample_warm(const bench_sampler *sampler, bench_load *load);

/// Seconds per patch: of a few patches, after their tables, but nothing else, were taken out of the
/// caches.
double bench_sample_cold(bench_sampler *sampler, bench_load *load);

#endif
