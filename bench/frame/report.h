/* SPDX-License-Identifier: MIT */
/* What `limn-bench frame` found, as text and as files. */
#ifndef FRAME_REPORT_H
#define FRAME_REPORT_H

#include "loop.h"

#include <stdio.h>

/// The largest crowd of one way within the budget at p99 of its curve.
typedef struct frame_crowd_size {
    uint32_t count; ///< 0: not even one character
    bool at_limit;  ///< FRAME_COUNT_MAX: more were not tried
    double p99;     ///< seconds
} frame_crowd_size;

typedef struct frame_result {
    const frame_host *host;
    const frame_ways *ways;
    frame_length length;
    uint32_t count;                 ///< of characters
    const frame_record *records;    ///< [way][round][frame]
    double budget;                  ///< seconds
    const char *clock;              ///< "wall" or "thread"
    const frame_crowd_size *crowds; ///< [way]; NULL: not looked for
} frame_result;

/// The records of a way, and how many there are.
const frame_record *frame_result_records(const frame_result *result, uint32_t way);
uint32_t frame_result_record_count(const frame_result *result);

/// Means over the frames of a way.
typedef struct frame_means {
    double vertices, triangles, bytes, patches[LIMN_LEVEL_COUNT], culled, visible;
    double stages[FRAME_STAGE_COUNT], total; ///< seconds
} frame_means;

frame_means frame_result_means(const frame_result *result, uint32_t way);

/// frame_loop_curve() of a way.
void frame_result_curve(const frame_result *result, uint32_t way, double *out);

void frame_report_print(FILE *stream, const frame_result *result);

/// A line per way, round and frame.
void frame_report_csv(FILE *stream, const frame_result *result);

/// False when out of memory, or when the stream fails.
bool frame_report_json(FILE *stream, const frame_result *result);

/// A page of its own: no scripts, no other files.
void frame_report_html(FILE *stream, const frame_result *result);

#endif
