/* SPDX-License-Identifier: MIT */
/*
 * The evaluation kernel, written once. A kernels_<isa>.c includes its lanes first, then this by way
 * of base_body.h. sums.h, light.h, formats.h and stores.h are its steps; between them, everything stays in L1.
 */
#include "control_normals_body.h"
#include "light.h"
#include "morph.h"
#include "pieces.h"
#include "refine_body.h"
#include "skin_body.h"
#include "stores.h"

// ---- Gathering

static inline size_t slot_of(const void *slots, uint32_t slot_size, size_t k) {
    return slot_size == 1 ? ((const uint8_t *)slots)[k] : ((const uint16_t *)slots)[k];
}

static inline quad gather_point(const float *controls, uint32_t index, quad origin) {
    return quad_subtract(quad_load_point(controls + 3 * (size_t)index), origin);
}

/// The control points of one patch in ascending order.
///
/// absolute  the same relative to nothing; NULL: not wanted
static LIMNI_INLINE void gather(const uint32_t *indices, const void *slots, uint32_t slot_size,
                                size_t count, uint32_t row_stride, const float *controls,
                                quad origin, term *out, term *absolute) {
    LIMNI_UNROLL_TWICE
    for (size_t k = 0; k < count; k++) {
        const size_t slot = slot_of(slots, slot_size, k);
        const uint32_t column = (uint32_t)slot * row_stride;
        const quad point = quad_load_point(controls + 3 * (size_t)indices[slot]);
        set_term(&out[k], quad_subtract(point, origin), column);
        if (absolute) set_term(&absolute[k], point, column);
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

/// What one patch is between summing and storing. Tangents become normals, in place of the first of
/// them; the second then are colours.
typedef struct scratch {
    vectors positions, along, across;
} scratch;

static inline void clear_rows(scratch *rows, size_t first) {
    for (int axis = 0; axis < 3; axis++) {
        lanes_store(&rows->positions.axes[axis][first], lanes_zero());
        lanes_store(&rows->along.axes[axis][first], lanes_zero());
        lanes_store(&rows->across.axes[axis][first], lanes_zero());
    }
}

/// What lies behind the last row of any level is read but not used.
static inline void clear_padding(const limn_domain *domain, scratch *rows) {
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
        clear_rows(rows, domain->row_counts[level]);
}

/// What the pieces of a run are, and what those of one patch are between summing and being placed.
typedef struct assembly {
    const limni_pieces *layouts;
    limni_piece items[LIMN_FORMAT_PIECE_COUNT];
    scratch staged;
} assembly;

// ---- Storing

static inline part position_part(const limni_target *target) {
    enum { FIRST = offsetof(scratch, positions) / sizeof(float) };
    part p = {.planes = {FIRST, FIRST + PLANE, FIRST + 2 * PLANE},
              .word_count = limni_format_words(target->format),
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

static inline part colour_part(const limni_target *target) {
    enum { FIRST = offsetof(scratch, across) / sizeof(float) };
    return (part){.planes = {FIRST},
                  .word_count = 1,
                  .size = 4,
                  .dst = target->colours,
                  .stride = target->colour_stride};
}

static inline void arrange_parts(const limni_target *target, parts *p) {
    const part position = position_part(target), normal = normal_part(target);
    const part colour = colour_part(target);
    *p = (parts){.count = 0};
    add_part(p, &position);
    if (target->normals) add_part(p, &normal);
    if (target->colours) add_part(p, &colour);
    join_parts(p);
}

/// The corners have the normals of their control points, so that all patches around one agree, or
/// all on one side.
static inline void set_corner_normals(const uint32_t *corners, uint32_t first_corner,
                                      size_t corner_count, const float *control_normals,
                                      vectors *normals) {
    for (size_t corner = 0; corner < corner_count; corner++) {
        const float *const normal = control_normals + 3 * (size_t)(corners[corner] - first_corner);
        for (size_t axis = 0; axis < 3; axis++)
            normals->axes[axis][corner] = normal[axis];
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
    const uint32_t *corners;      ///< indices of their normals,
    uint32_t first_corner;        ///< counted from here
    const float *control_normals; ///< NULL: neither normals nor light
    const limni_layout *layout;   ///< of tangents
    assembly *pieces;             ///< NULL: the class has a table
    uint32_t level;
    size_t row_count;
} wanted;

/// The normals of rows that were staged. The places of the first four are anywhere; then four, and
/// at last eight, are consecutive.
static inline void place_edge_normals(const limni_layout *layout, size_t corner_count,
                                      uint32_t level, vectors *normals) {
    const size_t count = layout->edge_counts[level], padded = limni_padded(count);
    for (size_t edge = 0; edge < corner_count; edge++) {
        const uint16_t *const places = &layout->rows[edge * LIMNI_EDGE_ROWS];
        const size_t staged = STAGED + edge * padded;
        for (size_t r = 0; r < count && r < 4; r++) {
            if (places[r] != LIMNI_NO_ROW) copy_row(normals, staged + r, places[r]);
        }
        for (size_t r = 4; r < count; r += 4)
            copy_four_rows(normals, staged + r, normals, places[r]);
    }
}

/// Of patches with a table. Vectors of rows inside go on into rows of edges, which therefore come
/// later.
static inline void find_table_normals(const limn_domain *domain, const wanted *what,
                                      scratch *rows) {
    const limni_layout *const layout = what->layout;
    for (uint32_t level = layout->inside_level; level <= what->level; level++) {
        const size_t first = limni_first_inside(domain, level);
        find_normals(&rows->across, first, domain->row_counts[level] - first, &rows->along);
    }
    find_normals(&rows->across, STAGED,
                 domain->corner_count * limni_padded(layout->edge_counts[what->level]),
                 &rows->along);
    place_edge_normals(layout, domain->corner_count, what->level, &rows->along);
}

static inline void find_piece_normals(assembly *a, uint32_t level, vectors *normals) {
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++)
        find_normals(&a->staged.across, a->items[p].first_place,
                     a->items[p].tangents->counts[level], &a->staged.along);
    place_rows(a->layouts->normal_copies, a->layouts->normal_copy_counts[level], &a->staged.along,
               normals);
}

/// Unit normals of all rows, or of the corners.
static inline void find_row_normals(const limni_target *target, const wanted *what, scratch *rows) {
    const limn_domain *const domain = target->domain;
    if (target->tangents && what->pieces) {
        find_piece_normals(what->pieces, what->level, &rows->along);
    } else if (target->tangents) {
        find_table_normals(domain, what, rows);
    }
    set_corner_normals(what->corners, what->first_corner, domain->corner_count,
                       what->control_normals, &rows->along);
}

/// corner_count  rows whose normals are known; where that is all of them, both modes are the same
static inline void light_rows(const limni_target *target, size_t corner_count, size_t row_count,
                              scratch *rows) {
    const lit_patch lit = {.grid = target->grid,
                           .positions = &rows->positions,
                           .normals = &rows->along,
                           .corner_count = corner_count,
                           .row_count = row_count,
                           .colours = &rows->across};
    light_patch(target->lighting, &lit);
}

/// Everything is found where the rows are and then moves alike, so that nothing jumps as levels
/// change.
static inline void morph_rows(const limni_target *target, const limn_plan_patch *item,
                              scratch *rows) {
    morph_patch(target->domain, item, false, &rows->positions);
    if (target->normals) morph_patch(target->domain, item, true, &rows->along);
    if (target->colours) morph_patch(target->domain, item, false, &rows->across);
}

static inline void pack_and_store(const limni_target *target, const parts *to, size_t row_count,
                                  scratch *rows) {
    const float *const planes = (const float *)(const void *)rows;
    pack_positions(target, row_count, &rows->positions);
    if (target->normals) pack_normals(target->normal_format, row_count, &rows->along);
    if (target->colours) pack_rgba8(row_count, &rows->across);
    if (target->streaming) {
        stream_parts(to, planes, row_count);
    } else {
        store_parts(to, planes, row_count);
    }
}

static LIMNI_NOINLINE void store_patch(const limni_target *target, const parts *to,
                                       const wanted *what, scratch *rows) {
    if (what->control_normals) find_row_normals(target, what, rows);
    if (target->colours) light_rows(target, target->domain->corner_count, what->row_count, rows);
    if (what->item) morph_rows(target, what->item, rows);
    pack_and_store(target, to, what->row_count, rows);
}

// ---- Summing

/// One patch of a run.
typedef struct chosen {
    const uint32_t *indices; ///< [control_count]
    const void *slots;       ///< [control_count]
    uint32_t level;
} chosen;

/// The terms of one patch.
typedef struct lists {
    term *ascending; ///< [control_count]; for pieces four times as many
    term *absolute;  ///< [LIMNI_PLAIN_TERMS] the same relative to nothing; NULL: not wanted
    term *folded;    ///< [LIMNI_PLAIN_TERMS]
} lists;

/// Where the terms of a patch come from.
typedef struct gathering {
    const float *controls;
    uint32_t slot_size;
    lists to;
} gathering;

/// Both tangents of some rows. They are differences, and precise relative to a point near by.
static inline void sum_tangent_segment(const patch *p, const limni_run *run, const chosen *which,
                                       const gathering *g, const float *origin,
                                       const limni_segment *segment, scratch *rows) {
    vectors *const out[2] = {&rows->along, &rows->across};
    if (g->to.absolute) {
        const lanes from[3] = {lanes_splat(origin[0]), lanes_splat(origin[1]),
                               lanes_splat(origin[2])};
        sum_tangent_rows(p, run->table_stride, from, segment, out);
        return;
    }
    patch table = *p;
    gather(which->indices, which->slots, g->slot_size, run->control_count, run->layout->row_stride,
           g->controls, quad_load_point(origin), g->to.ascending, NULL);
    sum_long_rows(&table, segment, out[0]);
    table.table += run->table_stride;
    sum_long_rows(&table, segment, out[1]);
}

/// Both tangents of all rows but the corners, of a patch whose positions are done. Those of edges
/// are relative to the end that comes first, as both patches know it, and staged.
static inline void sum_tangents(const patch *positions, const limni_run *run, const chosen *which,
                                const gathering *g, size_t corner_count, scratch *rows) {
    static const float nowhere[3] = {0};
    const limni_layout *const layout = run->tangent_layout;
    const uint32_t *const corners = which->indices;
    const uint32_t level = which->level;
    const size_t edge_count = limni_padded(layout->edge_counts[level]);
    patch p = *positions;
    p.table += run->table_stride;
    p.origin = p.pair_origin = nowhere;
    if (g->to.absolute) p.all = (terms){g->to.absolute, g->to.absolute + run->control_count};
    for (size_t edge = 0; edge < corner_count && edge_count; edge++) {
        const uint32_t a = corners[edge], b = corners[edge + 1 < corner_count ? edge + 1 : 0];
        const limni_segment segment = {.table_row = (uint16_t)(edge * LIMNI_EDGE_ROWS),
                                       .row = (uint16_t)(STAGED + edge * edge_count),
                                       .count = (uint16_t)edge_count};
        sum_tangent_segment(&p, run, which, g, g->controls + 3 * (size_t)(a < b ? a : b), &segment,
                            rows);
    }
    for (int s = 0; s < LIMNI_SEGMENT_MAX && layout->segments[level][s].count; s++)
        sum_tangent_segment(&p, run, which, g, g->controls + 3 * (size_t)corners[0],
                            &layout->segments[level][s], rows);
    if (!layout->pair_counts[level]) return;
    sum_pairs(&p, layout, layout->pair_counts[level], false, &rows->along);
    p.table += run->table_stride;
    sum_pairs(&p, layout, layout->pair_counts[level], true,
              &rows->across); // a mirror turns its sign
}

/// All sums of one patch.
static inline void sum_patch(patch *p, const limni_run *run, const chosen *which,
                             const gathering *g, quad origin, const limn_domain *domain,
                             bool normals, scratch *rows) {
    const limni_layout *const layout = run->layout;
    const uint32_t level = which->level, row_stride = layout->row_stride;
    const size_t count = run->control_count;
    if (g->to.absolute) {
        gather(which->indices, which->slots, g->slot_size, count, row_stride, g->controls, origin,
               g->to.ascending, g->to.absolute);
    } else {
        gather(which->indices, which->slots, g->slot_size, count, row_stride, g->controls, origin,
               g->to.ascending, NULL);
    }
    if (layout->pair_counts[level])
        gather_pairs(which->indices, count, run->pair_count, row_stride, g->controls, g->to.folded);
    p->pair_origin = g->controls + 3 * (size_t)which->indices[0];
    for (int s = 0; s < LIMNI_SEGMENT_MAX && layout->segments[level][s].count; s++) {
        if (count > LIMNI_PLAIN_TERMS) {
            sum_long_rows(p, &layout->segments[level][s], &rows->positions);
        } else {
            sum_rows(p, &layout->segments[level][s], &rows->positions);
        }
    }
    if (layout->pair_counts[level])
        sum_pairs(p, layout, layout->pair_counts[level], false, &rows->positions);
    if (normals) sum_tangents(p, run, which, g, domain->corner_count, rows);
}

/// Both tangents of the rows of all pieces. Those of edges are relative to the end that comes
/// first, and those inside to a corner.
static inline void sum_all_piece_tangents(assembly *a, const chosen *which, const float *controls,
                                          const piece_points *points, size_t corner_count) {
    vectors *const out[2] = {&a->staged.along, &a->staged.across};
    const uint32_t *const corners = which->indices;
    for (size_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++) {
        const limni_piece *const piece = &a->items[p];
        const uint32_t end = piece->tangents->counts[which->level];
        if (end == 0) continue;
        const terms absolute = list_terms(points->absolute, piece->columns,
                                          piece->tangents->row_stride, points->buffer);
        uint32_t first = 0;
        for (size_t half = 0; half < 2 && p < corner_count;
             half++, first += LIMN_FORMAT_ROW_BLOCK) {
            const size_t edge = half == 0 ? p : p > 0 ? p - 1 : corner_count - 1;
            const uint32_t start = corners[edge];
            const uint32_t next = corners[edge + 1 < corner_count ? edge + 1 : 0];
            const float *const origin = controls + 3 * (size_t)(start < next ? start : next);
            const uint32_t behind = first + LIMN_FORMAT_ROW_BLOCK;
            sum_piece_tangents(piece, absolute, points->moved, origin, first,
                               end < behind ? end : behind, out);
        }
        sum_piece_tangents(piece, absolute, points->moved, controls + 3 * (size_t)corners[0], first,
                           end, out);
    }
}

/// All sums of one patch in pieces.
static inline void sum_pieces(assembly *a, const limni_run *run, const chosen *which,
                              const gathering *g, const float *origin, const limn_domain *domain,
                              bool normals, vectors *positions) {
    const size_t count = run->control_count;
    const quad from = quad_load_point(origin);
    term *const relative = g->to.ascending, *const absolute = relative + count;
    if (normals) {
        gather(which->indices, which->slots, g->slot_size, count, 1, g->controls, from, relative,
               absolute);
    } else {
        gather(which->indices, which->slots, g->slot_size, count, 1, g->controls, from, relative,
               NULL);
    }
    const piece_points points = {.relative = {relative, absolute},
                                 .absolute = {absolute, absolute + count},
                                 .buffer = absolute + count,
                                 .moved = absolute + 2 * count};
    for (size_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++)
        sum_piece_positions(&a->items[p], &points, origin, which->level, &a->staged.positions);
    place_rows(a->layouts->position_copies, a->layouts->position_copy_counts[which->level],
               &a->staged.positions, positions);
    if (normals) sum_all_piece_tangents(a, which, g->controls, &points, domain->corner_count);
}

/// Whether all that is wanted are positions as three floats, one behind the other.
static inline bool is_tight(const limni_target *target) {
    return !target->normals && !target->colours && target->format == LIMNI_FLOAT3 &&
           target->stride == 3 * sizeof(float) && !target->streaming;
}

/// tight   is_tight(), for the compiler: a fifth of the time at the lowest levels
/// pieces  NULL: classes have tables
static LIMNI_INLINE void evaluate_patches(const limni_run *run, const gathering *g,
                                          const limni_points *from, const limni_target *target,
                                          bool tight, assembly *pieces) {
    // What does not change from patch to patch is set up once: the compiler cannot know that stores
    // of vectors leave it alone.
    const size_t count = run->control_count;
    const quad origin = quad_load_point(from->origin);
    const part position = position_part(target);
    parts to;
    arrange_parts(target, &to);
    const size_t even_count = count - 1 - run->pair_count;
    patch p = {.table = run->table,
               .origin = from->origin,
               .all = {g->to.ascending, g->to.ascending + count}};
    if (run->pair_count) {
        p.even = (terms){g->to.folded, g->to.folded + even_count};
        p.odd = (terms){g->to.folded + even_count, g->to.folded + (count - 1)};
    }
    scratch rows;
    clear_padding(target->domain, &rows);

    for (size_t i = 0; i < run->patch_count; i++) {
        const limn_plan_patch *const item = run->items ? &run->items[i] : NULL;
        const size_t at = item ? item->patch - run->first_patch : i;
        const chosen which = {.indices = run->indices + at * count,
                              .slots =
                                  (const unsigned char *)run->slots + at * count * g->slot_size,
                              .level = item ? item->level : target->level};
        const size_t row_count = target->domain->row_counts[which.level];
        to.first = item ? item->first_vertex : i * row_count;
        if (pieces) {
            sum_pieces(pieces, run, &which, g, from->origin, target->domain, target->tangents,
                       &rows.positions);
        } else {
            sum_patch(&p, run, &which, g, origin, target->domain, !tight && target->tangents,
                      &rows);
        }
        if (tight) {
            if (item) morph_patch(target->domain, item, false, &rows.positions);
            store_words(&position, 3, (const float *)(const void *)&rows, base_of(&to, 0),
                        row_count);
            continue;
        }
        const uint32_t *const corners =
            run->corner_normals ? run->corner_normals + at * target->domain->corner_count
                                : which.indices;
        const wanted what = {.item = item,
                             .corners = corners,
                             .first_corner = run->corner_normals ? 0 : run->first_corner,
                             .control_normals = from->normals,
                             .layout = run->tangent_layout,
                             .pieces = pieces,
                             .level = which.level,
                             .row_count = row_count};
        store_patch(target, &to, &what, &rows);
    }
}

static LIMNI_INLINE void evaluate_assembly(const limni_run *run, gathering *g,
                                           const limni_points *from, const limni_target *target) {
    assembly pieces;
    pieces.layouts = run->pieces;
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++)
        pieces.items[p] = limni_piece_of(run, p);
    clear_rows(&pieces.staged, LIMNI_PIECE_PLACES);
    evaluate_patches(run, g, from, target, false, &pieces);
}

/// All three apart, so that runs with tables keep their registers, and each takes no more stack than
/// its own.
static LIMNI_NOINLINE void evaluate_in_pieces(const limni_run *run, const limni_points *from,
                                              const limni_target *target) {
    _Alignas(16) term ascending[4 * LIMN_FORMAT_NARROW_SLOTS];
    gathering g = {.controls = from->controls, .slot_size = 1, .to.ascending = ascending};
    evaluate_assembly(run, &g, from, target);
}

static LIMNI_NOINLINE void evaluate_in_wide_pieces(const limni_run *run, const limni_points *from,
                                                   const limni_target *target) {
    _Alignas(16) term ascending[4 * LIMN_FORMAT_CONTROLS_MAX];
    gathering g = {.controls = from->controls, .slot_size = 2, .to.ascending = ascending};
    evaluate_assembly(run, &g, from, target);
}

/// Each way to store has its own loop over patches.
static LIMNI_NOINLINE void evaluate_with_tables(const limni_run *run, const limni_points *from,
                                                const limni_target *target) {
    _Alignas(16) term absolute[LIMNI_PLAIN_TERMS], folded[LIMNI_PLAIN_TERMS];
    const bool apart = target->tangents && run->control_count <= LIMNI_PLAIN_TERMS;
    gathering g = {.controls = from->controls,
                   .slot_size = run->slot_size,
                   .to = {.absolute = apart ? absolute : NULL, .folded = folded}};
    if (run->slot_size == 1) {
        _Alignas(16) term ascending[LIMN_FORMAT_NARROW_SLOTS];
        g.slot_size = 1;
        g.to.ascending = ascending;
        if (is_tight(target)) {
            evaluate_patches(run, &g, from, target, true, NULL);
        } else {
            evaluate_patches(run, &g, from, target, false, NULL);
        }
    } else {
        _Alignas(16) term ascending[LIMN_FORMAT_CONTROLS_MAX];
        g.slot_size = 2;
        g.to.ascending = ascending;
        evaluate_patches(run, &g, from, target, false, NULL);
    }
}

static void evaluate_run(const limni_run *run, const limni_points *from,
                         const limni_target *target) {
    if (run->pieces && run->slot_size == 1) {
        evaluate_in_pieces(run, from, target);
    } else if (run->pieces) {
        evaluate_in_wide_pieces(run, from, target);
    } else {
        evaluate_with_tables(run, from, target);
    }
    if (target->streaming) lanes_stream_end();
    lanes_end();
}
