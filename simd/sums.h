/* SPDX-License-Identifier: MIT */
/*
 * From control points and a table to the rows of one patch.
 *
 * Bitwise watertight (docs/mathematics.md): lanes run across rows, never across a sum. Every row that
 * patches may share is the sum of its control points in ascending global order, starting from +0
 * and rounded after each product and each sum, so two patches that share it add the same numbers in
 * the same order. Slots outside a row's support have coefficient +0 and leave the sum as it is.
 */
#ifndef SUMS_H
#define SUMS_H

#include "../runtime/domain.h"
#include "../runtime/kernels.h"

/// A vector for every row of one patch: structure of arrays, in L1. Loops over rows go on to the
/// end of a vector.
enum {
    STAGED = LIMNI_PADDED_ROWS_MAX, ///< from here on, rows of edges wait for their places
    PLANE = STAGED + LIMN_CORNER_MAX * LIMNI_EDGE_ROWS + LANES_WIDTH
};
typedef struct vectors {
    _Alignas(64) float axes[3][PLANE];
} vectors;

static inline void copy_row(vectors *rows, size_t from, size_t to) {
    for (int axis = 0; axis < 3; axis++)
        rows->axes[axis][to] = rows->axes[axis][from];
}

static inline void copy_four_rows(const vectors *src, size_t from, vectors *dst, size_t to) {
    for (int axis = 0; axis < 3; axis++)
        quad_store(&dst->axes[axis][to], quad_load(&src->axes[axis][from]));
}

/// A control point relative to some origin, and its column.
typedef struct term {
    float point[3];
    uint32_t column; ///< from the start of the table, in floats
} term;
LIMN_STATIC_ASSERT(sizeof(term) == 16, "a term is a quad");

static inline void set_term(term *dst, quad point, uint32_t column) {
    quad_store(dst, point);
    dst->column = column;
}

/// Terms to sum.
typedef struct terms {
    const term *begin, *end;
} terms;

/// What sums are computed from: one patch with its control points gathered.
typedef struct patch {
    const float *table;
    const float *origin;      ///< [3] added to every sum
    terms all;                ///< rows on edges: in ascending order of the control points
    const float *pair_origin; ///< where the class has pairs: the same for those
    terms even, odd;          ///< see sum_pair_tile()
} patch;

/// Sums of `count` vectors of rows; at most LANES_TILE, so that they are registers.
typedef struct tile {
    lanes x[LANES_TILE], y[LANES_TILE], z[LANES_TILE];
} tile;

static LIMNI_INLINE void clear_tile(tile *t, int count) {
    LIMNI_UNROLL
    for (int v = 0; v < count; v++)
        t->x[v] = t->y[v] = t->z[v] = lanes_zero();
}

/// Adds terms to rows `columns`, the table from the first of these rows on.
static LIMNI_INLINE void add_to_tile(tile *t, int count, const float *columns, terms of) {
    LIMNI_UNROLL_TWICE
    for (const term *k = of.begin; k != of.end; k++) {
        const float *const column = columns + k->column;
        const lanes x = lanes_splat(k->point[0]);
        const lanes y = lanes_splat(k->point[1]);
        const lanes z = lanes_splat(k->point[2]);
        LIMNI_UNROLL
        for (int v = 0; v < count; v++) {
            const lanes coefficient = lanes_load(column + v * LANES_WIDTH);
            t->x[v] = lanes_multiply_add(coefficient, x, t->x[v]);
            t->y[v] = lanes_multiply_add(coefficient, y, t->y[v]);
            t->z[v] = lanes_multiply_add(coefficient, z, t->z[v]);
        }
    }
}

/// Adds the origin and stores the sums of vector v.
static inline void store_sums(const tile *t, int v, const float *origin, size_t row, vectors *out) {
    lanes_store(&out->axes[0][row], lanes_add(t->x[v], lanes_splat(origin[0])));
    lanes_store(&out->axes[1][row], lanes_add(t->y[v], lanes_splat(origin[1])));
    lanes_store(&out->axes[2][row], lanes_add(t->z[v], lanes_splat(origin[2])));
}

// ---- Rows one by one

/// Rows [table_row, table_row + count * LANES_WIDTH) of the columns.
static LIMNI_INLINE void sum_tile(const patch *p, size_t table_row, size_t row, int count,
                                  vectors *out) {
    tile sums;
    clear_tile(&sums, count);
    add_to_tile(&sums, count, p->table + table_row, p->all);
    LIMNI_UNROLL
    for (int v = 0; v < count; v++)
        store_sums(&sums, v, p->origin, row + (size_t)v * LANES_WIDTH, out);
}

/// Full tiles, and one of just the vectors that are left. Not inlined: what a compiler would keep
/// in registers around the loop over patches are registers that the sums need (gcc 12 spills all
/// three splats).
static LIMNI_NOINLINE void sum_rows(const patch *p, const limni_segment *segment, vectors *out) {
    enum { TILE = LANES_TILE * LANES_WIDTH };
    const size_t table_row = segment->table_row, row = segment->row, count = segment->count;
    size_t at = 0;
    for (; at + TILE <= count; at += TILE)
        sum_tile(p, table_row + at, row + at, LANES_TILE, out);
    const int rest = (int)((count - at) / LANES_WIDTH);
    if (rest == 2) {
        sum_tile(p, table_row + at, row + at, 2, out);
    } else if (rest == 3 && LANES_TILE > 3) {
        sum_tile(p, table_row + at, row + at, 3, out);
    } else if (rest == 4 && LANES_TILE > 4) {
        sum_tile(p, table_row + at, row + at, 4, out);
    } else { // rarely more than one
        for (; at < count; at += LANES_WIDTH)
            sum_tile(p, table_row + at, row + at, 1, out);
    }
}

// ---- Tangents

/// Adds a term relative to `origin` to both tangents of the same rows.
static LIMNI_INLINE void add_to_tangents(const term *k, const lanes origin[3],
                                         const float *const columns[2], int count, tile sums[2]) {
    const lanes x = lanes_subtract(lanes_splat(k->point[0]), origin[0]);
    const lanes y = lanes_subtract(lanes_splat(k->point[1]), origin[1]);
    const lanes z = lanes_subtract(lanes_splat(k->point[2]), origin[2]);
    LIMNI_UNROLL
    for (int t = 0; t < 2; t++) {
        LIMNI_UNROLL
        for (int v = 0; v < count; v++) {
            const lanes coefficient = lanes_load(columns[t] + k->column + v * LANES_WIDTH);
            sums[t].x[v] = lanes_multiply_add(coefficient, x, sums[t].x[v]);
            sums[t].y[v] = lanes_multiply_add(coefficient, y, sums[t].y[v]);
            sums[t].z[v] = lanes_multiply_add(coefficient, z, sums[t].z[v]);
        }
    }
}

/// Both tangents of rows [table_row, table_row + count * LANES_WIDTH) of the columns.
static LIMNI_INLINE void sum_tangent_tile(const patch *p, size_t table_stride,
                                          const lanes origin[3], size_t table_row, size_t row,
                                          int count, vectors *const out[2]) {
    static const float nowhere[3] = {0};
    const float *const table = p->table + table_row;
    const float *const columns[2] = {table, table + table_stride};
    tile sums[2];
    clear_tile(&sums[0], count);
    clear_tile(&sums[1], count);
    for (const term *k = p->all.begin; k != p->all.end; k++)
        add_to_tangents(k, origin, columns, count, sums);
    LIMNI_UNROLL
    for (int v = 0; v < count; v++) {
        store_sums(&sums[0], v, nowhere, row + (size_t)v * LANES_WIDTH, out[0]);
        store_sums(&sums[1], v, nowhere, row + (size_t)v * LANES_WIDTH, out[1]);
    }
}

/// Both tangents of rows, in tables `table_stride` apart; the terms are relative to nothing.
static LIMNI_NOINLINE void sum_tangent_rows(const patch *p, size_t table_stride,
                                            const lanes origin[3], const limni_segment *segment,
                                            vectors *const out[2]) {
    enum { HALF = LANES_TILE / 2 > 0 ? LANES_TILE / 2 : 1, STEP = HALF * LANES_WIDTH };
    const size_t table_row = segment->table_row, row = segment->row;
    size_t at = 0;
    for (; at + STEP <= segment->count; at += STEP)
        sum_tangent_tile(p, table_stride, origin, table_row + at, row + at, HALF, out);
    for (; at < segment->count; at += LANES_WIDTH)
        sum_tangent_tile(p, table_stride, origin, table_row + at, row + at, 1, out);
}

// ---- Pairs of rows

LIMN_STATIC_ASSERT(LANES_PAIR_TILE *LANES_WIDTH % LIMN_FORMAT_ROW_BLOCK == 0,
                   "tiles of pairs begin with a block");

/// Where vector v of a tile of pairs goes: the row of one side or the other.
static inline size_t pair_row(const uint16_t *blocks, int v) {
    const size_t row = (size_t)v * LANES_WIDTH;
    return blocks[row / LIMN_FORMAT_ROW_BLOCK] + row % LIMN_FORMAT_ROW_BLOCK;
}

static inline void store_pair(lanes second, float *row, float *image) {
    const lanes first = lanes_load_any(row);
    lanes_store(row, lanes_add(first, second));
    lanes_store(image, lanes_subtract(first, second));
}

/// A class that is its own mirror image has control points in pairs, p and p', and rows in pairs, r
/// and r', with coefficients a and b: r = a p + b p', r' = b p + a p'. Then r = e + o and r' = e -
/// o where e = (a + b)/2 (p + p') and o = (a - b)/2 (p - p'): half the work. Control points that
/// are their own images belong to e. No other patch has such rows, so their order of summation is
/// ours. The first sums wait in `out`: there are not registers for both.
///
/// at      the first pair
/// negate  a row's image is the mirrored row with the opposite sign: r' = o - e
static LIMNI_INLINE void sum_pair_tile(const patch *p, const limni_layout *layout, size_t at,
                                       int count, bool negate, vectors *out) {
    const float *const columns = p->table + layout->pair_table_row + at;
    const uint16_t *const rows = &layout->pair_rows[at / LIMN_FORMAT_ROW_BLOCK];
    const uint16_t *const images = &layout->mirror_rows[at / LIMN_FORMAT_ROW_BLOCK];
    tile sums;
    clear_tile(&sums, count);
    add_to_tile(&sums, count, columns, negate ? p->odd : p->even);
    LIMNI_UNROLL
    for (int v = 0; v < count; v++)
        store_sums(&sums, v, p->pair_origin, pair_row(rows, v), out);

    clear_tile(&sums, count);
    add_to_tile(&sums, count, columns, negate ? p->even : p->odd);
    LIMNI_UNROLL
    for (int v = 0; v < count; v++) {
        const size_t row = pair_row(rows, v), image = pair_row(images, v);
        store_pair(sums.x[v], &out->axes[0][row], &out->axes[0][image]);
        store_pair(sums.y[v], &out->axes[1][row], &out->axes[1][image]);
        store_pair(sums.z[v], &out->axes[2][row], &out->axes[2][image]);
    }
}

static LIMNI_NOINLINE void sum_pairs(const patch *p, const limni_layout *layout, size_t pair_count,
                                     bool negate, vectors *out) {
    enum { TILE = LANES_PAIR_TILE * LANES_WIDTH };
    size_t at = 0;
    for (; at + TILE <= pair_count; at += TILE)
        sum_pair_tile(p, layout, at, LANES_PAIR_TILE, negate, out);
    if (at + 2 * LANES_WIDTH == pair_count) {
        sum_pair_tile(p, layout, at, 2, negate, out);
        return;
    }
    for (; at < pair_count; at += LIMN_FORMAT_ROW_BLOCK)
        sum_pair_tile(p, layout, at, LIMN_FORMAT_ROW_BLOCK / LANES_WIDTH, negate, out);
}

// ---- Long rows

/// One vector of rows, for classes with many control points. A plain sum of hundreds of terms loses
/// several digits, so long rows are summed with Kahan's compensation; short rows as everywhere else,
/// because a patch with few control points may share them. The axes are independent, and go
/// together: each would only wait for itself.
static LIMNI_INLINE void sum_long(const patch *p, size_t row, lanes sums[3]) {
    lanes plain[3], sum[3], lost[3], count = lanes_zero();
    for (int axis = 0; axis < 3; axis++)
        plain[axis] = sum[axis] = lost[axis] = lanes_zero();
    for (const term *k = p->all.begin; k != p->all.end; k++) {
        const lanes coefficient = lanes_load(p->table + k->column + row);
        count = lanes_add(count, lanes_select_zero(coefficient, lanes_zero(), lanes_splat(1.0f)));
        LIMNI_UNROLL
        for (int axis = 0; axis < 3; axis++) {
            const lanes point = lanes_splat(k->point[axis]);
            plain[axis] = lanes_multiply_add(coefficient, point, plain[axis]);

            const lanes product = lanes_subtract(lanes_multiply(coefficient, point), lost[axis]);
            const lanes next = lanes_add(sum[axis], product);
            const lanes error = lanes_subtract(lanes_subtract(next, sum[axis]), product);
            // A term with coefficient 0 must change nothing, not even what was lost before.
            lost[axis] = lanes_select_zero(coefficient, lost[axis], error);
            sum[axis] = lanes_select_zero(coefficient, sum[axis], next);
        }
    }
    for (int axis = 0; axis < 3; axis++)
        sums[axis] =
            lanes_select_greater(count, lanes_splat(LIMNI_PLAIN_TERMS), sum[axis], plain[axis]);
}

static LIMNI_NOINLINE void sum_long_rows(const patch *p, const limni_segment *segment,
                                         vectors *out) {
    for (size_t at = 0; at < segment->count; at += LANES_WIDTH) {
        lanes sums[3];
        sum_long(p, segment->table_row + at, sums);
        for (int axis = 0; axis < 3; axis++)
            lanes_store(&out->axes[axis][segment->row + at],
                        lanes_add(sums[axis], lanes_splat(p->origin[axis])));
    }
}

#endif
