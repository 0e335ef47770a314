/* SPDX-License-Identifier: MIT */
/* limn-bench frame: how long the frames of a scene take, and which stages of them. */
#include "../bench.h"
#include "../peers/allocate.h"
#include "find_crowd.h"
#include "options.h"
#include "report.h"
#include "way_drawn.h"

#include <stdlib.h>
#include <string.h>

// -------------------------------------------------------------------------------------------------
// Files

typedef struct files {
    limni_output_file json, csv, html;
} files;

static bool close_files(files *f, const frame_options *o, bool good) {
    good = bench_results_close(&f->json, o->json, good);
    good = bench_results_close(&f->csv, o->csv, good);
    return bench_results_close(&f->html, o->html, good);
}

static bool open_files(files *f, const frame_options *o) {
    *f = (files){0};
    if (bench_results_open(&f->json, o->json) && bench_results_open(&f->csv, o->csv) &&
        bench_results_open(&f->html, o->html))
        return true;
    return close_files(f, o, false);
}

static bool report(const frame_result *result, const files *f) {
    frame_report_print(stdout, result);
    if (f->csv.stream) frame_report_csv(f->csv.stream, result);
    if (f->html.stream) frame_report_html(f->html.stream, result);
    return !f->json.stream || frame_report_json(f->json.stream, result);
}

// -------------------------------------------------------------------------------------------------
// Running

static bool add_ways(frame_ways *ways, const frame_host *host, const frame_options *o) {
    bool good = frame_ways_add_limn(ways, host);
#ifdef BENCH_WITH_DRAWING
    good = good && (!o->draws || frame_ways_add_drawn(ways, host));
#endif
    for (uint32_t p = 0; p < frame_peer_count && good; p++)
        good = !(o->peers & 1u << p) || frame_peers[p].add(ways, host);
    return good;
}

static bool measure(const frame_host *host, const frame_ways *ways, const frame_options *o,
                    const files *f) {
    frame_crowd_size crowds[FRAME_WAY_MAX];
    const size_t record_count = (size_t)o->length.frames * o->length.rounds * ways->count;
    frame_record *const records = bench_allocate(record_count, sizeof *records);
    frame_loop_run(host, ways, host->script->count, o->length, records);
    if (o->finds_crowd) frame_find_crowds(host, ways, o->length, 1e-3 * o->budget, crowds);
    const frame_result result = {.host = host,
                                 .ways = ways,
                                 .length = o->length,
                                 .count = host->script->count,
                                 .records = records,
                                 .budget = 1e-3 * o->budget,
                                 .clock = o->clock,
                                 .crowds = o->finds_crowd ? crowds : NULL};
    const bool good = report(&result, f);
    free(records);
    return good;
}

static bool draw_picture(const frame_host *host, const frame_options *o) {
#ifdef BENCH_WITH_DRAWING
    const float *const viewport = host->script->viewport;
    return frame_draw_picture(host, o->frame, o->length.frames,
                              o->width ? o->width : (uint32_t)viewport[0],
                              o->width ? o->height : (uint32_t)viewport[1], o->png);
#else
    (void)host;
    return !o->png; // is refused before
#endif
}

static bool run_script(const frame_script *script, const frame_options *o, const files *f) {
    frame_actor actor;
    frame_ways ways = {.count = 0};
    frame_host host = {.script = script,
                       .actor = &actor,
                       .clock =
                           strcmp(o->clock, "wall") == 0 ? bench_seconds : bench_thread_seconds};
    bool good = frame_actor_create(&actor, script, limn_kernels_select(o->isa, o->family));
    if (good && o->threads > 1) host.threads = team_create(o->threads);
    if (o->png)
        good = good && draw_picture(&host, o);
    else
        good = good && add_ways(&ways, &host, o) && measure(&host, &ways, o, f);
    frame_ways_destroy(&ways);
    if (host.threads) team_destroy(host.threads);
    frame_actor_destroy(&actor);
    return good;
}

int bench_frame_times(int argc, char **argv) {
    static frame_script script;
    frame_options o;
    files f;
    const int status = frame_options_read(&o, argc, argv);
    if (status >= 0) return status;
    if (!frame_options_script(&o, &script) || !open_files(&f, &o)) return 1;
    return close_files(&f, &o, run_script(&script, &o, &f)) ? 0 : 1;
}
