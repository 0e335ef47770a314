/* SPDX-License-Identifier: MIT */
typedef float wide __attribute__((vector_size(16), may_alias));

#define PEAK_CHAINS 16 ///< 4 pipes of 4 cycles; compilers unroll no longer loops

#include "peak_body.h"

const bench_peak bench_peak_neon = {
    .isa = LIMN_ISA_NEON,
    .family = LIMN_FAMILY_REPRODUCIBLE,
    .multiply_adds = PEAK_CHAINS * PEAK_WIDTH,
    .compute = compute,
    .store = store,
};
