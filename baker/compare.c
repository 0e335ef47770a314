/* SPDX-License-Identifier: MIT */
#include "compare.h"

#include "base.h"
#include "deviation.h"
#include "info.h"
#include "opensubdiv.h"

#include <float.h>
#include <math.h>
#include <string.h>

/// OpenSubdiv's surface: [faces of the base mesh][rows] of each.
typedef struct answer {
    const limni_mesh *base; ///< split where it is no manifold
    double (*limit)[3];
    double (*tangents)[2][3]; ///< NULL for a mesh without normals
    bool *comparable;         ///< [vertices of the base mesh] whether normals are, there
    bool sided;               ///< on creases, each face has the tangents of its own side
} answer;

/// What a file says about how it was baked, or where its meshes differ, what the mesh asked for.
static limn_boundary boundary_of(const char *name, const limni_mesh *source) {
    if (strcmp(name, "mixed") == 0) return source->boundary;
    if (strcmp(name, "none") == 0) return LIMN_BOUNDARY_NONE;
    return strcmp(name, "edge-and-corner") == 0 ? LIMN_BOUNDARY_EDGE_AND_CORNER
                                                : LIMN_BOUNDARY_EDGE_ONLY;
}

static limn_creasing creasing_of(const char *name, const limni_mesh *source) {
    if (strcmp(name, "mixed") == 0) return source->creasing;
    return strcmp(name, "chaikin") == 0 ? LIMN_CREASING_CHAIKIN : LIMN_CREASING_UNIFORM;
}

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

/// Whether normals at a vertex can be compared (docs/design.md). OpenSubdiv's tangents at boundary
/// vertices with four faces and more, of quads three, are not those of the limit, but converge to
/// them with the level of refinement, and those of its surfaces likewise on creases with as many
/// faces on a side, and at corners with smooth edges. Ours are not those of the limit at the end of
/// a crease. Two quads back to back have no tangent plane.
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
    uint32_t valence_max = 0;
    for (uint32_t c = 0; c < source->control_count; c++)
        valence_max = source->valences[c] > valence_max ? source->valences[c] : valence_max;
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

/// How a file was baked.
typedef struct recipe {
    limni_opensubdiv_scheme scheme;
    limni_rules rules;
} recipe;

static limn_bake_status read_scheme(limni_context *context, const limn_pack *pack,
                                    const limn_mesh *mesh, recipe *r) {
    char scheme[32], weights[32];
    limni_info_value(pack->info, "scheme", scheme, sizeof scheme);
    limni_info_value(pack->info, "weights", weights, sizeof weights);
    const bool quads = mesh->domain->kind == LIMN_DOMAIN_QUAD;
    if (strcmp(scheme, "loop") == 0) {
        *r = (recipe){LIMNI_OPENSUBDIV_LOOP, {.scheme = LIMN_SCHEME_LOOP}};
        if (strcmp(weights, "loop") == 0) return LIMN_BAKE_OK;
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "the file was baked with %s weights, which OpenSubdiv does not have",
                          weights);
    }
    if (strcmp(scheme, "catmark") == 0) {
        *r = (recipe){LIMNI_OPENSUBDIV_CATMARK, {.scheme = LIMN_SCHEME_CATMARK}};
    } else if (strcmp(scheme, "none") == 0 && quads) {
        *r = (recipe){LIMNI_OPENSUBDIV_BILINEAR, {.scheme = LIMN_SCHEME_NONE}};
    } else {
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "the file was baked with --scheme %s, which OpenSubdiv does not have%s",
                          scheme, quads ? "" : " for triangles");
    }
    return LIMN_BAKE_OK;
}

/// A mesh twice.
typedef struct subject {
    limni_mesh built; ///< split where it is no manifold, if that was asked for
    limni_mesh whole; ///< as OpenSubdiv takes it; with the same faces, half-edges and holes
    limni_base base;  ///< of `built`
} subject;

static limn_bake_status read_subject(limni_context *context, const limn_pack *pack,
                                     const char *name, const char *path, recipe *r, subject *s) {
    char boundary[32], creases[32], creasing[32];
    limni_source source = {0}, again = {0};
    context->desc.scheme = r->rules.scheme;
    LIMNI_TRY(limni_read_mesh(context, path, name, &source));
    LIMNI_TRY(limni_mesh_build(context, &source, &s->built));
    LIMNI_TRY(limni_read_mesh(context, path, name, &again));
    LIMNI_TRY(limni_mesh_begin(context, &again, &s->whole));
    limni_info_value(pack->info, "boundary", boundary, sizeof boundary);
    limni_info_value(pack->info, "creases", creases, sizeof creases);
    limni_info_value(pack->info, "creasing", creasing, sizeof creasing);
    if (strcmp(creases, "lomont") == 0 &&
        (limni_has_sharpness(&s->built) || limni_has_boundary(&s->built)))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: the mesh was baked with Lomont's rules for creases and boundaries, "
                          "which OpenSubdiv does not have",
                          path);
    r->rules.boundary = boundary_of(boundary, &s->built);
    r->rules.creasing = creasing_of(creasing, &s->built);
    return limni_base_begin(context, &s->built, &r->rules, &s->base);
}

static limn_bake_status check_same(limni_context *context, const limn_mesh *mesh,
                                   const subject *s) {
    const limni_mesh *const source = &s->built;
    if (mesh->control_count != source->control_count ||
        mesh->face_count != s->base.mesh->face_count ||
        memcmp(mesh->controls, source->controls,
               source->control_count * sizeof *source->controls) != 0)
        return limni_fail(
            context, LIMN_BAKE_BAD_INPUT,
            "%s: mesh '%s' was baked from something else, or repaired or split differently",
            source->path, mesh->name);
    return LIMN_BAKE_OK;
}

/// The corners of each face.
static limn_bake_status list_sizes(limni_context *context, const limni_mesh *mesh,
                                   uint32_t **sizes) {
    *sizes = limni_allocate(context, mesh->face_count, sizeof **sizes);
    if (!*sizes) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face < mesh->face_count; face++)
        (*sizes)[face] = limni_face_size(mesh, face);
    return LIMN_BAKE_OK;
}

static limn_bake_status oracle(limni_context *context, const recipe *r, const subject *s,
                               bool with_normals, answer *given) {
    const limni_mesh *const source = &s->whole;
    char error[512];
    uint32_t *sizes;
    LIMNI_TRY(list_sizes(context, source, &sizes));
    const limni_opensubdiv_mesh mesh = {
        .positions = source->controls[0],
        .faces = source->corners,
        .face_sizes = sizes,
        .position_count = source->control_count,
        .face_count = source->face_count,
        .scheme = r->scheme,
        .divided = s->base.divided,
        .boundary = r->rules.boundary,
        .level = LIMN_LEVEL_MAX,
        .edge_sharpness = source->edge_sharpness,
        .vertex_sharpness = source->vertex_sharpness,
        .holes = source->holes,
        .creasing = r->rules.creasing,
    };
    const uint32_t row_count = limn_domain_get(source->domain)->row_counts[LIMN_LEVEL_MAX];
    const size_t count = (size_t)s->base.mesh->face_count * row_count;
    given->limit = limni_allocate(context, count, sizeof *given->limit);
    if (with_normals) given->tangents = limni_allocate(context, count, sizeof *given->tangents);
    if (!given->limit || (with_normals && !given->tangents)) return LIMN_BAKE_MEMORY;
    given->base = s->base.mesh;
    given->sided = mesh.creasing != LIMN_CREASING_CHAIKIN;
    LIMNI_TRY(find_comparable(context, &s->base, &r->rules, &given->comparable));
    if (!limni_opensubdiv_limit(&mesh, given->limit, given->tangents, error, sizeof error))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: OpenSubdiv: %s", source->path, error);
    return LIMN_BAKE_OK;
}

static uint32_t row_at(const limn_domain *domain, uint32_t i, uint32_t j) {
    uint32_t row = 0;
    while (domain->rows[row].i != i || domain->rows[row].j != j)
        row++;
    return row;
}

/// The row of the unrotated domain at the same place as `row` of a patch that starts at corner
/// `rotation`.
static uint32_t unrotate(const limn_domain *domain, uint32_t row, uint32_t rotation) {
    uint32_t i = domain->rows[row].i, j = domain->rows[row].j;
    for (; rotation > 0; rotation--) {
        const uint32_t before = i;
        if (domain->kind == LIMN_DOMAIN_QUAD) {
            i = LIMN_GRID_SIZE - j;
            j = before;
        } else {
            i = LIMN_GRID_SIZE - i - j;
            j = before;
        }
    }
    return row_at(domain, i, j);
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
                            const float (*normals)[3],
                            uint32_t unrotated[LIMN_CORNER_MAX][LIMNI_ROWS_MAX],
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
                          const double (*limit)[3],
                          uint32_t unrotated[LIMN_CORNER_MAX][LIMNI_ROWS_MAX],
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
    subject read;
    recipe baked;
    answer given = {0};
    LIMNI_TRY(read_scheme(context, pack, mesh, &baked));
    LIMNI_TRY(read_subject(context, pack, mesh->name, path, &baked, &read));
    LIMNI_TRY(check_same(context, mesh, &read));
    LIMNI_TRY(oracle(context, &baked, &read, mesh->normals, &given));

    const limn_plan plan = limn_plan_uniform(mesh, LIMN_LEVEL_MAX);
    float(*const vertices)[3] =
        limni_allocate(context, (size_t)plan.vertex_count, sizeof *vertices);
    float(*const normals)[3] = limni_allocate(context, (size_t)plan.vertex_count, sizeof *normals);
    float(*const control_normals)[3] =
        limni_allocate(context, mesh->normal_count, sizeof *control_normals);
    if (!vertices || !normals || !control_normals) return LIMN_BAKE_MEMORY;
    limn_output output = {.vertices = vertices};
    if (mesh->normals) {
        limn_mesh_control_normals(mesh, mesh->controls, control_normals[0]);
        output.normals = normals;
        output.control_normals = control_normals[0];
    }
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count, &output);

    uint32_t unrotated[LIMN_CORNER_MAX][LIMNI_ROWS_MAX];
    for (uint32_t rotation = 0; rotation < mesh->domain->corner_count; rotation++) {
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
            compare_normals(mesh, &given, patch, (const float(*)[3])normals, unrotated, comparison);
    }
    if (comparison->normal_count) comparison->mean_angle /= (double)comparison->normal_count;
    comparison->mean /= (double)plan.vertex_count;
    return LIMN_BAKE_OK;
}
