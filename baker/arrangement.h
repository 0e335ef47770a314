/* SPDX-License-Identifier: MIT */
/* How the faces of a base mesh become patches: their classes, frames and points. */
#ifndef LIMNI_ARRANGEMENT_H
#define LIMNI_ARRANGEMENT_H

#include "base.h"
#include "isolation.h"

typedef struct limni_arrangement {
    const limni_base *base;
    const limni_rules *rules;
    limni_classes *classes, *pieces;
    bool apart;             ///< each face is classified on its own
    const limni_mesh *mesh; ///< whose faces are classified: that of the base, or where they are
                            ///< apart, one whose corners are its half-edges
    const limni_mesh_sharpness *sharpness;
    limni_mesh apart_mesh;
    limni_mesh_sharpness apart_sharpness;
    limni_classifier classifier;
    limni_assignment assigned; ///< its keys: without isolation
    uint32_t *class_indices;   ///< [face_count]; holes have none
    limni_isolation isolation; ///< empty without it
} limni_arrangement;

/// Classifies all faces that are no holes; adds the classes and the pieces that are new. Checks that
/// faces which share an edge agree on it, and fails with LIMN_BAKE_INTERNAL if any two do not.
///
/// rotations    [face_count] of a channel, those of the mesh that is drawn; NULL: the canonical ones
/// arrangement  must stay where it is
limn_bake_status limni_arrangement_begin(limni_context *context, const limni_base *base,
                                         const limni_rules *rules, const uint32_t *rotations,
                                         limni_classes *classes, limni_classes *pieces,
                                         limni_arrangement *arrangement);
void limni_arrangement_end(limni_context *context, limni_arrangement *arrangement);

static inline const limni_class *limni_arrangement_class(const limni_arrangement *a,
                                                         uint32_t face) {
    return &a->classes->items[a->class_indices[face]];
}

/// The points of a patch: vertices of the base mesh, or of the level that isolates it, which follow
/// those. Returns how many.
///
/// pairs  out: [LIMN_FORMAT_CONTROLS_MAX] point << 32 | slot
uint32_t limni_arrangement_list(limni_arrangement *arrangement, uint32_t face, uint64_t *pairs);

#endif
