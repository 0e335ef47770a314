/* SPDX-License-Identifier: MIT */
/* Linear blend skinning with four bones for each vertex: the bones' matrices are blended, and the
 * sum is applied once. */
#ifndef SKIN_H
#define SKIN_H

#include "scene.h"

typedef struct skin_mesh {
    float (*positions)[3];
    float (*normals)[3]; ///< unit; NULL: positions only
    uint8_t (*bones)[4]; ///< indices of bones
    float (*weights)[4]; ///< sums of 1
    uint32_t count;
    uint64_t byte_count; ///< of all arrays
} skin_mesh;

/// Skins all vertices. Normals come out as unit vectors.
///
/// bones  aligned to 32 bytes
/// out    [mesh->count] vertices, tightly packed: position, and normal if the mesh has any; and
///        room for one more float, which is overwritten
typedef void skin_fn(const skin_mesh *mesh, const scene_bone *bones, float *out);

skin_fn skin_scalar, skin_sse2, skin_avx2; // of the latter two those that were built

/// The best that was built and that the CPU has, among the instruction sets in `isa_mask`.
skin_fn *skin_select(uint32_t isa_mask, const char **name);

/// Copies the vertices and gives them random bones and weights. normals: NULL for none.
skin_mesh skin_create(const float (*positions)[3], const float (*normals)[3], uint32_t count);
void skin_destroy(skin_mesh *mesh);

#endif
