/* SPDX-License-Identifier: MIT */
/* The oracle is itself right: it agrees with closed forms and symmetries on meshes made here. */
#include "../check.h"
#include "opensubdiv.h"

#include "limn/limn.h"

#include <math.h>
#include <stdlib.h>

enum { ROW_COUNT = 153, TORUS_SIZE = 6, FINE_SIZE = TORUS_SIZE * LIMN_GRID_SIZE };

typedef double point[3];

static const limn_domain *domain(void) {
    return limn_domain_get(LIMN_DOMAIN_TRIANGLE);
}

static void check_point(const point a, const point b, double tolerance) {
    for (int axis = 0; axis < 3; axis++)
        CHECK_NEAR(a[axis], b[axis], tolerance);
}

/// [face_count][row_count] limit positions, to be freed; NULL after a failed check.
static point *evaluate(const limni_opensubdiv_mesh *mesh) {
    char error[256];
    point *limit = malloc(mesh->face_count * ROW_COUNT * sizeof(point));
    if (limit == NULL) abort();
    if (CHECK(limni_opensubdiv_limit(mesh, limit, NULL, error, sizeof error))) {
        CHECK_TEXT(error, "");
        return limit;
    }
    fprintf(stderr, "    %s\n", error);
    free(limit);
    return NULL;
}

/// Two faces that share an edge have the same bits along it. Returns the number of such edges.
static uint32_t check_shared_edges(const limni_opensubdiv_mesh *mesh, point *limit) {
    uint32_t shared_count = 0;
    for (uint32_t a = 0; a < 3 * mesh->face_count; a++) {
        for (uint32_t b = 0; b < a; b++) {
            const uint32_t *face_a = mesh->faces + a / 3 * 3, *face_b = mesh->faces + b / 3 * 3;
            if (face_a[a % 3] != face_b[(b + 1) % 3] || face_a[(a + 1) % 3] != face_b[b % 3])
                continue;
            shared_count++;
            for (int k = 0; k <= LIMN_GRID_SIZE; k++) {
                const uint32_t row_a = domain()->edge_rows[a % 3][k];
                const uint32_t row_b = domain()->edge_rows[b % 3][LIMN_GRID_SIZE - k];
                CHECK(memcmp(limit[a / 3 * ROW_COUNT + row_a], limit[b / 3 * ROW_COUNT + row_b],
                             sizeof(point)) == 0);
            }
        }
    }
    return shared_count;
}

// -------------------------------------------------------------------------------------------------
// A torus of valence 6 throughout. Its refinement is again such a torus, so that Loop's regular
// masks on a periodic grid of points (x, y) are the reference for all rows.

static const int ring[6][2] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};

static uint32_t torus_index(int size, int x, int y) {
    return (uint32_t)((y + size) % size * size + (x + size) % size);
}

static const double *torus_neighbour(point *grid, int size, int x, int y, int direction) {
    const int *step = ring[(direction + 6) % 6];
    return grid[torus_index(size, x + step[0], y + step[1])];
}

/// out = centre_weight * (x, y) + ring_weight * the sum of its six neighbours
static void weigh_ring(point *grid, int size, int x, int y, double centre_weight,
                       double ring_weight, point out) {
    for (int axis = 0; axis < 3; axis++) {
        double sum = 0.0;
        for (int direction = 0; direction < 6; direction++)
            sum += torus_neighbour(grid, size, x, y, direction)[axis];
        out[axis] = centre_weight * grid[torus_index(size, x, y)][axis] + ring_weight * sum;
    }
}

/// The new vertex of the edge that leaves (x, y) in a direction.
static void split_edge(point *grid, int size, int x, int y, int direction, point out) {
    const double *from = grid[torus_index(size, x, y)];
    const double *to = torus_neighbour(grid, size, x, y, direction);
    const double *right = torus_neighbour(grid, size, x, y, direction - 1);
    const double *left = torus_neighbour(grid, size, x, y, direction + 1);
    for (int axis = 0; axis < 3; axis++)
        out[axis] = 0.375 * (from[axis] + to[axis]) + 0.125 * (right[axis] + left[axis]);
}

static void refine_torus(point *grid, int size, point *fine) {
    for (int y = 0; y < size; y++) {
        for (int x = 0; x < size; x++) {
            weigh_ring(grid, size, x, y, 0.625, 0.0625, fine[torus_index(2 * size, 2 * x, 2 * y)]);
            for (int direction = 0; direction < 3; direction++) // each edge once
                split_edge(grid, size, x, y, direction,
                           fine[torus_index(2 * size, 2 * x + ring[direction][0],
                                            2 * y + ring[direction][1])]);
        }
    }
}

/// Limit positions of the grid refined to FINE_SIZE.
static void refer_torus(const float *positions, point *limit) {
    static point coarse[FINE_SIZE * FINE_SIZE], fine[FINE_SIZE * FINE_SIZE];
    for (int k = 0; k < TORUS_SIZE * TORUS_SIZE; k++) {
        for (int axis = 0; axis < 3; axis++)
            coarse[k][axis] = positions[3 * k + axis];
    }
    for (int size = TORUS_SIZE; size < FINE_SIZE; size *= 2) {
        refine_torus(coarse, size, fine);
        memcpy(coarse, fine, sizeof coarse);
    }
    for (int k = 0; k < FINE_SIZE * FINE_SIZE; k++)
        weigh_ring(coarse, FINE_SIZE, k % FINE_SIZE, k / FINE_SIZE, 0.5, 1.0 / 12.0, limit[k]);
}

enum { TORUS_FACES = 2 * TORUS_SIZE * TORUS_SIZE };

static float torus_positions[TORUS_SIZE * TORUS_SIZE * 3];
static uint32_t torus_faces[TORUS_FACES * 3];
static const limni_opensubdiv_mesh torus = {.positions = torus_positions,
                                            .faces = torus_faces,
                                            .position_count = TORUS_SIZE * TORUS_SIZE,
                                            .face_count = TORUS_FACES,
                                            .level = LIMN_LEVEL_MAX};

/// Square (x, y) gives face 2k with its right angle at (x, y) and face 2k + 1 at (x + 1, y + 1).
static void make_torus(void) {
    for (int k = 0; k < TORUS_SIZE * TORUS_SIZE; k++) {
        const int x = k % TORUS_SIZE, y = k / TORUS_SIZE, n = TORUS_SIZE;
        const double u = x * 6.283 / n, v = y * 6.283 / n, radius = 3.0 + cos(v);
        torus_positions[3 * k] = (float)(radius * cos(u));
        torus_positions[3 * k + 1] = (float)(radius * sin(u));
        torus_positions[3 * k + 2] = (float)sin(v + 0.1 * x); // no symmetry to hide behind
        const uint32_t faces[6] = {torus_index(n, x, y),     torus_index(n, x + 1, y),
                                   torus_index(n, x, y + 1), torus_index(n, x + 1, y + 1),
                                   torus_index(n, x, y + 1), torus_index(n, x + 1, y)};
        memcpy(torus_faces + 6 * k, faces, sizeof faces);
    }
}

/// The reference position of a row of a face.
static const double *torus_row(point *reference, uint32_t face, uint32_t row) {
    const int k = (int)face / 2, upper = (int)face % 2;
    const int i = domain()->rows[row].i, j = domain()->rows[row].j;
    const int x = (k % TORUS_SIZE + upper) * LIMN_GRID_SIZE + (upper ? -i : i);
    const int y = (k / TORUS_SIZE + upper) * LIMN_GRID_SIZE + (upper ? -j : j);
    return reference[torus_index(FINE_SIZE, x, y)];
}

static void test_torus(void) {
    static point reference[FINE_SIZE * FINE_SIZE];
    refer_torus(torus_positions, reference);
    point *limit = evaluate(&torus);
    if (limit == NULL) return;
    for (uint32_t k = 0; k < TORUS_FACES * ROW_COUNT; k++)
        check_point(limit[k], torus_row(reference, k / ROW_COUNT, k % ROW_COUNT), 1e-12);
    for (uint32_t k = 0; k < 3 * TORUS_FACES; k++) { // the same without any refinement
        static point coarse[TORUS_SIZE * TORUS_SIZE];
        for (int p = 0; p < TORUS_SIZE * TORUS_SIZE * 3; p++)
            coarse[p / 3][p % 3] = torus_positions[p];
        const int vertex = (int)torus_faces[k];
        point corner;
        weigh_ring(coarse, TORUS_SIZE, vertex % TORUS_SIZE, vertex / TORUS_SIZE, 0.5, 1.0 / 12.0,
                   corner);
        check_point(limit[k / 3 * ROW_COUNT + k % 3], corner, 1e-12);
    }
    CHECK_EQUAL(check_shared_edges(&torus, limit), TORUS_FACES * 3 / 2);
    free(limit);
}

/// The rows of a coarser level are the first rows of a finer one.
static void test_levels(void) {
    point *limit = evaluate(&torus);
    if (limit == NULL) return;
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX; level++) {
        limni_opensubdiv_mesh mesh = torus;
        mesh.level = level;
        const uint32_t row_count = domain()->row_counts[level];
        point *coarse = evaluate(&mesh);
        for (uint32_t k = 0; coarse != NULL && k < TORUS_FACES * row_count; k++)
            check_point(coarse[k], limit[k / row_count * ROW_COUNT + k % row_count], 1e-12);
        free(coarse);
    }
    free(limit);
}

// -------------------------------------------------------------------------------------------------
// Small meshes with extraordinary vertices

static const float octahedron_positions[] = {1, 0,  0, -1, 0, 0, 0, 1, 0,
                                             0, -1, 0, 0,  0, 1, 0, 0, -1};
/// The x, y and z vertex of each octant; in the mirrored octants y comes before x.
static const uint32_t octahedron_faces[] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                            2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
static const limni_opensubdiv_mesh octahedron = {.positions = octahedron_positions,
                                                 .faces = octahedron_faces,
                                                 .position_count = 6,
                                                 .face_count = 8,
                                                 .level = LIMN_LEVEL_MAX};

/// The row with given coordinates.
static uint32_t find_row(int i, int j) {
    uint32_t row = 0;
    while (domain()->rows[row].i != i || domain()->rows[row].j != j)
        row++;
    return row;
}

static void test_octahedron(void) {
    point *limit = evaluate(&octahedron);
    if (limit == NULL) return;
    // Valence 4: b = 31/64, so that the limit's centre weight is 24/55; the neighbours cancel out.
    check_point(limit[0], (point){24.0 / 55.0, 0, 0}, 1e-15);
    check_point(limit[1], (point){0, 24.0 / 55.0, 0}, 1e-15);
    check_point(limit[2], (point){0, 0, 24.0 / 55.0}, 1e-15);
    for (uint32_t k = 0; k < 8 * ROW_COUNT; k++) {
        const limn_row row = domain()->rows[k % ROW_COUNT];
        const bool mirrored = octahedron_faces[k / ROW_COUNT * 3] / 2 == 1;
        const int i = mirrored ? LIMN_GRID_SIZE - row.i - row.j : row.i;
        for (int axis = 0; axis < 3; axis++)
            CHECK_NEAR(fabs(limit[k][axis]), limit[find_row(i, row.j)][axis], 1e-14);
    }
    CHECK_EQUAL(check_shared_edges(&octahedron, limit), 12);
    free(limit);
}

/// Two faces back to back: around valence 2, refined edges no longer differ in their end points.
static void test_pillow(void) {
    const float positions[] = {0, 0, 0, 4, 0, 0, 0, 4, 0};
    const uint32_t faces[] = {0, 1, 2, 0, 2, 1};
    point *limit = evaluate(&(limni_opensubdiv_mesh){.positions = positions,
                                                     .faces = faces,
                                                     .position_count = 3,
                                                     .face_count = 2,
                                                     .level = LIMN_LEVEL_MAX});
    if (limit == NULL) return;
    for (uint32_t k = 0; k < ROW_COUNT; k++) { // the second face has corners 1 and 2 swapped
        const limn_row row = domain()->rows[k];
        check_point(limit[k], limit[ROW_COUNT + find_row(row.j, row.i)], 1e-15);
        CHECK_NEAR(limit[k][2], 0, 0);
    }
    free(limit);
}

static void test_boundary(void) {
    const float positions[] = {9, 9, 9, 0, 0, 0, 6, 0, 0, 0, 6, 3}; // the first is not used
    const uint32_t faces[] = {1, 2, 3};
    limni_opensubdiv_mesh mesh = {.positions = positions,
                                  .faces = faces,
                                  .position_count = 4,
                                  .face_count = 1,
                                  .boundary = LIMN_BOUNDARY_EDGE_AND_CORNER,
                                  .level = LIMN_LEVEL_MAX};
    point *limit = evaluate(&mesh);
    if (limit == NULL) return;
    for (uint32_t k = 0; k <= LIMN_GRID_SIZE;
         k++) { // sharp corners: the edge is a B-spline between
        point *at = &limit[domain()->edge_rows[0][k]];
        CHECK_NEAR((*at)[1], 0, 1e-14);
        CHECK_NEAR((*at)[2], 0, 1e-14);
    }
    check_point(limit[0], (point){0, 0, 0}, 1e-14);
    check_point(limit[1], (point){6, 0, 0}, 1e-14);
    check_point(limit[2], (point){0, 6, 3}, 1e-14);
    free(limit);

    mesh.boundary = LIMN_BOUNDARY_EDGE_ONLY; // 2/3 of the corner and 1/6 of each of the others
    limit = evaluate(&mesh);
    if (limit == NULL) return;
    check_point(limit[0], (point){1, 1, 0.5}, 1e-14);
    check_point(limit[1], (point){4, 1, 0.5}, 1e-14);
    check_point(limit[2], (point){1, 4, 2}, 1e-14);
    free(limit);
}

// -------------------------------------------------------------------------------------------------
// Refusals and stencils

static void check_refused(const uint32_t *faces, uint32_t face_count, const char *part) {
    static const float positions[8 * 3];
    static point limit[4 * ROW_COUNT];
    const limni_opensubdiv_mesh mesh = {.positions = positions,
                                        .faces = faces,
                                        .position_count = 8,
                                        .face_count = face_count,
                                        .level = LIMN_LEVEL_MAX};
    limni_opensubdiv_stencils stencils;
    char error[256] = "";
    CHECK(!limni_opensubdiv_limit(&mesh, limit, NULL, error, sizeof error));
    CHECK_CONTAINS(error, part);
    CHECK(!limni_opensubdiv_stencil_bytes(&mesh, true, &stencils, error, sizeof error));
    CHECK_CONTAINS(error, part);
    CHECK(!limni_opensubdiv_limit(&mesh, limit, NULL, error, 4)); // the text is cut, not overrun
    CHECK_EQUAL(strlen(error), 3);
}

static void test_refusals(void) {
    check_refused(NULL, 0, "faces");
    check_refused((const uint32_t[]){0, 1, 8}, 1, "face 0 has an index out of range");
    check_refused((const uint32_t[]){0, 1, 2, 1, 3, 1}, 2, "face 1 uses a vertex twice");
}

static void test_stencils(void) {
    limni_opensubdiv_stencils shared, separate;
    char error[256];
    CHECK(limni_opensubdiv_stencil_bytes(&octahedron, true, &shared, error, sizeof error));
    CHECK(limni_opensubdiv_stencil_bytes(&octahedron, false, &separate, error, sizeof error));
    CHECK_EQUAL(shared.stencil_count, 6 + 12 * 15 + 8 * 105);
    CHECK_EQUAL(separate.stencil_count, 8 * ROW_COUNT);
    CHECK(shared.weight_count < separate.weight_count);
    // At least an index and a weight for each, and a size for each stencil.
    CHECK(separate.byte_count >= 8 * separate.weight_count + 4 * separate.stencil_count);
    CHECK(separate.byte_count <= 8 * separate.weight_count + 8 * separate.stencil_count);
}

int main(void) {
    make_torus();
    test_torus();
    test_levels();
    test_octahedron();
    test_pillow();
    test_boundary();
    test_refusals();
    test_stencils();
    return check_report();
}
