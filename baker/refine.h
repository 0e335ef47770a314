/* SPDX-License-Identifier: MIT */
/*
 * One level of subdivision, explicitly: the mesh that isolation makes its patches from. Point c of
 * it belongs to control point c, and behind those there is one for each edge. Face f becomes faces
 * 4f + k, at its corners k, each of which starts with that corner's point, and 4f + 3 between the
 * middles of its edges 0, 1 and 2.
 */
#ifndef LIMNI_REFINE_H
#define LIMNI_REFINE_H

#include "limn/format.h"
#include "mesh_sharpness.h"

typedef struct limni_refined {
    limni_mesh mesh;                ///< without positions, which follow from the control points
    limni_mesh_sharpness sharpness; ///< what is left after the level
    uint32_t *stencils;             ///< [mesh.control_count + 1] where the terms of a point begin
    limn_file_term *terms;          ///< [stencils[mesh.control_count]]
} limni_refined;

limn_bake_status limni_refine(limni_context *context, const limni_mesh *mesh,
                              const limni_mesh_sharpness *sharpness, const limni_rules *rules,
                              limni_refined *refined);

/// Frees all but the stencils and their terms.
void limni_refined_end(limni_context *context, limni_refined *refined);

#endif
