/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_SUBDIVIDE_H
#define LIMNI_SUBDIVIDE_H

#include "neighbourhood.h"

/// What becomes of the vertices after the last level.
typedef enum limni_projection {
    LIMNI_PROJECT_NOT,     ///< they stay where that level puts them
    LIMNI_PROJECT_TO_LIMIT ///< they move to where all further levels would take them: first to the
                           ///< level at which they are settled, the tenth at most
} limni_projection;

/// Where coefficients go, K being the number of slots; each row sums to 1 within a few units of
/// 2^-60.
typedef struct limni_rows {
    limni_fixed *positions; ///< [row_counts[depth]][K] in the order of the domain
    limni_fixed *tangents;  ///< NULL, or [2][row_counts[depth]][K] its two tangents, only of the
                            ///< limit. Rows inside an edge have them along the edge and across, so
                            ///< that the neighbour has both negated, or on a crease the own side's;
                            ///< corners, whose normals belong to the control points, have zeros
    uint32_t new_corners; ///< bit c: corner c is new all the same and has tangents; corner 1 along
                          ///< edge 0, as if that went on
} limni_rows;

/// Subdivides face 0 of a neighbourhood symbolically, `depth` times, 0 to LIMN_LEVEL_MAX.
limn_bake_status limni_subdivide(limni_context *context, const limni_rules *rules,
                                 const limni_neighbourhood *neighbourhood, int depth,
                                 limni_projection projection, const limni_rows *rows);

/// The tangents of limni_scheme of a star that need not be settled: relative to the vertex and its
/// ring as they are.
///
/// along, across  out: [1 + star->count], and in quads the faces
limn_bake_status limni_star_tangents(limni_context *context, const limni_rules *rules,
                                     const limni_star *star, uint32_t half_steps,
                                     limni_fixed *along, limni_fixed *across);

/// The same for slot 0 of a neighbourhood, where the scheme reads more than its star: as sums of
/// slots, from its first half-edge on.
///
/// along, across  out: [slots]
limn_bake_status limni_vertex_tangents(limni_context *context, const limni_rules *rules,
                                       const limni_neighbourhood *neighbourhood, limni_fixed *along,
                                       limni_fixed *across);

#endif
