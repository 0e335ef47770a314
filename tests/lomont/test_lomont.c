/* SPDX-License-Identifier: MIT */
/* Lomont's rules against themselves and against what is known of their surfaces. */
#include "../check.h"
#include "tagged.h"

#include <stdlib.h>

enum { SEED_COUNT = 30 };

typedef double vector[3];

static lomont_mesh tagged(uint64_t seed, bool finite) {
    random_mesh random = random_mesh_make(seed, seed % 2 == 1);
    random_mesh_tag(&random, finite);
    return lomont_from_random(&random);
}

static vector *allocate_vectors(int count) {
    vector *const vectors = malloc((size_t)count * sizeof *vectors);
    if (!vectors) abort();
    return vectors;
}

static double distance(const double *a, const double *b) {
    double square = 0;
    for (int axis = 0; axis < 3; axis++)
        square += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    return sqrt(square);
}

static int start(const lomont_mesh *mesh, int h) {
    return mesh->faces[h / 3][h % 3];
}

static int end(const lomont_mesh *mesh, int h) {
    return mesh->faces[h / 3][(h + 1) % 3];
}

// ---- Structure

static void check_half_edges(const lomont_mesh *mesh) {
    int boundary_count = 0;
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        const lomont_half_edge *const half = &mesh->half_edges[h];
        if (half->pair == -1) {
            boundary_count++;
            CHECK(isinf(half->weight));
            CHECK_EQUAL(mesh->vertices[end(mesh, h)].half_edge, h);
            continue;
        }
        CHECK_EQUAL(mesh->half_edges[half->pair].pair, h);
        CHECK(mesh->half_edges[half->pair].weight == half->weight);
        CHECK(start(mesh, h) == end(mesh, half->pair) && end(mesh, h) == start(mesh, half->pair));
    }
    CHECK_EQUAL(2 * mesh->edge_count, 3 * mesh->face_count + boundary_count);
    for (int v = 0; v < mesh->vertex_count; v++)
        CHECK_EQUAL(end(mesh, mesh->vertices[v].half_edge), v);
}

static void test_structure(void) {
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        lomont_mesh mesh = tagged(seed, true);
        const int characteristic = mesh.vertex_count - mesh.edge_count + mesh.face_count;
        for (int level = 0; level < 3; level++) {
            check_half_edges(&mesh);
            CHECK_EQUAL(mesh.vertex_count - mesh.edge_count + mesh.face_count, characteristic);
            lomont_refine(&mesh, 1);
        }
        lomont_destroy(&mesh);
    }
}

// ---- Masks

/// An affine map with a large translation, which only masks that sum to 1 leave alone.
static void map(const double *p, double *mapped) {
    mapped[0] = 100 + p[0] + 2 * p[1] - p[2];
    mapped[1] = -50 + p[1] / 2 + 3 * p[2];
    mapped[2] = 70 - p[0] + p[2];
}

static void test_affine_invariance(void) {
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        lomont_mesh plain = tagged(seed, true), moved = tagged(seed, true);
        for (int v = 0; v < plain.vertex_count; v++)
            map(plain.vertices[v].position, moved.vertices[v].position);
        lomont_refine(&plain, 2);
        lomont_refine(&moved, 2);
        vector *const limits = allocate_vectors(plain.vertex_count);
        vector *const moved_limits = allocate_vectors(plain.vertex_count);
        lomont_limits(&plain, limits);
        lomont_limits(&moved, moved_limits);
        for (int v = 0; v < plain.vertex_count; v++) {
            vector position, limit;
            map(plain.vertices[v].position, position);
            map(limits[v], limit);
            CHECK(distance(position, moved.vertices[v].position) < 1e-12);
            CHECK(distance(limit, moved_limits[v]) < 1e-12);
        }
        free(limits);
        free(moved_limits);
        lomont_destroy(&plain);
        lomont_destroy(&moved);
    }
}

/// Table 2 in other words: what is new on a sharp edge, from the types of its ends.
static void expect_on_sharp_edge(const lomont_mesh *mesh, int h, double *expected) {
    const lomont_type a = lomont_vertex_type(mesh, start(mesh, h));
    const lomont_type b = lomont_vertex_type(mesh, end(mesh, h));
    const int pair = mesh->half_edges[h].pair;
    const bool smooth = a == LOMONT_DART || b == LOMONT_DART;
    double from_a = 4, from_b = 4;
    if (smooth) from_a = from_b = 3;
    if (!smooth && a == LOMONT_REGULAR && b != LOMONT_REGULAR) from_a = 5, from_b = 3;
    if (!smooth && b == LOMONT_REGULAR && a != LOMONT_REGULAR) from_a = 3, from_b = 5;
    for (int axis = 0; axis < 3; axis++) {
        expected[axis] = (from_a * mesh->vertices[start(mesh, h)].position[axis] +
                          from_b * mesh->vertices[end(mesh, h)].position[axis]) /
                         8;
        for (int side = 0; smooth && side < 2; side++) {
            const int across = mesh->faces[(side ? pair : h) / 3][((side ? pair : h) + 2) % 3];
            expected[axis] += mesh->vertices[across].position[axis] / 8;
        }
    }
}

static void test_table_2(void) {
    int seen[5][5] = {{0}};
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        lomont_mesh mesh = tagged(seed, true), finer = lomont_subdivide(&mesh);
        for (int h = 0; h < 3 * mesh.face_count; h++) {
            if (mesh.half_edges[h].weight < 1) continue;
            const int middle = finer.faces[4 * (h / 3) + 3][(h + 1) % 3];
            vector expected;
            expect_on_sharp_edge(&mesh, h, expected);
            CHECK(distance(expected, finer.vertices[middle].position) < 1e-14);
            seen[lomont_vertex_type(&mesh, start(&mesh, h))]
                [lomont_vertex_type(&mesh, end(&mesh, h))]++;
        }
        lomont_destroy(&mesh);
        lomont_destroy(&finer);
    }
    for (int a = LOMONT_DART; a <= LOMONT_CORNER; a++) {
        for (int b = LOMONT_DART; b <= LOMONT_CORNER; b++)
            CHECK(seen[a][b] > 0);
    }
}

// ---- Limits

/// How many sharp edges each vertex has.
static int *count_sharp_edges(const lomont_mesh *mesh) {
    int *const counts = calloc((size_t)mesh->vertex_count, sizeof *counts);
    if (!counts) abort();
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        if (mesh->half_edges[h].weight < 1 || mesh->half_edges[h].pair > h) continue;
        counts[start(mesh, h)]++;
        counts[end(mesh, h)]++;
    }
    return counts;
}

static double largest_step, largest_turn;

/// Limits and normals of a level and of the next: the masks are left eigenvectors.
static void check_next_level(const lomont_mesh *mesh) {
    lomont_mesh finer = lomont_subdivide(mesh);
    vector *const limits = allocate_vectors(mesh->vertex_count);
    vector *const finer_limits = allocate_vectors(finer.vertex_count);
    vector *const normals = allocate_vectors(3 * mesh->face_count);
    vector *const finer_normals = allocate_vectors(3 * finer.face_count);
    lomont_limits(mesh, limits);
    lomont_limits(&finer, finer_limits);
    lomont_normals(mesh, normals);
    lomont_normals(&finer, finer_normals);
    int *const sharp_counts = count_sharp_edges(mesh);
    for (int v = 0; v < mesh->vertex_count; v++) {
        const double step = distance(limits[v], finer_limits[v]);
        CHECK(step < 1e-13);
        largest_step = fmax(step, largest_step);
    }
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        const int v = start(mesh, h);
        // A corner without sides has no normal.
        if (sharp_counts[v] < 2 && mesh->vertices[v].weight >= 1) continue;
        const double turn = distance(normals[h], finer_normals[3 * (4 * (h / 3) + h % 3) + 1]);
        CHECK(turn < 1e-10);
        largest_turn = fmax(turn, largest_turn);
    }
    free(sharp_counts);
    free(limits);
    free(finer_limits);
    free(normals);
    free(finer_normals);
    lomont_destroy(&finer);
}

static void test_limits(void) {
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        lomont_mesh mesh = tagged(seed, seed % 4 < 2);
        while (!lomont_is_settled(&mesh))
            lomont_refine(&mesh, 1);
        check_next_level(&mesh);
        lomont_destroy(&mesh);
    }
    printf("one more level: limits move by %.1e, normals by %.1e\n", largest_step, largest_turn);
}

/// Adds what the sharp edge of h gives to the limit of its end, a regular vertex: 1/6 of its start,
/// but something else if that is not regular.
static void add_along_crease(const lomont_mesh *mesh, int h, bool backwards, double *limit) {
    const lomont_vertex *const v = mesh->vertices;
    const int other = backwards ? end(mesh, h) : start(mesh, h);
    const int at = backwards ? start(mesh, h) : end(mesh, h);
    const lomont_type type = lomont_vertex_type(mesh, other);
    for (int axis = 0; axis < 3; axis++) {
        limit[axis] += v[other].position[axis] / 6;
        if (type == LOMONT_REGULAR) continue;
        limit[axis] -= v[other].position[axis] / 48;
        limit[axis] += (type == LOMONT_DART ? -1 : 1) * v[at].position[axis] / 48;
        if (type != LOMONT_DART) continue;
        const int pair = mesh->half_edges[h].pair;
        limit[axis] += v[mesh->faces[h / 3][(h + 2) % 3]].position[axis] / 48;
        limit[axis] += v[mesh->faces[pair / 3][(pair + 2) % 3]].position[axis] / 48;
    }
}

/// Limits of regular vertices, also beside others, from the mesh itself.
static void test_limits_along_creases(void) {
    int seen[LOMONT_CORNER + 1] = {0};
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        lomont_mesh mesh = tagged(seed, false);
        lomont_refine(&mesh, 1 + (int)(seed % 2));
        vector *const limits = allocate_vectors(mesh.vertex_count);
        vector *const expected = allocate_vectors(mesh.vertex_count);
        lomont_limits(&mesh, limits);
        for (int v = 0; v < mesh.vertex_count; v++) {
            for (int axis = 0; axis < 3; axis++)
                expected[v][axis] = 2 * mesh.vertices[v].position[axis] / 3;
        }
        for (int h = 0; h < 3 * mesh.face_count; h++) {
            if (mesh.half_edges[h].weight < 1 || mesh.half_edges[h].pair > h) continue;
            add_along_crease(&mesh, h, false, expected[end(&mesh, h)]);
            add_along_crease(&mesh, h, true, expected[start(&mesh, h)]);
            seen[lomont_vertex_type(&mesh, start(&mesh, h))]++;
        }
        for (int v = 0; v < mesh.vertex_count; v++) {
            if (lomont_vertex_type(&mesh, v) == LOMONT_REGULAR)
                CHECK(distance(expected[v], limits[v]) < 1e-13);
        }
        free(limits);
        free(expected);
        lomont_destroy(&mesh);
    }
    for (int type = LOMONT_DART; type <= LOMONT_CORNER; type++)
        CHECK(seen[type] > 0);
}

/// A vertex with `count` neighbours in a plane, all around or in less than half of it.
static lomont_mesh fan(uint64_t seed, uint32_t count, bool closed) {
    random_mesh random = {.state = seed};
    const double turn = (closed ? 2 : 1) * acos(-1) / count;
    random_mesh_add_vertex(&random, 0, 0, 0);
    for (uint32_t r = 0; r < count; r++) {
        const double angle = turn * (r + (double)random_float(&random) / 8);
        random_mesh_add_vertex(&random, (float)cos(angle), (float)sin(angle), 0);
        const uint32_t next = 1 + (r + 1) % count;
        if (closed || r + 1 < count) random_mesh_add_face(&random, 0, 1 + r, next);
    }
    return lomont_from_random(&random);
}

static void check_fan_normals(lomont_mesh *mesh) {
    static const vector up = {0, 0, 1};
    lomont_refine(mesh, 2);
    vector *const normals = allocate_vectors(3 * mesh->face_count);
    lomont_normals(mesh, normals);
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        if (start(mesh, h) == 0) CHECK(distance(normals[h], up) < 1e-12);
    }
    free(normals);
    lomont_destroy(mesh);
}

/// In a plane all normals are that of the plane, not its opposite: smooth, on boundaries and on
/// each side of creases, with any number of neighbours.
static void test_normals_in_a_plane(void) {
    for (uint32_t count = 3; count <= 12; count++) {
        lomont_mesh mesh = fan(count, count, true);
        check_fan_normals(&mesh);
        mesh = fan(count, count - 1, false);
        check_fan_normals(&mesh);
        for (uint32_t end = 1; end < count; end++) {
            mesh = fan(count, count, true);
            CHECK(lomont_set_edge_weight(&mesh, 0, 1, (double)INFINITY));
            CHECK(lomont_set_edge_weight(&mesh, 0, 1 + (int)end, (double)INFINITY));
            check_fan_normals(&mesh);
        }
    }
}

// ---- Known surfaces

enum { AROUND = 7, ALONG = 5 };

/// A tube with a sharp ring in the middle, of regular crease vertices.
static lomont_mesh ringed_tube(void) {
    random_mesh random = {.state = 5};
    random_mesh_tube(&random, AROUND, ALONG, true);
    for (uint32_t x = 0; x < AROUND; x++)
        random_mesh_crease(&random, 2 * AROUND + x, 2 * AROUND + (x + 1) % AROUND, INFINITY);
    return lomont_from_random(&random);
}

/// The uniform cubic B-spline over a closed ring of a tube, at 0 <= t < AROUND.
static void evaluate_spline(const lomont_vertex *ring, double t, double *point) {
    const int span = (int)t;
    const double u = t - span, v = 1 - u;
    const double weights[4] = {v * v * v / 6, (3 * u * u * (u - 2) + 4) / 6,
                               (3 * v * v * (v - 2) + 4) / 6, u * u * u / 6};
    for (int axis = 0; axis < 3; axis++) {
        point[axis] = 0;
        for (int i = 0; i < 4; i++)
            point[axis] += weights[i] * ring[(span + AROUND - 1 + i) % AROUND].position[axis];
    }
}

/// The next vertex after `from` along a sharp edge, other than `before`.
static int next_on_crease(const lomont_mesh *mesh, int from, int before) {
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        if (mesh->half_edges[h].weight < 1) continue;
        if (start(mesh, h) == from && end(mesh, h) != before) return end(mesh, h);
        if (end(mesh, h) == from && start(mesh, h) != before) return start(mesh, h);
    }
    return -1;
}

static void test_regular_creases_are_splines(void) {
    enum { LEVEL = 3, STEPS = 1 << LEVEL };
    lomont_mesh base = ringed_tube(), mesh = ringed_tube();
    lomont_refine(&mesh, LEVEL);
    vector *const limits = allocate_vectors(mesh.vertex_count);
    lomont_limits(&mesh, limits);
    for (int ring = 0; ring < ALONG; ring += 2) {
        const int first = ring * AROUND;
        int before = -1, at = first;
        vector point;
        // Either way around: the spline is taken at t or at AROUND - t.
        const int second = next_on_crease(&mesh, first, -1);
        evaluate_spline(base.vertices + first, 1. / STEPS, point);
        const bool forwards = distance(point, limits[second]) < 1e-13;
        for (int step = 0; step < AROUND * STEPS; step++) {
            const double t = (double)step / STEPS;
            evaluate_spline(base.vertices + first, forwards || step == 0 ? t : AROUND - t, point);
            CHECK(distance(point, limits[at]) < 1e-13);
            const int next = next_on_crease(&mesh, at, before);
            before = at;
            at = next;
        }
        CHECK_EQUAL(at, first);
    }
    free(limits);
    lomont_destroy(&base);
    lomont_destroy(&mesh);
}

/// What happens on one side of a sharp ring is not felt on the other, nor on the ring.
static void test_sharp_creases_split(void) {
    lomont_mesh mesh = ringed_tube(), moved = ringed_tube();
    const int first_moved = 3 * AROUND;
    for (int v = first_moved; v < moved.vertex_count; v++)
        moved.vertices[v].position[2] += 10;
    const int unmoved_faces = 2 * AROUND * 2;
    const int face_count = mesh.face_count;
    lomont_refine(&mesh, 3);
    lomont_refine(&moved, 3);
    int moved_count = 0;
    for (int h = 0; h < 3 * mesh.face_count; h++) {
        const int v = start(&mesh, h);
        const double difference = distance(mesh.vertices[v].position, moved.vertices[v].position);
        if (h / 3 < unmoved_faces * mesh.face_count / face_count) CHECK(difference == 0);
        moved_count += difference > 0;
    }
    CHECK(moved_count > mesh.face_count);
    lomont_destroy(&mesh);
    lomont_destroy(&moved);
}

/// A vertex of weight w stays for as many levels as w has ones, and moves a part of the way at the
/// next.
static void test_corners_stay(void) {
    for (double weight = 0; weight <= 3; weight += 0.25) {
        random_mesh random = random_mesh_make(8, false);
        lomont_mesh mesh = lomont_from_random(&random);
        mesh.vertices[0].weight = weight;
        vector before;
        for (int level = 0; level < 4; level++) {
            memcpy(before, mesh.vertices[0].position, sizeof before);
            const double left = mesh.vertices[0].weight;
            lomont_mesh smooth = lomont_subdivide(&mesh);
            mesh.vertices[0].weight = 0;
            lomont_mesh free_mesh = lomont_subdivide(&mesh);
            const double way = distance(before, free_mesh.vertices[0].position);
            const double gone = distance(before, smooth.vertices[0].position);
            CHECK_NEAR(gone, way * fmax(1 - left, 0), 1e-13);
            CHECK(left == fmax(weight - level, 0));
            lomont_destroy(&free_mesh);
            lomont_destroy(&mesh);
            mesh = smooth;
        }
        lomont_destroy(&mesh);
    }
}

/// Points on edges are continuous in the weight of a crease, at 0 and at 1.
static void test_fractional_edges(void) {
    static const double weights[] = {0, 1e-9, 1 - 1e-9, 1};
    vector points[4];
    for (uint64_t seed = 0; seed < SEED_COUNT; seed++) {
        random_mesh random = random_mesh_make(seed, false);
        random_mesh_tag(&random, false);
        const uint32_t *const ends = random.creases[0].ends;
        for (int w = 0; w < 4; w++) {
            lomont_mesh mesh = lomont_from_random(&random);
            for (uint32_t c = 0; c < random.crease_count; c++)
                lomont_set_edge_weight(&mesh, (int)random.creases[c].ends[0],
                                       (int)random.creases[c].ends[1], weights[w]);
            int h = 0;
            while (start(&mesh, h) != (int)ends[0] || end(&mesh, h) != (int)ends[1])
                h++;
            lomont_refine(&mesh, 1);
            const int middle = mesh.faces[4 * (h / 3) + 3][(h + 1) % 3];
            memcpy(points[w], mesh.vertices[middle].position, sizeof points[w]);
            lomont_destroy(&mesh);
        }
        CHECK(distance(points[0], points[1]) < 1e-7);
        CHECK(distance(points[2], points[3]) < 1e-7);
    }
}

int main(void) {
    test_structure();
    test_affine_invariance();
    test_table_2();
    test_limits();
    test_limits_along_creases();
    test_normals_in_a_plane();
    test_regular_creases_are_splines();
    test_sharp_creases_split();
    test_corners_stay();
    test_fractional_edges();
    return check_report();
}
