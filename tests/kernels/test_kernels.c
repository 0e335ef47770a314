/* SPDX-License-Identifier: MIT */
/*
 * The kernels of every instruction set this CPU has, on made-up classes: all ranges of patches, all
 * levels and strides; guard bytes around the output; bit-equal to scalar, and scalar within a bound
 * of a sum in double precision. Links the runtime alone.
 */
#include "../../runtime/checksum.h"
#include "../../runtime/kernels.h"
#include "../check.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { PATCHES = 3, CONTROLS = 600, STRIDE_MAX = 36, GUARD = 64 };

static const uint32_t control_counts[] = {1, 3, 12, 24, 25, 67, 256, 257, 400};
enum { CLASSES = sizeof control_counts / sizeof *control_counts };

typedef enum point_kind { RANDOM, EXTREME, DENORMAL, KINDS } point_kind;

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
    default:
        return random_float(-10, 10);
    }
}

/// A mesh of one run per class, without a file around it.
typedef struct made {
    limn_mesh mesh;
    limn_file_run runs[CLASSES];
    limn_file_class classes[CLASSES];
    float *tables;
    uint32_t *indices;
    uint8_t *slots;
    float controls[CONTROLS][3];
    float normals[CONTROLS][3]; ///< of the control points: any vectors will do
    limn_file_normal none; ///< a mesh with normals has a pointer to these; evaluation reads none
} made;

/// Coefficients of a class: rows of different support, so that both ways to sum occur in one class.
static void fill_table(float *table, uint32_t control_count) {
    for (uint32_t row = 0; row < 160; row++) {
        const uint32_t support = 1 + next_random() % control_count;
        for (uint32_t slot = 0; slot < control_count; slot++) {
            const bool used = row < 153 && next_random() % control_count < support;
            table[slot * 160 + row] = used ? random_float(0, 2.0f / (float)control_count) : 0;
        }
    }
}

/// Ascending control indices and a random permutation of the slots.
static void fill_patch(uint32_t control_count, uint32_t *indices, uint16_t *slots) {
    const uint32_t spread = CONTROLS / control_count;
    for (uint32_t k = 0; k < control_count; k++) {
        indices[k] = k * spread + next_random() % spread;
        const uint32_t other = next_random() % (k + 1);
        slots[k] = slots[other];
        slots[other] = (uint16_t)k;
    }
}

static void fill_run(made *m, uint32_t c, uint64_t first_index, uint64_t first_slot) {
    const uint32_t control_count = control_counts[c];
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

static void make(made *m) {
    uint64_t total = 0, index = 0, slot = 0;
    for (uint32_t c = 0; c < CLASSES; c++)
        total += control_counts[c];
    m->tables = aligned_alloc(64, 3 * total * 160 * sizeof(float));
    m->indices = malloc(total * PATCHES * sizeof(uint32_t));
    m->slots = malloc(total * PATCHES * 2 + CLASSES);
    uint64_t table = 0;
    for (uint32_t c = 0; c < CLASSES; c++) {
        slot += slot % 2;
        m->classes[c] = (limn_file_class){.table_offset = table * sizeof(float),
                                          .control_count = control_counts[c],
                                          .table_count = 3,
                                          .depth = LIMN_LEVEL_MAX};
        m->runs[c] = (limn_file_run){.class_index = c,
                                     .first_patch = c * PATCHES,
                                     .patch_count = PATCHES,
                                     .first_index = index,
                                     .first_slot = slot};
        for (uint32_t t = 0; t < 3; t++)
            fill_table(m->tables + table + (uint64_t)t * control_counts[c] * 160,
                       control_counts[c]);
        fill_run(m, c, index, slot);
        table += (uint64_t)control_counts[c] * 3 * 160;
        index += (uint64_t)control_counts[c] * PATCHES;
        slot += (uint64_t)control_counts[c] * PATCHES * limn_file_slot_size(&m->classes[c]);
    }
    m->mesh = (limn_mesh){.domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE),
                          .control_count = CONTROLS,
                          .patch_count = CLASSES * PATCHES,
                          .run_count = CLASSES,
                          .indices = m->indices,
                          .slots = m->slots,
                          .tables = m->tables,
                          .runs = m->runs,
                          .classes = m->classes,
                          .normals = &m->none};
}

/// Evaluates a range into a buffer with guards and checks that nothing else was written. Returns
/// the size of what was written or guarded.
static size_t evaluate(made *m, const limn_kernels *kernels, uint32_t level, uint32_t stride,
                       uint32_t begin, uint32_t end, unsigned char *buffer) {
    m->mesh.kernels = kernels;
    const limn_plan plan = limn_plan_uniform(&m->mesh, level);
    const size_t size = (size_t)plan.vertex_count * stride;
    memset(buffer, 0xa5, size + 2 * GUARD);
    limn_output output = {.vertices = buffer + GUARD, .stride = stride};
    const size_t written = stride >= 24 ? 24 : 12; // with room for them, normals
    if (written == 24) {
        output.normals = buffer + GUARD + 12;
        output.normal_stride = stride;
        output.control_normals = m->normals[0];
    }
    limn_evaluate(&plan, m->controls[0], begin, end, &output);

    const size_t row_count = plan.mesh->domain->row_counts[level];
    const size_t first = begin * row_count, last = end * row_count;
    bool untouched = true;
    for (size_t b = 0; b < size + 2 * GUARD; b++) {
        const bool inside = b >= GUARD + first * stride && b < GUARD + last * stride;
        if (inside && (b - GUARD) % stride < written) continue;
        untouched &= buffer[b] == 0xa5;
    }
    CHECK(untouched);
    return size + 2 * GUARD;
}

static unsigned char expected[CLASSES * PATCHES * 153 * STRIDE_MAX + 2 * GUARD];
static unsigned char actual[sizeof expected];

static const limn_kernels *scalar_kernels(void) {
    return limn_kernels_select(LIMN_ISA_SCALAR, LIMN_FAMILY_REPRODUCIBLE);
}

/// The reproducible kernels give the bits of the scalar ones; the fast ones must at least write
/// where they should.
static void test_ranges(made *m, const limn_kernels *kernels) {
    static const uint32_t strides[] = {12, 16, STRIDE_MAX};
    const uint32_t patch_count = m->mesh.patch_count;
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        for (int s = 0; s < 3; s++) {
            for (uint32_t begin = 0; begin <= patch_count; begin += 1 + next_random() % 9) {
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
                const size_t finest = v / row_count * 153 + v % row_count;
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

/// A bound for a sum of n rounded products, or of a compensated one, relative to the sum of
/// absolute values, plus the rounding of the origin.
static double bound(uint32_t terms, double magnitude, double result) {
    const double unit = FLT_EPSILON / 2;
    const double roundings = terms > LIMNI_PLAIN_TERMS ? 4 : terms + 1.0;
    return unit * (roundings * magnitude + 2 * fabs(result)) + 150 * (double)FLT_TRUE_MIN;
}

static void check_row(const made *m, uint32_t c, uint32_t patch, uint32_t row,
                      const float *vertex) {
    const limn_file_run *const run = &m->runs[c];
    const uint32_t control_count = control_counts[c];
    const float *const table = m->tables + m->classes[c].table_offset / sizeof(float);
    for (int axis = 0; axis < 3; axis++) {
        double sum = 0, magnitude = 0;
        uint32_t terms = 0;
        for (uint32_t k = 0; k < control_count; k++) {
            const size_t at = (size_t)patch * control_count + k;
            uint16_t slot = m->slots[run->first_slot + at];
            if (control_count > LIMN_FORMAT_NARROW_SLOTS)
                memcpy(&slot, m->slots + run->first_slot + 2 * at, 2);
            const double coefficient = table[(size_t)slot * 160 + row];
            const float point = m->controls[m->indices[run->first_index + at]][axis];
            const double relative =
                point - m->mesh.origin[axis]; // rounded to float, like the kernel's
            sum += coefficient * relative;
            magnitude += coefficient * fabs(relative);
            terms += coefficient != 0;
        }
        const double result = sum + m->mesh.origin[axis];
        CHECK_NEAR(vertex[axis], result, bound(terms, magnitude, result));
    }
}

static void test_precision(made *m, const limn_kernels *kernels) {
    m->mesh.kernels = kernels;
    const limn_plan plan = limn_plan_uniform(&m->mesh, LIMN_LEVEL_MAX);
    limn_evaluate(&plan, m->controls[0], 0, plan.patch_count, &(limn_output){.vertices = actual});
    for (uint32_t c = 0; c < CLASSES; c++) {
        for (uint32_t patch = 0; patch < PATCHES; patch++) {
            for (uint32_t row = 0; row < 153; row++) {
                const size_t vertex = ((size_t)c * PATCHES + patch) * 153 + row;
                check_row(m, c, patch, row, (const float *)(const void *)(actual + 12 * vertex));
            }
        }
    }
}

/// The bits of a whole evaluation at every level: the same from all reproducible kernels, whatever
/// the compiler and its flags. If this changes, results change for everybody.
static void test_golden(made *m, const limn_kernels *kernels) {
    static const uint64_t golden[LIMN_LEVEL_COUNT] = {0xb4f9a3bed2503751u, 0x9989404106379bb6u,
                                                      0x62a3a01d8336f8f2u, 0x26878e699788b882u,
                                                      0x4feb16fd010b8767u};
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

/// Normals in a stream of their own are those inside the vertices; corners have the control
/// points'.
static void test_normal_stream(made *m, const limn_kernels *kernels) {
    static float normals[CLASSES * PATCHES * 153][3];
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
            if (control_counts[patch / PATCHES] < 3) continue;
            limn_mesh_corners(&m->mesh, patch, corners);
            for (uint32_t c = 0; c < 3; c++)
                CHECK(memcmp(normals[limn_plan_first_vertex(&plan, patch) + c],
                             m->normals[corners[c]], 12) == 0);
        }
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
    test_precision(m, kernels);
    if (kind == RANDOM && kernels->family == LIMN_FAMILY_REPRODUCIBLE) test_golden(m, kernels);
    test_ranges(m, kernels);
    test_split(m, kernels);
    test_prefix(m, kernels);
    test_normal_stream(m, kernels);
}

int main(void) {
    static made m;
    make(&m);
    test_selection();
    for (int kind = 0; kind < KINDS; kind++) {
        for (uint32_t c = 0; c < CONTROLS; c++) {
            for (int axis = 0; axis < 3; axis++)
                m.controls[c][axis] = random_coordinate((point_kind)kind);
            for (int axis = 0; axis < 3; axis++)
                m.normals[c][axis] = random_float(-1, 1) + 0.0f;
        }
        m.mesh.origin[1] = kind == RANDOM ? 7.25f : 0;
        for (uint32_t isa = 1; isa <= LIMN_ISA_NEON; isa <<= 1) {
            if (!(limn_isa_supported() & isa)) continue;
            test_kernels(&m, limn_kernels_select(isa, LIMN_FAMILY_REPRODUCIBLE), (point_kind)kind);
            test_kernels(&m, limn_kernels_select(isa, LIMN_FAMILY_FAST), (point_kind)kind);
        }
    }
    free(m.tables);
    free(m.indices);
    free(m.slots);
    return check_report();
}
