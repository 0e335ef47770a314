/* SPDX-License-Identifier: MIT */
/* The public structs and numbers are those of layout.h, and the version is that of the headers. */
#include "limn/bake.h"
#include "limn/character.h"
#include "limn/format.h"
#include "limn/limn.h"

#include "check.h"

#include <stddef.h>
#include <stdint.h>

/// A struct, where `field` is NULL, or a field of the struct before it.
typedef struct layout_line {
    const char *record, *field;
    size_t size, offset;
    size_t expected; ///< of a struct its size, of a field its offset
} layout_line;

static const layout_line lines[] = {
#define RECORD(record, expected) {#record, NULL, sizeof(record), 0, expected},
#define FIELD(record, field, expected)                                                             \
    {#record, #field, sizeof(((record *)0)->field), offsetof(record, field), expected},
#define VALUE(name, expected)
#include "layout.h"
#undef RECORD
#undef FIELD
#undef VALUE
};
enum { LINE_COUNT = sizeof lines / sizeof *lines };

/// Records of the file are the same on all hosts.
static bool is_pinned(const layout_line *line) {
    return sizeof(void *) == 8 || strncmp(line->record, "limn_file_", strlen("limn_file_")) == 0;
}

static void test_layout(void) {
    for (size_t l = 0; l < LINE_COUNT; l++) {
        const layout_line *const line = &lines[l];
        if (!is_pinned(line)) continue;
        if (!CHECK_EQUAL(line->field ? line->offset : line->size, line->expected))
            fprintf(stderr, "    layout.h: %s%s%s\n", line->record, line->field ? "." : "",
                    line->field ? line->field : "");
    }
}

/// Between the fields that are listed, and behind the last, there is no room for one that is not:
/// a gap is smaller than the widest alignment.
static void test_gaps(void) {
    size_t size = 0;
    for (size_t l = 0; l < LINE_COUNT; l++) {
        const layout_line *const line = &lines[l];
        if (!line->field) size = line->size;
        const bool is_last = l + 1 == LINE_COUNT || !lines[l + 1].field;
        const size_t end = line->field ? line->offset + line->size : 0;
        const size_t next = is_last ? size : lines[l + 1].offset;
        if (!CHECK(end <= next && next - end < sizeof(uint64_t)))
            fprintf(stderr, "    layout.h: %s: nothing is listed at byte %zu\n", line->record, end);
    }
}

static void test_values(void) {
    static const struct {
        const char *name;
        unsigned long long value, expected;
    } values[] = {
#define RECORD(record, expected)
#define FIELD(record, field, expected)
#define VALUE(name, expected) {#name, (unsigned long long)(name), expected},
#include "layout.h"
#undef RECORD
#undef FIELD
#undef VALUE
    };
    for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
        if (!CHECK_EQUAL(values[v].value, values[v].expected))
            fprintf(stderr, "    layout.h: %s\n", values[v].name);
    }
}

/// Each part has eight bits, so that versions compare as numbers.
static void test_version(void) {
    CHECK_EQUAL(limn_version() >> 16, LIMN_VERSION_MAJOR);
    CHECK_EQUAL(limn_version() >> 8 & 0xff, LIMN_VERSION_MINOR);
    CHECK_EQUAL(limn_version() & 0xff, LIMN_VERSION_PATCH);
    CHECK(LIMN_FORMAT_VERSION_OLDEST <= LIMN_FORMAT_VERSION);
}

int main(void) {
    test_layout();
    test_gaps();
    test_values();
    test_version();
    return check_report();
}
