/* SPDX-License-Identifier: MIT */
/*
 * From the rows of one patch to what a vertex holds: planes of 32-bit words, one word for each row.
 * Integers are found without conversions, which every instruction set does its own way: adding a
 * number with the right exponent rounds to a whole number (halves to even) and leaves it in the
 * lower bits. All loops go on to the end of a vector.
 */
#ifndef FORMATS_H
#define FORMATS_H

#include "sums.h"

#include <float.h>
#include <string.h>

/// Between low and high; NaN becomes low.
static inline lanes clamp(lanes a, lanes low, lanes high) {
    return lanes_min(lanes_max(a, low), high);
}

/// 0 to `limit` in the lower bits.
static inline lanes quantise_unsigned(lanes a, float limit) {
    return lanes_add(clamp(a, lanes_zero(), lanes_splat(limit)), lanes_splat(0x1p23f));
}

/// -limit to limit, in two's complement, for a between -1 and 1.
static inline lanes quantise_signed(lanes a, float limit) {
    const lanes clamped = clamp(a, lanes_splat(-1.0f), lanes_splat(1.0f));
    return lanes_add(lanes_multiply(clamped, lanes_splat(limit)), lanes_splat(0x1.8p23f));
}

/// A coordinate in its box, from 0 to 65535.
static inline lanes quantise_in_box(const limni_target *target, const vectors *rows, int axis,
                                    size_t row) {
    const lanes from_box =
        lanes_subtract(lanes_load_any(&rows->axes[axis][row]), lanes_splat(target->box_min[axis]));
    return quantise_unsigned(lanes_multiply(from_box, lanes_splat(target->box_scale[axis])),
                             65535.0f);
}

/// Two planes: x and y, z and 65535.
static inline void pack_unorm16x4(const limni_target *target, size_t row_count, vectors *rows) {
    const lanes one = lanes_splat(0x1p23f + 65535.0f);
    for (size_t row = 0; row < row_count; row += LANES_WIDTH) {
        const lanes x = quantise_in_box(target, rows, 0, row);
        const lanes y = quantise_in_box(target, rows, 1, row);
        const lanes z = quantise_in_box(target, rows, 2, row);
        lanes_store(&rows->axes[0][row], lanes_join(x, y, 16));
        lanes_store(&rows->axes[1][row], lanes_join(z, one, 16));
    }
}

/// One plane: x and y.
static inline void pack_unorm16x2(const limni_target *target, size_t row_count, vectors *rows) {
    for (size_t row = 0; row < row_count; row += LANES_WIDTH) {
        const lanes x = quantise_in_box(target, rows, 0, row);
        const lanes y = quantise_in_box(target, rows, 1, row);
        lanes_store(&rows->axes[0][row], lanes_join(x, y, 16));
    }
}

/// One plane: red, green and blue from 0 to 255, and 255.
static inline void pack_rgba8(size_t row_count, vectors *rows) {
    const lanes limit = lanes_splat(255.0f), one = lanes_splat(0x1p23f + 255.0f);
    for (size_t row = 0; row < row_count; row += LANES_WIDTH) {
        lanes packed[3];
        for (int axis = 0; axis < 3; axis++)
            packed[axis] = quantise_unsigned(
                lanes_multiply(lanes_load_any(&rows->axes[axis][row]), limit), 255.0f);
        const lanes xy = lanes_join(packed[0], packed[1], 8), zw = lanes_join(packed[2], one, 8);
        lanes_store(&rows->axes[0][row], lanes_join(xy, zw, 16));
    }
}

// ---- Halves

static inline uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/// The nearest half, of two the even one; too large numbers become the largest. In whole numbers,
/// without branches: compilers make vectors of it.
static inline uint32_t half_of(float value) {
    enum { LARGEST = 0x477fe000, LEAST_NORMAL = 0x38800000, BIAS = 112 << 23, HALF_ULP = 0xfff };
    const uint32_t bits = bits_of(value), size = bits & 0x7fffffffu;
    const uint32_t kept = size < LARGEST ? size : LARGEST;
    const uint32_t normal = (kept - BIAS + HALF_ULP + (kept >> 13 & 1)) >> 13;
    // Adding 1/2 rounds to its last bit, which is that of a denormal half.
    const uint32_t tiny = bits_of((value < 0 ? -value : value) + 0.5f) - bits_of(0.5f);
    return (bits >> 16 & 0x8000u) | (kept < LEAST_NORMAL ? tiny : normal);
}

/// One plane: x and y.
static inline void pack_half2(size_t row_count, vectors *rows) {
    for (size_t row = 0; row < row_count; row++) {
        const uint32_t word = half_of(rows->axes[0][row]) | half_of(rows->axes[1][row]) << 16;
        memcpy(&rows->axes[0][row], &word, sizeof word);
    }
}

static inline void pack_positions(const limni_target *target, size_t row_count, vectors *rows) {
    switch (target->format) {
    case LIMNI_UNORM16X4:
        pack_unorm16x4(target, row_count, rows);
        break;
    case LIMNI_UNORM16X2:
        pack_unorm16x2(target, row_count, rows);
        break;
    case LIMNI_HALF2:
        pack_half2(row_count, rows);
        break;
    case LIMNI_RGBA8:
        pack_rgba8(row_count, rows);
        break;
    default:
        break;
    }
}

// ---- Normals

/// 1 / sqrt(a) for normal a, within 3 units in the last place: a guess from the bits (Lomont, "Fast
/// inverse square root", 2003) and three steps of Newton's iteration. Cheaper than a root and a
/// division, and the same everywhere.
#define LEAST_SQUARE                                                                               \
    (2 * FLT_MIN) ///< for which no step is denormal, as those may be flushed to zero
#define MOST_SQUARE 0x1p126f
enum { INVERSE_ROOT_BITS = 0x5f375a86, INVERSE_ROOT_STEPS = 3 };
static inline lanes inverse_root(lanes a) {
    const lanes half = lanes_multiply(a, lanes_splat(0.5f)), three_halves = lanes_splat(1.5f);
    lanes root = lanes_less_half_bits(INVERSE_ROOT_BITS, a);
    for (int step = 0; step < INVERSE_ROOT_STEPS; step++) {
        const lanes square = lanes_multiply(root, root);
        root = lanes_multiply(root, lanes_subtract(three_halves, lanes_multiply(half, square)));
    }
    return root;
}

/// Makes vectors unit vectors without a -0; those too short or too long to be squared become
/// (0, 0, 1).
static inline void make_unit_normals(lanes *x, lanes *y, lanes *z) {
    const lanes zero = lanes_zero(), one = lanes_splat(1.0f);
    const lanes least = lanes_splat(LEAST_SQUARE), most = lanes_splat(MOST_SQUARE);
    const lanes square = lanes_add(lanes_add(lanes_multiply(*x, *x), lanes_multiply(*y, *y)),
                                   lanes_multiply(*z, *z));
    const lanes root = inverse_root(square);
    const lanes scale =
        lanes_select_greater(square, least, lanes_select_greater(most, square, root, zero), zero);
    const lanes u = lanes_add(lanes_multiply(*x, scale), zero);
    const lanes v = lanes_add(lanes_multiply(*y, scale), zero);
    const lanes w = lanes_add(lanes_multiply(*z, scale), zero);
    *x = lanes_select_greater(scale, zero, u, zero);
    *y = lanes_select_greater(scale, zero, v, zero);
    *z = lanes_select_greater(scale, zero, w, one);
}

/// Unit normals from the two tangents of rows [row, row + count), in place of the first. Along a
/// shared edge the neighbour has both tangents negated, bit for bit, so that products, and all that
/// follows, are the same but for the signs of zeros; make_unit_normals() makes those alike.
static inline void find_normals(const vectors *across, size_t row, size_t count, vectors *along) {
    for (const size_t end = row + count; row < end; row += LANES_WIDTH) {
        const lanes ax = lanes_load_any(&along->axes[0][row]);
        const lanes ay = lanes_load_any(&along->axes[1][row]);
        const lanes az = lanes_load_any(&along->axes[2][row]);
        const lanes bx = lanes_load_any(&across->axes[0][row]);
        const lanes by = lanes_load_any(&across->axes[1][row]);
        const lanes bz = lanes_load_any(&across->axes[2][row]);
        lanes x = lanes_subtract(lanes_multiply(ay, bz), lanes_multiply(az, by));
        lanes y = lanes_subtract(lanes_multiply(az, bx), lanes_multiply(ax, bz));
        lanes z = lanes_subtract(lanes_multiply(ax, by), lanes_multiply(ay, bx));
        make_unit_normals(&x, &y, &z);
        lanes_store(&along->axes[0][row], x);
        lanes_store(&along->axes[1][row], y);
        lanes_store(&along->axes[2][row], z);
    }
}

/// The octahedron's lower half is folded outwards over its upper (Cigolle and others, "A survey of
/// efficient representations for independent unit vectors", 2014). The result is one plane of
/// `bits` bits each.
static inline void pack_octahedral(size_t row_count, int bits, float limit, vectors *rows) {
    const lanes zero = lanes_zero(), one = lanes_splat(1.0f);
    for (size_t row = 0; row < row_count; row += LANES_WIDTH) {
        const lanes x = lanes_load_any(&rows->axes[0][row]);
        const lanes y = lanes_load_any(&rows->axes[1][row]);
        const lanes z = lanes_load_any(&rows->axes[2][row]);
        const lanes sum = lanes_add(lanes_add(lanes_copy_sign(x, one), lanes_copy_sign(y, one)),
                                    lanes_copy_sign(z, one));
        const lanes root = inverse_root(sum), scale = lanes_multiply(root, root);
        const lanes u = lanes_multiply(x, scale), v = lanes_multiply(y, scale);
        const lanes folded_u = lanes_copy_sign(lanes_subtract(one, lanes_copy_sign(v, one)), u);
        const lanes folded_v = lanes_copy_sign(lanes_subtract(one, lanes_copy_sign(u, one)), v);
        const lanes a = quantise_signed(lanes_select_greater(zero, z, folded_u, u), limit);
        const lanes b = quantise_signed(lanes_select_greater(zero, z, folded_v, v), limit);
        lanes_store(&rows->axes[0][row], bits == 8 ? lanes_join(a, b, 8) : lanes_join(a, b, 16));
    }
}

static inline void pack_snorm8x4(size_t row_count, vectors *rows) {
    for (size_t row = 0; row < row_count; row += LANES_WIDTH) {
        const lanes x = quantise_signed(lanes_load_any(&rows->axes[0][row]), 127.0f);
        const lanes y = quantise_signed(lanes_load_any(&rows->axes[1][row]), 127.0f);
        const lanes z = quantise_signed(lanes_load_any(&rows->axes[2][row]), 127.0f);
        const lanes xy = lanes_join(x, y, 8), zw = lanes_join(z, lanes_zero(), 8);
        lanes_store(&rows->axes[0][row], lanes_join(xy, zw, 16));
    }
}

#endif
