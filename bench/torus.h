/* SPDX-License-Identifier: MIT */
/* A torus of triangles or of quads: regular, or with edges turned at random. */
#ifndef BENCH_TORUS_H
#define BENCH_TORUS_H

#include <stdbool.h>
#include <stdint.h>

/// Half-edge `face_size` * f + c runs from corner c of face f to the next one.
typedef struct bench_torus {
    uint32_t side;      ///< the control points are a grid of as many by as many
    uint32_t face_size; ///< 3 or 4
    uint32_t point_count, face_count;
    float *positions;     ///< [3 * point_count]
    uint32_t *face_sizes; ///< [face_count]
    uint32_t *corners;    ///< [face_size * face_count]
    uint32_t *opposites;  ///< [face_size * face_count]
    uint32_t *valences;   ///< [point_count]
} bench_torus;

/// Faces of a torus.
uint32_t bench_torus_faces(uint32_t side, uint32_t face_size);

/// All of one valence. False: no memory. Destroy it all the same.
bool bench_torus_create(bench_torus *t, uint32_t side, uint32_t face_size);
void bench_torus_destroy(bench_torus *t);

/// Turns edges at random; valences stay between 4 and 9, of quads between 3 and 7.
void bench_torus_shake(bench_torus *t);

#endif
