/* SPDX-License-Identifier: MIT */
/* A baked mesh beside OpenSubdiv's limit surface of its source. */
#ifndef LIMNI_COMPARE_H
#define LIMNI_COMPARE_H

#include "context.h"
#include "limn/limn.h"

typedef struct limni_comparison {
    double diagonal; ///< of the control points' bounding box
    double rounding; ///< what rounding the result to floats alone may add, relative to the diagonal
    double largest, mean;             ///< distances, relative to the diagonal
    uint32_t largest_face;            ///< where the largest is: a face of the base mesh, from 0
    uint64_t vertex_count;            ///< compared
    uint64_t normal_count;            ///< compared, if the mesh has normals
    uint64_t degenerate_count;        ///< not compared: the tangents span next to nothing
    double largest_angle, mean_angle; ///< between normals, in radians
    double largest_turn; ///< the largest way that such an angle moves the end of the tangents, from
                         ///< the line along the longer of them, divided by the diagonal
    uint32_t largest_angle_face;
} limni_comparison;

/// Compares the bind pose at level 4, all rows of every patch, with OpenSubdiv's answer for the
/// mesh in the file `path`. Fails when the mesh was baked from something else, by a scheme or weights
/// that OpenSubdiv does not have, or with Lomont's rules where these differ.
limn_bake_status limni_compare(limni_context *context, const limn_pack *pack, const limn_mesh *mesh,
                               const char *path, limni_comparison *comparison);

typedef struct limni_channel_comparison {
    double extent;         ///< of the values, along the axis where they have the largest
    double largest;        ///< difference of a component, relative to the extent
    uint32_t largest_face; ///< as above
    uint64_t value_count;  ///< compared; OpenSubdiv has no limit for some
} limni_channel_comparison;

/// The same for a channel of the mesh.
limn_bake_status limni_compare_channel(limni_context *context, const limn_pack *pack,
                                       const limn_mesh *mesh, uint32_t channel_index,
                                       const char *path, limni_channel_comparison *comparison);

#endif
