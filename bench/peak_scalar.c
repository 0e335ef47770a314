/* SPDX-License-Identifier: MIT */
/* Compiled so that the compiler does not find vectors on its own. */
typedef float wide;

#define PEAK_CHAINS 12

#include "peak_body.h"

const bench_peak bench_peak_scalar = {
    .isa = LIMN_ISA_SCALAR,
    .family = LIMN_FAMILY_REPRODUCIBLE,
    .multiply_adds = PEAK_CHAINS * PEAK_WIDTH,
    .compute = compute,
    .store = store,
};
