/* SPDX-License-Identifier: MIT */
/* A made-up piece of land: a height for each point of a grid, with boundaries all around. */
#ifndef BENCH_TERRAIN_H
#define BENCH_TERRAIN_H

#include <stdbool.h>
#include <stdint.h>

typedef struct bench_terrain {
    uint32_t point_count, face_count;
    float *positions;     ///< [point_count][3]: x and z from 0 to 1, y upwards
    uint32_t *face_sizes; ///< [face_count]
    uint32_t *corners;    ///< [face_count][face_size]
} bench_terrain;

/// `side` by `side` squares, as quads or each as two triangles. False: no memory. Destroy it all the
/// same.
bool bench_terrain_create(bench_terrain *t, uint32_t side, uint32_t face_size);
void bench_terrain_destroy(bench_terrain *t);

#endif
