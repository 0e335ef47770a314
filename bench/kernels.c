/* SPDX-License-Identifier: MIT */
/*
 * limn-bench kernels: what a patch costs with every instruction set, family, level and output, and
 * how much of what this core can do at most that is. Everything is measured in turn, round after
 * round, in one process.
 */
#include "arguments.h"
#include "bench.h"

#include "mixes.h"
#include "peak.h"

#include "limn/format.h"
#include "limn/limn.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: limn-bench kernels [OPTIONS] [MESH...]\n\n"
    "Evaluates a regular torus, the same torus with edges flipped at random (\"worst\":\n"
    "neighbours rarely share a class) and every MESH (.obj, .off: baked first; .limn: its\n"
    "first mesh), all variants and outputs in turn, and prints medians:\n\n"
    "  ns per patch   by level 0 to 4\n"
    "  % of peak      multiply-adds, rows x control points x 3, or x 9 with normals, beside\n"
    "                 what this core does at most between registers: fused for the fast family,\n"
    "                 else multiply, then add. It can exceed 100: classes that are their own\n"
    "                 mirror images are summed with less work than is counted here\n"
    "  Mvertices/s    at level 4\n"
    "  % of stores    bytes written at level 4 beside plain forward stores into the same buffer\n\n"
    "  class          ranges of as many patches as the buffer holds, in file order\n"
    "  shuffled       ranges of one patch in random order: with one call per patch, and control\n"
    "                 points, indices and tables from anywhere\n"
    "  warm           the whole mesh, again and again\n"
    "  cold           64 patches, after their tables, but nothing else, were taken out of the\n"
    "                 caches\n\n"
    "Vertices go to a small buffer that is used again and again, as a mapped ring buffer would\n"
    "be. Outputs, and bytes per vertex:\n\n"
    "  position         12: floats\n"
    "  position+normal  24: floats, in two streams, a half of the buffer each\n"
    "  interleaved      24: floats, the normal behind the position\n"
    "  packed           12: UNORM16X4, and OCT16X2 behind it\n"
    "  streaming        12: floats, past the caches; the stores beside are not\n\n"
    "All but the first two are measured only by class and warm. A .limn file without normals has\n"
    "only outputs without.\n\n"
    "  --isa LIST     scalar,sse2,avx2,neon: only these\n"
    "  --output LIST  only these outputs\n"
    "  --all          all outputs shuffled and cold too\n"
    "  --rounds N     samples of each figure (default 25)\n"
    "  --quick        3 rounds of short samples\n"
    "  --buffer KIB   size of the buffer (default 64)\n"
    "  --csv FILE     writes all figures, of all levels\n";

enum {
    VARIANT_MAX = 8,
    TORUS_SIDE = 64,
    COLD_PATCHES = 64,
    COLD_PASSES = 8,
    ROUND_MAX = 1000,
    MODE_COUNT = 4 ///< class order or shuffled, warm or cold
};

typedef struct options {
    uint32_t isa_mask;
    uint32_t output_mask; ///< bit o: outputs[o]
    bool all_modes;
    uint32_t rounds;
    double sample_seconds;
    size_t buffer_size; ///< a multiple of 4096
    const char *csv;
} options;

/// What is written. A further output is one entry.
static const struct output_kind {
    const char *name;
    uint32_t vertex_size;   ///< bytes
    uint32_t sums;          ///< multiply-adds per row and control point
    bool all_modes;         ///< else only in class order and warm
    uint32_t normal_offset; ///< of the normal in its vertex; 0: normals have half of the buffer
    limn_output form;       ///< without addresses; normal_stride 0: no normals
} outputs[] = {
    {"position", 12, 3, .all_modes = true, .form = {.stride = 12}},
    {"position+normal", 24, 9, .all_modes = true, .form = {.stride = 12, .normal_stride = 12}},
    {"interleaved", 24, 9, .normal_offset = 12, .form = {.stride = 24, .normal_stride = 24}},
    {"packed", 12, 9, .normal_offset = 8,
     .form = {.stride = 12,
              .normal_stride = 12,
              .position_format = LIMN_POSITION_UNORM16X4,
              .normal_format = LIMN_NORMAL_OCT16X2}},
    {"streaming", 12, 3, .form = {.stride = 12, .streaming = true}},
};

enum { OUTPUT_COUNT = sizeof outputs / sizeof *outputs };

typedef struct variant {
    const limn_kernels *kernels;
    const bench_peak *peak;
    double compute_rate, store_rate; ///< the peaks a moment ago
} variant;

typedef struct mix {
    bench_mix base;
    uint32_t *shuffled; ///< [patch_count]
} mix;

/// What a patch takes: seconds, and the multiply-adds and bytes that would fit into them at the
/// peaks that were measured just before. The CPU is rarely alone, and not always as fast.
typedef struct cost {
    double seconds, multiply_adds, bytes;
} cost;

/// One figure.
typedef struct cell {
    variant *variant;
    const mix *mix;
    const struct output_kind *output;
    uint32_t level;
    bool is_shuffled, is_cold;
    double patch_count, control_count; ///< of all samples
    cost *samples;                     ///< [rounds]
    cost median;
} cell;

typedef struct session {
    options options;
    unsigned char *buffer;
    uint64_t random;
    variant variants[VARIANT_MAX];
    uint32_t variant_count, mix_count, cell_count;
    mix *mixes;
    cell *cells;
} session;

// -------------------------------------------------------------------------------------------------
// Measuring

/// Part of the patches of a mix, in the order of a cell.
typedef struct span {
    uint32_t first, count;
} span;

static uint32_t patch_at(const cell *c, uint32_t position) {
    return c->is_shuffled ? c->mix->shuffled[position] : position;
}

static const limn_file_class *class_of(const cell *c, uint32_t position) {
    const bench_mix *const base = &c->mix->base;
    return &base->mesh.classes[base->patch_classes[patch_at(c, position)]];
}

/// Where a patch goes that is the `cursor`th in the buffer. An output begins with the first vertex
/// of the plan, which does not exist here.
static limn_output output_at(const session *s, const cell *c, uint32_t patch, uint32_t cursor) {
    const struct output_kind *const kind = c->output;
    const uint32_t rows = c->mix->base.mesh.domain->row_counts[c->level];
    const uintptr_t start = (uintptr_t)s->buffer;
    const uintptr_t vertex = (uintptr_t)rows * cursor - (uintptr_t)rows * patch;
    const uintptr_t normals =
        start + (kind->normal_offset ? kind->normal_offset : s->options.buffer_size / 2);
    limn_output output = kind->form;
    output.vertices = (void *)(start + vertex * kind->form.stride);
    if (kind->form.normal_stride == 0) return output;
    output.normals = (void *)(normals + vertex * kind->form.normal_stride);
    output.control_normals = c->mix->base.control_normals;
    return output;
}

/// Evaluates a span into the buffer, from its start again whenever it is full.
static void evaluate_span(const session *s, const cell *c, const limn_plan *plan, span part) {
    const uint32_t rows = plan->mesh->domain->row_counts[c->level];
    const uint32_t capacity =
        (uint32_t)(s->options.buffer_size / ((size_t)rows * c->output->vertex_size));
    const uint32_t step = c->is_shuffled ? 1 : capacity;
    const uint32_t end = part.first + part.count;
    uint32_t cursor = 0;
    for (uint32_t position = part.first; position < end; position += step) {
        const uint32_t patch = patch_at(c, position);
        const uint32_t count = end - position < step ? end - position : step;
        const limn_output output = output_at(s, c, patch, cursor);
        limn_evaluate(plan, plan->mesh->controls, patch, patch + count, &output);
        cursor = cursor + 2 * step <= capacity ? cursor + step : 0;
    }
}

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

static void evict_tables(const cell *c, span part) {
    const limn_mesh *const mesh = &c->mix->base.mesh;
    const limn_file_class *last = NULL;
    for (uint32_t p = part.first; p < part.first + part.count; p++) {
        const limn_file_class *const class = class_of(c, p);
        if (class != last)
            evict(mesh->tables + class->table_offset / sizeof(float),
                  (size_t)limn_file_table_size(class) * sizeof(float));
        last = class;
    }
}

static void count_span(cell *c, span part) {
    c->patch_count += part.count;
    for (uint32_t p = part.first; p < part.first + part.count; p++)
        c->control_count += class_of(c, p)->control_count;
}

static double sample_warm(const session *s, cell *c, const limn_plan *plan) {
    const span all = {0, plan->patch_count};
    const uint32_t repeats = 1 + 4096 / plan->patch_count;
    uint64_t passes = 0;
    double elapsed;
    count_span(c, all);
    evaluate_span(s, c, plan, all);
    const double start = bench_seconds();
    do {
        for (uint32_t r = 0; r < repeats; r++)
            evaluate_span(s, c, plan, all);
        passes += repeats;
        elapsed = bench_seconds() - start;
    } while (elapsed < s->options.sample_seconds);
    return elapsed / ((double)passes * all.count);
}

static double sample_cold(session *s, cell *c, const limn_plan *plan) {
    const uint32_t patches = plan->patch_count;
    const uint32_t count = patches < COLD_PATCHES ? patches : COLD_PATCHES;
    double elapsed = 0;
    for (int pass = 0; pass < COLD_PASSES; pass++) {
        const span part = {bench_random(&s->random, patches - count + 1), count};
        count_span(c, part);
        evaluate_span(s, c, plan, part);
        evict_tables(c, part);
        const double start = bench_seconds();
        evaluate_span(s, c, plan, part);
        elapsed += bench_seconds() - start;
    }
    return elapsed / ((double)COLD_PASSES * count);
}

static void measure_peaks(const session *s, variant *v) {
    const double seconds = s->options.sample_seconds / 4;
    v->compute_rate = bench_peak_compute(v->peak, seconds);
    v->store_rate =
        bench_peak_store(v->peak, (float *)(void *)s->buffer, s->options.buffer_size, seconds);
}

static void measure_cell(session *s, cell *c, uint32_t round) {
    limn_mesh mesh = c->mix->base.mesh;
    mesh.kernels = c->variant->kernels;
    const limn_plan plan = limn_plan_uniform(&mesh, c->level);
    if (c->level == 0) measure_peaks(s, c->variant);
    const double seconds = c->is_cold ? sample_cold(s, c, &plan) : sample_warm(s, c, &plan);
    c->samples[round] = (cost){.seconds = seconds,
                               .multiply_adds = seconds * c->variant->compute_rate,
                               .bytes = seconds * c->variant->store_rate};
}

static double median_of(const cell *c, size_t offset, uint32_t rounds) {
    double values[ROUND_MAX];
    for (uint32_t round = 0; round < rounds; round++)
        memcpy(&values[round], (const char *)&c->samples[round] + offset, sizeof *values);
    return bench_median(values, rounds);
}

static void measure(session *s) {
    const uint32_t rounds = s->options.rounds;
    for (uint32_t round = 0; round < rounds; round++) {
        for (uint32_t c = 0; c < s->cell_count; c++)
            measure_cell(s, &s->cells[c], round);
    }
    for (uint32_t i = 0; i < s->cell_count; i++) {
        cell *const c = &s->cells[i];
        c->median = (cost){.seconds = median_of(c, offsetof(cost, seconds), rounds),
                           .multiply_adds = median_of(c, offsetof(cost, multiply_adds), rounds),
                           .bytes = median_of(c, offsetof(cost, bytes), rounds)};
    }
}

// -------------------------------------------------------------------------------------------------
// Printing

static const char *family_name(const limn_kernels *kernels) {
    return limn_kernels_family(kernels) == LIMN_FAMILY_FAST ? "fast" : "reproducible";
}

/// Whether the mesh has what an output needs.
static bool is_possible(const mix *m, const struct output_kind *output) {
    return output->form.normal_stride == 0 || m->base.control_normals;
}

static double rows_of(const cell *c) {
    return c->mix->base.mesh.domain->row_counts[c->level];
}

static double compute_share(const cell *c) {
    const double controls = c->control_count / c->patch_count;
    return rows_of(c) * c->output->sums * controls / c->median.multiply_adds;
}

static double store_share(const cell *c) {
    return rows_of(c) * c->output->vertex_size / c->median.bytes;
}

static const cell *first_cell_of(const session *s, const variant *v) {
    for (uint32_t c = 0; c < s->cell_count; c++) {
        if (s->cells[c].variant == v) return &s->cells[c];
    }
    return NULL;
}

/// The peaks, as they were while the first row of this variant was measured.
static void print_peaks(const session *s) {
    printf("\n%-6s %-12s %18s %14s\n", "isa", "family", "multiply-adds G/s", "stores GB/s");
    for (uint32_t v = 0; v < s->variant_count; v++) {
        const cell *const c = first_cell_of(s, &s->variants[v]);
        if (!c) continue;
        printf("%-6s %-12s %18.1f %14.1f\n", limn_kernels_name(c->variant->kernels),
               family_name(c->variant->kernels), c->median.multiply_adds / c->median.seconds / 1e9,
               c->median.bytes / c->median.seconds / 1e9);
    }
}

/// `cells` has one cell per level.
static void print_row(const cell *cells) {
    const cell *const finest = &cells[LIMN_LEVEL_MAX];
    printf("%-6s %-12s %-8s %-4s", limn_kernels_name(finest->variant->kernels),
           family_name(finest->variant->kernels), finest->is_shuffled ? "shuffled" : "class",
           finest->is_cold ? "cold" : "warm");
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        printf(" %7.1f", cells[level].median.seconds * 1e9);
    printf("  ");
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        printf(" %5.1f", 100 * compute_share(&cells[level]));
    printf("  %11.0f %11.1f\n", rows_of(finest) / finest->median.seconds / 1e6,
           100 * store_share(finest));
}

static void print_mix(const session *s, const mix *m, const struct output_kind *output) {
    if (!is_possible(m, output)) {
        printf("\n%s, %s: the file has no normals\n", m->base.name, output->name);
        return;
    }
    double controls = 0;
    for (uint32_t p = 0; p < m->base.mesh.patch_count; p++)
        controls += m->base.mesh.classes[m->base.patch_classes[p]].control_count;
    printf("\n%s, %s: %u patches, %u classes, %.2f control points per patch\n", m->base.name,
           output->name, m->base.mesh.patch_count, m->base.mesh.run_count,
           controls / m->base.mesh.patch_count);
    printf("%-6s %-12s %-8s %-4s %39s   %29s  %11s %11s\n", "isa", "family", "order", "",
           "ns per patch, level 0 to 4", "% of peak, level 0 to 4", "Mvertices/s", "% of stores");
    for (uint32_t c = 0; c < s->cell_count; c += LIMN_LEVEL_COUNT) {
        if (s->cells[c].mix == m && s->cells[c].output == output) print_row(&s->cells[c]);
    }
}

static void write_csv(const session *s, FILE *file) {
    fprintf(file, "# ");
    bench_print_conditions(file);
    fprintf(file, "mesh,output,isa,family,order,tables,level,ns_per_patch,vertices_per_second,"
                  "peak_multiply_adds_per_second,peak_share,peak_stored_bytes_per_second,"
                  "store_share\n");
    for (uint32_t i = 0; i < s->cell_count; i++) {
        const cell *const c = &s->cells[i];
        const limn_kernels *const kernels = c->variant->kernels;
        fprintf(file, "%s,%s,%s,%s,%s,%s,%u,%.3f,%.4g,%.4g,%.4f,%.4g,%.4f\n", c->mix->base.name,
                c->output->name, limn_kernels_name(kernels), family_name(kernels),
                c->is_shuffled ? "shuffled" : "class", c->is_cold ? "cold" : "warm", c->level,
                c->median.seconds * 1e9, rows_of(c) / c->median.seconds,
                c->median.multiply_adds / c->median.seconds, compute_share(c),
                c->median.bytes / c->median.seconds, store_share(c));
    }
}

// -------------------------------------------------------------------------------------------------
// Setting up

static void *allocate(size_t count, size_t size) {
    void *const memory = calloc(count, size);
    if (memory) return memory;
    fprintf(stderr, "limn-bench: out of memory\n");
    exit(1);
}

static void add_variants(session *s) {
    const uint32_t mask = limn_isa_supported() & s->options.isa_mask;
    for (uint32_t isa = 1; isa <= LIMN_ISA_NEON; isa *= 2) {
        for (int f = LIMN_FAMILY_REPRODUCIBLE; f <= LIMN_FAMILY_FAST; f++) {
            const limn_family family = (limn_family)f;
            const limn_kernels *const kernels = limn_kernels_select(isa, family);
            const bench_peak *const peak = bench_peak_find((limn_isa)isa, family);
            if (!(mask & isa) || !peak || limn_kernels_family(kernels) != family) continue;
            s->variants[s->variant_count++] = (variant){.kernels = kernels, .peak = peak};
        }
    }
}

static void shuffle(mix *m) {
    const uint32_t count = m->base.mesh.patch_count;
    uint64_t state = 1;
    m->shuffled = allocate(count, sizeof *m->shuffled);
    for (uint32_t p = 0; p < count; p++) {
        const uint32_t other = bench_random(&state, p + 1);
        m->shuffled[p] = m->shuffled[other];
        m->shuffled[other] = p;
    }
}

static bool add_mixes(session *s, char **paths, int path_count) {
    s->mixes = allocate((size_t)path_count + 2, sizeof *s->mixes);
    bool good = bench_mix_regular(&s->mixes[s->mix_count++].base, TORUS_SIDE);
    good = good && bench_mix_worst(&s->mixes[s->mix_count++].base, TORUS_SIDE);
    for (int p = 0; p < path_count && good; p++)
        good = bench_mix_file(&s->mixes[s->mix_count++].base, paths[p]);
    for (uint32_t m = 0; m < s->mix_count && good; m++)
        shuffle(&s->mixes[m]);
    return good;
}

/// All levels of a row of the table, one after the other.
static void add_levels(session *s, const mix *m, const struct output_kind *output, variant *v,
                       int mode) {
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        s->cells[s->cell_count++] = (cell){
            .variant = v,
            .mix = m,
            .output = output,
            .level = level,
            .is_shuffled = mode & 1,
            .is_cold = mode & 2,
            .samples = allocate(s->options.rounds, sizeof(cost)),
        };
    }
}

/// All rows of one part of the table.
static void add_rows(session *s, const mix *m, const struct output_kind *output) {
    const int modes = output->all_modes || s->options.all_modes ? MODE_COUNT : 1;
    if (!is_possible(m, output)) return;
    for (uint32_t v = 0; v < s->variant_count; v++) {
        for (int mode = 0; mode < modes; mode++)
            add_levels(s, m, output, &s->variants[v], mode);
    }
}

static void add_cells(session *s) {
    s->cells = allocate((size_t)s->mix_count * OUTPUT_COUNT * s->variant_count * MODE_COUNT *
                            LIMN_LEVEL_COUNT,
                        sizeof *s->cells);
    for (uint32_t m = 0; m < s->mix_count; m++) {
        for (int o = 0; o < OUTPUT_COUNT; o++) {
            if (s->options.output_mask >> o & 1) add_rows(s, &s->mixes[m], &outputs[o]);
        }
    }
}

static void destroy(session *s) {
    for (uint32_t c = 0; c < s->cell_count; c++)
        free(s->cells[c].samples);
    for (uint32_t m = 0; m < s->mix_count; m++) {
        bench_mix_destroy(&s->mixes[m].base);
        free(s->mixes[m].shuffled);
    }
    free(s->cells);
    free(s->mixes);
    free(s->buffer);
}

/// csv  NULL: none
static bool run(session *s, char **paths, int path_count, FILE *csv) {
    s->buffer = aligned_alloc(4096, s->options.buffer_size);
    add_variants(s);
    if (!s->buffer || s->variant_count == 0) {
        fprintf(stderr, "limn-bench: this CPU has none of these instruction sets\n");
        return false;
    }
    if (!add_mixes(s, paths, path_count)) return false;
    add_cells(s);
    measure(s);
    bench_print_conditions(stdout);
    printf("%u rounds; vertices go to a buffer of %zu KiB\n", s->options.rounds,
           s->options.buffer_size / 1024);
    print_peaks(s);
    for (uint32_t m = 0; m < s->mix_count; m++) {
        for (int o = 0; o < OUTPUT_COUNT; o++) {
            if (s->options.output_mask >> o & 1) print_mix(s, &s->mixes[m], &outputs[o]);
        }
    }
    if (csv) write_csv(s, csv);
    return true;
}

/// The name of a bit in an option's list; NULL behind the last.
typedef const char *bit_name(uint32_t bit);

static const char *isa_name(uint32_t bit) {
    static const char *const names[] = {"scalar", "sse2", "avx2", "neon"};
    return bit < sizeof names / sizeof *names ? names[bit] : NULL;
}

static const char *output_name(uint32_t bit) {
    return bit < OUTPUT_COUNT ? outputs[bit].name : NULL;
}

/// The bits that a list names; 0 if a name is not known.
static uint32_t parse_list(const char *list, bit_name *name_of) {
    uint32_t mask = 0;
    for (const char *name = list; *name;) {
        const size_t length = strcspn(name, ",");
        uint32_t bit = 0;
        while (name_of(bit) &&
               (strlen(name_of(bit)) != length || strncmp(name, name_of(bit), length) != 0))
            bit++;
        if (!name_of(bit)) return 0;
        mask |= 1u << bit;
        name += length + (name[length] == ',');
    }
    return mask;
}

static bool parse_option(int option, void *parsed) {
    options *const to = parsed;
    uint32_t kib;
    switch (option) {
    case 'i':
        to->isa_mask = parse_list(optarg, isa_name);
        return to->isa_mask != 0;
    case 'o':
        to->output_mask = parse_list(optarg, output_name);
        return to->output_mask != 0;
    case 'a':
        to->all_modes = true;
        return true;
    case 'r':
        return bench_parse_range(optarg, 1, ROUND_MAX, &to->rounds);
    case 'q':
        to->rounds = 3;
        to->sample_seconds = 3e-4;
        return true;
    case 'b':
        if (!bench_parse_range(optarg, 4, 1 << 20, &kib) || kib % 4 != 0) return false;
        to->buffer_size = 1024 * (size_t)kib;
        return true;
    case 'c':
        to->csv = optarg;
        return true;
    default:
        return false;
    }
}

int bench_kernels(int argc, char **argv) {
    static const struct option names[] = {{"isa", required_argument, NULL, 'i'},
                                          {"output", required_argument, NULL, 'o'},
                                          {"all", no_argument, NULL, 'a'},
                                          {"rounds", required_argument, NULL, 'r'},
                                          {"quick", no_argument, NULL, 'q'},
                                          {"csv", required_argument, NULL, 'c'},
                                          {"buffer", required_argument, NULL, 'b'},
                                          {"help", no_argument, NULL, 'h'},
                                          {0}};
    session s = {.options = {.isa_mask = LIMN_ISA_ALL,
                             .output_mask = (1u << OUTPUT_COUNT) - 1,
                             .rounds = 25,
                             .sample_seconds = 1e-3,
                             .buffer_size = 64 * 1024}};
    const int status = bench_read_options(argc, argv, help, names, parse_option, &s.options);
    if (status >= 0) return status;
    limni_output_file csv;
    if (!bench_results_open(&csv, s.options.csv)) return 1;
    const bool good = run(&s, argv + optind, argc - optind, csv.stream);
    destroy(&s);
    return bench_results_close(&csv, s.options.csv, good) ? 0 : 1;
}
