/* SPDX-License-Identifier: MIT */
#include "terrain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Waves, of which each is shorter and lower than the one before and runs another way.
static float find_height(float x, float z) {
    float height = 0, size = 0.06f, frequency = 7;
    for (int octave = 0; octave < 5; octave++) {
        const float turn = 1.9f * (float)octave;
        const float along = cosf(turn) * x + sinf(turn) * z,
                    across = cosf(turn) * z - sinf(turn) * x;
        height += size * sinf(frequency * along + turn) * cosf(0.8f * frequency * across);
        size *= 0.5f;
        frequency *= 2.1f;
    }
    return height;
}

static void place_points(bench_terrain *t, uint32_t side) {
    for (uint32_t p = 0; p < t->point_count; p++) {
        const float x = (float)(p % (side + 1)) / (float)side;
        const float z = (float)(p / (side + 1)) / (float)side;
        const float position[3] = {x, find_height(x, z), z};
        memcpy(t->positions + (size_t)3 * p, position, sizeof position);
    }
}

static void join_points(bench_terrain *t, uint32_t side, uint32_t face_size) {
    uint32_t *corner = t->corners;
    for (uint32_t square = 0; square < side * side; square++) {
        const uint32_t a = square % side + square / side * (side + 1), c = a + side + 2;
        const uint32_t triangles[6] = {a, a + side + 1, c, a, c, a + 1};
        const uint32_t quad[4] = {a, a + side + 1, c, a + 1};
        const uint32_t count = face_size == 3 ? 6 : 4;
        memcpy(corner, face_size == 3 ? triangles : quad, count * sizeof *corner);
        corner += count;
    }
    for (uint32_t f = 0; f < t->face_count; f++)
        t->face_sizes[f] = face_size;
}

bool bench_terrain_create(bench_terrain *t, uint32_t side, uint32_t face_size) {
    *t = (bench_terrain){.point_count = (side + 1) * (side + 1),
                         .face_count = side * side * (face_size == 3 ? 2 : 1)};
    t->positions = malloc(t->point_count * sizeof(float[3]));
    t->face_sizes = malloc(t->face_count * sizeof *t->face_sizes);
    t->corners = malloc((size_t)t->face_count * face_size * sizeof *t->corners);
    if (!t->positions || !t->face_sizes || !t->corners) return false;
    place_points(t, side);
    join_points(t, side, face_size);
    return true;
}

void bench_terrain_destroy(bench_terrain *t) {
    free(t->positions);
    free(t->face_sizes);
    free(t->corners);
}
