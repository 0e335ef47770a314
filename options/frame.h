/* SPDX-License-Identifier: MIT */
/* A frame as options describe it: a camera, and what limn_plan_build() wants to know. */
#ifndef LIMNI_FRAME_H
#define LIMNI_FRAME_H

#include "frame_options.h"

/// A box around what may be seen.
typedef struct limni_bounds {
    float min[3], max[3];
} limni_bounds;

/// A perspective camera, complete.
typedef struct limni_camera {
    float eye[3], target[3], up[3];
    double axes[3][3]; ///< to the right, up and towards the viewer, of unit length
    float fov;         ///< vertical, radians
    float near_plane, far_plane;
} limni_camera;

typedef struct limni_frame {
    bool has_camera;
    limni_camera camera;
    limn_view view; ///< without a camera: one that has no say
    limn_lod_desc desc;
} limni_frame;

/// Finds the axes of a camera from its eye, target and up. False if these do not say them.
bool limni_camera_orient(limni_camera *camera);

/// Fills in what was not given. `options` were checked; on failure they hold the error.
bool limni_frame_resolve(limni_frame_options *options, const limni_bounds *bounds,
                         limni_frame *frame);

/// The most vertices that a mesh may have in any such frame: limn_plan_build() takes INT32_MAX.
uint64_t limni_frame_vertex_bound(const limni_frame *frame, const limn_mesh *mesh);

#endif
