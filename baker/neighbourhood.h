/* SPDX-License-Identifier: MIT */
/* A part of a mesh: all that the coefficients of one face, or of one vertex, depend on. */
#ifndef LIMNI_NEIGHBOURHOOD_H
#define LIMNI_NEIGHBOURHOOD_H

#include "mesh_sharpness.h"

/// Without positions. The vertices of `mesh` are slots. Those that matter, the *inner* ones, come
/// first and have whole stars: all faces around them are there. Others have no first half-edge, and
/// where faces end that touch no inner vertex, the mesh does.
typedef struct limni_neighbourhood {
    limni_mesh mesh; ///< face 0 is the face itself, with slots 0, 1, ... as its corners
    limni_mesh_sharpness sharpness;
    uint32_t *faces; ///< [mesh.face_count] of the mesh that it is a part of
    const uint32_t
        *twins; ///< [slots] of slots that are in the same place for ever, the first, which
                ///< has the coefficients of all; NULL: none are
} limni_neighbourhood;

/// What is taken out of a mesh.
typedef struct limni_cutting {
    const limni_mesh *mesh;
    const limni_mesh_sharpness *sharpness;
    const uint32_t *controls; ///< [control_count] the control point of each slot
    uint32_t control_count;
    uint32_t inner_count;
    uint32_t half_edge; ///< starts at slot 0, in what will be face 0
    bool with_edges;    ///< whether the sharpness of edges matters
} limni_cutting;

limn_bake_status limni_neighbourhood_begin(limni_context *context, const limni_cutting *cutting,
                                           limni_neighbourhood *neighbourhood);

/// A vertex and the faces around it as a neighbourhood of their own: slot 0 is the vertex, 1 + r
/// ring vertex r, and in quads 1 + count + f diagonal f. Its first half-edge leads to ring vertex
/// 0. Has no `faces`.
limn_bake_status limni_fan_begin(limni_context *context, const limni_star *star,
                                 limni_neighbourhood *fan);

void limni_neighbourhood_end(limni_context *context, limni_neighbourhood *neighbourhood);

#endif
