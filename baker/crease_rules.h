/* SPDX-License-Identifier: MIT */
/* What the two sets of rules for creases differ in; star.h has them behind one interface. */
#ifndef LIMNI_CREASE_RULES_H
#define LIMNI_CREASE_RULES_H

#include "star.h"

/// Each member is the function of star.h of the same name.
typedef struct limni_crease_rules {
    limni_sharpness sharp_from; ///< what is less sharp takes no part in a feature
    bool (*is_settled)(const limni_star *star);
    limni_transition (*transition)(const limni_rules *rules, const limni_star *star);
    limni_edge_feature (*edge_feature)(const limni_rules *rules, const limni_star *star,
                                       uint32_t r);
    void (*see)(const limni_rules *rules, const limni_star *star, uint32_t first, uint32_t count,
                uint32_t *seen);
    uint32_t (*next_beyond)(const limni_rules *rules, const limni_star *star, uint32_t r);
} limni_crease_rules;

extern const limni_crease_rules limni_opensubdiv_creases, limni_lomont_creases;

// ---- What they share

/// Whether anything at the vertex will be less sharp after a level.
bool limni_star_decays(const limni_star *star);

/// Those around a vertex that Chaikin's method takes the average of.
limni_sharp_edges limni_star_sharp_edges(const limni_star *star);

/// The feature of the edges that are at least as sharp as `edges`, and of the vertex if it is as
/// sharp as `vertex`.
limni_feature limni_star_find_feature(const limni_star *star, limni_sharpness edges,
                                      limni_sharpness vertex);

/// What `sharp_count` sharp edges make of a vertex that is `sharp` itself or not.
limni_vertex_rule limni_vertex_rule_of(bool sharp, uint32_t sharp_count);

#endif
