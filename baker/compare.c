/* SPDX-License-Identifier: MIT */
#include "compare.h"

#include "../runtime/domain.h"
#include "subject.h"

#include <float.h>
#include <math.h>

/// OpenSubdiv's surface: [faces of the base mesh][rows] of each.
typedef struct answer {
    const limni_mesh *base; ///< split where it is no manifold
    double (*limit)[3];
    double (*tangents)[2][3]; ///< NULL for a mesh without normals
    bool *comparable;         ///< [vertices of the base mesh] whether normals are, there
    bool sided;               ///< on creases, each face has the tangents of its own side
} answer;

/// The most smooth edges that follow one another between two edges that stay sharp.
static uint32_t longest_smooth_run(const limni_star *star, uint32_t first_sharp) {
    uint32_t run = 0, longest = 0;
    for (uint32_t r = 1; r <= (star->closed ? star->count : star->count - 1); r++) {
        const uint32_t place = (first_sharp + r) % star->count;
        run = limni_star_edge(star, place) < LIMNI_SHARPNESS_INFINITE ? run + 1 : 0;
        if (run > longest) longest = run;
    }
    return longest;
}

/// Whether normals at a vertex can be compared (docs/mathematics.md). OpenSubdiv's tangents at
/// boundary vertices with four faces and more, of quads three, are not those of the limit, but
/// converge to them with the level of refinement, and those of its surfaces likewise on creases with
/// as many faces on a side, and at corners with smooth edges. Ours are not those of the limit at the
/// end of a crease. Two quads back to back have no tangent plane.
///
/// sided  see answer
static bool has_comparable_normals(const limni_star *star, bool sided) {
    const limni_feature last = limni_star_last_feature(star);
    const bool boundary = !star->closed && last.rule == LIMNI_VERTEX_CREASE;
    if (!sided && !boundary && last.rule != LIMNI_VERTEX_SMOOTH) return false;
    const bool any_sharp = limni_star_edge(star, last.ends[0]) >= LIMNI_SHARPNESS_INFINITE;
    const uint32_t longest = any_sharp ? longest_smooth_run(star, last.ends[0]) : 0;
    switch (last.rule) {
    case LIMNI_VERTEX_SMOOTH:
        return !star->diagonals || star->count > 2;
    case LIMNI_VERTEX_CREASE:
        return longest < (star->diagonals ? 2 : 3);
    case LIMNI_VERTEX_CORNER:
        return any_sharp && longest == 0;
    default:
        return false;
    }
}

/// Finds which vertices of the base mesh have normals that can be compared. Those that were split
/// have several.
static limn_bake_status find_comparable(limni_context *context, const limni_base *base,
                                        const limni_rules *rules, bool **comparable) {
    const limni_mesh *const source = base->mesh;
    const uint32_t valence_max = limni_valence_max(source);
    uint32_t *const room = limni_allocate(context, 4 * (size_t)valence_max, sizeof *room);
    *comparable = limni_allocate_zeroed(context, source->control_count, sizeof **comparable);
    if (!room || !*comparable) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < source->control_count; c++) {
        limni_star star = {.ring = room,
                           .edges = room + valence_max,
                           .beyond = room + 2 * (size_t)valence_max,
                           .diagonals = room + 3 * (size_t)valence_max};
        if (source->first[c] == LIMNI_NONE || limni_is_split(source, c)) continue;
        limni_mesh_star(source, base->sharpness, source->first[c], &star);
        (*comparable)[c] = has_comparable_normals(&star, rules->creasing != LIMN_CREASING_CHAIKIN);
    }
    limni_release(context, room);
    return LIMN_BAKE_OK;
}

static limn_bake_status oracle(limni_context *context, const limni_subject *s, bool with_normals,
                               answer *given) {
    char error[512];
    limni_opensubdiv_mesh mesh;
    LIMNI_TRY(limni_subject_describe(context, s, &mesh));
    const uint32_t row_count = limn_domain_get(s->base.mesh->domain)->row_counts[LIMN_LEVEL_MAX];
    const size_t count = (size_t)s->base.mesh->face_count * row_count;
    given->limit = limni_allocate(context, count, sizeof *given->limit);
    if (with_normals) given->tangents = limni_allocate(context, count, sizeof *given->tangents);
    if (!given->limit || (with_normals && !given->tangents)) return LIMN_BAKE_MEMORY;
    given->base = s->base.mesh;
    given->sided = mesh.creasing != LIMN_CREASING_CHAIKIN;
    LIMNI_TRY(find_comparable(context, &s->base, &s->rules, &given->comparable));
    if (!limni_opensubdiv_limit(&mesh, given->limit, given->tangents, error, sizeof error))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: OpenSubdiv: %s", s->whole.path, error);
    return LIMN_BAKE_OK;
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

/// How far two tangents reach across the longer of them.
static double width(const double tangents[2][3]) {
    double cross[3];
    cross_product(tangents[0], tangents[1], cross);
    return length(cross) / fmax(length(tangents[0]), length(tangents[1]));
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

/// The edges of a patch between two vertices that were split: one of each has OpenSubdiv's
/// tangents.
static uint32_t split_edges(const limn_mesh *mesh, const limni_mesh *base, uint32_t patch) {
    const uint32_t count = mesh->domain->corner_count, first = mesh->base_first;
    uint32_t corners[LIMN_CORNER_MAX], edges = 0;
    limn_mesh_corners(mesh, patch, corners);
    for (uint32_t e = 0; e < count; e++)
        edges |= (uint32_t)(limni_is_split(base, corners[e] - first) &&
                            limni_is_split(base, corners[(e + 1) % count] - first))
                 << e;
    return edges;
}

static bool is_comparable(const limn_mesh *mesh, const answer *given, uint32_t patch,
                          uint32_t row) {
    uint32_t corners[LIMN_CORNER_MAX];
    if (row < mesh->domain->corner_count) {
        limn_mesh_corners(mesh, patch, corners);
        return given->comparable[corners[row] - mesh->base_first];
    }
    const uint32_t edges = mesh->domain->rows[row].edges;
    if (edges & split_edges(mesh, given->base, patch)) return false;
    return given->sided || !mesh->creases || !(mesh->creases[patch] & edges);
}

static void compare_normals(const limn_mesh *mesh, const answer *given, uint32_t patch,
                            const float (*normals)[3], limni_unrotated unrotated,
                            limni_comparison *comparison) {
    const uint32_t row_count = mesh->domain->row_counts[LIMN_LEVEL_MAX];
    const limn_patch_face face = limn_mesh_face(mesh, patch);
    const double(*const tangents)[2][3] = (const double(*)[2][3])given->tangents;
    for (uint32_t row = 0; row < row_count; row++) {
        const size_t other = (size_t)face.face * row_count + unrotated[face.rotation][row];
        if (!is_comparable(mesh, given, patch, row)) continue;
        if (!span_plane(tangents[other], 1e-9 * comparison->diagonal)) {
            comparison->degenerate_count++;
            continue;
        }
        const double angle =
            angle_between(normals[(size_t)patch * row_count + row], tangents[other]);
        comparison->largest_turn =
            fmax(comparison->largest_turn, angle * width(tangents[other]) / comparison->diagonal);
        comparison->normal_count++;
        comparison->mean_angle += angle;
        if (!(angle <= comparison->largest_angle)) {
            comparison->largest_angle = angle;
            comparison->largest_angle_face = face.face;
        }
    }
}

static void compare_patch(const limn_mesh *mesh, uint32_t patch, const float (*vertices)[3],
                          const double (*limit)[3], limni_unrotated unrotated,
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

/// The vertices of all patches at the finest level.
typedef struct evaluated {
    limn_plan plan;
    float (*vertices)[3], (*normals)[3];
} evaluated;

static limn_bake_status evaluate(limni_context *context, const limn_mesh *mesh, evaluated *made) {
    made->plan = limn_plan_uniform(mesh, LIMN_LEVEL_MAX);
    const size_t count = (size_t)made->plan.vertex_count;
    made->vertices = limni_allocate(context, count, sizeof *made->vertices);
    made->normals = limni_allocate(context, count, sizeof *made->normals);
    float(*const control_normals)[3] =
        limni_allocate(context, mesh->normal_count, sizeof *control_normals);
    if (!made->vertices || !made->normals || !control_normals) return LIMN_BAKE_MEMORY;
    limn_output output = {.vertices = made->vertices};
    if (mesh->normals) {
        limn_mesh_control_normals(mesh, mesh->controls, control_normals[0]);
        output.normals = made->normals;
        output.control_normals = control_normals[0];
    }
    limn_evaluate(&made->plan, mesh->controls, 0, made->plan.patch_count, &output);
    limni_release(context, control_normals);
    return LIMN_BAKE_OK;
}

/// Sets what differences are measured by.
static limn_bake_status measure_extent(limni_context *context, const limn_mesh *mesh,
                                       const char *path, limni_comparison *comparison) {
    const float *const low = mesh->bounds_min;
    const double high[3] = {mesh->bounds_max[0], mesh->bounds_max[1], mesh->bounds_max[2]};
    comparison->diagonal = distance(low, high);
    if (!(comparison->diagonal > 0))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: the mesh has no extent", path);
    for (int axis = 0; axis < 3; axis++) {
        const double reach = fmax(fabs((double)low[axis]), fabs(high[axis]));
        comparison->rounding += reach * (double)FLT_EPSILON / comparison->diagonal;
    }
    return LIMN_BAKE_OK;
}

static void compare_patches(const limn_mesh *mesh, const answer *given, const evaluated *made,
                            limni_comparison *comparison) {
    limni_unrotated unrotated;
    limni_unrotate(mesh->domain, unrotated);
    for (uint32_t patch = 0; patch < made->plan.patch_count; patch++) {
        compare_patch(mesh, patch, (const float(*)[3])made->vertices,
                      (const double(*)[3])given->limit, unrotated, comparison);
        if (mesh->normals)
            compare_normals(mesh, given, patch, (const float(*)[3])made->normals, unrotated,
                            comparison);
    }
    comparison->vertex_count = made->plan.vertex_count;
    comparison->mean /= (double)comparison->vertex_count;
    if (comparison->normal_count) comparison->mean_angle /= (double)comparison->normal_count;
}

limn_bake_status limni_compare(limni_context *context, const limn_pack *pack, const limn_mesh *mesh,
                               const char *path, limni_comparison *comparison) {
    limni_subject read;
    answer given = {0};
    evaluated made;
    *comparison = (limni_comparison){0};
    LIMNI_TRY(limni_subject_read(context, pack, mesh, path, &read));
    LIMNI_TRY(measure_extent(context, mesh, path, comparison));
    LIMNI_TRY(oracle(context, &read, mesh->normals, &given));
    LIMNI_TRY(evaluate(context, mesh, &made));
    compare_patches(mesh, &given, &made, comparison);
    return LIMN_BAKE_OK;
}
