/* SPDX-License-Identifier: MIT */
#include "moment.h"

#include "limn/character.h"
#include "limn/format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// What moves the meshes of a pack.
typedef struct motion {
    const limn_pack *pack;
    const limn_clip *clip; ///< NULL: at rest
    float time;
    float *matrices; ///< [joint_count][3][4]
} motion;

/// Whether a clip is to be shown, named or not.
static bool has_clip(const limn_pack *pack, const limni_frame_options *options) {
    return options->clip || (options->live && limn_pack_clip_count(pack) > 0);
}

static bool find_clip(const limn_pack *pack, limni_frame_options *options, limn_clip *clip) {
    char names[128] = "";
    const uint32_t count = limn_pack_clip_count(pack);
    for (uint32_t c = 0; c < count; c++) {
        *clip = limn_pack_clip(pack, c);
        if (!options->clip || strcmp(clip->name, options->clip) == 0) return true;
        const size_t length = strlen(names);
        snprintf(names + length, sizeof names - length, "%s%s", c ? ", " : "", clip->name);
    }
    return count ? limni_frame_refuse(options, "--clip '%s': the file has %s", options->clip, names)
                 : limni_frame_refuse(options, "--clip '%s': the file has no clips", options->clip);
}

/// Adds what morph targets do to the control points.
static bool morph(const motion *by, uint32_t mesh_index, const limn_mesh *mesh, float *controls) {
    const limn_morph_targets targets = limn_mesh_morph_targets(by->pack, mesh_index);
    if (targets.target_count == 0) return true;
    float *const weights = malloc(targets.target_count * sizeof *weights);
    if (!weights) return false;
    limn_clip_morph_weights(by->pack, mesh_index, by->clip, by->time, LIMN_WRAP_CLAMP, weights);
    limn_morph_points(&targets, weights, mesh->controls, 0, targets.point_count, controls);
    free(weights);
    return true;
}

static void find_bounds(limn_mesh *mesh) {
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        const limn_file_run *const run = &mesh->runs[r];
        const uint32_t *const indices = mesh->indices + run->first_index;
        const size_t count =
            (size_t)run->patch_count * mesh->classes[run->class_index].control_count;
        for (size_t i = 0; i < count; i++) {
            for (int axis = 0; axis < 3; axis++) {
                const float x = mesh->controls[3 * (size_t)indices[i] + (size_t)axis];
                const bool first = r == 0 && i == 0;
                mesh->bounds_min[axis] = first ? x : fminf(mesh->bounds_min[axis], x);
                mesh->bounds_max[axis] = first ? x : fmaxf(mesh->bounds_max[axis], x);
            }
        }
    }
}

static bool move(const motion *by, uint32_t mesh_index, limni_moment_mesh *moved) {
    limn_mesh *const mesh = &moved->mesh;
    const limn_skin skin = limn_mesh_skin(by->pack, mesh_index);
    if (skin.point_count == 0 && limn_mesh_morph_targets(by->pack, mesh_index).target_count == 0)
        return true;
    const size_t size = ((size_t)mesh->point_count + 1) * sizeof(float[3]);
    moved->controls = malloc(size);
    if (!moved->controls) return false;
    memcpy(moved->controls, mesh->controls, size - sizeof(float[3]));
    if (!morph(by, mesh_index, mesh, moved->controls)) return false;
    const limn_pose pose = {.skin = &skin, .matrices = by->matrices};
    if (skin.point_count > 0)
        limn_pose_points(&pose, moved->controls, 0, skin.point_count, moved->controls);
    limn_mesh_refine(mesh, moved->controls);
    mesh->controls = moved->controls;
    find_bounds(mesh);
    return true;
}

static bool move_all(limni_moment *moment, motion *by, uint32_t first) {
    const limn_skeleton skeleton = limn_pack_skeleton(by->pack);
    by->matrices = malloc(((size_t)skeleton.joint_count + 1) * sizeof(float[12]));
    if (!by->matrices) return false;
    limn_clip_pose(&skeleton, by->clip, by->time, LIMN_WRAP_CLAMP, by->matrices);
    bool moved = true;
    for (uint32_t m = 0; m < moment->mesh_count && moved; m++)
        moved = move(by, first + m, &moment->meshes[m]);
    free(by->matrices);
    return moved;
}

bool limni_moment_make(limni_moment *moment, const limn_pack *pack, uint32_t first, uint32_t count,
                       limni_frame_options *options) {
    *moment = (limni_moment){.meshes = calloc((size_t)count + 1, sizeof *moment->meshes)};
    if (!moment->meshes) return limni_frame_refuse(options, "out of memory for %u meshes", count);
    moment->mesh_count = count;
    for (uint32_t m = 0; m < count; m++)
        moment->meshes[m].mesh = limn_pack_mesh(pack, first + m);
    limn_clip clip = {0};
    const bool moving = has_clip(pack, options);
    motion by = {.pack = pack, .clip = moving ? &clip : NULL, .time = options->time};
    return (!moving || find_clip(pack, options, &clip)) &&
           (move_all(moment, &by, first) ||
            limni_frame_refuse(options, "out of memory for control points"));
}

void limni_moment_free(limni_moment *moment) {
    for (uint32_t m = 0; m < moment->mesh_count; m++)
        free(moment->meshes[m].controls);
    free(moment->meshes);
    *moment = (limni_moment){0};
}

limni_bounds limni_moment_bounds(const limni_moment *moment) {
    limni_bounds bounds = {0};
    for (uint32_t m = 0; m < moment->mesh_count; m++) {
        const limn_mesh *const mesh = &moment->meshes[m].mesh;
        for (int axis = 0; axis < 3; axis++) {
            const float low = mesh->bounds_min[axis], high = mesh->bounds_max[axis];
            bounds.min[axis] = m == 0 ? low : fminf(bounds.min[axis], low);
            bounds.max[axis] = m == 0 ? high : fmaxf(bounds.max[axis], high);
        }
    }
    return bounds;
}
