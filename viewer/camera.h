/* SPDX-License-Identifier: MIT */
/*
 * Perspective cameras: one that looks at things from a three-quarter angle, +Y up, and stands just
 * far enough away to see all of them; and that of a frame.
 */
#ifndef VIEW_CAMERA_H
#define VIEW_CAMERA_H

#include "frame.h"
#include <stdbool.h>

/// What a picture must show. Start with view_framing_start(), include every point, then ask for
/// the camera. The members belong to camera.c.
typedef struct view_framing {
    double tangents[2];       ///< of half the angle of view, less a margin: across and up
    double highest[2];        ///< of +p + depth * tangent, per direction
    double lowest[2];         ///< of -p + depth * tangent, per direction
    double nearest, farthest; ///< along the axis towards the viewer
} view_framing;

/// Matrices are column-major, as OpenGL wants them.
typedef struct view_camera {
    float view[16];
    float projection[16];
} view_camera;

/// aspect  width / height of the picture
view_framing view_framing_start(double aspect);

void view_framing_include(view_framing *framing, const float point[3]);

/// False if no point was included, or if the points are too far apart for the arithmetic.
bool view_framing_camera(const view_framing *framing, double aspect, limni_camera *camera);

/// The matrices of a camera, whose vertical angle of view it keeps whatever the aspect.
view_camera view_camera_matrices(const limni_camera *source, double aspect);

#endif
