/* SPDX-License-Identifier: MIT */
/*
 * The mesh whose faces become patches: that of the source, or where it has polygons that are not
 * patches of its domain, what one level of subdivision makes of it.
 */
#ifndef LIMNI_BASE_H
#define LIMNI_BASE_H

#include "refine.h"

typedef struct limni_base {
    const limni_mesh *mesh;
    const limni_mesh_sharpness *sharpness;
    bool divided;
    uint32_t first; ///< among all points, its vertex 0

    const limni_mesh *source;
    limni_mesh_sharpness source_sharpness;
    limni_refined refined;   ///< where it is divided, with positions,
    limni_stencils stencils; ///< and how these follow from the control points
} limni_base;

/// base  must stay where it is, and the source with it
limn_bake_status limni_base_begin(limni_context *context, const limni_mesh *source,
                                  const limni_rules *rules, limni_base *base);

/// The base of a channel of a mesh, whose faces correspond to those of the mesh that is drawn.
///
/// sharpness  of the source; becomes the base's
limn_bake_status limni_base_follow(limni_context *context, const limni_base *drawn,
                                   const limni_mesh *source, const limni_mesh_sharpness *sharpness,
                                   const limni_rules *rules, limni_base *base);
void limni_base_end(limni_context *context, limni_base *base);

/// Points behind control points, as the runtime computes them.
///
/// points  [control_count + count][3], of which the last are written
void limni_place_points(const limni_stencils *stencils, float (*points)[3], uint32_t control_count,
                        uint32_t count);

#endif
