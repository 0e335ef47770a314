/* SPDX-License-Identifier: MIT */
/*
 * Limit normals of the control points: what a file stores to compute them every frame. A control
 * point has one; on a crease that stays sharp it has one for each side, and at a corner one for
 * each face.
 */
#ifndef LIMNI_CONTROL_NORMALS_H
#define LIMNI_CONTROL_NORMALS_H

#include "limn/format.h"
#include "mesh_sharpness.h"

typedef struct limni_control_normals {
    limn_file_normal *records; ///< [control_count]
    limn_file_side *sides;     ///< [side_count] further ones
    uint32_t side_count;
    uint32_t
        *corners;   ///< [half_edge_count] by half-edge: the normal of the corner where it starts,
                    ///< sides counting from control_count on; NULL: there are none
    uint32_t *ring; ///< [ring_size]
    float *weights; ///< [weight_count]
    uint64_t ring_size;
    uint64_t weight_count;
} limni_control_normals;

limn_bake_status limni_control_normals_build(limni_context *context, const limni_mesh *mesh,
                                             const limni_mesh_sharpness *sharpness,
                                             const limni_rules *rules,
                                             limni_control_normals *normals);

#endif
