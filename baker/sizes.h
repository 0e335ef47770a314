/* SPDX-License-Identifier: MIT */
/* What is stored in a .limn file, in bytes. */
#ifndef LIMNI_SIZES_H
#define LIMNI_SIZES_H

#include "limn/limn.h"

/// The stencil tables of all classes, or of their pieces.
uint64_t limni_tables_size(const limn_pack *pack);

/// The columns of classes that are in pieces.
uint64_t limni_columns_size(const limn_pack *pack);

/// What the patches of a mesh or a channel list: runs, control indices and slots.
uint64_t limni_lists_size(const limn_mesh *mesh);

/// The patches of a mesh: all that grows with its faces.
uint64_t limni_patches_size(const limn_mesh *mesh);

/// The points of level 1 of an isolated mesh, in the bind pose, and their stencils.
uint64_t limni_points_size(const limn_mesh *mesh);

/// The records and rings for the normals of control points; 0 without normals.
uint64_t limni_normals_size(const limn_mesh *mesh);

#endif
