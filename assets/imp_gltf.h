/* SPDX-License-Identifier: MIT */
/* The imp as a character: bones, a clip, a morph target and texture coordinates, as glTF. */
#ifndef ASSETS_IMP_GLTF_H
#define ASSETS_IMP_GLTF_H

#include "mesh.h"

/* From the cage that was modelled to the imp: swings the tail to one side, and brings it to its
 * height with its feet on the ground. */
point imp_pose_point(point p);

/* Writes the imp's triangles with all that moves them. */
void imp_print_gltf(const mesh *m, FILE *out);

#endif
