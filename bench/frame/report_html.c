/* SPDX-License-Identifier: MIT */
/* Results as one page: pictures are SVG inside it. */
#include "report.h"

#include "../bench.h"
#include "../peers/allocate.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 860, HEIGHT = 300, LEFT = 70, TOP = 20, BAR = 26, BIN_COUNT = 50 };

/// Of Okabe and Ito, which most people can tell apart.
static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                      "#e69f00", "#56b4e9", "#999999", "#000000"};

enum { COLOUR_COUNT = sizeof colours / sizeof *colours };

static const char *colour_of(uint32_t index) {
    return colours[index % COLOUR_COUNT];
}

static void write_text(FILE *page, const char *text) {
    for (; *text; text++) {
        if (*text == '<' || *text == '>' || *text == '&')
            fprintf(page, "&#%d;", *text);
        else
            fputc(*text, page);
    }
}

static void begin_picture(FILE *page, const char *title, int height) {
    fprintf(page, "<h2>%s</h2>\n<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"%s\">\n",
            title, WIDTH, height, title);
}

static void write_label(FILE *page, double x, double y, const char *anchor, const char *text) {
    fprintf(page, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor);
    write_text(page, text);
    fprintf(page, "</text>\n");
}

static void write_line(FILE *page, double x1, double y1, double x2, double y2, const char *class) {
    fprintf(page, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" class=\"%s\"/>\n", x1, y1,
            x2, y2, class);
}

static void write_box(FILE *page, double x, double y, double width, double height,
                      const char *colour) {
    fprintf(page, "<rect x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\" fill=\"%s\"/>\n", x,
            y, width, height, colour);
}

/// One entry of a row of names with their colours.
static void write_key(FILE *page, uint32_t index, const char *text, double y) {
    const double x = LEFT + 105.0 * index;
    write_box(page, x, y - 9, 10, 10, colour_of(index));
    write_label(page, x + 14, y, "start", text);
}

// -------------------------------------------------------------------------------------------------
// Frame times

/// The logarithmic axis of times: from a power of ten to another.
typedef struct axis {
    double low, high; ///< log10 of seconds
} axis;

static double place_time(axis a, double seconds) {
    const double share = (log10(fmax(seconds, 1e-9)) - a.low) / (a.high - a.low);
    return TOP + (1 - fmin(fmax(share, 0), 1)) * (HEIGHT - 2 * TOP);
}

static axis find_axis(const frame_result *result, const double *curves) {
    const size_t count = (size_t)result->ways->count * result->length.frames;
    double low = result->budget, high = result->budget;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, fmax(curves[i], 1e-9));
        high = fmax(high, curves[i]);
    }
    return (axis){floor(log10(low)), ceil(log10(high) + 0.05)};
}

static void write_axis(FILE *page, const frame_result *result, axis a) {
    char text[32];
    for (double power = a.low; power <= a.high; power++) {
        const double y = place_time(a, pow(10, power));
        snprintf(text, sizeof text, "%g ms", 1e3 * pow(10, power));
        write_line(page, LEFT, y, WIDTH, y, "grid");
        write_label(page, LEFT - 6, y + 4, "end", text);
    }
    const double y = place_time(a, result->budget);
    write_line(page, LEFT, y, WIDTH, y, "budget");
    snprintf(text, sizeof text, "budget %.1f ms", 1e3 * result->budget);
    write_label(page, WIDTH - 4, y - 4, "end", text);
    snprintf(text, sizeof text, "frame %u", result->length.frames - 1);
    write_label(page, LEFT, HEIGHT - 4, "start", "frame 0");
    write_label(page, WIDTH - 4, HEIGHT - 4, "end", text);
}

static void write_curve(FILE *page, const double *curve, uint32_t count, axis a,
                        const char *colour) {
    fprintf(page, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\" points=\"", colour);
    for (uint32_t f = 0; f < count; f++)
        fprintf(page, "%.1f,%.1f ", LEFT + (double)(WIDTH - LEFT) * f / (count > 1 ? count - 1 : 1),
                place_time(a, curve[f]));
    fprintf(page, "\"/>\n");
}

static void write_curves(FILE *page, const frame_result *result) {
    const uint32_t frames = result->length.frames;
    double *const curves = bench_allocate((size_t)result->ways->count * frames, sizeof *curves);
    for (uint32_t w = 0; w < result->ways->count; w++)
        frame_result_curve(result, w, curves + (size_t)w * frames);
    const axis a = find_axis(result, curves);
    begin_picture(page, "Frame times, median of the rounds", HEIGHT + 20);
    for (uint32_t w = 0; w < result->ways->count; w++) {
        write_curve(page, curves + (size_t)w * frames, frames, a, colour_of(w));
        write_key(page, w, result->ways->ways[w].name, HEIGHT + 14);
    }
    write_axis(page, result, a);
    fprintf(page, "</svg>\n");
    free(curves);
}

// -------------------------------------------------------------------------------------------------
// Stages

/// A stage that noise made shorter than nothing has no part.
static void write_stack(FILE *page, const frame_means *means, const char *name, double y) {
    char text[32];
    double sum = 0, x = LEFT;
    for (int stage = 0; stage < FRAME_STAGE_COUNT; stage++)
        sum += fmax(means->stages[stage], 0);
    for (uint32_t stage = 0; stage < FRAME_STAGE_COUNT; stage++) {
        const double width = fmax(means->stages[stage], 0) / sum * (WIDTH - LEFT - 90);
        write_box(page, x, y, width, BAR - 6, colour_of(stage));
        x += width;
    }
    snprintf(text, sizeof text, "%.3f ms", 1e3 * means->total);
    write_label(page, LEFT - 6, y + 14, "end", name);
    write_label(page, x + 6, y + 14, "start", text);
}

static void write_stages(FILE *page, const frame_result *result) {
    const int bottom = TOP + BAR * (int)result->ways->count;
    begin_picture(page, "Stages, shares of the mean frame", bottom + 24);
    for (uint32_t w = 0; w < result->ways->count; w++) {
        const frame_means means = frame_result_means(result, w);
        write_stack(page, &means, result->ways->ways[w].name, TOP + BAR * (double)w);
    }
    for (uint32_t stage = 0; stage < FRAME_STAGE_COUNT; stage++)
        write_key(page, stage, frame_stage_names[stage], bottom + 16);
    fprintf(page, "</svg>\n");
}

// -------------------------------------------------------------------------------------------------
// Histogram

/// Frames of the first way from the shortest to the 99th percentile; longer ones are in the last bin.
static void write_histogram(FILE *page, const frame_result *result) {
    const frame_record *const records = frame_result_records(result, 0);
    const uint32_t count = frame_result_record_count(result);
    const double high = frame_stage_times(records, count, FRAME_STAGE_COUNT).p99;
    double low = high;
    uint32_t bins[BIN_COUNT] = {0}, largest = 1;
    char text[64];
    for (uint32_t r = 0; r < count; r++)
        low = fmin(low, records[r].total);
    for (uint32_t r = 0; r < count; r++) {
        const double share = high > low ? (records[r].total - low) / (high - low) : 0;
        uint32_t *const bin = &bins[(uint32_t)fmin(share * BIN_COUNT, BIN_COUNT - 1)];
        largest = ++*bin > largest ? *bin : largest;
    }
    begin_picture(page, "Histogram of the frames of limn", HEIGHT);
    for (int b = 0; b < BIN_COUNT; b++) {
        const double step = (double)(WIDTH - LEFT) / BIN_COUNT;
        const double height = (double)bins[b] / largest * (HEIGHT - 2 * TOP);
        write_box(page, LEFT + b * step, HEIGHT - TOP - height, step - 1, height, colours[0]);
    }
    snprintf(text, sizeof text, "%u frames", largest);
    write_label(page, LEFT - 6, TOP + 10, "end", text);
    snprintf(text, sizeof text, "%.3f ms", 1e3 * low);
    write_label(page, LEFT, HEIGHT - 4, "start", text);
    snprintf(text, sizeof text, "%.3f ms and more", 1e3 * high);
    write_label(page, WIDTH - 4, HEIGHT - 4, "end", text);
    fprintf(page, "</svg>\n");
}

// -------------------------------------------------------------------------------------------------
// The table

static void write_row(FILE *page, const frame_result *result, uint32_t way) {
    const frame_way *const what = &result->ways->ways[way];
    const frame_record *const records = frame_result_records(result, way);
    const uint32_t count = frame_result_record_count(result);
    const frame_times t = frame_stage_times(records, count, FRAME_STAGE_COUNT);
    const frame_means means = frame_result_means(result, way);
    fprintf(page, "<tr><th>%s</th><td>%.3f</td><td>%.3f</td><td>%.3f</td><td>%.3f</td>", what->name,
            1e3 * t.p50, 1e3 * t.p95, 1e3 * t.p99, 1e3 * t.max);
    fprintf(page, "<td>%.1f</td><td>%.0f</td><td>%.0f</td><td>%.1f</td><td>%.1f</td><td>%.1f</td>",
            100 * frame_share_over(records, count, result->budget), means.vertices, means.triangles,
            1e-3 * means.bytes, 1e-3 * (double)what->shared_bytes,
            1e-3 * (double)what->instance_bytes);
    if (result->crowds) fprintf(page, "<td>%u</td>", result->crowds[way].count);
    fprintf(page, "</tr>\n");
}

static void write_table(FILE *page, const frame_result *result) {
    fprintf(page,
            "<h2>Comparison</h2>\n<table>\n<tr><th></th><th>p50, ms</th><th>p95</th><th>p99</th>"
            "<th>max</th><th>%% over budget</th><th>vertices a frame</th><th>triangles</th>"
            "<th>kB written</th><th>kB stored</th><th>kB a character</th>%s</tr>\n",
            result->crowds ? "<th>largest crowd</th>" : "");
    for (uint32_t w = 0; w < result->ways->count; w++)
        write_row(page, result, w);
    fprintf(page, "</table>\n");
}

static void write_head(FILE *page, const frame_result *result) {
    const frame_host *const host = result->host;
    char cpu[128];
    bench_cpu_name(cpu, sizeof cpu);
    fprintf(page, "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>Limn: ");
    write_text(page, host->script->name);
    fprintf(page, "</title>\n<style>\n"
                  "body { font: 14px sans-serif; max-width: 64em; margin: 2em auto; padding: 0 "
                  "1em; color: #222 }\n"
                  "svg { width: 100%% }\n"
                  "text { font: 11px sans-serif; fill: #222 }\n"
                  "text { paint-order: stroke; stroke: #fff; stroke-width: 3px }\n"
                  ".grid { stroke: #ddd }\n"
                  ".budget { stroke: #c00; stroke-dasharray: 4 3 }\n"
                  "table { border-collapse: collapse; font-size: 13px }\n"
                  "td, th { padding: 2px 8px; text-align: right }\n"
                  "tr { border-bottom: 1px solid #ddd }\n</style>\n<h1>");
    write_text(page, host->script->name);
    fprintf(page, "</h1>\n<p>");
    write_text(page, host->actor->mix.name);
    fprintf(page,
            ", %u patches, %u characters; %u frames, %u rounds, %s clock, %u threads, %s kernels."
            "</p>\n<p>Limn commit %s, %s, flags %s, CPU %s.</p>\n",
            host->actor->mix.mesh.patch_count, result->count, result->length.frames,
            result->length.rounds, result->clock, frame_host_threads(host),
            limn_kernels_name(host->actor->mix.mesh.kernels), BENCH_COMMIT, BENCH_COMPILER,
            BENCH_FLAGS, cpu);
}

void frame_report_html(FILE *page, const frame_result *result) {
    write_head(page, result);
    write_curves(page, result);
    write_stages(page, result);
    write_histogram(page, result);
    write_table(page, result);
    fprintf(page, "</html>\n");
}
