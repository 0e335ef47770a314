/* SPDX-License-Identifier: MIT */
/* The frame loop: all ways to make the frames of a scene, in turn. */
#ifndef FRAME_LOOP_H
#define FRAME_LOOP_H

#include "way.h"

typedef struct frame_length {
    uint32_t frames; ///< of the camera's path
    uint32_t rounds; ///< that the path is gone, by all ways in turn
} frame_length;

/// Makes frames of a crowd of `count`: each way goes the path quickly to warm up, and then as often
/// as there are rounds.
///
/// records  out: [way][round][frame]
void frame_loop_run(const frame_host *host, const frame_ways *ways, uint32_t count,
                    frame_length length, frame_record *records);

/// The median over the rounds of each frame of a way, seconds.
///
/// records  [length.rounds][length.frames]
/// out      [length.frames]
void frame_loop_curve(const frame_record *records, frame_length length, double *out);

/// What a way took: percentiles by the nearest rank, seconds.
typedef struct frame_times {
    double p50, p95, p99, max;
} frame_times;

/// The share of the frames that are longer than `seconds`.
double frame_share_over(const frame_record *records, uint32_t count, double seconds);

/// The times of one stage; FRAME_STAGE_COUNT: of whole frames.
frame_times frame_stage_times(const frame_record *records, uint32_t count, int stage);

#endif
