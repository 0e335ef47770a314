/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_RUNTIME_MESH_H
#define LIMNI_RUNTIME_MESH_H

#include "kernels.h"

/// The run that holds `patch_index`: the last one that starts at or before it.
uint32_t limni_find_run(const limn_mesh *mesh, uint32_t patch_index);

/// The index that stands for control point 0 where the corners of patches are: in pieces, these are
/// points of level 1, of which the first belong to the control points.
static inline uint32_t limni_first_corner(const limn_mesh *mesh, const limn_file_class *class) {
    return class->depth == LIMN_FORMAT_PIECE_DEPTH ? mesh->control_count : 0;
}

/// Patches [begin, end) of a run, counted within it, as the kernels take them.
limni_run limni_run_part(const limn_mesh *mesh, const limn_file_run *run, uint32_t begin,
                         uint32_t end);

#endif
