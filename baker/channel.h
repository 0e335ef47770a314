/* SPDX-License-Identifier: MIT */
/*
 * Channels as meshes of their own: the faces of the mesh that is drawn, but with values in the place
 * of control points, and open where faces do not share them. Values are interpolated by the rules of
 * the mesh, with boundaries along the seams; what is sharp there are OpenSubdiv's modes of linear
 * interpolation (Vtr::FVarLevel).
 */
#ifndef LIMNI_CHANNEL_H
#define LIMNI_CHANNEL_H

#include "base.h"
#include "limn/format.h"

typedef struct limni_channel {
    const char *name;
    limn_file_channel record;
    limni_rules rules;
    limni_mesh mesh; ///< its control point c is what a fan of faces around a vertex shares
    limni_base base;
} limni_channel;

/// The channels of a source: [source->channel_count], which must stay where they are.
///
/// source  that the mesh was built from
/// drawn   of the mesh
/// rules   of the mesh
limn_bake_status limni_channels_begin(limni_context *context, const limni_source *source,
                                      const limni_base *drawn, const limni_rules *rules,
                                      limni_channel **channels);

/// Frees all but the values.
void limni_channels_end(limni_context *context, limni_channel *channels, uint32_t count);

#endif
