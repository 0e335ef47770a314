/* SPDX-License-Identifier: MIT */
/* What `limn-bench frame` compares: ways to make the vertices of all characters of a frame. One file
 * per way; each prepares what does not depend on the frame beforehand. */
#ifndef FRAME_WAY_H
#define FRAME_WAY_H

#include "../peers/team.h"
#include "crowd.h"

/// The stages of a frame, and what each is.
#define FRAME_STAGES(X)                                                                            \
    X(SKIN, "skin", "clips, morph targets and skin")                                               \
    X(REFINE, "refine", "points behind the control points")                                        \
    X(NORMALS, "normals", "limit normals of the base vertices")                                    \
    X(PLAN, "plan", "views, who is in view, and levels")                                           \
    X(EVALUATE, "evaluate", "positions and unit normals, as floats")                               \
    X(LIGHT, "light", "what colours add to that")                                                  \
    X(PACK, "pack", "what packed formats add to that")                                             \
    X(DRAW, "draw", "drawing, by OpenGL in software")

typedef enum frame_stage {
#define FRAME_STAGE(name, text, meaning) FRAME_##name,
    FRAME_STAGES(FRAME_STAGE)
#undef FRAME_STAGE
        FRAME_STAGE_COUNT
} frame_stage;

extern const char *const frame_stage_names[FRAME_STAGE_COUNT];

/// One frame. Light and packing are part of evaluation: what they add is found by evaluating the
/// frame again without them, which `total` does not count. Noise can make it less than nothing.
typedef struct frame_record {
    double seconds[FRAME_STAGE_COUNT];
    double total; ///< of the frame as the scene wants it
    uint64_t vertices, triangles, bytes;
    uint64_t patches[LIMN_LEVEL_COUNT], culled; ///< of Limn; culled: of characters out of view, too
    uint32_t visible;                           ///< characters
} frame_record;

/// What all ways run with.
typedef struct frame_host {
    const frame_script *script;
    const frame_actor *actor;
    team *threads;         ///< NULL: one thread
    double (*clock)(void); ///< seconds
} frame_host;

typedef struct frame_way {
    const char *name;
    uint64_t shared_bytes;   ///< of what is stored, once
    uint64_t instance_bytes; ///< of each character, without its vertices
    void *state;
    /// Takes the frames that follow from this crowd, which lives as long.
    void (*set_crowd)(void *state, frame_crowd *crowd);
    /// Makes the frame of which the crowd has just been seen.
    void (*make)(void *state, frame_record *record);
    void (*destroy)(void *state);
} frame_way;

enum { FRAME_WAY_MAX = 8 };

typedef struct frame_ways {
    frame_way ways[FRAME_WAY_MAX];
    uint32_t count;
} frame_ways;

/// Appends a way, to be filled in. There is room for all that there are.
frame_way *frame_ways_append(frame_ways *ways);
void frame_ways_destroy(frame_ways *ways);

/// Each prepares a way and appends it, or nothing where the scene leaves it no sense. False after a
/// message.
typedef bool frame_ways_add(frame_ways *ways, const frame_host *host);

frame_ways_add frame_ways_add_limn;     ///< as the scene wants it, with light and packing timed
frame_ways_add frame_ways_add_floats;   ///< Limn writing what the others write
frame_ways_add frame_ways_add_dense;    ///< the skinned mesh of the finest level
frame_ways_add frame_ways_add_discrete; ///< skinned meshes of all levels
frame_ways_add frame_ways_add_stencils; ///< OpenSubdiv's limit stencils, and its Bfr surfaces
frame_ways_add frame_ways_add_bfr;
frame_ways_add frame_ways_add_drawn; ///< Limn, and its surfaces are drawn

/// Memory for poses, one for each thread.
frame_pose_memory *frame_host_create_poses(const frame_host *host);
void frame_host_free_poses(const frame_host *host, frame_pose_memory *poses);

/// Does all parts of a step, in all threads.
void frame_host_run(const frame_host *host, team_work *work, void *state);
uint32_t frame_host_threads(const frame_host *host);

/// Memory that grows, and never moves once it is large enough. What it holds is lost.
typedef struct frame_buffer {
    unsigned char *bytes;
    size_t size;
} frame_buffer;

void frame_buffer_reserve(frame_buffer *buffer, size_t size);

#endif
