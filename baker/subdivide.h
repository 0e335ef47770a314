/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_SUBDIVIDE_H
#define LIMNI_SUBDIVIDE_H

#include "context.h"
#include "scheme.h"

/// The surroundings of one triangle, without positions: all that its coefficients depend on.
typedef struct limni_neighbourhood {
    uint32_t control_count; ///< K: slots 0, 1, 2 are the corners, the others follow around them
    limni_star corners[3];  ///< rings of slots
    const uint32_t *twins;  ///< [control_count] of slots that are in the same place for ever, the
                            ///< first, which has the coefficients of all; NULL: none are
} limni_neighbourhood;

/// What becomes of the vertices after the last level.
typedef enum limni_projection {
    LIMNI_PROJECT_NOT,     ///< they stay where that level puts them
    LIMNI_PROJECT_TO_LIMIT ///< they move to where all further levels would take them: first to the
                           ///< level at which they are settled, the tenth at most
} limni_projection;

/// Subdivides the triangle symbolically, `depth` times, 0 to LIMN_LEVEL_MAX.
///
/// positions  out: [row_counts[depth]][control_count] coefficients in the row order of the triangle
///            domain; each row sums to 1 within a few units of 2^-60
/// tangents   out, or NULL; only of the limit: the same for its two tangents, [2][…][…]; rows inside
///            an edge have them along the edge and across, so that the neighbour has both negated,
///            or on a crease the own side's; the corners, whose normals belong to the control
///            points, have zeros
limn_bake_status limni_subdivide(limni_context *context, const limni_rules *rules,
                                 const limni_neighbourhood *neighbourhood, int depth,
                                 limni_projection projection, limni_fixed *positions,
                                 limni_fixed *tangents);

/// limni_loop_tangent_masks() of a star that need not be settled: relative to the vertex and its
/// ring as they are.
///
/// along, across  out: [1 + star->count]
limn_bake_status limni_star_tangents(limni_context *context, const limni_rules *rules,
                                     const limni_star *star, uint32_t half_steps,
                                     limni_fixed *along, limni_fixed *across);

#endif
