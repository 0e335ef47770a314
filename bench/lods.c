/* SPDX-License-Identifier: MIT */
#include "lods.h"

#include <string.h>

const bench_lod bench_lods[] = {
    {"uniform", {.lod = LIMN_LOD_UNIFORM, .level = 2.5f}},
    {"length", {.lod = LIMN_LOD_LENGTH, .pixels = 8}},
    {"error", {.lod = LIMN_LOD_ERROR, .pixels = 1}},
};

const uint32_t bench_lod_count = sizeof bench_lods / sizeof *bench_lods;

const bench_lod *bench_lod_find(const char *name) {
    for (uint32_t k = 0; k < bench_lod_count; k++) {
        if (strcmp(bench_lods[k].name, name) == 0) return &bench_lods[k];
    }
    return NULL;
}
