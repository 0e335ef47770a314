/* SPDX-License-Identifier: MIT */
#include "actor.h"

#include "../peers/allocate.h"
#include "../rig.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MADE_UP_JOINTS = 60, MADE_UP_INFLUENCES = 4 };

static bool find_clip(frame_actor *actor, const char *name) {
    const limn_pack *const pack = &actor->mix.pack;
    const uint32_t count = limn_pack_clip_count(pack);
    for (uint32_t c = 0; c < count; c++) {
        actor->clip = limn_pack_clip(pack, c);
        if (!*name || strcmp(actor->clip.name, name) == 0) return true;
    }
    if (!*name) return true;
    fprintf(stderr, "limn-bench: %s has no clip '%s'\n", actor->mix.name, name);
    return false;
}

static bool find_motion(frame_actor *actor, const frame_script *script) {
    const limn_mesh *const mesh = &actor->mix.mesh;
    actor->skeleton = limn_pack_skeleton(&actor->mix.pack);
    actor->skin = limn_mesh_skin(&actor->mix.pack, 0);
    actor->targets = limn_mesh_morph_targets(&actor->mix.pack, 0);
    actor->moves = !script->still;
    if (!actor->moves) return true;
    if (!find_clip(actor, script->clip)) return false;
    actor->made_up = actor->clip.track_count == 0;
    if (actor->made_up)
        return bench_rig_attach(&actor->skin, mesh, MADE_UP_JOINTS, MADE_UP_INFLUENCES);
    actor->skin.kernels = mesh->kernels;
    return true;
}

static bool open_mesh(frame_actor *actor, const frame_script *script) {
    const bench_way way = {.scheme = script->scheme, .isolate = script->isolate};
    if (!script->mesh[0]) return bench_mix_terrain(&actor->mix, script->terrain_side, way);
    if (!bench_mix_file(&actor->mix, script->mesh, way)) return false;
    if (actor->mix.mesh.normals) return true;
    fprintf(stderr, "limn-bench: %s: bake it with --normals exact\n", actor->mix.name);
    return false;
}

bool frame_actor_create(frame_actor *actor, const frame_script *script,
                        const limn_kernels *kernels) {
    *actor = (frame_actor){0};
    if (!open_mesh(actor, script)) return false;
    limn_mesh *const mesh = &actor->mix.mesh;
    mesh->kernels = kernels;
    for (int axis = 0; axis < 3; axis++) {
        const float low = mesh->bounds_min[axis], high = mesh->bounds_max[axis];
        actor->middle[axis] = (low + high) / 2;
        actor->diagonal = hypotf(actor->diagonal, high - low);
    }
    return find_motion(actor, script);
}

void frame_actor_destroy(frame_actor *actor) {
    if (actor->made_up) bench_rig_free(&actor->skin);
    bench_mix_destroy(&actor->mix);
}

frame_pose_memory frame_pose_memory_create(const frame_actor *actor) {
    const uint32_t joints = actor->made_up ? actor->skin.joint_count : actor->skeleton.joint_count;
    return (frame_pose_memory){.matrices = bench_allocate(joints + 1, sizeof(float[12])),
                               .weights =
                                   bench_allocate(actor->targets.target_count + 1, sizeof(float))};
}

void frame_pose_memory_destroy(frame_pose_memory *memory) {
    free(memory->matrices);
    free(memory->weights);
}

void frame_actor_move(const frame_actor *actor, float seconds, frame_pose_memory *memory) {
    if (!actor->moves) return;
    if (actor->made_up)
        bench_rig_wobble(&actor->mix.mesh, actor->skin.joint_count, seconds, memory->matrices);
    else
        limn_clip_pose(&actor->skeleton, &actor->clip, seconds, LIMN_WRAP_REPEAT, memory->matrices);
}

void frame_actor_pose(const frame_actor *actor, float seconds, frame_pose_memory *memory,
                      float *controls) {
    if (!actor->moves) return;
    const float *points = actor->mix.mesh.controls;
    if (!actor->made_up && actor->targets.target_count > 0) {
        limn_clip_morph_weights(&actor->mix.pack, 0, &actor->clip, seconds, LIMN_WRAP_REPEAT,
                                memory->weights);
        limn_morph_points(&actor->targets, memory->weights, points, 0, actor->targets.point_count,
                          controls);
        points = controls;
    }
    if (actor->skin.point_count == 0) return;
    const limn_pose pose = {.skin = &actor->skin, .matrices = memory->matrices};
    limn_pose_points(&pose, points, 0, actor->skin.point_count, controls);
}
