/* SPDX-License-Identifier: MIT */
/*
 * Lomont's surface without tags beside the baker's, at all rows of level 4. On boundaries the two
 * have different rules, but for regular vertices, those with four neighbours: faces whose corners
 * have no other boundary vertex among their neighbours must agree.
 */
#include "../check.h"
#include "limn/bake.h"
#include "limn/limn.h"
#include "tagged.h"

#include <stdlib.h>

enum { SEED_COUNT = 12, STEPS = LIMN_GRID_SIZE };

/// The vertices of level 4 of a base face, by i and j.
typedef struct face_grid {
    int vertices[STEPS + 1][STEPS + 1];
} face_grid;

/// A place in a base face.
typedef struct grid_place {
    int i, j;
} grid_place;

static grid_place middle(grid_place a, grid_place b) {
    return (grid_place){(a.i + b.i) / 2, (a.j + b.j) / 2};
}

/// Fills the part of the grid that a face of some level covers, its corners being at a, b and c.
static void fill_grid(const lomont_mesh *finest, int face, int level, grid_place a, grid_place b,
                      grid_place c, face_grid *grid) {
    if (level == LIMN_LEVEL_MAX) {
        grid->vertices[a.i][a.j] = finest->faces[face][0];
        grid->vertices[b.i][b.j] = finest->faces[face][1];
        grid->vertices[c.i][c.j] = finest->faces[face][2];
        return;
    }
    const grid_place ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fill_grid(finest, 4 * face, level + 1, ca, a, ab, grid);
    fill_grid(finest, 4 * face + 1, level + 1, ab, b, bc, grid);
    fill_grid(finest, 4 * face + 2, level + 1, bc, c, ca, grid);
    fill_grid(finest, 4 * face + 3, level + 1, ca, ab, bc, grid);
}

/// Whether Lomont's rules and the baker's are the same for all that a face depends on.
static bool has_same_rules(const lomont_mesh *mesh, int face) {
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        const int *const near = mesh->faces[h / 3];
        bool touches = false;
        for (int k = 0; k < 9; k++)
            touches |= near[k / 3] == mesh->faces[face][k % 3];
        if (touches && lomont_vertex_type(mesh, near[h % 3]) == LOMONT_NON_REGULAR) return false;
    }
    return true;
}

static double largest_same, largest_other;

static double diagonal_of(const limn_mesh *mesh) {
    double square = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double extent = (double)mesh->bounds_max[axis] - (double)mesh->bounds_min[axis];
        square += extent * extent;
    }
    return sqrt(square);
}

/// The largest difference of a patch, as a part of the diagonal.
static double compare_patch(const limn_mesh *mesh, uint32_t patch, const float (*rows)[3],
                            const face_grid *grid, const double (*limits)[3]) {
    const uint32_t rotation = limn_mesh_face(mesh, patch).rotation;
    double largest = 0;
    for (uint32_t r = 0; r < mesh->domain->row_counts[LIMN_LEVEL_MAX]; r++) {
        const int i = mesh->domain->rows[r].i, j = mesh->domain->rows[r].j;
        int of_corner[3]; // of the face
        of_corner[rotation] = STEPS - i - j;
        of_corner[(1 + rotation) % 3] = i;
        of_corner[(2 + rotation) % 3] = j;
        const double *const limit = limits[grid->vertices[of_corner[1]][of_corner[2]]];
        double square = 0;
        for (int axis = 0; axis < 3; axis++) {
            const double difference = (double)rows[r][axis] - limit[axis];
            square += difference * difference;
        }
        largest = fmax(largest, sqrt(square));
    }
    return largest / diagonal_of(mesh);
}

static void compare(const limn_mesh *mesh, const random_mesh *random) {
    lomont_mesh base = lomont_from_random(random), finest = lomont_from_random(random);
    lomont_refine(&finest, LIMN_LEVEL_MAX);
    double(*const limits)[3] = malloc((size_t)finest.vertex_count * sizeof *limits);
    const limn_plan plan = limn_plan_uniform(mesh, LIMN_LEVEL_MAX);
    float(*const rows)[3] = malloc((size_t)plan.vertex_count * sizeof *rows);
    if (!limits || !rows) abort();
    lomont_limits(&finest, limits);
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count, &(limn_output){.vertices = rows});
    for (uint32_t p = 0; p < plan.patch_count; p++) {
        const int face = (int)limn_mesh_face(mesh, p).face;
        face_grid grid;
        fill_grid(&finest, face, 0, (grid_place){0, 0}, (grid_place){STEPS, 0},
                  (grid_place){0, STEPS}, &grid);
        const double difference =
            compare_patch(mesh, p, (const float(*)[3])rows + limn_plan_first_vertex(&plan, p),
                          &grid, (const double(*)[3])limits);
        const bool same = has_same_rules(&base, face);
        double *const largest = same ? &largest_same : &largest_other;
        *largest = fmax(*largest, difference);
        if (same) CHECK(difference < 3e-7);
    }
    free(limits);
    free(rows);
    lomont_destroy(&base);
    lomont_destroy(&finest);
}

static void bake_and_compare(const random_mesh *random) {
    limn_baker *const baker = limn_baker_create(NULL);
    const limn_bake_mesh mesh = {
        .name = "random",
        .positions = random->positions[0],
        .position_count = random->vertex_count,
        .face_count = random->face_count,
        .face_indices = random->faces[0],
    };
    const void *blob;
    size_t size;
    limn_pack pack;
    if (CHECK_EQUAL(limn_baker_add_mesh(baker, &mesh), LIMN_BAKE_OK) &&
        CHECK_EQUAL(limn_baker_finish(baker, &blob, &size), LIMN_BAKE_OK) &&
        CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK)) {
        const limn_mesh baked = limn_pack_mesh(&pack, 0);
        compare(&baked, random);
    } else {
        fprintf(stderr, "    %s\n", limn_baker_error(baker));
    }
    limn_baker_destroy(baker);
}

int main(void) {
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        random_mesh random = random_mesh_make(seed, seed % 2 == 1);
        bake_and_compare(&random);
    }
    random_mesh tube = {.state = 1};
    random_mesh_tube(&tube, 8, 5, true);
    bake_and_compare(&tube);
    printf("largest difference where rules are the same: %.1e of the diagonal, elsewhere %.1e\n",
           largest_same, largest_other);
    CHECK(largest_same > 0 && largest_other > 1e-3);
    return check_report();
}
