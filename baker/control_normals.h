/* SPDX-License-Identifier: MIT */
/* Limit normals of the control points: what a file stores to compute them every frame. */
#ifndef LIMNI_CONTROL_NORMALS_H
#define LIMNI_CONTROL_NORMALS_H

#include "limn/format.h"
#include "mesh.h"
#include "scheme.h"

typedef struct limni_control_normals {
    limn_file_normal *records; ///< [control_count]
    uint32_t *ring;            ///< [ring_size]
    float *weights;            ///< [weight_count], shared by all control points with the same mask
    uint64_t ring_size;
    uint64_t weight_count;
} limni_control_normals;

limn_bake_status limni_control_normals_build(limni_context *context, const limni_mesh *mesh,
                                             const limni_rules *rules,
                                             limni_control_normals *normals);

#endif
