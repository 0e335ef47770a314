/* SPDX-License-Identifier: MIT */
/* What a scene shows: a mesh, and what moves its control points. */
#ifndef FRAME_ACTOR_H
#define FRAME_ACTOR_H

#include "../mixes.h"
#include "script.h"

#include "limn/character.h"

typedef struct frame_actor {
    bench_mix mix;
    float middle[3]; ///< of the bounds
    float diagonal;  ///< of the bounds
    bool moves;
    limn_skin skin;
    bool made_up; ///< whether the skin is from bench_rig_attach(), which has no clips
    limn_skeleton skeleton;
    limn_clip clip; ///< the file's, unless the skin is made up
    limn_morph_targets targets;
} frame_actor;

/// What a thread needs to pose an actor.
typedef struct frame_pose_memory {
    float *matrices; ///< [joint_count][3][4]
    float *weights;  ///< [target_count] of morph targets
} frame_pose_memory;

/// Bakes or opens the mesh, with normals. False after a message; destroy it all the same.
bool frame_actor_create(frame_actor *actor, const frame_script *script,
                        const limn_kernels *kernels);
void frame_actor_destroy(frame_actor *actor);

frame_pose_memory frame_pose_memory_create(const frame_actor *actor);
void frame_pose_memory_destroy(frame_pose_memory *memory);

/// The matrices of a moment, which all ways to draw it need.
void frame_actor_move(const frame_actor *actor, float seconds, frame_pose_memory *memory);

/// Morphs and skins the control points with those matrices. Control points that do not move stay as
/// they are.
///
/// controls  [control_count][3]
void frame_actor_pose(const frame_actor *actor, float seconds, frame_pose_memory *memory,
                      float *controls);

#endif
