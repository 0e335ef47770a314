/* SPDX-License-Identifier: MIT */
#include "peak.h"

#include "bench.h"

static const bench_peak *const peaks[] = {
    &bench_peak_scalar,
#if defined(__x86_64__) || defined(__i386__)
    &bench_peak_sse2,
    &bench_peak_avx2,
    &bench_peak_avx2_fast,
#elif defined(__aarch64__)
    &bench_peak_neon,
    &bench_peak_neon_fast,
#endif
};

const bench_peak *bench_peak_find(limn_isa isa, limn_family family) {
    for (size_t p = 0; p < sizeof peaks / sizeof *peaks; p++) {
        if (peaks[p]->isa == isa && peaks[p]->family == family) return peaks[p];
    }
    return NULL;
}

double bench_peak_compute(const bench_peak *peak, double seconds) {
    const uint64_t batch = 10000;
    uint64_t steps = 0;
    double elapsed;
    peak->compute(batch);
    const double start = bench_seconds();
    do {
        peak->compute(batch);
        steps += batch;
        elapsed = bench_seconds() - start;
    } while (elapsed < seconds);
    return (double)steps * peak->multiply_adds / elapsed;
}

double bench_peak_store(const bench_peak *peak, float *dst, size_t size, double seconds) {
    uint64_t passes = 0;
    double elapsed;
    peak->store(dst, size, 1);
    const double start = bench_seconds();
    do {
        peak->store(dst, size, 10);
        passes += 10;
        elapsed = bench_seconds() - start;
    } while (elapsed < seconds);
    return (double)passes * (double)size / elapsed;
}
