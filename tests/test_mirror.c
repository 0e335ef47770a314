/* SPDX-License-Identifier: MIT */
/* Which classes are found to be their own mirror images. */
#include "check.h"
#include "limn/bake.h"
#include "limn/format.h"
#include "limn/limn.h"

#include <stdlib.h>

typedef struct baked {
    limn_baker *baker;
    limn_pack pack;
    limn_mesh mesh;
} baked;

static baked bake(const float (*positions)[3], uint32_t position_count, const uint32_t *faces,
                  uint32_t face_count, limn_normals normals) {
    baked b = {.baker = limn_baker_create(&(limn_bake_desc){.normals = normals})};
    const void *blob;
    size_t size;
    CHECK_EQUAL(limn_baker_add_mesh(b.baker, &(limn_bake_mesh){.name = "made",
                                                               .positions = positions[0],
                                                               .position_count = position_count,
                                                               .face_count = face_count,
                                                               .face_indices = faces}),
                LIMN_BAKE_OK);
    CHECK_EQUAL(limn_baker_finish(b.baker, &blob, &size), LIMN_BAKE_OK);
    CHECK_EQUAL(limn_pack_open(&b.pack, blob, size), LIMN_OK);
    b.mesh = limn_pack_mesh(&b.pack, 0);
    return b;
}

/// A torus of 8 by 8 points, all of valence 6: one class of 12 points, of which two lie on the
/// mirror line.
static void test_regular(limn_normals normals) {
    enum { SIDE = 8 };
    float positions[SIDE * SIDE][3];
    uint32_t faces[SIDE * SIDE][6];
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t x = i % SIDE, y = i / SIDE, right = (x + 1) % SIDE, up = (y + 1) % SIDE;
        const uint32_t corners[6] = {
            i, SIDE * y + right, SIDE * up + x, SIDE * y + right, SIDE * up + right, SIDE * up + x};
        memcpy(faces[i], corners, sizeof corners);
        for (uint32_t axis = 0; axis < 3; axis++)
            positions[i][axis] = (float)((i * (7 + 4 * axis)) % 61);
    }
    const baked b =
        bake((const float(*)[3])positions, SIDE * SIDE, faces[0], 2 * SIDE * SIDE, normals);
    CHECK_EQUAL(b.pack.class_count, 1);
    CHECK_EQUAL(b.pack.classes[0].control_count, 12);
    CHECK_EQUAL(b.pack.classes[0].pair_count, 5);
    CHECK_EQUAL(b.pack.classes[0].table_count, normals == LIMN_NORMALS_EXACT ? 3 : 1);
    limn_baker_destroy(b.baker);
}

/// Two pyramids back to back over a polygon: valences n, 4 and 4, the apex on the mirror line.
static void test_bipyramid(uint32_t n, uint32_t expected_pairs) {
    float(*const positions)[3] = calloc(n + 2, sizeof *positions);
    uint32_t(*const faces)[3] = calloc(2 * n, sizeof *faces);
    for (uint32_t v = 0; v < n; v++) {
        positions[v][0] = (float)(v * 13 % n);
        positions[v][1] = (float)(v * 29 % 31);
        const uint32_t next = (v + 1) % n;
        faces[2 * v][0] = v, faces[2 * v][1] = next, faces[2 * v][2] = n;
        faces[2 * v + 1][0] = next, faces[2 * v + 1][1] = v, faces[2 * v + 1][2] = n + 1;
    }
    positions[n][2] = 1, positions[n + 1][2] = -1;
    const baked b = bake((const float(*)[3])positions, n + 2, faces[0], 2 * n, LIMN_NORMALS_EXACT);
    CHECK_EQUAL(b.pack.class_count, 1);
    CHECK_EQUAL(b.pack.classes[0].control_count, n + 2);
    CHECK_EQUAL(b.pack.classes[0].pair_count, expected_pairs);
    CHECK_EQUAL(b.pack.classes[0].valences[0], n == 4 ? 4 : n);
    limn_baker_destroy(b.baker);
    free(positions);
    free(faces);
}

/// Classes whose corners have three valences are never mirrored, and the same ones with and without
/// normals are.
static void test_file(const char *name) {
    char path[4096];
    uint32_t mirrored[2] = {0, 0}, count[2];
    snprintf(path, sizeof path, "%s/%s", getenv("LIMN_ASSETS"), name);
    for (int n = 0; n < 2; n++) {
        limn_baker *const baker = limn_baker_create(&(limn_bake_desc){.normals = (limn_normals)n});
        limn_pack pack;
        const void *blob;
        size_t size;
        CHECK_EQUAL(limn_baker_add_file(baker, path), LIMN_BAKE_OK);
        CHECK_EQUAL(limn_baker_finish(baker, &blob, &size), LIMN_BAKE_OK);
        CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK);
        count[n] = pack.class_count;
        for (uint32_t c = 0; c < pack.class_count; c++) {
            const uint16_t *const v = pack.classes[c].valences;
            const bool distinct = v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
            mirrored[n] += pack.classes[c].pair_count > 0;
            if (distinct) CHECK_EQUAL(pack.classes[c].pair_count, 0);
        }
        limn_baker_destroy(baker);
    }
    CHECK(mirrored[0] > 0 && mirrored[0] < count[0]);
    CHECK(mirrored[0] == mirrored[1] && count[0] == count[1]);
}

int main(void) {
    test_regular(LIMN_NORMALS_NONE);
    test_regular(LIMN_NORMALS_EXACT);
    // Vertices far around the apex have a say through it alone, and count as their own images.
    test_bipyramid(5, 2);
    test_bipyramid(21, 5);
    test_bipyramid(22, 5); // 24 control points, the most that a mirrored class may have
    test_bipyramid(23, 0);
    test_file("imp.obj");
    return check_report();
}
