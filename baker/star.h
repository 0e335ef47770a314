/* SPDX-License-Identifier: MIT */
/* A vertex, its neighbours, and what is sharp there. */
#ifndef LIMNI_STAR_H
#define LIMNI_STAR_H

#include "rules.h"
#include "sharpness.h"

#include <stdbool.h>

/// A vertex with its neighbours, counter-clockwise. In an open ring the boundary runs through the
/// first and the last neighbour.
typedef struct limni_star {
    bool closed;
    uint32_t count;      ///< neighbours
    uint32_t *ring;      ///< [count]
    uint32_t *diagonals; ///< [limni_star_face_count()] in quads, the vertex across the face to
                         ///< the left of each neighbour; NULL in other faces
    limni_sharpness sharpness; ///< of the vertex
    limni_sharpness *edges;    ///< [count] of the edges to the ring, infinite on a boundary; NULL:
                               ///< none is sharp, but a boundary if the rules need not see its ends
    uint32_t *beyond;          ///< [count] what the rules have to know of the far ends, see
                               ///< limni_star_see(); NULL with `edges`
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
    bool regular;     ///< of a crease: with two neighbours on each side of it
} limni_feature;

/// How a vertex goes through a level: its mask is `weight` of that for what it is, and the rest of
/// that for what it will be.
typedef struct limni_transition {
    limni_feature now, next;
    limni_fixed weight; ///< 1 where `next` has no part in it
} limni_transition;

/// What an edge is: its mask is `weight` of that for a crease, and the rest of that for a smooth
/// edge.
typedef struct limni_edge_feature {
    limni_fixed weight;
    int ends[2]; ///< what a crease gives the vertex itself and the other end, in eighths
} limni_edge_feature;

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

static inline uint32_t limni_star_face_count(const limni_star *star) {
    return star->closed ? star->count : star->count - 1;
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

/// Whether the limit masks hold: nothing will be less sharp after a level, and what the vertex is
/// next to does not matter.
bool limni_star_is_settled(const limni_rules *rules, const limni_star *star);

limni_feature limni_star_feature(const limni_rules *rules, const limni_star *star);

/// What the vertex is when all that decays has.
limni_feature limni_star_last_feature(const limni_star *star);

limni_transition limni_star_transition(const limni_rules *rules, const limni_star *star);

/// What the edge to ring vertex r is.
limni_edge_feature limni_star_edge_feature(const limni_rules *rules, const limni_star *star,
                                           uint32_t r);

/// What the half of the edge to ring vertex r that is next to the vertex has after a level.
limni_sharpness limni_star_next_edge(const limni_rules *rules, const limni_star *star, uint32_t r);

/// What some ring vertices have to know of the vertex, which is beyond the edges to them.
///
/// seen  out: [count] of ring vertex `first` and those that follow; 0 where the edge is smooth
void limni_star_see(const limni_rules *rules, const limni_star *star, uint32_t first,
                    uint32_t count, uint32_t *seen);

/// What there is beyond the edge to ring vertex r after a level, at the new vertex on it.
uint32_t limni_star_next_beyond(const limni_rules *rules, const limni_star *star, uint32_t r);

#endif
