/* SPDX-License-Identifier: MIT */
/*
 * Random manifold triangle meshes with tags: closed or with boundaries, of genus 0 and 1, with
 * creases, darts, corners and fractional weights. The same seed gives the same mesh everywhere.
 */
#ifndef RANDOM_MESH_H
#define RANDOM_MESH_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { RANDOM_MESH_VERTEX_MAX = 64, RANDOM_MESH_FACE_MAX = 128, RANDOM_MESH_CREASE_MAX = 64 };

typedef struct random_mesh {
    uint64_t state; ///< of the generator
    uint32_t vertex_count, face_count, crease_count;
    float positions[RANDOM_MESH_VERTEX_MAX][3];
    uint32_t faces[RANDOM_MESH_FACE_MAX][3]; ///< counter-clockwise
    float vertex_weights[RANDOM_MESH_VERTEX_MAX];
    struct {
        uint32_t ends[2]; ///< of an interior edge, which has no other entry
        float weight;
    } creases[RANDOM_MESH_CREASE_MAX];
} random_mesh;

/// Uniform in [0, count).
static inline uint32_t random_below(random_mesh *mesh, uint32_t count) {
    uint64_t z = mesh->state += 0x9e3779b97f4a7c15u; // splitmix64
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (uint32_t)(((z ^ (z >> 31)) >> 32) * count >> 32);
}

/// A multiple of 1/1024 in [-1, 1].
static inline float random_float(random_mesh *mesh) {
    return ((float)random_below(mesh, 2049) - 1024) / 1024;
}

/// Finds the face with the directed edge a b, turned so that the edge comes first.
static inline bool random_mesh_find(const random_mesh *mesh, uint32_t a, uint32_t b, uint32_t *face,
                                    uint32_t *opposite) {
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        const uint32_t *const corners = mesh->faces[h / 3];
        if (corners[h % 3] != a || corners[(h + 1) % 3] != b) continue;
        *face = h / 3;
        *opposite = corners[(h + 2) % 3];
        return true;
    }
    return false;
}

static inline bool random_mesh_has(const random_mesh *mesh, uint32_t a, uint32_t b) {
    uint32_t face, opposite;
    return random_mesh_find(mesh, a, b, &face, &opposite);
}

static inline uint32_t random_mesh_valence(const random_mesh *mesh, uint32_t vertex) {
    uint32_t count = 0; // of faces
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++)
        count += mesh->faces[h / 3][h % 3] == vertex;
    return count;
}

static inline void random_mesh_set_face(random_mesh *mesh, uint32_t face, uint32_t a, uint32_t b,
                                        uint32_t c) {
    mesh->faces[face][0] = a, mesh->faces[face][1] = b, mesh->faces[face][2] = c;
}

static inline void random_mesh_add_face(random_mesh *mesh, uint32_t a, uint32_t b, uint32_t c) {
    random_mesh_set_face(mesh, mesh->face_count++, a, b, c);
}

static inline uint32_t random_mesh_add_vertex(random_mesh *mesh, float x, float y, float z) {
    const float position[3] = {x, y, z};
    memcpy(mesh->positions[mesh->vertex_count], position, sizeof position);
    return mesh->vertex_count++;
}

// ---- Shapes to start from

static inline void random_mesh_octahedron(random_mesh *mesh) {
    static const uint32_t faces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                         {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int v = 0; v < 6; v++) {
        float position[3] = {0};
        position[v / 2] = v % 2 ? -4 : 4;
        random_mesh_add_vertex(mesh, position[0], position[1], position[2]);
    }
    memcpy(mesh->faces, faces, sizeof faces);
    mesh->face_count = 8;
}

/// `around` x `along` vertices, each with six neighbours; a torus, or where `open` a tube, with
/// four neighbours on its boundaries.
static inline void random_mesh_tube(random_mesh *mesh, uint32_t around, uint32_t along, bool open) {
    for (uint32_t v = 0; v < around * along; v++) {
        const float s = (float)(v / around), x = (float)(v % around);
        random_mesh_add_vertex(mesh, 4 * x + random_float(mesh), 4 * s + random_float(mesh),
                               (x - 2) * (s - 1) + random_float(mesh));
    }
    for (uint32_t q = 0; q < around * (open ? along - 1 : along); q++) {
        const uint32_t s = q / around, x = q % around, up = (s + 1) % along * around;
        const uint32_t next = (x + 1) % around;
        random_mesh_add_face(mesh, s * around + x, s * around + next, up + next);
        random_mesh_add_face(mesh, s * around + x, up + next, up + x);
    }
}

// ---- Changes that leave a closed manifold closed and manifold

/// Puts a vertex of valence 3 into a face.
static inline void random_mesh_split(random_mesh *mesh) {
    const uint32_t face = random_below(mesh, mesh->face_count);
    const uint32_t a = mesh->faces[face][0], b = mesh->faces[face][1], c = mesh->faces[face][2];
    float p[3];
    for (int axis = 0; axis < 3; axis++)
        p[axis] =
            (mesh->positions[a][axis] + mesh->positions[b][axis] + mesh->positions[c][axis]) / 4 +
            random_float(mesh);
    const uint32_t v = random_mesh_add_vertex(mesh, p[0], p[1], p[2]);
    random_mesh_set_face(mesh, face, a, b, v);
    random_mesh_add_face(mesh, b, c, v);
    random_mesh_add_face(mesh, c, a, v);
}

/// Exchanges an edge for the other diagonal of its two faces, unless that is an edge already.
static inline void random_mesh_flip(random_mesh *mesh) {
    const uint32_t face = random_below(mesh, mesh->face_count), k = random_below(mesh, 3);
    const uint32_t a = mesh->faces[face][k], b = mesh->faces[face][(k + 1) % 3];
    const uint32_t c = mesh->faces[face][(k + 2) % 3];
    uint32_t other, d;
    if (!random_mesh_find(mesh, b, a, &other, &d) || c == d) return;
    if (random_mesh_has(mesh, c, d) || random_mesh_has(mesh, d, c)) return;
    if (random_mesh_valence(mesh, a) <= 3 || random_mesh_valence(mesh, b) <= 3) return;
    random_mesh_set_face(mesh, face, a, d, c);
    random_mesh_set_face(mesh, other, d, b, c);
}

// ---- Boundaries

/// Whether a vertex has faces, and no more than one boundary passes through it.
static inline bool random_mesh_is_manifold(const random_mesh *mesh, uint32_t vertex) {
    uint32_t boundary_count = 0;
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        if (mesh->faces[h / 3][h % 3] != vertex) continue;
        boundary_count += !random_mesh_has(mesh, mesh->faces[h / 3][(h + 1) % 3], vertex);
    }
    return boundary_count <= 1 && random_mesh_valence(mesh, vertex) > 0;
}

/// Removes a face, unless a vertex would not be manifold without it.
static inline void random_mesh_remove_face(random_mesh *mesh) {
    const uint32_t face = random_below(mesh, mesh->face_count);
    uint32_t removed[3], *const last = mesh->faces[mesh->face_count - 1];
    memcpy(removed, mesh->faces[face], sizeof removed);
    memmove(mesh->faces[face], last, sizeof removed);
    mesh->face_count--;
    for (int k = 0; k < 3; k++) {
        if (random_mesh_is_manifold(mesh, removed[k])) continue;
        random_mesh_add_face(mesh, removed[0], removed[1], removed[2]);
        return;
    }
}

// ---- Tags

static inline void random_mesh_crease(random_mesh *mesh, uint32_t a, uint32_t b, float weight) {
    const bool interior = random_mesh_has(mesh, a, b) && random_mesh_has(mesh, b, a);
    if (!interior || mesh->crease_count == RANDOM_MESH_CREASE_MAX) return;
    for (uint32_t c = 0; c < mesh->crease_count; c++) {
        const uint32_t *const ends = mesh->creases[c].ends;
        if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a)) return;
    }
    mesh->creases[mesh->crease_count].ends[0] = a;
    mesh->creases[mesh->crease_count].ends[1] = b;
    mesh->creases[mesh->crease_count++].weight = weight;
}

/// Infinite, or with `finite` as well an integer or a fraction up to 3.
static inline float random_weight(random_mesh *mesh, bool finite) {
    static const float weights[] = {INFINITY, 0.25f, 0.5f, 1, 1.75f, 2, 2.5f, 3};
    return finite ? weights[random_below(mesh, 8)] : INFINITY;
}

/// A crease of one weight along a few edges, which may cross itself and others.
static inline void random_mesh_walk(random_mesh *mesh, bool finite) {
    const float weight = random_weight(mesh, finite);
    uint32_t at = random_below(mesh, mesh->vertex_count);
    for (uint32_t step = 2 + random_below(mesh, 5); step > 0; step--) {
        const uint32_t to = random_below(mesh, mesh->vertex_count);
        uint32_t face, opposite;
        for (uint32_t i = 0; i < mesh->vertex_count; i++) {
            const uint32_t candidate = (to + i) % mesh->vertex_count;
            if (!random_mesh_find(mesh, at, candidate, &face, &opposite)) continue;
            random_mesh_crease(mesh, at, candidate, weight);
            at = candidate;
            break;
        }
    }
}

/// Tags a mesh: some creases, some corners; all weights infinite unless `finite`.
static inline void random_mesh_tag(random_mesh *mesh, bool finite) {
    for (uint32_t count = 2 + random_below(mesh, 6); count > 0; count--)
        random_mesh_walk(mesh, finite);
    for (uint32_t count = random_below(mesh, 5); count > 0; count--)
        mesh->vertex_weights[random_below(mesh, mesh->vertex_count)] = random_weight(mesh, finite);
}

/// A mesh of 12 to 64 vertices without tags, closed unless `open`. Seeds give tori every third
/// time.
static inline random_mesh random_mesh_make(uint64_t seed, bool open) {
    random_mesh mesh = {.state = seed};
    if (seed % 3 == 0)
        random_mesh_tube(&mesh, 4 + random_below(&mesh, 2), 4, false);
    else
        random_mesh_octahedron(&mesh);
    for (uint32_t count = 6 + random_below(&mesh, 20); count > 0; count--)
        random_mesh_split(&mesh);
    for (uint32_t count = random_below(&mesh, 80); count > 0; count--)
        random_mesh_flip(&mesh);
    for (uint32_t count = open ? 1 + random_below(&mesh, mesh.face_count / 2) : 0; count > 0;
         count--)
        random_mesh_remove_face(&mesh);
    return mesh;
}

#endif
