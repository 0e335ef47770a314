/* SPDX-License-Identifier: MIT */
/*
 * The oracle for Catmull-Clark and bilinear faces is itself right: it agrees with closed forms and
 * with the scheme written out here.
 */
#include "../check.h"
#include "surface.h"

// -------------------------------------------------------------------------------------------------
// A torus of valence 4: bicubic B-splines

enum { TORUS_SIZE = 6, TORUS_FACES = TORUS_SIZE * TORUS_SIZE };

static float torus_positions[TORUS_FACES][3];
static uint32_t torus_faces[4 * TORUS_FACES], torus_sizes[TORUS_FACES];
static const limni_opensubdiv_mesh torus = {.positions = torus_positions[0],
                                            .faces = torus_faces,
                                            .face_sizes = torus_sizes,
                                            .position_count = TORUS_FACES,
                                            .face_count = TORUS_FACES,
                                            .scheme = LIMNI_OPENSUBDIV_CATMARK,
                                            .level = LIMN_LEVEL_MAX};

static uint32_t torus_index(uint32_t x, uint32_t y) {
    return y % TORUS_SIZE * TORUS_SIZE + x % TORUS_SIZE;
}

/// Face k has its corner 0 at vertex k, but every second one begins elsewhere.
static uint32_t torus_turn(uint32_t face) {
    return face % 4;
}

static void make_torus(void) {
    for (uint32_t k = 0; k < TORUS_FACES; k++) {
        const uint32_t x = k % TORUS_SIZE, y = k / TORUS_SIZE;
        const double u = x * 6.283 / TORUS_SIZE, v = y * 6.283 / TORUS_SIZE;
        torus_positions[k][0] = (float)((3 + cos(v)) * cos(u));
        torus_positions[k][1] = (float)((3 + cos(v)) * sin(u));
        torus_positions[k][2] = (float)sin(v + 0.1 * x); // no symmetry to hide behind
        const uint32_t corners[4] = {torus_index(x, y), torus_index(x + 1, y),
                                     torus_index(x + 1, y + 1), torus_index(x, y + 1)};
        torus_sizes[k] = 4;
        for (uint32_t c = 0; c < 4; c++)
            torus_faces[4 * k + c] = corners[(c + torus_turn(k)) % 4];
    }
}

/// Uniform cubic B-splines that begin one, none, minus one and minus two steps before t.
static void weigh_spline(double t, double weights[4], double slopes[4]) {
    const double s = 1 - t;
    weights[0] = s * s * s / 6;
    weights[1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
    weights[2] = (4 - 6 * s * s + 3 * s * s * s) / 6;
    weights[3] = t * t * t / 6;
    slopes[0] = -s * s / 2;
    slopes[1] = (3 * t * t - 4 * t) / 2;
    slopes[2] = -(3 * s * s - 4 * s) / 2;
    slopes[3] = t * t / 2;
}

/// The surface at (u, v) of the face between x, y and x + 1, y + 1.
static void refer_torus(uint32_t x, uint32_t y, double u, double v, point at, point tangents[2]) {
    double across[4], across_slopes[4], along[4], along_slopes[4];
    weigh_spline(u, across, across_slopes);
    weigh_spline(v, along, along_slopes);
    memset(at, 0, sizeof(point));
    memset(tangents, 0, 2 * sizeof(point));
    for (uint32_t b = 0; b < 4; b++) {
        for (uint32_t a = 0; a < 4; a++) {
            const uint32_t vertex = torus_index(x + a + TORUS_SIZE - 1, y + b + TORUS_SIZE - 1);
            for (int axis = 0; axis < 3; axis++) {
                const double control = (double)torus_positions[vertex][axis];
                at[axis] += across[a] * along[b] * control;
                tangents[0][axis] += across_slopes[a] * along[b] * control;
                tangents[1][axis] += across[a] * along_slopes[b] * control;
            }
        }
    }
}

/// From the parameters of a quad that begins at corner `turn` to those of corner 0.
static void unturn(uint32_t turn, double u, double v, double *x, double *y) {
    for (; turn > 0; turn--) {
        const double before = u;
        u = 1 - v;
        v = before;
    }
    *x = u;
    *y = v;
}

static void test_torus(bool divided) {
    limni_opensubdiv_mesh mesh = torus;
    mesh.divided = divided;
    surface made = must_evaluate(&mesh);
    CHECK_EQUAL(made.patch_count, divided ? 4 * TORUS_FACES : TORUS_FACES);
    for (size_t k = 0; k < (size_t)made.patch_count * ROW_COUNT; k++) {
        const uint32_t patch = (uint32_t)(k / ROW_COUNT), face = divided ? patch / 4 : patch;
        const double size = divided ? 0.5 : 1;
        const limn_row row = domain()->rows[k % ROW_COUNT];
        double u, v;
        unturn(divided ? patch % 4 : 0, row.i * size / LIMN_GRID_SIZE,
               row.j * size / LIMN_GRID_SIZE, &u, &v);
        unturn(torus_turn(face), u, v, &u, &v);
        point at, tangents[2];
        refer_torus(face % TORUS_SIZE, face / TORUS_SIZE, u, v, at, tangents);
        check_point(made.limit[k], at, 1e-14);
        CHECK(plane_difference((const point *)made.tangents[k], (const point *)tangents) < 1e-13);
    }
    release(&made);
}

/// The rows of a coarser level are the first rows of a finer one.
static void test_levels(void) {
    surface fine = must_evaluate(&torus);
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX; level++) {
        limni_opensubdiv_mesh mesh = torus;
        mesh.level = level;
        surface coarse = must_evaluate(&mesh);
        const uint32_t row_count = domain()->row_counts[level];
        for (uint32_t k = 0; k < TORUS_FACES * row_count; k++)
            check_point(coarse.limit[k],
                        fine.limit[(size_t)(k / row_count) * ROW_COUNT + k % row_count], 1e-14);
        release(&coarse);
    }
    release(&fine);
}

// -------------------------------------------------------------------------------------------------
// Closed meshes of any faces: one step of Catmull-Clark and the mask of the limit, written out

enum { MESH_MAX = 16, FACE_MAX = 12 };

/// faces[f][0] is the number of its corners.
typedef struct small_mesh {
    uint32_t position_count, face_count;
    float positions[MESH_MAX][3];
    uint32_t faces[MESH_MAX][FACE_MAX];
} small_mesh;

static const small_mesh cube = {8,
                                6,
                                {{-1, -1, -1},
                                 {1, -1, -1},
                                 {1, 1, -1.5f},
                                 {-1, 1, -1},
                                 {-1, -1, 1},
                                 {1, -1, 1},
                                 {1, 1, 1},
                                 {-1, 2, 1}},
                                {{4, 0, 3, 2, 1},
                                 {4, 4, 5, 6, 7},
                                 {4, 0, 1, 5, 4},
                                 {4, 1, 2, 6, 5},
                                 {4, 2, 3, 7, 6},
                                 {4, 3, 0, 4, 7}}};

/// A prism over a pentagon with one side cut into two triangles: faces of 3, 4 and 5 corners.
static const small_mesh prism = {10,
                                 8,
                                 {{2, 0, 0},
                                  {1, 2, 0.5f},
                                  {-1.5f, 1, 0},
                                  {-1.5f, -1, 0},
                                  {1, -2, 0},
                                  {2, 0, 2},
                                  {1, 2, 2},
                                  {-2, 1, 3},
                                  {-1.5f, -1, 2},
                                  {1, -2, 2}},
                                 {{5, 4, 3, 2, 1, 0},
                                  {5, 5, 6, 7, 8, 9},
                                  {4, 0, 1, 6, 5},
                                  {4, 1, 2, 7, 6},
                                  {4, 2, 3, 8, 7},
                                  {4, 3, 4, 9, 8},
                                  {3, 4, 0, 5},
                                  {3, 4, 5, 9}}};

/// Two faces back to back: vertices of two faces, where OpenSubdiv's own limit is not one.
static const small_mesh pillow = {
    4, 2, {{0, 0, 0}, {2, 0, 0}, {3, 2, 1}, {0, 1, 0}}, {{4, 0, 1, 2, 3}, {4, 3, 2, 1, 0}}};

static uint32_t find_corner(const small_mesh *mesh, uint32_t face, uint32_t vertex) {
    uint32_t c = 0;
    while (c < mesh->faces[face][0] && mesh->faces[face][1 + c] != vertex)
        c++;
    return c;
}

static uint32_t corner_of(const small_mesh *mesh, uint32_t face, uint32_t c) {
    return mesh->faces[face][1 + c % mesh->faces[face][0]];
}

static void find_centre(const small_mesh *mesh, uint32_t face, point centre) {
    const uint32_t size = mesh->faces[face][0];
    for (int axis = 0; axis < 3; axis++) {
        centre[axis] = 0;
        for (uint32_t c = 0; c < size; c++)
            centre[axis] += (double)mesh->positions[mesh->faces[face][1 + c]][axis] / size;
    }
}

/// The face on the other side of the edge from corner c.
static uint32_t face_beyond(const small_mesh *mesh, uint32_t face, uint32_t c) {
    const uint32_t a = corner_of(mesh, face, c), b = corner_of(mesh, face, c + 1);
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t at = find_corner(mesh, f, b);
        if (at < mesh->faces[f][0] && corner_of(mesh, f, at + 1) == a) return f;
    }
    abort();
}

/// The point of level 1 of the edge from corner c.
static void find_edge_point(const small_mesh *mesh, uint32_t face, uint32_t c, point at) {
    point centre, beyond;
    find_centre(mesh, face, centre);
    find_centre(mesh, face_beyond(mesh, face, c), beyond);
    for (int axis = 0; axis < 3; axis++)
        at[axis] = ((double)mesh->positions[corner_of(mesh, face, c)][axis] +
                    (double)mesh->positions[corner_of(mesh, face, c + 1)][axis] + centre[axis] +
                    beyond[axis]) /
                   4;
}

/// Q/n + 2R/n + S(n - 3)/n, from the centres of faces, the middles of edges and the vertex.
static void find_vertex_point(const small_mesh *mesh, uint32_t vertex, point at) {
    double count = 0;
    point centres = {0}, middles = {0};
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t c = find_corner(mesh, f, vertex);
        point centre;
        if (c == mesh->faces[f][0]) continue;
        count++;
        find_centre(mesh, f, centre);
        for (int axis = 0; axis < 3; axis++) {
            centres[axis] += centre[axis];
            middles[axis] += ((double)mesh->positions[vertex][axis] +
                              (double)mesh->positions[corner_of(mesh, f, c + 1)][axis]) /
                             2;
        }
    }
    for (int axis = 0; axis < 3; axis++)
        at[axis] = (centres[axis] / count + 2 * middles[axis] / count +
                    (count - 3) * (double)mesh->positions[vertex][axis]) /
                   count;
}

/// (n^2 v + 4 sum of edges + sum of diagonals) / (n (n + 5)), on level 1.
static void add_limit(double count, const point centre, const point sides, const point diagonals,
                      point limit) {
    for (int axis = 0; axis < 3; axis++)
        limit[axis] = (count * count * centre[axis] + 4 * sides[axis] + diagonals[axis]) /
                      (count * (count + 5));
}

static void accumulate(point sum, const point what) {
    for (int axis = 0; axis < 3; axis++)
        sum[axis] += what[axis];
}

static void refer_vertex(const small_mesh *mesh, uint32_t vertex, point limit) {
    double count = 0;
    point centre, at, sides = {0}, diagonals = {0};
    find_vertex_point(mesh, vertex, centre);
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t c = find_corner(mesh, f, vertex);
        if (c == mesh->faces[f][0]) continue;
        count++;
        find_edge_point(mesh, f, c, at);
        accumulate(sides, at);
        find_centre(mesh, f, at);
        accumulate(diagonals, at);
    }
    add_limit(count, centre, sides, diagonals, limit);
}

static void refer_middle(const small_mesh *mesh, uint32_t face, point limit) {
    const uint32_t size = mesh->faces[face][0];
    point centre, at, sides = {0}, diagonals = {0};
    find_centre(mesh, face, centre);
    for (uint32_t c = 0; c < size; c++) {
        find_edge_point(mesh, face, c, at);
        accumulate(sides, at);
        find_vertex_point(mesh, corner_of(mesh, face, c), at);
        accumulate(diagonals, at);
    }
    add_limit(size, centre, sides, diagonals, limit);
}

static void refer_edge(const small_mesh *mesh, uint32_t face, uint32_t c, point limit) {
    const uint32_t faces[2] = {face, face_beyond(mesh, face, c)};
    point centre, at, sides = {0}, diagonals = {0};
    find_edge_point(mesh, face, c, centre);
    for (uint32_t end = 0; end < 2; end++) {
        const uint32_t f = faces[end], size = mesh->faces[f][0];
        const uint32_t from = find_corner(mesh, f, corner_of(mesh, face, c + end));
        find_vertex_point(mesh, corner_of(mesh, f, from), at);
        accumulate(sides, at);
        find_centre(mesh, f, at);
        accumulate(sides, at);
        find_edge_point(mesh, f, from + 1, at); // the edges of the face on both sides of this one
        accumulate(diagonals, at);
        find_edge_point(mesh, f, from + size - 1, at);
        accumulate(diagonals, at);
    }
    add_limit(4, centre, sides, diagonals, limit);
}

/// With its arrays, for OpenSubdiv.
typedef struct flat_mesh {
    uint32_t corners[MESH_MAX * FACE_MAX], sizes[MESH_MAX];
    limni_opensubdiv_mesh mesh;
} flat_mesh;

static void flatten(const small_mesh *mesh, limni_opensubdiv_scheme scheme, bool divided,
                    flat_mesh *flat) {
    uint32_t count = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        flat->sizes[f] = mesh->faces[f][0];
        for (uint32_t c = 0; c < flat->sizes[f]; c++)
            flat->corners[count++] = mesh->faces[f][1 + c];
    }
    flat->mesh = (limni_opensubdiv_mesh){.positions = mesh->positions[0],
                                         .faces = flat->corners,
                                         .face_sizes = flat->sizes,
                                         .position_count = mesh->position_count,
                                         .face_count = mesh->face_count,
                                         .scheme = scheme,
                                         .divided = divided,
                                         .level = LIMN_LEVEL_MAX};
}

static void test_corners(const small_mesh *small, bool divided, double tolerance) {
    flat_mesh flat;
    flatten(small, LIMNI_OPENSUBDIV_CATMARK, divided, &flat);
    surface made = must_evaluate(&flat.mesh);
    const point *limit = (const point *)made.limit;
    for (uint32_t f = 0; f < small->face_count; f++) {
        const uint32_t size = small->faces[f][0];
        for (uint32_t c = 0; c < size; c++) {
            point at;
            refer_vertex(small, corner_of(small, f, c), at);
            check_point(limit[divided ? 0 : c], at, tolerance);
            if (!divided) continue;
            refer_edge(small, f, c, at);
            check_point(limit[1], at, tolerance);
            refer_middle(small, f, at);
            check_point(limit[2], at, tolerance);
            refer_edge(small, f, c + size - 1, at);
            check_point(limit[3], at, tolerance);
            limit += ROW_COUNT;
        }
        if (!divided) limit += ROW_COUNT;
    }
    release(&made);
}

/// Where the mask of the limit has one step less to go: the control points themselves.
static void test_cube_vertex(void) {
    flat_mesh flat;
    flatten(&cube, LIMNI_OPENSUBDIV_CATMARK, false, &flat);
    surface made = must_evaluate(&flat.mesh);
    // Vertex 0 has edges to 1, 3 and 4 and faces with 2, 5 and 7 at the far corner.
    for (int axis = 0; axis < 3; axis++) {
        const float *const p = &cube.positions[0][axis];
        const double sides = (double)(p[3] + p[9] + p[12]);
        const double diagonals = (double)(p[6] + p[15] + p[21]);
        CHECK_NEAR(made.limit[0][axis], (9 * (double)p[0] + 4 * sides + diagonals) / 24, 1e-14);
    }
    release(&made);
}

// -------------------------------------------------------------------------------------------------
// Neighbouring patches

/// Every edge of a patch of a closed mesh is that of another one, in the other direction, with the
/// same bits. Patches are found by their corners.
static void test_edges(const small_mesh *small, bool divided) {
    flat_mesh flat;
    const limn_edge_rows *const rows = domain()->edge_rows;
    uint32_t shared_count = 0;
    flatten(small, LIMNI_OPENSUBDIV_CATMARK, divided, &flat);
    surface made = must_evaluate(&flat.mesh);
    for (uint32_t a = 0; a < 4 * made.patch_count; a++) {
        for (uint32_t b = 0; b < 4 * made.patch_count; b++) {
            const point *const one = (const point *)made.limit + (size_t)(a / 4) * ROW_COUNT;
            const point *const other = (const point *)made.limit + (size_t)(b / 4) * ROW_COUNT;
            if (memcmp(one[a % 4], other[(b + 1) % 4], sizeof(point)) != 0 ||
                memcmp(one[(a + 1) % 4], other[b % 4], sizeof(point)) != 0)
                continue;
            shared_count++;
            for (uint32_t t = 0; t <= LIMN_GRID_SIZE; t++)
                CHECK(memcmp(one[rows[a % 4][t]], other[rows[b % 4][LIMN_GRID_SIZE - t]],
                             sizeof(point)) == 0);
        }
    }
    CHECK_EQUAL(shared_count, 4 * made.patch_count);
    release(&made);
}

// -------------------------------------------------------------------------------------------------
// Bilinear faces

static void check_bilinear(const point corners[4], const point *limit, const point (*tangents)[2]) {
    for (uint32_t row = 0; row < ROW_COUNT; row++) {
        const double u = (double)domain()->rows[row].i / LIMN_GRID_SIZE;
        const double v = (double)domain()->rows[row].j / LIMN_GRID_SIZE;
        point at, slopes[2];
        for (int axis = 0; axis < 3; axis++) {
            const double c[4] = {corners[0][axis], corners[1][axis], corners[2][axis],
                                 corners[3][axis]};
            at[axis] = (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]);
            slopes[0][axis] = (1 - v) * (c[1] - c[0]) + v * (c[2] - c[3]);
            slopes[1][axis] = (1 - u) * (c[3] - c[0]) + u * (c[2] - c[1]);
        }
        check_point(limit[row], at, 1e-14);
        CHECK(plane_difference(tangents[row], (const point *)slopes) < 1e-13);
    }
}

static void test_bilinear(const small_mesh *small, bool divided) {
    flat_mesh flat;
    flatten(small, LIMNI_OPENSUBDIV_BILINEAR, divided, &flat);
    surface made = must_evaluate(&flat.mesh);
    size_t patch = 0;
    for (uint32_t f = 0; f < small->face_count; f++) {
        const uint32_t size = small->faces[f][0];
        for (uint32_t k = 0; k < (divided ? size : 1); k++, patch++) {
            point corners[4];
            if (divided) find_centre(small, f, corners[2]);
            for (int axis = 0; axis < 3; axis++) {
                double at[4];
                for (uint32_t c = 0; c < 4; c++)
                    at[c] = (double)small->positions[corner_of(small, f, k + c)][axis];
                const double before =
                    (double)small->positions[corner_of(small, f, k + size - 1)][axis];
                corners[0][axis] = at[0];
                corners[1][axis] = divided ? (at[0] + at[1]) / 2 : at[1];
                if (!divided) corners[2][axis] = at[2];
                corners[3][axis] = divided ? (at[0] + before) / 2 : at[3];
            }
            check_bilinear((const point *)corners, (const point *)made.limit + patch * ROW_COUNT,
                           (const point(*)[2])made.tangents + patch * ROW_COUNT);
        }
    }
    release(&made);
}

// -------------------------------------------------------------------------------------------------
// Refusals

static void check_refused(limni_opensubdiv_mesh mesh, const char *part) {
    limni_opensubdiv_stencils stencils;
    surface made = evaluate(&mesh);
    CHECK(!made.limit);
    CHECK_CONTAINS(made.error, part);
    release(&made);
    CHECK(!limni_opensubdiv_stencil_bytes(&mesh, true, &stencils, made.error, sizeof made.error));
}

static void test_refusals(void) {
    flat_mesh flat;
    flatten(&prism, LIMNI_OPENSUBDIV_CATMARK, false, &flat);
    check_refused(flat.mesh, "face 0 is not a quad, and faces are not divided");
    flat.mesh.scheme = LIMNI_OPENSUBDIV_LOOP;
    check_refused(flat.mesh, "face 0 is not a triangle");
    flat.mesh.divided = true;
    check_refused(flat.mesh, "not divided");
    flatten(&prism, LIMNI_OPENSUBDIV_CATMARK, true, &flat);
    flat.corners[4] = flat.corners[0];
    check_refused(flat.mesh, "face 0 uses a vertex twice");
    flat.corners[4] = 10;
    check_refused(flat.mesh, "face 0 has an index out of range");
    flat.sizes[0] = 2;
    check_refused(flat.mesh, "face 0 has too few corners");
}

int main(void) {
    make_torus();
    test_torus(false);
    test_torus(true);
    test_levels();
    test_cube_vertex();
    test_corners(&cube, false, 1e-14);
    test_corners(&cube, true, 1e-14);
    test_corners(&prism, true, 1e-14);
    test_corners(&pillow, false, 2e-9); // 4^-15 of the way is left
    test_corners(&pillow, true, 2e-9);
    test_edges(&cube, false);
    test_edges(&cube, true);
    test_edges(&prism, true);
    test_bilinear(&cube, false);
    test_bilinear(&prism, true);
    test_refusals();
    return check_report();
}
