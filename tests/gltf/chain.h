/* SPDX-License-Identifier: MIT */
/* A triangle that follows three joints: the end of a chain of nodes, and two that hang on nothing. */
#ifndef CHAIN_H
#define CHAIN_H

#include "glb.h"

/// length  of the chain: nodes
static inline void chain_make(glb *file, int length) {
    static const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const uint8_t joints[3][4] = {{0}, {1}, {2}};
    static const float weights[3][4] = {{1}, {1}, {1}};
    memset(file, 0, sizeof *file);
    const int position = glb_floats(file, "corners", corners[0], "VEC3", 3, 3);
    const int joint = glb_accessor(file, "joints", joints, sizeof joints, 5121, "VEC4", 3, "");
    const int weight = glb_floats(file, "weights", weights[0], "VEC4", 4, 3);
    glb_append(file->rest, sizeof file->rest, "\"nodes\":[{\"mesh\":0,\"skin\":0}");
    for (int n = 1; n < length; n++)
        glb_append(file->rest, sizeof file->rest, ",{\"children\":[%d]}", n + 1);
    glb_append(file->rest, sizeof file->rest,
               ",{},{},{}],\"skins\":[{\"joints\":[%d,%d,%d]}],\"meshes\":[{\"primitives\":"
               "[{\"attributes\":{\"POSITION\":%d,\"JOINTS_0\":%d,\"WEIGHTS_0\":%d}}]}]",
               length, length + 1, length + 2, position, joint, weight);
}

#endif
