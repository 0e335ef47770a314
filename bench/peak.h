/* SPDX-License-Identifier: MIT */
/*
 * What one core can do at most, measured: multiply-adds between registers, and forward stores. One
 * peak_<isa>.c for each table of kernels; peak_body.h is what they share.
 */
#ifndef BENCH_PEAK_H
#define BENCH_PEAK_H

#include "limn/limn.h"

typedef struct bench_peak {
    limn_isa isa;
    limn_family family;     ///< fused, or a multiplication and an addition
    uint32_t multiply_adds; ///< in a step
    /// Runs `steps` steps and returns a number that depends on all of them.
    float (*compute)(uint64_t steps);
    /// Fills `size` bytes, a multiple of 64, `passes` times from front to back.
    void (*store)(float *dst, size_t size, uint64_t passes);
} bench_peak;

/// The peak to hold these kernels against; NULL if none was built.
const bench_peak *bench_peak_find(limn_isa isa, limn_family family);

/// Multiply-adds per second, measured for about `seconds`.
double bench_peak_compute(const bench_peak *peak, double seconds);

/// Bytes per second into a buffer of `size` bytes, a multiple of 64, measured for about `seconds`.
double bench_peak_store(const bench_peak *peak, float *dst, size_t size, double seconds);

extern const bench_peak bench_peak_scalar;
extern const bench_peak bench_peak_sse2;
extern const bench_peak bench_peak_avx2, bench_peak_avx2_fast;
extern const bench_peak bench_peak_neon, bench_peak_neon_fast;

#endif
