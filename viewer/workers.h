/* SPDX-License-Identifier: MIT */
/* Threads that wait for work, and share it by ranges. */
#ifndef VIEW_WORKERS_H
#define VIEW_WORKERS_H

#include <stdint.h>

typedef struct view_workers view_workers;

/// Does items [begin, end). Called from several threads at once.
typedef void view_work_fn(void *user, uint32_t begin, uint32_t end);

/// `thread_count` threads that do work, counting the one that gives it. Returns NULL if there is no
/// memory or no thread to be had; says nothing.
view_workers *view_workers_create(uint32_t thread_count);

/// Does items [0, count), in ranges of at most `grain`, and returns when all are done. Work of one
/// range is done at once. Does not allocate. One thread at a time.
void view_workers_run(view_workers *workers, view_work_fn *work, void *user, uint32_t count,
                      uint32_t grain);

/// Takes NULL as well.
void view_workers_destroy(view_workers *workers);

#endif
