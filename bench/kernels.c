/* SPDX-License-Identifier: MIT */
/*
 * limn-bench kernels: what a patch costs with every instruction set, family, level and output, and
 * how much of what this core can do at most that is. Everything is measured in turn, round after
 * round, in one process.
 */
#include "arguments.h"
#include "bench.h"

#include "peak.h"
#include "sampler.h"

#include "limn/format.h"
#include "limn/limn.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: limn-bench kernels [OPTIONS] [MESH...]\n\n"
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
    "Options:\n"
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
    ROUND_MAX = 1000,
    MODE_COUNT = 4 ///< class order or shuffled, warm or cold
};

typedef struct options {
    uint32_t isa_mask;
    uint32_t output_mask; ///< bit o: bench_outputs[o]
    bool all_modes;
    uint32_t rounds;
    const char *csv;
} options;

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
    bench_load load;
    bool is_cold;
    cost *samples; ///< [rounds]
    cost median;
} cell;

typedef struct session {
    options options;
    bench_sampler sampler;
    variant variants[VARIANT_MAX];
    uint32_t variant_count, mix_count, cell_count;
    mix *mixes;
    cell *cells;
} session;

// -------------------------------------------------------------------------------------------------
// Measuring

static void measure_peaks(const session *s, variant *v) {
    const bench_sampler *const sampler = &s->sampler;
    const double seconds = sampler->seconds / 4;
    v->compute_rate = bench_peak_compute(v->peak, seconds);
    v->store_rate =
        bench_peak_store(v->peak, (float *)(void *)sampler->buffer, sampler->buffer_size, seconds);
}

static void measure_cell(session *s, cell *c, uint32_t round) {
    if (c->load.level == 0) measure_peaks(s, c->variant);
    const double seconds = c->is_cold ? bench_sample_cold(&s->sampler, &c->load)
                                      : bench_sample_warm(&s->sampler, &c->load);
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
static bool is_possible(const mix *m, const bench_output *output) {
    return output->form.normal_stride == 0 || m->base.control_normals;
}

static double rows_of(const cell *c) {
    return c->load.mix->mesh.domain->row_counts[c->load.level];
}

static double compute_share(const cell *c) {
    const double controls = c->load.control_count / c->load.patch_count;
    return rows_of(c) * c->load.output->sums * controls / c->median.multiply_adds;
}

static double store_share(const cell *c) {
    return rows_of(c) * c->load.output->vertex_size / c->median.bytes;
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
           family_name(finest->variant->kernels), finest->load.order ? "shuffled" : "class",
           finest->is_cold ? "cold" : "warm");
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        printf(" %7.1f", cells[level].median.seconds * 1e9);
    printf("  ");
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        printf(" %5.1f", 100 * compute_share(&cells[level]));
    printf("  %11.0f %11.1f\n", rows_of(finest) / finest->median.seconds / 1e6,
           100 * store_share(finest));
}

static void print_mix(const session *s, const mix *m, const bench_output *output) {
    if (!is_possible(m, output)) {
        printf("\n%s, %s: the file has no normals\n", m->base.name, output->name);
        return;
    }
    double controls = 0;
    for (uint32_t p = 0; p < m->base.mesh.patch_count; p++)
        controls += bench_class_of(&m->base, p)->control_count;
    printf("\n%s, %s: %u patches, %u classes, %.2f control points per patch\n", m->base.name,
           output->name, m->base.mesh.patch_count, m->base.mesh.run_count,
           controls / m->base.mesh.patch_count);
    printf("%-6s %-12s %-8s %-4s %39s   %29s  %11s %11s\n", "isa", "family", "order", "",
           "ns per patch, level 0 to 4", "% of peak, level 0 to 4", "Mvertices/s", "% of stores");
    for (uint32_t c = 0; c < s->cell_count; c += LIMN_LEVEL_COUNT) {
        if (s->cells[c].load.mix == &m->base && s->cells[c].load.output == output)
            print_row(&s->cells[c]);
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
        fprintf(file, "%s,%s,%s,%s,%s,%s,%u,%.3f,%.4g,%.4g,%.4f,%.4g,%.4f\n", c->load.mix->name,
                c->load.output->name, limn_kernels_name(kernels), family_name(kernels),
                c->load.order ? "shuffled" : "class", c->is_cold ? "cold" : "warm", c->load.level,
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
    bool good = bench_mix_regular(&s->mixes[s->mix_count++].base, TORUS_SIDE, (bench_way){0});
    good = good && bench_mix_worst(&s->mixes[s->mix_count++].base, TORUS_SIDE, (bench_way){0});
    for (int p = 0; p < path_count && good; p++)
        good = bench_mix_file(&s->mixes[s->mix_count++].base, paths[p], (bench_way){0});
    for (uint32_t m = 0; m < s->mix_count && good; m++)
        shuffle(&s->mixes[m]);
    return good;
}

/// All levels of a row of the table, one after the other.
static void add_levels(session *s, const mix *m, const bench_output *output, variant *v, int mode) {
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        s->cells[s->cell_count++] = (cell){
            .variant = v,
            .load = {.mix = &m->base,
                     .kernels = v->kernels,
                     .output = output,
                     .level = level,
                     .order = mode & 1 ? m->shuffled : NULL},
            .is_cold = mode & 2,
            .samples = allocate(s->options.rounds, sizeof(cost)),
        };
    }
}

/// All rows of one part of the table.
static void add_rows(session *s, const mix *m, const bench_output *output) {
    const int modes = output->all_modes || s->options.all_modes ? MODE_COUNT : 1;
    if (!is_possible(m, output)) return;
    for (uint32_t v = 0; v < s->variant_count; v++) {
        for (int mode = 0; mode < modes; mode++)
            add_levels(s, m, output, &s->variants[v], mode);
    }
}

static void add_cells(session *s) {
    s->cells = allocate((size_t)s->mix_count * BENCH_OUTPUT_COUNT * s->variant_count * MODE_COUNT *
                            LIMN_LEVEL_COUNT,
                        sizeof *s->cells);
    for (uint32_t m = 0; m < s->mix_count; m++) {
        for (int o = 0; o < BENCH_OUTPUT_COUNT; o++) {
            if (s->options.output_mask >> o & 1) add_rows(s, &s->mixes[m], &bench_outputs[o]);
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
    free(s->sampler.buffer);
}

/// csv  NULL: none
static bool run(session *s, char **paths, int path_count, FILE *csv) {
    s->sampler.buffer = aligned_alloc(4096, s->sampler.buffer_size);
    add_variants(s);
    if (!s->sampler.buffer || s->variant_count == 0) {
        fprintf(stderr, "limn-bench: this CPU has none of these instruction sets\n");
        return false;
    }
    if (!add_mixes(s, paths, path_count)) return false;
    add_cells(s);
    measure(s);
    bench_print_conditions(stdout);
    printf("%u rounds; vertices go to a buffer of %zu KiB\n", s->options.rounds,
           s->sampler.buffer_size / 1024);
    print_peaks(s);
    for (uint32_t m = 0; m < s->mix_count; m++) {
        for (int o = 0; o < BENCH_OUTPUT_COUNT; o++) {
            if (s->options.output_mask >> o & 1) print_mix(s, &s->mixes[m], &bench_outputs[o]);
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
    return bit < BENCH_OUTPUT_COUNT ? bench_outputs[bit].name : NULL;
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
    session *const s = parsed;
    options *const to = &s->options;
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
        s->sampler.seconds = 3e-4;
        return true;
    case 'b':
        if (!bench_parse_range(optarg, 4, 1 << 20, &kib) || kib % 4 != 0) return false;
        s->sampler.buffer_size = 1024 * (size_t)kib;
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
                             .output_mask = (1u << BENCH_OUTPUT_COUNT) - 1,
                             .rounds = 25},
                 .sampler = {.buffer_size = 64 * 1024, .seconds = 1e-3}};
    const int status = bench_read_options(argc, argv, help, names, parse_option, &s);
    if (status >= 0) return status;
    limni_output_file csv;
    if (!bench_results_open(&csv, s.options.csv)) return 1;
    const bool good = run(&s, argv + optind, argc - optind, csv.stream);
    destroy(&s);
    return bench_results_close(&csv, s.options.csv, good) ? 0 : 1;
}
