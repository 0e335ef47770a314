/* SPDX-License-Identifier: MIT */
/* A vertex, its neighbours, and what is sharp there. */
#ifndef LIMNI_STAR_H
#define LIMNI_STAR_H

#include "sharpness.h"

#include <stdbool.h>

/// A vertex with its neighbours, counter-clockwise. In an open ring the boundary runs through the
/// first and the last neighbour.
typedef struct limni_star {
    bool closed;
    uint32_t count;            ///< neighbours
    uint32_t *ring;            ///< [count]
    limni_sharpness sharpness; ///< of the vertex
    limni_sharpness *edges;    ///< [count] of the edges to the ring, infinite on a boundary; NULL:
                               ///< none is sharp but the boundary
    limni_sharpness *beyond;   ///< [count] what their halves at the far ends will have after a
                               ///< level; NULL with `edges`
} limni_star;

typedef enum limni_vertex_rule {
    LIMNI_VERTEX_SMOOTH,
    LIMNI_VERTEX_CREASE, ///< between two sharp edges
    LIMNI_VERTEX_CORNER, ///< stays where it is
    LIMNI_VERTEX_DART    ///< where a crease ends: smooth
} limni_vertex_rule;

/// What a vertex is.
typedef struct limni_feature {
    limni_vertex_rule rule;
    uint32_t ends[2]; ///< of a crease: the places of its two edges in the ring; of a dart: [0]
} limni_feature;

/// How a vertex goes through a level: its mask is `weight` of that for what it is, and the rest of
/// that for what it will be.
typedef struct limni_transition {
    limni_feature now, next;
    limni_fixed weight; ///< 1 where `next` has no part in it
} limni_transition;

static inline bool limni_star_has_left(const limni_star *star, uint32_t r) {
    return star->closed || r + 1 < star->count;
}
static inline bool limni_star_has_right(const limni_star *star, uint32_t r) {
    return star->closed || r > 0;
}
/// The places beside r, counter-clockwise and clockwise.
static inline uint32_t limni_star_left(const limni_star *star, uint32_t r) {
    return r + 1 < star->count ? r + 1 : 0;
}
static inline uint32_t limni_star_right(const limni_star *star, uint32_t r) {
    return r > 0 ? r - 1 : star->count - 1;
}

/// In half steps around the ring of a vertex that is new on an edge, which has a row of its own on
/// both sides: where the edge goes on that comes from place r.
uint32_t limni_star_opposite(const limni_star *star, uint32_t r);

/// The sharpness of the edge to ring vertex r.
static inline limni_sharpness limni_star_edge(const limni_star *star, uint32_t r) {
    if (star->edges) return star->edges[r];
    const bool inside = limni_star_has_left(star, r) && limni_star_has_right(star, r);
    return inside ? 0 : LIMNI_SHARPNESS_INFINITE;
}

/// Whether anything at the vertex will be less sharp after a level.
bool limni_star_decays(const limni_star *star);

/// What the half of the edge to ring vertex r that is next to the vertex has after a level.
limni_sharpness limni_star_next_edge(limn_creasing creasing, const limni_star *star, uint32_t r);

limni_feature limni_star_feature(const limni_star *star);

/// What the vertex is when all that decays has.
limni_feature limni_star_last_feature(const limni_star *star);

limni_transition limni_star_transition(limn_creasing creasing, const limni_star *star);

/// How much of a crease the edge to ring vertex r is in the mask of its new vertex: 0 if it is
/// smooth, 1 if it is sharp, and its sharpness on the level at which that ends.
limni_fixed limni_star_edge_weight(limn_creasing creasing, const limni_star *star, uint32_t r);

#endif
