/* SPDX-License-Identifier: MIT */
/* The meshes of a pack in one moment of an animation clip. */
#ifndef LIMNI_MOMENT_H
#define LIMNI_MOMENT_H

#include "frame.h"

/// A mesh in that moment: `mesh.controls` are where its points are then, and so are its bounds.
typedef struct limni_moment_mesh {
    limn_mesh mesh;
    float *controls; ///< what to free; NULL: nothing moves it
} limni_moment_mesh;

typedef struct limni_moment {
    limni_moment_mesh *meshes; ///< [mesh_count]
    uint32_t mesh_count;
} limni_moment;

/// Moves meshes [first, first + count) of a pack as --clip and --time say; without a clip joints and
/// morph targets are at rest. On failure the options hold the error. To be freed in either case.
bool limni_moment_make(limni_moment *moment, const limn_pack *pack, uint32_t first, uint32_t count,
                       limni_frame_options *options);
void limni_moment_free(limni_moment *moment);

/// A box around all control points that faces use.
limni_bounds limni_moment_bounds(const limni_moment *moment);

#endif
