/* SPDX-License-Identifier: MIT */
#include "bench.h"

#include "limn/limn.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double seconds_of(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double bench_seconds(void) {
    return seconds_of(CLOCK_MONOTONIC);
}

double bench_thread_seconds(void) {
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

static int compare_doubles(const void *a, const void *b) {
    const double left = *(const double *)a, right = *(const double *)b;
    return (left > right) - (left < right);
}

uint32_t bench_random(uint64_t *state, uint32_t bound) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((*state >> 32) * bound >> 32);
}

double bench_median(double *values, uint32_t count) {
    qsort(values, count, sizeof *values, compare_doubles);
    return count % 2 ? values[count / 2] : (values[count / 2 - 1] + values[count / 2]) / 2;
}

double bench_percentile(double *values, uint32_t count, double share) {
    qsort(values, count, sizeof *values, compare_doubles);
    const uint32_t rank = (uint32_t)ceil(share * count);
    return values[rank > 0 ? rank - 1 : 0];
}

bool bench_results_open(limni_output_file *file, const char *path) {
    *file = (limni_output_file){0};
    if (!path || limni_output_open(file, path)) return true;
    fprintf(stderr, "limn-bench: %s: %s\n", path, file->error);
    return false;
}

bool bench_results_close(limni_output_file *file, const char *path, bool good) {
    if (!file->stream) return good;
    if (!good) {
        limni_output_abandon(file);
        return false;
    }
    if (limni_output_commit(file)) return true;
    fprintf(stderr, "limn-bench: %s: %s\n", path, file->error);
    return false;
}

void bench_note(void *user, const char *text) {
    (void)user;
    fprintf(stderr, "limn-bench: %s\n", text);
}

void bench_cpu_name(char *name, size_t size) {
    snprintf(name, size, "%s", "");
    char line[256];
    FILE *const file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof line, file)) {
        if (strncmp(line, "model name", 10) != 0) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(name, size, "%s", strchr(line, ':') + 2);
        break;
    }
    if (file) fclose(file);
}

void bench_print_conditions(FILE *stream) {
    char cpu[128];
    bench_cpu_name(cpu, sizeof cpu);
    fprintf(stream, "limn %d.%d.%d, commit %s, %s, flags %s, CPU %s\n", LIMN_VERSION_MAJOR,
            LIMN_VERSION_MINOR, LIMN_VERSION_PATCH, BENCH_COMMIT, BENCH_COMPILER, BENCH_FLAGS, cpu);
}
