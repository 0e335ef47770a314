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
    PEER_PATCH_POINTS, ///< all vertices of every patch: what Limn writes, 153 a face at level 4
    PEER_UNIQUE_POINTS ///< each vertex of the refined mesh once: about 128 a face at level 4
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
    /// The position, of 3 floats, of a row of a face in the last frame.
    const float *(*position)(const void *state, uint32_t face, uint32_t row);
    void (*destroy)(void *state);
} peer;

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

/// Each prepares its peers for the scene and appends them; the scene outlives them. False after a
/// message.
bool peers_add_limn(peer_list *list, const peer_scene *scene);
bool peers_add_loop(peer_list *list, const peer_scene *scene);
bool peers_add_dense(peer_list *list, const peer_scene *scene);
bool peers_add_stencils(peer_list *list, const peer_scene *scene);
bool peers_add_bfr(peer_list *list, const peer_scene *scene);

#ifdef __cplusplus
}
#endif

#endif
