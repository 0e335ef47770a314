/* SPDX-License-Identifier: MIT */
#include "scene.h"

#include "../../baker/source.h"
#include "../bench.h"
#include "allocate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool check_bake(limn_bake_status status, const limn_baker *baker) {
    if (status != LIMN_BAKE_OK) fprintf(stderr, "limn-bench: %s\n", limn_baker_error(baker));
    return status == LIMN_BAKE_OK;
}

// -------------------------------------------------------------------------------------------------
// Reading and baking

/// The faces of a baked mesh, in the order of its source. Holes are in no file.
static bool copy_faces(peer_scene *scene, const limn_mesh *mesh) {
    const uint32_t size = mesh->domain->corner_count;
    if (mesh->patch_count < mesh->face_count || mesh->base_first > 0) {
        fprintf(stderr, "limn-bench: %s has holes or divided faces, which peers do not\n",
                mesh->name);
        return false;
    }
    snprintf(scene->name, sizeof scene->name, "%s", mesh->name);
    scene->control_count = mesh->control_count;
    scene->face_count = scene->patch_count = mesh->patch_count;
    scene->controls = bench_allocate(mesh->control_count, sizeof *scene->controls);
    memcpy(scene->controls, mesh->controls, mesh->control_count * sizeof *scene->controls);
    scene->face_sizes = bench_allocate(mesh->patch_count, sizeof *scene->face_sizes);
    scene->face_corners = bench_allocate(mesh->patch_count, size * sizeof *scene->face_corners);
    for (uint32_t p = 0; p < mesh->patch_count; p++) {
        const limn_patch_face face = limn_mesh_face(mesh, p);
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(mesh, p, corners);
        scene->face_sizes[p] = size;
        for (uint32_t c = 0; c < size; c++)
            scene->face_corners[size * face.face + (c + face.rotation) % size] = corners[c];
    }
    return true;
}

static bool copy_triangles(peer_scene *scene, const void *blob, size_t blob_size) {
    limn_pack pack;
    if (limn_pack_open(&pack, blob, blob_size) != LIMN_OK) return false;
    const limn_mesh mesh = limn_pack_mesh(&pack, 0);
    return copy_faces(scene, &mesh);
}

static bool read_triangles(peer_scene *scene, const char *path) {
    limn_baker *const baker = limn_baker_create(
        &(limn_bake_desc){.repair = LIMN_REPAIR_ALL, .non_manifold = LIMN_NON_MANIFOLD_SPLIT});
    if (!baker) return false;
    const void *blob;
    size_t blob_size;
    const bool good = check_bake(limn_baker_add_file(baker, path), baker) &&
                      check_bake(limn_baker_finish(baker, &blob, &blob_size), baker) &&
                      copy_triangles(scene, blob, blob_size);
    limn_baker_destroy(baker);
    return good;
}

static void copy_polygons(peer_scene *scene, const limni_source *source) {
    const uint32_t corner_count = source->face_offsets[source->face_count];
    snprintf(scene->name, sizeof scene->name, "%s", source->name);
    scene->control_count = source->position_count;
    scene->face_count = source->face_count;
    scene->controls = bench_allocate(source->position_count, sizeof *scene->controls);
    memcpy(scene->controls, source->positions, source->position_count * sizeof *scene->controls);
    scene->face_sizes = bench_allocate(source->face_count, sizeof *scene->face_sizes);
    for (uint32_t f = 0; f < source->face_count; f++) {
        scene->face_sizes[f] = source->face_offsets[f + 1] - source->face_offsets[f];
        scene->divided |= scene->face_sizes[f] != 4;
    }
    scene->face_corners = bench_allocate(corner_count, sizeof *scene->face_corners);
    memcpy(scene->face_corners, source->face_corners, corner_count * sizeof *scene->face_corners);
}

/// As it is in the file: nothing is mended.
static bool read_polygons(peer_scene *scene, const char *path) {
    limni_context context = {0};
    limni_source source = {0};
    bool good = limni_read_file(&context, path, &source) == LIMN_BAKE_OK;
    if (!good) fprintf(stderr, "limn-bench: %s\n", context.error);
    if (good && source.tags.hole_count > 0) {
        fprintf(stderr, "limn-bench: %s has holes, which peers do not\n", path);
        good = false;
    }
    if (good) copy_polygons(scene, &source);
    limni_release_all(&context);
    return good;
}

static bool read_mesh(peer_scene *scene, const char *path) {
    if (scene->scheme == LIMN_SCHEME_LOOP ? !read_triangles(scene, path)
                                          : !read_polygons(scene, path))
        return false;
    topology mesh = scene_topology(scene);
    const bool manifold = mesh.manifold_edges;
    scene->patch_count = scene->divided ? mesh.face_starts[mesh.face_count] : mesh.face_count;
    topology_destroy(&mesh);
    if (!manifold) fprintf(stderr, "limn-bench: %s is not manifold, as peers need it\n", path);
    if (scene->patch_count <= INT32_MAX / (6u << 2 * LIMN_LEVEL_MAX)) return manifold;
    fprintf(stderr, "limn-bench: %s has too many faces for a comparison\n", path);
    return false;
}

/// From the arrays that the peers get too, so that no reading of files is timed.
static bool bake(const peer_scene *scene, const limn_bake_desc *desc, scene_baked *baked) {
    const limn_bake_mesh mesh = {
        .name = scene->name,
        .positions = scene->controls[0],
        .position_count = scene->control_count,
        .face_sizes = scene->face_sizes,
        .face_count = scene->face_count,
        .face_indices = scene->face_corners,
    };
    const double start = bench_seconds();
    baked->baker = limn_baker_create(desc);
    if (!baked->baker) return false;
    const bool good =
        check_bake(limn_baker_add_mesh(baked->baker, &mesh), baked->baker) &&
        check_bake(limn_baker_finish(baked->baker, &baked->blob, &baked->blob_size), baked->baker);
    baked->ms = 1e3 * (bench_seconds() - start);
    return good;
}

static bool bake_both(peer_scene *scene, bool isolated) {
    limn_bake_desc desc = {
        .scheme = scene->scheme,
        .isolate = isolated ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER,
    };
    if (!bake(scene, &desc, &scene->baked)) return false;
    desc.normals = LIMN_NORMALS_EXACT;
    return bake(scene, &desc, &scene->baked_with_normals);
}

// -------------------------------------------------------------------------------------------------
// Vertices

topology scene_topology(const peer_scene *scene) {
    return topology_create(scene->face_sizes, scene->face_corners, scene->face_count,
                           scene->control_count);
}

uint32_t scene_refinement_count(const peer_scene *scene) {
    return scene->level + scene->divided;
}

typedef struct grid_point {
    int i, j;
} grid_point;

typedef grid_point patch_corners[LIMN_CORNER_MAX];

static grid_point middle_of(grid_point a, grid_point b) {
    return (grid_point){(a.i + b.i) / 2, (a.j + b.j) / 2};
}

/// Where the corners of the child faces of one face lie, in the order of topology_refine_…().
static void place_children(uint32_t level, int size, const patch_corners corners,
                           patch_corners **place) {
    if (level == 0) {
        memcpy(*(*place)++, corners, sizeof **place);
        return;
    }
    const grid_point centre = middle_of(corners[0], corners[2]);
    patch_corners middles;
    for (int c = 0; c < size; c++)
        middles[c] = middle_of(corners[c], corners[(c + 1) % size]);
    for (int c = 0; c < size; c++) {
        const grid_point next = middles[c], before = middles[(c + size - 1) % size];
        if (size == 3)
            place_children(level - 1, size, (patch_corners){corners[c], next, before}, place);
        else
            place_children(level - 1, size, (patch_corners){corners[c], next, centre, before},
                           place);
    }
    if (size == 3) place_children(level - 1, size, middles, place);
}

static void fill_refined(peer_scene *scene, const topology *mesh) {
    enum { CHILD_MAX = 1 << 2 * LIMN_LEVEL_MAX };
    static patch_corners places[CHILD_MAX];
    patch_corners *end = places, corners = {{0, 0}};
    const uint32_t size = scene->domain->corner_count, child_count = 1u << 2 * scene->level;
    for (uint32_t c = 0; c < size; c++)
        corners[c] = (grid_point){scene->domain->rows[c].i, scene->domain->rows[c].j};
    place_children(scene->level, (int)size, corners, &end);

    for (uint32_t f = 0; f < mesh->face_count; f++) {
        for (uint32_t c = 0; c < size; c++) {
            const grid_point place = places[f % child_count][c];
            const size_t patch = f / child_count;
            scene->refined[patch * scene->row_count + scene->row_at[place.i][place.j]] =
                mesh->face_vertices[size * f + c];
        }
    }
}

static void number_unique(peer_scene *scene, uint32_t vertex_count) {
    uint32_t *const number = bench_allocate(vertex_count, sizeof *number);
    memset(number, 0xff, vertex_count * sizeof *number);
    scene->unique_rows = bench_allocate(vertex_count, sizeof *scene->unique_rows);
    const uint32_t row_total = scene->patch_count * scene->row_count;
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
    topology mesh = scene_topology(scene);
    for (uint32_t level = 0; level < scene_refinement_count(scene); level++) {
        topology fine = scene->scheme == LIMN_SCHEME_LOOP ? topology_refine_triangles(&mesh)
                                                          : topology_refine_quads(&mesh);
        topology_destroy(&mesh);
        mesh = fine;
    }
    const size_t row_total = (size_t)scene->patch_count * scene->row_count;
    scene->refined = bench_allocate(row_total, sizeof *scene->refined);
    scene->unique = bench_allocate(row_total, sizeof *scene->unique);
    fill_refined(scene, &mesh);
    number_unique(scene, mesh.vertex_count);
    topology_destroy(&mesh);
}

uint32_t scene_row(const peer_scene *scene, uint32_t row, uint32_t rotation) {
    int i = scene->domain->rows[row].i, j = scene->domain->rows[row].j;
    for (; rotation > 0; rotation--) {
        const int before = i;
        i = scene->scheme == LIMN_SCHEME_LOOP ? LIMN_GRID_SIZE - i - j : LIMN_GRID_SIZE - j;
        j = before;
    }
    return scene->row_at[i][j];
}

// -------------------------------------------------------------------------------------------------
// Bones

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

static void choose_rows(peer_scene *scene, limn_scheme scheme, uint32_t level) {
    memset(scene, 0, sizeof *scene);
    scene->scheme = scheme;
    scene->level = level;
    scene->domain =
        limn_domain_get(scheme == LIMN_SCHEME_LOOP ? LIMN_DOMAIN_TRIANGLE : LIMN_DOMAIN_QUAD);
    scene->row_count = scene->domain->row_counts[level];
    for (uint16_t r = 0; r < scene->row_count; r++)
        scene->row_at[scene->domain->rows[r].i][scene->domain->rows[r].j] = r;
}

static void create_bones(peer_scene *scene) {
    scene->bones = bench_allocate(SCENE_BONE_COUNT, sizeof *scene->bones);
    scene_set_bones(scene, false);
}

bool scene_create(peer_scene *scene, const char *path, const scene_desc *desc) {
    choose_rows(scene, desc->scheme, desc->level);
    if (!read_mesh(scene, path) || !bake_both(scene, desc->isolated)) return false;
    find_vertices(scene);
    create_bones(scene);
    if (desc->thread_count > 1) scene->threads = team_create(desc->thread_count);
    return true;
}

bool scene_create_baked(peer_scene *scene, const limn_mesh *mesh, uint32_t level) {
    const bool quads = mesh->domain->kind == LIMN_DOMAIN_QUAD;
    choose_rows(scene, quads ? LIMN_SCHEME_CATMARK : LIMN_SCHEME_LOOP, level);
    if (!copy_faces(scene, mesh)) return false;
    find_vertices(scene);
    create_bones(scene);
    return true;
}

uint32_t scene_vertex(const peer_scene *scene, const limn_mesh *mesh, uint32_t patch,
                      uint32_t row) {
    const limn_patch_face face = limn_mesh_face(mesh, patch);
    const size_t first = (size_t)face.face * scene->row_count;
    return scene->unique[first + scene_row(scene, row, face.rotation)];
}

void scene_destroy(peer_scene *scene) {
    if (scene->threads) team_destroy(scene->threads);
    limn_baker_destroy(scene->baked.baker);
    limn_baker_destroy(scene->baked_with_normals.baker);
    free(scene->controls);
    free(scene->face_sizes);
    free(scene->face_corners);
    free(scene->refined);
    free(scene->unique);
    free(scene->unique_rows);
    free(scene->bones);
}
