/* SPDX-License-Identifier: MIT */
#define LANES_FUSED
#include "lanes_neon.h"

#include "base_body.h"

const limn_kernels limni_kernels_neon_fast = {
    .name = "neon",
    .isa = LIMN_ISA_NEON,
    .family = LIMN_FAMILY_FAST,
    .evaluate = evaluate_run,
    .evaluate_base = evaluate_base,
    .refine = refine_mesh,
    .control_normals = find_control_normals,
    .skin = skin_range,
};
