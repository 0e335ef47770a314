/* SPDX-License-Identifier: MIT */
#include "deviation.h"

#include <string.h>

typedef double vector[3];
typedef double padded[4]; ///< a vector and 0: its sums are vector instructions

static double dot(const vector a, const vector b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const vector a, const vector b, vector product) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static void subtract(const float a[3], const float b[3], vector difference) {
    for (int axis = 0; axis < 3; axis++)
        difference[axis] = (double)a[axis] - (double)b[axis];
}

// ---- Which triangles are near which rows

static int cross_of_grid(limn_row a, limn_row b, limn_row p) {
    return (b.i - a.i) * (p.j - a.j) - (b.j - a.j) * (p.i - a.i);
}

static bool contains(const limn_domain *domain, const uint16_t *corners, uint32_t row) {
    for (int c = 0; c < 3; c++) {
        if (cross_of_grid(domain->rows[corners[c]], domain->rows[corners[(c + 1) % 3]],
                          domain->rows[row]) < 0)
            return false;
    }
    return true;
}

static int count_common(const uint16_t *a, const uint16_t *b) {
    int count = 0;
    for (int i = 0; i < 9; i++)
        count += a[i / 3] == b[i % 3];
    return count;
}

static limni_near find_near(const limn_domain *domain, uint32_t level, uint32_t row) {
    const uint16_t *const indices = domain->indices[level];
    const uint32_t count = domain->index_counts[level] / 3u;
    uint32_t own = 0;
    while (!contains(domain, indices + 3 * own, row))
        own++;
    limni_near near = {.count = 1, .triangles = {(uint16_t)own}};
    for (uint32_t t = 0; t < count; t++) {
        if (count_common(indices + 3 * own, indices + 3 * t) == 2)
            near.triangles[near.count++] = (uint16_t)t;
    }
    return near;
}

void limni_ruler_begin(limni_ruler *ruler, const limn_domain *domain) {
    ruler->domain = domain;
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX; level++) {
        for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++)
            ruler->near[level][row] = find_near(domain, level, row);
    }
}

// ---- From a point to a triangle

/// offset: of the point from the start of the segment
static double square_to_segment(const vector offset, const vector along) {
    const double projected = dot(offset, along), whole = dot(along, along);
    const double part = !(projected > 0) ? 0 : projected < whole ? projected / whole : 1;
    vector rest;
    for (int axis = 0; axis < 3; axis++)
        rest[axis] = offset[axis] - part * along[axis];
    return dot(rest, rest);
}

/// A triangle, prepared for many points.
typedef struct facet {
    bool prepared;
    const float *corner;
    vector sides[2]; ///< from the corner
    vector normal;
    vector duals[2]; ///< of a point's offset, they give its coordinates along the sides
    double scale;    ///< 1 / normal^2, or 0 where the triangle has no area
} facet;

static void prepare(facet *f, const float (*points)[3], const uint16_t *corners) {
    f->prepared = true;
    f->corner = points[corners[0]];
    subtract(points[corners[1]], f->corner, f->sides[0]);
    subtract(points[corners[2]], f->corner, f->sides[1]);
    cross(f->sides[0], f->sides[1], f->normal);
    const double square = dot(f->normal, f->normal);
    f->scale = square > 0 ? 1 / square : 0;
    cross(f->sides[1], f->normal, f->duals[0]);
    cross(f->normal, f->sides[0], f->duals[1]);
}

static double least(double a, double b) {
    return a < b ? a : b;
}

/// *over: whether the point lies over the triangle, not past one of its sides. The nearest point
/// of a triangle lies on a side that the point is past.
static double square_to_facet(const facet *f, const float point[3], bool *over) {
    vector offset;
    subtract(point, f->corner, offset);
    const bool flat = f->scale == 0;
    const double a = dot(offset, f->duals[0]) * f->scale, b = dot(offset, f->duals[1]) * f->scale;
    const double height = dot(offset, f->normal);
    *over = !flat && a >= 0 && b >= 0 && a + b <= 1;
    if (*over) return height * height * f->scale;
    double square = dot(offset, offset);
    if (flat || a < 0) square = least(square, square_to_segment(offset, f->sides[1]));
    if (flat || b < 0) square = least(square, square_to_segment(offset, f->sides[0]));
    if (flat || a + b > 1) {
        vector side;
        for (int axis = 0; axis < 3; axis++) {
            offset[axis] -= f->sides[0][axis];
            side[axis] = f->sides[1][axis] - f->sides[0][axis];
        }
        square = least(square, square_to_segment(offset, side));
    }
    return square;
}

// ---- One level of a patch

/// Where rows are off the middle of their parents, and off the surface of a level.
typedef struct offsets {
    padded middles[LIMNI_ROWS_MAX], level[LIMNI_ROWS_MAX];
} offsets;

static void find_middles(const limn_domain *domain, const float (*points)[3], offsets *off) {
    padded exact[LIMNI_ROWS_MAX];
    for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++) {
        for (int axis = 0; axis < 3; axis++)
            exact[row][axis] = (double)points[row][axis];
        exact[row][3] = 0;
        const uint16_t *const parents = domain->rows[row].parents;
        for (int axis = 0; axis < 4; axis++)
            off->middles[row][axis] =
                exact[row][axis] - (exact[parents[0]][axis] + exact[parents[1]][axis]) * 0.5;
    }
}

/// The triangles of a level are linear between its rows, so what a row is off them in the domain
/// follows from its parents. For one level after the other, from the finest on.
static void find_offsets(const limn_domain *domain, uint32_t level, offsets *off) {
    const uint32_t first = domain->row_counts[level], next = domain->row_counts[level + 1];
    memset(off->level, 0, first * sizeof(padded));
    memcpy(off->level + first, off->middles + first, (next - first) * sizeof(padded));
    for (uint32_t row = next; row < domain->row_counts[LIMN_LEVEL_MAX]; row++) {
        const uint16_t *const parents = domain->rows[row].parents;
        const double *const a = off->level[parents[0]], *const b = off->level[parents[1]];
        for (int axis = 0; axis < 4; axis++)
            off->level[row][axis] = off->middles[row][axis] + (a[axis] + b[axis]) * 0.5;
    }
}

/// A row is at most as far off the chords as it is in the domain. Rows in the middle of chords come
/// first: as a rule they are the furthest off, and settle it.
static double square_to_chords(const limn_domain *domain, uint32_t edge, uint32_t level,
                               const float (*points)[3], const offsets *off) {
    const uint16_t *const along = domain->edge_rows[edge];
    const uint32_t step = LIMN_GRID_SIZE >> level;
    double worst = 0;
    for (uint32_t half = step / 2; half > 0; half /= 2) {
        for (uint32_t t = half; t < LIMN_GRID_SIZE; t += 2 * half) {
            const double *const offset = off->level[along[t]];
            const uint32_t start = t & ~(step - 1);
            if (dot(offset, offset) <= worst) continue;
            vector from_start, chord;
            subtract(points[along[t]], points[along[start]], from_start);
            subtract(points[along[start + step]], points[along[start]], chord);
            const double square = square_to_segment(from_start, chord);
            worst = square > worst ? square : worst;
        }
    }
    return worst;
}

static double square_to_near(const limni_ruler *ruler, uint32_t level, uint32_t row,
                             const float (*points)[3], facet *facets) {
    const limni_near *const near = &ruler->near[level][row];
    bool over = false;
    double square = 0;
    for (uint32_t k = 0; k < near->count && !over; k++) {
        facet *const f = &facets[near->triangles[k]];
        if (!f->prepared)
            prepare(f, points, ruler->domain->indices[level] + 3 * near->triangles[k]);
        const double other = square_to_facet(f, points[row], &over);
        square = k == 0 ? other : least(square, other);
    }
    return square;
}

// ---- All levels

/// What rows may miss, as a factor to squares. A quadratic surface that is as far off over all
/// three sides of a triangle is 4/3 of that off in the middle. The row next to the middle, `seen`
/// levels below, is off by 1 - 4^-seen of the most. At level 3, where only the middles of sides
/// have rows, 4/3 is the most that any quadratic surface can be off between them.
static double between_rows(uint32_t seen) {
    const double quarters = (double)(1u << 2 * seen), factor = quarters / (quarters - 1);
    return factor * factor;
}

/// Without the rows on edges, and not less than `least_edge`, since that much counts already.
static double square_inside(const limni_ruler *ruler, uint32_t level, const float (*points)[3],
                            const offsets *off, double least_edge) {
    const double factor = between_rows(LIMN_LEVEL_MAX - level);
    facet facets[2u << 2 * (LIMN_LEVEL_MAX - 1)]; // of quads
    for (uint32_t t = 0; t < ruler->domain->index_counts[level] / 3u; t++)
        facets[t].prepared = false;
    double worst = least_edge / factor;
    for (uint32_t row = ruler->domain->row_counts[level];
         row < ruler->domain->row_counts[LIMN_LEVEL_MAX]; row++) {
        if (ruler->domain->rows[row].edges) continue;
        if (dot(off->level[row], off->level[row]) <= worst) continue;
        const double square = square_to_near(ruler, level, row, points, facets);
        worst = square > worst ? square : worst;
    }
    return worst * factor;
}

void limni_deviation_measure(const limni_ruler *ruler, const float (*points)[3],
                             limni_deviation *deviation) {
    const limn_domain *const domain = ruler->domain;
    offsets off;
    find_middles(domain, points, &off);
    for (uint32_t level = LIMN_LEVEL_MAX; level-- > 0;) {
        find_offsets(domain, level, &off);
        double least_edge = 0;
        for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
            const double square = square_to_chords(domain, edge, level, points, &off);
            deviation->edges[edge][level] = square;
            least_edge = edge == 0 ? square : least(least_edge, square);
        }
        deviation->inside[level] = square_inside(ruler, level, points, &off, least_edge);
    }
}
