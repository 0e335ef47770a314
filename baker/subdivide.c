/* SPDX-License-Identifier: MIT */
/*
 * Symbolic subdivision after Brickhill: a vertex is a vector of coefficients of the control points.
 * Of each level only the faces that touch a vertex inside the patch are kept (the *core*): the stars
 * of the core are whole, and so are all masks that the next level needs.
 */
#include "subdivide.h"

#include "../runtime/domain.h"
#include "masks.h"
#include "refine.h"

#include <string.h>

typedef struct subdivision {
    limni_context *context;
    const limni_rules *rules;
    const limni_scheme *scheme;
    const limn_domain *domain;
    uint32_t control_count;
    limni_wide *sums; ///< [control_count]
    uint16_t row_at[LIMN_GRID_SIZE + 1][LIMN_GRID_SIZE + 1];
} subdivision;

/// A level: its vertices in `mesh` with their coefficients, those of the core with their rows.
typedef struct level {
    limni_mesh mesh;
    limni_mesh_sharpness sharpness;
    uint32_t *rows;            ///< [control_count]; LIMNI_NONE outside the core
    bool *inside;              ///< [face_count] whether a face is part of the patch
    limni_fixed *coefficients; ///< [control_count][K]
} level;

static limni_fixed *coefficients_of(const subdivision *s, const level *l, uint32_t vertex) {
    return l->coefficients + (size_t)vertex * s->control_count;
}

// ---- Sums

static void begin_sum(const subdivision *s) {
    memset(s->sums, 0, s->control_count * sizeof *s->sums);
}

static void add_to_sum(const subdivision *s, const level *l, uint32_t vertex, limni_fixed weight) {
    if (weight == 0) return;
    const limni_fixed *const coefficients = coefficients_of(s, l, vertex);
    for (uint32_t k = 0; k < s->control_count; k++)
        s->sums[k] += (limni_wide)weight * coefficients[k];
}

static void end_sum(const subdivision *s, limni_fixed *dst) {
    for (uint32_t k = 0; k < s->control_count; k++)
        dst[k] = limni_fixed_round(s->sums[k]);
}

static void sum_terms(const subdivision *s, const level *l, const limni_masks *masks,
                      limni_fixed *dst) {
    begin_sum(s);
    for (uint32_t t = 0; t < masks->term_count; t++)
        add_to_sum(s, l, masks->terms[t].control, masks->terms[t].weight);
    end_sum(s, dst);
}

// ---- Memory

static limn_bake_status begin_subdivision(limni_context *context, const limni_rules *rules,
                                          const limni_neighbourhood *neighbourhood,
                                          subdivision *s) {
    const uint32_t control_count = neighbourhood->mesh.control_count;
    *s = (subdivision){.context = context,
                       .rules = rules,
                       .scheme = limni_scheme_of(rules, neighbourhood->mesh.domain),
                       .domain = limn_domain_get(neighbourhood->mesh.domain),
                       .control_count = control_count,
                       .sums = limni_allocate(context, control_count, sizeof *s->sums)};
    for (uint16_t row = 0; row < s->domain->row_counts[LIMN_LEVEL_MAX]; row++)
        s->row_at[s->domain->rows[row].i][s->domain->rows[row].j] = row;
    return s->sums ? LIMN_BAKE_OK : LIMN_BAKE_MEMORY;
}

static void end_subdivision(const subdivision *s) {
    limni_release(s->context, s->sums);
}

static limn_bake_status allocate_level(const subdivision *s, level *l) {
    const size_t count = l->mesh.control_count;
    l->rows = limni_allocate(s->context, count, sizeof *l->rows);
    l->inside = limni_allocate_zeroed(s->context, l->mesh.face_count, sizeof *l->inside);
    l->coefficients =
        limni_allocate_zeroed(s->context, count * s->control_count, sizeof *l->coefficients);
    if (!l->rows || !l->inside || !l->coefficients) return LIMN_BAKE_MEMORY;
    memset(l->rows, 0xff, count * sizeof *l->rows);
    return LIMN_BAKE_OK;
}

static void release_level(const subdivision *s, level *l) {
    limni_mesh_end(s->context, &l->mesh);
    limni_mesh_sharpness_end(s->context, &l->sharpness);
    limni_release(s->context, l->rows);
    limni_release(s->context, l->inside);
    limni_release(s->context, l->coefficients);
}

// ---- One level

/// What is kept of a refined mesh: the vertices of the core, and the faces around them.
typedef struct selection {
    const limni_refined *refined;
    uint32_t *rows;     ///< [points]
    bool *inside;       ///< [faces]
    uint32_t *controls; ///< [kept_count] points by slot: the core first
    uint32_t *slots;    ///< [points] or LIMNI_NONE
    uint32_t core_count, inner_count, kept_count;
} selection;

static limn_bake_status begin_selection(const subdivision *s, const limni_refined *refined,
                                        selection *kept) {
    const size_t count = refined->mesh.control_count;
    *kept = (selection){
        .refined = refined,
        .rows = limni_allocate(s->context, count, sizeof *kept->rows),
        .inside = limni_allocate_zeroed(s->context, refined->mesh.face_count, sizeof(bool)),
        .controls = limni_allocate(s->context, count, sizeof *kept->controls),
        .slots = limni_allocate(s->context, count, sizeof *kept->slots)};
    if (!kept->rows || !kept->inside || !kept->controls || !kept->slots) return LIMN_BAKE_MEMORY;
    memset(kept->rows, 0xff, count * sizeof *kept->rows);
    memset(kept->slots, 0xff, count * sizeof *kept->slots);
    return LIMN_BAKE_OK;
}

static void end_selection(const subdivision *s, const selection *kept) {
    limni_release(s->context, kept->rows);
    limni_release(s->context, kept->inside);
    limni_release(s->context, kept->controls);
    limni_release(s->context, kept->slots);
}

/// The row in the middle of others.
static uint32_t middle_row(const subdivision *s, const uint32_t *rows, uint32_t count) {
    uint32_t i = 0, j = 0;
    for (uint32_t r = 0; r < count; r++) {
        i += s->domain->rows[rows[r]].i;
        j += s->domain->rows[rows[r]].j;
    }
    return s->row_at[i / count][j / count];
}

/// Rows of a face inside the patch, and which of its children are.
static void find_rows_of_face(const subdivision *s, const level *l, uint32_t face,
                              selection *kept) {
    const limni_mesh *const mesh = &l->mesh;
    const limni_refined *const refined = kept->refined;
    uint32_t rows[LIMN_CORNER_MAX];
    const uint32_t first = mesh->offsets[face], size = limni_face_size(mesh, face);
    for (uint32_t k = 0; k < size; k++)
        rows[k] = l->rows[mesh->corners[first + k]];
    for (uint32_t k = 0; k < size; k++)
        kept->rows[refined->edge_points[first + k]] =
            middle_row(s, (uint32_t[]){rows[k], rows[(k + 1) % size]}, 2);
    if (mesh->domain == LIMN_DOMAIN_QUAD)
        kept->rows[refined->first_face_point + face] = middle_row(s, rows, size);
    const uint32_t end = limni_first_child(mesh, face + 1);
    for (uint32_t child = limni_first_child(mesh, face); child < end; child++)
        kept->inside[child] = true;
}

/// Vertices keep their rows.
static void find_rows(const subdivision *s, const level *l, selection *kept) {
    memcpy(kept->rows, l->rows, l->mesh.control_count * sizeof *kept->rows);
    for (uint32_t face = 0; face < l->mesh.face_count; face++) {
        if (l->inside[face]) find_rows_of_face(s, l, face, kept);
    }
}

static void keep(selection *kept, uint32_t point) {
    if (kept->slots[point] != LIMNI_NONE) return;
    kept->slots[point] = kept->kept_count;
    kept->controls[kept->kept_count++] = point;
}

/// All other corners of the faces around the points so far.
static void keep_around(selection *kept) {
    const limni_mesh *const mesh = &kept->refined->mesh;
    const uint32_t count = kept->kept_count;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        bool touches = false;
        for (uint32_t h = mesh->offsets[face]; h < mesh->offsets[face + 1]; h++)
            touches |= kept->slots[mesh->corners[h]] < count;
        for (uint32_t h = mesh->offsets[face]; h < mesh->offsets[face + 1] && touches; h++)
            keep(kept, mesh->corners[h]);
    }
}

/// The core, what is around it as far as stars matter, and the rest of these stars.
static void select_points(const subdivision *s, selection *kept) {
    for (uint32_t point = 0; point < kept->refined->mesh.control_count; point++) {
        if (kept->rows[point] != LIMNI_NONE) keep(kept, point);
    }
    kept->core_count = kept->kept_count;
    for (uint32_t reach = 1; reach < s->scheme->reach; reach++)
        keep_around(kept);
    kept->inner_count = kept->kept_count;
    keep_around(kept);
}

/// The coefficients of the points that are kept, of which each has a whole mask.
static limn_bake_status apply_masks(const subdivision *s, const level *l, const selection *kept,
                                    level *next) {
    const limni_mesh *const mesh = &l->mesh;
    const limni_refined *const refined = kept->refined;
    limni_masks masks;
    LIMNI_TRY(limni_masks_begin(s->context, &masks, mesh, &l->sharpness, s->rules));
    for (uint32_t v = 0; v < mesh->control_count; v++) {
        if (mesh->first[v] == LIMNI_NONE) continue;
        limni_masks_look(&masks, v, LIMNI_NONE);
        if (kept->slots[v] != LIMNI_NONE) {
            limni_masks_vertex(&masks);
            sum_terms(s, l, &masks, coefficients_of(s, next, kept->slots[v]));
        }
        for (uint32_t r = 0; r < masks.star.count; r++) {
            const uint32_t slot = kept->slots[refined->edge_points[masks.ring_edges[r]]];
            const uint32_t other = masks.star.ring[r];
            const bool whole = mesh->first[other] != LIMNI_NONE;
            if (slot == LIMNI_NONE || (whole ? other < v : s->scheme->reach > 1)) continue;
            limni_masks_edge(&masks, r);
            sum_terms(s, l, &masks, coefficients_of(s, next, slot));
        }
    }
    for (uint32_t f = 0; f < mesh->face_count && mesh->domain == LIMN_DOMAIN_QUAD; f++) {
        const uint32_t slot = kept->slots[refined->first_face_point + f];
        if (slot == LIMNI_NONE) continue;
        limni_masks_face(&masks, f);
        sum_terms(s, l, &masks, coefficients_of(s, next, slot));
    }
    limni_masks_end(s->context, &masks);
    return LIMN_BAKE_OK;
}

static limn_bake_status cut_out(const subdivision *s, const selection *kept, level *next) {
    const limni_refined *const refined = kept->refined;
    const limni_cutting cutting = {.mesh = &refined->mesh,
                                   .sharpness = &refined->sharpness,
                                   .controls = kept->controls,
                                   .control_count = kept->kept_count,
                                   .inner_count = kept->inner_count,
                                   .half_edge = refined->mesh.first[kept->controls[0]],
                                   .with_edges = true};
    limni_neighbourhood part;
    LIMNI_TRY(limni_neighbourhood_begin(s->context, &cutting, &part));
    *next = (level){.mesh = part.mesh, .sharpness = part.sharpness};
    LIMNI_TRY(allocate_level(s, next));
    for (uint32_t slot = 0; slot < kept->core_count; slot++)
        next->rows[slot] = kept->rows[kept->controls[slot]];
    for (uint32_t f = 0; f < next->mesh.face_count; f++)
        next->inside[f] = kept->inside[part.faces[f]];
    limni_release(s->context, part.faces);
    return LIMN_BAKE_OK;
}

static limn_bake_status refine(const subdivision *s, const level *l, level *next) {
    limni_refined refined;
    selection kept;
    LIMNI_TRY(limni_refine(s->context, &l->mesh, &l->sharpness, s->rules, &refined));
    LIMNI_TRY(begin_selection(s, &refined, &kept));
    find_rows(s, l, &kept);
    select_points(s, &kept);
    LIMNI_TRY(cut_out(s, &kept, next));
    LIMNI_TRY(apply_masks(s, l, &kept, next));
    end_selection(s, &kept);
    limni_refined_end(s->context, &refined);
    return LIMN_BAKE_OK;
}

// ---- The limit

/// A star of a level, and what it is made of, as a level of its own, which is closed under
/// subdivision.
static limn_bake_status begin_fan(const subdivision *s, const level *l, const limni_star *star,
                                  uint32_t vertex, level *fan) {
    limni_neighbourhood part;
    LIMNI_TRY(limni_fan_begin(s->context, star, &part));
    *fan = (level){.mesh = part.mesh, .sharpness = part.sharpness};
    LIMNI_TRY(allocate_level(s, fan));
    const size_t size = s->control_count * sizeof(limni_fixed);
    fan->rows[0] = 0;
    memcpy(coefficients_of(s, fan, 0), coefficients_of(s, l, vertex), size);
    for (uint32_t r = 0; r < star->count; r++)
        memcpy(coefficients_of(s, fan, 1 + r), coefficients_of(s, l, star->ring[r]), size);
    for (uint32_t f = 0; star->diagonals && f < limni_star_face_count(star); f++)
        memcpy(coefficients_of(s, fan, 1 + star->count + f),
               coefficients_of(s, l, star->diagonals[f]), size);
    return LIMN_BAKE_OK;
}

/// Refines a fan until its vertex is settled.
static limn_bake_status settle(const subdivision *s, level *fan, limni_masks *masks) {
    LIMNI_TRY(limni_masks_begin(s->context, masks, &fan->mesh, &fan->sharpness, s->rules));
    limni_masks_look(masks, 0, LIMNI_NONE);
    while (!limni_star_is_settled(s->rules, &masks->star)) {
        level next;
        LIMNI_TRY(refine(s, fan, &next));
        limni_masks_end(s->context, masks);
        release_level(s, fan);
        *fan = next;
        LIMNI_TRY(limni_masks_begin(s->context, masks, &fan->mesh, &fan->sharpness, s->rules));
        limni_masks_look(masks, 0, LIMNI_NONE);
    }
    return LIMN_BAKE_OK;
}

/// Where the limit of one row goes.
typedef struct limit_row {
    limni_fixed *position;    ///< NULL: not wanted
    limni_fixed *tangents[2]; ///< NULL: not wanted
    uint32_t half_steps;      ///< of the tangents
} limit_row;

/// Both tangents of the vertex that was looked at.
static void sum_tangents(const subdivision *s, const level *l, limni_masks *masks,
                         uint32_t half_steps, limni_fixed *const tangents[2]) {
    for (int t = 0; t < 2; t++) {
        limni_masks_tangent(masks, half_steps, t);
        sum_terms(s, l, masks, tangents[t]);
    }
}

/// The limit of the vertex that was looked at, whose star is settled.
static void project(const subdivision *s, const level *l, limni_masks *masks,
                    const limit_row *dst) {
    if (dst->position) {
        limni_masks_limit(masks);
        sum_terms(s, l, masks, dst->position);
    }
    if (dst->tangents[0]) sum_tangents(s, l, masks, dst->half_steps, dst->tangents);
}

/// The limit of the vertex of a level that was looked at.
static limn_bake_status project_vertex(const subdivision *s, const level *l, limni_masks *masks,
                                       const limit_row *dst) {
    if (limni_star_is_settled(s->rules, &masks->star)) {
        project(s, l, masks, dst);
        return LIMN_BAKE_OK;
    }
    level fan;
    limni_masks settled;
    LIMNI_TRY(begin_fan(s, l, &masks->star, masks->vertex, &fan));
    LIMNI_TRY(settle(s, &fan, &settled));
    project(s, &fan, &settled, dst);
    limni_masks_end(s->context, &settled);
    release_level(s, &fan);
    return LIMN_BAKE_OK;
}

/// The place of a row in a ring.
static uint32_t place_in_ring(const level *l, const limni_star *star, uint32_t row) {
    uint32_t r = 0;
    while (r + 1 < star->count && l->rows[star->ring[r]] != row)
        r++;
    return r;
}

/// In half steps around a ring, where the tangents of a row start: on an edge, at the next row along
/// it; inside, halfway between the directions of i and j, so that mirrored rows have mirrored
/// tangents.
static uint32_t tangent_start(const subdivision *s, const level *l, const limni_star *star,
                              uint32_t row, int depth) {
    const limn_row place = s->domain->rows[row];
    const int step = LIMN_GRID_SIZE >> depth;
    int di = 1, dj = 0;
    for (uint32_t edge = 0; edge < s->domain->corner_count && place.edges; edge++) {
        if (!(place.edges >> edge & 1)) continue;
        const limn_row start = s->domain->rows[edge];
        const limn_row end = s->domain->rows[(edge + 1) % s->domain->corner_count];
        di = (end.i - start.i) / LIMN_GRID_SIZE;
        dj = (end.j - start.j) / LIMN_GRID_SIZE;
    }
    const uint32_t next = s->row_at[place.i + step * di][place.j + step * dj];
    return 2 * place_in_ring(l, star, next) + (place.edges == 0);
}

/// Likewise at a corner that is new: corner 1 where edge 0 would go on, others at their own edge.
static uint32_t corner_tangent_start(const subdivision *s, const level *l, const limni_star *star,
                                     uint32_t corner, int depth) {
    const uint32_t step = LIMN_GRID_SIZE >> depth;
    if (corner == 1)
        return limni_star_opposite(
            star, place_in_ring(l, star, s->domain->edge_rows[0][LIMN_GRID_SIZE - step]));
    return 2 * place_in_ring(l, star, s->domain->edge_rows[corner][step]);
}

/// The tangents of all rows that have them, from the vertices of the level behind theirs.
///
/// half_steps  [row_counts[depth]] where they start; LIMNI_NONE: none are wanted
static limn_bake_status project_later(const subdivision *s, const level *l,
                                      const uint32_t *half_steps, size_t table_size,
                                      limni_fixed *tangents) {
    level still = *l, next; // no new rows
    still.inside = limni_allocate_zeroed(s->context, l->mesh.face_count, sizeof *still.inside);
    if (!still.inside) return LIMN_BAKE_MEMORY;
    limni_masks masks;
    LIMNI_TRY(refine(s, &still, &next));
    LIMNI_TRY(limni_masks_begin(s->context, &masks, &next.mesh, &next.sharpness, s->rules));
    for (uint32_t vertex = 0; vertex < next.mesh.control_count; vertex++) {
        const uint32_t row = next.rows[vertex];
        if (row == LIMNI_NONE || half_steps[row] == LIMNI_NONE) continue;
        limni_masks_look(&masks, vertex, LIMNI_NONE);
        limni_fixed *const along = tangents + (size_t)row * s->control_count;
        sum_tangents(s, &next, &masks, half_steps[row],
                     (limni_fixed *const[]){along, along + table_size});
    }
    limni_masks_end(s->context, &masks);
    release_level(s, &next);
    limni_release(s->context, still.inside);
    return LIMN_BAKE_OK;
}

static limn_bake_status project_rows(const subdivision *s, const level *l, int depth,
                                     const limni_rows *rows) {
    const size_t table_size = (size_t)s->domain->row_counts[depth] * s->control_count;
    const bool later = s->scheme->reach > 1;
    uint32_t half_steps[LIMNI_ROWS_MAX];
    limni_masks masks;
    LIMNI_TRY(limni_masks_begin(s->context, &masks, &l->mesh, &l->sharpness, s->rules));
    if (rows->tangents) memset(rows->tangents, 0, 2 * table_size * sizeof *rows->tangents);
    for (uint32_t vertex = 0; vertex < l->mesh.control_count; vertex++) {
        const uint32_t row = l->rows[vertex];
        const size_t first = (size_t)row * s->control_count;
        if (row == LIMNI_NONE) continue;
        limit_row dst = {.position = rows->positions + first};
        limni_masks_look(&masks, vertex, LIMNI_NONE);
        const bool corner = row < s->domain->corner_count;
        half_steps[row] = LIMNI_NONE;
        if (rows->tangents && (!corner || rows->new_corners >> row & 1)) {
            half_steps[row] = corner ? corner_tangent_start(s, l, &masks.star, row, depth)
                                     : tangent_start(s, l, &masks.star, row, depth);
            dst.half_steps = half_steps[row];
            dst.tangents[0] = later ? NULL : rows->tangents + first;
            dst.tangents[1] = rows->tangents + table_size + first;
        }
        LIMNI_TRY(project_vertex(s, l, &masks, &dst));
    }
    limni_masks_end(s->context, &masks);
    if (!later || !rows->tangents) return LIMN_BAKE_OK;
    return project_later(s, l, half_steps, table_size, rows->tangents);
}

// ---- All levels

/// The neighbourhood before any level: each vertex is a control point, its own or that of its twin.
static limn_bake_status begin(const subdivision *s, const limni_neighbourhood *neighbourhood,
                              level *l) {
    *l = (level){.mesh = neighbourhood->mesh, .sharpness = neighbourhood->sharpness};
    LIMNI_TRY(allocate_level(s, l));
    const uint32_t *const twins = neighbourhood->twins;
    for (uint32_t v = 0; v < s->control_count; v++)
        coefficients_of(s, l, v)[twins ? twins[v] : v] = LIMNI_FIXED_ONE;
    return LIMN_BAKE_OK;
}

/// Frees all but what belongs to the neighbourhood.
static void end_first(const subdivision *s, level *l) {
    limni_release(s->context, l->rows);
    limni_release(s->context, l->inside);
    limni_release(s->context, l->coefficients);
}

static void copy_rows(const subdivision *s, const level *l, limni_fixed *positions) {
    for (uint32_t v = 0; v < l->mesh.control_count; v++) {
        if (l->rows[v] != LIMNI_NONE)
            memcpy(positions + (size_t)l->rows[v] * s->control_count, coefficients_of(s, l, v),
                   s->control_count * sizeof *positions);
    }
}

limn_bake_status limni_subdivide(limni_context *context, const limni_rules *rules,
                                 const limni_neighbourhood *neighbourhood, int depth,
                                 limni_projection projection, const limni_rows *rows) {
    subdivision s;
    level levels[LIMN_LEVEL_COUNT];
    LIMNI_TRY(begin_subdivision(context, rules, neighbourhood, &s));
    LIMNI_TRY(begin(&s, neighbourhood, &levels[0]));
    for (uint32_t corner = 0; corner < s.domain->corner_count; corner++)
        levels[0].rows[corner] = corner;
    levels[0].inside[0] = true;
    for (int n = 0; n < depth; n++)
        LIMNI_TRY(refine(&s, &levels[n], &levels[n + 1]));
    if (projection == LIMNI_PROJECT_TO_LIMIT) {
        LIMNI_TRY(project_rows(&s, &levels[depth], depth, rows));
    } else {
        copy_rows(&s, &levels[depth], rows->positions);
    }
    for (int n = depth; n > 0; n--)
        release_level(&s, &levels[n]);
    end_first(&s, &levels[0]);
    end_subdivision(&s);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_star_tangents(limni_context *context, const limni_rules *rules,
                                     const limni_star *star, uint32_t half_steps,
                                     limni_fixed *along, limni_fixed *across) {
    limni_neighbourhood fan;
    subdivision s;
    level l;
    limni_masks masks;
    LIMNI_TRY(limni_fan_begin(context, star, &fan));
    LIMNI_TRY(begin_subdivision(context, rules, &fan, &s));
    LIMNI_TRY(begin(&s, &fan, &l));
    LIMNI_TRY(limni_masks_begin(context, &masks, &l.mesh, &l.sharpness, rules));
    limni_masks_look(&masks, 0, LIMNI_NONE);
    const limit_row dst = {.tangents = {along, across}, .half_steps = half_steps};
    LIMNI_TRY(project_vertex(&s, &l, &masks, &dst));
    limni_masks_end(context, &masks);
    end_first(&s, &l);
    end_subdivision(&s);
    limni_neighbourhood_end(context, &fan);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_vertex_tangents(limni_context *context, const limni_rules *rules,
                                       const limni_neighbourhood *neighbourhood, limni_fixed *along,
                                       limni_fixed *across) {
    subdivision s;
    level first, next, *l = &first;
    limni_masks masks;
    LIMNI_TRY(begin_subdivision(context, rules, neighbourhood, &s));
    LIMNI_TRY(begin(&s, neighbourhood, &first));
    first.rows[0] = 0;
    // With one face there is no tangent plane to come nearer to.
    const bool alone = neighbourhood->mesh.valences[0] == 2 && limni_is_boundary(&first.mesh, 0);
    if (!alone) {
        LIMNI_TRY(refine(&s, &first, &next));
        l = &next;
    }
    LIMNI_TRY(limni_masks_begin(context, &masks, &l->mesh, &l->sharpness, rules));
    limni_masks_look(&masks, 0, LIMNI_NONE);
    sum_tangents(&s, l, &masks, 0, (limni_fixed *const[]){along, across});
    limni_masks_end(context, &masks);
    if (!alone) release_level(&s, &next);
    end_first(&s, &first);
    end_subdivision(&s);
    return LIMN_BAKE_OK;
}
