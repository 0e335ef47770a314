/* SPDX-License-Identifier: MIT */
#include "write_mesh.h"

static uint32_t largest_face(const limni_source *source) {
    uint32_t largest = 0;
    for (uint32_t face = 0; face < source->face_count; face++) {
        const uint32_t size = source->face_offsets[face + 1] - source->face_offsets[face];
        if (size > largest) largest = size;
    }
    return largest;
}

void limni_write_ply(const limni_source *source, FILE *stream) {
    const bool narrow = largest_face(source) <= UINT8_MAX;
    fprintf(stream,
            "ply\nformat binary_little_endian 1.0\nelement vertex %u\n"
            "property float x\nproperty float y\nproperty float z\nelement face %u\n"
            "property list %s uint vertex_indices\nend_header\n",
            source->position_count, source->face_count, narrow ? "uchar" : "uint");
    fwrite(source->positions, sizeof *source->positions, source->position_count, stream);
    for (uint32_t face = 0; face < source->face_count; face++) {
        const uint32_t begin = source->face_offsets[face];
        const uint32_t size = source->face_offsets[face + 1] - begin;
        const uint8_t byte = (uint8_t)size;
        fwrite(narrow ? (const void *)&byte : &size, narrow ? 1 : sizeof size, 1, stream);
        fwrite(source->face_corners + begin, sizeof(uint32_t), size, stream);
    }
}
