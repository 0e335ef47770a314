/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_RUNTIME_MESH_H
#define LIMNI_RUNTIME_MESH_H

#include "kernels.h"

/// The run that holds `patch_index`: the last one that starts at or before it.
uint32_t limni_find_run(const limn_mesh *mesh, uint32_t patch_index);

/// Patches [begin, end) of a run, counted within it, as the kernels take them.
limni_run limni_run_part(const limn_mesh *mesh, const limn_file_run *run, uint32_t begin,
                         uint32_t end);

#endif
