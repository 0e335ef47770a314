/* SPDX-License-Identifier: MIT */
/*
 * What evaluating a mesh costs, counted: the steps of the kernel, each at what it takes on the
 * machine of docs/performance.md ("Counted time"), so that a mesh costs the same wherever and
 * whenever it is baked.
 */
#ifndef LIMNI_COST_H
#define LIMNI_COST_H

#include "limn/limn.h"

/// Half of what a core of a console has as its second cache. Larger tables compete with the points
/// and vertices of a frame, and count as being elsewhere at every change of class.
#define LIMNI_TABLES_MAX (256u << 10)

/// The level that times are compared at: the middle of those that frames spend time on.
enum { LIMNI_COST_LEVEL = 3 };

/// Picoseconds for positions of all patches, one core.
typedef struct limni_cost {
    uint64_t levels[LIMN_LEVEL_COUNT];
    uint64_t points; ///< limn_mesh_refine(), once a frame
} limni_cost;

/// Needs neither the tables of the mesh nor what its patches list.
///
/// pack  whose the mesh is
void limni_cost_count(const limn_pack *pack, const limn_mesh *mesh, limni_cost *cost);

/// Of a frame in which all patches have that level.
static inline uint64_t limni_cost_frame(const limni_cost *cost, uint32_t level) {
    return cost->levels[level] + cost->points;
}

/// Nanoseconds per patch.
static inline double limni_cost_per_patch(uint64_t cost, uint32_t patch_count) {
    return patch_count ? (double)cost / 1000 / patch_count : 0;
}

#endif
