/* SPDX-License-Identifier: MIT */
#include "checksum.h"

#include <string.h>

static const uint64_t prime_1 = 0x9E3779B185EBCA87u, prime_2 = 0xC2B2AE3D27D4EB4Fu,
                      prime_3 = 0x165667B19E3779F9u, prime_4 = 0x85EBCA77C2B2AE63u,
                      prime_5 = 0x27D4EB2F165667C5u;

static inline uint64_t rotate(uint64_t value, int bits) {
    return value << bits | value >> (64 - bits);
}

static inline uint64_t read_64(const unsigned char *src) {
    uint64_t value;
    memcpy(&value, src, sizeof value);
    return value;
}

static inline uint32_t read_32(const unsigned char *src) {
    uint32_t value;
    memcpy(&value, src, sizeof value);
    return value;
}

static inline uint64_t mix(uint64_t lane, uint64_t input) {
    return rotate(lane + input * prime_2, 31) * prime_1;
}

static inline uint64_t merge(uint64_t hash, uint64_t lane) {
    return (hash ^ mix(0, lane)) * prime_1 + prime_4;
}

static uint64_t avalanche(uint64_t hash) {
    hash = (hash ^ hash >> 33) * prime_2;
    hash = (hash ^ hash >> 29) * prime_3;
    return hash ^ hash >> 32;
}

static uint64_t finish(uint64_t hash, const unsigned char *src, size_t size) {
    for (; size >= 8; src += 8, size -= 8)
        hash = rotate(hash ^ mix(0, read_64(src)), 27) * prime_1 + prime_4;
    for (; size >= 4; src += 4, size -= 4)
        hash = rotate(hash ^ read_32(src) * prime_1, 23) * prime_2 + prime_3;
    for (; size > 0; src++, size--)
        hash = rotate(hash ^ *src * prime_5, 11) * prime_1;
    return avalanche(hash);
}

uint64_t limni_checksum(const void *data, size_t size) {
    const unsigned char *src = data;
    uint64_t hash = prime_5;
    size_t rest = size;
    if (size >= 32) {
        uint64_t a = prime_1 + prime_2, b = prime_2, c = 0, d = 0 - prime_1;
        for (; rest >= 32; src += 32, rest -= 32) {
            a = mix(a, read_64(src));
            b = mix(b, read_64(src + 8));
            c = mix(c, read_64(src + 16));
            d = mix(d, read_64(src + 24));
        }
        hash = rotate(a, 1) + rotate(b, 7) + rotate(c, 12) + rotate(d, 18);
        hash = merge(merge(merge(merge(hash, a), b), c), d);
    }
    return finish(hash + size, src, rest);
}
