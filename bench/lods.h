/* SPDX-License-Identifier: MIT */
/* The ways to choose levels that are measured. A further one is one entry in lods.c. */
#ifndef BENCH_LODS_H
#define BENCH_LODS_H

#include "limn/limn.h"

typedef struct bench_lod {
    const char *name;
    limn_lod_desc desc;
} bench_lod;

extern const bench_lod bench_lods[];
extern const uint32_t bench_lod_count;

/// NULL: there is none of that name.
const bench_lod *bench_lod_find(const char *name);

#endif
