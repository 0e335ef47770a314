/* SPDX-License-Identifier: MIT */
/*
 * From planes of words to the caller's memory, which may be write-combined: each byte is written
 * once, going forward, and nothing is read.
 */
#ifndef STORES_H
#define STORES_H

#include "sums.h"

#include <string.h>

enum { PARTS_MAX = 3, WORDS_MAX = 7, VERTEX_MAX = 4 * WORDS_MAX };

/// Consecutive bytes of each vertex.
typedef struct part {
    size_t planes[WORDS_MAX]; ///< where in the scratch of a patch, in floats
    size_t word_count;
    size_t size;        ///< bytes: 4 for each word, or 2
    unsigned char *dst; ///< of the first vertex of the run
    size_t stride;      ///< bytes from vertex to vertex
} part;

static inline void store_vertex(const part *p, const float *rows, unsigned char *base, size_t row) {
    unsigned char *const dst = base + row * p->stride;
    if (p->size == 2) {
        memcpy(dst, rows + p->planes[0] + row,
               2); // the lower half: files are little-endian, and so is this
        return;
    }
    for (size_t w = 0; w < p->word_count; w++)
        memcpy(dst + 4 * w, rows + p->planes[w] + row, 4);
}

/// Four vertices of six words behind one another: positions and normals.
static inline void store_four_dense(const part *p, const float *rows, unsigned char *base,
                                    size_t row) {
    quad w[6], pairs[3][2];
    for (int i = 0; i < 6; i++)
        w[i] = quad_load(rows + p->planes[i] + row);
    for (int i = 0; i < 3; i++) {
        pairs[i][0] = quad_zip_low(w[2 * i], w[2 * i + 1]);
        pairs[i][1] = quad_zip_high(w[2 * i], w[2 * i + 1]);
    }
    unsigned char *dst = base + row * p->stride;
    for (int half = 0; half < 2; half++, dst += 48) {
        quad_store(dst, quad_low_low(pairs[0][half], pairs[1][half]));
        quad_store(dst + 16, quad_low_high(pairs[2][half], pairs[0][half]));
        quad_store(dst + 32, quad_high_high(pairs[1][half], pairs[2][half]));
    }
}

/// Four vertices of four words or more.
static inline void store_four(const part *p, const float *rows, unsigned char *base, size_t row) {
    quad w[4];
    for (int i = 0; i < 4; i++)
        w[i] = quad_load(rows + p->planes[i] + row);
    const quad ab[2] = {quad_zip_low(w[0], w[1]), quad_zip_high(w[0], w[1])};
    const quad cd[2] = {quad_zip_low(w[2], w[3]), quad_zip_high(w[2], w[3])};
    unsigned char *dst = base + row * p->stride;
    for (size_t v = 0; v < 4; v++, dst += p->stride) {
        const quad first =
            v % 2 ? quad_high_high(ab[v / 2], cd[v / 2]) : quad_low_low(ab[v / 2], cd[v / 2]);
        quad_store(dst, first);
        for (size_t i = 4; i < p->word_count; i++)
            memcpy(dst + 4 * i, rows + p->planes[i] + row + v, 4);
    }
}

/// Four rows at a time. Returns the first that is left.
static inline size_t store_fours(const part *p, const float *rows, unsigned char *base,
                                 size_t row_count) {
    size_t row = 0;
    if (p->word_count == 6 && p->size == p->stride) {
        for (; row + 4 <= row_count; row += 4)
            store_four_dense(p, rows, base, row);
    } else if (p->word_count >= 4) {
        for (; row + 4 <= row_count; row += 4)
            store_four(p, rows, base, row);
    }
    return row;
}

/// Vertices of one to three words behind one another, a vector of them at a time. A loop each: the
/// words would be counted again for every row.
static LIMNI_INLINE void store_words(const part *p, size_t word_count, const float *rows,
                                     unsigned char *base, size_t row_count) {
    const float *const x = rows + p->planes[0];
    const float *const y = rows + p->planes[1], *const z = rows + p->planes[2];
    float *dst = (float *)(void *)base;
    size_t row = 0;
    for (; row + LANES_WIDTH <= row_count; row += LANES_WIDTH, dst += word_count * LANES_WIDTH) {
        if (word_count == 3) {
            lanes_store_xyz(dst, lanes_load_any(x + row), lanes_load_any(y + row),
                            lanes_load_any(z + row));
        } else if (word_count == 2) {
            lanes_store_xy(dst, lanes_load_any(x + row), lanes_load_any(y + row));
        } else {
            lanes_store(dst, lanes_load_any(x + row));
        }
    }
    for (; row < row_count; row++, dst += word_count) {
        dst[0] = x[row];
        if (word_count > 1) dst[1] = y[row];
        if (word_count > 2) dst[2] = z[row];
    }
}

static inline void store_dense(const part *p, const float *rows, unsigned char *base,
                               size_t row_count) {
    switch (p->word_count) {
    case 1:
        store_words(p, 1, rows, base, row_count);
        break;
    case 2:
        store_words(p, 2, rows, base, row_count);
        break;
    default:
        store_words(p, 3, rows, base, row_count);
        break;
    }
}

/// All rows of a patch.
///
/// rows  its scratch
/// base  where its first row goes
static inline void store_rows(const part *p, const float *rows, unsigned char *base,
                              size_t row_count) {
    const bool few = p->word_count <= 3 && p->size == 4 * p->word_count && p->size == p->stride;
    if (few) {
        store_dense(p, rows, base, row_count);
        return;
    }
    for (size_t row = store_fours(p, rows, base, row_count); row < row_count; row++)
        store_vertex(p, rows, base, row);
}

/// The parts of the vertices: positions, and perhaps normals and colours. Those that lie in the same
/// vertices, with bytes of the caller's between them, are consecutive and in the order of memory.
typedef struct parts {
    part items[PARTS_MAX];
    bool follows[PARTS_MAX]; ///< the part lies in the vertices of the one before
    int count;
    size_t first; ///< vertex of the patch, in the run
} parts;

static inline unsigned char *base_of(const parts *p, int item) {
    return p->items[item].dst + p->first * p->items[item].stride;
}

/// Appends b to a, if it lies right behind it in the same vertices.
static inline bool join(part *a, const part *b) {
    if (a->dst + a->size != b->dst || a->size % 4 != 0 || b->size % 4 != 0) return false;
    for (size_t w = 0; w < b->word_count; w++)
        a->planes[a->word_count++] = b->planes[w];
    a->size += b->size;
    return true;
}

static inline bool share_vertices(const part *a, const part *b) {
    const uintptr_t distance = (uintptr_t)b->dst - (uintptr_t)a->dst;
    return a->stride == b->stride && (distance < a->stride || -distance < a->stride);
}

/// Puts a part beside those in the same vertices, in the order of memory, or behind all.
static inline void add_part(parts *p, const part *added) {
    int at = p->count;
    for (int i = p->count - 1; i >= 0; i--) {
        if (!share_vertices(&p->items[i], added)) continue;
        at = p->items[i].dst < added->dst ? i + 1 : i;
        if (at > i) break;
    }
    for (int i = p->count++; i > at; i--)
        p->items[i] = p->items[i - 1];
    p->items[at] = *added;
}

/// Makes one part of those that lie right behind one another, and finds which follow which.
static inline void join_parts(parts *p) {
    int count = 1;
    for (int i = 1; i < p->count; i++) {
        const bool shared = share_vertices(&p->items[count - 1], &p->items[i]);
        if (shared && join(&p->items[count - 1], &p->items[i])) continue;
        p->follows[count] = shared;
        p->items[count++] = p->items[i];
    }
    p->count = count;
}

/// The first part that does not follow part `i`.
static inline int end_of(const parts *p, int i) {
    for (i++; i < p->count && p->follows[i];)
        i++;
    return i;
}

/// Parts [begin, end) of the same vertices.
static inline void store_apart(const parts *p, int begin, int end, const float *rows,
                               size_t row_count) {
    for (size_t row = 0; row < row_count; row++) {
        for (int i = begin; i < end; i++)
            store_vertex(&p->items[i], rows, base_of(p, i), row);
    }
}

static inline void store_parts(const parts *p, const float *rows, size_t row_count) {
    for (int i = 0, end; i < p->count; i = end) {
        end = end_of(p, i);
        if (end > i + 1) {
            store_apart(p, i, end, rows, row_count);
        } else {
            store_rows(&p->items[i], rows, base_of(p, i), row_count);
        }
    }
}

/// All rows past the caches, by way of L1. There is no such way where the caller has bytes of his
/// own between the vertices, nor for elements of two bytes.
static inline void stream_parts(const parts *p, const float *rows, size_t row_count) {
    _Alignas(64) unsigned char staging[LIMNI_PADDED_ROWS_MAX * VERTEX_MAX];
    for (int i = 0, end; i < p->count; i = end) {
        const part *const item = &p->items[i];
        end = end_of(p, i);
        if (end > i + 1) {
            store_apart(p, i, end, rows, row_count);
        } else if (item->size != item->stride || item->size % 4 != 0) {
            store_rows(item, rows, base_of(p, i), row_count);
        } else {
            store_rows(item, rows, staging, row_count);
            lanes_stream(base_of(p, i), staging, row_count * item->size);
        }
    }
}

#endif
