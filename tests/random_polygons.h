/* SPDX-License-Identifier: MIT */
/*
 * Random manifold polygon meshes with tags, made from random triangle meshes: a quad for every edge
 * inside of one, or its triangles put together. The same seed gives the same mesh everywhere.
 */
#ifndef RANDOM_POLYGONS_H
#define RANDOM_POLYGONS_H

#include "random_mesh.h"

#include <stdio.h>

enum {
    RANDOM_POLYGON_SIZE_MAX = 7,
    RANDOM_POLYGON_VERTEX_MAX = RANDOM_MESH_VERTEX_MAX + RANDOM_MESH_FACE_MAX,
    RANDOM_POLYGON_MAX = 2 * RANDOM_MESH_FACE_MAX
};

typedef struct random_polygon {
    uint32_t size; ///< 0: it has become a part of another
    uint32_t corners[RANDOM_POLYGON_SIZE_MAX];
} random_polygon;

typedef struct random_polygons {
    random_mesh triangles; ///< what they come from; its generator goes on
    uint32_t vertex_count, face_count;
    float positions[RANDOM_POLYGON_VERTEX_MAX][3];
    random_polygon faces[RANDOM_POLYGON_MAX];
} random_polygons;

/// Between the ends of every edge and the middles of its two triangles; vertices of valence 3 and
/// others alternate around each quad.
static inline void random_quads_of_edges(random_polygons *mesh) {
    const random_mesh *const from = &mesh->triangles;
    for (uint32_t f = 0; f < from->face_count; f++) {
        float *const middle = mesh->positions[mesh->vertex_count++];
        for (int axis = 0; axis < 3; axis++) {
            for (int c = 0; c < 3; c++)
                middle[axis] += from->positions[from->faces[f][c]][axis] / 3;
        }
    }
    for (uint32_t h = 0; h < 3 * from->face_count; h++) {
        const uint32_t a = from->faces[h / 3][h % 3], b = from->faces[h / 3][(h + 1) % 3];
        uint32_t other, opposite;
        if (a > b || !random_mesh_find(from, b, a, &other, &opposite)) continue;
        mesh->faces[mesh->face_count++] =
            (random_polygon){4, {a, from->vertex_count + other, b, from->vertex_count + h / 3}};
    }
}

/// The face and the place in it where the directed edge a b starts.
static inline bool random_polygons_find(const random_polygons *mesh, uint32_t a, uint32_t b,
                                        uint32_t *face, uint32_t *place) {
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const random_polygon *const polygon = &mesh->faces[f];
        for (uint32_t k = 0; k < polygon->size; k++) {
            if (polygon->corners[k] != a || polygon->corners[(k + 1) % polygon->size] != b)
                continue;
            *face = f;
            *place = k;
            return true;
        }
    }
    return false;
}

/// Puts two faces together, unless that would be no simple polygon or too large.
static inline void random_polygons_merge(random_polygons *mesh) {
    const uint32_t f = random_below(&mesh->triangles, mesh->face_count);
    random_polygon *const face = &mesh->faces[f];
    uint32_t g, place, k = random_below(&mesh->triangles, RANDOM_POLYGON_SIZE_MAX);
    if (k >= face->size) return;
    const uint32_t a = face->corners[k], b = face->corners[(k + 1) % face->size];
    if (!random_polygons_find(mesh, b, a, &g, &place)) return;
    random_polygon *const other = &mesh->faces[g];
    random_polygon made = {.size = face->size + other->size - 2};
    if (made.size > RANDOM_POLYGON_SIZE_MAX) return;
    for (uint32_t c = 0; c < made.size; c++) {
        const bool first = c + 1 < face->size; // from b round to before a, and on from a
        made.corners[c] = first ? face->corners[(k + 1 + c) % face->size]
                                : other->corners[(place + 2 + c - face->size) % other->size];
        for (uint32_t before = 0; before < c; before++) {
            if (made.corners[before] == made.corners[c]) return;
        }
    }
    *face = made;
    other->size = 0;
}

/// With the vertices of the triangles: all quads, or triangles to heptagons.
static inline random_polygons random_polygons_make(uint64_t seed, bool quads, bool open) {
    random_polygons mesh = {.triangles = random_mesh_make(seed, open)};
    mesh.vertex_count = mesh.triangles.vertex_count;
    memcpy(mesh.positions, mesh.triangles.positions, sizeof mesh.triangles.positions);
    if (quads) {
        random_quads_of_edges(&mesh);
        return mesh;
    }
    mesh.face_count = mesh.triangles.face_count;
    for (uint32_t f = 0; f < mesh.face_count; f++) {
        mesh.faces[f].size = 3;
        memcpy(mesh.faces[f].corners, mesh.triangles.faces[f], sizeof mesh.triangles.faces[f]);
    }
    for (uint32_t count = 3 * mesh.face_count; count > 0; count--)
        random_polygons_merge(&mesh);
    return mesh;
}

/// As an OBJ file with OpenSubdiv's tags on some edges and vertices: for ever, or up to 3.
static inline bool random_polygons_write(random_polygons *mesh, bool tagged, const char *path) {
    FILE *const file = fopen(path, "w");
    random_mesh *const from = &mesh->triangles;
    if (!file) return false;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        fprintf(file, "v %g %g %g\n", (double)mesh->positions[v][0], (double)mesh->positions[v][1],
                (double)mesh->positions[v][2]);
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const random_polygon *const face = &mesh->faces[f];
        for (uint32_t k = 0; k < face->size; k++)
            fprintf(file, "%s%u%s", k == 0 ? "f " : " ", face->corners[k] + 1,
                    k + 1 == face->size ? "\n" : "");
        for (uint32_t k = 0; k < face->size && tagged; k++) {
            const uint32_t next = face->corners[(k + 1) % face->size];
            if (random_below(from, 6)) continue;
            fprintf(file, "t crease 2/1/0 %u %u %g\n", face->corners[k], next,
                    fmin((double)random_weight(from, true), 10));
        }
    }
    for (uint32_t v = 0; v < from->vertex_count && tagged; v += 1 + random_below(from, 20))
        fprintf(file, "t corner 1/1/0 %u %g\n", v, fmin((double)random_weight(from, true), 10));
    return fclose(file) == 0;
}

#endif
