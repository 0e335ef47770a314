/* SPDX-License-Identifier: MIT */
#include "motion.h"

#include <math.h>
#include <string.h>

/// Turns a vector around a unit axis.
static void rotate(const double axis[3], double angle, double vector[3]) {
    const double c = cos(angle), s = sin(angle);
    const double along = axis[0] * vector[0] + axis[1] * vector[1] + axis[2] * vector[2];
    double turned[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        turned[i] = c * vector[i] + s * (axis[j] * vector[k] - axis[k] * vector[j]) +
                    (1 - c) * along * axis[i];
    }
    memcpy(vector, turned, sizeof turned);
}

/// Turns what leads from one point to the other, around the camera's up and then its right.
static void turn(const limni_camera *camera, const float from[3], float to[3], double right,
                 double up) {
    const double length =
        hypot(hypot((double)camera->up[0], (double)camera->up[1]), (double)camera->up[2]);
    double vector[3], vertical[3];
    for (int axis = 0; axis < 3; axis++) {
        vector[axis] = (double)to[axis] - (double)from[axis];
        vertical[axis] = (double)camera->up[axis] / length;
    }
    rotate(camera->axes[0], up, vector);
    rotate(vertical, right, vector);
    for (int axis = 0; axis < 3; axis++)
        to[axis] = (float)((double)from[axis] + vector[axis]);
}

static void keep_if_possible(limni_camera *camera, limni_camera *moved) {
    if (limni_camera_orient(moved)) *camera = *moved;
}

void view_motion_orbit(limni_camera *camera, float right, float up) {
    limni_camera moved = *camera;
    turn(camera, camera->target, moved.eye, (double)right, (double)-up);
    keep_if_possible(camera, &moved);
}

void view_motion_look(limni_camera *camera, float right, float up) {
    limni_camera moved = *camera;
    turn(camera, camera->eye, moved.target, (double)-right, (double)up);
    keep_if_possible(camera, &moved);
}

void view_motion_fly(limni_camera *camera, const float along[3]) {
    limni_camera moved = *camera;
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int axis = 0; axis < 3; axis++)
            sum += (double)along[axis] * camera->axes[axis][i];
        moved.eye[i] += (float)sum;
        moved.target[i] += (float)sum;
    }
    keep_if_possible(camera, &moved);
}

void view_motion_zoom(limni_camera *camera, float factor) {
    limni_camera moved = *camera;
    for (int axis = 0; axis < 3; axis++)
        moved.eye[axis] =
            camera->target[axis] + factor * (camera->eye[axis] - camera->target[axis]);
    keep_if_possible(camera, &moved);
}

float view_motion_distance(const limni_camera *camera) {
    return hypotf(hypotf(camera->eye[0] - camera->target[0], camera->eye[1] - camera->target[1]),
                  camera->eye[2] - camera->target[2]);
}
