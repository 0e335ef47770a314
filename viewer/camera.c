/* SPDX-License-Identifier: MIT */
#include "camera.h"

#include <math.h>
#include <string.h>

static const double half_angle_tangent = 0.24932800284318; // tan 14°: a portrait lens
static const double margin = 0.07;                         // of half the picture, on every side

/// The camera's axes in the world: to the right, up, and towards the viewer, who stands 35° to the
/// right of the +Z axis and looks down by 18°.
static const double axes[3][3] = {
    {0.819152044288992, 0, -0.573576436351046},
    {-0.177244866405494, 0.951056516295154, -0.253131902662278},
    {0.545503607385015, 0.309016994374947, 0.779059889557542},
};

static double dot(const double axis[3], const float point[3]) {
    return axis[0] * (double)point[0] + axis[1] * (double)point[1] + axis[2] * (double)point[2];
}

/// Tangent of half the angle of view, across (0) and up (1): the narrower one is fixed.
static double view_tangent(double aspect, int direction) {
    if (direction == 0) return aspect > 1 ? half_angle_tangent * aspect : half_angle_tangent;
    return aspect > 1 ? half_angle_tangent : half_angle_tangent / aspect;
}

view_framing view_framing_start(double aspect) {
    view_framing framing = {.nearest = -INFINITY, .farthest = INFINITY};
    for (int direction = 0; direction < 2; direction++) {
        framing.tangents[direction] = view_tangent(aspect, direction) * (1 - margin);
        framing.highest[direction] = framing.lowest[direction] = -INFINITY;
    }
    return framing;
}

// A point at (x, z) is right of the left side and left of the right side of what an eye at
// (ex, ez) sees if |x - ex| <= (ez - z) * tangent. Both hold for all points if
// ez * tangent - ex >= max(-x + z * tangent) and ez * tangent + ex >= max(x + z * tangent):
// two numbers per direction are all there is to know about the points, and the fit is exact.
void view_framing_include(view_framing *framing, const float point[3]) {
    const double depth = dot(axes[2], point);
    for (int direction = 0; direction < 2; direction++) {
        const double offset = dot(axes[direction], point);
        const double reach = depth * framing->tangents[direction];
        framing->highest[direction] = fmax(framing->highest[direction], reach + offset);
        framing->lowest[direction] = fmax(framing->lowest[direction], reach - offset);
    }
    framing->nearest = fmax(framing->nearest, depth);
    framing->farthest = fmin(framing->farthest, depth);
}

/// rotation: the camera's axes; eye: along these
static void set_view(view_camera *camera, const double rotation[3][3], const double eye[3]) {
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            camera->view[4 * column + row] = (float)rotation[row][column];
        camera->view[12 + row] = (float)-eye[row];
        camera->view[4 * row + 3] = 0;
    }
    camera->view[15] = 1;
}

/// tangents: of half the angle of view, across and up
static void set_projection(view_camera *camera, const double tangents[2], double near, double far) {
    for (int i = 0; i < 16; i++)
        camera->projection[i] = 0;
    camera->projection[0] = (float)(1 / tangents[0]);
    camera->projection[5] = (float)(1 / tangents[1]);
    camera->projection[10] = (float)((far + near) / (near - far));
    camera->projection[11] = -1;
    camera->projection[14] = (float)(2 * far * near / (near - far));
}

/// eye: along the axes; the target is `depth` in front of it
static void place_camera(limni_camera *camera, const double eye[3], double depth) {
    for (int axis = 0; axis < 3; axis++) {
        double sum = 0;
        for (int row = 0; row < 3; row++)
            sum += axes[row][axis] * eye[row];
        camera->eye[axis] = (float)sum;
        camera->target[axis] = (float)(sum - axes[2][axis] * depth);
    }
}

bool view_framing_camera(const view_framing *framing, double aspect, limni_camera *camera) {
    static const double largest = 1e15, smallest = 1e-15;
    double eye[3] = {0, 0, -INFINITY}; // in the camera's axes
    for (int direction = 0; direction < 2; direction++) {
        const double high = framing->highest[direction], low = framing->lowest[direction];
        eye[direction] = (high - low) / 2;
        eye[2] = fmax(eye[2], (high + low) / 2 / framing->tangents[direction]);
    }
    // A single point has no size of its own.
    const double distance = fmax(eye[2] - framing->farthest, smallest);
    const double depth = framing->nearest - framing->farthest;
    if (!(fabs(eye[0]) + fabs(eye[1]) + fabs(eye[2]) + distance < largest)) return false;

    eye[2] = framing->farthest + distance;
    *camera = (limni_camera){
        .up = {0, 1, 0},
        .fov = (float)(2 * atan(view_tangent(aspect, 1))),
        .near_plane = (float)fmax((distance - depth) * 0.9, distance * 1e-3),
        .far_plane = (float)(distance * 1.02),
    };
    memcpy(camera->axes, axes, sizeof axes);
    place_camera(camera, eye, distance - depth / 2);
    return true;
}

view_camera view_camera_matrices(const limni_camera *source, double aspect) {
    double eye[3];
    for (int row = 0; row < 3; row++)
        eye[row] = dot(source->axes[row], source->eye);

    view_camera camera;
    const double tangent = tan((double)source->fov / 2);
    set_view(&camera, source->axes, eye);
    set_projection(&camera, (const double[2]){tangent * aspect, tangent},
                   (double)source->near_plane, (double)source->far_plane);
    return camera;
}
