/* SPDX-License-Identifier: MIT */
/*
 * What `limn-bench peers` compares: ways of computing the same points of the same mesh once a
 * frame. A peer prepares everything that does not depend on the frame beforehand; one file per
 * peer. To add one: a file with a function peers_add_…(), a line here and one in peers.c.
 */
#ifndef PEER_H
#define PEER_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What is written for each point.
typedef enum peer_output {
    PEER_POSITION,
    PEER_POSITION_DERIVATIVES, ///< position and two first derivatives, not yet a normal
    PEER_POSITION_NORMAL       ///< position and unit normal
} peer_output;

/// Which points are written.
typedef enum peer_points {
    PEER_PATCH_POINTS, ///< all vertices of every patch: what Limn writes, at level 4 153 a triangle,
                       ///< 289 a quad
    PEER_UNIQUE_POINTS ///< each vertex of the refined mesh once: about 128 a triangle, 256 a quad
} peer_points;

typedef struct peer {
    const char *name;
    peer_output output;
    peer_points points;
    const char *isa;
    const char *family;  ///< of Limn's kernels; "" for others
    uint32_t threads;    ///< that work on a frame
    bool skinned;        ///< starts from bones, not from control points
    bool best_limn;      ///< what peers with the same output, threads and start are held against
    double build_ms;     ///< from the mesh in memory to what is stored
    double load_ms;      ///< from what is stored, in memory, to ready; NAN: there is no stored form
    uint64_t byte_count; ///< of what is stored, per mesh and not per instance or frame
    void *state;
    void (*run)(void *state); ///< computes one frame
    /// The position of a row of a patch in the last frame: three floats, `axis_stride` apart.
    const float *(*position)(const void *state, uint32_t patch, uint32_t row);
    uint32_t axis_stride; ///< 0 means 1
    /// The control points of the next frame, [control_count][control_size], of which three are
    /// coordinates; NULL: those of the scene, always.
    float *controls;
    uint32_t control_size;
    void (*destroy)(void *state);
} peer;

static inline uint32_t peer_axis_stride(const peer *which) {
    return which->axis_stride ? which->axis_stride : 1;
}

#define PEER_MAX 64

/// What the system's OpenSubdiv is built for: what every CPU of the architecture has.
#if defined(__x86_64__) || defined(__i386__)
#define PEER_OPENSUBDIV_ISA "sse2"
#elif defined(__aarch64__)
#define PEER_OPENSUBDIV_ISA "neon"
#else
#define PEER_OPENSUBDIV_ISA "scalar"
#endif

typedef struct peer_list {
    peer peers[PEER_MAX];
    uint32_t count;
} peer_list;

/// Appends a peer and returns it, to be filled in. The list has room for all that there are.
peer *peer_append(peer_list *list);

/// Each prepares its peers for the scene and appends them, or none if they do not have its scheme;
/// the scene outlives them. False after a message.
bool peers_add_limn(peer_list *list, const peer_scene *scene);
bool peers_add_stencils(peer_list *list, const peer_scene *scene);
bool peers_add_bfr(peer_list *list, const peer_scene *scene);
bool peers_add_embree(peer_list *list, const peer_scene *scene);
bool peers_add_loop(peer_list *list, const peer_scene *scene);
bool peers_add_catmark(peer_list *list, const peer_scene *scene);
/// Last: it takes the bind pose from the first of the list.
bool peers_add_dense(peer_list *list, const peer_scene *scene);

/// Appends peers that share what they have prepared and have control points of their own, for as many
/// threads: with derivatives, of stencils at the unique points, or of Bfr. False after a message.
typedef bool peers_add_copies(peer_list *list, const peer_scene *scene, uint32_t count);
peers_add_copies peers_add_stencil_copies, peers_add_bfr_copies;

#ifdef __cplusplus
}
#endif

#endif
