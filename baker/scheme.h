/* SPDX-License-Identifier: MIT */
/*
 * A subdivision scheme is a set of masks. It sees a vertex and its ring, and gives weights; it
 * knows nothing of classes, tables or files. What is sharp there is in the star.
 */
#ifndef LIMNI_SCHEME_H
#define LIMNI_SCHEME_H

#include "limn/limn.h"
#include "star.h"

/// Weights of the new vertex on an edge.
typedef struct limni_edge_mask {
    limni_fixed ends[2]; ///< of the vertex itself and of the other end
    limni_fixed beside; ///< on both sides, of the opposite vertex of the triangle, or of the middle
                        ///< of the face; 0 on a crease, and on a boundary, where there is but one
} limni_edge_mask;

/// Weights of a mask: [0] of the vertex itself, [1 + r] of ring vertex r, and where the domain is
/// quads [1 + count + f] of face f, to the left of ring vertex f: in vertex masks of its middle, in
/// others of its diagonal. Those of a vertex and of the limit of a settled star sum to exactly 1.
typedef void limni_mask_fn(const limni_rules *rules, const limni_star *star, limni_fixed *weights);

struct limni_masks;

typedef struct limni_scheme {
    limn_domain_kind domain;
    uint32_t reach; ///< edges from the patch to the vertices whose stars its coefficients depend on
    limni_mask_fn *vertex_mask, *limit_mask;
    /// Adds the terms (masks.h) of the new vertex on the edge from the vertex that was looked at to
    /// ring vertex r.
    void (*edge_terms)(struct limni_masks *masks, uint32_t r);
    /// Adds those of a tangent of the limit surface, 0: along, 1: across, at the vertex that was
    /// looked at, whose star is settled; with a reach of 2 one level after its own. They sum to 0.
    /// The cross product of both points to the side from which the ring is counter-clockwise. Where the
    /// star is smooth, `along` points `half_steps` half steps from ring vertex 0 towards ring vertex
    /// 1, and starting from the opposite side of an even ring negates both exactly. Otherwise they
    /// are those of the side of the crease that starts at its edge half_steps / 2, along it and into
    /// that side; at a corner, of the face that starts there.
    void (*tangent_terms)(struct limni_masks *masks, uint32_t half_steps, int tangent);
} limni_scheme;

extern const limni_scheme limni_scheme_loop, limni_scheme_catmark, limni_scheme_butterfly;

/// What the terms of edges come from where a scheme reads one star.
limni_edge_mask limni_loop_edge_mask(const limni_edge_feature *feature);
limni_edge_mask limni_catmark_edge_mask(const limni_edge_feature *feature);

/// Whether a scheme has rules for sharpness and for corners of the boundary.
static inline bool limni_scheme_has_creases(limn_scheme scheme) {
    return scheme == LIMN_SCHEME_LOOP || scheme == LIMN_SCHEME_CATMARK;
}

/// The masks by some rules, for faces of a domain.
const limni_scheme *limni_scheme_of(const limni_rules *rules, limn_domain_kind domain);

// ---- What schemes share

/// What the masks of a feature give the ring, and the faces of quads.
typedef struct limni_ring_weights {
    limni_fixed smooth; ///< every neighbour
    limni_fixed crease; ///< both neighbours along it
    limni_fixed face;   ///< of a smooth vertex
} limni_ring_weights;

/// The mask of a vertex that goes through a level.
void limni_fill_mask(const limni_transition *transition, limni_ring_weights given,
                     const limni_star *star, limn_domain_kind domain, limni_fixed *weights);

/// A star that stays as it is.
limni_transition limni_star_forever(const limni_rules *rules, const limni_star *star);

/// z(j), where k z(j) - z(j - 1) - z(j + 1) = 1 between z(0) = z(n) = 0, which (1 - (q^j + q^(n -
/// j)) / (1 + q^n)) / (k - 2) solves, q being the smaller root of q^2 - k q + 1 = 0.
limni_fixed limni_dart_profile(uint32_t j, uint32_t n, int k, limni_fixed q);

/// Places in a ring from `first` on, counter-clockwise.
typedef struct limni_sector {
    uint32_t first, count;
} limni_sector;

/// The side of a crease that starts at its edge `first`.
limni_sector limni_crease_side(const limni_star *star, uint32_t first);

/// The weight of its vertex k.
static inline limni_fixed *limni_in_sector(const limni_star *star, limni_sector s, uint32_t k,
                                           limni_fixed *weights) {
    return &weights[1 + (s.first + k) % star->count];
}

/// At a corner, the tangents are the edges on both sides of the part whose normal the face has that
/// starts at ring vertex `first`.
void limni_corner_tangents(const limni_rules *rules, const limni_star *star, uint32_t first,
                           limni_fixed *along, limni_fixed *across);

#endif
