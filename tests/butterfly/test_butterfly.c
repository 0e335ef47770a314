/* SPDX-License-Identifier: MIT */
/* The modified butterfly against itself and against what is known of its surfaces. */
#include "../check.h"
#include "../random_mesh.h"
#include "butterfly.h"

#include <stdlib.h>

enum { SEED_COUNT = 30 };

typedef double vector[3];

// ---- Meshes

static butterfly_mesh from_random(const random_mesh *random) {
    return butterfly_create((const float(*)[3])random->positions, random->vertex_count,
                            (const uint32_t(*)[3])random->faces, random->face_count);
}

/// Every other one has boundaries.
static butterfly_mesh random_butterfly(uint64_t seed) {
    const random_mesh random = random_mesh_make(seed, seed % 2 == 1);
    butterfly_mesh mesh = from_random(&random);
    mesh.stencil = seed % 5 < 2 ? BUTTERFLY_TEN : BUTTERFLY_EIGHT;
    mesh.tension = seed % 5 == 0 ? 0 : ((double)(seed % 5) - 2.5) / 100;
    return mesh;
}

/// A flat parallelogram of a regular lattice; its vertex (x, y) is x + y * LATTICE_SIZE.
enum { LATTICE_SIZE = 8 };

static butterfly_mesh lattice(void) {
    random_mesh random = {.state = 1};
    for (int v = 0; v < LATTICE_SIZE * LATTICE_SIZE; v++) {
        const double x = v % LATTICE_SIZE, y = v / LATTICE_SIZE;
        random_mesh_add_vertex(&random, (float)x, (float)y, 0);
    }
    for (uint32_t v = 0; v < LATTICE_SIZE * (LATTICE_SIZE - 1); v++) {
        if (v % LATTICE_SIZE == LATTICE_SIZE - 1) continue;
        random_mesh_add_face(&random, v, v + 1, v + LATTICE_SIZE);
        random_mesh_add_face(&random, v + 1, v + LATTICE_SIZE + 1, v + LATTICE_SIZE);
    }
    return from_random(&random);
}

/// A vertex with `count` neighbours in a plane, all around or in less than half of it.
static butterfly_mesh fan(uint32_t count, bool closed) {
    random_mesh random = {.state = count};
    const double turn = acos(-1) * (closed ? 2 : 1) / count;
    random_mesh_add_vertex(&random, 0, 0, 0);
    for (uint32_t r = 0; r < count; r++) {
        const double angle = turn * (r + (double)random_float(&random) / 8);
        random_mesh_add_vertex(&random, (float)cos(angle), (float)sin(angle), 0);
        if (closed || r + 1 < count) random_mesh_add_face(&random, 0, 1 + r, 1 + (r + 1) % count);
    }
    return from_random(&random);
}

static void refine(butterfly_mesh *mesh, int level_count) {
    for (int level = 0; level < level_count; level++) {
        butterfly_mesh finer = butterfly_subdivide(mesh);
        butterfly_destroy(mesh);
        *mesh = finer;
    }
}

static int start(const butterfly_mesh *mesh, int h) {
    return mesh->faces[h / 3][h % 3];
}

static int end(const butterfly_mesh *mesh, int h) {
    return mesh->faces[h / 3][(h + 1) % 3];
}

static int find_half_edge(const butterfly_mesh *mesh, int from, int to) {
    int h = 0;
    while (start(mesh, h) != from || end(mesh, h) != to)
        h++;
    return h;
}

static bool is_regular(const butterfly_mesh *mesh, int v) {
    return butterfly_valence(mesh, v) == (butterfly_is_on_boundary(mesh, v) ? 4 : 6);
}

// ---- Vectors

static vector *allocate_vectors(int count) {
    vector *const vectors = malloc((size_t)count * sizeof *vectors);
    if (!vectors) abort();
    return vectors;
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(const double *a, const double *b, double *difference) {
    for (int axis = 0; axis < 3; axis++)
        difference[axis] = a[axis] - b[axis];
}

static double distance(const double *a, const double *b) {
    vector difference;
    subtract(a, b, difference);
    return sqrt(dot(difference, difference));
}

static void add_product(const double *a, const double *b, double *sum) {
    for (int axis = 0; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        sum[axis] += a[u] * b[v] - a[v] * b[u];
    }
}

static void normalize(double *a) {
    const double length = sqrt(dot(a, a));
    for (int axis = 0; axis < 3; axis++)
        a[axis] /= length;
}

/// Adds twice the area of a face, along its normal.
static void add_face_normal(const butterfly_mesh *mesh, int face, double *sum) {
    const int *const v = mesh->faces[face];
    vector first, second;
    subtract(mesh->positions[v[1]], mesh->positions[v[0]], first);
    subtract(mesh->positions[v[2]], mesh->positions[v[0]], second);
    add_product(first, second, sum);
}

// ---- Structure

static void check_half_edges(const butterfly_mesh *mesh) {
    int boundary_count = 0;
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        const int pair = mesh->pairs[h];
        if (pair == -1) {
            boundary_count++;
            CHECK_EQUAL(mesh->first_edges[start(mesh, h)], h);
            continue;
        }
        CHECK_EQUAL(mesh->pairs[pair], h);
        CHECK(start(mesh, h) == end(mesh, pair) && end(mesh, h) == start(mesh, pair));
    }
    CHECK_EQUAL(2 * mesh->edge_count, 3 * mesh->face_count + boundary_count);
    for (int v = 0; v < mesh->vertex_count; v++)
        CHECK_EQUAL(start(mesh, mesh->first_edges[v]), v);
}

/// Half-edges fit together, and no vertex moves by a bit; what is new is regular.
static void test_levels(void) {
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        butterfly_mesh mesh = random_butterfly(seed);
        const int characteristic = mesh.vertex_count - mesh.edge_count + mesh.face_count;
        for (int level = 0; level < 2; level++) {
            butterfly_mesh finer = butterfly_subdivide(&mesh);
            check_half_edges(&finer);
            CHECK_EQUAL(finer.vertex_count - finer.edge_count + finer.face_count, characteristic);
            CHECK(memcmp(finer.positions, mesh.positions,
                         (size_t)mesh.vertex_count * sizeof *mesh.positions) == 0);
            for (int v = 0; v < finer.vertex_count; v++) {
                if (v >= mesh.vertex_count)
                    CHECK(is_regular(&finer, v));
                else
                    CHECK_EQUAL(butterfly_valence(&finer, v), butterfly_valence(&mesh, v));
            }
            for (int h = 0; h < 3 * mesh.face_count; h++)
                CHECK_EQUAL(finer.faces[4 * (h / 3) + h % 3][h % 3], start(&mesh, h));
            butterfly_destroy(&mesh);
            mesh = finer;
        }
        butterfly_destroy(&mesh);
    }
}

// ---- Masks

static double weight_of(const butterfly_mask *mask, int vertex) {
    double sum = 0;
    for (int t = 0; t < mask->count; t++)
        sum += mask->vertices[t] == vertex ? mask->weights[t] : 0;
    return sum;
}

/// The mask of the edge to neighbour `spoke` of the middle of a fan, once subdivided.
static void check_fan_mask(uint32_t count, bool closed, int spoke, double centre,
                           const double *weights) {
    butterfly_mesh base = fan(count, closed), mesh = butterfly_subdivide(&base);
    int ring[BUTTERFLY_VALENCE_MAX];
    for (int r = 0; r < (int)count; r++) {
        const bool last = !closed && r == (int)count - 1;
        const int h = last ? find_half_edge(&base, 1 + r, 0) : find_half_edge(&base, 0, 1 + r);
        ring[r] = mesh.faces[4 * (h / 3) + 3][h % 3];
    }
    const butterfly_mask mask = butterfly_edge_mask(&mesh, find_half_edge(&mesh, 0, ring[spoke]));
    CHECK_NEAR(weight_of(&mask, 0), centre, 1e-15);
    for (int r = 0; r < (int)count; r++)
        CHECK_NEAR(weight_of(&mask, ring[r]), weights[r], 1e-15);
    butterfly_destroy(&base);
    butterfly_destroy(&mesh);
}

static void test_extraordinary_weights(void) {
    const double root = sqrt(5), half = sqrt(1 / 2.);
    check_fan_mask(3, true, 0, 3 / 4., (double[]){5 / 12., -1 / 12., -1 / 12.});
    check_fan_mask(4, true, 0, 3 / 4., (double[]){3 / 8., 0, -1 / 8., 0});
    check_fan_mask(4, true, 1, 3 / 4., (double[]){0, 3 / 8., 0, -1 / 8.});
    check_fan_mask(
        5, true, 0, 3 / 4.,
        (double[]){7 / 20., (root - 1) / 40, -(root + 1) / 40, -(root + 1) / 40, (root - 1) / 40});
    check_fan_mask(8, true, 0, 3 / 4.,
                   (double[]){7 / 32., (1 / 4. + half) / 8, -1 / 32., (1 / 4. - half) / 8, -1 / 32.,
                              (1 / 4. - half) / 8, -1 / 32., (1 / 4. + half) / 8});
    check_fan_mask(3, false, 1, 1 / 2., (double[]){0, 1 / 2., 0});
    check_fan_mask(5, false, 1, 3 / 4. - half / 4,
                   (double[]){half / 8, 1 / 4., half / 4, 0, -half / 8});
    check_fan_mask(5, false, 2, 3 / 4. - half / 2, (double[]){0, half / 4, 1 / 4., half / 4, 0});
}

/// Whether a vertex is another or its neighbour.
static bool is_near(const butterfly_mesh *mesh, int vertex, int other) {
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        if (start(mesh, h) == vertex && end(mesh, h) == other) return true;
        if (end(mesh, h) == vertex && start(mesh, h) == other) return true;
    }
    return vertex == other;
}

/// Of an inner edge, nothing comes from a regular end, and half from each extraordinary one of two.
static void check_shares(const butterfly_mesh *mesh, int h) {
    const int a = start(mesh, h), b = end(mesh, h);
    const double share = is_regular(mesh, a) ? 0 : is_regular(mesh, b) ? 1 : 1 / 2.;
    const butterfly_mask mask = butterfly_edge_mask(mesh, h);
    double sum = 0;
    for (int v = 0; v < mesh->vertex_count; v++) {
        const double weight = weight_of(&mask, v);
        if (share == 0 && !is_near(mesh, v, b)) CHECK(weight == 0);
        if (share == 1 && !is_near(mesh, v, a)) CHECK(weight == 0);
        sum += weight;
    }
    CHECK_NEAR(sum, 1, 1e-14);
    const int n = butterfly_valence(mesh, a), m = butterfly_valence(mesh, b);
    if (share != 1 / 2. || butterfly_is_on_boundary(mesh, a) || n < 5) return;
    if (butterfly_is_on_boundary(mesh, b) || m < 5) return;
    CHECK_NEAR(weight_of(&mask, a), (3 / 4. + 7 / (4. * m)) / 2, 1e-14);
}

static void test_extraordinary_ends(void) {
    int seen[3][3] = {{0}}; // by how many ends are on a boundary, how many are extraordinary
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        butterfly_mesh mesh = random_butterfly(seed);
        for (int h = 0; h < 3 * mesh.face_count; h++) {
            const int a = start(&mesh, h), b = end(&mesh, h);
            const int extraordinary_count = !is_regular(&mesh, a) + !is_regular(&mesh, b);
            if (mesh.pairs[h] == -1) continue;
            if (extraordinary_count > 0) check_shares(&mesh, h);
            seen[butterfly_is_on_boundary(&mesh, a) + butterfly_is_on_boundary(&mesh, b)]
                [extraordinary_count]++;
        }
        butterfly_destroy(&mesh);
    }
    for (int kind = 0; kind < 9; kind++)
        CHECK(seen[kind / 3][kind % 3] > 0);
}

/// Weights of the edge between two vertices of the lattice, at (x, y) from the first.
typedef struct lattice_weight {
    int x, y;
    double weight;
} lattice_weight;

static void check_lattice_mask(const butterfly_mesh *mesh, int x, int y, int x_step, int y_step,
                               const lattice_weight *weights, int count) {
    const int from = x + y * LATTICE_SIZE, to = from + x_step + y_step * LATTICE_SIZE;
    const butterfly_mask mask = butterfly_edge_mask(mesh, find_half_edge(mesh, from, to));
    double rest = 1;
    for (int w = 0; w < count; w++) {
        const int vertex = from + weights[w].x + weights[w].y * LATTICE_SIZE;
        CHECK_NEAR(weight_of(&mask, vertex), weights[w].weight, 1e-15);
        rest -= weights[w].weight;
    }
    CHECK_NEAR(rest, 0, 1e-15);
}

#define CHECK_LATTICE(mesh, x, y, x_step, y_step, ...)                                             \
    check_lattice_mask((mesh), (x), (y), (x_step), (y_step), (lattice_weight[]){__VA_ARGS__},      \
                       (int)(sizeof((lattice_weight[]){__VA_ARGS__}) / sizeof(lattice_weight)))

static void test_regular_weights(void) {
    butterfly_mesh mesh = lattice();
    for (mesh.tension = -0.05; mesh.tension < 0.06; mesh.tension += 0.05) {
        const double w = mesh.tension, b = 1 / 8. + 2 * w, c = -1 / 16. - w;
        mesh.stencil = BUTTERFLY_EIGHT;
        CHECK_LATTICE(&mesh, 3, 3, 1, 0, {0, 0, 0.5}, {1, 0, 0.5}, {0, 1, b}, {1, -1, b},
                      {-1, 1, c}, {1, 1, c}, {0, -1, c}, {2, -1, c}, {-1, 0, 0}, {2, 0, 0});
        mesh.stencil = BUTTERFLY_TEN;
        CHECK_LATTICE(&mesh, 3, 3, 1, 0, {0, 0, 0.5 - w}, {1, 0, 0.5 - w}, {0, 1, b}, {1, -1, b},
                      {-1, 1, c}, {1, 1, c}, {0, -1, c}, {2, -1, c}, {-1, 0, w}, {2, 0, w});
        CHECK_LATTICE(&mesh, 3, 0, 1, 0, {-1, 0, -1 / 16.}, {0, 0, 9 / 16.}, {1, 0, 9 / 16.},
                      {2, 0, -1 / 16.});
        CHECK_LATTICE(&mesh, 3, 0, 0, 1, {0, 0, 3 / 8.}, {0, 1, 5 / 8.}, {1, 0, 1 / 16.},
                      {-1, 1, 3 / 16.}, {-1, 0, -1 / 16.}, {1, 1, -1 / 16.}, {-1, 2, -1 / 8.});
        CHECK_LATTICE(&mesh, 3, 0, -1, 1, {0, 0, 3 / 8.}, {-1, 1, 5 / 8.}, {-1, 0, 1 / 16.},
                      {0, 1, 3 / 16.}, {1, 0, -1 / 16.}, {-2, 1, -1 / 16.}, {-1, 2, -1 / 8.});
        CHECK_LATTICE(&mesh, 1, 0, -1, 1, {0, 0, 1 / 2.}, {-1, 1, 1 / 2.}, {0, 1, 1 / 4.},
                      {1, 0, -1 / 8.}, {-1, 2, -1 / 8.}, {-1, 0, 0});
    }
    butterfly_destroy(&mesh);
}

/// A strip between two boundaries, one face wide.
static void test_strip(void) {
    random_mesh random = {.state = 3};
    random_mesh_tube(&random, 6, 2, true);
    butterfly_mesh mesh = from_random(&random);
    for (int h = 0; h < 3 * mesh.face_count; h++) {
        if (mesh.pairs[h] == -1) continue;
        const butterfly_mask mask = butterfly_edge_mask(&mesh, h);
        for (int v = 0; v < mesh.vertex_count; v++)
            CHECK(weight_of(&mask, v) == (v == start(&mesh, h) || v == end(&mesh, h) ? 0.5 : 0));
    }
    butterfly_destroy(&mesh);
}

/// An affine map with a large translation, which only masks that sum to 1 leave alone.
static void map(const double *p, double *mapped) {
    mapped[0] = 100 + p[0] + 2 * p[1] - p[2];
    mapped[1] = -50 + p[1] / 2 + 3 * p[2];
    mapped[2] = 70 - p[0] + p[2];
}

static void test_affine_invariance(void) {
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        butterfly_mesh plain = random_butterfly(seed), moved = random_butterfly(seed);
        for (int v = 0; v < plain.vertex_count; v++)
            map(plain.positions[v], moved.positions[v]);
        refine(&plain, 2);
        refine(&moved, 2);
        for (int v = 0; v < plain.vertex_count; v++) {
            vector position;
            map(plain.positions[v], position);
            CHECK(distance(position, moved.positions[v]) < 1e-12);
        }
        butterfly_destroy(&plain);
        butterfly_destroy(&moved);
    }
}

/// Masks do not know which half of an edge they come from, nor left from right.
static void test_mirror_images(void) {
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        random_mesh random = random_mesh_make(seed, seed % 2 == 1);
        butterfly_mesh mesh = from_random(&random);
        for (uint32_t f = 0; f < random.face_count; f++) {
            const uint32_t *const v = random.faces[f];
            random_mesh_set_face(&random, f, v[1], v[0], v[2]);
        }
        butterfly_mesh mirrored = from_random(&random);
        for (int h = 0; h < 3 * mesh.face_count; h++) {
            const int image = find_half_edge(&mirrored, end(&mesh, h), start(&mesh, h));
            const butterfly_mask mask = butterfly_edge_mask(&mesh, h);
            const butterfly_mask other = butterfly_edge_mask(&mirrored, image);
            for (int v = 0; v < mesh.vertex_count; v++)
                CHECK_NEAR(weight_of(&mask, v), weight_of(&other, v), 1e-15);
        }
        butterfly_destroy(&mesh);
        butterfly_destroy(&mirrored);
    }
}

/// The boundary does not depend on what is inside, by any bit.
static void test_boundaries_are_curves(void) {
    for (uint64_t seed = 1; seed < SEED_COUNT; seed += 2) {
        butterfly_mesh mesh = random_butterfly(seed), moved = random_butterfly(seed);
        for (int v = 0; v < mesh.vertex_count; v++)
            moved.positions[v][2] += butterfly_is_on_boundary(&mesh, v) ? 0 : 10;
        refine(&mesh, 3);
        refine(&moved, 3);
        for (int v = 0; v < mesh.vertex_count; v++) {
            if (butterfly_is_on_boundary(&mesh, v))
                CHECK(memcmp(mesh.positions[v], moved.positions[v], sizeof(vector)) == 0);
        }
        butterfly_destroy(&mesh);
        butterfly_destroy(&moved);
    }
}

// ---- Polynomials

typedef enum edge_kind { INNER, TO_BOUNDARY, ACROSS_CORNER, ALONG_BOUNDARY, KIND_COUNT } edge_kind;

/// Of an edge of the lattice whose ends are regular.
static edge_kind kind_of(const butterfly_mesh *mesh, int h) {
    if (mesh->pairs[h] == -1) return ALONG_BOUNDARY;
    const int boundary_count = butterfly_is_on_boundary(mesh, start(mesh, h)) +
                               butterfly_is_on_boundary(mesh, end(mesh, h));
    return (edge_kind)boundary_count;
}

/// The largest error in the middle of edges, by kind, for the monomial x^a y^b.
static void measure_monomial(butterfly_mesh *mesh, int a, int b, double errors[KIND_COUNT]) {
    for (int v = 0; v < mesh->vertex_count; v++)
        mesh->positions[v][2] = pow(mesh->positions[v][0], a) * pow(mesh->positions[v][1], b);
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        if (!is_regular(mesh, start(mesh, h)) || !is_regular(mesh, end(mesh, h))) continue;
        const butterfly_mask mask = butterfly_edge_mask(mesh, h);
        vector middle;
        butterfly_apply(mesh, &mask, middle);
        double *const error = &errors[kind_of(mesh, h)];
        *error = fmax(*error, fabs(middle[2] - pow(middle[0], a) * pow(middle[1], b)));
    }
}

/// The highest degree that is reproduced, of 4 at most.
static void find_degrees(butterfly_mesh *mesh, int degrees[KIND_COUNT]) {
    for (int kind = 0; kind < KIND_COUNT; kind++)
        degrees[kind] = -1;
    for (int degree = 0; degree <= 4; degree++) {
        double errors[KIND_COUNT] = {0};
        for (int a = 0; a <= degree; a++)
            measure_monomial(mesh, a, degree - a, errors);
        for (int kind = 0; kind < KIND_COUNT; kind++) {
            if (errors[kind] < 1e-10 && degrees[kind] == degree - 1) degrees[kind] = degree;
        }
    }
}

static void test_polynomials(void) {
    butterfly_mesh mesh = lattice();
    int degrees[KIND_COUNT];
    for (int stencil = BUTTERFLY_EIGHT; stencil <= BUTTERFLY_TEN; stencil++) {
        for (mesh.tension = -0.0625; mesh.tension < 0.07; mesh.tension += 0.0625) {
            mesh.stencil = (butterfly_stencil)stencil;
            find_degrees(&mesh, degrees);
            const bool cubic = stencil == BUTTERFLY_TEN || mesh.tension == 0;
            CHECK_EQUAL(degrees[INNER], cubic ? 3 : 1);
            CHECK_EQUAL(degrees[TO_BOUNDARY], 2);
            CHECK_EQUAL(degrees[ACROSS_CORNER], 2);
            CHECK_EQUAL(degrees[ALONG_BOUNDARY], 3);
        }
    }
    butterfly_destroy(&mesh);
}

// ---- Tangents

static double largest_change;

/// One more level halves the tangents: they are left eigenvectors for 1/2.
static void check_tangents(const butterfly_mesh *mesh, const butterfly_mesh *finer, int v) {
    butterfly_mask tangents[2], finer_tangents[2];
    if (!butterfly_tangents(mesh, v, tangents)) return;
    CHECK(butterfly_tangents(finer, v, finer_tangents));
    for (int t = 0; t < 2; t++) {
        vector tangent, finer_tangent;
        butterfly_apply(mesh, &tangents[t], tangent);
        butterfly_apply(finer, &finer_tangents[t], finer_tangent);
        for (int axis = 0; axis < 3; axis++)
            finer_tangent[axis] *= 2;
        const double change = distance(tangent, finer_tangent);
        CHECK(change < 1e-12);
        largest_change = fmax(change, largest_change);
    }
}

static void test_tangents(void) {
    int seen[2][16] = {{0}};
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        butterfly_mesh base = random_butterfly(seed);
        butterfly_mesh mesh = butterfly_subdivide(&base), finer = butterfly_subdivide(&mesh);
        for (int v = 0; v < base.vertex_count; v++) {
            const int valence = butterfly_valence(&base, v);
            check_tangents(&mesh, &finer, v);
            if (valence < 16) seen[butterfly_is_on_boundary(&base, v)][valence]++;
        }
        butterfly_destroy(&base);
        butterfly_destroy(&mesh);
        butterfly_destroy(&finer);
    }
    for (int valence = 3; valence <= 9; valence++)
        CHECK(seen[0][valence] > 0 && seen[1][valence] > 0);
    printf("one more level: tangents change by %.1e\n", largest_change);
}

static void test_regular_tangents(void) {
    butterfly_mesh mesh = lattice();
    butterfly_mask tangents[2];
    const int v = 3 + 3 * LATTICE_SIZE;
    CHECK(butterfly_tangents(&mesh, v, tangents));
    // Twice the first is 16 cos and so on, as printed; but the first neighbour may be any.
    double squares[3] = {0};
    static const int kinds[3][2] = {{1, 0}, {1, 1}, {2, 0}};
    for (int kind = 0; kind < 3; kind++) {
        const int vertex = v + kinds[kind][0] + kinds[kind][1] * LATTICE_SIZE;
        for (int t = 0; t < 2; t++)
            squares[kind] += pow(16 * weight_of(&tangents[t], vertex), 2);
    }
    CHECK_NEAR(squares[0], 256, 1e-12);
    CHECK_NEAR(squares[1], 64 / 3., 1e-12);
    CHECK_NEAR(squares[2], 1, 1e-12);
    butterfly_destroy(&mesh);
}

/// At any level, at vertices of any age.
static void test_normals(void) {
    double largest = 0;
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        butterfly_mesh mesh = random_butterfly(seed);
        refine(&mesh, (int)(seed % 3));
        butterfly_mesh finer = butterfly_subdivide(&mesh);
        vector *const normals = allocate_vectors(mesh.vertex_count);
        vector *const finer_normals = allocate_vectors(finer.vertex_count);
        butterfly_normals(&mesh, normals);
        butterfly_normals(&finer, finer_normals);
        for (int v = 0; v < mesh.vertex_count; v++) {
            if (butterfly_valence(&mesh, v) == 2) continue;
            const double turn = distance(normals[v], finer_normals[v]);
            CHECK(turn < 1e-10);
            largest = fmax(turn, largest);
        }
        free(normals);
        free(finer_normals);
        butterfly_destroy(&mesh);
        butterfly_destroy(&finer);
    }
    printf("one more level: normals turn by %.1e\n", largest);
}

/// In a plane all normals are that of the plane, not its opposite, with any number of neighbours.
static void test_normals_in_a_plane(void) {
    static const vector up = {0, 0, 1};
    for (uint32_t count = 2; count <= 24; count++) {
        butterfly_mesh mesh = fan(count, count % 2 == 0 && count > 3);
        refine(&mesh, 1);
        vector *const normals = allocate_vectors(mesh.vertex_count);
        butterfly_normals(&mesh, normals);
        CHECK(distance(normals[0], up) < 1e-12);
        free(normals);
        butterfly_destroy(&mesh);
    }
}

// ---- The surface around a vertex, at any level

/// How many edges vertices are from one of them, up to `limit`.
static int *measure_distances(const butterfly_mesh *mesh, int vertex, int limit) {
    int *const distances = malloc((size_t)mesh->vertex_count * sizeof(int));
    if (!distances) abort();
    for (int v = 0; v < mesh->vertex_count; v++)
        distances[v] = v == vertex ? 0 : limit;
    for (int step = 0; step < limit; step++) {
        for (int h = 0; h < 3 * mesh->face_count; h++) {
            int *const a = &distances[start(mesh, h)], *const b = &distances[end(mesh, h)];
            if (*a == step && *b > step) *b = step + 1;
            if (*b == step && *a > step) *a = step + 1;
        }
    }
    return distances;
}

/// The faces around all vertices up to `radius` edges from a vertex, which comes first. Edges
/// between such vertices do not feel the cut, and so the same part of the next level does not.
static butterfly_mesh zoom(const butterfly_mesh *mesh, int vertex, int radius) {
    int *const distances = measure_distances(mesh, vertex, radius + 1);
    int *const indices = calloc((size_t)mesh->vertex_count, sizeof(int)); // 1 more
    float(*const unplaced)[3] = calloc((size_t)mesh->vertex_count, sizeof(float[3]));
    uint32_t(*const faces)[3] = malloc((size_t)mesh->face_count * sizeof *faces);
    if (!indices || !unplaced || !faces) abort();
    uint32_t vertex_count = 0, face_count = 0;
    indices[vertex] = (int)++vertex_count;
    for (int f = 0; f < mesh->face_count; f++) {
        const int *const v = mesh->faces[f];
        if (distances[v[0]] > radius && distances[v[1]] > radius && distances[v[2]] > radius)
            continue;
        for (int k = 0; k < 3; k++) {
            if (indices[v[k]] == 0) indices[v[k]] = (int)++vertex_count;
            faces[face_count][k] = (uint32_t)indices[v[k]] - 1;
        }
        face_count++;
    }
    butterfly_mesh part = butterfly_create((const float(*)[3])unplaced, vertex_count,
                                           (const uint32_t(*)[3])faces, face_count);
    part.stencil = mesh->stencil;
    part.tension = mesh->tension;
    for (int v = 0; v < mesh->vertex_count; v++) {
        if (indices[v] != 0)
            memcpy(part.positions[indices[v] - 1], mesh->positions[v], sizeof(vector));
    }
    free(distances);
    free(indices);
    free(unplaced);
    free(faces);
    return part;
}

/// Subdivides what is around the vertex 0.
static void zoom_in(butterfly_mesh *part, int radius, int level_count) {
    for (int level = 0; level < level_count; level++) {
        butterfly_mesh finer = butterfly_subdivide(part);
        butterfly_destroy(part);
        *part = zoom(&finer, 0, radius);
        butterfly_destroy(&finer);
    }
}

/// The normal of the faces around the vertex 0, which stands for finite differences.
static void flat_normal(const butterfly_mesh *part, double *normal) {
    memset(normal, 0, sizeof(vector));
    for (int h = 0; h < 3 * part->face_count; h++) {
        if (start(part, h) == 0) add_face_normal(part, h / 3, normal);
    }
    normalize(normal);
}

/// How far the neighbours of the vertex 0 are from it, along the surface and off its tangent plane.
typedef struct extent {
    double along, off;
} extent;

static extent measure_ring(const butterfly_mesh *part, const double *normal) {
    extent largest = {0, 0};
    for (int h = 0; h < 3 * part->face_count; h++) {
        vector spoke;
        if (start(part, h) == 0)
            subtract(part->positions[end(part, h)], part->positions[0], spoke);
        else if (end(part, h) == 0)
            subtract(part->positions[start(part, h)], part->positions[0], spoke);
        else
            continue;
        largest.along = fmax(largest.along, sqrt(dot(spoke, spoke)));
        largest.off = fmax(largest.off, fabs(dot(spoke, normal)));
    }
    return largest;
}

/// The largest difference between the normal of the vertex 0 and those of its neighbours.
static double measure_turn(const butterfly_mesh *part) {
    vector *const normals = allocate_vectors(part->vertex_count);
    butterfly_normals(part, normals);
    double turn = 0;
    for (int h = 0; h < 3 * part->face_count; h++) {
        if (start(part, h) == 0) turn = fmax(turn, distance(normals[0], normals[end(part, h)]));
        if (end(part, h) == 0) turn = fmax(turn, distance(normals[0], normals[start(part, h)]));
    }
    free(normals);
    return turn;
}

static double largest_deviation, largest_final_turn;

/// A long way down, distances along the surface halve, and those off the tangent plane fall as with
/// 1/4, if with a Jordan block; so 1/2 is the largest eigenvalue. The normal is that of the faces,
/// and normals around come together.
static void look_closer(const butterfly_mesh *mesh, int v, const double *normal) {
    enum { LEVEL_COUNT = 14, RADIUS = 3 };
    butterfly_mesh part = zoom(mesh, v, RADIUS);
    zoom_in(&part, RADIUS, LEVEL_COUNT - 1);
    const extent before = measure_ring(&part, normal);
    const double turn_before = measure_turn(&part);
    zoom_in(&part, RADIUS, 1);
    const extent after = measure_ring(&part, normal);
    const double turn = measure_turn(&part);
    vector flat;
    flat_normal(&part, flat);
    const double deviation = distance(flat, normal);
    CHECK_NEAR(after.along / before.along, 1 / 2., 2e-3);
    CHECK(after.off / before.off < 0.29);
    CHECK(deviation < 4e-3);
    CHECK(turn < 1e-2);
    CHECK(turn / turn_before < 0.6);
    largest_deviation = fmax(deviation, largest_deviation);
    largest_final_turn = fmax(turn, largest_final_turn);
    butterfly_destroy(&part);
}

/// Some vertices of each kind.
static void test_smoothness(void) {
    enum { VALENCE_COUNT = 13, EACH = 4 };
    int seen[2][VALENCE_COUNT] = {{0}};
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        butterfly_mesh mesh = random_butterfly(seed);
        const int base_count = mesh.vertex_count;
        refine(&mesh, 2);
        vector *const normals = allocate_vectors(mesh.vertex_count);
        butterfly_normals(&mesh, normals);
        for (int v = 0; v < base_count; v++) {
            const int valence = butterfly_valence(&mesh, v);
            if (valence == 2 || valence >= VALENCE_COUNT) continue;
            if (seen[butterfly_is_on_boundary(&mesh, v)][valence]++ < EACH)
                look_closer(&mesh, v, normals[v]);
        }
        free(normals);
        butterfly_destroy(&mesh);
    }
    for (int valence = 3; valence <= 9; valence++)
        CHECK(seen[0][valence] >= EACH && seen[1][valence] >= EACH);
    printf("after 16 levels: normals off those of faces by %.1e, of neighbours by %.1e\n",
           largest_deviation, largest_final_turn);
}

// ---- Support

/// Up to two edges from a corner of a face.
static bool *mark_support(const butterfly_mesh *mesh, int face) {
    bool *const marked = calloc((size_t)mesh->vertex_count, sizeof *marked);
    if (!marked) abort();
    for (int k = 0; k < 3; k++) {
        int *const distances = measure_distances(mesh, mesh->faces[face][k], 3);
        for (int v = 0; v < mesh->vertex_count; v++)
            marked[v] |= distances[v] <= 2;
        free(distances);
    }
    return marked;
}

/// Of a face, positions and normals do not depend on anything else, by any bit.
static void check_support(const butterfly_mesh *mesh, const butterfly_mesh *moved, int face) {
    vector *const normals = allocate_vectors(mesh->vertex_count);
    vector *const moved_normals = allocate_vectors(mesh->vertex_count);
    butterfly_normals(mesh, normals);
    butterfly_normals(moved, moved_normals);
    for (int h = 48 * face; h < 48 * (face + 1); h++) {
        const int v = start(mesh, h);
        CHECK(memcmp(mesh->positions[v], moved->positions[v], sizeof(vector)) == 0);
        CHECK(memcmp(normals[v], moved_normals[v], sizeof(vector)) == 0);
    }
    free(normals);
    free(moved_normals);
}

static void test_support(void) {
    int outside_count = 0;
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        butterfly_mesh mesh = random_butterfly(seed), moved = random_butterfly(seed);
        refine(&mesh, (int)(seed / 2 % 2));
        refine(&moved, (int)(seed / 2 % 2));
        const int face = (int)(7 * seed) % mesh.face_count;
        bool *const marked = mark_support(&mesh, face);
        for (int v = 0; v < mesh.vertex_count; v++) {
            moved.positions[v][1] += marked[v] ? 0 : 10;
            outside_count += !marked[v];
        }
        free(marked);
        refine(&mesh, 2);
        refine(&moved, 2);
        check_support(&mesh, &moved, face);
        butterfly_destroy(&mesh);
        butterfly_destroy(&moved);
    }
    CHECK(outside_count > 20 * SEED_COUNT);
}

int main(void) {
    test_levels();
    test_extraordinary_weights();
    test_extraordinary_ends();
    test_regular_weights();
    test_strip();
    test_affine_invariance();
    test_mirror_images();
    test_boundaries_are_curves();
    test_polynomials();
    test_tangents();
    test_regular_tangents();
    test_normals();
    test_normals_in_a_plane();
    test_smoothness();
    test_support();
    return check_report();
}
