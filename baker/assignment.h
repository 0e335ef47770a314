/* SPDX-License-Identifier: MIT */
/* Which class each face of a mesh has, and the check that neighbours agree. */
#ifndef LIMNI_ASSIGNMENT_H
#define LIMNI_ASSIGNMENT_H

#include "classes.h"

/// What is known of each face. Holes have nothing.
typedef struct limni_assignment {
    uint32_t *keys;      ///< [face_count] indices of class keys
    uint32_t *rotations; ///< [face_count]
} limni_assignment;

limn_bake_status limni_assignment_begin(limni_context *context, uint32_t face_count,
                                        limni_assignment *assigned);
void limni_assignment_end(limni_context *context, const limni_assignment *assigned);

/// Every pair of faces must give the rows of the edge they share the same coefficients of the same
/// points; otherwise the surface would crack. Fails with LIMN_BAKE_INTERNAL if any two do not.
///
/// classifier  of the mesh
limn_bake_status limni_check_agreement(limni_context *context, limni_classifier *classifier,
                                       const limni_classes *classes,
                                       const limni_assignment *assigned);

#endif
