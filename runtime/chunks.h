/* SPDX-License-Identifier: MIT */
/* The chunks of a file whose header and directory have been checked, and what checks share. */
#ifndef LIMNI_CHUNKS_H
#define LIMNI_CHUNKS_H

#include "limn/format.h"
#include "limn/limn.h"

#include <string.h>

#define TRY(call)                                                                                  \
    do {                                                                                           \
        const limn_result try_result = (call);                                                     \
        if (try_result != LIMN_OK) return try_result;                                              \
    } while (0)

static inline const unsigned char *bytes_at(const limn_pack *pack, uint64_t offset) {
    return (const unsigned char *)pack->blob + offset;
}

static inline const limn_file_header *header_of(const limn_pack *pack) {
    return (const limn_file_header *)pack->blob;
}

static inline const limn_file_chunk *directory_of(const limn_pack *pack) {
    return (const limn_file_chunk *)(const void *)bytes_at(pack, sizeof(limn_file_header));
}

static inline const limn_file_chunk *find_chunk(const limn_pack *pack, uint32_t mesh,
                                                uint32_t kind) {
    const limn_file_chunk *const chunks = directory_of(pack);
    const uint64_t key = limn_file_chunk_key(mesh, kind);
    uint32_t low = 0, high = header_of(pack)->chunk_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const uint64_t other = limn_file_chunk_key(chunks[middle].mesh, chunks[middle].kind);
        if (other == key) return &chunks[middle];
        if (other < key) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return NULL;
}

/// The start of a chunk that validation has found to be there.
static inline const void *chunk_data(const limn_pack *pack, uint32_t mesh, uint32_t kind) {
    return bytes_at(pack, find_chunk(pack, mesh, kind)->offset);
}

static inline const void *optional_data(const limn_pack *pack, uint32_t mesh, uint32_t kind) {
    const limn_file_chunk *const chunk = find_chunk(pack, mesh, kind);
    return chunk ? bytes_at(pack, chunk->offset) : NULL;
}

static inline bool chunk_has_size(const limn_pack *pack, uint32_t mesh, uint32_t kind,
                                  uint64_t count, size_t record_size) {
    const limn_file_chunk *const chunk = find_chunk(pack, mesh, kind);
    return chunk && chunk->size % record_size == 0 && chunk->size / record_size == count;
}

static inline bool all_finite(const float *values, size_t count) {
    uint32_t bad = 0;
    for (size_t v = 0; v < count; v++) {
        uint32_t bits;
        memcpy(&bits, &values[v], sizeof bits);
        bad |= (bits & 0x7f800000u) == 0x7f800000u;
    }
    return !bad;
}

#endif
