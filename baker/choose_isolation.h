/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_CHOOSE_ISOLATION_H
#define LIMNI_CHOOSE_ISOLATION_H

#include "patches.h"

/// Half of what a core of a console has as its second cache. Larger tables compete with the points
/// and vertices of a frame; smaller ones stay there, and patches with one table are quicker.
#define LIMNI_TABLES_MAX (256u << 10)

/// Bakes the mesh both ways, without measuring errors, and decides (docs/design.md, "Isolation").
///
/// footprints  out: not isolated, isolated; 0 where the mesh is too large for that
/// isolate     out: LIMN_ISOLATE_NEVER or LIMN_ISOLATE_ALWAYS
limn_bake_status limni_choose_isolation(limni_context *context, const limni_base *base,
                                        const limni_rules *rules, limni_footprint footprints[2],
                                        limn_isolate *isolate);

#endif
