/* SPDX-License-Identifier: MIT */
/*
 * Sharpness of edges and vertices: for how many levels they are treated as sharp (DeRose, Kass and
 * Truong, "Subdivision Surfaces in Character Animation", 1998), as OpenSubdiv does. In steps of
 * 2^-24, so that it is the same on every host; a step changes a coefficient by less than what a
 * float shows of it.
 */
#ifndef LIMNI_SHARPNESS_H
#define LIMNI_SHARPNESS_H

#include "fixed.h"
#include "limn/bake.h"

typedef uint32_t limni_sharpness;

#define LIMNI_SHARPNESS_BITS 24
#define LIMNI_SHARPNESS_LEVEL ((limni_sharpness)1 << LIMNI_SHARPNESS_BITS)
/// 10 and more never ends. Anything less ends within 10 levels.
#define LIMNI_SHARPNESS_INFINITE (10 * LIMNI_SHARPNESS_LEVEL)

/// The nearest step; below 0: 0.
limni_sharpness limni_sharpness_from_float(float sharpness);

/// The semi-sharp edges at a vertex: what Chaikin's rule takes the average of.
typedef struct limni_sharp_edges {
    uint64_t sum;
    uint32_t count;
} limni_sharp_edges;

static inline bool limni_is_semi_sharp(limni_sharpness s) {
    return s > 0 && s < LIMNI_SHARPNESS_INFINITE;
}

static inline void limni_sharp_edges_add(limni_sharp_edges *edges, limni_sharpness s) {
    if (!limni_is_semi_sharp(s)) return;
    edges->sum += s;
    edges->count++;
}

/// What a vertex has after a level.
limni_sharpness limni_sharpness_next(limni_sharpness s);

/// What an edge has after a level in its half next to a vertex, where it is one of `edges`. Uniform
/// creasing: one less. Chaikin's: 3/4 of its own and 1/4 of the average of the others, less one.
limni_sharpness limni_edge_sharpness_next(limn_creasing creasing, limni_sharpness s,
                                          limni_sharp_edges edges);

/// As a weight, 1 being the level's end.
static inline limni_fixed limni_sharpness_to_fixed(limni_sharpness s) {
    return (limni_fixed)s << (LIMNI_FIXED_BITS - LIMNI_SHARPNESS_BITS);
}

#endif
