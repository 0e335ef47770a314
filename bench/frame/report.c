/* SPDX-License-Identifier: MIT */
#include "report.h"

#include "../bench.h"
#include "../peers/allocate.h"

#include <stdlib.h>
#include <string.h>

uint32_t frame_result_record_count(const frame_result *result) {
    return result->length.rounds * result->length.frames;
}

const frame_record *frame_result_records(const frame_result *result, uint32_t way) {
    return result->records + (size_t)way * frame_result_record_count(result);
}

static void add(frame_means *sum, const frame_record *r, double weight) {
    sum->vertices += weight * (double)r->vertices;
    sum->triangles += weight * (double)r->triangles;
    sum->bytes += weight * (double)r->bytes;
    sum->culled += weight * (double)r->culled;
    sum->visible += weight * r->visible;
    sum->total += weight * r->total;
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        sum->patches[level] += weight * (double)r->patches[level];
    for (int stage = 0; stage < FRAME_STAGE_COUNT; stage++)
        sum->stages[stage] += weight * r->seconds[stage];
}

frame_means frame_result_means(const frame_result *result, uint32_t way) {
    const uint32_t count = frame_result_record_count(result);
    const frame_record *const records = frame_result_records(result, way);
    frame_means means = {0};
    for (uint32_t r = 0; r < count; r++)
        add(&means, &records[r], 1.0 / count);
    return means;
}

void frame_result_curve(const frame_result *result, uint32_t way, double *out) {
    frame_loop_curve(frame_result_records(result, way), result->length, out);
}

// -------------------------------------------------------------------------------------------------
// Text

static void print_times(FILE *stream, const char *name, frame_times t, double share) {
    fprintf(stream, "  %-12s %9.3f %9.3f %9.3f %9.3f %7.1f\n", name, 1e3 * t.p50, 1e3 * t.p95,
            1e3 * t.p99, 1e3 * t.max, 100 * share);
}

static void print_stages(FILE *stream, const frame_result *result, uint32_t way,
                         const frame_means *means) {
    const frame_record *const records = frame_result_records(result, way);
    const uint32_t count = frame_result_record_count(result);
    fprintf(stream, "  %-12s %9s %9s %9s %9s %7s\n", "ms", "p50", "p95", "p99", "max", "share %");
    for (int stage = 0; stage < FRAME_STAGE_COUNT; stage++) {
        if (means->stages[stage] == 0) continue;
        print_times(stream, frame_stage_names[stage], frame_stage_times(records, count, stage),
                    means->stages[stage] / means->total);
    }
    print_times(stream, "frame", frame_stage_times(records, count, FRAME_STAGE_COUNT), 1);
}

/// Whether the stages around evaluation cost less than it.
static void print_evaluation(FILE *stream, const frame_means *means) {
    const double evaluate = means->stages[FRAME_EVALUATE];
    if (evaluate == 0) return;
    fprintf(stream, "  all but evaluate: %.2f of evaluate; without light and pack %.2f\n",
            means->total / evaluate - 1,
            (means->total - means->stages[FRAME_LIGHT] - means->stages[FRAME_PACK]) / evaluate - 1);
}

static void print_counts(FILE *stream, const frame_means *means) {
    fprintf(stream,
            "  a frame: %.1f characters in view, %.0f vertices, %.0f triangles, %.0f bytes; %.1f "
            "million vertices/s\n",
            means->visible, means->vertices, means->triangles, means->bytes,
            1e-6 * means->vertices / means->total);
    double patches = 0;
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        patches += means->patches[level];
    if (patches == 0) return;
    fprintf(stream, "  patches of levels 0 to 4:");
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        fprintf(stream, " %.0f", means->patches[level]);
    fprintf(stream, "; culled %.0f\n", means->culled);
}

static void print_way(FILE *stream, const frame_result *result, uint32_t way) {
    const frame_way *const what = &result->ways->ways[way];
    const frame_means means = frame_result_means(result, way);
    const double over = frame_share_over(frame_result_records(result, way),
                                         frame_result_record_count(result), result->budget);
    fprintf(stream, "\n%s: %llu bytes stored, %llu for each character\n", what->name,
            (unsigned long long)what->shared_bytes, (unsigned long long)what->instance_bytes);
    print_stages(stream, result, way, &means);
    print_evaluation(stream, &means);
    print_counts(stream, &means);
    fprintf(stream, "  over %.1f ms: %.1f %% of frames\n", 1e3 * result->budget, 100 * over);
}

/// What others are compared with: Limn writing the same, if that was measured.
static uint32_t find_base(const frame_ways *ways) {
    return ways->count > 1 && strcmp(ways->ways[1].name, "floats") == 0 ? 1 : 0;
}

static void print_comparison(FILE *stream, const frame_result *result) {
    const uint32_t frames = result->length.frames, base = find_base(result->ways);
    double *const curves = bench_allocate(2 * (size_t)frames, sizeof *curves);
    frame_result_curve(result, base, curves);
    fprintf(stream, "\ntime against %s, median of the frames:\n", result->ways->ways[base].name);
    for (uint32_t w = 0; w < result->ways->count; w++) {
        frame_result_curve(result, w, curves + frames);
        for (uint32_t f = 0; f < frames; f++)
            curves[frames + f] /= curves[f];
        fprintf(stream, "  %-12s %9.3f\n", result->ways->ways[w].name,
                bench_median(curves + frames, frames));
    }
    free(curves);
}

static void print_crowds(FILE *stream, const frame_result *result) {
    fprintf(stream, "\nlargest crowds within %.1f ms at p99:\n", 1e3 * result->budget);
    for (uint32_t w = 0; w < result->ways->count; w++) {
        const frame_crowd_size *const crowd = &result->crowds[w];
        const frame_way *const what = &result->ways->ways[w];
        fprintf(stream, "  %-18s %6u%s characters, p99 %.2f ms, %.2f MB\n", what->name,
                crowd->count, crowd->at_limit ? "+" : " ", 1e3 * crowd->p99,
                1e-6 * ((double)what->shared_bytes +
                        (double)crowd->count * (double)what->instance_bytes));
    }
}

void frame_report_print(FILE *stream, const frame_result *result) {
    const frame_host *const host = result->host;
    const limn_kernels *const kernels = host->actor->mix.mesh.kernels;
    bench_print_conditions(stream);
    fprintf(stream,
            "scene %s: %s, %u patches, %u characters; %s kernels, %s; %u threads; %u frames x %u, "
            "%s clock\n",
            host->script->name, host->actor->mix.name, host->actor->mix.mesh.patch_count,
            result->count, limn_kernels_name(kernels),
            limn_kernels_family(kernels) == LIMN_FAMILY_FAST ? "fast" : "reproducible",
            frame_host_threads(host), result->length.frames, result->length.rounds, result->clock);
    for (uint32_t w = 0; w < result->ways->count; w++)
        print_way(stream, result, w);
    if (result->ways->count > 1) print_comparison(stream, result);
    if (result->crowds) print_crowds(stream, result);
}

// -------------------------------------------------------------------------------------------------
// CSV

static void write_line(FILE *stream, const frame_record *r) {
    for (int stage = 0; stage < FRAME_STAGE_COUNT; stage++)
        fprintf(stream, ",%.5f", 1e3 * r->seconds[stage]);
    fprintf(stream, ",%.5f,%u,%llu,%llu,%llu", 1e3 * r->total, r->visible,
            (unsigned long long)r->vertices, (unsigned long long)r->triangles,
            (unsigned long long)r->bytes);
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        fprintf(stream, ",%llu", (unsigned long long)r->patches[level]);
    fprintf(stream, ",%llu\n", (unsigned long long)r->culled);
}

void frame_report_csv(FILE *stream, const frame_result *result) {
    fprintf(stream, "# ");
    bench_print_conditions(stream);
    fprintf(stream, "scene,characters,way,round,frame");
    for (int stage = 0; stage < FRAME_STAGE_COUNT; stage++)
        fprintf(stream, ",%s_ms", frame_stage_names[stage]);
    fprintf(stream, ",frame_ms,visible,vertices,triangles,bytes,level_0,level_1,level_2,level_3,"
                    "level_4,culled\n");
    for (uint32_t w = 0; w < result->ways->count; w++) {
        const frame_record *const records = frame_result_records(result, w);
        for (uint32_t r = 0; r < frame_result_record_count(result); r++) {
            fprintf(stream, "%s,%u,\"%s\",%u,%u", result->host->script->name, result->count,
                    result->ways->ways[w].name, r / result->length.frames,
                    r % result->length.frames);
            write_line(stream, &records[r]);
        }
    }
}
