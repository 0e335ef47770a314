/* SPDX-License-Identifier: MIT */
/* Random meshes as Lomont's. */
#ifndef TAGGED_H
#define TAGGED_H

#include "../random_mesh.h"
#include "lomont.h"

/// A mesh with its tags. Free it with lomont_destroy().
static inline lomont_mesh lomont_from_random(const random_mesh *random) {
    lomont_mesh mesh = lomont_create((const float(*)[3])random->positions, random->vertex_count,
                                     (const uint32_t(*)[3])random->faces, random->face_count);
    for (uint32_t c = 0; c < random->crease_count; c++) {
        const uint32_t *const ends = random->creases[c].ends;
        lomont_set_edge_weight(&mesh, (int)ends[0], (int)ends[1],
                               (double)random->creases[c].weight);
    }
    for (int v = 0; v < mesh.vertex_count; v++)
        mesh.vertices[v].weight = (double)random->vertex_weights[v];
    return mesh;
}

/// Subdivides a mesh in place.
static inline void lomont_refine(lomont_mesh *mesh, int level_count) {
    for (int level = 0; level < level_count; level++) {
        lomont_mesh finer = lomont_subdivide(mesh);
        lomont_destroy(mesh);
        *mesh = finer;
    }
}

#endif
