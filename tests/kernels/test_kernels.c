/* SPDX-License-Identifier: MIT */
/*
 * The kernels of every instruction set this CPU has, on made-up classes: all ranges of patches, all
 * levels, formats, strides and modes of light; guard bytes around the output; bit-equal to scalar, and scalar
 * within a bound of a sum in double precision. Links the runtime alone.
 */
#include "../../runtime/checksum.h"
#include "../../runtime/kernels.h"
#include "../check.h"
#include "../coefficients.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { PATCHES = 3, CONTROLS = 600, STRIDE_MAX = 36, GUARD = 64 };

enum { CLASSES = 11, ROWS_MAX = 289, PLACES_MAX = 320 };

/// By domain. Quads have no pairs.
static const uint32_t control_counts[LIMN_DOMAIN_COUNT][CLASSES] = {
    {3, 3, 12, 12, 24, 24, 25, 67, 256, 257, 400}, {4, 4, 4, 16, 17, 24, 25, 26, 33, 67, 257}};
static const uint16_t pair_counts[LIMN_DOMAIN_COUNT][CLASSES] = {{0, 1, 0, 5, 0, 11}};

typedef enum point_kind { RANDOM, EXTREME, DENORMAL, EQUAL, NOT_FINITE, KINDS } point_kind;

static uint32_t state = 12345;

static uint32_t next_random(void) {
    state = state * 1664525u + 1013904223u;
    return state >> 8;
}

static float random_float(float low, float high) {
    return low + (high - low) * (float)next_random() / 16777216.0f;
}

static float random_coordinate(point_kind kind) {
    switch (kind) {
    case EXTREME:
        return random_float(-1, 1) * (next_random() % 2 ? 1e30f : 1e-30f);
    case DENORMAL:
        return random_float(-1, 1) * 1e-39f;
    case EQUAL:
        return 3;
    case NOT_FINITE:
        return next_random() % 64 ? random_float(-10, 10) : next_random() % 2 ? NAN : -INFINITY;
    default:
        return random_float(-10, 10);
    }
}

/// A mesh of one run per class, without a file around it.
typedef struct made {
    limn_mesh mesh;
    bool in_pieces;
    size_t row_count, corner_count;
    limn_file_run runs[CLASSES];
    limn_file_class classes[CLASSES];
    limn_file_piece pieces[CLASSES * LIMN_FORMAT_PIECE_COUNT];
    uint16_t *columns;
    float *tables;
    uint32_t *indices;
    uint8_t *slots;
    float controls[CONTROLS][3];
    float normals[CONTROLS][3]; ///< of the control points: any vectors will do
    limn_file_normal none; ///< a mesh with normals has a pointer to these; evaluation reads none
} made;

/// Coefficients of a class: rows of different support, so that both ways to sum occur in one class.
static void fill_table(uint32_t control_count, uint32_t stride, float *table) {
    for (uint32_t row = 0; row < stride; row++) {
        const uint32_t support = 1 + next_random() % control_count;
        for (uint32_t slot = 0; slot < control_count; slot++) {
            const bool used = next_random() % control_count < support;
            table[slot * stride + row] = used ? random_float(0, 2.0f / (float)control_count) : 0;
        }
    }
}

/// A random permutation of the slots, and control indices that ascend in its order.
static void fill_patch(uint32_t control_count, uint32_t *indices, uint16_t *slots) {
    const uint32_t spread = CONTROLS / control_count;
    for (uint32_t k = 0; k < control_count; k++) {
        const uint32_t other = next_random() % (k + 1);
        slots[k] = slots[other];
        slots[other] = (uint16_t)k;
    }
    for (uint32_t k = 0; k < control_count; k++)
        indices[slots[k]] = k * spread + next_random() % spread;
}

static void fill_run(made *m, uint32_t c, uint64_t first_index, uint64_t first_slot) {
    const uint32_t control_count = m->classes[c].control_count;
    for (uint32_t p = 0; p < PATCHES; p++) {
        uint16_t slots[CONTROLS] = {0};
        const size_t skipped = (size_t)p * control_count;
        fill_patch(control_count, m->indices + first_index + skipped, slots);
        for (uint32_t k = 0; k < control_count; k++) {
            if (control_count <= LIMN_FORMAT_NARROW_SLOTS) {
                m->slots[first_slot + skipped + k] = (uint8_t)slots[k];
            } else {
                memcpy(m->slots + first_slot + 2 * (skipped + k), &slots[k], 2);
            }
        }
    }
}

/// One table of a class with three times as many rows. Returns its floats.
static uint64_t make_table(made *m, uint32_t c, uint64_t table) {
    limn_file_class *const class = &m->classes[c];
    class->table_offset = table * sizeof(float);
    class->pair_count = pair_counts[class->domain][c];
    const uint64_t size = limn_file_table_size(class);
    for (uint32_t t = 0; t < 3; t++)
        fill_table(class->control_count, limn_file_row_stride(class),
                   m->tables + table + t * size / 3);
    return size;
}

/// The same of four pieces. Each has some of the slots, the corners among them, in any order.
static uint64_t make_pieces(made *m, uint32_t c, uint64_t table, uint16_t **columns) {
    const uint32_t count = m->classes[c].control_count;
    uint16_t *const parts = *columns;
    uint64_t size = 0;
    m->classes[c].table_offset = (uint64_t)(parts - m->columns) * sizeof *parts;
    m->classes[c].depth = LIMN_FORMAT_PIECE_DEPTH;
    *columns += LIMN_FORMAT_PIECE_COUNT * (1 + (size_t)count);
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++) {
        const uint32_t index = c * LIMN_FORMAT_PIECE_COUNT + p;
        uint16_t *const of_piece = parts + LIMN_FORMAT_PIECE_COUNT + (size_t)p * count;
        uint16_t used = 0;
        parts[p] = (uint16_t)index;
        for (uint32_t slot = 0; slot < count; slot++) {
            const bool has = slot < m->corner_count || next_random() % 4;
            of_piece[slot] = has ? used++ : LIMN_FORMAT_NO_COLUMN;
        }
        m->pieces[index] =
            (limn_file_piece){.table_offset = (table + size) * sizeof(float),
                              .control_count = used,
                              .kind = (uint8_t)limni_piece_kind_of(m->mesh.domain, p),
                              .domain = (uint8_t)m->mesh.domain->kind,
                              .table_count = 3};
        const uint32_t stride = limn_file_piece_stride(&m->pieces[index]);
        for (uint32_t t = 0; t < 3; t++)
            fill_table(used, stride, m->tables + table + size + (size_t)t * used * stride);
        size += 3 * (uint64_t)used * stride;
    }
    return (size + 15) / 16 * 16;
}

static void make(made *m, limn_domain_kind domain, bool in_pieces) {
    const uint32_t *const counts = control_counts[domain];
    uint64_t total = 0, index = 0, slot = 0;
    for (uint32_t c = 0; c < CLASSES; c++)
        total += counts[c];
    m->mesh.domain = limn_domain_get(domain);
    m->in_pieces = in_pieces;
    m->row_count = m->mesh.domain->row_counts[LIMN_LEVEL_MAX];
    m->corner_count = m->mesh.domain->corner_count;
    m->tables = aligned_alloc(64, 3 * (total + CLASSES) * PLACES_MAX * sizeof(float)); // or less
    m->columns = malloc(LIMN_FORMAT_PIECE_COUNT * (total + CLASSES) * sizeof *m->columns);
    uint16_t *columns = m->columns;
    m->indices = malloc(total * PATCHES * sizeof(uint32_t));
    m->slots = malloc(total * PATCHES * 2 + CLASSES);
    uint64_t table = 0;
    for (uint32_t c = 0; c < CLASSES; c++) {
        slot += slot % 2;
        m->classes[c] = (limn_file_class){.control_count = counts[c],
                                          .domain = (uint16_t)domain,
                                          .table_count = 3,
                                          .depth = LIMN_FORMAT_DEPTH};
        m->runs[c] = (limn_file_run){.class_index = c,
                                     .first_patch = c * PATCHES,
                                     .patch_count = PATCHES,
                                     .first_index = index,
                                     .first_slot = slot};
        table += in_pieces ? make_pieces(m, c, table, &columns) : make_table(m, c, table);
        fill_run(m, c, index, slot);
        index += (uint64_t)counts[c] * PATCHES;
        slot += (uint64_t)counts[c] * PATCHES * limn_file_slot_size(&m->classes[c]);
    }
    m->mesh = (limn_mesh){.domain = m->mesh.domain,
                          .control_count = in_pieces ? 0 : CONTROLS, // all are points of level 1
                          .base_count = in_pieces ? 0 : CONTROLS,
                          .point_count = CONTROLS,
                          .patch_count = CLASSES * PATCHES,
                          .run_count = CLASSES,
                          .indices = m->indices,
                          .slots = m->slots,
                          .tables = m->tables,
                          .pieces = m->pieces,
                          .columns = m->columns,
                          .runs = m->runs,
                          .classes = m->classes,
                          .normals = &m->none};
}

/// How vertices are laid out.
typedef struct layout {
    limn_position_format position;
    limn_normal_format normal;
    uint32_t stride, normal_offset; ///< of vertices that hold both; 0: positions alone
    uint32_t position_offset;
    bool streaming;
    const limn_lighting *lighting; ///< NULL: no colours
    uint32_t colour_offset;
} layout;

static uint32_t position_size(const layout *l) {
    return l->position == LIMN_POSITION_FLOAT3 ? 12 : 8;
}

static uint32_t normal_size(const layout *l) {
    static const uint8_t sizes[] = {12, 4, 2, 4};
    return l->stride > position_size(l) + 1 && l->normal_offset != l->position_offset
               ? sizes[l->normal]
               : 0;
}

static bool is_written(const layout *l, size_t at) {
    return at - l->position_offset < position_size(l) || at - l->normal_offset < normal_size(l) ||
           (l->lighting && at - l->colour_offset < 4);
}

/// All kinds of lights, among points between -10 and 10.
static const limn_light lights[] = {
    {.colour = {0.2f, 0.1f, 0.1f}, .direction = {0.6f, -0.64f, -0.48f}},
    {.kind = LIMN_LIGHT_POINT,
     .colour = {2, 3, 4},
     .position = {3, -4, 5},
     .attenuation = {1, 0.5f, 0.25f}},
    {.kind = LIMN_LIGHT_SPOT,
     .colour = {0.3f, 0.1f, -0.1f},
     .position = {-2, 9, 1},
     .direction = {0, -1, 0},
     .range = 30,
     .inner_cosine = 0.9f,
     .outer_cosine = 0.4f},
};
static const limn_lighting lightings[2] = {
    {LIMN_LIGHT_INTERPOLATED, {0.1f, 0.2f, 0.3f}, lights, 3},
    {LIMN_LIGHT_EXACT, {0.3f, 0.2f, 0.1f}, lights, 3},
};

static limn_output make_output(const made *m, const layout *l, unsigned char *vertices) {
    static const float box[2][3] = {{-11, -12, -13}, {12, 20, 11}};
    limn_output output = {.vertices = vertices + l->position_offset,
                          .stride = l->stride,
                          .position_format = l->position,
                          .box = box[0],
                          .normal_format = l->normal,
                          .streaming = l->streaming};
    if (normal_size(l)) {
        output.normals = vertices + l->normal_offset;
        output.normal_stride = l->stride;
        output.control_normals = m->normals[0];
    }
    if (l->lighting) {
        output.colours = vertices + l->colour_offset;
        output.colour_stride = l->stride;
        output.lighting = l->lighting;
        output.control_normals = m->normals[0];
    }
    return output;
}

/// Evaluates a range into a buffer with guards and checks that nothing else was written. Returns
/// the size of what was written or guarded.
static size_t evaluate_as(made *m, const limn_kernels *kernels, uint32_t level, const layout *l,
                          uint32_t begin, uint32_t end, unsigned char *buffer) {
    m->mesh.kernels = kernels;
    const limn_plan plan = limn_plan_uniform(&m->mesh, level);
    const size_t size = (size_t)plan.vertex_count * l->stride;
    memset(buffer, 0xa5, size + 2 * GUARD);
    const limn_output output = make_output(m, l, buffer + GUARD);
    limn_evaluate(&plan, m->controls[0], begin, end, &output);

    const size_t row_count = plan.mesh->domain->row_counts[level];
    const size_t first = begin * row_count, last = end * row_count;
    bool untouched = true;
    for (size_t b = 0; b < size + 2 * GUARD; b++) {
        const bool inside = b >= GUARD + first * l->stride && b < GUARD + last * l->stride;
        if (inside && is_written(l, (b - GUARD) % l->stride)) continue;
        untouched &= buffer[b] == 0xa5;
    }
    CHECK(untouched);
    return size + 2 * GUARD;
}

/// Floats: positions, and where there is room, normals behind them.
static size_t evaluate(made *m, const limn_kernels *kernels, uint32_t level, uint32_t stride,
                       uint32_t begin, uint32_t end, unsigned char *buffer) {
    const layout l = {.stride = stride, .normal_offset = stride >= 24 ? 12 : 0};
    return evaluate_as(m, kernels, level, &l, begin, end, buffer);
}

static unsigned char expected[CLASSES * PATCHES * ROWS_MAX * STRIDE_MAX + 2 * GUARD];
static unsigned char actual[sizeof expected];

static const limn_kernels *scalar_kernels(void) {
    return limn_kernels_select(LIMN_ISA_SCALAR, LIMN_FAMILY_REPRODUCIBLE);
}

/// The reproducible kernels give the bits of the scalar ones; the fast ones must at least write
/// where they should.
static void test_ranges(made *m, const limn_kernels *kernels) {
    static const uint32_t strides[] = {12, 16, STRIDE_MAX};
    const uint32_t patch_count = m->mesh.patch_count;
    const uint32_t step = m->mesh.domain->kind == LIMN_DOMAIN_TRIANGLE ? 16 : 32;
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        for (int s = 0; s < 3; s++) {
            for (uint32_t begin = 0; begin <= patch_count; begin += 1 + next_random() % step) {
                const uint32_t end = begin + next_random() % (patch_count - begin + 1);
                evaluate(m, scalar_kernels(), level, strides[s], begin, end, expected);
                const size_t size = evaluate(m, kernels, level, strides[s], begin, end, actual);
                CHECK(kernels->family == LIMN_FAMILY_FAST || memcmp(expected, actual, size) == 0);
            }
        }
    }
}

/// Every level is a prefix of the finest, by bits, whatever the stride: which ways to sum and to
/// store a kernel takes must not show.
static void test_prefix(made *m, const limn_kernels *kernels) {
    evaluate(m, kernels, LIMN_LEVEL_MAX, 12, 0, m->mesh.patch_count, expected);
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        for (uint32_t stride = 12; stride <= STRIDE_MAX; stride += 12) {
            const size_t row_count = m->mesh.domain->row_counts[level];
            bool same = true;
            evaluate(m, kernels, level, stride, 0, m->mesh.patch_count, actual);
            for (size_t v = 0; v < m->mesh.patch_count * row_count; v++) {
                const size_t finest = v / row_count * m->row_count + v % row_count;
                same &=
                    memcmp(expected + GUARD + 12 * finest, actual + GUARD + stride * v, 12) == 0;
            }
            CHECK(same);
        }
    }
}

/// A range in parts gives the same as in one go.
static void test_split(made *m, const limn_kernels *kernels) {
    m->mesh.kernels = kernels;
    const limn_plan plan = limn_plan_uniform(&m->mesh, 2);
    const size_t size = (size_t)plan.vertex_count * 12;
    limn_evaluate(&plan, m->controls[0], 0, plan.patch_count, &(limn_output){.vertices = expected});
    memset(actual, 0, size);
    for (uint32_t patch = plan.patch_count; patch-- > 0;)
        limn_evaluate(&plan, m->controls[0], patch, patch + 1, &(limn_output){.vertices = actual});
    CHECK(memcmp(expected, actual, size) == 0);
}

/// A row in double precision, and how far from it a kernel may be.
typedef struct reference {
    double result, bound;
} reference;

/// Bounds a sum of n rounded products, or a compensated one, relative to the sum of absolute
/// values, plus the rounding of the origin. The sums of pairs take three roundings more.
static double bound(uint32_t terms, bool paired, double magnitude, double result) {
    const double unit = FLT_EPSILON / 2;
    const double roundings = terms > LIMNI_PLAIN_TERMS ? 4 : terms + (paired ? 4.0 : 1.0);
    return unit * (roundings * magnitude + 2 * fabs(result)) + 150 * (double)FLT_TRUE_MIN;
}

static reference refer(const made *m, uint32_t c, uint32_t patch, uint32_t row, int axis) {
    const limn_file_class *const class = &m->classes[c];
    const limn_file_run *const run = &m->runs[c];
    const uint32_t *const indices =
        m->indices + run->first_index + (size_t)patch * class->control_count;
    const column_place place = place_of_row(&m->mesh, c, 0, row);
    const float origin = place.paired ? m->controls[indices[0]][axis] : m->mesh.origin[axis];
    double sum = 0, magnitude = fabs((double)origin) * place.paired;
    uint32_t terms = 0;
    for (uint32_t slot = 0; slot < class->control_count; slot++) {
        const double coefficient = coefficient_at(&place, slot);
        const float relative = m->controls[indices[slot]][axis] - origin; // rounded, as by kernels
        sum += coefficient * (double)relative;
        terms += coefficient != 0;
        // A pair's sum and difference are as large as both its points, and so are its coefficients.
        magnitude += (fabs(coefficient) + (place.paired ? 2.0 / class->control_count : 0)) *
                     fabs((double)relative) * (place.paired ? 2 : 1);
    }
    const double result = sum + (double)origin;
    return (reference){result, bound(terms, place.paired, magnitude, result)};
}

/// A tangent of a row, from table 1 or 2, and what its sum may be off by. Rows in the block of an
/// edge are relative to its end with the lower index, others to the first corner.
static double refer_tangent(const made *m, uint32_t c, uint32_t patch, uint32_t row, uint32_t table,
                            double tangent[3]) {
    const limn_file_class *const class = &m->classes[c];
    const uint32_t *const indices =
        m->indices + m->runs[c].first_index + (size_t)patch * class->control_count;
    const column_place place = place_of_row(&m->mesh, c, table, row);
    const uint32_t edge = place.edge, end = (edge + 1) % (uint32_t)m->corner_count;
    uint32_t near = indices[0];
    if (edge < m->corner_count) near = indices[edge] < indices[end] ? indices[edge] : indices[end];
    const double sign = place.image && table == 2 ? -1 : 1; // a mirror turns the tangent across
    double error = 0;
    for (int axis = 0; axis < 3; axis++) {
        double magnitude = 0;
        tangent[axis] = 0;
        for (uint32_t slot = 0; slot < class->control_count; slot++) {
            const double coefficient = coefficient_at(&place, slot);
            const double point =
                (double)(m->controls[indices[slot]][axis] - m->controls[near][axis]);
            tangent[axis] += sign * coefficient * point;
            magnitude += (fabs(coefficient) + (place.paired ? 2.0 / class->control_count : 0)) *
                         fabs(point) * (place.paired ? 2 : 1);
        }
        error = fmax(error, bound(place.column_count, place.paired, magnitude, tangent[axis]));
    }
    return error;
}

static double length_of(const double a[3]) {
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static void cross_product(const double a[3], const double b[3], double product[3]) {
    for (int axis = 0; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        product[axis] = a[u] * b[v] - a[v] * b[u];
    }
}

/// The normal of a row is that of both tangents, within what their errors may turn it by.
static void check_normal(const made *m, uint32_t c, uint32_t patch, uint32_t row,
                         const float *normal) {
    double along[3], across[3], exact[3], off[3], dot = 0;
    const double e = refer_tangent(m, c, patch, row, 1, along) / length_of(along);
    const double f = refer_tangent(m, c, patch, row, 2, across) / length_of(across);
    const double n[3] = {normal[0], normal[1], normal[2]};
    cross_product(along, across, exact);
    cross_product(exact, n, off);
    for (int axis = 0; axis < 3; axis++)
        dot += exact[axis] * n[axis];
    const double sine = length_of(exact) / (length_of(along) * length_of(across));
    const double allowed = 2 * (e + f) / sine + 1e-6;
    if (!(allowed < 0.1)) return; // nothing can be said: the tangents are nearly parallel, or 0
    CHECK(dot > 0 && length_of(off) / length_of(exact) <= allowed);
}

static void check_row(const made *m, uint32_t c, uint32_t patch, uint32_t row,
                      const float *vertex) {
    for (int axis = 0; axis < 3; axis++) {
        const reference r = refer(m, c, patch, row, axis);
        CHECK_NEAR((double)vertex[axis], r.result, r.bound);
    }
}

/// Normals only of points whose tangents floats can square.
static void test_precision(made *m, const limn_kernels *kernels, bool has_normals) {
    static float normals[CLASSES * PATCHES * ROWS_MAX][3];
    m->mesh.kernels = kernels;
    const limn_plan plan = limn_plan_uniform(&m->mesh, LIMN_LEVEL_MAX);
    limn_evaluate(
        &plan, m->controls[0], 0, plan.patch_count,
        &(limn_output){.vertices = actual, .normals = normals, .control_normals = m->normals[0]});
    for (uint32_t c = 0; c < CLASSES; c++) {
        for (uint32_t patch = 0; patch < PATCHES; patch++) {
            for (uint32_t row = 0; row < m->row_count; row++) {
                const size_t vertex = ((size_t)c * PATCHES + patch) * m->row_count + row;
                check_row(m, c, patch, row, (const float *)(const void *)(actual + 12 * vertex));
                if (has_normals && row >= m->corner_count)
                    check_normal(m, c, patch, row, normals[vertex]);
            }
        }
    }
}

/// The bits of a whole evaluation at every level: the same from all reproducible kernels, whatever
/// the compiler and its flags. If this changes, results change for everybody.
static void test_golden(made *m, const limn_kernels *kernels) {
    static const uint64_t goldens[LIMN_DOMAIN_COUNT][2][LIMN_LEVEL_COUNT] = {
        {{0xe2a6d34423703fc1u, 0x1147a25460ba461bu, 0x3d12e9c75aa4b848u, 0xd378fcc6fffc5bf8u,
          0x22756486d7b9ae4fu},
         {0x8abda75424063ef7u, 0x23fb39c436b097efu, 0x1182769033975e64u, 0x32b5ea5ad75f3f57u,
          0x8dbc0c2080328876u}},
        {{0x108eb2189198aa0au, 0x0caa1cdedc794836u, 0x14b5c3eed0335cf4u, 0x9b553b7c5fa1c202u,
          0x0145d6e5e4b5cffbu},
         {0x1db1eddf19a9e642u, 0x04000ff48794890du, 0x68fd92d0b15aee1fu, 0x71c7515290c1e7e6u,
          0x52e061cae3bad8dcu}}};
    const uint64_t *const golden = goldens[m->mesh.domain->kind][m->in_pieces];
    m->mesh.kernels = kernels;
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        const limn_plan plan = limn_plan_uniform(&m->mesh, level);
        evaluate(m, kernels, level, 24, 0, plan.patch_count, actual); // with normals
        const uint64_t hash = limni_checksum(actual + GUARD, (size_t)plan.vertex_count * 24);
        if (!CHECK(hash == golden[level]))
            fprintf(stderr, "    %s: level %u: 0x%016llx\n", limn_kernels_name(kernels), level,
                    (unsigned long long)hash);
    }
}

/// The same of colours, in both modes.
static void test_golden_light(made *m, const limn_kernels *kernels) {
    static const uint64_t goldens[LIMN_DOMAIN_COUNT][2][2] = {
        {{0x0156f45897f27e4du, 0x4489522599d8577cu}, {0x5a8593cb52532e46u, 0x83ca221a6e9fc019u}},
        {{0x244be30527819381u, 0xa5e255d8fc4a3ea5u}, {0xda3510e782471769u, 0x6ebbc025f97b2e89u}}};
    for (int mode = 0; mode < 2; mode++) {
        const layout l = {.stride = 16, .lighting = &lightings[mode], .colour_offset = 12};
        const size_t size = evaluate_as(m, kernels, 3, &l, 0, m->mesh.patch_count, actual);
        const uint64_t hash = limni_checksum(actual + GUARD, size - 2 * GUARD);
        if (!CHECK(hash == goldens[m->mesh.domain->kind][m->in_pieces][mode]))
            fprintf(stderr, "    %s: light %d: 0x%016llx\n", limn_kernels_name(kernels), mode,
                    (unsigned long long)hash);
    }
}

/// Normals in a stream of their own are those inside the vertices; corners have the control
/// points'.
static void test_normal_stream(made *m, const limn_kernels *kernels) {
    static float normals[CLASSES * PATCHES * ROWS_MAX][3];
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        const limn_plan plan = limn_plan_uniform(&m->mesh, level);
        evaluate(m, kernels, level, STRIDE_MAX, 0, plan.patch_count, expected);
        limn_evaluate(&plan, m->controls[0], 0, plan.patch_count,
                      &(limn_output){.vertices = actual,
                                     .normals = normals,
                                     .control_normals = m->normals[0]});
        bool same = true;
        for (size_t v = 0; v < plan.vertex_count; v++)
            same &= memcmp(normals[v], expected + GUARD + STRIDE_MAX * v + 12, 12) == 0;
        CHECK(same);
        for (uint32_t patch = 0; patch < plan.patch_count; patch++) {
            uint32_t corners[LIMN_CORNER_MAX];
            limn_mesh_corners(&m->mesh, patch, corners);
            for (uint32_t c = 0; c < m->corner_count; c++)
                CHECK(memcmp(normals[limn_plan_first_vertex(&plan, patch) + c],
                             m->normals[corners[c]], 12) == 0);
        }
    }
}

/// Where the cross product of the tangents is too short or too long to be squared, the normal is
/// (0, 0, 1): of all rows whose tangents are 0 or denormal, and of many with extreme ones.
static void test_fallback(made *m, const limn_kernels *kernels, bool all) {
    static const float fallback[3] = {0, 0, 1};
    const size_t count = m->mesh.patch_count * m->row_count;
    size_t fallen = 0;
    bool unit = true;
    evaluate(m, kernels, LIMN_LEVEL_MAX, 24, 0, m->mesh.patch_count, actual);
    for (size_t v = 0; v < count; v++) {
        float normal[3];
        if (v % m->row_count < m->corner_count) continue; // corners have the control points'
        memcpy(normal, actual + GUARD + 24 * v + 12, sizeof normal);
        const double n[3] = {normal[0], normal[1], normal[2]};
        unit &= fabs(length_of(n) - 1) < 1e-6;
        fallen += memcmp(normal, fallback, sizeof normal) == 0;
    }
    CHECK(unit);
    CHECK(all ? fallen == m->mesh.patch_count * (m->row_count - m->corner_count) : fallen > 0);
}

// ---- Formats

static const layout layouts[] = {
    {.position = LIMN_POSITION_UNORM16X4, .stride = 8},
    {.position = LIMN_POSITION_UNORM16X4, .stride = 20, .position_offset = 4, .normal_offset = 4},
    {.stride = 16, .normal_offset = 12, .normal = LIMN_NORMAL_OCT16X2},
    {.stride = 16, .normal_offset = 12, .normal = LIMN_NORMAL_SNORM8X4},
    {.stride = 16, .normal_offset = 12, .normal = LIMN_NORMAL_OCT8X2},
    {.stride = 16, .position_offset = 4, .normal_offset = 0, .normal = LIMN_NORMAL_OCT16X2},
    {.stride = 24, .position_offset = 12, .normal_offset = 0},
    {.stride = 32, .position_offset = 4, .normal_offset = 20},
    {.stride = 20, .position_offset = 0, .normal_offset = 8, .position = LIMN_POSITION_UNORM16X4},
    {.stride = 12,
     .normal_offset = 8,
     .position = LIMN_POSITION_UNORM16X4,
     .normal = LIMN_NORMAL_OCT16X2},
    {.stride = 24,
     .position_offset = 4,
     .normal_offset = 18,
     .position = LIMN_POSITION_UNORM16X4,
     .normal = LIMN_NORMAL_OCT8X2},
    {.stride = 28, .position_offset = 4, .normal_offset = 16},
    {.stride = 16, .lighting = &lightings[0], .colour_offset = 12},
    {.stride = 16, .lighting = &lightings[1], .colour_offset = 12},
    {.stride = 20, .position_offset = 8, .normal_offset = 8, .lighting = &lightings[0]},
    {.stride = 28, .normal_offset = 12, .lighting = &lightings[0], .colour_offset = 24},
    {.stride = 28, .normal_offset = 16, .lighting = &lightings[1], .colour_offset = 12},
    {.stride = 36,
     .position_offset = 8,
     .normal_offset = 24,
     .lighting = &lightings[1],
     .colour_offset = 4},
    {.stride = 12,
     .position = LIMN_POSITION_UNORM16X4,
     .lighting = &lightings[0],
     .colour_offset = 8},
    {.stride = 16,
     .position = LIMN_POSITION_UNORM16X4,
     .normal_offset = 12,
     .normal = LIMN_NORMAL_OCT8X2,
     .lighting = &lightings[1],
     .colour_offset = 8},
};
enum { LAYOUTS = sizeof layouts / sizeof *layouts };

/// As with the scalar kernels, bit for bit; and past the caches as through them.
static void test_layouts(made *m, const limn_kernels *kernels) {
    for (uint32_t i = 0; i < 2 * LAYOUTS; i++) {
        const layout *const plain = &layouts[i % LAYOUTS];
        const uint32_t level = i < LAYOUTS ? i % LIMN_LEVEL_COUNT : LIMN_LEVEL_MAX;
        const uint32_t count = m->mesh.patch_count, begin = next_random() % count;
        const uint32_t end = begin + 1 + next_random() % (count - begin);
        layout streaming = *plain;
        streaming.streaming = true;
        const size_t size = evaluate_as(m, kernels, level, plain, begin, end, actual);
        evaluate_as(m, kernels, level, &streaming, begin, end, expected);
        CHECK(memcmp(expected, actual, size) == 0);
        evaluate_as(m, scalar_kernels(), level, plain, begin, end, expected);
        CHECK(kernels->family == LIMN_FAMILY_FAST || memcmp(expected, actual, size) == 0);
    }
    const layout tight = {.stride = 12, .streaming = true};
    const size_t size = evaluate(m, kernels, 4, 12, 1, m->mesh.patch_count, actual);
    evaluate_as(m, kernels, 4, &tight, 1, m->mesh.patch_count, expected);
    CHECK(memcmp(expected, actual, size) == 0);
}

static void unpack_octahedral(int u, int v, double limit, double n[3]) {
    n[0] = u / limit, n[1] = v / limit;
    n[2] = 1 - fabs(n[0]) - fabs(n[1]);
    if (n[2] < 0) {
        const double x = n[0];
        n[0] = (1 - fabs(n[1])) * (x < 0 ? -1 : 1);
        n[1] = (1 - fabs(x)) * (n[1] < 0 ? -1 : 1);
    }
}

static void unpack_normal(limn_normal_format format, const unsigned char *from, double n[3]) {
    const int8_t *const bytes = (const int8_t *)from;
    int16_t words[2];
    memcpy(words, from, format == LIMN_NORMAL_OCT16X2 ? 4 : 2);
    if (format == LIMN_NORMAL_OCT16X2) unpack_octahedral(words[0], words[1], 32767, n);
    if (format == LIMN_NORMAL_OCT8X2) unpack_octahedral(bytes[0], bytes[1], 127, n);
    if (format == LIMN_NORMAL_SNORM8X4) {
        for (int axis = 0; axis < 3; axis++)
            n[axis] = bytes[axis] / 127.0;
        CHECK(bytes[3] == 0);
    }
}

static double angle_between(const double a[3], const float b[3]) {
    double dot = 0, square = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        const double cross = a[next] * (double)b[last] - a[last] * (double)b[next];
        dot += a[axis] * (double)b[axis];
        square += cross * cross;
    }
    return atan2(sqrt(square), dot);
}

/// Streams of their own hold what is inside the vertices otherwise, tightly packed or not.
static void test_streams(made *m, const limn_kernels *kernels) {
    static unsigned char positions[CLASSES * PATCHES * ROWS_MAX * 16 + 2 * GUARD];
    static unsigned char normals[CLASSES * PATCHES * ROWS_MAX * 16 + 2 * GUARD];
    static unsigned char colours[CLASSES * PATCHES * ROWS_MAX * 8 + 2 * GUARD];
    for (int kind = 0; kind < 32; kind++) {
        const layout inside = {.stride = STRIDE_MAX,
                               .normal_offset = 16,
                               .position = (limn_position_format)(kind % 2),
                               .normal = (limn_normal_format)(kind / 2 % 4),
                               .streaming = kind / 8 % 2,
                               .lighting = &lightings[kind % 2],
                               .colour_offset = 32};
        const uint32_t gap = kind / 16 ? 4 : 0, level = next_random() % LIMN_LEVEL_COUNT;
        const uint32_t position_stride = position_size(&inside) + gap;
        const uint32_t normal_stride = normal_size(&inside) + gap;
        evaluate_as(m, kernels, level, &inside, 0, m->mesh.patch_count, expected);
        memset(positions, 0xa5, sizeof positions);
        memset(normals, 0xa5, sizeof normals);
        memset(colours, 0xa5, sizeof colours);
        limn_output output = make_output(m, &inside, positions + GUARD);
        output.stride = position_stride;
        output.normals = normals + GUARD;
        output.normal_stride = normal_stride;
        output.colours = colours + GUARD;
        output.colour_stride = 4 + gap;
        const limn_plan plan = limn_plan_uniform(&m->mesh, level);
        limn_evaluate(&plan, m->controls[0], 0, plan.patch_count, &output);
        const size_t count = (size_t)plan.vertex_count;
        bool same = true;
        for (size_t v = 0; v < count; v++) {
            const unsigned char *const vertex = expected + GUARD + v * STRIDE_MAX;
            same &= memcmp(vertex, positions + GUARD + v * position_stride,
                           position_size(&inside)) == 0;
            same &=
                memcmp(vertex + 16, normals + GUARD + v * normal_stride, normal_size(&inside)) == 0;
            same &= memcmp(vertex + 32, colours + GUARD + v * (4 + gap), 4) == 0;
        }
        CHECK(same);
        CHECK(positions[GUARD - 1] == 0xa5 && positions[GUARD + count * position_stride] == 0xa5);
        CHECK(normals[GUARD - 1] == 0xa5 && normals[GUARD + count * normal_stride] == 0xa5);
        CHECK(colours[GUARD - 1] == 0xa5 && colours[GUARD + count * (4 + gap)] == 0xa5);
    }
}

// ---- Plans with levels of detail

enum { PATCH_TOTAL = CLASSES * PATCHES };

/// Some of the patches, at any levels and weights, one behind the other.
static limn_plan make_plan(const made *m, limn_plan_patch *items) {
    limn_plan plan = {.mesh = &m->mesh, .patches = items};
    for (uint32_t patch = 0; patch < PATCH_TOTAL; patch++) {
        limn_plan_patch *const item = &items[plan.patch_count];
        if (next_random() % 4 == 0) continue;
        plan.patch_count++;
        *item = (limn_plan_patch){.patch = patch,
                                  .level = (uint8_t)(next_random() % LIMN_LEVEL_COUNT),
                                  .first_vertex = (uint32_t)plan.vertex_count,
                                  .morph = next_random() % 4 ? random_float(0, 1) : 1};
        for (uint32_t e = 0; e < m->corner_count; e++) {
            item->edge_levels[e] = (uint8_t)(next_random() % (item->level + 1u));
            item->edge_morphs[e] = next_random() % 4 ? random_float(0, 1) : 1;
        }
        plan.vertex_count += m->mesh.domain->row_counts[item->level];
    }
    return plan;
}

static void evaluate_plan(made *m, const limn_kernels *kernels, const limn_plan *plan,
                          const layout *l, uint32_t begin, uint32_t end, unsigned char *buffer) {
    m->mesh.kernels = kernels;
    const size_t size = (size_t)plan->vertex_count * l->stride;
    memset(buffer, 0xa5, size + 2 * GUARD);
    const limn_output output = make_output(m, l, buffer + GUARD);
    limn_evaluate(plan, m->controls[0], begin, end, &output);
    const size_t last = end < plan->patch_count ? (size_t)plan->patches[end].first_vertex
                                                : (size_t)plan->vertex_count;
    const size_t first = begin < end ? plan->patches[begin].first_vertex : last;
    bool untouched = true;
    for (size_t b = 0; b < size + 2 * GUARD; b++) {
        if (b < GUARD + first * l->stride || b >= GUARD + last * l->stride)
            untouched &= buffer[b] == 0xa5;
    }
    CHECK(untouched);
}

/// Patches at levels of their own, morphed: as with the scalar kernels, and nothing else is
/// written.
static void test_plans(made *m, const limn_kernels *kernels) {
    static limn_plan_patch items[PATCH_TOTAL];
    for (int round = 0; round < 8; round++) {
        const layout l = round % 3 == 0   ? (layout){.stride = 12}
                         : round % 3 == 1 ? (layout){.stride = 24, .normal_offset = 12}
                                          : layouts[next_random() % LAYOUTS];
        const limn_plan plan = make_plan(m, items);
        const uint32_t begin = next_random() % plan.patch_count;
        const uint32_t end = begin + next_random() % (plan.patch_count - begin + 1);
        evaluate_plan(m, scalar_kernels(), &plan, &l, begin, end, expected);
        evaluate_plan(m, kernels, &plan, &l, begin, end, actual);
        const size_t size = (size_t)plan.vertex_count * l.stride + 2 * GUARD;
        CHECK(kernels->family == LIMN_FAMILY_FAST || memcmp(expected, actual, size) == 0);
    }
}

// ---- Morphing, by its definition

typedef double vector[3];

/// Where the rows of a patch are at the finest level: positions, or normals.
typedef struct shown {
    const limn_domain *domain;
    const limn_plan_patch *item;
    const float (*finest)[6];
    size_t first; ///< of the six floats
} shown;

static void show(const shown *s, uint32_t row, vector where);

/// Part `weight` of the way from the middle of two rows to a third; normals are of unit length
/// again.
static void show_between(const shown *s, const uint16_t from[2], uint32_t row, double weight,
                         vector where) {
    vector a, b;
    show(s, from[0], a);
    show(s, from[1], b);
    for (size_t axis = 0; axis < 3; axis++)
        where[axis] = (1 - weight) * (a[axis] + b[axis]) / 2 +
                      weight * (double)s->finest[row][s->first + axis];
    const double length = s->first ? length_of(where) : 1;
    for (size_t axis = 0; axis < 3; axis++)
        where[axis] /= length;
}

/// On an edge, a row that the edge does not have is where its elder is; that of level 1, where the
/// edge starts.
static void show_on_edge(const shown *s, uint32_t e, uint32_t row, vector where) {
    const limn_row r = s->domain->rows[row];
    const uint8_t levels[2] = {s->domain->rows[r.parents[0]].level,
                               s->domain->rows[r.parents[1]].level};
    const uint16_t elder = r.parents[levels[0] > levels[1]];
    const uint16_t both[2] = {r.level == 1 ? r.parents[0] : elder,
                              r.level == 1 ? r.parents[1] : elder};
    if (r.level > s->item->edge_levels[e]) {
        show(s, r.level == 1 ? s->domain->edge_rows[e][0] : elder, where);
    } else {
        show_between(s, both, row, (double)s->item->edge_morphs[e], where);
    }
}

/// Where a row is displayed.
static void show(const shown *s, uint32_t row, vector where) {
    const limn_row r = s->domain->rows[row];
    float weight = 1;
    for (uint32_t e = 0; e < s->domain->corner_count && r.level > 0; e++) {
        if (!(r.edges >> e & 1) || r.level < s->item->edge_levels[e]) continue;
        weight = r.level > s->item->edge_levels[e] ? 0 : s->item->edge_morphs[e];
        if (weight != 1) {
            show_on_edge(s, e, row, where);
            return;
        }
    }
    if (r.level > 0 && !r.edges && r.level == s->item->level && s->item->morph != 1) {
        show_between(s, r.parents, row, (double)s->item->morph, where);
        return;
    }
    for (size_t axis = 0; axis < 3; axis++)
        where[axis] = (double)s->finest[row][s->first + axis];
}

/// Rows that templates leave out may be anywhere.
static bool is_drawn(const shown *s, uint32_t row) {
    const limn_row r = s->domain->rows[row];
    bool drawn = true;
    for (uint32_t e = 0; e < s->domain->corner_count; e++)
        drawn &= !(r.edges >> e & 1) || r.level <= s->item->edge_levels[e];
    return drawn;
}

/// Rows of a plan are where the definition has them. Normals that turn back while they morph have
/// lost digits.
static void test_morphing(made *m, const limn_kernels *kernels) {
    static limn_plan_patch items[PATCH_TOTAL];
    static float finest[PATCH_TOTAL * ROWS_MAX][6], vertices[PATCH_TOTAL * ROWS_MAX][6];
    const limn_plan plan = make_plan(m, items), whole = limn_plan_uniform(&m->mesh, 4);
    limn_output output = {.stride = 24, .normal_stride = 24, .control_normals = m->normals[0]};
    m->mesh.kernels = kernels;
    output.vertices = finest[0], output.normals = finest[0] + 3;
    limn_evaluate(&whole, m->controls[0], 0, whole.patch_count, &output);
    output.vertices = vertices[0], output.normals = vertices[0] + 3;
    limn_evaluate(&plan, m->controls[0], 0, plan.patch_count, &output);
    double furthest[2] = {0};
    uint32_t moved = 0;
    for (uint32_t p = 0; p < plan.patch_count; p++) {
        const limn_plan_patch *const item = &items[p];
        shown s = {m->mesh.domain, item, (const float(*)[6])finest + item->patch * m->row_count, 0};
        for (uint32_t row = 0; row < m->mesh.domain->row_counts[item->level]; row++) {
            const float *const vertex = vertices[item->first_vertex + row];
            if (!is_drawn(&s, row)) continue;
            moved += memcmp(vertex, s.finest[row], 12) != 0;
            for (s.first = 0; s.first < 6; s.first += 3) {
                vector where;
                show(&s, row, where);
                for (size_t axis = 0; axis < 3; axis++)
                    furthest[s.first / 3] = fmax(
                        furthest[s.first / 3], fabs((double)vertex[s.first + axis] - where[axis]));
            }
        }
    }
    CHECK(moved > 100);
    CHECK(furthest[0] < 2e-6);
    CHECK(furthest[1] < 1e-5);
}

/// A plan of all patches, with levels and weights that are always the same, as a golden value.
static void test_golden_plan(made *m, const limn_kernels *kernels) {
    static const uint64_t goldens[LIMN_DOMAIN_COUNT][2] = {
        {0x165597af3afa03aau, 0xfaeb1966053f431au}, {0xf9db39c9c5c0c3d5u, 0x87a77b5d35533b7bu}};
    const uint64_t golden = goldens[m->mesh.domain->kind][m->in_pieces];
    static limn_plan_patch items[PATCH_TOTAL];
    limn_plan plan = {.mesh = &m->mesh, .patches = items, .patch_count = PATCH_TOTAL};
    for (uint32_t patch = 0; patch < PATCH_TOTAL; patch++) {
        limn_plan_patch *const item = &items[patch];
        *item = (limn_plan_patch){.patch = patch,
                                  .level = (uint8_t)(patch % LIMN_LEVEL_COUNT),
                                  .first_vertex = (uint32_t)plan.vertex_count,
                                  .morph = (float)(patch % 7) / 6};
        for (uint32_t e = 0; e < m->corner_count; e++) {
            item->edge_levels[e] = (uint8_t)((patch / 2 + e) % (item->level + 1u));
            item->edge_morphs[e] = (float)((patch + e) % 5) / 4;
        }
        plan.vertex_count += m->mesh.domain->row_counts[item->level];
    }
    const layout l = {.stride = 24, .normal_offset = 12};
    evaluate_plan(m, kernels, &plan, &l, 0, plan.patch_count, actual);
    const uint64_t hash = limni_checksum(actual + GUARD, (size_t)plan.vertex_count * l.stride);
    if (!CHECK(hash == golden))
        fprintf(stderr, "    %s: plan: 0x%016llx\n", limn_kernels_name(kernels),
                (unsigned long long)hash);
}

/// Packed normals, unpacked, are near the floats: half a step in each coordinate is sqrt(18) of
/// that in the middle of the octahedron's faces, and sqrt(3) on the sphere. Corners are left out,
/// whose normals are not of unit length here.
static void test_packed_normals(made *m, const limn_kernels *kernels) {
    static const double bounds[] = {0, 4.25 * 0.5 / 32767, 4.25 * 0.5 / 127, 1.74 * 0.5 / 127};
    const uint32_t count = m->mesh.patch_count;
    evaluate(m, kernels, LIMN_LEVEL_MAX, 24, 0, count, expected);
    for (int format = LIMN_NORMAL_OCT16X2; format <= LIMN_NORMAL_SNORM8X4; format++) {
        const layout l = {.stride = 16, .normal_offset = 12, .normal = (limn_normal_format)format};
        double furthest = 0;
        evaluate_as(m, kernels, LIMN_LEVEL_MAX, &l, 0, count, actual);
        for (size_t v = 0; v < count * m->row_count; v++) {
            double n[3];
            float exact[3];
            if (v % m->row_count < m->corner_count) continue;
            memcpy(exact, expected + GUARD + 24 * v + 12, 12);
            unpack_normal(l.normal, actual + GUARD + 16 * v + 12, n);
            furthest = fmax(furthest, angle_between(n, exact));
        }
        CHECK(furthest < bounds[format]);
        CHECK(furthest > bounds[format] / 2); // they are packed at all
    }
}

/// Packed positions, unpacked, are half a step from the floats, or on the box.
static void test_packed_positions(made *m, const limn_kernels *kernels) {
    static const double low[3] = {-11, -12, -13}, high[3] = {12, 20, 11};
    const layout l = {.stride = 8, .position = LIMN_POSITION_UNORM16X4};
    const uint32_t count = m->mesh.patch_count;
    uint32_t clamped = 0;
    evaluate(m, kernels, LIMN_LEVEL_MAX, 12, 0, count, expected);
    evaluate_as(m, kernels, LIMN_LEVEL_MAX, &l, 0, count, actual);
    for (size_t v = 0; v < count * m->row_count; v++) {
        uint16_t packed[4];
        float exact[3];
        memcpy(exact, expected + GUARD + 12 * v, sizeof exact);
        memcpy(packed, actual + GUARD + 8 * v, sizeof packed);
        CHECK_EQUAL(packed[3], 65535);
        for (int axis = 0; axis < 3; axis++) {
            const double step = (high[axis] - low[axis]) / 65535;
            const double inside = fmin(fmax((double)exact[axis], low[axis]), high[axis]);
            clamped += inside != (double)exact[axis];
            CHECK_NEAR(low[axis] + packed[axis] * step, inside, 0.51 * step);
        }
    }
    CHECK(clamped > 0);
}

/// Whether a row depends on a control point that is not finite; `any`: whether its patch does.
static bool is_spoilt(const made *m, uint32_t patch, uint32_t row, int axis, bool *any) {
    const limn_file_run *const run = &m->runs[patch / PATCHES];
    const limn_file_class *const class = &m->classes[run->class_index];
    const uint32_t *const indices =
        m->indices + run->first_index + (size_t)(patch % PATCHES) * class->control_count;
    const column_place place = place_of_row(&m->mesh, patch / PATCHES, 0, row);
    bool spoilt = false;
    *any = false;
    for (uint32_t slot = 0; slot < class->control_count; slot++) {
        if (isfinite(m->controls[indices[slot]][axis])) continue;
        *any = true;
        spoilt |= coefficient_at(&place, slot) != 0;
    }
    return spoilt;
}

/// NaN and infinity reach all rows that depend on them, and no other patches.
static void test_not_finite(made *m, const limn_kernels *kernels) {
    m->mesh.kernels = kernels;
    const limn_plan plan = limn_plan_uniform(&m->mesh, LIMN_LEVEL_MAX);
    uint32_t spoilt_count = 0, finite_count = 0;
    limn_evaluate(&plan, m->controls[0], 0, plan.patch_count, &(limn_output){.vertices = actual});
    for (uint32_t patch = 0; patch < plan.patch_count; patch++) {
        for (uint32_t row = 0; row < m->row_count; row++) {
            float vertex[3];
            memcpy(vertex, actual + 12 * (m->row_count * patch + row), sizeof vertex);
            for (int axis = 0; axis < 3; axis++) {
                bool any;
                const bool spoilt = is_spoilt(m, patch, row, axis, &any);
                if (spoilt) CHECK(!isfinite(vertex[axis]));
                if (!any) CHECK(isfinite(vertex[axis]));
                spoilt_count += spoilt;
                finite_count += !any;
            }
        }
    }
    CHECK(spoilt_count > 0 && finite_count > 0);
}

// ---- Points of level 1

enum { OWN = 40, ADDED = 61, TERMS = 9, ROOM = 3 * (OWN + ADDED) + 4 };

/// Stencils whose weights add up to 1. The first has no terms, the second is a control point.
typedef struct stencils {
    limn_mesh mesh;
    uint32_t first[ADDED + 1];
    limn_file_term terms[ADDED * TERMS];
} stencils;

static void make_stencils(stencils *s) {
    uint32_t count = 0;
    for (uint32_t p = 0; p < ADDED; p++) {
        const uint32_t length = p < 2 ? p : 1 + next_random() % TERMS;
        float rest = 1;
        s->first[p] = count;
        for (uint32_t t = 0; t < length; t++, count++) {
            const float weight = t + 1 < length ? random_float(-0.2f, 0.4f) : rest;
            s->terms[count] = (limn_file_term){next_random() % OWN, weight};
            rest -= weight;
        }
    }
    s->first[ADDED] = count;
    s->mesh = (limn_mesh){.control_count = OWN,
                          .point_count = OWN + ADDED,
                          .origin = {1, 2, 3},
                          .stencils = s->first,
                          .terms = s->terms};
}

static void check_point(const stencils *s, uint32_t p, const float *points) {
    const float *const point = points + 3 * (size_t)(OWN + p);
    for (int axis = 0; axis < 3; axis++) {
        double sum = p == 0 ? (double)s->mesh.origin[axis] : 0, magnitude = 0;
        for (uint32_t t = s->first[p]; t < s->first[p + 1]; t++) {
            const double at = (double)points[3 * (size_t)s->terms[t].point + (size_t)axis];
            sum += (double)s->terms[t].weight * at;
            magnitude += fabs((double)s->terms[t].weight * at) + fabs(at);
        }
        CHECK_NEAR((double)point[axis], sum,
                   p < 2 ? 0 : (TERMS + 2) * (double)FLT_EPSILON * magnitude);
    }
}

/// The golden bits, of either family; control points and what lies behind are left alone.
static void test_refine(const limn_kernels *kernels) {
    static const uint64_t golden = 0x803abb9350e88a28u;
    static stencils s;
    state = 12345;
    float before[ROOM], points[ROOM];
    make_stencils(&s);
    for (size_t c = 0; c < ROOM; c++)
        before[c] = points[c] = random_float(90, 110);
    s.mesh.kernels = kernels;
    limn_mesh_refine(&s.mesh, points);
    CHECK(memcmp(points, before, 3 * OWN * sizeof *points) == 0);
    CHECK(memcmp(points + 3 * (OWN + ADDED), before + 3 * (OWN + ADDED), 4 * sizeof *points) == 0);
    for (uint32_t p = 0; p < ADDED; p++)
        check_point(&s, p, points);
    const uint64_t hash = limni_checksum(points, sizeof points);
    if (!CHECK(hash == golden))
        fprintf(stderr, "    %s: points: 0x%016llx\n", limn_kernels_name(kernels),
                (unsigned long long)hash);
}

/// A long stencil of equal weights, whose roundings all go the same way in a plain sum: to a
/// rounding of the sum, of which 200 would make 1e-6.
static void test_refine_long(const limn_kernels *kernels) {
    enum { LONG = 200 };
    limn_file_term terms[LONG];
    const uint32_t first[] = {0, LONG};
    float points[3 * (LONG + 1) + 1] = {0};
    double sum = 0;
    for (uint32_t t = 0; t < LONG; t++) {
        terms[t] = (limn_file_term){t, 1.0f / LONG};
        points[3 * t] = t == 0 ? 0 : 1;
        sum += (double)terms[t].weight * (double)points[3 * t];
    }
    const limn_mesh mesh = {.control_count = LONG,
                            .point_count = LONG + 1,
                            .stencils = first,
                            .terms = terms,
                            .kernels = kernels};
    limn_mesh_refine(&mesh, points);
    CHECK_NEAR((double)points[3 * LONG], sum, (double)FLT_EPSILON);
    CHECK(points[3 * LONG + 1] == 0 && points[3 * LONG + 2] == 0);
}

static void test_refining(bool fast) {
    const limn_family family = fast ? LIMN_FAMILY_FAST : LIMN_FAMILY_REPRODUCIBLE;
    for (uint32_t isa = 1; isa <= LIMN_ISA_NEON; isa <<= 1) {
        if (!(limn_isa_supported() & isa)) continue;
        test_refine(limn_kernels_select(isa, family));
        test_refine_long(limn_kernels_select(isa, family));
    }
}

static void test_selection(void) {
    const uint32_t supported = limn_isa_supported();
    CHECK(supported & LIMN_ISA_SCALAR);
    for (int family = 0; family < 2; family++) {
        CHECK_TEXT(limn_kernels_name(limn_kernels_select(0, (limn_family)family)), "scalar");
        CHECK(limn_kernels_select(LIMN_ISA_SCALAR, (limn_family)family) == scalar_kernels());
        for (uint32_t isa = 1; isa <= LIMN_ISA_NEON; isa <<= 1) {
            const limn_kernels *const kernels = limn_kernels_select(isa, (limn_family)family);
            CHECK(kernels->isa == (supported & isa ? isa : (uint32_t)LIMN_ISA_SCALAR));
            CHECK(family == LIMN_FAMILY_FAST ||
                  limn_kernels_family(kernels) == (limn_family)family);
        }
    }
}

static void test_kernels(made *m, const limn_kernels *kernels, point_kind kind) {
    if (kind == NOT_FINITE) { // the bits of a NaN are the CPU's
        test_not_finite(m, kernels);
        return;
    }
    if (kind != RANDOM) test_fallback(m, kernels, kind != EXTREME);
    if (kind == EQUAL) return;
    if (kind == RANDOM && kernels->family == LIMN_FAMILY_REPRODUCIBLE) {
        test_golden(m, kernels);
        test_golden_plan(m, kernels);
        test_golden_light(m, kernels);
    }
    test_precision(m, kernels, kind == RANDOM);
    test_ranges(m, kernels);
    test_split(m, kernels);
    test_prefix(m, kernels);
    test_normal_stream(m, kernels);
    test_plans(m, kernels);
    if (kind != RANDOM) return;
    test_morphing(m, kernels);
    test_layouts(m, kernels);
    test_streams(m, kernels);
    test_packed_normals(m, kernels);
    test_packed_positions(m, kernels);
}

/// Points that try the arithmetic, which is the same for all domains: with one it takes long enough.
static bool is_of_arithmetic(point_kind kind) {
    return kind == EXTREME || kind == DENORMAL;
}

/// Classes with tables, or in pieces.
static void test_made(limn_domain_kind domain, bool in_pieces, bool fast) {
    static made m;
    state = 12345; // so that golden values do not depend on what was tested before
    make(&m, domain, in_pieces);
    for (int kind = 0; kind < KINDS; kind++) {
        if (domain != LIMN_DOMAIN_TRIANGLE && is_of_arithmetic((point_kind)kind)) continue;
        for (uint32_t c = 0; c < CONTROLS; c++) {
            for (int axis = 0; axis < 3; axis++)
                m.controls[c][axis] = random_coordinate((point_kind)kind);
            for (int axis = 0; axis < 3; axis++)
                m.normals[c][axis] = random_float(-1, 1) + 0.0f;
        }
        m.mesh.origin[1] = kind == RANDOM ? 7.25f : 0;
        for (uint32_t isa = 1; isa <= LIMN_ISA_NEON; isa <<= 1) {
            if (!(limn_isa_supported() & isa)) continue;
            const limn_kernels *const kernels =
                limn_kernels_select(isa, fast ? LIMN_FAMILY_FAST : LIMN_FAMILY_REPRODUCIBLE);
            if (fast && kernels->family != LIMN_FAMILY_FAST) continue; // there are none
            test_kernels(&m, kernels, (point_kind)kind);
        }
    }
    free(m.columns);
    free(m.tables);
    free(m.indices);
    free(m.slots);
}

static bool has_argument(int argc, char **argv, const char *word) {
    for (int a = 1; a < argc; a++) {
        if (strcmp(argv[a], word) == 0) return true;
    }
    return false;
}

/// The reproducible kernels on triangles, or with the argument `quads` on those, so that both can
/// run at a time; with `fast`, the fast kernels.
int main(int argc, char **argv) {
    const bool fast = has_argument(argc, argv, "fast");
    const limn_domain_kind own =
        has_argument(argc, argv, "quads") ? LIMN_DOMAIN_QUAD : LIMN_DOMAIN_TRIANGLE;
    test_selection();
    test_made(own, false, fast);
    test_made(own, true, fast);
    test_refining(fast);
    return check_report();
}
