/* SPDX-License-Identifier: MIT */
/* What moves the control points of a mesh, in the arrays that are written. */
#ifndef LIMNI_RIG_H
#define LIMNI_RIG_H

#include "mesh.h"

typedef struct limni_control_rig {
    uint32_t influence_count; ///< 0: no joints move them
    uint16_t *joints;         ///< [control_count][influence_count]
    float *weights;
    uint32_t target_count;
    const limn_file_target *targets; ///< [target_count]
    uint32_t *first;                 ///< [target_count + 1] into points and deltas
    uint32_t *points;
    float (*deltas)[3];
} limni_control_rig;

/// Gives the control points of a mesh what its source has for their positions. Of morph targets
/// only what moves is kept.
limn_bake_status limni_rig_build(limni_context *context, const limni_source *source,
                                 const limni_mesh *mesh, limni_control_rig *rig);

/// Keeps some positions of a rig, in their order.
///
/// numbers  [count] ascending
void limni_rig_keep(limni_rig *rig, const uint32_t *numbers, uint32_t count);

void limni_rig_release(limni_context *context, const limni_rig *rig);

#endif
