/* SPDX-License-Identifier: MIT */
#include "torus.h"

#include "bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TURNS_PER_EDGE = 8 };

uint32_t bench_torus_faces(uint32_t side, uint32_t face_size) {
    return side * side * (face_size == 3 ? 2 : 1);
}

static uint32_t next_edge(const bench_torus *t, uint32_t edge) {
    return edge % t->face_size == t->face_size - 1 ? edge - (t->face_size - 1) : edge + 1;
}

static uint32_t previous_edge(const bench_torus *t, uint32_t edge) {
    return edge % t->face_size == 0 ? edge + t->face_size - 1 : edge - 1;
}

// ---- The regular torus

static uint32_t point_at(const bench_torus *t, uint32_t x, uint32_t y) {
    return y % t->side * t->side + x % t->side;
}

static void place_points(bench_torus *t) {
    const double turn = 6.283185307179586 / t->side;
    for (uint32_t p = 0; p < t->point_count; p++) {
        const double u = turn * (p % t->side), v = turn * (p / t->side);
        float *const position = &t->positions[3 * (size_t)p];
        position[0] = (float)((2 + cos(v)) * cos(u));
        position[1] = (float)((2 + cos(v)) * sin(u));
        position[2] = (float)sin(v);
        t->valences[p] = t->face_size == 3 ? 6 : 4;
    }
}

/// Two triangles to a square: edge 0 of the lower one lies below, edge 1 to the right, edge 2 is
/// the diagonal; edge 0 of the upper one is the diagonal, edge 1 lies above, edge 2 to the left.
static void connect_triangles(bench_torus *t, uint32_t x, uint32_t y) {
    const uint32_t side = t->side;
    const uint32_t lower = 6 * point_at(t, x, y), upper = lower + 3;
    const uint32_t a = point_at(t, x, y), b = point_at(t, x + 1, y);
    const uint32_t c = point_at(t, x + 1, y + 1), d = point_at(t, x, y + 1);
    memcpy(&t->corners[lower], (uint32_t[]){a, b, c, a, c, d}, 6 * sizeof *t->corners);
    t->opposites[lower] = 6 * point_at(t, x, y + side - 1) + 4;
    t->opposites[lower + 1] = 6 * point_at(t, x + 1, y) + 5;
    t->opposites[lower + 2] = upper;
    t->opposites[upper] = lower + 2;
    t->opposites[upper + 1] = 6 * point_at(t, x, y + 1);
    t->opposites[upper + 2] = 6 * point_at(t, x + side - 1, y) + 1;
}

/// Edge 0 lies below, edge 1 to the right, edge 2 above, edge 3 to the left.
static void connect_quad(bench_torus *t, uint32_t x, uint32_t y) {
    const uint32_t side = t->side, quad = 4 * point_at(t, x, y);
    t->corners[quad] = point_at(t, x, y);
    t->corners[quad + 1] = point_at(t, x + 1, y);
    t->corners[quad + 2] = point_at(t, x + 1, y + 1);
    t->corners[quad + 3] = point_at(t, x, y + 1);
    t->opposites[quad] = 4 * point_at(t, x, y + side - 1) + 2;
    t->opposites[quad + 1] = 4 * point_at(t, x + 1, y) + 3;
    t->opposites[quad + 2] = 4 * point_at(t, x, y + 1);
    t->opposites[quad + 3] = 4 * point_at(t, x + side - 1, y) + 1;
}

bool bench_torus_create(bench_torus *t, uint32_t side, uint32_t face_size) {
    const uint32_t points = side * side, faces = bench_torus_faces(side, face_size);
    const size_t edges = (size_t)faces * face_size;
    *t = (bench_torus){
        .side = side, .face_size = face_size, .point_count = points, .face_count = faces};
    t->positions = malloc(3 * (size_t)points * sizeof *t->positions);
    t->face_sizes = malloc(faces * sizeof *t->face_sizes);
    t->corners = malloc(edges * sizeof *t->corners);
    t->opposites = malloc(edges * sizeof *t->opposites);
    t->valences = malloc(points * sizeof *t->valences);
    if (!t->positions || !t->face_sizes || !t->corners || !t->opposites || !t->valences)
        return false;
    place_points(t);
    for (uint32_t f = 0; f < faces; f++)
        t->face_sizes[f] = face_size;
    for (uint32_t p = 0; p < points; p++)
        (face_size == 3 ? connect_triangles : connect_quad)(t, p % side, p / side);
    return true;
}

void bench_torus_destroy(bench_torus *t) {
    free(t->positions);
    free(t->face_sizes);
    free(t->corners);
    free(t->opposites);
    free(t->valences);
}

// ---- Turning edges

/// Whether an edge runs from the start of `edge` to `point`.
static bool has_edge_to(const bench_torus *t, uint32_t edge, uint32_t point) {
    uint32_t around = edge;
    do {
        if (t->corners[next_edge(t, around)] == point) return true;
        around = t->opposites[previous_edge(t, around)];
    } while (around != edge);
    return false;
}

static void join(bench_torus *t, uint32_t edge, uint32_t opposite) {
    t->opposites[edge] = opposite;
    t->opposites[opposite] = edge;
}

enum { RING_MAX = 6 };

/// The other edges of the two faces on an edge, in order around both: first those of its own face.
static void list_ring(const bench_torus *t, uint32_t edge, uint32_t ring[RING_MAX]) {
    const uint32_t other = t->opposites[edge], half = t->face_size - 1;
    ring[0] = next_edge(t, edge);
    ring[half] = next_edge(t, other);
    for (uint32_t k = 1; k < half; k++) {
        ring[k] = next_edge(t, ring[k - 1]);
        ring[half + k] = next_edge(t, ring[half + k - 1]);
    }
}

/// Turns an edge by one step around its two faces, where the valences allow it: each of its ends
/// moves to the next corner, and each edge of the ring to the place of the one before.
static void turn_edge(bench_torus *t, uint32_t edge) {
    const uint32_t least = t->face_size == 3 ? 4 : 3, most = t->face_size == 3 ? 9 : 7;
    const uint32_t other = t->opposites[edge], count = 2 * (t->face_size - 1);
    uint32_t ring[RING_MAX], corners[RING_MAX], opposites[RING_MAX];
    list_ring(t, edge, ring);
    const uint32_t a = t->corners[edge], b = t->corners[other];
    const uint32_t c = t->corners[ring[1]], d = t->corners[ring[count / 2 + 1]];
    if (t->valences[a] <= least || t->valences[b] <= least) return;
    if (t->valences[c] >= most || t->valences[d] >= most) return;
    if (c == d || has_edge_to(t, ring[1], d)) return;
    t->valences[a]--, t->valences[b]--, t->valences[c]++, t->valences[d]++;

    for (uint32_t k = 0; k < count; k++) {
        corners[k] = t->corners[ring[(k + 1) % count]];
        opposites[k] = t->opposites[ring[(k + 1) % count]];
    }
    for (uint32_t k = 0; k < count; k++) {
        t->corners[ring[k]] = corners[k];
        join(t, ring[k], opposites[k]);
    }
    t->corners[edge] = d;
    t->corners[other] = c;
}

void bench_torus_shake(bench_torus *t) {
    const uint32_t edges = t->face_size * t->face_count;
    uint64_t state = 1;
    for (uint32_t turn = 0; turn < TURNS_PER_EDGE * edges; turn++)
        turn_edge(t, bench_random(&state, edges));
}
