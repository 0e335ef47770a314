/* SPDX-License-Identifier: MIT */
/* Levels of edges, for a block of patches at a time. */
#ifndef LIMNI_LOD_H
#define LIMNI_LOD_H

#include "limn/limn.h"

/// With the defaults filled in.
///
/// desc  NULL: all defaults
limn_lod_desc limni_lod_complete(const limn_lod_desc *desc);

/// Whether levels of a mesh can be chosen so; of what is complete.
bool limni_lod_is_valid(const limn_lod_desc *desc, const limn_mesh *mesh);

enum { LIMNI_LOD_BLOCK = 64 };

/// What edges are measured by: structure of arrays, so that compilers find vectors.
typedef struct limni_lod_block {
    _Alignas(64) float corners[LIMN_CORNER_MAX][3][LIMNI_LOD_BLOCK];
    uint16_t errors[LIMN_CORNER_MAX][LIMNI_LOD_BLOCK]; ///< of edges, for LIMN_LOD_ERROR
} limni_lod_block;

typedef struct limni_lod_levels {
    float edges[LIMN_CORNER_MAX][LIMNI_LOD_BLOCK];
} limni_lod_levels;

/// The levels of all edges of a block, before limits and budget: from the edge alone. Exchanging
/// its ends changes no bit, so that both patches at an edge find the same.
void limni_lod_measure(const limn_lod_desc *desc, const limn_view *views, uint32_t view_count,
                       uint32_t corner_count, const limni_lod_block *block,
                       limni_lod_levels *levels);

/// What a block of patches is drawn with.
typedef struct limni_lod_choice {
    _Alignas(64) float edge_morphs[LIMN_CORNER_MAX][LIMNI_LOD_BLOCK], morphs[LIMNI_LOD_BLOCK];
    int32_t edge_levels[LIMN_CORNER_MAX][LIMNI_LOD_BLOCK], levels[LIMNI_LOD_BLOCK];
    int32_t places[LIMNI_LOD_BLOCK]; ///< of the template among those of its level
} limni_lod_choice;

/// Whole levels and weights, from the levels of edges.
///
/// lowered  subtracted from all levels
void limni_lod_choose(const limn_lod_desc *desc, uint32_t corner_count,
                      const limni_lod_levels *levels, float lowered, limni_lod_choice *choice);

#endif
