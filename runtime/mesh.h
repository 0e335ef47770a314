/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_RUNTIME_MESH_H
#define LIMNI_RUNTIME_MESH_H

#include "kernels.h"

/// The run that holds `patch_index`: the last one that starts at or before it.
uint32_t limni_find_run(const limn_mesh *mesh, uint32_t patch_index);

/// The points of an isolated mesh go on behind the base vertices: one for each of these, and others.
static inline bool limni_is_isolated(const limn_mesh *mesh) {
    return mesh->point_count > mesh->base_first + mesh->base_count;
}

/// The index that stands for the first base vertex where the corners of patches are: of an isolated
/// mesh, that of the point which belongs to it.
static inline uint32_t limni_first_corner(const limn_mesh *mesh) {
    return mesh->base_first + (limni_is_isolated(mesh) ? mesh->base_count : 0);
}

/// Patches [begin, end) of a run, counted within it, as the kernels take them.
limni_run limni_run_part(const limn_mesh *mesh, const limn_file_run *run, uint32_t begin,
                         uint32_t end);

#endif
