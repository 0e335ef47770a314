/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_RULES_H
#define LIMNI_RULES_H

#include "fixed.h"
#include "limn/bake.h"

/// The options that decide the masks. Meshes of one file may differ in what limn_bake_desc leaves
/// to them.
typedef struct limni_rules {
    limn_scheme scheme;
    limn_weights weights;
    limni_fixed tension;    ///< of the butterfly
    limn_boundary boundary; ///< not the default, nor that of creasing
    limn_creases creases;
    limn_creasing creasing; ///< uniform with Lomont's creases
    limn_normals normals;
    limn_isolate isolate;
    limn_face_varying face_varying;
} limni_rules;

#endif
