/* SPDX-License-Identifier: MIT */
/*
 * Every mesh, baked and evaluated at level 4, beside OpenSubdiv refined uniformly to level 4 and
 * projected to the limit in double precision: all 153 rows of every face within 3e-7 of the
 * diagonal.
 */
#include "../../baker/compare.h"
#include "../check.h"
#include "../mesh_files.h"

#include <stdlib.h>

static const double tolerance = 3e-7;
static double largest_of_all, largest_angle;

static bool bake(limn_baker *baker, const char *path, limn_pack *pack) {
    const void *blob;
    size_t size;
    return limn_baker_add_file(baker, path) == LIMN_BAKE_OK &&
           limn_baker_finish(baker, &blob, &size) == LIMN_BAKE_OK &&
           limn_pack_open(pack, blob, size) == LIMN_OK;
}

/// Returns whether the mesh could be baked.
static bool compare(const char *path, const limn_bake_desc *desc) {
    limn_baker *const baker = limn_baker_create(desc);
    limn_pack pack;
    const bool baked = bake(baker, path, &pack);
    if (baked) {
        const limn_mesh mesh = limn_pack_mesh(&pack, 0);
        limni_context context = {.desc = *desc};
        limni_comparison comparison;
        if (CHECK_EQUAL(limni_compare(&context, &pack, &mesh, path, &comparison), LIMN_BAKE_OK)) {
            printf("%-32s %8u faces  largest %.2e  mean %.2e  normals %.2e %.2e  degenerate %llu\n",
                   mesh.name, mesh.patch_count, comparison.largest, comparison.mean,
                   comparison.largest_angle, comparison.mean_angle,
                   (unsigned long long)comparison.degenerate_count);
            CHECK(comparison.largest <= tolerance);
            CHECK(comparison.largest_angle <= 1e-4 && comparison.mean_angle <= 2e-6);
            CHECK(comparison.normal_count > comparison.degenerate_count);
            if (comparison.largest_angle > largest_angle) largest_angle = comparison.largest_angle;
            CHECK(comparison.largest > 0); // two computations that are not the same one
            if (comparison.largest > largest_of_all) largest_of_all = comparison.largest;
        } else {
            fprintf(stderr, "    %s\n", context.error);
        }
        limni_release_all(&context);
    }
    limn_baker_destroy(baker);
    return baked;
}

static void visit(const char *path) {
    const limn_bake_desc strict = {.boundary = LIMN_BOUNDARY_EDGE_ONLY,
                                   .normals = LIMN_NORMALS_EXACT};
    const limn_bake_desc corners = {.boundary = LIMN_BOUNDARY_EDGE_AND_CORNER,
                                    .normals = LIMN_NORMALS_EXACT};
    const limn_bake_desc repaired = {.repair = LIMN_REPAIR_ALL, .normals = LIMN_NORMALS_EXACT};
    if (compare(path, &strict)) {
        if (strstr(path, "opensubdiv_shapes") || strstr(path, "sail")) compare(path, &corners);
    } else {
        CHECK(compare(path, &repaired));
    }
}

int main(void) {
    CHECK(mesh_files_visit(visit) > 0);
    printf("largest difference of all: %.2e of the diagonal, %.2e radians\n", largest_of_all,
           largest_angle);
    return check_report();
}
