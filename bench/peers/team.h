/* SPDX-License-Identifier: MIT */
/* Threads that wait for work, which is cut into one part for each. */
#ifndef TEAM_H
#define TEAM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct team team;

typedef void team_work(void *state, uint32_t part, uint32_t part_count);

/// `count` threads, the caller's included. Ends the program when they cannot be had.
team *team_create(uint32_t count);
void team_destroy(team *threads);

uint32_t team_size(const team *threads);

/// Does all parts, the last in the calling thread, and returns when they are done.
void team_run(team *threads, team_work *work, void *state);

/// Where part `part` of `count` items begins; it ends where the next one begins.
static inline uint32_t team_share(uint32_t count, uint32_t part, uint32_t part_count) {
    return (uint32_t)((uint64_t)count * part / part_count);
}

#ifdef __cplusplus
}
#endif

#endif
