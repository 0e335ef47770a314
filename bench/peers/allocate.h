/* SPDX-License-Identifier: MIT */
#ifndef BENCH_ALLOCATE_H
#define BENCH_ALLOCATE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Zeroed memory, aligned to 64 bytes, for free(). Ends the program when there is none.
void *bench_allocate(size_t count, size_t size);

#ifdef __cplusplus
}
#endif

#endif
