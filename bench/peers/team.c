/* SPDX-License-Identifier: MIT */
#include "team.h"

#include "allocate.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct member {
    team *threads;
    pthread_t thread;
    uint32_t part;
} member;

struct team {
    pthread_mutex_t lock;
    pthread_cond_t begin, end;
    team_work *work;
    void *state;
    uint32_t count, running;
    uint64_t job; ///< counts the calls of team_run()
    bool quit;
    member *members; ///< [count - 1]
};

/// Waits for a job after `seen`. False: there will be none.
static bool wait_for_job(team *threads, uint64_t seen) {
    pthread_mutex_lock(&threads->lock);
    while (threads->job == seen && !threads->quit)
        pthread_cond_wait(&threads->begin, &threads->lock);
    const bool quit = threads->quit;
    pthread_mutex_unlock(&threads->lock);
    return !quit;
}

static void *serve(void *argument) {
    const member *const self = argument;
    team *const threads = self->threads;
    for (uint64_t job = 0; wait_for_job(threads, job); job++) {
        threads->work(threads->state, self->part, threads->count);
        pthread_mutex_lock(&threads->lock);
        if (--threads->running == 0) pthread_cond_signal(&threads->end);
        pthread_mutex_unlock(&threads->lock);
    }
    return NULL;
}

team *team_create(uint32_t count) {
    team *const threads = bench_allocate(1, sizeof *threads);
    threads->count = count;
    threads->members = bench_allocate(count, sizeof *threads->members);
    pthread_mutex_init(&threads->lock, NULL);
    pthread_cond_init(&threads->begin, NULL);
    pthread_cond_init(&threads->end, NULL);
    for (uint32_t part = 0; part + 1 < count; part++) {
        member *const self = &threads->members[part];
        self->threads = threads;
        self->part = part;
        if (pthread_create(&self->thread, NULL, serve, self) == 0) continue;
        fputs("limn-bench: cannot create a thread\n", stderr);
        exit(1);
    }
    return threads;
}

void team_destroy(team *threads) {
    pthread_mutex_lock(&threads->lock);
    threads->quit = true;
    pthread_cond_broadcast(&threads->begin);
    pthread_mutex_unlock(&threads->lock);
    for (uint32_t part = 0; part + 1 < threads->count; part++)
        pthread_join(threads->members[part].thread, NULL);
    pthread_cond_destroy(&threads->begin);
    pthread_cond_destroy(&threads->end);
    pthread_mutex_destroy(&threads->lock);
    free(threads->members);
    free(threads);
}

uint32_t team_size(const team *threads) {
    return threads->count;
}

void team_run(team *threads, team_work *work, void *state) {
    pthread_mutex_lock(&threads->lock);
    threads->work = work;
    threads->state = state;
    threads->running = threads->count - 1;
    threads->job++;
    pthread_cond_broadcast(&threads->begin);
    pthread_mutex_unlock(&threads->lock);
    work(state, threads->count - 1, threads->count);
    pthread_mutex_lock(&threads->lock);
    while (threads->running > 0)
        pthread_cond_wait(&threads->end, &threads->lock);
    pthread_mutex_unlock(&threads->lock);
}
