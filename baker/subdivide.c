/* SPDX-License-Identifier: MIT */
/*
 * Symbolic subdivision after Brickhill: a vertex is a vector of coefficients of the control points.
 * Of each level only the vertices inside the triangle are kept with their stars (the *core*; core
 * vertex r is row r of the domain), and of the vertices around them only the coefficients: the
 * edges that touch a core vertex are all that the next level needs, and their masks are complete.
 */
#include "subdivide.h"

#include "limn/limn.h"
#include "mesh.h"

#include <string.h>

enum { CORE_MAX = 153 };

typedef struct complex {
    uint32_t core_count;
    uint32_t vertex_count;      ///< core vertices first
    limni_star stars[CORE_MAX]; ///< of the core
    uint32_t *
        edge_points[CORE_MAX]; ///< parallel to the rings: the vertex of the next level on that edge
    uint32_t *ring_pool;       ///< what rings and edge_points point into
    uint32_t *sharpness_pool;  ///< what edges and beyond point into; NULL: no edge is sharp
    limni_fixed *coefficients; ///< [vertex_count][control_count]
} complex;

typedef struct subdivision {
    limni_context *context;
    const limni_rules *rules;
    const limn_domain *domain;
    uint32_t control_count;
    uint32_t weight_count; ///< of a vertex mask, at most
    limni_wide *sums;      ///< [control_count]
    limni_fixed *weights;  ///< of two vertex masks
} subdivision;

// ---- Masks

static limni_fixed *vertex_of(const subdivision *s, const complex *c, uint32_t vertex) {
    return c->coefficients + (size_t)vertex * s->control_count;
}

static void begin_sum(const subdivision *s) {
    memset(s->sums, 0, s->control_count * sizeof *s->sums);
}

static void add_to_sum(const subdivision *s, const complex *c, uint32_t vertex,
                       limni_fixed weight) {
    if (weight == 0) return;
    const limni_fixed *const coefficients = vertex_of(s, c, vertex);
    for (uint32_t k = 0; k < s->control_count; k++)
        s->sums[k] += (limni_wide)weight * coefficients[k];
}

static void end_sum(const subdivision *s, limni_fixed *dst) {
    for (uint32_t k = 0; k < s->control_count; k++)
        dst[k] = limni_fixed_round(s->sums[k]);
}

/// Applies a vertex mask around core vertex v.
static void apply_vertex_mask(const subdivision *s, const complex *c, uint32_t v,
                              const limni_fixed *weights, limni_fixed *dst) {
    begin_sum(s);
    add_to_sum(s, c, v, weights[0]);
    for (uint32_t r = 0; r < c->stars[v].count; r++)
        add_to_sum(s, c, c->stars[v].ring[r], weights[1 + r]);
    end_sum(s, dst);
}

// ---- Stars

/// Applies the edge mask between core vertex v and its ring vertex r.
static void apply_edge_mask(const subdivision *s, const complex *c, uint32_t v, uint32_t r,
                            limni_fixed *dst) {
    const limni_star *const star = &c->stars[v];
    const limni_edge_feature feature = limni_star_edge_feature(s->rules, star, r);
    const limni_edge_mask mask = limni_loop_edge_mask(&feature);
    begin_sum(s);
    add_to_sum(s, c, v, mask.ends[0]);
    add_to_sum(s, c, star->ring[r], mask.ends[1]);
    add_to_sum(s, c, star->ring[limni_star_left(star, r)], mask.opposite);
    add_to_sum(s, c, star->ring[limni_star_right(star, r)], mask.opposite);
    end_sum(s, dst);
}

/// The row at grid coordinates (i, j), or LIMNI_NONE outside the triangle.
static uint32_t grid_row(const subdivision *s, int i, int j) {
    for (uint32_t row = 0; row < CORE_MAX; row++) {
        if (s->domain->rows[row].i == i && s->domain->rows[row].j == j) return row;
    }
    return LIMNI_NONE;
}

/// The place, in the ring of core vertex w, of the edge that is place r in the ring of core vertex
/// v. Two faces back to back give pairs of edges between the same vertices: what lies beside tells
/// them apart.
static uint32_t opposite_place(const complex *c, uint32_t v, uint32_t r) {
    const limni_star *const from = &c->stars[v], *const to = &c->stars[from->ring[r]];
    const uint32_t left =
        limni_star_has_left(from, r) ? from->ring[limni_star_left(from, r)] : LIMNI_NONE;
    const uint32_t right =
        limni_star_has_right(from, r) ? from->ring[limni_star_right(from, r)] : LIMNI_NONE;
    for (uint32_t q = 0; q < to->count; q++) {
        if (to->ring[q] != v) continue;
        const uint32_t seen_right =
            limni_star_has_left(to, q) ? to->ring[limni_star_left(to, q)] : LIMNI_NONE;
        const uint32_t seen_left =
            limni_star_has_right(to, q) ? to->ring[limni_star_right(to, q)] : LIMNI_NONE;
        if (seen_left == left && seen_right == right) return q;
    }
    return LIMNI_NONE; // not reached: both ends see the same edge
}

// ---- One level

/// The place of the grid edge on which `row` appears in the ring of its first parent. Where there
/// are several edges between the two parents, the grid triangle beside it tells which one is meant.
static uint32_t grid_edge_place(const subdivision *s, const complex *c, uint32_t row) {
    const uint16_t *const parents = s->domain->rows[row].parents;
    const limn_row a = s->domain->rows[parents[0]], b = s->domain->rows[parents[1]];
    const limni_star *const star = &c->stars[parents[0]];
    const int di = b.i - a.i, dj = b.j - a.j;
    // A turn by 60 degrees takes (di, dj) to (-dj, di + dj), and back to (di + dj, -di).
    const uint32_t left = grid_row(s, a.i - dj, a.j + di + dj);
    const uint32_t right = grid_row(s, a.i + di + dj, a.j - di);
    for (uint32_t r = 0; r < star->count; r++) {
        if (star->ring[r] != parents[1]) continue;
        if (left != LIMNI_NONE
                ? limni_star_has_left(star, r) && star->ring[limni_star_left(star, r)] == left
                : limni_star_has_right(star, r) && star->ring[limni_star_right(star, r)] == right)
            return r;
    }
    return LIMNI_NONE; // not reached: the grid is part of the complex
}

static void set_edge_point(complex *c, uint32_t v, uint32_t r, uint32_t point) {
    const uint32_t w = c->stars[v].ring[r];
    c->edge_points[v][r] = point;
    if (w < c->core_count) c->edge_points[w][opposite_place(c, v, r)] = point;
}

/// Numbers the vertices of the next level on all edges that touch the core: new rows first, as the
/// domain has them, then those outside. Returns how many vertices the next level has.
static uint32_t number_edge_points(const subdivision *s, complex *c, uint32_t next_core_count) {
    for (uint32_t v = 0; v < c->core_count; v++)
        memset(c->edge_points[v], 0xff, c->stars[v].count * sizeof(uint32_t));
    for (uint32_t row = c->core_count; row < next_core_count; row++) {
        set_edge_point(c, s->domain->rows[row].parents[0], grid_edge_place(s, c, row), row);
    }
    uint32_t count = next_core_count;
    for (uint32_t v = 0; v < c->core_count; v++) {
        for (uint32_t r = 0; r < c->stars[v].count; r++) {
            if (c->edge_points[v][r] == LIMNI_NONE) set_edge_point(c, v, r, count++);
        }
    }
    return count;
}

/// The ring of a new vertex on the edge from core vertex a to its ring vertex r.
static limni_star edge_point_star(const complex *c, uint32_t a, uint32_t r, uint32_t *ring) {
    const limni_star *const star = &c->stars[a];
    const uint32_t b = star->ring[r], q = opposite_place(c, a, r);
    const limni_star *const other = &c->stars[b];
    const bool left = limni_star_has_left(star, r), right = limni_star_has_right(star, r);
    limni_star made = {.closed = left && right, .ring = ring};
    if (left) {
        ring[made.count++] = b;
        ring[made.count++] = c->edge_points[b][limni_star_right(other, q)];
        ring[made.count++] = c->edge_points[a][limni_star_left(star, r)];
    }
    ring[made.count++] = a;
    if (right) {
        ring[made.count++] = c->edge_points[a][limni_star_right(star, r)];
        ring[made.count++] = c->edge_points[b][limni_star_left(other, q)];
        if (!left) ring[made.count++] = b;
    }
    return made;
}

static void make_rings(const subdivision *s, const complex *c, complex *next) {
    uint32_t *ring = next->ring_pool;
    for (uint32_t row = 0; row < next->core_count; row++) {
        limni_star *const star = &next->stars[row];
        if (row < c->core_count) {
            const limni_star *const old = &c->stars[row];
            *star = (limni_star){.closed = old->closed, .count = old->count, .ring = ring};
            memcpy(ring, c->edge_points[row], star->count * sizeof *ring);
        } else {
            const uint32_t parent = s->domain->rows[row].parents[0];
            *star = edge_point_star(c, parent, grid_edge_place(s, c, row), ring);
        }
        ring += star->count;
    }
    for (uint32_t row = 0; row < next->core_count; row++) {
        next->edge_points[row] = ring;
        ring += next->stars[row].count;
    }
}

// ---- Sharpness

static void sharpen_old_star(const limni_rules *rules, const limni_star *old, limni_star *star) {
    star->sharpness = limni_sharpness_next(old->sharpness);
    for (uint32_t r = 0; star->edges && r < star->count; r++) {
        star->edges[r] = limni_star_next_edge(rules, old, r);
        star->beyond[r] = limni_star_next_beyond(rules, old, r);
    }
}

/// A new vertex has the halves of its edge, and no other sharp edge; their far ends, its parents,
/// come before it.
static void sharpen_new_star(const limni_rules *rules, const complex *c, uint32_t a, uint32_t r,
                             const complex *next, limni_star *star) {
    const uint32_t ends[2] = {a, c->stars[a].ring[r]};
    const uint32_t places[2] = {r, opposite_place(c, a, r)};
    memset(star->edges, 0, star->count * sizeof *star->edges);
    memset(star->beyond, 0, star->count * sizeof *star->beyond);
    for (int end = 0; end < 2; end++) {
        const limni_star *const parent = &next->stars[ends[end]];
        uint32_t q = 0;
        while (star->ring[q] != ends[end])
            q++;
        star->edges[q] = parent->edges[places[end]];
        limni_star_see(rules, parent, places[end], 1, &star->beyond[q]);
    }
}

static void sharpen_stars(const subdivision *s, const complex *c, complex *next) {
    uint32_t *pool = next->sharpness_pool;
    for (uint32_t row = 0; row < next->core_count; row++) {
        limni_star *const star = &next->stars[row];
        if (pool) {
            star->edges = pool;
            star->beyond = pool + star->count;
            pool += 2 * star->count;
        }
        if (row < c->core_count) {
            sharpen_old_star(s->rules, &c->stars[row], star);
        } else if (pool) {
            sharpen_new_star(s->rules, c, s->domain->rows[row].parents[0],
                             grid_edge_place(s, c, row), next, star);
        }
    }
}

// ---- Levels

/// with_sharpness  of edges
static limn_bake_status allocate_level(const subdivision *s, uint32_t core_count,
                                       uint32_t vertex_count, size_t ring_total,
                                       bool with_sharpness, complex *c) {
    c->core_count = core_count;
    c->vertex_count = vertex_count;
    c->ring_pool = limni_allocate(s->context, 2 * ring_total, sizeof *c->ring_pool);
    c->coefficients = limni_allocate(s->context, (size_t)vertex_count * s->control_count,
                                     sizeof *c->coefficients);
    c->sharpness_pool = NULL;
    if (!c->ring_pool || !c->coefficients) return LIMN_BAKE_MEMORY;
    if (!with_sharpness) return LIMN_BAKE_OK;
    c->sharpness_pool = limni_allocate(s->context, 2 * ring_total, sizeof *c->sharpness_pool);
    return c->sharpness_pool ? LIMN_BAKE_OK : LIMN_BAKE_MEMORY;
}

static void release_level(const subdivision *s, complex *c) {
    limni_release(s->context, c->ring_pool);
    limni_release(s->context, c->sharpness_pool);
    limni_release(s->context, c->coefficients);
}

static limn_bake_status refine(const subdivision *s, complex *c, uint32_t next_core_count,
                               complex *next) {
    const uint32_t count = number_edge_points(s, c, next_core_count);
    size_t ring_total = 6 * (size_t)next_core_count; // new vertices have at most 6 neighbours
    for (uint32_t v = 0; v < c->core_count; v++)
        ring_total += c->stars[v].count;
    LIMNI_TRY(allocate_level(s, next_core_count, count, ring_total, c->sharpness_pool, next));

    for (uint32_t v = 0; v < c->core_count; v++) {
        limni_loop_vertex_mask(s->rules, &c->stars[v], s->weights);
        apply_vertex_mask(s, c, v, s->weights, vertex_of(s, next, v));
        for (uint32_t r = 0; r < c->stars[v].count; r++)
            apply_edge_mask(s, c, v, r, vertex_of(s, next, c->edge_points[v][r]));
    }
    make_rings(s, c, next);
    sharpen_stars(s, c, next);
    return LIMN_BAKE_OK;
}

// ---- All levels

/// A complex of the first `core_count` vertices with these stars, before any level. The
/// coefficients are left to the caller.
static limn_bake_status begin(const subdivision *s, const limni_star *stars, uint32_t core_count,
                              uint32_t vertex_count, complex *c) {
    size_t ring_total = 0;
    for (uint32_t v = 0; v < core_count; v++)
        ring_total += stars[v].count;
    LIMNI_TRY(allocate_level(s, core_count, vertex_count, ring_total, stars[0].edges, c));

    size_t first = 0;
    for (uint32_t v = 0; v < core_count; v++) {
        limni_star *const star = &c->stars[v];
        *star = stars[v];
        star->ring = memcpy(c->ring_pool + first, star->ring, star->count * sizeof *star->ring);
        c->edge_points[v] = c->ring_pool + ring_total + first;
        if (star->edges) {
            const size_t size = star->count * sizeof *star->edges;
            star->edges = memcpy(c->sharpness_pool + first, star->edges, size);
            star->beyond = memcpy(c->sharpness_pool + ring_total + first, star->beyond, size);
        }
        first += star->count;
    }
    return LIMN_BAKE_OK;
}

/// Each vertex is a control point, its own or that of its twin.
static void set_identity(const subdivision *s, const uint32_t *twins, complex *c) {
    memset(c->coefficients, 0, (size_t)c->vertex_count * s->control_count * sizeof(limni_fixed));
    for (uint32_t v = 0; v < c->vertex_count; v++)
        vertex_of(s, c, v)[twins ? twins[v] : v] = LIMNI_FIXED_ONE;
}

// ---- The limit

/// Refines a complex of one core vertex until it is settled.
static limn_bake_status settle(const subdivision *s, complex *c) {
    while (!limni_star_is_settled(s->rules, &c->stars[0])) {
        complex next;
        LIMNI_TRY(refine(s, c, 1, &next));
        release_level(s, c);
        *c = next;
    }
    return LIMN_BAKE_OK;
}

/// One core vertex and its ring as a complex of their own, which is closed under subdivision,
/// settled.
static limn_bake_status settle_row(const subdivision *s, const complex *c, uint32_t row,
                                   complex *settled) {
    limni_star star = c->stars[row];
    const uint32_t vertex_count = 1 + star.count;
    star.ring = limni_allocate(s->context, star.count, sizeof *star.ring);
    if (!star.ring) return LIMN_BAKE_MEMORY;
    for (uint32_t r = 0; r < star.count; r++)
        star.ring[r] = 1 + r;
    LIMNI_TRY(begin(s, &star, 1, vertex_count, settled));
    limni_release(s->context, star.ring);
    const size_t size = s->control_count * sizeof(limni_fixed);
    memcpy(vertex_of(s, settled, 0), vertex_of(s, c, row), size);
    for (uint32_t r = 0; r < star.count; r++)
        memcpy(vertex_of(s, settled, 1 + r), vertex_of(s, c, c->stars[row].ring[r]), size);
    return settle(s, settled);
}

/// In half steps around a closed ring, where the tangents of a row start: on an edge, at the next
/// row along it; inside, halfway between the directions of i and j, so that mirrored rows have
/// mirrored tangents.
static uint32_t tangent_start(const subdivision *s, const complex *c, uint32_t row, int depth) {
    static const int directions[4][2] = {{1, 0}, {-1, 1}, {0, -1}, {1, 0}};
    const limn_row place = s->domain->rows[row];
    const int step = LIMN_GRID_SIZE >> depth;
    uint32_t edge = 0; // or 3: none
    while (edge < 3 && !(place.edges >> edge & 1))
        edge++;
    const uint32_t next =
        grid_row(s, place.i + step * directions[edge][0], place.j + step * directions[edge][1]);
    uint32_t r = 0;
    while (r + 1 < c->stars[row].count && c->stars[row].ring[r] != next)
        r++;
    return 2 * r + (edge == 3);
}

/// Where the rows of a level go.
typedef struct limit_rows {
    limni_fixed *positions;
    limni_fixed *tangents[2]; ///< NULL: not wanted
} limit_rows;

/// The limit of core vertex v, which is settled.
///
/// start  see limni_loop_tangent_masks()
static void project(const subdivision *s, const complex *c, uint32_t v, uint32_t start,
                    const limit_rows *dst) {
    const limni_star *const star = &c->stars[v];
    limni_fixed *const along = s->weights, *const across = along + s->weight_count;
    if (dst->positions) {
        limni_loop_limit_mask(s->rules, star, s->weights);
        apply_vertex_mask(s, c, v, s->weights, dst->positions);
    }
    if (!dst->tangents[0]) return;
    limni_loop_tangent_masks(s->rules, star, start, along, across);
    apply_vertex_mask(s, c, v, along, dst->tangents[0]);
    apply_vertex_mask(s, c, v, across, dst->tangents[1]);
}

static limn_bake_status project_row(const subdivision *s, const complex *c, uint32_t row,
                                    uint32_t start, const limit_rows *dst) {
    if (limni_star_is_settled(s->rules, &c->stars[row])) {
        project(s, c, row, start, dst);
        return LIMN_BAKE_OK;
    }
    complex settled;
    LIMNI_TRY(settle_row(s, c, row, &settled));
    project(s, &settled, 0, start, dst);
    release_level(s, &settled);
    return LIMN_BAKE_OK;
}

static limn_bake_status project_rows(const subdivision *s, const complex *c, int depth,
                                     limni_fixed *positions, limni_fixed *tangents) {
    const size_t table_size = (size_t)c->core_count * s->control_count;
    if (tangents) memset(tangents, 0, 2 * table_size * sizeof *tangents);
    for (uint32_t row = 0; row < c->core_count; row++) {
        const bool corner = row < s->domain->corner_count;
        const size_t first = (size_t)row * s->control_count;
        limit_rows dst = {.positions = positions + first};
        if (tangents && !corner) {
            dst.tangents[0] = tangents + first;
            dst.tangents[1] = tangents + table_size + first;
        }
        const uint32_t start = corner ? 0 : tangent_start(s, c, row, depth);
        LIMNI_TRY(project_row(s, c, row, start, &dst));
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status begin_subdivision(limni_context *context, const limni_rules *rules,
                                          uint32_t control_count, subdivision *s) {
    *s = (subdivision){
        .context = context,
        .rules = rules,
        .domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE),
        .control_count = control_count,
        .weight_count = control_count + 7,
        .sums = limni_allocate(context, control_count, sizeof *s->sums),
    };
    s->weights = limni_allocate(context, 2 * (size_t)s->weight_count, sizeof *s->weights);
    return s->sums && s->weights ? LIMN_BAKE_OK : LIMN_BAKE_MEMORY;
}

static void end_subdivision(const subdivision *s) {
    limni_release(s->context, s->sums);
    limni_release(s->context, s->weights);
}

limn_bake_status limni_subdivide(limni_context *context, const limni_rules *rules,
                                 const limni_neighbourhood *neighbourhood, int depth,
                                 limni_projection projection, limni_fixed *positions,
                                 limni_fixed *tangents) {
    const uint32_t control_count = neighbourhood->control_count;
    subdivision s;
    complex level;
    LIMNI_TRY(begin_subdivision(context, rules, control_count, &s));
    LIMNI_TRY(begin(&s, neighbourhood->corners, 3, control_count, &level));
    set_identity(&s, neighbourhood->twins, &level);
    for (int n = 1; n <= depth; n++) {
        complex next;
        LIMNI_TRY(refine(&s, &level, s.domain->row_counts[n], &next));
        release_level(&s, &level);
        level = next;
    }
    if (projection == LIMNI_PROJECT_TO_LIMIT) {
        LIMNI_TRY(project_rows(&s, &level, depth, positions, tangents));
    } else {
        memcpy(positions, level.coefficients,
               (size_t)level.core_count * control_count * sizeof *positions);
    }
    release_level(&s, &level);
    end_subdivision(&s);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_star_tangents(limni_context *context, const limni_rules *rules,
                                     const limni_star *star, uint32_t half_steps,
                                     limni_fixed *along, limni_fixed *across) {
    subdivision s;
    complex c;
    LIMNI_TRY(begin_subdivision(context, rules, 1 + star->count, &s));
    LIMNI_TRY(begin(&s, star, 1, 1 + star->count, &c));
    for (uint32_t r = 0; r < star->count; r++)
        c.stars[0].ring[r] = 1 + r;
    set_identity(&s, NULL, &c);
    LIMNI_TRY(settle(&s, &c));
    project(&s, &c, 0, half_steps, &(limit_rows){.tangents = {along, across}});
    release_level(&s, &c);
    end_subdivision(&s);
    return LIMN_BAKE_OK;
}
