/* SPDX-License-Identifier: MIT */
#if defined(__SSE2__)

#include "lanes_sse2.h"

#include "evaluate_body.h"

const limn_kernels limni_kernels_sse2 = {
    .name = "sse2",
    .isa = LIMN_ISA_SSE2,
    .evaluate = evaluate_run,
};

#else
typedef int limni_kernels_sse2_not_built; // a translation unit needs a declaration
#endif
