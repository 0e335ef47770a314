/* SPDX-License-Identifier: MIT */
#include "frame.h"

#include <math.h>
#include <string.h>

/// Gives a vector unit length. Returns the length it had.
static double normalise(double vector[3]) {
    const double length = hypot(hypot(vector[0], vector[1]), vector[2]);
    for (int axis = 0; axis < 3; axis++)
        vector[axis] /= length;
    return length;
}

static void cross(const double a[3], const double b[3], double product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static void place_target(const limni_frame_options *options, const limni_bounds *bounds,
                         limni_camera *camera) {
    memcpy(camera->target, options->target, sizeof camera->target);
    if (limni_frame_given(options, LIMNI_FRAME_TARGET)) return;
    for (int axis = 0; axis < 3; axis++)
        camera->target[axis] = bounds->min[axis] / 2 + bounds->max[axis] / 2;
}

/// Finds the axis towards the viewer. False if the eye is the target.
static bool face_target(limni_camera *camera) {
    for (int axis = 0; axis < 3; axis++)
        camera->axes[2][axis] = (double)camera->eye[axis] - (double)camera->target[axis];
    return normalise(camera->axes[2]) > 0;
}

bool limni_camera_orient(limni_camera *camera) {
    static const double least_sine = 1e-3; // below, floats do not tell what is to the right
    const float *const up = camera->up;
    double direction[3] = {(double)up[0], (double)up[1], (double)up[2]};
    if (!face_target(camera) || !(normalise(direction) > 0)) return false;
    cross(direction, camera->axes[2], camera->axes[0]);
    if (!(normalise(camera->axes[0]) > least_sine)) return false;
    cross(camera->axes[2], camera->axes[0], camera->axes[1]);
    return true;
}

static bool refuse_point(limni_frame_options *options, const char *name, const float point[3],
                         const char *why) {
    return limni_frame_refuse(options, "--%s %g,%g,%g: %s", name, (double)point[0],
                              (double)point[1], (double)point[2], why);
}

/// Whether the camera can have this direction up.
static bool set_up(limni_camera *camera, const float up[3]) {
    memcpy(camera->up, up, sizeof camera->up);
    return limni_camera_orient(camera);
}

static bool orient(limni_frame_options *options, limni_camera *camera) {
    static const float usual[3] = {0, 1, 0}, other[3] = {0, 0, -1};
    if (!face_target(camera)) return refuse_point(options, "eye", camera->eye, "is the target too");
    if (!limni_frame_given(options, LIMNI_FRAME_UP))
        return set_up(camera, usual) || set_up(camera, other);
    return set_up(camera, options->up) ||
           refuse_point(options, "up", options->up, "is not across the line of sight");
}

/// The distance of the corner of the bounds that is farthest away, and a little more.
static float distance_to_all(const limni_bounds *bounds, const float eye[3]) {
    double farthest[3];
    for (int axis = 0; axis < 3; axis++)
        farthest[axis] = fmax(fabs((double)eye[axis] - (double)bounds->min[axis]),
                              fabs((double)eye[axis] - (double)bounds->max[axis]));
    return (float)(normalise(farthest) * 1.01);
}

static bool place_planes(limni_frame_options *options, const limni_bounds *bounds,
                         limni_camera *camera) {
    const bool has_near = limni_frame_given(options, LIMNI_FRAME_NEAR);
    camera->far_plane = limni_frame_given(options, LIMNI_FRAME_FAR)
                            ? options->far_plane
                            : distance_to_all(bounds, camera->eye);
    camera->near_plane = has_near ? options->near_plane : camera->far_plane / 1000;
    return camera->near_plane < camera->far_plane || !has_near ||
           limni_frame_refuse(options, "--near %g: is not nearer than the far plane, %g",
                              (double)camera->near_plane, (double)camera->far_plane);
}

static bool is_usable(const limn_view *view) {
    float sum = view->pixels;
    for (uint32_t p = 0; p < view->plane_count; p++)
        for (int k = 0; k < 4; k++)
            sum += fabsf(view->planes[p][k]);
    return view->plane_count > 0 && isfinite(sum);
}

static bool make_view(limni_frame_options *options, const limni_camera *camera, limn_view *view) {
    const float width = (float)options->width, height = (float)options->height;
    const bool bounded = camera->near_plane > 0 && camera->far_plane > camera->near_plane &&
                         isfinite(camera->far_plane);
    if (bounded)
        *view = limn_view_perspective(camera->eye, camera->target, camera->up, camera->fov, width,
                                      height, camera->near_plane, camera->far_plane);
    if (!bounded || !is_usable(view))
        return refuse_point(options, "eye", camera->eye,
                            "floats cannot tell what is seen from there");
    if (!limni_frame_given(options, LIMNI_FRAME_CULL)) view->plane_count = 0;
    return true;
}

static limn_lod_desc complete_desc(const limni_frame_options *options) {
    limn_lod_desc desc = options->desc;
    desc.min_level = options->min_level;
    desc.max_level = options->max_level;
    if (options->max_level == 0) { // where 0 would be the default
        desc.lod = LIMN_LOD_UNIFORM;
        desc.level = desc.bias = 0;
    }
    return desc;
}

static bool place_camera(limni_frame_options *options, const limni_bounds *bounds,
                         limni_camera *camera) {
    static const double degree = 0.017453292519943295;
    camera->fov = (float)(degree * (double)options->fov);
    memcpy(camera->eye, options->eye, sizeof camera->eye);
    place_target(options, bounds, camera);
    return orient(options, camera) && place_planes(options, bounds, camera);
}

bool limni_frame_resolve(limni_frame_options *options, const limni_bounds *bounds,
                         limni_frame *frame) {
    *frame = (limni_frame){.desc = complete_desc(options),
                           .has_camera = limni_frame_given(options, LIMNI_FRAME_EYE)};
    if (!frame->has_camera) return true;
    return place_camera(options, bounds, &frame->camera) &&
           make_view(options, &frame->camera, &frame->view);
}

uint64_t limni_frame_vertex_bound(const limni_frame *frame, const limn_mesh *mesh) {
    const limn_lod_desc *const desc = &frame->desc;
    float highest = desc->max_level > 0 ? desc->max_level : LIMN_LEVEL_MAX;
    if (desc->lod == LIMN_LOD_UNIFORM)
        highest = fminf(highest, fmaxf(desc->level + desc->bias, desc->min_level));
    return (uint64_t)mesh->patch_count * mesh->domain->row_counts[(uint32_t)ceilf(highest)];
}
