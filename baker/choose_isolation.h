/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_CHOOSE_ISOLATION_H
#define LIMNI_CHOOSE_ISOLATION_H

#include "patches.h"

/// Settles what LIMN_ISOLATE_AUTO means for a mesh, with a note that says why: bakes it both ways,
/// without measuring errors, and decides (docs/design.md, "Isolation"). Other rules stay as they
/// are.
///
/// source      that the base was built from, with its channels
/// rules       in and out: isolate becomes LIMN_ISOLATE_NEVER or LIMN_ISOLATE_ALWAYS
/// footprints  out: not isolated, isolated; 0 where the mesh is too large for that
limn_bake_status limni_choose_isolation(limni_context *context, const limni_source *source,
                                        const limni_base *base, limni_rules *rules,
                                        limni_footprint footprints[2]);

#endif
