/* SPDX-License-Identifier: MIT */
/*
 * Isolation: patches that are evaluated in pieces, the faces of the first level of subdivision. A
 * piece has at most one corner that is not regular, so there are as many tables as kinds of
 * vertices, and not as many as kinds of faces. The class of a face says which four tables its
 * pieces have, and which of its points are the columns of each.
 */
#ifndef LIMNI_ISOLATION_H
#define LIMNI_ISOLATION_H

#include "assignment.h"
#include "refine.h"

typedef struct limni_isolation {
    const limni_mesh *mesh;
    limni_refined refined;
    limni_stencils stencils;     ///< of its points
    limni_classifier classifier; ///< of the refined mesh
    limni_assignment assigned;   ///< of its faces
    uint32_t *slots, *marks;     ///< [points] see limni_classifier
    uint32_t mark;
    size_t points_max; ///< of a patch
    uint32_t *points;  ///< [points_max] of the last patch, by slot
    uint16_t *columns; ///< [LIMN_FORMAT_PIECE_COUNT][points_max]
    uint16_t *parts;   ///< the same, packed behind the pieces: see limni_class
} limni_isolation;

/// isolation  must stay where it is
limn_bake_status limni_isolation_begin(limni_context *context, const limni_mesh *mesh,
                                       const limni_mesh_sharpness *sharpness,
                                       const limni_rules *rules, limni_isolation *isolation);

void limni_isolation_end(limni_context *context, limni_isolation *isolation);

/// Finds the tables of the pieces of a face, and its class.
limn_bake_status limni_isolation_classify(limni_context *context, limni_isolation *isolation,
                                          const limni_rules *rules, uint32_t face,
                                          uint32_t rotation, limni_classes *pieces,
                                          limni_classes *classes, uint32_t *class_index);

/// The points of a face that was classified, by slot, in isolation->points. Returns how many.
uint32_t limni_isolation_list(limni_isolation *isolation, const limni_classes *pieces,
                              uint32_t face, uint32_t rotation);

#endif
