/* SPDX-License-Identifier: MIT */
#include "sharpness.h"

#include <math.h>

limni_sharpness limni_sharpness_from_float(float sharpness) {
    if (!(sharpness > 0)) return 0;
    if (sharpness >= 10) return LIMNI_SHARPNESS_INFINITE;
    // Exact: a product with a power of two, and far from the limits of a float.
    return (limni_sharpness)lrintf(ldexpf(sharpness, LIMNI_SHARPNESS_BITS));
}

limni_sharpness limni_sharpness_next(limni_sharpness s) {
    if (s >= LIMNI_SHARPNESS_INFINITE) return s;
    return s > LIMNI_SHARPNESS_LEVEL ? s - LIMNI_SHARPNESS_LEVEL : 0;
}

limni_sharpness limni_edge_sharpness_next(limn_creasing creasing, limni_sharpness s,
                                          limni_sharp_edges edges) {
    if (creasing != LIMN_CREASING_CHAIKIN || edges.count < 2 || !limni_is_semi_sharp(s))
        return limni_sharpness_next(s);
    const limni_wide others = edges.count - 1;
    const limni_wide fourfold = 3 * others * s + (limni_wide)(edges.sum - s); // times others
    return limni_sharpness_next((limni_sharpness)limni_wide_divide(fourfold, 4 * others));
}
