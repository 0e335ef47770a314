/* SPDX-License-Identifier: MIT */
/*
 * Texture coordinates beside OpenSubdiv's, all rows of every face at level 4, in every mode of
 * face-varying interpolation, dense and isolated: within 1e-6 of their extent. The shapes of its
 * suite made for that, a textured character, a grid with random charts and tags, and a book, which
 * is no manifold at its spine.
 *
 * Not compared: two values that alternate around a vertex, of which OpenSubdiv counts the second
 * twice; and Chaikin's creasing at seams, where it also averages the edges of the other side.
 */
#include "../../baker/compare.h"
#include "../check.h"
#include "../mesh_files.h"

#include <math.h>
#include <stdlib.h>

static const double tolerance = 1e-6;
static double largest_of_all;

static bool bake(limn_baker *baker, const char *path, limn_pack *pack) {
    const void *blob;
    size_t size;
    return limn_baker_add_file(baker, path) == LIMN_BAKE_OK &&
           limn_baker_finish(baker, &blob, &size) == LIMN_BAKE_OK &&
           limn_pack_open(pack, blob, size) == LIMN_OK;
}

static void compare(const char *path, const limn_pack *pack, const limn_bake_desc *desc) {
    const limn_mesh mesh = limn_pack_mesh(pack, 0);
    limni_context context = {.desc = *desc};
    limni_channel_comparison comparison = {0};
    CHECK_EQUAL(mesh.channel_count, 1);
    if (!CHECK_EQUAL(limni_compare_channel(&context, pack, &mesh, 0, path, &comparison),
                     LIMN_BAKE_OK)) {
        fprintf(stderr, "    %s\n", context.error);
    } else if (!CHECK(comparison.largest <= tolerance) || !CHECK(comparison.value_count > 0)) {
        fprintf(stderr, "    %s, mode %d, isolate %d: %.2e at face %u\n", path,
                (int)desc->face_varying, (int)desc->isolate, comparison.largest,
                comparison.largest_face);
    }
    if (comparison.largest > largest_of_all) largest_of_all = comparison.largest;
    limni_release_all(&context);
}

/// All modes; alternately dense and isolated, with and without normals.
static void check_modes(const char *path, limn_scheme scheme) {
    for (int mode = LIMN_FACE_VARYING_NONE; mode <= LIMN_FACE_VARYING_ALL; mode++) {
        const limn_bake_desc desc = {.scheme = scheme,
                                     .face_varying = (limn_face_varying)mode,
                                     .isolate = mode % 2 ? LIMN_ISOLATE_NEVER : LIMN_ISOLATE_ALWAYS,
                                     .normals = mode % 3 ? LIMN_NORMALS_NONE : LIMN_NORMALS_EXACT,
                                     .non_manifold = LIMN_NON_MANIFOLD_SPLIT};
        limn_baker *const baker = limn_baker_create(&desc);
        limn_pack pack;
        if (CHECK(bake(baker, path, &pack))) compare(path, &pack, &desc);
        limn_baker_destroy(baker);
    }
}

static void visit(const char *path) {
    if (strstr(path, "fvar") || strstr(path, "spot_control_mesh"))
        check_modes(path, mesh_files_scheme(path));
}

// ---- Random charts and tags

enum { GRID = 4 };

static uint32_t random_state = 1;

static uint32_t next_random(uint32_t count) {
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) % count;
}

static void write_tags(FILE *file) {
    for (uint32_t v = 0; v < (GRID + 1) * (GRID + 1); v++) {
        const double sharpness = next_random(2) ? next_random(40) / 10.0 : 10;
        const uint32_t step = next_random(2) ? 1 : GRID + 1;
        if (next_random(2) || v % (GRID + 1) == GRID || v + step >= (GRID + 1) * (GRID + 1))
            continue;
        fprintf(file, "t crease 2/1/0 %u %u %.9g\n", v, v + step, sharpness);
        if (next_random(6) == 0) fprintf(file, "t corner 1/1/0 %u %.9g\n", v, sharpness);
    }
}

/// A grid whose columns are on charts, some of which are sewn at some of the vertices.
static void write_grid(const char *path) {
    FILE *const file = fopen(path, "w");
    const uint32_t count = (GRID + 1) * (GRID + 1);
    uint32_t charts[GRID + 1], sewn = next_random(1u << (GRID + 1));
    if (!file) abort();
    for (uint32_t c = 0; c <= GRID; c++)
        charts[c] = c == 0 ? 0 : charts[c - 1] + next_random(2);
    for (uint32_t v = 0; v < count; v++)
        fprintf(file, "v %u %u %u\n", v % (GRID + 1), v / (GRID + 1), v * v % 3);
    for (uint32_t t = 0; t < count * (GRID + 1); t++)
        fprintf(file, "vt %.9g %.9g\n", t % count % (GRID + 1) + 0.1 * next_random(8),
                t % count / (GRID + 1) + 0.1 * next_random(8));
    for (uint32_t f = 0; f < GRID * GRID; f++) {
        const uint32_t v = f / GRID * (GRID + 1) + f % GRID;
        const uint32_t corners[] = {v, v + 1, v + GRID + 2, v + GRID + 1};
        fprintf(file, "f");
        for (uint32_t c = 0; c < 4; c++) {
            const bool apart = sewn >> corners[c] / (GRID + 1) & 1;
            const uint32_t chart = apart ? charts[f % GRID] : 0;
            fprintf(file, " %u/%u", 1 + corners[c], 1 + chart * count + corners[c]);
        }
        fprintf(file, "\n");
    }
    write_tags(file);
    fclose(file);
}

static void test_random(void) {
    for (uint32_t round = 0; round < 2; round++) {
        write_grid("charts.obj");
        check_modes("charts.obj", LIMN_SCHEME_CATMARK);
        check_modes("charts.obj", LIMN_SCHEME_LOOP);
    }
}

// ---- Pages that share a spine

/// Of four rows, two columns from the spine. Some pages are on a chart of their own, all of which
/// are sewn together at some of the vertices of the spine.
static void write_book(const char *path, uint32_t page_count) {
    enum { ROWS = 4, COLUMNS = 2 };
    FILE *const file = fopen(path, "w");
    if (!file) abort();
    const uint32_t spine = 1 + ROWS, page_size = spine * COLUMNS;
    const uint32_t count = spine + page_count * page_size, sewn = next_random(1u << spine);
    for (uint32_t v = 0; v < count; v++) {
        const double turn = v < spine ? 0 : 2 * (v - spine) / page_size;
        const double far = v < spine ? 0 : 1 + (v - spine) % page_size / spine;
        fprintf(file, "v %.9g %.9g %u\n", far * cos(turn), far * sin(turn),
                v < spine ? v : (v - spine) % spine);
    }
    for (uint32_t t = 0; t < count * (1 + page_count); t++)
        fprintf(file, "vt %.9g %.9g\n", t % count * 0.7 + 0.1 * next_random(8),
                t % count % spine + 0.1 * next_random(8));
    for (uint32_t page = 0; page < page_count; page++) {
        const uint32_t chart = next_random(2) ? 1 + page : 0;
        for (uint32_t f = 0; f < ROWS * COLUMNS; f++) {
            const uint32_t row = f % ROWS, column = f / ROWS, first = spine + page * page_size;
            const uint32_t near = column == 0 ? row : first + (column - 1) * spine + row;
            const uint32_t corners[] = {near, first + column * spine + row,
                                        first + column * spine + row + 1, near + 1};
            fprintf(file, "f");
            for (uint32_t c = 0; c < 4; c++) {
                const bool common = corners[c] < spine && sewn >> corners[c] & 1;
                fprintf(file, " %u/%u", 1 + corners[c],
                        1 + (common ? 0 : chart) * count + corners[c]);
            }
            fprintf(file, "\n");
        }
    }
    fclose(file);
}

static void test_books(void) {
    for (uint32_t page_count = 3; page_count <= 6; page_count++) {
        write_book("book.obj", page_count);
        check_modes("book.obj", LIMN_SCHEME_CATMARK);
        check_modes("book.obj", LIMN_SCHEME_LOOP);
    }
}

int main(void) {
    mesh_files_visit(visit);
    test_random();
    test_books();
    printf("largest difference %.2e\n", largest_of_all);
    return check_report();
}
