/* SPDX-License-Identifier: MIT */
#include "find_crowd.h"

#include "../bench.h"
#include "../peers/allocate.h"

#include <math.h>
#include <stdlib.h>

enum { STEP_MAX = 12, FIRST_COUNT = 16 };

/// A crowd that is a fiftieth larger would be too large.
#define PRECISION 1.02

/// What is known of one way.
typedef struct search {
    frame_crowd_size best; ///< that keeps the budget
    uint32_t too_large;    ///< the smallest that does not; above FRAME_COUNT_MAX: none was found
    uint32_t next;
    bool done;
} search;

static double measure_p99(const frame_host *host, const frame_way *way, uint32_t count,
                          frame_length length) {
    const frame_ways alone = {.ways = {*way}, .count = 1};
    frame_record *const records =
        bench_allocate((size_t)length.frames * length.rounds, sizeof *records);
    double *const curve = bench_allocate(length.frames, sizeof *curve);
    frame_loop_run(host, &alone, count, length, records);
    frame_loop_curve(records, length, curve);
    const double p99 = bench_percentile(curve, length.frames, 0.99);
    free(records);
    free(curve);
    return p99;
}

/// Where the time would be that of the budget, were it proportional to the crowd; but between what
/// is known, and at most four times as large.
static uint32_t choose_next(const search *s, double p99, double budget) {
    const double guess = s->next * fmin(budget / p99, 4);
    const double low = s->best.count + 1.0, high = s->too_large - 1.0;
    if (s->best.count > 0 && s->too_large <= FRAME_COUNT_MAX && (guess < low || guess > high))
        return (s->best.count + s->too_large) / 2;
    return (uint32_t)fmax(fmin(guess, high), low);
}

static void step(const frame_host *host, const frame_way *way, frame_length length, double budget,
                 search *s) {
    const double p99 = measure_p99(host, way, s->next, length);
    if (p99 <= budget)
        s->best = (frame_crowd_size){.count = s->next, .p99 = p99};
    else
        s->too_large = s->next;
    s->best.at_limit = s->best.count == FRAME_COUNT_MAX;
    s->done = s->best.at_limit || s->too_large == 1 || s->best.count + 1 == s->too_large ||
              (s->best.count > 0 && s->too_large <= PRECISION * s->best.count);
    if (!s->done) s->next = choose_next(s, p99, budget);
}

void frame_find_crowds(const frame_host *host, const frame_ways *ways, frame_length length,
                       double budget, frame_crowd_size *crowds) {
    search searches[FRAME_WAY_MAX];
    for (uint32_t w = 0; w < ways->count; w++)
        searches[w] = (search){.too_large = FRAME_COUNT_MAX + 1, .next = FIRST_COUNT};
    for (int round = 0; round < STEP_MAX; round++) {
        for (uint32_t w = 0; w < ways->count; w++) {
            if (!searches[w].done) step(host, &ways->ways[w], length, budget, &searches[w]);
        }
    }
    for (uint32_t w = 0; w < ways->count; w++)
        crowds[w] = searches[w].best;
}
