/* SPDX-License-Identifier: MIT */
/* How the mouse and the keys move a camera. A motion that a camera cannot make is not made. */
#ifndef VIEW_MOTION_H
#define VIEW_MOTION_H

#include "frame.h"

/// Turns around the target, by angles in radians to the right and up.
void view_motion_orbit(limni_camera *camera, float right, float up);

/// Turns around the eye.
void view_motion_look(limni_camera *camera, float right, float up);

/// Moves the eye and the target, by model units along the axes of the camera: to the right, up and
/// backward.
void view_motion_fly(limni_camera *camera, const float along[3]);

/// Multiplies the distance between the eye and the target, which stays.
void view_motion_zoom(limni_camera *camera, float factor);

float view_motion_distance(const limni_camera *camera);

#endif
