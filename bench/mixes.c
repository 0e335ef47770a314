/* SPDX-License-Identifier: MIT */
#include "mixes.h"

#include "bench.h"

#include "limn/format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

uint32_t bench_random(uint64_t *state, uint32_t bound) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((*state >> 32) * bound >> 32);
}

// -------------------------------------------------------------------------------------------------
// A torus of triangles. Half-edge 3 f + c runs from corner c of face f to the next one.

enum { VALENCE_MIN = 4, VALENCE_MAX = 9, FLIPS_PER_EDGE = 8 };

typedef struct torus {
    uint32_t side;
    uint32_t point_count, face_count;
    float *positions;
    uint32_t *corners;   ///< [3 * face_count]
    uint32_t *opposites; ///< [3 * face_count]
    uint32_t *valences;  ///< [point_count]
} torus;

static uint32_t next_edge(uint32_t edge) {
    return edge % 3 == 2 ? edge - 2 : edge + 1;
}

static uint32_t previous_edge(uint32_t edge) {
    return edge % 3 == 0 ? edge + 2 : edge - 1;
}

static uint32_t point_at(const torus *t, uint32_t x, uint32_t y) {
    return y % t->side * t->side + x % t->side;
}

static void place_points(torus *t) {
    const double turn = 6.283185307179586 / t->side;
    for (uint32_t p = 0; p < t->point_count; p++) {
        const double u = turn * (p % t->side), v = turn * (p / t->side);
        float *const position = &t->positions[3 * (size_t)p];
        position[0] = (float)((2 + cos(v)) * cos(u));
        position[1] = (float)((2 + cos(v)) * sin(u));
        position[2] = (float)sin(v);
        t->valences[p] = 6;
    }
}

/// Two triangles to a square: edge 0 of the lower one lies below, edge 1 to the right, edge 2 is
/// the diagonal; edge 0 of the upper one is the diagonal, edge 1 lies above, edge 2 to the left.
static void connect_square(torus *t, uint32_t x, uint32_t y) {
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

static void torus_destroy(torus *t) {
    free(t->positions);
    free(t->corners);
    free(t->opposites);
    free(t->valences);
}

static bool torus_create(torus *t, uint32_t side) {
    const uint32_t points = side * side;
    *t = (torus){.side = side, .point_count = points, .face_count = 2 * points};
    t->positions = malloc(3 * (size_t)points * sizeof *t->positions);
    t->corners = malloc(6 * (size_t)points * sizeof *t->corners);
    t->opposites = malloc(6 * (size_t)points * sizeof *t->opposites);
    t->valences = malloc(points * sizeof *t->valences);
    if (!t->positions || !t->corners || !t->opposites || !t->valences) return false;
    place_points(t);
    for (uint32_t p = 0; p < points; p++)
        connect_square(t, p % side, p / side);
    return true;
}

/// Whether an edge runs from the start of `edge` to `point`.
static bool has_edge_to(const torus *t, uint32_t edge, uint32_t point) {
    uint32_t around = edge;
    do {
        if (t->corners[next_edge(around)] == point) return true;
        around = t->opposites[previous_edge(around)];
    } while (around != edge);
    return false;
}

static void join(torus *t, uint32_t edge, uint32_t opposite) {
    t->opposites[edge] = opposite;
    t->opposites[opposite] = edge;
}

/// Replaces the diagonal ab of the quadrilateral a d b c by cd, where the valences allow it.
static void flip(torus *t, uint32_t edge) {
    const uint32_t other = t->opposites[edge];
    const uint32_t bc = next_edge(edge), ca = previous_edge(edge);
    const uint32_t ad = next_edge(other), db = previous_edge(other);
    const uint32_t a = t->corners[edge], b = t->corners[other];
    const uint32_t c = t->corners[ca], d = t->corners[db];
    if (t->valences[a] <= VALENCE_MIN || t->valences[b] <= VALENCE_MIN) return;
    if (t->valences[c] >= VALENCE_MAX || t->valences[d] >= VALENCE_MAX) return;
    if (c == d || has_edge_to(t, ca, d)) return;
    t->valences[a]--, t->valences[b]--, t->valences[c]++, t->valences[d]++;

    // The faces become d c a and c d b; the two outer edges that change their face move over.
    const uint32_t outer_ca = t->opposites[ca], outer_ad = t->opposites[ad];
    const uint32_t outer_bc = t->opposites[bc], outer_db = t->opposites[db];
    t->corners[edge] = d, t->corners[bc] = c, t->corners[ca] = a;
    t->corners[other] = c, t->corners[ad] = d, t->corners[db] = b;
    join(t, bc, outer_ca);
    join(t, ca, outer_ad);
    join(t, ad, outer_db);
    join(t, db, outer_bc);
}

static void shake(torus *t) {
    uint64_t state = 1;
    for (uint32_t f = 0; f < FLIPS_PER_EDGE * 3 * t->face_count; f++)
        flip(t, bench_random(&state, 3 * t->face_count));
}

// -------------------------------------------------------------------------------------------------
// Mixes

static bool add_normals(bench_mix *mix) {
    const limn_mesh *const mesh = &mix->mesh;
    mix->control_normals = malloc(3 * (size_t)mesh->normal_count * sizeof(float));
    if (!mix->control_normals) return false;
    limn_mesh_control_normals(mesh, mesh->controls, mix->control_normals);
    return true;
}

static bool open_mix(bench_mix *mix, const char *name, const void *blob, size_t size) {
    const limn_result result = limn_pack_open(&mix->pack, blob, size);
    if (result != LIMN_OK) {
        fprintf(stderr, "limn-bench: %s: %s\n", name, limn_result_text(result));
        return false;
    }
    if (mix->pack.mesh_count == 0) return false;
    snprintf(mix->name, sizeof mix->name, "%s", name);
    mix->mesh = limn_pack_mesh(&mix->pack, 0);
    if (mix->mesh.normals && !add_normals(mix)) return false;
    mix->patch_classes = malloc((mix->mesh.patch_count + 1) * sizeof *mix->patch_classes);
    for (uint32_t r = 0; r < mix->mesh.run_count && mix->patch_classes; r++) {
        const limn_file_run *const run = &mix->mesh.runs[r];
        for (uint32_t p = 0; p < run->patch_count; p++)
            mix->patch_classes[run->first_patch + p] = run->class_index;
    }
    return mix->patch_classes && mix->mesh.patch_count > 0;
}

/// Bakes what was added.
static bool bake_mix(bench_mix *mix, const char *name, limn_bake_status added) {
    const void *blob;
    size_t size;
    if (added == LIMN_BAKE_OK && limn_baker_finish(mix->baker, &blob, &size) == LIMN_BAKE_OK)
        return open_mix(mix, name, blob, size);
    fprintf(stderr, "limn-bench: %s\n", mix->baker ? limn_baker_error(mix->baker) : "no memory");
    return false;
}

static bool bake_torus(bench_mix *mix, const char *name, const torus *t, limn_isolate isolate) {
    const limn_bake_mesh mesh = {.name = name,
                                 .positions = t->positions,
                                 .position_count = t->point_count,
                                 .face_count = t->face_count,
                                 .face_indices = t->corners};
    mix->baker =
        limn_baker_create(&(limn_bake_desc){.normals = LIMN_NORMALS_EXACT, .isolate = isolate});
    return bake_mix(mix, name,
                    mix->baker ? limn_baker_add_mesh(mix->baker, &mesh) : LIMN_BAKE_MEMORY);
}

bool bench_mix_regular(bench_mix *mix, uint32_t side, limn_isolate isolate) {
    torus t;
    *mix = (bench_mix){0};
    const bool good = torus_create(&t, side) && bake_torus(mix, "regular", &t, isolate);
    torus_destroy(&t);
    return good;
}

bool bench_mix_worst(bench_mix *mix, uint32_t side, limn_isolate isolate) {
    torus t;
    *mix = (bench_mix){0};
    bool good = torus_create(&t, side);
    if (good) {
        shake(&t);
        good = bake_torus(mix, "worst", &t, isolate);
    }
    torus_destroy(&t);
    return good;
}

bool bench_mix_file(bench_mix *mix, const char *path, limn_isolate isolate) {
    char error[512];
    *mix = (bench_mix){0};
    const char *const slash = strrchr(path, '/');
    const char *const name = slash ? slash + 1 : path;
    const char *const dot = strrchr(name, '.');
    if (dot && strcmp(dot, ".limn") == 0) {
        if (limni_blob_file_open(&mix->file, path, error, sizeof error))
            return open_mix(mix, name, mix->file.bytes, mix->file.size);
        fprintf(stderr, "limn-bench: %s\n", error);
        return false;
    }
    mix->baker = limn_baker_create(&(limn_bake_desc){.normals = LIMN_NORMALS_EXACT,
                                                     .isolate = isolate,
                                                     .repair = LIMN_REPAIR_ALL,
                                                     .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                                                     .note = bench_note});
    return bake_mix(mix, name,
                    mix->baker ? limn_baker_add_file(mix->baker, path) : LIMN_BAKE_MEMORY);
}

void bench_mix_destroy(bench_mix *mix) {
    free(mix->patch_classes);
    free(mix->control_normals);
    if (mix->baker) limn_baker_destroy(mix->baker);
    if (mix->file.bytes) limni_blob_file_close(&mix->file);
}
