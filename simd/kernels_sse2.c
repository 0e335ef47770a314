/* SPDX-License-Identifier: MIT */
#include "lanes_sse2.h"

#include "base_body.h"

const limn_kernels limni_kernels_sse2 = {
    .name = "sse2",
    .isa = LIMN_ISA_SSE2,
    .family = LIMN_FAMILY_REPRODUCIBLE,
    .evaluate = evaluate_run,
    .evaluate_base = evaluate_base,
    .refine = refine_mesh,
    .control_normals = find_control_normals,
    .skin = skin_range,
};
