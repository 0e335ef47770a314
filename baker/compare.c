/* SPDX-License-Identifier: MIT */
#include "compare.h"

#include "info.h"
#include "mesh.h"
#include "opensubdiv.h"

#include <float.h>
#include <math.h>
#include <string.h>

static limn_bake_status check_same(limni_context *context, const limn_mesh *mesh,
                                   const limni_mesh *source) {
    if (mesh->control_count != source->control_count || mesh->patch_count != source->face_count ||
        memcmp(mesh->controls, source->controls,
               source->control_count * sizeof *source->controls) != 0)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: mesh '%s' was baked from something else, or repaired differently",
                          source->path, mesh->name);
    return LIMN_BAKE_OK;
}

static limn_bake_status oracle(limni_context *context, const limn_pack *pack,
                               const limni_mesh *source, double (**limit)[3]) {
    char weights[32], boundary[32], error[512];
    limni_info_value(pack->info, "weights", weights, sizeof weights);
    limni_info_value(pack->info, "boundary", boundary, sizeof boundary);
    if (strcmp(weights, "loop") != 0)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "the file was baked with %s weights, which OpenSubdiv does not have",
                          weights);
    const limni_opensubdiv_mesh mesh = {
        .positions = source->controls[0],
        .faces = source->faces[0],
        .position_count = source->control_count,
        .face_count = source->face_count,
        .boundary = strcmp(boundary, "edge-and-corner") == 0 ? LIMN_BOUNDARY_EDGE_AND_CORNER
                                                             : LIMN_BOUNDARY_EDGE_ONLY,
        .level = LIMN_LEVEL_MAX,
    };
    const uint32_t row_count = limn_domain_get(LIMN_DOMAIN_TRIANGLE)->row_counts[LIMN_LEVEL_MAX];
    *limit = limni_allocate(context, (size_t)source->face_count * row_count, sizeof **limit);
    if (!*limit) return LIMN_BAKE_MEMORY;
    if (!limni_opensubdiv_limit(&mesh, *limit, error, sizeof error))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: OpenSubdiv: %s", source->path, error);
    return LIMN_BAKE_OK;
}

/// The row of the unrotated triangle at the same place as `row` of a patch that starts at corner
/// `rotation`.
static uint32_t unrotate(const limn_domain *domain, uint32_t row, uint32_t rotation) {
    uint32_t weights[3] = {0, domain->rows[row].i, domain->rows[row].j}; // of the patch's corners
    weights[0] = LIMN_GRID_SIZE - weights[1] - weights[2];
    const uint32_t i = weights[(1 + 3 - rotation) % 3], j = weights[(2 + 3 - rotation) % 3];
    uint32_t other = 0;
    while (domain->rows[other].i != i || domain->rows[other].j != j)
        other++;
    return other;
}

static double distance(const float *a, const double *b) {
    double sum = 0;
    for (int axis = 0; axis < 3; axis++)
        sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    return sqrt(sum);
}

static void compare_patch(const limn_mesh *mesh, uint32_t patch, const float (*vertices)[3],
                          const double (*limit)[3], uint32_t unrotated[3][256],
                          limni_comparison *comparison) {
    const uint32_t row_count = mesh->domain->row_counts[LIMN_LEVEL_MAX];
    const limn_patch_face face = limn_mesh_face(mesh, patch);
    for (uint32_t row = 0; row < row_count; row++) {
        const size_t other = (size_t)face.face * row_count + unrotated[face.rotation][row];
        const double difference =
            distance(vertices[(size_t)patch * row_count + row], limit[other]) /
            comparison->diagonal;
        comparison->mean += difference;
        // Written so that a difference which is not a number is the largest.
        if (!(difference <= comparison->largest)) {
            comparison->largest = difference;
            comparison->largest_face = face.face;
        }
    }
}

limn_bake_status limni_compare(limni_context *context, const limn_pack *pack, const limn_mesh *mesh,
                               const char *path, limni_comparison *comparison) {
    limni_source source = {0};
    limni_mesh built;
    double(*limit)[3] = NULL;
    LIMNI_TRY(limni_read_file(context, path, &source));
    LIMNI_TRY(limni_mesh_build(context, &source, &built));
    LIMNI_TRY(check_same(context, mesh, &built));
    LIMNI_TRY(oracle(context, pack, &built, &limit));

    const limn_plan plan = limn_plan_uniform(mesh, LIMN_LEVEL_MAX);
    float(*const vertices)[3] =
        limni_allocate(context, (size_t)plan.vertex_count, sizeof *vertices);
    if (!vertices) return LIMN_BAKE_MEMORY;
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count, &(limn_output){.vertices = vertices});

    uint32_t unrotated[3][256];
    for (uint32_t rotation = 0; rotation < 3; rotation++) {
        for (uint32_t row = 0; row < mesh->domain->row_counts[LIMN_LEVEL_MAX]; row++)
            unrotated[rotation][row] = unrotate(mesh->domain, row, rotation);
    }
    const float *const low = mesh->bounds_min;
    const double high[3] = {mesh->bounds_max[0], mesh->bounds_max[1], mesh->bounds_max[2]};
    *comparison =
        (limni_comparison){.diagonal = distance(low, high), .vertex_count = plan.vertex_count};
    for (int axis = 0; axis < 3; axis++) {
        const double reach = fmax(fabs((double)low[axis]), fabs(high[axis]));
        comparison->rounding += reach * (double)FLT_EPSILON / comparison->diagonal;
    }
    if (!(comparison->diagonal > 0))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: the mesh has no extent", path);
    for (uint32_t patch = 0; patch < plan.patch_count; patch++)
        compare_patch(mesh, patch, (const float(*)[3])vertices, (const double(*)[3])limit,
                      unrotated, comparison);
    comparison->mean /= (double)plan.vertex_count;
    return LIMN_BAKE_OK;
}
