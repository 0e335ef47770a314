/* SPDX-License-Identifier: MIT */
#include "edge_errors.h"

#include "../runtime/edge_error.h"
#include "deviation.h"
#include "hash.h"
#include "topology.h"

#include <math.h>

enum { BATCH = 16 };

/// Of an edge as one of its patches sees it, by levels 0 to 3: model units.
typedef struct edge_error {
    double levels[LIMN_LEVEL_MAX];
} edge_error;

/// The larger of what happens along the edge and inside the patch.
static edge_error combine(const limni_deviation *deviation, uint32_t edge) {
    edge_error error;
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX; level++) {
        const double along = deviation->edges[edge][level], inside = deviation->inside[level];
        error.levels[level] = sqrt(along > inside ? along : inside);
    }
    return error;
}

/// What measuring needs. `view` shows the runtime part of a run, as a mesh of its own.
typedef struct measurer {
    limni_ruler ruler;
    limn_mesh view;
    limn_file_run part;
    limn_file_class record;
    limn_file_piece pieces[LIMN_FORMAT_PIECE_COUNT];
    float *tables;     ///< of the pieces, one behind the other; NULL: the class has a table
    uint16_t *columns; ///< as a class has them
    float points[BATCH * LIMNI_ROWS_MAX][3];
    uint32_t next_progress; ///< patches
} measurer;

static void begin_measurer(measurer *m, const limni_mesh *mesh, const limni_patches *patches) {
    const limn_domain *const domain = limn_domain_get(mesh->domain);
    limni_ruler_begin(&m->ruler, domain);
    m->next_progress = 0;
    m->view = (limn_mesh){.domain = domain,
                          .controls = patches->controls[0],
                          .control_count = mesh->control_count,
                          .point_count = patches->record.point_count,
                          .run_count = 1,
                          .indices = patches->indices,
                          .slots = patches->slots,
                          .runs = &m->part,
                          .classes = &m->record,
                          .kernels = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_REPRODUCIBLE)};
    memcpy(m->view.origin, patches->record.origin, sizeof m->view.origin);
}

/// faces: of the patches in view
static void measure_view(measurer *m, const limni_mesh *mesh, const uint32_t *faces,
                         edge_error *errors) {
    const limn_plan plan = limn_plan_uniform(&m->view, LIMN_LEVEL_MAX);
    const uint32_t row_count = m->view.domain->row_counts[LIMN_LEVEL_MAX];
    const uint32_t corner_count = m->view.domain->corner_count;
    limn_evaluate(&plan, m->view.controls, 0, plan.patch_count,
                  &(limn_output){.vertices = m->points});
    for (uint32_t p = 0; p < plan.patch_count; p++) {
        const uint32_t face = faces[p] >> 2, rotation = faces[p] & 3;
        limni_deviation deviation;
        limni_deviation_measure(&m->ruler, (const float(*)[3])m->points + p * row_count,
                                &deviation);
        for (uint32_t edge = 0; edge < corner_count; edge++)
            errors[mesh->offsets[face] + (edge + rotation) % corner_count] =
                combine(&deviation, edge);
    }
}

static void show_progress(limni_context *context, measurer *m, uint32_t done, uint32_t total) {
    if (done < m->next_progress) return;
    limni_progress(context, "measure", done, total);
    m->next_progress = done + total / 200 + 1;
}

/// The pieces of a class as those of a file of its own.
static limn_bake_status copy_pieces(limni_context *context, measurer *m, const limni_class *class,
                                    const limni_classes *pieces) {
    const size_t parts_size = limni_class_parts_size(class);
    size_t size = 0;
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++) {
        const limni_class *const piece = &pieces->items[class->parts[p]];
        m->pieces[p] = limni_piece_record(piece);
        m->pieces[p].table_offset = size;
        size += limni_class_table_size(piece);
    }
    m->tables = limni_allocate(context, size, 1);
    m->columns = limni_allocate(context, parts_size, 1);
    if (!m->tables || !m->columns) return LIMN_BAKE_MEMORY;
    memcpy(m->columns, class->parts, parts_size);
    for (uint16_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++) {
        const limni_class *const piece = &pieces->items[class->parts[p]];
        memcpy((unsigned char *)m->tables + m->pieces[p].table_offset, piece->table,
               limni_class_table_size(piece));
        m->columns[p] = p;
    }
    m->view.tables = m->tables;
    m->view.pieces = m->pieces;
    m->view.columns = m->columns;
    return LIMN_BAKE_OK;
}

static limn_bake_status view_class(limni_context *context, measurer *m, const limni_class *class,
                                   const limni_classes *pieces) {
    m->record = limni_class_record(class);
    limni_release(context, m->tables);
    limni_release(context, m->columns);
    m->tables = NULL;
    m->columns = NULL;
    if (class->parts) return copy_pieces(context, m, class, pieces);
    m->view.tables = class->table;
    return LIMN_BAKE_OK;
}

static void measure_run(limni_context *context, measurer *m, const limni_mesh *mesh,
                        const limn_file_run *run, const limni_patches *patches,
                        edge_error *errors) {
    const uint64_t batch = (uint64_t)BATCH * m->record.control_count;
    for (uint32_t begin = 0; begin < run->patch_count; begin += BATCH) {
        const uint32_t rest = run->patch_count - begin, first = run->first_patch + begin;
        show_progress(context, m, first, patches->record.patch_count);
        m->part =
            (limn_file_run){.patch_count = rest < BATCH ? rest : BATCH,
                            .first_index = run->first_index + begin / BATCH * batch,
                            .first_slot = run->first_slot +
                                          begin / BATCH * batch * limn_file_slot_size(&m->record)};
        m->view.patch_count = m->part.patch_count;
        measure_view(m, mesh, patches->faces + first, errors);
    }
}

static limn_bake_status measure(limni_context *context, const limni_mesh *mesh,
                                const limni_classes *classes, const limni_classes *pieces,
                                const limni_patches *patches, edge_error *errors) {
    measurer *const m = limni_allocate_zeroed(context, 1, sizeof *m);
    if (!m) return LIMN_BAKE_MEMORY;
    begin_measurer(m, mesh, patches);
    for (uint32_t r = 0; r < patches->record.run_count; r++) {
        const limn_file_run *const run = &patches->runs[r];
        LIMNI_TRY(view_class(context, m, &classes->items[run->class_index], pieces));
        measure_run(context, m, mesh, run, patches, errors);
    }
    limni_progress(context, "measure", patches->record.patch_count, patches->record.patch_count);
    limni_release(context, m->tables);
    limni_release(context, m->columns);
    limni_release(context, m);
    return LIMN_BAKE_OK;
}

// ---- Sheets

static void raise_error(edge_error *error, const edge_error *least) {
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX; level++) {
        if (error->levels[level] < least->levels[level])
            error->levels[level] = least->levels[level];
    }
}

/// Gives all sheets that were one edge the largest of their errors, so that they have one level.
static limn_bake_status share_errors(limni_context *context, const limni_mesh *mesh,
                                     edge_error *errors) {
    const uint32_t half_edge_count = mesh->half_edge_count;
    if (!mesh->origins) return LIMN_BAKE_OK;
    limni_keyed_edge *const edges = limni_allocate(context, half_edge_count, sizeof *edges);
    size_t count = 0;
    if (!edges) return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < half_edge_count; h++) {
        const uint32_t a = limni_half_edge_start(mesh, h), b = limni_half_edge_end(mesh, h);
        if (!limni_is_split(mesh, a) || !limni_is_split(mesh, b)) continue;
        edges[count++] = (limni_keyed_edge){limni_edge_key(mesh->origins[a], mesh->origins[b]), h};
    }
    limni_sort_edges(edges, count);
    for (size_t begin = 0, end; begin < count; begin = end) {
        edge_error largest = {0};
        for (end = begin; end < count && edges[end].key == edges[begin].key; end++)
            raise_error(&largest, &errors[edges[end].half_edge]);
        for (size_t e = begin; e < end; e++)
            errors[edges[e].half_edge] = largest;
    }
    limni_release(context, edges);
    return LIMN_BAKE_OK;
}

// ---- Encoding

/// The least code that is not below: rounding up what is behind the two bits of the mantissa may
/// carry into the exponent, as it should.
static uint32_t encode_first(double error) {
    const int64_t one = (int64_t)1 << 50, lowest = (int64_t)(1023 - 20) << 2;
    int64_t bits;
    if (error == 0) return 0;
    memcpy(&bits, &error, sizeof bits);
    const int64_t code = ((bits + one - 1) >> 50) - lowest;
    if (code < 1) return 1;
    return code < LIMNI_ERROR_FIRST_MAX ? (uint32_t)code : LIMNI_ERROR_FIRST_MAX;
}

/// Relative to what the code before says, so that rounding up does not add up.
static uint16_t encode(const edge_error *relative) {
    uint32_t packed = encode_first(relative->levels[0]);
    double error = (double)limni_error_first(packed);
    for (uint32_t level = 0; level + 1 < LIMN_LEVEL_MAX; level++) {
        uint32_t code = 0;
        while (code < LIMNI_ERROR_FACTOR_COUNT - 1 &&
               error * (double)limni_error_factors[code] < relative->levels[level + 1])
            code++;
        error *= (double)limni_error_factors[code];
        packed |= code << (LIMNI_ERROR_FIRST_BITS + LIMNI_ERROR_FACTOR_BITS * level);
    }
    return (uint16_t)packed;
}

/// In lengths of the edge, and falling from level to level by one of the factors at least. An edge
/// without length gets the largest error there is: its level follows from its length all the same.
static void make_relative(double length, edge_error *error) {
    const double largest = (double)limni_error_first(LIMNI_ERROR_FIRST_MAX);
    const double slowest = (double)limni_error_factors[LIMNI_ERROR_FACTOR_COUNT - 1];
    double next = 0;
    for (uint32_t level = LIMN_LEVEL_MAX; level-- > 0;) {
        double *const here = &error->levels[level];
        if (*here > 0) *here = *here < largest * length ? *here / length : largest;
        if (next > *here * slowest) *here = next / slowest;
        next = *here;
    }
}

static double edge_length(const limni_mesh *mesh, uint32_t h) {
    const float *const a = mesh->controls[limni_half_edge_start(mesh, h)];
    const float *const b = mesh->controls[limni_half_edge_end(mesh, h)];
    double square = 0;
    for (int axis = 0; axis < 3; axis++)
        square += ((double)a[axis] - (double)b[axis]) * ((double)a[axis] - (double)b[axis]);
    return sqrt(square);
}

/// Both sides of an edge get the same. What happens in a hole does not show.
static uint16_t encode_edge(const limni_mesh *mesh, uint32_t h, const edge_error *errors) {
    edge_error both;
    const uint32_t pair = mesh->pairs[h] == LIMNI_NONE ? h : mesh->pairs[h];
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX; level++) {
        const double one = errors[h].levels[level], other = errors[pair].levels[level];
        both.levels[level] = one > other ? one : other;
    }
    make_relative(edge_length(mesh, h), &both);
    return encode(&both);
}

limn_bake_status limni_edge_errors_build(limni_context *context, const limni_mesh *mesh,
                                         const limni_classes *classes, const limni_classes *pieces,
                                         limni_patches *patches) {
    const size_t count = mesh->half_edge_count;
    const uint32_t patch_count = patches->record.patch_count;
    edge_error *const errors = limni_allocate_zeroed(context, count, sizeof *errors);
    const uint32_t corner_count = limni_corner_count(patches);
    patches->errors =
        limni_allocate(context, corner_count * (size_t)patch_count, sizeof *patches->errors);
    if (!errors || !patches->errors) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(measure(context, mesh, classes, pieces, patches, errors));
    LIMNI_TRY(share_errors(context, mesh, errors));
    for (uint32_t p = 0; p < patch_count; p++) {
        for (uint32_t edge = 0; edge < corner_count; edge++)
            patches->errors[corner_count * p + edge] =
                encode_edge(mesh, limni_patch_half_edge(patches, mesh, p, edge), errors);
    }
    limni_release(context, errors);
    return LIMN_BAKE_OK;
}
