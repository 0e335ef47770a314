/* SPDX-License-Identifier: MIT */
#include "workers.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

typedef struct job {
    view_work_fn *work;
    void *user;
    uint32_t count, grain;
} job;

struct view_workers {
    pthread_mutex_t mutex;
    pthread_cond_t started, finished;
    // What the mutex guards:
    job job;
    uint64_t job_number;
    uint32_t busy_count; ///< threads that have not yet finished the job
    bool closing;
    // And what it does not:
    _Atomic uint64_t next; ///< item that nobody has taken
    uint32_t thread_count; ///< of those below
    pthread_t threads[];
};

static void do_ranges(view_workers *workers, const job *given) {
    for (;;) {
        const uint64_t begin = atomic_fetch_add(&workers->next, given->grain);
        if (begin >= given->count) return;
        const uint64_t left = given->count - begin;
        const uint64_t size = left < given->grain ? left : given->grain;
        given->work(given->user, (uint32_t)begin, (uint32_t)(begin + size));
    }
}

/// Waits for a job after number `done`. False if there will be none.
static bool wait_for_job(view_workers *workers, uint64_t *done, job *next) {
    pthread_mutex_lock(&workers->mutex);
    while (workers->job_number == *done && !workers->closing)
        pthread_cond_wait(&workers->started, &workers->mutex);
    const bool goes_on = !workers->closing;
    *done = workers->job_number;
    *next = workers->job;
    pthread_mutex_unlock(&workers->mutex);
    return goes_on;
}

static void *work(void *argument) {
    view_workers *const workers = argument;
    uint64_t done = 0;
    job next;
    while (wait_for_job(workers, &done, &next)) {
        do_ranges(workers, &next);
        pthread_mutex_lock(&workers->mutex);
        if (--workers->busy_count == 0) pthread_cond_signal(&workers->finished);
        pthread_mutex_unlock(&workers->mutex);
    }
    return NULL;
}

view_workers *view_workers_create(uint32_t thread_count) {
    const uint32_t others = thread_count > 1 ? thread_count - 1 : 0;
    view_workers *const workers = calloc(1, sizeof *workers + others * sizeof(pthread_t));
    if (!workers) return NULL;
    pthread_mutex_init(&workers->mutex, NULL);
    pthread_cond_init(&workers->started, NULL);
    pthread_cond_init(&workers->finished, NULL);
    while (workers->thread_count < others) {
        pthread_t *const thread = &workers->threads[workers->thread_count];
        if (pthread_create(thread, NULL, work, workers) != 0) {
            view_workers_destroy(workers);
            return NULL;
        }
        workers->thread_count++;
    }
    return workers;
}

void view_workers_run(view_workers *workers, view_work_fn *function, void *user, uint32_t count,
                      uint32_t grain) {
    const job given = {.work = function, .user = user, .count = count, .grain = grain};
    if (count <= grain) {
        function(user, 0, count);
        return;
    }
    pthread_mutex_lock(&workers->mutex);
    workers->job = given;
    workers->job_number++;
    workers->busy_count = workers->thread_count;
    atomic_store(&workers->next, 0);
    pthread_cond_broadcast(&workers->started);
    pthread_mutex_unlock(&workers->mutex);

    do_ranges(workers, &given);
    pthread_mutex_lock(&workers->mutex);
    while (workers->busy_count > 0)
        pthread_cond_wait(&workers->finished, &workers->mutex);
    pthread_mutex_unlock(&workers->mutex);
}

void view_workers_destroy(view_workers *workers) {
    if (!workers) return;
    pthread_mutex_lock(&workers->mutex);
    workers->closing = true;
    pthread_cond_broadcast(&workers->started);
    pthread_mutex_unlock(&workers->mutex);
    for (uint32_t t = 0; t < workers->thread_count; t++)
        pthread_join(workers->threads[t], NULL);
    pthread_cond_destroy(&workers->started);
    pthread_cond_destroy(&workers->finished);
    pthread_mutex_destroy(&workers->mutex);
    free(workers);
}
