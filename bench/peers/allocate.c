/* SPDX-License-Identifier: MIT */
#include "allocate.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *bench_allocate(size_t count, size_t size) {
    const size_t byte_count = count > SIZE_MAX / 2 / size ? 0 : (count * size + 64) / 64 * 64;
    void *const bytes = byte_count ? aligned_alloc(64, byte_count) : NULL;
    if (!bytes) {
        fputs("limn-bench: out of memory\n", stderr);
        exit(1);
    }
    return memset(bytes, 0, byte_count);
}
