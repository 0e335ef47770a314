/* SPDX-License-Identifier: MIT */
#include "write_mesh.h"

void limni_write_off(const limni_source *source, FILE *stream) {
    fprintf(stream, "OFF\n%u %u 0\n", source->position_count, source->face_count);
    for (uint32_t p = 0; p < source->position_count; p++) {
        const float *const position = source->positions[p];
        fprintf(stream, "%.9g %.9g %.9g\n", (double)position[0], (double)position[1],
                (double)position[2]);
    }
    for (uint32_t face = 0; face < source->face_count; face++) {
        const uint32_t begin = source->face_offsets[face], end = source->face_offsets[face + 1];
        fprintf(stream, "%u", end - begin);
        for (uint32_t c = begin; c < end; c++)
            fprintf(stream, " %u", source->face_corners[c]);
        fputc('\n', stream);
    }
}
