/* SPDX-License-Identifier: MIT */
/* Levels of detail that are meshes of their own: one is chosen for a whole character. */
#ifndef FRAME_DISCRETE_H
#define FRAME_DISCRETE_H

#include "way.h"

#include "../peers/scene.h"

/// The surface of an actor at levels 0 to 4, in the bind pose.
typedef struct frame_discrete {
    uint32_t low, high; ///< the levels that there are
    peer_scene scenes[LIMN_LEVEL_COUNT];
    /// What chooses: how far off the limit surface a level is, of which 99 % of patches keep to
    /// that; and the root of the mean square of its edges. Model units.
    float deviations[LIMN_LEVEL_COUNT], lengths[LIMN_LEVEL_COUNT];
    float (*positions[LIMN_LEVEL_COUNT])[3]; ///< [unique_count]
    float (*normals[LIMN_LEVEL_COUNT])[3];
} frame_discrete;

/// Levels `low` to `high`. False after a message; destroy it all the same.
bool frame_discrete_create(frame_discrete *levels, const frame_actor *actor, uint32_t low,
                           uint32_t high);
void frame_discrete_destroy(frame_discrete *levels);

/// The lowest that keeps the tolerance of the scene at the middle of a character, or the highest.
uint32_t frame_discrete_choose(const frame_discrete *levels, const frame_crowd *crowd,
                               uint32_t instance);

/// The finest level that the scene asks for anywhere.
uint32_t frame_discrete_finest(const frame_script *script);

#endif
