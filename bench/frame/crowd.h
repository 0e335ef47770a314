/* SPDX-License-Identifier: MIT */
/* Where the characters of a scene stand, and which of them the camera sees. */
#ifndef FRAME_CROWD_H
#define FRAME_CROWD_H

#include "actor.h"

#define FRAME_RATE 60 ///< of animations, per second

/// One character in one frame.
typedef struct frame_instance {
    float place[3]; ///< diagonals
    float yaw;
    float start; ///< seconds into the clip at frame 0
    bool visible;
    limn_view view; ///< in its own space
} frame_instance;

typedef struct frame_crowd {
    const frame_script *script;
    const frame_actor *actor;
    uint32_t count;
    frame_instance *instances;
    uint32_t *visible; ///< [visible_count] those that may be seen, in order
    uint32_t visible_count;
    float eye[3], target[3]; ///< of the camera, diagonals
    float seconds;           ///< of the animation
} frame_crowd;

/// The first `count` of a sequence that fills the area evenly, so that a larger crowd is a denser
/// one, and has the smaller one in it.
frame_crowd frame_crowd_create(const frame_script *script, const frame_actor *actor,
                               uint32_t count);
void frame_crowd_destroy(frame_crowd *crowd);

/// Puts the camera where it is in frame `frame` of `frame_count`, and finds who is in view: by a
/// sphere around each, a half wider than its bounds in the bind pose.
void frame_crowd_see(frame_crowd *crowd, uint32_t frame, uint32_t frame_count);

/// When an instance is in the clip.
float frame_crowd_time(const frame_crowd *crowd, uint32_t instance);

/// Where an instance stands, in diagonals: a column-major matrix from its space into the scene's.
///
/// matrix  out: [16]
void frame_crowd_place(const frame_crowd *crowd, uint32_t instance, float *matrix);

/// The light of the scene in the space of an instance.
///
/// lights  out: [script->light_count], which the result points to
limn_lighting frame_crowd_lighting(const frame_crowd *crowd, uint32_t instance, limn_light *lights);

/// Pixels of a model unit at the middle of an instance.
float frame_crowd_scale(const frame_crowd *crowd, uint32_t instance);

#endif
