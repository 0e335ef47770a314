/* SPDX-License-Identifier: MIT */
/*
 * Runs a fuzz target over each file of a folder with all the damage that there is in one place: cut
 * off at every length, every byte another, every word a number at a limit. Where that is too much,
 * at places STRIDE apart, which begin elsewhere for each kind of damage.
 *
 * usage: TEST FOLDER STRIDE [all]     all: every value of a byte, instead of a few
 */
#include "corpus_files.h"
#include "fuzz.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { FILE_MAX = 1 << 16 };

static size_t stride;
static bool all_values;
static unsigned long inputs;

static void run(const uint8_t *bytes, size_t size) {
    inputs++;
    LLVMFuzzerTestOneInput(bytes, size);
}

static void cut(const uint8_t *bytes, size_t size) {
    for (size_t length = 0; length < size; length += stride)
        run(bytes, length);
}

static void change_byte(uint8_t *bytes, size_t size, size_t at, unsigned value) {
    const uint8_t before = bytes[at];
    if ((uint8_t)value == before) return;
    bytes[at] = (uint8_t)value;
    run(bytes, size);
    bytes[at] = before;
}

static void change_bytes(uint8_t *bytes, size_t size) {
    for (size_t at = stride / 2; at < size; at += stride) {
        const unsigned before = bytes[at];
        const unsigned few[] = {0,   0xff, before + 1, before - 1, before ^ 0x80, before ^ 0x10,
                                ' ', '-'};
        for (unsigned v = 0; v < (all_values ? 256 : sizeof few / sizeof *few); v++)
            change_byte(bytes, size, at, all_values ? v : few[v]);
    }
}

/// Counts, sizes, offsets and floats at the limits of their types, of words of 4 and of 8 bytes.
static void change_words(uint8_t *bytes, size_t size) {
    static const uint64_t values[] = {0,
                                      1,
                                      0xffff,
                                      0x10000,
                                      0x3fffffff,
                                      0x40000000,
                                      0x7f800000,
                                      0x7fc00000,
                                      0x7fffffff,
                                      0x80000000,
                                      0xfffffffe,
                                      0xffffffff,
                                      0x100000000,
                                      0x7fffffffffffffff,
                                      0x8000000000000000,
                                      0xffffffffffffffff};
    for (size_t at = stride / 3 * 4; at + 8 <= size; at += 4 * stride) {
        for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
            uint8_t before[8];
            memcpy(before, bytes + at, sizeof before);
            memcpy(bytes + at, &values[v], values[v] > UINT32_MAX ? 8 : 4);
            run(bytes, size);
            memcpy(bytes + at, before, sizeof before);
        }
    }
}

static void damage(const char *name, const uint8_t *bytes, size_t size) {
    static uint8_t copy[FILE_MAX];
    (void)name;
    memcpy(copy, bytes, size);
    cut(copy, size);
    change_bytes(copy, size);
    change_words(copy, size);
}

int main(int argc, char **argv) {
    stride = argc >= 3 ? strtoul(argv[2], NULL, 10) : 0;
    all_values = argc == 4 && strcmp(argv[3], "all") == 0;
    const int count = stride ? corpus_files_visit(argv[1], damage) : -1;
    printf("%d files, %lu damaged ones\n", count, inputs);
    return count <= 0;
}
