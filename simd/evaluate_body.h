/* SPDX-License-Identifier: MIT */
/*
 * The evaluation kernel, written once. A kernels_<isa>.c includes its lanes first, then this.
 * sums.h, formats.h and stores.h are its three steps; between them, everything stays in L1.
 */
#include "control_normals_body.h"
#include "morph.h"
#include "stores.h"

#if defined(__FAST_MATH__)
#error "fast-math reorders the sums that shared vertices depend on"
#endif
LIMN_STATIC_ASSERT(FLT_EVAL_METHOD == 0, "floats must be rounded to float (-mfpmath=sse)");

// ---- Gathering

static inline size_t slot_of(const void *slots, uint32_t slot_size, size_t k) {
    return slot_size == 1 ? ((const uint8_t *)slots)[k] : ((const uint16_t *)slots)[k];
}

static inline quad gather_point(const float *controls, uint32_t index, quad origin) {
    return quad_subtract(quad_load_point(controls + 3 * (size_t)index), origin);
}

static inline void set_term(term *dst, quad point, uint32_t column) {
    quad_store(dst, point);
    dst->column = column;
}

/// The control points of one patch in ascending order.
static inline void gather(const uint32_t *indices, const void *slots, uint32_t slot_size,
                          size_t count, uint32_t row_stride, const float *controls, quad origin,
                          term *out) {
    for (size_t k = 0; k < count; k++) {
        const size_t slot = slot_of(slots, slot_size, k);
        set_term(&out[k], gather_point(controls, indices[slot], origin),
                 (uint32_t)slot * row_stride);
    }
}

/// Where a class has pairs, slots 1 and 2, 3 and 4, and so on: first the sums of the pairs and the
/// slots that are their own images, the even terms, then the differences. All are relative to slot
/// 0, which is near and therefore precise, and needs no term itself.
static inline void gather_pairs(const uint32_t *indices, size_t count, size_t pair_count,
                                uint32_t row_stride, const float *controls, term *out) {
    const quad origin = quad_load_point(controls + 3 * (size_t)indices[0]);
    term *odd = out + (count - 1 - pair_count);
    uint32_t column = 0;
    for (size_t slot = 1; slot < 2 * pair_count; slot += 2) {
        const quad a = gather_point(controls, indices[slot], origin);
        const quad b = gather_point(controls, indices[slot + 1], origin);
        set_term(out++, quad_add(a, b), column += row_stride);
        set_term(odd++, quad_subtract(a, b), column += row_stride);
    }
    for (size_t slot = 2 * pair_count + 1; slot < count; slot++)
        set_term(out++, gather_point(controls, indices[slot], origin), column += row_stride);
}

/// What lies behind the last row of any level is read but not used.
static inline void clear_padding(const limn_domain *domain, vectors *rows) {
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        for (int axis = 0; axis < 3; axis++)
            lanes_store(&rows->axes[axis][domain->row_counts[level]], lanes_zero());
    }
}

/// What one patch is between summing and storing.
typedef struct scratch {
    vectors positions, along, across;
} scratch;

// ---- Storing

static inline part position_part(const limni_target *target) {
    enum { FIRST = offsetof(scratch, positions) / sizeof(float) };
    part p = {.planes = {FIRST, FIRST + PLANE, FIRST + 2 * PLANE},
              .word_count = target->position_format == LIMN_POSITION_UNORM16X4 ? 2 : 3,
              .dst = target->vertices,
              .stride = target->stride};
    p.size = 4 * p.word_count;
    return p;
}

static inline part normal_part(const limni_target *target) {
    enum { FIRST = offsetof(scratch, along) / sizeof(float) };
    part p = {.planes = {FIRST, FIRST + PLANE, FIRST + 2 * PLANE},
              .word_count = target->normal_format == LIMN_NORMAL_FLOAT3 ? 3 : 1,
              .dst = target->normals,
              .stride = target->normal_stride};
    p.size = target->normal_format == LIMN_NORMAL_OCT8X2 ? 2 : 4 * p.word_count;
    return p;
}

/// The corners have the normals of their control points, so that all patches around one agree.
static inline void set_corner_normals(const uint32_t *corners, size_t corner_count,
                                      const float *control_normals, vectors *normals) {
    for (size_t corner = 0; corner < corner_count; corner++) {
        for (size_t axis = 0; axis < 3; axis++)
            normals->axes[axis][corner] = control_normals[3 * (size_t)corners[corner] + axis];
    }
}

static inline void pack_normals(limn_normal_format format, size_t row_count, vectors *normals) {
    switch (format) {
    case LIMN_NORMAL_OCT16X2:
        pack_octahedral(row_count, 16, 32767.0f, normals);
        break;
    case LIMN_NORMAL_OCT8X2:
        pack_octahedral(row_count, 8, 127.0f, normals);
        break;
    case LIMN_NORMAL_SNORM8X4:
        pack_snorm8x4(row_count, normals);
        break;
    default:
        break;
    }
}

/// What is stored of a patch.
typedef struct wanted {
    const limn_plan_patch *item;  ///< NULL: all rows where they are
    const uint32_t *corners;      ///< control points
    const float *control_normals; ///< NULL: no normals
    size_t row_count;
} wanted;

/// Unit normals from tangents, in place of the first of them, as they will be written.
static inline void make_normals(const limni_target *target, const wanted *what, scratch *rows) {
    find_normals(&rows->across, what->row_count, &rows->along);
    set_corner_normals(what->corners, target->domain->corner_count, what->control_normals,
                       &rows->along);
    if (what->item) morph_patch(target->domain, what->item, true, &rows->along);
    pack_normals(target->normal_format, what->row_count, &rows->along);
}

static LIMNI_NOINLINE void store_patch(const limni_target *target, const parts *to,
                                       const wanted *what, scratch *rows) {
    const float *const planes = (const float *)(const void *)rows;
    if (what->item) morph_patch(target->domain, what->item, false, &rows->positions);
    if (target->position_format == LIMN_POSITION_UNORM16X4)
        pack_unorm16x4(target, what->row_count, &rows->positions);
    if (what->control_normals) make_normals(target, what, rows);
    if (target->streaming) {
        stream_parts(to, planes, what->row_count);
    } else {
        store_parts(to, planes, 0, what->row_count);
    }
}

// ---- Summing

/// Sums the rows of one table.
static inline void sum_table(const patch *p, const limni_layout *layout, uint32_t level,
                             bool negate, vectors *rows) {
    const bool is_long = p->all.end - p->all.begin > LIMNI_PLAIN_TERMS;
    for (int s = 0; s < LIMNI_SEGMENT_MAX && layout->segments[level][s].count; s++) {
        if (is_long) {
            sum_long_rows(p, &layout->segments[level][s], rows);
        } else {
            sum_rows(p, &layout->segments[level][s], rows);
        }
    }
    if (layout->pair_counts[level]) sum_pairs(p, layout, layout->pair_counts[level], negate, rows);
}

/// pair_origin  [3] the control point of slot 0
static inline void sum_patch(patch *p, const limni_run *run, const limni_points *from,
                             const float *pair_origin, uint32_t level, scratch *rows) {
    static const float nowhere[3] = {0};
    p->table = run->table;
    p->origin = from->origin;
    p->pair_origin = pair_origin;
    sum_table(p, run->layout, level, false, &rows->positions);
    if (!from->normals) return;
    p->table += run->table_stride;
    p->origin = p->pair_origin = nowhere;
    sum_table(p, run->layout, level, false, &rows->along);
    p->table += run->table_stride;
    sum_table(p, run->layout, level, true, &rows->across); // a mirror turns its sign
}

/// ascending, folded  room for the control points of one patch
static inline void evaluate_patches(const limni_run *run, uint32_t slot_size, term *ascending,
                                    term *folded, const limni_points *from,
                                    const limni_target *target) {
    // What does not change from patch to patch is set up once: the compiler cannot know that stores
    // of vectors leave it alone.
    const size_t count = run->control_count, pair_count = run->pair_count;
    const uint32_t row_stride = run->layout->row_stride;
    const float *const controls = from->controls;
    const quad origin = quad_load_point(from->origin);
    const part position = position_part(target), normal = normal_part(target);
    parts to;
    arrange_parts(&position, from->normals ? &normal : NULL, &to);
    const size_t even_count = count - 1 - pair_count;
    patch p = {.all = {ascending, ascending + count}};
    if (pair_count) {
        p.even = (terms){folded, folded + even_count};
        p.odd = (terms){folded + even_count, folded + (count - 1)};
    }
    scratch rows;
    clear_padding(target->domain, &rows.positions);
    clear_padding(target->domain, &rows.along);
    clear_padding(target->domain, &rows.across);

    for (size_t i = 0; i < run->patch_count; i++) {
        const limn_plan_patch *const item = run->items ? &run->items[i] : NULL;
        const uint32_t level = item ? item->level : target->level;
        const size_t at = item ? item->patch - run->first_patch : i;
        const uint32_t *const indices = run->indices + at * count;
        const unsigned char *const slots =
            (const unsigned char *)run->slots + at * count * slot_size;
        const wanted what = {.item = item,
                             .corners = indices,
                             .control_normals = from->normals,
                             .row_count = target->domain->row_counts[level]};
        gather(indices, slots, slot_size, count, row_stride, controls, origin, ascending);
        if (run->layout->pair_counts[level])
            gather_pairs(indices, count, pair_count, row_stride, controls, folded);
        sum_patch(&p, run, from, controls + 3 * (size_t)indices[0], level, &rows);
        to.first = item ? item->first_vertex : i * what.row_count;
        store_patch(target, &to, &what, &rows);
    }
}

static void evaluate_run(const limni_run *run, const limni_points *from,
                         const limni_target *target) {
    if (run->slot_size == 1) {
        _Alignas(16) term ascending[LIMN_FORMAT_NARROW_SLOTS];
        _Alignas(16) term folded[LIMNI_PLAIN_TERMS];
        evaluate_patches(run, 1, ascending, folded, from, target);
    } else {
        _Alignas(16) term ascending[LIMN_FORMAT_CONTROLS_MAX];
        evaluate_patches(run, 2, ascending, ascending, from, target);
    }
    if (target->streaming) lanes_stream_end();
    lanes_end();
}
