/* SPDX-License-Identifier: MIT */
#include <immintrin.h>

typedef __m256 wide;

#define PEAK_CHAINS 12
#define PEAK_FUSED(a, b, c) _mm256_fmadd_ps(a, b, c)

#include "peak_body.h"

const bench_peak bench_peak_avx2_fast = {
    .isa = LIMN_ISA_AVX2,
    .family = LIMN_FAMILY_FAST,
    .multiply_adds = PEAK_CHAINS * PEAK_WIDTH,
    .compute = compute,
    .store = store,
};
