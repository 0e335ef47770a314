/* SPDX-License-Identifier: MIT */
/*
 * Baked rows beside the modified butterfly, level by level on explicit meshes: random meshes, with
 * tables and in pieces of a mesh that was divided. Rows lie where the vertices of the explicit mesh
 * do, control points on the surface bit for bit, and normals are those of its limit, and of finite
 * differences.
 */
#include "../check.h"
#include "../random_mesh.h"
#include "butterfly.h"
#include "limn/bake.h"
#include "limn/limn.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SEED_COUNT = 8, STEPS = LIMN_GRID_SIZE };

/// Normals are off finite differences by less than this share of the spread of the triangles, but
/// for a few where the surface has folds; and by so many radians in the mean.
#define SHARE_MAX 0.7
#define NEAR_MIN 0.985
#define SLOPE_MEAN_MAX 0.01

static void *allocate(size_t count, size_t size) {
    void *const memory = malloc(count * size + 1);
    if (!memory) abort();
    return memory;
}

// ---- The explicit mesh

/// A place in a face of the base mesh, and the vertices there.
typedef struct grid_place {
    int i, j;
} grid_place;

typedef int face_grid[STEPS + 1][STEPS + 1];

static grid_place middle(grid_place a, grid_place b) {
    return (grid_place){(a.i + b.i) / 2, (a.j + b.j) / 2};
}

/// Fills the part of the grid that a face covers; the mesh is `levels` finer than the face.
static void fill_grid(const butterfly_mesh *mesh, int face, int levels, const grid_place places[3],
                      face_grid grid) {
    if (levels == 0) {
        for (int k = 0; k < 3; k++)
            grid[places[k].i][places[k].j] = mesh->faces[face][k];
        return;
    }
    const grid_place a = places[0], b = places[1], c = places[2];
    const grid_place ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    const grid_place parts[4][3] = {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}};
    for (int part = 0; part < 4; part++)
        fill_grid(mesh, 4 * face + part, levels - 1, parts[part], grid);
}

static butterfly_mesh subdivide(butterfly_mesh mesh, int levels) {
    for (; levels > 0; levels--) {
        const butterfly_mesh finer = butterfly_subdivide(&mesh);
        butterfly_destroy(&mesh);
        mesh = finer;
    }
    return mesh;
}

// ---- Both

static double largest_difference, largest_angle, slope_sum;
static uint64_t row_count, normal_count, slope_count, near_count;

static double distance(const float *a, const double *b) {
    double square = 0;
    for (int axis = 0; axis < 3; axis++)
        square += ((double)a[axis] - b[axis]) * ((double)a[axis] - b[axis]);
    return sqrt(square);
}

static double diagonal_of(const limn_mesh *mesh) {
    const double high[3] = {mesh->bounds_max[0], mesh->bounds_max[1], mesh->bounds_max[2]};
    return distance(mesh->bounds_min, high);
}

/// A unit normal of the triangles around a vertex, and how far theirs are from it.
typedef struct facet_mean {
    double normal[3], spread;
} facet_mean;

/// A baked mesh at level 4, and the explicit mesh of that level.
typedef struct subject {
    limn_mesh mesh;
    limn_plan plan;
    float (*positions)[3], (*normals)[3];
    bool divided;
    butterfly_mesh finest;
    double (*expected_normals)[3];
    facet_mean *differences; ///< [finest.vertex_count]; NULL: not wanted
    const random_mesh *random;
} subject;

static void evaluate(subject *s) {
    s->plan = limn_plan_uniform(&s->mesh, LIMN_LEVEL_MAX);
    s->positions = allocate((size_t)s->plan.vertex_count, sizeof *s->positions);
    s->normals = allocate((size_t)s->plan.vertex_count, sizeof *s->normals);
    float(*const base_normals)[3] = allocate(s->mesh.normal_count, sizeof *base_normals);
    limn_mesh_control_normals(&s->mesh, s->mesh.controls, base_normals[0]);
    limn_evaluate(&s->plan, s->mesh.controls, 0, s->plan.patch_count,
                  &(limn_output){.vertices = s->positions,
                                 .normals = s->normals,
                                 .control_normals = base_normals[0]});
    free(base_normals);
}

static double normalise(double *v) {
    const double length = hypot(hypot(v[0], v[1]), v[2]);
    for (int x = 0; x < 3; x++)
        v[x] /= length;
    return length;
}

/// The normal of corner k of a face, as long as twice its area.
static void cross_at(const butterfly_mesh *mesh, int face, int k, double *product) {
    const int *const corners = mesh->faces[face];
    const double *const at = mesh->positions[corners[k]];
    const double *const to = mesh->positions[corners[(k + 1) % 3]];
    const double *const on = mesh->positions[corners[(k + 2) % 3]];
    for (int x = 0; x < 3; x++) {
        const int y = (x + 1) % 3, z = (x + 2) % 3;
        product[x] = (to[y] - at[y]) * (on[z] - at[z]) - (to[z] - at[z]) * (on[y] - at[y]);
    }
}

/// Finite differences: the mean of the triangles around each vertex, two levels down.
static facet_mean *differentiate(const butterfly_mesh *mesh) {
    butterfly_mesh finer = butterfly_subdivide(mesh);
    finer = subdivide(finer, 1);
    facet_mean *const made = allocate((size_t)mesh->vertex_count, sizeof *made);
    memset(made, 0, (size_t)mesh->vertex_count * sizeof *made);
    for (int pass = 0; pass < 2; pass++) {
        for (int h = 0; h < 3 * finer.face_count; h++) {
            const int vertex = finer.faces[h / 3][h % 3];
            double product[3], square = 0;
            if (vertex >= mesh->vertex_count) continue;
            cross_at(&finer, h / 3, h % 3, product);
            if (pass == 1) normalise(product);
            for (int x = 0; x < 3; x++) {
                if (pass == 0) made[vertex].normal[x] += product[x];
                square += pow(product[x] - made[vertex].normal[x], 2);
            }
            made[vertex].spread = pass == 1 ? fmax(made[vertex].spread, sqrt(square)) : 0;
        }
        for (int v = 0; v < mesh->vertex_count && pass == 0; v++)
            normalise(made[v].normal);
    }
    butterfly_destroy(&finer);
    return made;
}

/// Boundary vertices with one face have no tangent plane.
static bool has_normal(const subject *s, int vertex) {
    return butterfly_valence(&s->finest, vertex) > 2;
}

static void compare_row(const subject *s, size_t at, int vertex, double diagonal) {
    const double difference = distance(s->positions[at], s->finest.positions[vertex]) / diagonal;
    CHECK(difference < 1e-6);
    largest_difference = fmax(largest_difference, difference);
    row_count++;
    if (vertex < (int)s->mesh.control_count)
        CHECK(memcmp(s->positions[at], s->random->positions[vertex], sizeof *s->positions) == 0);
    if (!has_normal(s, vertex)) return;
    const double angle = distance(s->normals[at], s->expected_normals[vertex]);
    CHECK(angle < 1e-3);
    largest_angle = fmax(largest_angle, angle);
    normal_count++;
    if (!s->differences || butterfly_is_on_boundary(&s->finest, vertex)) return;
    const double slope = distance(s->normals[at], s->differences[vertex].normal);
    near_count += slope < SHARE_MAX * s->differences[vertex].spread;
    slope_sum += slope;
    slope_count++;
}

static void compare_patch(const subject *s, uint32_t patch, double diagonal) {
    const limn_patch_face face = limn_mesh_face(&s->mesh, patch);
    const size_t first = (size_t)limn_plan_first_vertex(&s->plan, patch);
    face_grid grid;
    fill_grid(&s->finest, (int)face.face, LIMN_LEVEL_MAX,
              (const grid_place[3]){{0, 0}, {STEPS, 0}, {0, STEPS}}, grid);
    for (uint32_t r = 0; r < s->mesh.domain->row_counts[LIMN_LEVEL_MAX]; r++) {
        const int i = s->mesh.domain->rows[r].i, j = s->mesh.domain->rows[r].j;
        const int own[3] = {STEPS - i - j, i, j}; // of the patch's corners
        int of_corner[3];
        for (uint32_t c = 0; c < 3; c++) {
            const uint32_t baked = (c + face.rotation) % 3;
            const uint32_t turn = s->divided && face.face % 4 < 3 ? face.face % 4 : 0;
            of_corner[(baked + turn) % 3] = own[c];
        }
        compare_row(s, first + r, grid[of_corner[1]][of_corner[2]], diagonal);
    }
}

static void compare(const limn_pack *pack, const random_mesh *random, float tension) {
    subject s = {.mesh = limn_pack_mesh(pack, 0), .random = random};
    s.divided = s.mesh.base_first > 0;
    evaluate(&s);
    s.finest = butterfly_create((const float(*)[3])random->positions, random->vertex_count,
                                (const uint32_t(*)[3])random->faces, random->face_count);
    s.finest.stencil = BUTTERFLY_TEN;
    s.finest.tension = (double)tension;
    s.finest = subdivide(s.finest, LIMN_LEVEL_MAX + s.divided);
    s.expected_normals = allocate((size_t)s.finest.vertex_count, sizeof *s.expected_normals);
    butterfly_normals(&s.finest, s.expected_normals);
    if (!s.divided) s.differences = differentiate(&s.finest);
    for (uint32_t p = 0; p < s.plan.patch_count; p++)
        compare_patch(&s, p, diagonal_of(&s.mesh));
    free(s.expected_normals);
    free(s.differences);
    free(s.positions);
    free(s.normals);
    butterfly_destroy(&s.finest);
}

static void bake_and_compare(const random_mesh *random, float tension, limn_isolate isolate) {
    limn_baker *const baker = limn_baker_create(&(limn_bake_desc){.scheme = LIMN_SCHEME_BUTTERFLY,
                                                                  .tension = tension,
                                                                  .normals = LIMN_NORMALS_EXACT,
                                                                  .isolate = isolate});
    const limn_bake_mesh mesh = {.name = "random",
                                 .positions = random->positions[0],
                                 .position_count = random->vertex_count,
                                 .face_count = random->face_count,
                                 .face_indices = random->faces[0]};
    const void *blob;
    size_t size;
    limn_pack pack;
    if (CHECK_EQUAL(limn_baker_add_mesh(baker, &mesh), LIMN_BAKE_OK) &&
        CHECK_EQUAL(limn_baker_finish(baker, &blob, &size), LIMN_BAKE_OK) &&
        CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK))
        compare(&pack, random, tension);
    else
        fprintf(stderr, "    %s\n", limn_baker_error(baker));
    limn_baker_destroy(baker);
}

int main(void) {
    static const float tensions[] = {0, 1 / 32.0f, -1 / 20.0f};
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        random_mesh random = random_mesh_make(seed, seed % 2 == 1);
        // Some lie beside the origin, far from it or near.
        for (uint32_t v = 0; v < random.vertex_count && seed % 4 > 1; v++)
            random.positions[v][seed % 3] += seed % 4 == 2 ? 3.1f : 9.7f;
        bake_and_compare(&random, tensions[seed % 3], LIMN_ISOLATE_NEVER);
        if (seed % 4 == 3) bake_and_compare(&random, tensions[seed / 4], LIMN_ISOLATE_ALWAYS);
    }
    printf("%llu rows: difference %.1e of the diagonal; %llu normals: angle %.1e\n",
           (unsigned long long)row_count, largest_difference, (unsigned long long)normal_count,
           largest_angle);
    const double near_share = (double)near_count / (double)slope_count;
    const double slope_mean = slope_sum / (double)slope_count;
    printf("%llu normals inside: %.4f near differences, %.1e off them in the mean\n",
           (unsigned long long)slope_count, near_share, slope_mean);
    CHECK(normal_count > 50000 && slope_count > 50000);
    CHECK(near_share > NEAR_MIN);
    CHECK(slope_mean < SLOPE_MEAN_MAX);
    return check_report();
}
