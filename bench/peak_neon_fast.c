/* SPDX-License-Identifier: MIT */
#include <arm_neon.h>

typedef float32x4_t wide;

#define PEAK_CHAINS 16 ///< 4 pipes of 4 cycles; compilers unroll no longer loops
#define PEAK_FUSED(a, b, c) vfmaq_f32(c, a, b)

#include "peak_body.h"

const bench_peak bench_peak_neon_fast = {
    .isa = LIMN_ISA_NEON,
    .family = LIMN_FAMILY_FAST,
    .multiply_adds = PEAK_CHAINS * PEAK_WIDTH,
    .compute = compute,
    .store = store,
};
