/* SPDX-License-Identifier: MIT */
/* Hashing for the baker's open-addressing tables. The same on every host. */
#ifndef LIMNI_HASH_H
#define LIMNI_HASH_H

#include <stdint.h>

static inline uint64_t limni_hash_mix(uint64_t hash, uint64_t value) {
    hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
    hash *= 0xD6E8FEB86659FD93u;
    return hash ^ hash >> 32;
}

/// An edge, whatever its direction. 0 only if both ends are control point 0.
static inline uint64_t limni_edge_key(uint32_t a, uint32_t b) {
    return a < b ? (uint64_t)b << 32 | a : (uint64_t)a << 32 | b;
}

/// A power of two, at least twice `count`, for `count` up to 2^30.
static inline uint32_t limni_hash_size(uint32_t count) {
    uint32_t size = 16;
    while (size / 2 < count)
        size *= 2;
    return size;
}

#endif
