/* SPDX-License-Identifier: MIT */
/*
 * Every mesh, baked and evaluated at level 4, beside OpenSubdiv's limit in double precision: all
 * 153 rows of every face within 3e-7 of the diagonal. Tags and all; and random tags.
 *
 * Isolated, too. There the points of level 1 are rounded to floats, which moves the ends of
 * tangents by about as much as a coordinate is rounded: normals turn by that, divided by the size
 * of the face, up to 1e-2 radians on slivers. Positions of meshes far from 0 are rounded twice.
 */
#include "../../baker/compare.h"
#include "../../baker/source.h"
#include "../check.h"
#include "../mesh_files.h"

#include <math.h>
#include <stdlib.h>

static const double tolerance = 3e-7;
static double largest_of_all, largest_turn;
static double largest_angles[2]; ///< by limn_isolate

enum { ISOLATED_MAX = 1000 }; ///< faces of meshes that are compared isolated, too: to save time

static bool bake(limn_baker *baker, const char *path, limn_pack *pack) {
    const void *blob;
    size_t size;
    return limn_baker_add_file(baker, path) == LIMN_BAKE_OK &&
           limn_baker_finish(baker, &blob, &size) == LIMN_BAKE_OK &&
           limn_pack_open(pack, blob, size) == LIMN_OK;
}

static void keep_larger(double *largest, double value) {
    if (value > *largest) *largest = value;
}

static void check(const limn_mesh *mesh, limn_isolate isolate, const limni_comparison *comparison) {
    printf("%-32s %8u faces %s  largest %.2e  mean %.2e  normals %.2e %.2e %.2e  degenerate %llu\n",
           mesh->name, mesh->patch_count, isolate ? "isolated" : "dense   ", comparison->largest,
           comparison->mean, comparison->largest_angle, comparison->mean_angle,
           comparison->largest_turn, (unsigned long long)comparison->degenerate_count);
    if (mesh->domain->kind == LIMN_DOMAIN_QUAD) {
        // Chessmen of tiny faces; the others stay within 1.1e-4.
        CHECK(comparison->largest <= tolerance + comparison->rounding);
        CHECK(comparison->largest_angle <= 1.5e-3 && comparison->mean_angle <= 7e-6);
    } else if (isolate) {
        CHECK(comparison->largest <= fmax(tolerance, comparison->rounding));
        CHECK(comparison->largest_turn <= comparison->rounding && comparison->mean_angle <= 5e-6);
    } else {
        CHECK(comparison->largest <= tolerance);
        CHECK(comparison->largest_angle <= 1e-4 && comparison->mean_angle <= 2e-6);
    }
    CHECK(comparison->normal_count > comparison->degenerate_count);
    CHECK(comparison->largest > 0); // two computations that are not the same one
    keep_larger(&largest_of_all, comparison->largest);
    keep_larger(&largest_turn, comparison->largest_turn);
    keep_larger(&largest_angles[isolate], comparison->largest_angle);
}

/// Returns the number of patches, 0 if the mesh could not be baked.
static uint32_t compare_as(const char *path, const limn_bake_desc *desc) {
    limn_baker *const baker = limn_baker_create(desc);
    uint32_t patch_count = 0;
    limn_pack pack;
    if (bake(baker, path, &pack)) {
        const limn_mesh mesh = limn_pack_mesh(&pack, 0);
        limni_context context = {.desc = *desc};
        limni_comparison comparison;
        if (CHECK_EQUAL(limni_compare(&context, &pack, &mesh, path, &comparison), LIMN_BAKE_OK)) {
            check(&mesh, desc->isolate, &comparison);
        } else {
            fprintf(stderr, "    %s\n", context.error);
        }
        limni_release_all(&context);
        patch_count = mesh.patch_count;
    }
    limn_baker_destroy(baker);
    return patch_count;
}

/// Returns whether the mesh could be baked.
static bool compare(const char *path, const limn_bake_desc *desc) {
    limn_bake_desc isolated = *desc;
    const uint32_t patch_count = compare_as(path, desc);
    isolated.isolate = LIMN_ISOLATE_ALWAYS;
    if (patch_count > 0 && patch_count <= ISOLATED_MAX) CHECK(compare_as(path, &isolated) > 0);
    return patch_count > 0;
}

static void visit(const char *path) {
    const limn_bake_desc strict = {.boundary = LIMN_BOUNDARY_EDGE_ONLY,
                                   .normals = LIMN_NORMALS_EXACT};
    const limn_bake_desc corners = {.boundary = LIMN_BOUNDARY_EDGE_AND_CORNER,
                                    .normals = LIMN_NORMALS_EXACT};
    const limn_bake_desc repaired = {.repair = LIMN_REPAIR_ALL,
                                     .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                                     .normals = LIMN_NORMALS_EXACT};
    const limn_bake_desc quads = {.scheme = mesh_files_scheme(path),
                                  .repair = LIMN_REPAIR_DROP,
                                  .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                                  .normals = LIMN_NORMALS_EXACT};
    if (compare(path, &strict)) {
        if (strstr(path, "loop_") || strstr(path, "sail")) compare(path, &corners);
    } else {
        CHECK(compare(path, &repaired));
    }
    if (quads.scheme != LIMN_SCHEME_LOOP) CHECK(compare(path, &quads));
}

// ---- Random tags

static uint32_t random_state = 1;

static uint32_t next_random(uint32_t count) {
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) % count;
}

/// For ever, of whole levels, below 1, or any.
static double random_sharpness(bool chaikin) {
    const uint32_t most = chaikin ? 4 : 9; // Chaikin's method is compared by uniform refinement
    switch (next_random(4)) {
    case 0:
        return 10;
    case 1:
        return 1 + next_random(most);
    case 2:
        return next_random(1000) / 1000.0;
    default:
        return next_random(most * 1000) / 1000.0;
    }
}

static void write_tags(FILE *file, const limni_source *source, bool chaikin) {
    const uint32_t one_in = 2 + next_random(8);
    if (chaikin) fprintf(file, "t creasemethod 0/0/1 chaikin\n");
    fprintf(file, "t interpolateboundary 1/0/0 %u\n", 1 + next_random(2));
    for (uint32_t c = 0; c + 1 < source->face_offsets[source->face_count]; c++) {
        if (next_random(one_in) || (c + 1) % 3 == 0) continue;
        fprintf(file, "t crease 2/1/0 %u %u %.9g\n", source->face_corners[c],
                source->face_corners[c + 1], random_sharpness(chaikin));
    }
    for (uint32_t v = 0; v < source->position_count; v++) {
        if (next_random(10)) continue;
        fprintf(file, "t corner 1/1/0 %u %.9g\n", v, random_sharpness(chaikin));
    }
    fprintf(file, "t hole 1/0/0 %u\n", next_random(source->face_count));
}

/// A mesh of triangles with tags of its own.
static void test_random_tags(const char *path, bool chaikin) {
    static const char tagged[] = "test_limit_tagged.obj";
    limni_context context = {0};
    limni_source source = {0};
    FILE *const file = fopen(tagged, "w");
    if (!CHECK(file) || !CHECK_EQUAL(limni_read_file(&context, path, &source), LIMN_BAKE_OK))
        return;
    for (uint32_t v = 0; v < source.position_count; v++) {
        const float *const at = source.positions[v];
        fprintf(file, "v %.9g %.9g %.9g\n", (double)at[0], (double)at[1], (double)at[2]);
    }
    for (uint32_t c = 0; c < source.face_offsets[source.face_count]; c++)
        fprintf(file, "%s%u", c % 3 ? " " : "\nf ", source.face_corners[c] + 1);
    fprintf(file, "\n");
    write_tags(file, &source, chaikin);
    const int closed = fclose(file);
    CHECK(closed == 0);
    const limn_bake_desc exact = {.normals = LIMN_NORMALS_EXACT};
    CHECK(compare(tagged, &exact));
    remove(tagged);
    limni_release_all(&context);
}

int main(void) {
    char path[4096];
    CHECK(mesh_files_visit(visit) > 0);
    snprintf(path, sizeof path, "%s/sail.obj", getenv("LIMN_ASSETS"));
    for (int round = 0; round < 8; round++)
        test_random_tags(path, round % 2);
    printf("largest difference of all: %.2e of the diagonal; normals %.2e radians, isolated %.2e, "
           "%.2e of the diagonal\n",
           largest_of_all, largest_angles[0], largest_angles[1], largest_turn);
    return check_report();
}
