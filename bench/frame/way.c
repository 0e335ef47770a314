/* SPDX-License-Identifier: MIT */
#include "way.h"

#include "../peers/allocate.h"

#include <stdlib.h>

const char *const frame_stage_names[FRAME_STAGE_COUNT] = {
#define FRAME_STAGE_NAME(name, text, meaning) [FRAME_##name] = text,
    FRAME_STAGES(FRAME_STAGE_NAME)};

frame_way *frame_ways_append(frame_ways *ways) {
    if (ways->count == FRAME_WAY_MAX) abort();
    return &ways->ways[ways->count++];
}

void frame_ways_destroy(frame_ways *ways) {
    for (uint32_t w = 0; w < ways->count; w++)
        ways->ways[w].destroy(ways->ways[w].state);
    ways->count = 0;
}

void frame_host_run(const frame_host *host, team_work *work, void *state) {
    if (host->threads)
        team_run(host->threads, work, state);
    else
        work(state, 0, 1);
}

uint32_t frame_host_threads(const frame_host *host) {
    return host->threads ? team_size(host->threads) : 1;
}

frame_pose_memory *frame_host_create_poses(const frame_host *host) {
    frame_pose_memory *const poses = bench_allocate(frame_host_threads(host), sizeof *poses);
    for (uint32_t t = 0; t < frame_host_threads(host); t++)
        poses[t] = frame_pose_memory_create(host->actor);
    return poses;
}

void frame_host_free_poses(const frame_host *host, frame_pose_memory *poses) {
    for (uint32_t t = 0; t < frame_host_threads(host); t++)
        frame_pose_memory_destroy(&poses[t]);
    free(poses);
}

void frame_buffer_reserve(frame_buffer *buffer, size_t size) {
    if (size <= buffer->size) return;
    free(buffer->bytes);
    buffer->size = size + size / 2;
    buffer->bytes = bench_allocate(1, buffer->size);
}
