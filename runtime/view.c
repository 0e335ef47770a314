/* SPDX-License-Identifier: MIT */
#include "limn/limn.h"
#include "require.h"
#include "rounding.h"

#include <math.h>

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const float a[3], const float b[3], float product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static void normalise(float v[3]) {
    const float length = sqrtf(dot(v, v));
    for (int axis = 0; axis < 3; axis++)
        v[axis] /= length;
}

/// Right, up and forward, of unit length.
typedef struct camera_axes {
    float right[3], up[3], forward[3];
} camera_axes;

static camera_axes find_axes(const float eye[3], const float target[3], const float up[3]) {
    camera_axes axes;
    for (int axis = 0; axis < 3; axis++)
        axes.forward[axis] = target[axis] - eye[axis];
    normalise(axes.forward);
    cross(axes.forward, up, axes.right);
    normalise(axes.right);
    cross(axes.right, axes.forward, axes.up);
    return axes;
}

/// Adds the plane through `point` whose inside is where forward * f + side * s points to.
static void add_plane(limn_view *view, const float point[3], const float *forward, float f,
                      const float *side, float s) {
    float *const plane = view->planes[view->plane_count++];
    for (int axis = 0; axis < 3; axis++)
        plane[axis] = forward[axis] * f + side[axis] * s;
    plane[3] = -dot(plane, point);
}

static void add_depth_planes(limn_view *view, const float eye[3], const camera_axes *axes,
                             float near_plane, float far_plane) {
    float point[3];
    for (int axis = 0; axis < 3; axis++)
        point[axis] = eye[axis] + axes->forward[axis] * near_plane;
    add_plane(view, point, axes->forward, 1, axes->forward, 0);
    for (int axis = 0; axis < 3; axis++)
        point[axis] = eye[axis] + axes->forward[axis] * far_plane;
    add_plane(view, point, axes->forward, -1, axes->forward, 0);
}

limn_view limn_view_perspective(const float eye[3], const float target[3], const float up[3],
                                float fov, float width, float height, float near_plane,
                                float far_plane) {
    LIMNI_REQUIRE(eye && target && up && fov > 0 && width > 0 && height > 0, (limn_view){0});
    LIMNI_REQUIRE(near_plane > 0 && far_plane > near_plane, (limn_view){0});
    const camera_axes axes = find_axes(eye, target, up);
    const float y = tanf(fov / 2), x = y * width / height;
    limn_view view = {
        .eye = {eye[0], eye[1], eye[2]}, .pixels = height / (2 * y), .nearest = near_plane};
    add_depth_planes(&view, eye, &axes, near_plane, far_plane);
    add_plane(&view, eye, axes.forward, x, axes.right, 1);
    add_plane(&view, eye, axes.forward, x, axes.right, -1);
    add_plane(&view, eye, axes.forward, y, axes.up, 1);
    add_plane(&view, eye, axes.forward, y, axes.up, -1);
    return view;
}

limn_view limn_view_orthographic(const float eye[3], const float target[3], const float up[3],
                                 float extent, float width, float height, float near_plane,
                                 float far_plane) {
    LIMNI_REQUIRE(eye && target && up && extent > 0 && width > 0 && height > 0, (limn_view){0});
    LIMNI_REQUIRE(far_plane > near_plane, (limn_view){0});
    const camera_axes axes = find_axes(eye, target, up);
    const float y = extent / 2, x = y * width / height;
    limn_view view = {
        .eye = {eye[0], eye[1], eye[2]}, .pixels = height / extent, .orthographic = true};
    add_depth_planes(&view, eye, &axes, near_plane, far_plane);
    for (int side = -1; side <= 1; side += 2) {
        float beside[3], above[3];
        for (int axis = 0; axis < 3; axis++) {
            beside[axis] = eye[axis] - axes.right[axis] * x * (float)side;
            above[axis] = eye[axis] - axes.up[axis] * y * (float)side;
        }
        add_plane(&view, beside, axes.forward, 0, axes.right, (float)side);
        add_plane(&view, above, axes.forward, 0, axes.up, (float)side);
    }
    return view;
}
