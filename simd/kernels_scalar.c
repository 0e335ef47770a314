/* SPDX-License-Identifier: MIT */
#include "lanes_scalar.h"

#include "base_body.h"

const limn_kernels limni_kernels_scalar = {
    .name = "scalar",
    .isa = LIMN_ISA_SCALAR,
    .family = LIMN_FAMILY_REPRODUCIBLE,
    .evaluate = evaluate_run,
    .evaluate_base = evaluate_base,
    .refine = refine_mesh,
    .control_normals = find_control_normals,
    .skin = skin_range,
};
