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
    if (mesh->control_count != source->control_count || mesh->face_count != source->face_count ||
        memcmp(mesh->controls, source->controls,
               source->control_count * sizeof *source->controls) != 0)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: mesh '%s' was baked from something else, or repaired differently",
                          source->path, mesh->name);
    return LIMN_BAKE_OK;
}

/// OpenSubdiv's surface: [face_count][153] of each.
typedef struct answer {
    double (*limit)[3];
    double (*tangents)[2][3]; ///< NULL for a mesh without normals
} answer;

static limn_bake_status oracle(limni_context *context, const limn_pack *pack,
                               const limni_mesh *source, bool with_normals, answer *given) {
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
        .boundary = strcmp(boundary, "mixed") == 0             ? source->boundary
                    : strcmp(boundary, "edge-and-corner") == 0 ? LIMN_BOUNDARY_EDGE_AND_CORNER
                                                               : LIMN_BOUNDARY_EDGE_ONLY,
        .level = LIMN_LEVEL_MAX,
    };
    const uint32_t row_count = limn_domain_get(LIMN_DOMAIN_TRIANGLE)->row_counts[LIMN_LEVEL_MAX];
    const size_t count = (size_t)source->face_count * row_count;
    given->limit = limni_allocate(context, count, sizeof *given->limit);
    if (with_normals) given->tangents = limni_allocate(context, count, sizeof *given->tangents);
    if (!given->limit || (with_normals && !given->tangents)) return LIMN_BAKE_MEMORY;
    if (!limni_opensubdiv_limit(&mesh, given->limit, given->tangents, error, sizeof error))
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

static void cross_product(const double a[3], const double b[3], double cross[3]) {
    for (int axis = 0; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        cross[axis] = a[u] * b[v] - a[v] * b[u];
    }
}

static double length(const double a[3]) {
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/// Whether two tangents span a plane: not nearly parallel, nor shorter than `least`.
static bool span_plane(const double tangents[2][3], double least) {
    double cross[3];
    cross_product(tangents[0], tangents[1], cross);
    const double a = length(tangents[0]), b = length(tangents[1]);
    return a > least && b > least && length(cross) > 1e-3 * a * b;
}

/// The angle between a normal and the one that two tangents span.
static double angle_between(const float normal[3], const double tangents[2][3]) {
    const double wide[3] = {normal[0], normal[1], normal[2]};
    double cross[3], across[3], along = 0;
    cross_product(tangents[0], tangents[1], cross);
    cross_product(cross, wide, across);
    for (int axis = 0; axis < 3; axis++)
        along += cross[axis] * wide[axis];
    return atan2(length(across), along); // exact for small angles, unlike acos
}

/// At boundary vertices of valence 5 and more OpenSubdiv's tangents are not those of the limit, but
/// converge to them with the level of refinement (docs/design.md).
static bool is_comparable(const limn_mesh *mesh, const limni_mesh *source, uint32_t patch,
                          uint32_t row) {
    uint32_t corners[LIMN_CORNER_MAX];
    if (row >= mesh->domain->corner_count) return true;
    limn_mesh_corners(mesh, patch, corners);
    return !limni_is_boundary(source, corners[row]) || source->valences[corners[row]] < 5;
}

static void compare_normals(const limn_mesh *mesh, const limni_mesh *source, uint32_t patch,
                            const float (*normals)[3], const double (*tangents)[2][3],
                            uint32_t unrotated[3][256], limni_comparison *comparison) {
    const uint32_t row_count = mesh->domain->row_counts[LIMN_LEVEL_MAX];
    const limn_patch_face face = limn_mesh_face(mesh, patch);
    for (uint32_t row = 0; row < row_count; row++) {
        const size_t other = (size_t)face.face * row_count + unrotated[face.rotation][row];
        if (!is_comparable(mesh, source, patch, row)) continue;
        if (!span_plane(tangents[other], 1e-9 * comparison->diagonal)) {
            comparison->degenerate_count++;
            continue;
        }
        const double angle =
            angle_between(normals[(size_t)patch * row_count + row], tangents[other]);
        comparison->normal_count++;
        comparison->mean_angle += angle;
        if (!(angle <= comparison->largest_angle)) {
            comparison->largest_angle = angle;
            comparison->largest_angle_face = face.face;
        }
    }
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
    answer given = {0};
    LIMNI_TRY(limni_read_file(context, path, &source));
    LIMNI_TRY(limni_mesh_build(context, &source, &built));
    LIMNI_TRY(check_same(context, mesh, &built));
    LIMNI_TRY(oracle(context, pack, &built, mesh->normals, &given));

    const limn_plan plan = limn_plan_uniform(mesh, LIMN_LEVEL_MAX);
    float(*const vertices)[3] =
        limni_allocate(context, (size_t)plan.vertex_count, sizeof *vertices);
    float(*const normals)[3] = limni_allocate(context, (size_t)plan.vertex_count, sizeof *normals);
    float(*const control_normals)[3] =
        limni_allocate(context, mesh->control_count, sizeof *control_normals);
    if (!vertices || !normals || !control_normals) return LIMN_BAKE_MEMORY;
    limn_output output = {.vertices = vertices};
    if (mesh->normals) {
        limn_mesh_control_normals(mesh, mesh->controls, control_normals[0]);
        output.normals = normals;
        output.control_normals = control_normals[0];
    }
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count, &output);

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
    for (uint32_t patch = 0; patch < plan.patch_count; patch++) {
        compare_patch(mesh, patch, (const float(*)[3])vertices, (const double(*)[3])given.limit,
                      unrotated, comparison);
        if (mesh->normals)
            compare_normals(mesh, &built, patch, (const float(*)[3])normals,
                            (const double(*)[2][3])given.tangents, unrotated, comparison);
    }
    if (comparison->normal_count) comparison->mean_angle /= (double)comparison->normal_count;
    comparison->mean /= (double)plan.vertex_count;
    return LIMN_BAKE_OK;
}
