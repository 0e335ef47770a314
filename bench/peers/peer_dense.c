/* SPDX-License-Identifier: MIT */
/* No subdivision at all: the refined mesh is stored, every vertex of it with bones and weights, and
 * skinned. */
#include "peer.h"

#include "../bench.h"
#include "allocate.h"
#include "skin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct state {
    const peer_scene *scene;
    skin_mesh skin;
    uint32_t *indices;
    skin_fn *apply;
    float *vertices;
    uint32_t floats; ///< of a vertex
} state;

static void run(void *self_state) {
    state *const self = self_state;
    self->apply(&self->skin, (const scene_bone *)self->scene->bones, self->vertices);
}

static const float *position(const void *self_state, uint32_t patch, uint32_t row) {
    const state *const self = self_state;
    const size_t vertex = self->scene->unique[(size_t)patch * self->scene->row_count + row];
    return self->vertices + vertex * self->floats;
}

static void destroy(void *self_state) {
    state *const self = self_state;
    skin_destroy(&self->skin);
    free(self->indices);
    free(self->vertices);
    free(self);
}

/// The vertices in the bind pose, from a peer.
static void evaluate_unique(const peer_scene *scene, const peer *source, float (*positions)[3]) {
    source->run(source->state);
    for (uint32_t vertex = 0; vertex < scene->unique_count; vertex++) {
        const uint32_t at = scene->unique_rows[vertex];
        const float *const position =
            source->position(source->state, at / scene->row_count, at % scene->row_count);
        for (uint32_t axis = 0; axis < 3; axis++)
            positions[vertex][axis] = position[axis * peer_axis_stride(source)];
    }
}

/// The triangles of all patches, which is also what a file of this mesh would hold.
static uint32_t *make_indices(const peer_scene *scene, uint64_t *byte_count) {
    const uint32_t count = scene->domain->index_counts[scene->level];
    const uint16_t *const rows = scene->domain->indices[scene->level];
    uint32_t *const indices = bench_allocate((size_t)scene->patch_count * count, sizeof *indices);
    for (uint32_t patch = 0; patch < scene->patch_count; patch++) {
        for (uint32_t i = 0; i < count; i++)
            indices[(size_t)patch * count + i] =
                scene->unique[(size_t)patch * scene->row_count + rows[i]];
    }
    *byte_count += (uint64_t)scene->patch_count * count * sizeof *indices;
    return indices;
}

static void subtract(const float a[3], const float b[3], float difference[3]) {
    for (int axis = 0; axis < 3; axis++)
        difference[axis] = a[axis] - b[axis];
}

/// Of the triangles, weighted by area: what skinning them costs does not depend on their values.
static void make_normals(const float (*positions)[3], uint32_t count, const uint32_t *indices,
                         size_t index_count, float (*normals)[3]) {
    for (size_t i = 0; i < index_count; i += 3) {
        float u[3], v[3];
        subtract(positions[indices[i + 1]], positions[indices[i]], u);
        subtract(positions[indices[i + 2]], positions[indices[i]], v);
        for (int corner = 0; corner < 3; corner++) {
            for (int axis = 0; axis < 3; axis++) {
                const int y = (axis + 1) % 3, z = (axis + 2) % 3;
                normals[indices[i + (size_t)corner]][axis] += u[y] * v[z] - u[z] * v[y];
            }
        }
    }
    for (uint32_t n = 0; n < count; n++) {
        float *const normal = normals[n];
        const float squares = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
        for (int axis = 0; axis < 3; axis++)
            normal[axis] = squares > 0 ? normal[axis] / sqrtf(squares) : axis == 0;
    }
}

static void append(peer_list *list, const peer_scene *scene, uint32_t isa, bool with_normals) {
    state *const self = bench_allocate(1, sizeof *self);
    const double start = bench_seconds();
    const uint32_t count = scene->unique_count;
    float(*const positions)[3] = bench_allocate(count, sizeof *positions);
    float(*const normals)[3] = bench_allocate(count, sizeof *normals);
    uint64_t index_bytes = 0;
    self->scene = scene;
    evaluate_unique(scene, &list->peers[0], positions);
    self->indices = make_indices(scene, &index_bytes);
    make_normals((const float(*)[3])positions, count, self->indices,
                 (size_t)index_bytes / sizeof *self->indices, normals);
    self->skin = skin_create((const float(*)[3])positions,
                             with_normals ? (const float(*)[3])normals : NULL, count);
    free(positions);
    free(normals);
    const double build_ms = 1e3 * (bench_seconds() - start);
    self->floats = with_normals ? 6 : 3;
    self->vertices = bench_allocate((size_t)count * self->floats + 1, sizeof *self->vertices);
    peer *const added = peer_append(list);
    *added = (peer){
        .name = "skin dense",
        .output = with_normals ? PEER_POSITION_NORMAL : PEER_POSITION,
        .points = PEER_UNIQUE_POINTS,
        .family = "",
        .threads = 1,
        .skinned = true,
        .build_ms = build_ms,
        .load_ms = (double)NAN,
        .byte_count = self->skin.byte_count + index_bytes,
        .state = self,
        .run = run,
        .position = position,
        .destroy = destroy,
    };
    self->apply = skin_select(isa, &added->isa);
}

bool peers_add_dense(peer_list *list, const peer_scene *scene) {
    for (int with_normals = 0; with_normals < 2; with_normals++) {
        const char *narrow, *wide;
        const uint32_t narrow_isas = LIMN_ISA_ALL & ~(uint32_t)LIMN_ISA_AVX2;
        if (skin_select(narrow_isas, &narrow) != skin_select(LIMN_ISA_ALL, &wide))
            append(list, scene, narrow_isas, with_normals);
        append(list, scene, LIMN_ISA_ALL, with_normals);
    }
    return true;
}
