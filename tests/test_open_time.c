/* SPDX-License-Identifier: MIT */
/* Opening a file takes time that is linear in its size. */
#include "packs.h"

#include <time.h>

enum { SMALL = 2000, TIMES = 8 };

/// A strip of triangles.
static blob bake_strip(uint32_t face_count) {
    const uint32_t position_count = face_count + 2;
    float *const positions = malloc(position_count * sizeof(float[3]));
    uint32_t *const faces = malloc(face_count * sizeof(uint32_t[3]));
    if (!positions || !faces) abort();
    for (uint32_t p = 0; p < position_count; p++) {
        positions[3 * p] = (float)(p / 2);
        positions[3 * p + 1] = (float)(p % 2);
        positions[3 * p + 2] = (float)(p % 5) * 0.125f;
    }
    for (uint32_t f = 0; f < face_count; f++) {
        const uint32_t corners[3] = {f, f + 1 + f % 2, f + 2 - f % 2};
        memcpy(faces + 3 * f, corners, sizeof corners);
    }
    const mesh_case strip_case = {.name = "strip",
                                  .positions = positions,
                                  .faces = faces,
                                  .position_count = position_count,
                                  .face_count = face_count};
    const blob file =
        bake_with(&(limn_bake_desc){.normals = LIMN_NORMALS_EXACT, .isolate = LIMN_ISOLATE_ALWAYS},
                  (const mesh_case *[]){&strip_case}, 1);
    free(positions);
    free(faces);
    return file;
}

/// The shortest of several times, of the processor's.
static double time_to_open(const blob *file) {
    double shortest = 1e9;
    for (int run = 0; run < 20; run++) {
        limn_pack pack;
        const clock_t start = clock();
        for (int repeat = 0; repeat < 10; repeat++)
            CHECK(limn_pack_open(&pack, file->bytes, file->size) == LIMN_OK);
        shortest = fmin(shortest, (double)(clock() - start));
    }
    return shortest / CLOCKS_PER_SEC / 10;
}

int main(void) {
    const blob small = bake_strip(SMALL), large = bake_strip(TIMES * SMALL);
    const double seconds[2] = {time_to_open(&small), time_to_open(&large)};
    const double sizes = (double)large.size / (double)small.size;
    CHECK(sizes > TIMES / 2);
    CHECK(seconds[1] < 3 * sizes * seconds[0]);
    printf("%zu and %zu bytes: %.3f and %.3f ms\n", small.size, large.size, 1e3 * seconds[0],
           1e3 * seconds[1]);
    free(small.bytes);
    free(large.bytes);
    return check_report();
}
