/* SPDX-License-Identifier: MIT */
/*
 * Baked rows beside Lomont's surface, level by level on explicit meshes: random meshes with and
 * without tags. The rows of level n lie where the limit masks put the vertices of the explicit mesh
 * of level n, and have their normals.
 */
#include "../check.h"
#include "limn/bake.h"
#include "limn/limn.h"
#include "tagged.h"

#include <stdlib.h>

enum { SEED_COUNT = 16, TUBE_COUNT = 6, STEPS = LIMN_GRID_SIZE };

static void *allocate(size_t count, size_t size) {
    void *const memory = malloc(count * size);
    if (!memory) abort();
    return memory;
}

// ---- The explicit mesh

/// The vertices of a base face at some level, by i and j, and for each a corner of a face there.
typedef struct face_grid {
    int vertices[STEPS + 1][STEPS + 1];
    int corners[STEPS + 1][STEPS + 1]; ///< 3 f + k
} face_grid;

/// A place in a base face.
typedef struct grid_place {
    int i, j;
} grid_place;

static grid_place middle(grid_place a, grid_place b) {
    return (grid_place){(a.i + b.i) / 2, (a.j + b.j) / 2};
}

/// Fills the part of the grid that a face covers, its corners being at `places`; the mesh is
/// `levels` finer than the face.
static void fill_grid(const lomont_mesh *mesh, int face, int levels, const grid_place places[3],
                      face_grid *grid) {
    if (levels == 0) {
        for (int k = 0; k < 3; k++) {
            grid->vertices[places[k].i][places[k].j] = mesh->faces[face][k];
            grid->corners[places[k].i][places[k].j] = 3 * face + k;
        }
        return;
    }
    const grid_place a = places[0], b = places[1], c = places[2];
    const grid_place ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    const grid_place parts[4][3] = {{ca, a, ab}, {ab, b, bc}, {bc, c, ca}, {ca, ab, bc}};
    for (int part = 0; part < 4; part++)
        fill_grid(mesh, 4 * face + part, levels - 1, parts[part], grid);
}

/// What the explicit mesh says of all its vertices.
typedef struct surface {
    lomont_mesh mesh;
    int level;
    double (*limits)[3];  ///< by vertex
    double (*normals)[3]; ///< by corner, or NULL
} surface;

/// Limits hold on settled meshes; vertices keep their numbers on the way there.
static surface make_surface(const random_mesh *random, int level, bool with_normals) {
    surface made = {.mesh = lomont_from_random(random), .level = level};
    lomont_refine(&made.mesh, level);
    const bool settled = lomont_is_settled(&made.mesh);
    lomont_mesh finer = settled ? made.mesh : lomont_subdivide(&made.mesh);
    while (!lomont_is_settled(&finer))
        lomont_refine(&finer, 1);
    made.limits = allocate((size_t)finer.vertex_count, sizeof *made.limits);
    lomont_limits(&finer, made.limits);
    if (with_normals && settled) {
        made.normals = allocate(3 * (size_t)finer.face_count, sizeof *made.normals);
        lomont_normals(&finer, made.normals);
    }
    if (!settled) lomont_destroy(&finer);
    return made;
}

static void free_surface(surface *s) {
    free(s->limits);
    free(s->normals);
    lomont_destroy(&s->mesh);
}

/// The edges that are sharp for ever at each vertex, and whether these make no side of a corner:
/// there faces approach no plane, and have no normal.
static bool *find_corners_without_sides(const random_mesh *random) {
    lomont_mesh mesh = lomont_from_random(random);
    int *const sharp_counts = allocate((size_t)mesh.vertex_count, sizeof *sharp_counts);
    bool *const without = allocate((size_t)mesh.vertex_count, sizeof *without);
    for (int v = 0; v < mesh.vertex_count; v++)
        sharp_counts[v] = 0;
    for (int h = 0; h < 3 * mesh.face_count; h++) {
        if (!isinf(mesh.half_edges[h].weight) || mesh.half_edges[h].pair > h) continue;
        sharp_counts[mesh.faces[h / 3][h % 3]]++;
        sharp_counts[mesh.faces[h / 3][(h + 1) % 3]]++;
    }
    for (int v = 0; v < mesh.vertex_count; v++)
        without[v] = sharp_counts[v] < 2 && isinf(mesh.vertices[v].weight);
    free(sharp_counts);
    lomont_destroy(&mesh);
    return without;
}

// ---- Both

static double largest_difference, mean_difference, largest_angle, mean_angle;
static uint64_t row_count, normal_count, left_out;

static double diagonal_of(const limn_mesh *mesh) {
    double square = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double extent = (double)mesh->bounds_max[axis] - (double)mesh->bounds_min[axis];
        square += extent * extent;
    }
    return sqrt(square);
}

static double distance(const float *a, const double *b) {
    double square = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double difference = (double)a[axis] - b[axis];
        square += difference * difference;
    }
    return sqrt(square);
}

/// A baked mesh at level 4.
typedef struct rows {
    limn_mesh mesh;
    limn_plan plan;
    float (*positions)[3], (*normals)[3];
} rows;

static void evaluate(const limn_pack *pack, rows *r) {
    r->mesh = limn_pack_mesh(pack, 0);
    r->plan = limn_plan_uniform(&r->mesh, LIMN_LEVEL_MAX);
    r->positions = allocate((size_t)r->plan.vertex_count, sizeof *r->positions);
    r->normals = allocate((size_t)r->plan.vertex_count, sizeof *r->normals);
    float(*const control_normals)[3] = allocate(r->mesh.normal_count, sizeof *control_normals);
    limn_mesh_control_normals(&r->mesh, r->mesh.controls, control_normals[0]);
    limn_evaluate(&r->plan, r->mesh.controls, 0, r->plan.patch_count,
                  &(limn_output){.vertices = r->positions,
                                 .normals = r->normals,
                                 .control_normals = control_normals[0]});
    free(control_normals);
}

static void free_rows(const rows *r) {
    free(r->positions);
    free(r->normals);
}

static void compare_normals(const float *normal, const double *expected) {
    const double angle = distance(normal, expected);
    CHECK(angle < 1e-4);
    largest_angle = fmax(largest_angle, angle);
    mean_angle += angle;
    normal_count++;
}

/// The rows of a patch that a level has.
static void compare_patch(const rows *baked, uint32_t patch, const surface *s,
                          const bool *without_normal) {
    const limn_mesh *const mesh = &baked->mesh;
    const uint64_t first = limn_plan_first_vertex(&baked->plan, patch);
    const limn_patch_face face = limn_mesh_face(mesh, patch);
    const double diagonal = diagonal_of(mesh);
    face_grid grid;
    fill_grid(&s->mesh, (int)face.face, s->level,
              (const grid_place[3]){{0, 0}, {STEPS, 0}, {0, STEPS}}, &grid);
    for (uint32_t r = 0; r < mesh->domain->row_counts[s->level]; r++) {
        const int i = mesh->domain->rows[r].i, j = mesh->domain->rows[r].j;
        int of_corner[3]; // of the face
        of_corner[face.rotation] = STEPS - i - j;
        of_corner[(1 + face.rotation) % 3] = i;
        of_corner[(2 + face.rotation) % 3] = j;
        const int vertex = grid.vertices[of_corner[1]][of_corner[2]];
        const double difference =
            distance(baked->positions[first + r], s->limits[vertex]) / diagonal;
        CHECK(difference < 3e-7);
        largest_difference = fmax(largest_difference, difference);
        mean_difference += difference;
        row_count++;
        if (!s->normals) continue;
        if (r < 3 && without_normal[vertex])
            left_out++;
        else
            compare_normals(baked->normals[first + r],
                            s->normals[grid.corners[of_corner[1]][of_corner[2]]]);
    }
}

static void compare(const limn_pack *pack, const random_mesh *random) {
    rows baked;
    evaluate(pack, &baked);
    bool *const without_normal = find_corners_without_sides(random);
    for (int level = 0; level <= LIMN_LEVEL_MAX; level++) {
        surface s = make_surface(random, level, level == LIMN_LEVEL_MAX);
        for (uint32_t p = 0; p < baked.plan.patch_count; p++)
            compare_patch(&baked, p, &s, without_normal);
        free_surface(&s);
    }
    free(without_normal);
    free_rows(&baked);
}

// ---- Meshes

static limn_bake_status add_mesh(limn_baker *baker, const random_mesh *random) {
    uint32_t edges[RANDOM_MESH_CREASE_MAX][2], vertices[RANDOM_MESH_VERTEX_MAX];
    float sharpness[RANDOM_MESH_CREASE_MAX];
    for (uint32_t c = 0; c < random->crease_count; c++) {
        memcpy(edges[c], random->creases[c].ends, sizeof edges[c]);
        sharpness[c] = random->creases[c].weight;
    }
    for (uint32_t v = 0; v < random->vertex_count; v++)
        vertices[v] = v;
    return limn_baker_add_mesh(baker, &(limn_bake_mesh){
                                          .name = "random",
                                          .positions = random->positions[0],
                                          .position_count = random->vertex_count,
                                          .face_count = random->face_count,
                                          .face_indices = random->faces[0],
                                          .crease_edges = edges[0],
                                          .crease_sharpness = sharpness,
                                          .crease_count = random->crease_count,
                                          .sharp_vertices = vertices,
                                          .vertex_sharpness = random->vertex_weights,
                                          .sharp_vertex_count = random->vertex_count,
                                      });
}

static void bake_and_compare(const random_mesh *random, limn_isolate isolate) {
    limn_baker *const baker = limn_baker_create(&(limn_bake_desc){
        .creases = LIMN_CREASES_LOMONT, .normals = LIMN_NORMALS_EXACT, .isolate = isolate});
    const void *blob;
    size_t size;
    limn_pack pack;
    if (CHECK_EQUAL(add_mesh(baker, random), LIMN_BAKE_OK) &&
        CHECK_EQUAL(limn_baker_finish(baker, &blob, &size), LIMN_BAKE_OK) &&
        CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK))
        compare(&pack, random);
    else
        fprintf(stderr, "    %s\n", limn_baker_error(baker));
    limn_baker_destroy(baker);
}

/// Of every four seeds one without tags, one with such that last, two with all kinds; every other
/// four in pieces.
static void test_random_meshes(void) {
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        random_mesh random = random_mesh_make(seed, seed / 2 % 2 == 1);
        if (seed % 4 > 0) random_mesh_tag(&random, seed % 4 > 1);
        bake_and_compare(&random, seed % 8 < 4 ? LIMN_ISOLATE_NEVER : LIMN_ISOLATE_ALWAYS);
    }
}

/// Faces that differ by nothing but their tags, and what lies beyond them, have different classes.
static void test_tubes(void) {
    for (uint64_t seed = 0; seed < TUBE_COUNT; seed++) {
        random_mesh tube = {.state = seed};
        random_mesh_tube(&tube, 8, 5, seed % 2 == 0);
        if (seed > 1) random_mesh_tag(&tube, seed != 2);
        for (uint32_t v = 16; v < 24 && seed == 0; v++) // a ring
            tube.vertex_weights[v] = v % 2 == 0 ? (float)v / 32 : 0;
        bake_and_compare(&tube, LIMN_ISOLATE_NEVER);
        bake_and_compare(&tube, LIMN_ISOLATE_ALWAYS);
    }
}

/// Rows are limits also where sharpness is above the level count.
static void test_high_weights(void) {
    random_mesh random = {.state = 3};
    random_mesh_octahedron(&random);
    random_mesh_split(&random);
    random_mesh_crease(&random, 0, 2, 5.5f);
    random_mesh_crease(&random, 0, 3, 4.25f);
    random_mesh_crease(&random, 2, 4, 6);
    random.vertex_weights[1] = 5.25f;
    bake_and_compare(&random, LIMN_ISOLATE_NEVER);
    bake_and_compare(&random, LIMN_ISOLATE_ALWAYS);
}

int main(void) {
    test_random_meshes();
    test_high_weights();
    test_tubes();
    printf("%llu rows: difference %.1e of the diagonal, mean %.1e; %llu normals: angle %.1e, mean "
           "%.1e, %llu left out\n",
           (unsigned long long)row_count, largest_difference, mean_difference / (double)row_count,
           (unsigned long long)normal_count, largest_angle, mean_angle / (double)normal_count,
           (unsigned long long)left_out);
    CHECK(normal_count > 100000 && left_out < normal_count / 1000);
    return check_report();
}
