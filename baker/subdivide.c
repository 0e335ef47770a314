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
    limni_fixed *coefficients; ///< [vertex_count][control_count]
} complex;

typedef struct subdivision {
    limni_context *context;
    const limni_rules *rules;
    const limn_domain *domain;
    uint32_t control_count;
    limni_wide *sums;     ///< [control_count]
    limni_fixed *weights; ///< of two vertex masks
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

static bool has_left(const limni_star *star, uint32_t r) {
    return star->closed || r + 1 < star->count;
}
static bool has_right(const limni_star *star, uint32_t r) {
    return star->closed || r > 0;
}
static uint32_t left_of(const limni_star *star, uint32_t r) {
    return r + 1 < star->count ? r + 1 : 0;
}
static uint32_t right_of(const limni_star *star, uint32_t r) {
    return r > 0 ? r - 1 : star->count - 1;
}

/// Applies the edge mask between core vertex v and its ring vertex r.
static void apply_edge_mask(const subdivision *s, const complex *c, uint32_t v, uint32_t r,
                            limni_fixed *dst) {
    const limni_star *const star = &c->stars[v];
    const bool boundary = !has_left(star, r) || !has_right(star, r);
    const limni_edge_mask mask = limni_loop_edge_mask(boundary);
    begin_sum(s);
    add_to_sum(s, c, v, mask.end);
    add_to_sum(s, c, star->ring[r], mask.end);
    add_to_sum(s, c, star->ring[left_of(star, r)], mask.opposite);
    add_to_sum(s, c, star->ring[right_of(star, r)], mask.opposite);
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
    const uint32_t left = has_left(from, r) ? from->ring[left_of(from, r)] : LIMNI_NONE;
    const uint32_t right = has_right(from, r) ? from->ring[right_of(from, r)] : LIMNI_NONE;
    for (uint32_t q = 0; q < to->count; q++) {
        if (to->ring[q] != v) continue;
        const uint32_t seen_right = has_left(to, q) ? to->ring[left_of(to, q)] : LIMNI_NONE;
        const uint32_t seen_left = has_right(to, q) ? to->ring[right_of(to, q)] : LIMNI_NONE;
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
        if (left != LIMNI_NONE ? has_left(star, r) && star->ring[left_of(star, r)] == left
                               : has_right(star, r) && star->ring[right_of(star, r)] == right)
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

/// The star of a new vertex on the edge from core vertex a to its ring vertex r.
static limni_star edge_point_star(const complex *c, uint32_t a, uint32_t r, uint32_t *ring) {
    const limni_star *const star = &c->stars[a];
    const uint32_t b = star->ring[r], q = opposite_place(c, a, r);
    const limni_star *const other = &c->stars[b];
    const bool left = has_left(star, r), right = has_right(star, r);
    limni_star made = {.closed = left && right, .ring = ring};
    made.rule = made.closed ? LIMNI_VERTEX_SMOOTH : LIMNI_VERTEX_CREASE;
    if (left) {
        ring[made.count++] = b;
        ring[made.count++] = c->edge_points[b][right_of(other, q)];
        ring[made.count++] = c->edge_points[a][left_of(star, r)];
    }
    ring[made.count++] = a;
    if (right) {
        ring[made.count++] = c->edge_points[a][right_of(star, r)];
        ring[made.count++] = c->edge_points[b][left_of(other, q)];
        if (!left) ring[made.count++] = b;
    }
    return made;
}

static void make_stars(const subdivision *s, const complex *c, complex *next) {
    uint32_t *ring = next->ring_pool;
    for (uint32_t row = 0; row < next->core_count; row++) {
        limni_star *const star = &next->stars[row];
        if (row < c->core_count) {
            *star = c->stars[row];
            star->ring = ring;
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

static limn_bake_status allocate_level(const subdivision *s, uint32_t core_count,
                                       uint32_t vertex_count, size_t ring_total, complex *c) {
    c->core_count = core_count;
    c->vertex_count = vertex_count;
    c->ring_pool = limni_allocate(s->context, 2 * ring_total, sizeof *c->ring_pool);
    c->coefficients = limni_allocate(s->context, (size_t)vertex_count * s->control_count,
                                     sizeof *c->coefficients);
    return c->ring_pool && c->coefficients ? LIMN_BAKE_OK : LIMN_BAKE_MEMORY;
}

static void release_level(const subdivision *s, complex *c) {
    limni_release(s->context, c->ring_pool);
    limni_release(s->context, c->coefficients);
}

static limn_bake_status refine(const subdivision *s, complex *c, uint32_t next_core_count,
                               complex *next) {
    const uint32_t count = number_edge_points(s, c, next_core_count);
    size_t ring_total = 6 * (size_t)next_core_count; // new vertices have at most 6 neighbours
    for (uint32_t v = 0; v < c->core_count; v++)
        ring_total += c->stars[v].count;
    LIMNI_TRY(allocate_level(s, next_core_count, count, ring_total, next));

    for (uint32_t v = 0; v < c->core_count; v++) {
        limni_loop_vertex_mask(s->rules, &c->stars[v], s->weights);
        apply_vertex_mask(s, c, v, s->weights, vertex_of(s, next, v));
        for (uint32_t r = 0; r < c->stars[v].count; r++)
            apply_edge_mask(s, c, v, r, vertex_of(s, next, c->edge_points[v][r]));
    }
    make_stars(s, c, next);
    return LIMN_BAKE_OK;
}

// ---- All levels

static limn_bake_status begin(const subdivision *s, const limni_neighbourhood *n, complex *c) {
    size_t ring_total = 0;
    for (int corner = 0; corner < 3; corner++)
        ring_total += n->corners[corner].count;
    LIMNI_TRY(allocate_level(s, 3, n->control_count, ring_total, c));
    memset(c->coefficients, 0, (size_t)n->control_count * n->control_count * sizeof(limni_fixed));
    for (uint32_t v = 0; v < n->control_count; v++)
        vertex_of(s, c, v)[v] = LIMNI_FIXED_ONE;

    uint32_t *ring = c->ring_pool;
    for (int corner = 0; corner < 3; corner++) {
        limni_star *const star = &c->stars[corner];
        *star = n->corners[corner];
        star->ring = memcpy(ring, star->ring, star->count * sizeof *ring);
        c->edge_points[corner] = ring + ring_total;
        ring += star->count;
    }
    return LIMN_BAKE_OK;
}

static void project_to_limit(const subdivision *s, const complex *c, limni_fixed *rows) {
    for (uint32_t row = 0; row < c->core_count; row++) {
        limni_loop_limit_mask(s->rules, &c->stars[row], s->weights);
        apply_vertex_mask(s, c, row, s->weights, rows + (size_t)row * s->control_count);
    }
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

static void find_tangents(const subdivision *s, const complex *c, int depth,
                          limni_fixed *tangents) {
    const size_t table_size = (size_t)c->core_count * s->control_count;
    memset(tangents, 0, 2 * table_size * sizeof *tangents);
    for (uint32_t row = s->domain->corner_count; row < c->core_count; row++) {
        limni_fixed *const along = s->weights, *const across = along + s->control_count + 7;
        limni_fixed *const dst = tangents + (size_t)row * s->control_count;
        limni_loop_tangent_masks(&c->stars[row], tangent_start(s, c, row, depth), along, across);
        apply_vertex_mask(s, c, row, along, dst);
        apply_vertex_mask(s, c, row, across, dst + table_size);
    }
}

limn_bake_status limni_subdivide(limni_context *context, const limni_rules *rules,
                                 const limni_neighbourhood *neighbourhood, int depth,
                                 limni_projection projection, limni_fixed *positions,
                                 limni_fixed *tangents) {
    const uint32_t control_count = neighbourhood->control_count;
    const subdivision s = {
        .context = context,
        .rules = rules,
        .domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE),
        .control_count = control_count,
        .sums = limni_allocate(context, control_count, sizeof *s.sums),
        .weights = limni_allocate(context, 2 * ((size_t)control_count + 7), sizeof *s.weights),
    };
    if (!s.sums || !s.weights) return LIMN_BAKE_MEMORY;

    complex level;
    LIMNI_TRY(begin(&s, neighbourhood, &level));
    for (int n = 1; n <= depth; n++) {
        complex next;
        LIMNI_TRY(refine(&s, &level, s.domain->row_counts[n], &next));
        release_level(&s, &level);
        level = next;
    }
    if (projection == LIMNI_PROJECT_TO_LIMIT) {
        project_to_limit(&s, &level, positions);
    } else {
        memcpy(positions, level.coefficients,
               (size_t)level.core_count * control_count * sizeof *positions);
    }
    if (tangents) find_tangents(&s, &level, depth, tangents);
    release_level(&s, &level);
    limni_release(context, s.sums);
    limni_release(context, s.weights);
    return LIMN_BAKE_OK;
}
