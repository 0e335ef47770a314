/* SPDX-License-Identifier: MIT */
/* Results as JSON, which limn-bench compare reads. Times are in ms. */
#include "report.h"

#include "../bench.h"
#include "../peers/allocate.h"

#include <jansson.h>
#include <stdlib.h>

static json_t *make_curve(const frame_result *result, uint32_t way) {
    double *const curve = bench_allocate(result->length.frames, sizeof *curve);
    json_t *const array = json_array();
    frame_result_curve(result, way, curve);
    for (uint32_t frame = 0; frame < result->length.frames; frame++)
        json_array_append_new(array, json_real(1e3 * curve[frame]));
    free(curve);
    return array;
}

/// stage: FRAME_STAGE_COUNT for whole frames.
static json_t *make_times(const frame_result *result, uint32_t way, int stage, double share) {
    const frame_times t = frame_stage_times(frame_result_records(result, way),
                                            frame_result_record_count(result), stage);
    return json_pack("{sf sf sf sf sf}", "p50", 1e3 * t.p50, "p95", 1e3 * t.p95, "p99", 1e3 * t.p99,
                     "max", 1e3 * t.max, "share", share);
}

static json_t *make_stages(const frame_result *result, uint32_t way, const frame_means *means) {
    json_t *const stages = json_object();
    for (int stage = 0; stage < FRAME_STAGE_COUNT; stage++)
        json_object_set_new(stages, frame_stage_names[stage],
                            make_times(result, way, stage, means->stages[stage] / means->total));
    return stages;
}

static json_t *make_patches(const frame_means *means) {
    json_t *const patches = json_array();
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        json_array_append_new(patches, json_real(means->patches[level]));
    return patches;
}

static json_t *make_way(const frame_result *result, uint32_t way) {
    const frame_way *const what = &result->ways->ways[way];
    const frame_means means = frame_result_means(result, way);
    const double over = frame_share_over(frame_result_records(result, way),
                                         frame_result_record_count(result), result->budget);
    json_t *const made = json_pack(
        "{ss sI sI so so so sf sf sf sf sf so sf sf}", "name", what->name, "shared_bytes",
        (json_int_t)what->shared_bytes, "instance_bytes", (json_int_t)what->instance_bytes,
        "frames", make_curve(result, way), "frame", make_times(result, way, FRAME_STAGE_COUNT, 1),
        "stages", make_stages(result, way, &means), "over_budget", over, "visible", means.visible,
        "vertices", means.vertices, "triangles", means.triangles, "bytes", means.bytes, "patches",
        make_patches(&means), "culled", means.culled, "vertices_per_second",
        means.vertices / means.total);
    if (made && result->crowds)
        json_object_set_new(made, "largest_crowd",
                            json_pack("{si sb sf}", "characters", (int)result->crowds[way].count,
                                      "at_limit", (int)result->crowds[way].at_limit, "p99",
                                      1e3 * result->crowds[way].p99));
    return made;
}

static json_t *make_conditions(const frame_result *result) {
    const limn_kernels *const kernels = result->host->actor->mix.mesh.kernels;
    char cpu[128];
    bench_cpu_name(cpu, sizeof cpu);
    return json_pack("{ss ss ss ss ss ss ss si si si si ss sf}", "commit", BENCH_COMMIT, "compiler",
                     BENCH_COMPILER, "flags", BENCH_FLAGS, "cpu", cpu, "scene",
                     result->host->script->name, "mesh", result->host->actor->mix.name, "isa",
                     limn_kernels_name(kernels), "characters", (int)result->count, "threads",
                     (int)frame_host_threads(result->host), "frames", (int)result->length.frames,
                     "rounds", (int)result->length.rounds, "clock", result->clock, "budget",
                     1e3 * result->budget);
}

bool frame_report_json(FILE *stream, const frame_result *result) {
    json_t *const ways = json_array();
    for (uint32_t w = 0; w < result->ways->count; w++)
        json_array_append_new(ways, make_way(result, w));
    json_t *const root = json_pack("{so so}", "conditions", make_conditions(result), "ways", ways);
    const bool good =
        root && json_dumpf(root, stream, JSON_INDENT(1) | JSON_REAL_PRECISION(6)) == 0;
    json_decref(root);
    return good && fputc('\n', stream) != EOF;
}
