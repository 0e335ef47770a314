/* SPDX-License-Identifier: MIT */
#include "scene.h"

#include "../bench.h"
#include "allocate.h"
#include "topology.h"

#include "limn/bake.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool check_bake(limn_bake_status status, const limn_baker *baker) {
    if (status != LIMN_BAKE_OK) fprintf(stderr, "limn-bench: %s\n", limn_baker_error(baker));
    return status == LIMN_BAKE_OK;
}

/// The mesh as the baker has read and mended it, in the order of the file. Holes are in no file.
static bool copy_mesh(peer_scene *scene, const void *blob, size_t blob_size) {
    limn_pack pack;
    if (limn_pack_open(&pack, blob, blob_size) != LIMN_OK) return false;
    const limn_mesh mesh = limn_pack_mesh(&pack, 0);
    if (mesh.patch_count < mesh.face_count) {
        fprintf(stderr, "limn-bench: %s has holes, which peers do not\n", mesh.name);
        return false;
    }
    snprintf(scene->name, sizeof scene->name, "%s", mesh.name);
    scene->control_count = mesh.control_count;
    scene->face_count = mesh.patch_count;
    scene->controls = bench_allocate(mesh.control_count, sizeof *scene->controls);
    memcpy(scene->controls, mesh.controls, mesh.control_count * sizeof *scene->controls);
    scene->faces = bench_allocate(mesh.patch_count, sizeof *scene->faces);
    for (uint32_t p = 0; p < mesh.patch_count; p++) {
        const limn_patch_face face = limn_mesh_face(&mesh, p);
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(&mesh, p, corners);
        for (uint32_t c = 0; c < 3; c++)
            scene->faces[face.face][(c + face.rotation) % 3] = corners[c];
    }
    return true;
}

static bool read_mesh(peer_scene *scene, const char *path) {
    limn_baker *const baker = limn_baker_create(
        &(limn_bake_desc){.repair = LIMN_REPAIR_ALL, .non_manifold = LIMN_NON_MANIFOLD_SPLIT});
    if (!baker) return false;
    const void *blob;
    size_t blob_size;
    const bool good = check_bake(limn_baker_add_file(baker, path), baker) &&
                      check_bake(limn_baker_finish(baker, &blob, &blob_size), baker) &&
                      copy_mesh(scene, blob, blob_size);
    limn_baker_destroy(baker);
    return good;
}

/// From the arrays that the peers get too, so that no reading of files is timed.
static bool bake(const peer_scene *scene, limn_normals normals, scene_baked *baked) {
    const limn_bake_mesh mesh = {
        .name = scene->name,
        .positions = scene->controls[0],
        .position_count = scene->control_count,
        .face_count = scene->face_count,
        .face_indices = scene->faces[0],
    };
    const double start = bench_seconds();
    baked->baker = limn_baker_create(&(limn_bake_desc){.normals = normals});
    if (!baked->baker) return false;
    const bool good =
        check_bake(limn_baker_add_mesh(baked->baker, &mesh), baked->baker) &&
        check_bake(limn_baker_finish(baked->baker, &baked->blob, &baked->blob_size), baked->baker);
    baked->ms = 1e3 * (bench_seconds() - start);
    return good;
}

typedef struct grid_point {
    int i, j;
} grid_point;

/// Where the corners of the child faces of one face lie, in the order of topology_refine().
static void place_children(uint32_t level, const grid_point corners[3], grid_point (**place)[3]) {
    if (level == 0) {
        memcpy(*(*place)++, corners, sizeof **place);
        return;
    }
    grid_point middles[3];
    for (int c = 0; c < 3; c++) {
        const grid_point a = corners[c], b = corners[(c + 1) % 3];
        middles[c] = (grid_point){(a.i + b.i) / 2, (a.j + b.j) / 2};
    }
    for (int c = 0; c < 3; c++)
        place_children(level - 1, (grid_point[3]){corners[c], middles[c], middles[(c + 2) % 3]},
                       place);
    place_children(level - 1, middles, place);
}

static void fill_refined(peer_scene *scene, const topology *mesh) {
    enum { CHILD_MAX = 1 << 2 * LIMN_LEVEL_MAX };
    static grid_point places[CHILD_MAX][3];
    grid_point(*end)[3] = places;
    const grid_point corners[3] = {{0, 0}, {LIMN_GRID_SIZE, 0}, {0, LIMN_GRID_SIZE}};
    place_children(scene->level, corners, &end);

    const uint32_t child_count = 1u << 2 * scene->level;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        for (int c = 0; c < 3; c++) {
            const grid_point place = places[f % child_count][c];
            const size_t face = f / child_count;
            scene->refined[face * scene->row_count + scene->row_at[place.i][place.j]] =
                mesh->face_vertices[f][c];
        }
    }
}

static void number_unique(peer_scene *scene, uint32_t vertex_count) {
    uint32_t *const number = bench_allocate(vertex_count, sizeof *number);
    memset(number, 0xff, vertex_count * sizeof *number);
    scene->unique_rows = bench_allocate(vertex_count, sizeof *scene->unique_rows);
    const uint32_t row_total = scene->face_count * scene->row_count;
    for (uint32_t row = 0; row < row_total; row++) {
        uint32_t *const mine = &number[scene->refined[row]];
        if (*mine == SCENE_NO_VERTEX) {
            scene->unique_rows[scene->unique_count] = row;
            *mine = scene->unique_count++;
        }
        scene->unique[row] = *mine;
    }
    free(number);
}

static void find_vertices(peer_scene *scene) {
    topology mesh = topology_create((const uint32_t(*)[3])scene->faces, scene->face_count,
                                    scene->control_count);
    for (uint32_t level = 0; level < scene->level; level++) {
        topology fine = topology_refine(&mesh);
        topology_destroy(&mesh);
        mesh = fine;
    }
    const size_t row_total = (size_t)scene->face_count * scene->row_count;
    scene->refined = bench_allocate(row_total, sizeof *scene->refined);
    scene->unique = bench_allocate(row_total, sizeof *scene->unique);
    fill_refined(scene, &mesh);
    number_unique(scene, mesh.vertex_count);
    topology_destroy(&mesh);
}

uint32_t scene_face_row(const peer_scene *scene, uint32_t row, uint32_t rotation) {
    const int i = scene->domain->rows[row].i, j = scene->domain->rows[row].j;
    const int weights[3] = {LIMN_GRID_SIZE - i - j, i, j}; // of the corners of the patch
    return scene->row_at[weights[(4 - rotation) % 3]][weights[(5 - rotation) % 3]];
}

float scene_random(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) * 0x1p-24f;
}

/// From a random unit quaternion.
static void make_bone(scene_bone bone, uint32_t *seed) {
    float q[4], length = 0;
    for (int i = 0; i < 4; i++) {
        q[i] = scene_random(seed) + (i == 3 ? 1.5f : -0.5f);
        length += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++)
        q[i] /= sqrtf(length);
    const float x = q[0], y = q[1], z = q[2], w = q[3];
    const float columns[16] = {
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),     0,
        2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),     0,
        2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y), 0,
        scene_random(seed),      scene_random(seed),      scene_random(seed),      0};
    memcpy(bone, columns, sizeof columns);
}

void scene_set_bones(peer_scene *scene, bool equal) {
    uint32_t seed = 1;
    for (int b = 0; b < SCENE_BONE_COUNT; b++) {
        make_bone(scene->bones[b], &seed);
        if (equal) seed = 1;
    }
}

bool scene_create(peer_scene *scene, const char *path, uint32_t level, uint32_t thread_count) {
    memset(scene, 0, sizeof *scene);
    scene->level = level;
    scene->domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    scene->row_count = scene->domain->row_counts[level];
    for (uint16_t r = 0; r < scene->row_count; r++)
        scene->row_at[scene->domain->rows[r].i][scene->domain->rows[r].j] = r;
    if (!read_mesh(scene, path)) return false;
    if (scene->face_count > INT32_MAX / (4u << 2 * LIMN_LEVEL_MAX)) {
        fprintf(stderr, "limn-bench: %s has too many faces for a comparison\n", path);
        return false;
    }
    if (!bake(scene, LIMN_NORMALS_NONE, &scene->baked) ||
        !bake(scene, LIMN_NORMALS_EXACT, &scene->baked_with_normals))
        return false;
    find_vertices(scene);
    scene->bones = bench_allocate(SCENE_BONE_COUNT, sizeof *scene->bones);
    scene_set_bones(scene, false);
    if (thread_count > 1) scene->threads = team_create(thread_count);
    return true;
}

void scene_destroy(peer_scene *scene) {
    if (scene->threads) team_destroy(scene->threads);
    limn_baker_destroy(scene->baked.baker);
    limn_baker_destroy(scene->baked_with_normals.baker);
    free(scene->controls);
    free(scene->faces);
    free(scene->refined);
    free(scene->unique);
    free(scene->unique_rows);
    free(scene->bones);
}
