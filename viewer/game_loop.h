/* SPDX-License-Identifier: MIT */
/*
 * What a game does with Limn in every frame. Written to be read and copied: of Limn it uses the
 * public headers only.
 */
#ifndef VIEW_GAME_LOOP_H
#define VIEW_GAME_LOOP_H

#include "limn/character.h"
#include "renderer.h"
#include "scene.h"
#include "workers.h"

/// A mesh, and what of it changes from frame to frame: all memory that a frame needs.
typedef struct view_actor {
    limn_mesh mesh; ///< in the bind pose
    uint32_t mesh_index;
    limn_skin skin;
    limn_morph_targets targets;
    float *weights;        ///< [targets.target_count]
    float *controls;       ///< [mesh.point_count][3]
    float *normals;        ///< [mesh.normal_count][3]
    void *plan_memory;     ///< [limn_plan_size()]
    view_surface *surface; ///< what the renderer draws: takes the plan
} view_actor;

/// The steps of a frame, in their order.
typedef enum view_stage {
    VIEW_STAGE_POSE,    ///< clip, morph targets, skin, further points
    VIEW_STAGE_NORMALS, ///< of control points
    VIEW_STAGE_PLAN,
    VIEW_STAGE_MAP, ///< wait for the GPU, where it is behind
    VIEW_STAGE_EVALUATE,
    VIEW_STAGE_DRAW, ///< give commands to the GPU
    VIEW_STAGE_COUNT
} view_stage;

typedef struct view_game {
    const limn_pack *pack;
    const view_scene *scene; ///< for its templates
    limn_skeleton skeleton;
    float *matrices; ///< [skeleton.joint_count][3][4]
    view_actor *actors;
    uint32_t actor_count;
    view_workers *workers;
    double seconds[VIEW_STAGE_COUNT]; ///< of the last frame
    uint64_t vertex_count;            ///< of the last frame
} view_game;

/// What is to be seen in a frame.
typedef struct view_moment {
    const limn_clip *clip; ///< NULL: all at rest
    float time;            ///< of the clip, seconds
    limn_view view;
    limn_lod_desc lod;
    const limn_lighting *lighting; ///< NULL: the shader lights
    view_frame frame;              ///< how it is drawn
} view_moment;

/// Allocates all that frames of the scene need. The scene and the workers must outlive the game.
/// Reports why and returns false on failure; close the game in either case.
bool view_game_open(view_game *game, view_scene *scene, view_workers *workers);
void view_game_close(view_game *game);

/// One frame. Reports why and returns false on failure.
bool view_game_frame(view_game *game, view_renderer *renderer, const view_moment *moment);

#endif
