/* SPDX-License-Identifier: MIT */
#include "loop.h"

#include "../bench.h"
#include "../peers/allocate.h"

#include <stdlib.h>

static frame_record make_frame(const frame_host *host, const frame_way *way, frame_crowd *crowd,
                               uint32_t frame, uint32_t frame_count) {
    frame_record record = {0};
    const double start = host->clock();
    frame_crowd_see(crowd, frame, frame_count);
    record.seconds[FRAME_PLAN] = host->clock() - start;
    record.visible = crowd->visible_count;
    way->make(way->state, &record);
    return record;
}

/// Some frames of the whole path, backwards to the first.
static void warm_up(const frame_host *host, const frame_way *way, frame_crowd *crowd,
                    uint32_t frames) {
    enum { WARM_FRAMES = 16 };
    for (uint32_t f = WARM_FRAMES; f-- > 0;)
        make_frame(host, way, crowd, f * (frames - 1) / (WARM_FRAMES - 1), frames);
}

void frame_loop_run(const frame_host *host, const frame_ways *ways, uint32_t count,
                    frame_length length, frame_record *records) {
    frame_crowd crowd = frame_crowd_create(host->script, host->actor, count);
    for (uint32_t w = 0; w < ways->count; w++)
        ways->ways[w].set_crowd(ways->ways[w].state, &crowd);
    for (uint32_t round = 0; round < length.rounds; round++) {
        for (uint32_t w = 0; w < ways->count; w++) {
            frame_record *const to = records + (size_t)(w * length.rounds + round) * length.frames;
            warm_up(host, &ways->ways[w], &crowd, length.frames);
            for (uint32_t frame = 0; frame < length.frames; frame++)
                to[frame] = make_frame(host, &ways->ways[w], &crowd, frame, length.frames);
        }
    }
    for (uint32_t w = 0; w < ways->count; w++)
        ways->ways[w].set_crowd(ways->ways[w].state, NULL);
    frame_crowd_destroy(&crowd);
}

static frame_times find_times(double *values, uint32_t count) {
    return (frame_times){bench_percentile(values, count, 0.50),
                         bench_percentile(values, count, 0.95),
                         bench_percentile(values, count, 0.99), values[count - 1]};
}

frame_times frame_stage_times(const frame_record *records, uint32_t count, int stage) {
    double *const values = bench_allocate(count, sizeof *values);
    for (uint32_t r = 0; r < count; r++)
        values[r] = stage == FRAME_STAGE_COUNT ? records[r].total : records[r].seconds[stage];
    const frame_times times = find_times(values, count);
    free(values);
    return times;
}

void frame_loop_curve(const frame_record *records, frame_length length, double *out) {
    double *const values = bench_allocate(length.rounds, sizeof *values);
    for (uint32_t frame = 0; frame < length.frames; frame++) {
        for (uint32_t round = 0; round < length.rounds; round++)
            values[round] = records[round * length.frames + frame].total;
        out[frame] = bench_median(values, length.rounds);
    }
    free(values);
}

double frame_share_over(const frame_record *records, uint32_t count, double seconds) {
    uint32_t over = 0;
    for (uint32_t r = 0; r < count; r++)
        over += records[r].total > seconds;
    return (double)over / count;
}
