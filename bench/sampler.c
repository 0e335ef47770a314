/* SPDX-License-Identifier: MIT */
#include "sampler.h"

#include "bench.h"

#include "limn/format.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

enum { COLD_PATCHES = 64, COLD_PASSES = 8 };

const bench_output bench_outputs[BENCH_OUTPUT_COUNT] = {
    [BENCH_POSITION] = {"position", 12, 3, .all_modes = true, .form = {.stride = 12}},
    [BENCH_POSITION_NORMAL] = {"position+normal", 24, 9, .all_modes = true,
                               .form = {.stride = 12, .normal_stride = 12}},
    {"interleaved", 24, 9, .normal_offset = 12, .form = {.stride = 24, .normal_stride = 24}},
    {"packed", 12, 9, .normal_offset = 8,
     .form = {.stride = 12,
              .normal_stride = 12,
              .position_format = LIMN_POSITION_UNORM16X4,
              .normal_format = LIMN_NORMAL_OCT16X2}},
    {"streaming", 12, 3, .form = {.stride = 12, .streaming = true}},
};

// ---- Evaluating

/// Part of the patches of a mix, in the order of a load.
typedef struct span {
    uint32_t first, count;
} span;

static uint32_t patch_at(const bench_load *load, uint32_t position) {
    return load->order ? load->order[position] : position;
}

const limn_file_class *bench_class_of(const bench_mix *mix, uint32_t patch) {
    return &mix->mesh.classes[mix->patch_classes[patch]];
}

static limn_plan plan_of(const bench_load *load, limn_mesh *mesh) {
    *mesh = load->mix->mesh;
    mesh->kernels = load->kernels;
    return limn_plan_uniform(mesh, load->level);
}

/// Where a patch goes that is the `cursor`th in the buffer. An output begins with the first vertex
/// of the plan, which does not exist here.
static limn_output output_at(const bench_sampler *s, const bench_load *load, uint32_t patch,
                             uint32_t cursor) {
    const bench_output *const kind = load->output;
    const uint32_t rows = load->mix->mesh.domain->row_counts[load->level];
    const uintptr_t start = (uintptr_t)s->buffer;
    const uintptr_t vertex = (uintptr_t)rows * cursor - (uintptr_t)rows * patch;
    const uintptr_t normals =
        start + (kind->normal_offset ? kind->normal_offset : s->buffer_size / 2);
    limn_output output = kind->form;
    output.vertices = (void *)(start + vertex * kind->form.stride);
    if (kind->form.normal_stride == 0) return output;
    output.normals = (void *)(normals + vertex * kind->form.normal_stride);
    output.control_normals = load->mix->control_normals;
    return output;
}

/// Evaluates a span into the buffer, from its start again whenever it is full.
static void evaluate_span(const bench_sampler *s, const bench_load *load, const limn_plan *plan,
                          span part) {
    const uint32_t rows = plan->mesh->domain->row_counts[load->level];
    const uint32_t capacity =
        (uint32_t)(s->buffer_size / ((size_t)rows * load->output->vertex_size));
    const uint32_t step = load->order ? 1 : capacity;
    const uint32_t end = part.first + part.count;
    uint32_t cursor = 0;
    for (uint32_t position = part.first; position < end; position += step) {
        const uint32_t patch = patch_at(load, position);
        const uint32_t count = end - position < step ? end - position : step;
        const limn_output output = output_at(s, load, patch, cursor);
        limn_evaluate(plan, plan->mesh->controls, patch, patch + count, &output);
        cursor = cursor + 2 * step <= capacity ? cursor + step : 0;
    }
}

static void count_span(bench_load *load, span part) {
    load->patch_count += part.count;
    for (uint32_t p = part.first; p < part.first + part.count; p++)
        load->control_count += bench_class_of(load->mix, patch_at(load, p))->control_count;
}

double bench_sample_warm(const bench_sampler *s, bench_load *load) {
    limn_mesh mesh;
    const limn_plan plan = plan_of(load, &mesh);
    const span all = {0, plan.patch_count};
    const uint32_t repeats = 1 + 4096 / plan.patch_count;
    uint64_t passes = 0;
    double elapsed;
    count_span(load, all);
    evaluate_span(s, load, &plan, all);
    const double start = bench_thread_seconds();
    do {
        for (uint32_t r = 0; r < repeats; r++)
            evaluate_span(s, load, &plan, all);
        passes += repeats;
        elapsed = bench_thread_seconds() - start;
    } while (elapsed < s->seconds);
    return elapsed / ((double)passes * all.count);
}

// ---- Cold tables

/// Takes memory out of all caches.
static void evict(const void *start, size_t size) {
#ifdef __SSE2__
    for (size_t offset = 0; offset < size; offset += 64)
        _mm_clflush((const char *)start + offset);
    _mm_mfence();
#elif defined(__aarch64__)
    for (size_t offset = 0; offset < size; offset += 64)
        __asm__ volatile("dc civac, %0" : : "r"((const char *)start + offset) : "memory");
    __asm__ volatile("dsb ish" : : : "memory");
#else
    enum { SWEEP = 128 << 20 };
    (void)start, (void)size;
    static unsigned char sweep[SWEEP];
    for (size_t offset = 0; offset < SWEEP; offset += 64)
        ((volatile unsigned char *)sweep)[offset]++;
#endif
}

static void evict_pieces(const limn_mesh *mesh, const limn_file_class *class) {
    const uint16_t *const columns = mesh->columns + class->table_offset / sizeof(uint16_t);
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++) {
        const limn_file_piece *const piece = &mesh->pieces[columns[p]];
        evict(mesh->tables + piece->table_offset / sizeof(float),
              (size_t)limn_file_piece_table_size(piece) * sizeof(float));
    }
    evict(columns, limn_file_columns_size(class) * sizeof *columns);
}

static void evict_class(const limn_mesh *mesh, const limn_file_class *class) {
    if (class->depth == LIMN_FORMAT_PIECE_DEPTH) {
        evict_pieces(mesh, class);
    } else {
        evict(mesh->tables + class->table_offset / sizeof(float),
              (size_t)limn_file_table_size(class) * sizeof(float));
    }
}

static void evict_tables(const bench_load *load, span part) {
    const limn_file_class *last = NULL;
    for (uint32_t p = part.first; p < part.first + part.count; p++) {
        const limn_file_class *const class = bench_class_of(load->mix, patch_at(load, p));
        if (class != last) evict_class(&load->mix->mesh, class);
        last = class;
    }
}

double bench_sample_cold(bench_sampler *s, bench_load *load) {
    limn_mesh mesh;
    const limn_plan plan = plan_of(load, &mesh);
    const uint32_t patches = plan.patch_count;
    const uint32_t count = patches < COLD_PATCHES ? patches : COLD_PATCHES;
    double elapsed = 0;
    for (int pass = 0; pass < COLD_PASSES; pass++) {
        const span part = {bench_random(&s->random, patches - count + 1), count};
        count_span(load, part);
        evaluate_span(s, load, &plan, part);
        evict_tables(load, part);
        const double start = bench_seconds();
        evaluate_span(s, load, &plan, part);
        elapsed += bench_seconds() - start;
    }
    return elapsed / ((double)COLD_PASSES * count);
}
