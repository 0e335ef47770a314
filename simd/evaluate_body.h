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

/// Positions of one patch, relative to the origin: structure of arrays, in L1.
typedef struct positions {
    _Alignas(64) float axes[3][LIMNI_ROW_MAX];
} positions;

/// What a tile is computed from: one patch with its control points gathered.
typedef struct patch {
    const float *table;
    size_t row_stride;
    size_t control_count;
    const void *slots;
    const float (*points)[3]; ///< relative to the origin, in the order of the slots
} patch;

static inline const float *column_of(const patch *p, uint32_t slot_size, size_t k) {
    const size_t slot =
        slot_size == 1 ? ((const uint8_t *)p->slots)[k] : ((const uint16_t *)p->slots)[k];
    return p->table + slot * p->row_stride;
}

/// Rows [first_row, first_row + vector_count * LANES_WIDTH) of one patch. `vector_count` and
/// `slot_size` are constants where this is called, so that the accumulators are registers.
static inline void evaluate_tile(const patch *p, uint32_t slot_size, size_t first_row,
                                 int vector_count, positions *out) {
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
                                       positions *out) {
    for (int axis = 0; axis < 3; axis++) {
        for (size_t row = 0; row < row_count; row += LANES_WIDTH)
            lanes_store(&out->axes[axis][row], evaluate_long_sums(p, slot_size, row, axis));
    }
}

static inline void evaluate_tiles(const patch *p, uint32_t slot_size, size_t row_count,
                                  positions *out) {
    enum { TILE = LANES_TILE * LANES_WIDTH, BLOCK = LIMN_FORMAT_ROW_BLOCK };
    size_t row = 0;
    for (; row + TILE <= row_count; row += TILE)
        evaluate_tile(p, slot_size, row, LANES_TILE, out);
    for (; row < row_count; row += BLOCK)
        evaluate_tile(p, slot_size, row, BLOCK / LANES_WIDTH, out);
}

/// Not inlined: what a compiler would keep in registers around the loop over patches are registers that
/// the accumulators need (gcc 12 spills all three splats).
static LIMNI_NOINLINE void evaluate_narrow_patch(const patch *p, size_t row_count, positions *out) {
    evaluate_tiles(p, 1, row_count, out);
}

static inline void gather(const uint32_t *indices, size_t count, const limni_points *from,
                          float (*points)[3]) {
    for (size_t k = 0; k < count; k++) {
        const float *const control = from->controls + 3 * (size_t)indices[k];
        for (int axis = 0; axis < 3; axis++)
            points[k][axis] = control[axis] - from->origin[axis];
    }
}

static inline void store_vertex(const positions *src, size_t row, const float *origin,
                                unsigned char *dst) {
    float *const vertex = (float *)(void *)dst;
    for (int axis = 0; axis < 3; axis++)
        vertex[axis] = src->axes[axis][row] + origin[axis];
}

/// Vertices without gaps, a vector of rows at a time. Returns how many rows were stored.
static inline size_t store_packed(const positions *src, size_t row_count, const float *origin,
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

/// Writes forward only, so that `dst` may be write-combined memory. The origin is added here: in the
/// sums it would take registers that the accumulators need.
static inline void store_positions(const positions *src, const float *origin,
                                   const limni_target *target, unsigned char *dst) {
    size_t row = 0;
    if (target->stride == 3 * sizeof(float))
        row = store_packed(src, target->row_count, origin, dst);
    for (; row < target->row_count; row++)
        store_vertex(src, row, origin, dst + row * target->stride);
}

/// `points` has room for one patch.
static inline void evaluate_patches(const limni_run *run, uint32_t slot_size, float (*points)[3],
                                    const limni_points *from, const limni_target *target) {
    const bool is_long = run->control_count > LIMNI_PLAIN_TERMS;
    const uint32_t *indices = run->indices;
    const unsigned char *slots = run->slots;
    unsigned char *dst = target->vertices;
    for (uint32_t i = 0; i < run->patch_count; i++) {
        const patch p = {
            .table = run->table,
            .row_stride = run->row_stride,
            .control_count = run->control_count,
            .slots = slots,
            .points = (const float(*)[3])points,
        };
        positions scratch;
        gather(indices, run->control_count, from, points);
        if (is_long) {
            evaluate_long_patch(&p, slot_size, target->padded_row_count, &scratch);
        } else {
            evaluate_narrow_patch(&p, target->padded_row_count, &scratch);
        }
        store_positions(&scratch, from->origin, target, dst);
        indices += run->control_count;
        slots += (size_t)run->control_count * slot_size;
        dst += target->row_count * target->stride;
    }
}

static void evaluate_narrow(const limni_run *run, const limni_points *from,
                            const limni_target *target) {
    float points[LIMN_FORMAT_NARROW_SLOTS][3];
    evaluate_patches(run, 1, points, from, target);
}

static void evaluate_wide(const limni_run *run, const limni_points *from,
                          const limni_target *target) {
    float points[LIMN_FORMAT_CONTROLS_MAX][3];
    evaluate_patches(run, 2, points, from, target);
}

static void evaluate_run(const limni_run *run, const limni_points *from,
                         const limni_target *target) {
    if (run->slot_size == 1) {
        evaluate_narrow(run, from, target);
    } else {
        evaluate_wide(run, from, target);
    }
}
