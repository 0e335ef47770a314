/* SPDX-License-Identifier: MIT */
/*
 * The evaluation kernel, written once. A kernels_<isa>.c includes its lanes first, then this.
 *
 * Bitwise watertight (docs/design.md): lanes run across rows, never across a sum. Every row is the
 * sum of its control points in ascending global order, starting from +0 and rounded after each
 * product and each sum, so two patches that share a row add the same numbers in the same order.
 * Slots outside a row's support have coefficient +0 and leave the sum as it is.
 */
#include "../runtime/kernels.h"

#include <float.h>

#if defined(__FAST_MATH__)
#error "fast-math reorders the sums that shared vertices depend on"
#endif
LIMN_STATIC_ASSERT(FLT_EVAL_METHOD == 0, "floats must be rounded to float (-mfpmath=sse)");

/// A vector for every row of one patch: structure of arrays, in L1.
typedef struct vectors {
    _Alignas(64) float axes[3][LIMNI_ROW_MAX];
} vectors;

/// What a tile is computed from: one patch with its control points gathered.
typedef struct patch {
    const float *table;
    size_t row_stride;
    size_t control_count;
    const void *slots;
    const float (*points)[4]; ///< relative to the origin, in the order of the slots
} patch;

static inline const float *column_of(const patch *p, uint32_t slot_size, size_t k) {
    const size_t slot =
        slot_size == 1 ? ((const uint8_t *)p->slots)[k] : ((const uint16_t *)p->slots)[k];
    return p->table + slot * p->row_stride;
}

/// Rows [first_row, first_row + vector_count * LANES_WIDTH) of one patch. `vector_count` and
/// `slot_size` are constants where this is called, so that the accumulators are registers.
static inline void evaluate_tile(const patch *p, uint32_t slot_size, size_t first_row,
                                 int vector_count, vectors *out) {
    lanes x[LANES_TILE], y[LANES_TILE], z[LANES_TILE];
    LIMNI_UNROLL
    for (int v = 0; v < vector_count; v++)
        x[v] = y[v] = z[v] = lanes_zero();
    for (size_t k = 0; k < p->control_count; k++) {
        const float *const column = column_of(p, slot_size, k) + first_row;
        const lanes px = lanes_splat(p->points[k][0]);
        const lanes py = lanes_splat(p->points[k][1]);
        const lanes pz = lanes_splat(p->points[k][2]);
        LIMNI_UNROLL
        for (int v = 0; v < vector_count; v++) {
            const lanes coefficient = lanes_load(column + v * LANES_WIDTH);
            x[v] = lanes_multiply_add(coefficient, px, x[v]);
            y[v] = lanes_multiply_add(coefficient, py, y[v]);
            z[v] = lanes_multiply_add(coefficient, pz, z[v]);
        }
    }
    LIMNI_UNROLL
    for (int v = 0; v < vector_count; v++) {
        const size_t row = first_row + (size_t)v * LANES_WIDTH;
        lanes_store(&out->axes[0][row], x[v]);
        lanes_store(&out->axes[1][row], y[v]);
        lanes_store(&out->axes[2][row], z[v]);
    }
}

/// One vector of rows on one axis, for classes with many control points. A plain sum of hundreds of
/// terms loses several digits, so long rows are summed with Kahan's compensation; short rows as
/// everywhere else, because a patch with few control points may share them.
static inline lanes evaluate_long_sums(const patch *p, uint32_t slot_size, size_t row, int axis) {
    lanes plain = lanes_zero(), sum = lanes_zero(), lost = lanes_zero(), terms = lanes_zero();
    for (size_t k = 0; k < p->control_count; k++) {
        const lanes coefficient = lanes_load(column_of(p, slot_size, k) + row);
        const lanes point = lanes_splat(p->points[k][axis]);
        plain = lanes_multiply_add(coefficient, point, plain);

        const lanes term = lanes_subtract(lanes_multiply(coefficient, point), lost);
        const lanes next = lanes_add(sum, term);
        const lanes one = lanes_select_zero(coefficient, lanes_zero(), lanes_splat(1.0f));
        // A term with coefficient 0 must change nothing, not even what was lost before.
        lost =
            lanes_select_zero(coefficient, lost, lanes_subtract(lanes_subtract(next, sum), term));
        sum = lanes_select_zero(coefficient, sum, next);
        terms = lanes_add(terms, one);
    }
    return lanes_select_greater(terms, lanes_splat(LIMNI_PLAIN_TERMS), sum, plain);
}

static inline void evaluate_long_patch(const patch *p, uint32_t slot_size, size_t row_count,
                                       vectors *out) {
    for (int axis = 0; axis < 3; axis++) {
        for (size_t row = 0; row < row_count; row += LANES_WIDTH)
            lanes_store(&out->axes[axis][row], evaluate_long_sums(p, slot_size, row, axis));
    }
}

/// Full tiles, and one of just the vectors that are left.
static inline void evaluate_tiles(const patch *p, uint32_t slot_size, size_t row_count,
                                  vectors *out) {
    enum { TILE = LANES_TILE * LANES_WIDTH };
    size_t row = 0;
    for (; row + TILE <= row_count; row += TILE)
        evaluate_tile(p, slot_size, row, LANES_TILE, out);
    const int rest = (int)((row_count - row) / LANES_WIDTH);
    if (rest == 1) {
        evaluate_tile(p, slot_size, row, 1, out);
    } else if (rest == 2) {
        evaluate_tile(p, slot_size, row, 2, out);
    } else if (rest == 3 && LANES_TILE > 3) {
        evaluate_tile(p, slot_size, row, 3, out);
    } else if (rest == 4 && LANES_TILE > 4) {
        evaluate_tile(p, slot_size, row, 4, out);
    }
}

/// Not inlined: what a compiler would keep in registers around the loop over patches are registers
/// that the accumulators need (gcc 12 spills all three splats).
static LIMNI_NOINLINE void evaluate_narrow_patch(const patch *p, size_t row_count, vectors *out) {
    evaluate_tiles(p, 1, row_count, out);
}

static inline void gather(const uint32_t *indices, size_t count, const limni_points *from,
                          float (*points)[4]) {
    for (size_t k = 0; k < count; k++)
        lanes_subtract_point(points[k], from->controls + 3 * (size_t)indices[k], from->origin);
}

/// Unit normals from two tangents. Along a shared edge the neighbour has both tangents negated, bit
/// for bit, so that products, and all that follows, are the same but for the signs of zeros, which
/// store_vertices() makes alike.
static inline void find_normals(const vectors *along, const vectors *across, size_t row_count,
                                vectors *out) {
    const lanes zero = lanes_zero(), one = lanes_splat(1.0f), least = lanes_splat(FLT_MIN);
    for (size_t row = 0; row < row_count; row += LANES_WIDTH) {
        const lanes ax = lanes_load(&along->axes[0][row]), bx = lanes_load(&across->axes[0][row]);
        const lanes ay = lanes_load(&along->axes[1][row]), by = lanes_load(&across->axes[1][row]);
        const lanes az = lanes_load(&along->axes[2][row]), bz = lanes_load(&across->axes[2][row]);
        const lanes x = lanes_subtract(lanes_multiply(ay, bz), lanes_multiply(az, by));
        const lanes y = lanes_subtract(lanes_multiply(az, bx), lanes_multiply(ax, bz));
        const lanes z = lanes_subtract(lanes_multiply(ax, by), lanes_multiply(ay, bx));
        const lanes square =
            lanes_add(lanes_add(lanes_multiply(x, x), lanes_multiply(y, y)), lanes_multiply(z, z));
        const lanes scale = lanes_divide(one, lanes_square_root(square));
        const lanes nx = lanes_multiply(x, scale);
        const lanes ny = lanes_multiply(y, scale);
        const lanes nz = lanes_multiply(z, scale);
        lanes_store(&out->axes[0][row], lanes_select_greater(square, least, nx, zero));
        lanes_store(&out->axes[1][row], lanes_select_greater(square, least, ny, zero));
        lanes_store(&out->axes[2][row], lanes_select_greater(square, least, nz, one));
    }
}

static inline void store_row(const vectors *src, size_t row, const float *origin,
                             unsigned char *dst) {
    float *const vector = (float *)(void *)dst;
    for (int axis = 0; axis < 3; axis++)
        vector[axis] = src->axes[axis][row] + origin[axis];
}

/// Without gaps, a vector of rows at a time. Returns how many rows were stored.
static inline size_t store_packed(const vectors *src, size_t row_count, const float *origin,
                                  unsigned char *dst) {
    const lanes x = lanes_splat(origin[0]), y = lanes_splat(origin[1]), z = lanes_splat(origin[2]);
    size_t row = 0;
    for (; row + LANES_WIDTH <= row_count; row += LANES_WIDTH) {
        lanes_store_xyz((float *)(void *)dst + 3 * row, //
                        lanes_add(lanes_load(&src->axes[0][row]), x),
                        lanes_add(lanes_load(&src->axes[1][row]), y),
                        lanes_add(lanes_load(&src->axes[2][row]), z));
    }
    return row;
}

/// Writes forward only, so that `dst` may be write-combined memory. The origin is added here: in
/// the sums it would take registers that the accumulators need.
static inline void store_stream(const vectors *src, const float *origin, size_t row_count,
                                size_t stride, unsigned char *dst) {
    size_t row = 0;
    if (stride == 3 * sizeof(float)) row = store_packed(src, row_count, origin, dst);
    for (; row < row_count; row++)
        store_row(src, row, origin, dst + row * stride);
}

/// Normals inside the vertices are written with them, vertex by vertex.
static inline void store_vertices(const vectors *positions, const vectors *normals,
                                  const float *origin, const limni_target *target,
                                  size_t patch_index) {
    static const float nowhere[3] = {0}; // adding +0 turns -0 into +0
    const size_t row_count = target->row_count, first = patch_index * row_count;
    unsigned char *const dst = target->vertices + first * target->stride;
    unsigned char *const normal_dst =
        normals ? target->normals + first * target->normal_stride : NULL;
    const uintptr_t apart = (uintptr_t)target->normals - (uintptr_t)target->vertices;
    if (normals && target->normal_stride == target->stride && apart < target->stride) {
        for (size_t row = 0; row < row_count; row++) {
            store_row(positions, row, origin, dst + row * target->stride);
            store_row(normals, row, nowhere, normal_dst + row * target->stride);
        }
        return;
    }
    store_stream(positions, origin, row_count, target->stride, dst);
    if (normals) store_stream(normals, nowhere, row_count, target->normal_stride, normal_dst);
}

/// Sums the rows of one table: positions relative to the origin, or a tangent.
static inline void evaluate_table(patch *p, const limni_run *run, int table, size_t row_count,
                                  vectors *out) {
    p->table = run->table + (size_t)table * run->table_stride;
    if (run->slot_size == 2) {
        evaluate_long_patch(p, 2, row_count, out);
    } else if (run->control_count > LIMNI_PLAIN_TERMS) {
        evaluate_long_patch(p, 1, row_count, out);
    } else {
        evaluate_narrow_patch(p, row_count, out);
    }
}

/// The corners have the normals of their control points, so that all patches around one agree.
static inline void set_corner_normals(const limni_run *run, const uint32_t *indices,
                                      const void *slots, const float *control_normals,
                                      vectors *normals) {
    for (size_t k = 0; k < run->control_count; k++) {
        const size_t slot =
            run->slot_size == 1 ? ((const uint8_t *)slots)[k] : ((const uint16_t *)slots)[k];
        if (slot >= run->corner_count) continue;
        for (size_t axis = 0; axis < 3; axis++)
            normals->axes[axis][slot] = control_normals[3 * (size_t)indices[k] + axis];
    }
}

/// `points` has room for one patch.
static inline void evaluate_patches(const limni_run *run, float (*points)[4],
                                    const limni_points *from, const limni_target *target) {
    const size_t row_count = target->padded_row_count, control_count = run->control_count;
    for (size_t i = 0; i < run->patch_count; i++) {
        const uint32_t *const indices = run->indices + i * control_count;
        const unsigned char *const slots =
            (const unsigned char *)run->slots + i * control_count * run->slot_size;
        patch p = {.row_stride = run->row_stride,
                   .control_count = control_count,
                   .slots = slots,
                   .points = (const float(*)[4])points};
        vectors positions, along, across, normals;
        gather(indices, control_count, from, points);
        evaluate_table(&p, run, 0, row_count, &positions);
        if (from->normals) {
            evaluate_table(&p, run, 1, row_count, &along);
            evaluate_table(&p, run, 2, row_count, &across);
            find_normals(&along, &across, row_count, &normals);
            set_corner_normals(run, indices, slots, from->normals, &normals);
        }
        store_vertices(&positions, from->normals ? &normals : NULL, from->origin, target, i);
    }
}

static void evaluate_run(const limni_run *run, const limni_points *from,
                         const limni_target *target) {
    if (run->slot_size == 1) {
        _Alignas(16) float points[LIMN_FORMAT_NARROW_SLOTS][4];
        evaluate_patches(run, points, from, target);
    } else {
        _Alignas(16) float points[LIMN_FORMAT_CONTROLS_MAX][4];
        evaluate_patches(run, points, from, target);
    }
}
