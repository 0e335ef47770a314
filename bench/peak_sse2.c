/* SPDX-License-Identifier: MIT */
typedef float wide __attribute__((vector_size(16), may_alias));

#define PEAK_CHAINS 12

#include "peak_body.h"

const bench_peak bench_peak_sse2 = {
    .isa = LIMN_ISA_SSE2,
    .family = LIMN_FAMILY_REPRODUCIBLE,
    .multiply_adds = PEAK_CHAINS * PEAK_WIDTH,
    .compute = compute,
    .store = store,
};
