/* SPDX-License-Identifier: MIT */
/*
 * How far the triangles of a patch lie from its limit surface, at each level: measured at the rows
 * of finer levels, which lie on the limit. Only + - * / of doubles: the same on every host.
 */
#ifndef LIMNI_DEVIATION_H
#define LIMNI_DEVIATION_H

#include "../runtime/domain.h"

enum { LIMNI_NEAR_MAX = 4 }; ///< a triangle and its neighbours

/// The triangles of a level near a row: first the one that it lies on in the domain, then the
/// neighbours of that one inside the patch.
typedef struct limni_near {
    uint16_t count;
    uint16_t triangles[LIMNI_NEAR_MAX];
} limni_near;

/// What is the same for all patches of a domain.
typedef struct limni_ruler {
    const limn_domain *domain;
    limni_near near[LIMN_LEVEL_MAX][LIMNI_ROWS_MAX]; ///< levels 0 to 3
} limni_ruler;

void limni_ruler_begin(limni_ruler *ruler, const limn_domain *domain);

/// Squares of distances, in model units, by levels 0 to 3.
typedef struct limni_deviation {
    double edges[LIMN_CORNER_MAX][LIMN_LEVEL_MAX]; ///< of the curve over an edge from its chords
    double inside[LIMN_LEVEL_MAX]; ///< of the surface from the triangles, without the edges; never
                                   ///< less than the smallest of the edges
} limni_deviation;

/// points: [row_counts[LIMN_LEVEL_MAX]] limits of the rows
void limni_deviation_measure(const limni_ruler *ruler, const float (*points)[3],
                             limni_deviation *deviation);

#endif
