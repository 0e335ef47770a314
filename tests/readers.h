/* SPDX-License-Identifier: MIT */
/* What tests of mesh readers share: good texts, bad texts with their messages, damaged texts. */
#ifndef READERS_H
#define READERS_H

#include "../baker/source.h"

#include "check.h"

#include <math.h>
#include <stdlib.h>

typedef limn_bake_status read_text_fn(limni_context *context, const char *text, size_t size,
                                      limni_source *source);

typedef struct text_case {
    const char *text;
    const char *expected;
} text_case;

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static inline const char *path_of(read_text_fn *read) {
    return read == limni_read_obj ? "t.obj" : read == limni_read_off ? "t.off" : "t.ply";
}

/// Reads a copy of exactly the text, so that the address sanitizer sees every step outside.
static inline limn_bake_status read_text(limni_context *context, read_text_fn *read,
                                         const char *text, size_t size, limni_source *source) {
    char *copy = malloc(size + 1);
    if (!copy) abort();
    memcpy(copy, text, size);
    copy[size] = '\0';
    *source = (limni_source){.path = path_of(read)};
    const limn_bake_status status = read(context, copy, size, source);
    free(copy);
    return status;
}

static inline bool is_sharpness(float value) {
    return value >= 0 && !signbit(value);
}

/// Tags may name what is not there.
static inline bool has_valid_tags(const limni_tags *tags) {
    bool valid = true;
    for (uint32_t c = 0; c < tags->crease_count; c++)
        valid = valid && is_sharpness(tags->creases[c].sharpness) && tags->creases[c].line > 0;
    for (uint32_t v = 0; v < tags->sharp_vertex_count; v++)
        valid = valid && is_sharpness(tags->sharp_vertices[v].sharpness) &&
                tags->sharp_vertices[v].line > 0;
    for (uint32_t h = 0; h < tags->hole_count; h++)
        valid = valid && tags->holes[h].line > 0;
    return valid;
}

static inline bool is_valid_channel(const limni_source_channel *channel, uint32_t corner_count) {
    bool valid = channel->component_count > 0 && channel->component_count <= 3;
    for (uint32_t v = 0; v < channel->value_count; v++) {
        for (uint32_t axis = 0; axis < 3; axis++)
            valid = valid && isfinite(channel->values[v][axis]);
    }
    for (uint32_t corner = 0; corner < corner_count; corner++)
        valid = valid && channel->corner_values[corner] < channel->value_count;
    return valid;
}

/// Everything that source.h promises about the arrays.
static inline bool is_valid(const limni_source *source) {
    bool valid = source->position_count > 0 && source->face_count > 0;
    valid = valid && has_valid_tags(&source->tags);
    for (uint32_t position = 0; position < source->position_count; position++) {
        const float *p = source->positions[position];
        valid = valid && isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
        valid = valid && (!source->position_lines || source->position_lines[position] > 0);
    }
    valid = valid && source->face_offsets[0] == 0;
    for (uint32_t face = 0; face < source->face_count; face++) {
        valid = valid && source->face_offsets[face] + 3 <= source->face_offsets[face + 1];
        valid = valid && (!source->face_lines || source->face_lines[face] > 0);
    }
    const uint32_t corner_count = source->face_offsets[source->face_count];
    for (uint32_t corner = 0; corner < corner_count; corner++) {
        valid = valid && source->face_corners[corner] < source->position_count;
    }
    for (uint32_t c = 0; c < source->channel_count; c++)
        valid = valid && is_valid_channel(&source->channels[c], corner_count);
    return valid;
}

/// The mesh as "line:x,y,z …  line:a,b,c …". Binary files have no lines: they show as 0.
static inline const char *describe(const limni_source *source) {
    static char text[1024];
    size_t used = 0;
    for (uint32_t position = 0; position < source->position_count; position++) {
        const float *p = source->positions[position];
        used += (size_t)snprintf(text + used, sizeof text - used, "%u:%g,%g,%g ",
                                 source->position_lines ? source->position_lines[position] : 0,
                                 (double)p[0], (double)p[1], (double)p[2]);
    }
    for (uint32_t face = 0; face < source->face_count; face++) {
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 " %u:", source->face_lines ? source->face_lines[face] : 0);
        for (uint32_t corner = source->face_offsets[face]; corner < source->face_offsets[face + 1];
             corner++) {
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%u",
                                     corner > source->face_offsets[face] ? "," : "",
                                     source->face_corners[corner]);
        }
    }
    return text;
}

/// The tags as "line:a-b=sharpness … line:vertex=sharpness … line:face … boundary creasing".
static inline const char *describe_tags(const limni_source *source) {
    static char text[1024];
    const limni_tags *const tags = &source->tags;
    size_t used = 0;
    for (uint32_t c = 0; c < tags->crease_count; c++) {
        const limni_crease *const crease = &tags->creases[c];
        used += (size_t)snprintf(text + used, sizeof text - used, "%u:%u-%u=%g ", crease->line,
                                 crease->a, crease->b, (double)crease->sharpness);
    }
    for (uint32_t v = 0; v < tags->sharp_vertex_count; v++) {
        const limni_sharp_vertex *const vertex = &tags->sharp_vertices[v];
        used += (size_t)snprintf(text + used, sizeof text - used, "%u:%u=%g ", vertex->line,
                                 vertex->position, (double)vertex->sharpness);
    }
    for (uint32_t h = 0; h < tags->hole_count; h++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%u:%u ", tags->holes[h].line,
                                 tags->holes[h].face);
    snprintf(text + used, sizeof text - used, "%d %d", (int)tags->boundary, (int)tags->creasing);
    return text;
}

/// The channels as "name: x,y,z …  a b c …", values and then those of the corners.
static inline const char *describe_channels(const limni_source *source) {
    static char text[1024];
    size_t used = 0;
    text[0] = '\0';
    for (uint32_t c = 0; c < source->channel_count; c++) {
        const limni_source_channel *const channel = &source->channels[c];
        used += (size_t)snprintf(text + used, sizeof text - used, "%s: ", channel->name);
        for (uint32_t v = 0; v < channel->value_count; v++) {
            const float *const value = channel->values[v];
            used += (size_t)snprintf(text + used, sizeof text - used, "%g,%g,%g ", (double)value[0],
                                     (double)value[1], (double)value[2]);
        }
        for (uint32_t corner = 0; corner < source->face_offsets[source->face_count]; corner++)
            used += (size_t)snprintf(text + used, sizeof text - used, " %u",
                                     channel->corner_values[corner]);
    }
    return text;
}

typedef const char *describe_fn(const limni_source *source);

static inline void check_described(read_text_fn *read, const text_case *cases, size_t count,
                                   describe_fn *as_text) {
    for (size_t i = 0; i < count; i++) {
        limni_context context = {0};
        limni_source source;
        const limn_bake_status status =
            read_text(&context, read, cases[i].text, strlen(cases[i].text), &source);
        CHECK_TEXT(context.error, "");
        if (CHECK_EQUAL(status, LIMN_BAKE_OK)) {
            CHECK(is_valid(&source));
            CHECK_TEXT(as_text(&source), cases[i].expected);
        }
        limni_release_all(&context);
    }
}

static inline void check_good(read_text_fn *read, const text_case *cases, size_t count) {
    check_described(read, cases, count, describe);
}

static inline void check_bad(read_text_fn *read, const text_case *cases, size_t count) {
    for (size_t i = 0; i < count; i++) {
        limni_context context = {0};
        limni_source source;
        CHECK_EQUAL(read_text(&context, read, cases[i].text, strlen(cases[i].text), &source),
                    LIMN_BAKE_BAD_INPUT);
        CHECK_TEXT(context.error, cases[i].expected);
        limni_release_all(&context);
    }
}

static inline bool read_anything(read_text_fn *read, const char *text, size_t size) {
    limni_context context = {0};
    limni_source source;
    const limn_bake_status status = read_text(&context, read, text, size, &source);
    if (status == LIMN_BAKE_OK) {
        CHECK(is_valid(&source));
    } else {
        CHECK_EQUAL(status, LIMN_BAKE_BAD_INPUT);
        CHECK(strncmp(context.error, path_of(read), 5) == 0 && context.error[5] == ':');
    }
    limni_release_all(&context);
    return status == LIMN_BAKE_OK;
}

static inline uint32_t random_below(uint64_t *state, uint32_t limit) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((*state >> 33) % limit);
}

/// Bytes that mean something to a reader are likelier than others.
static inline char random_byte(uint64_t *state) {
    static const char common[] = "0123456789-+.eE/\\#\n\r\t vftnOFChds";
    if (random_below(state, 8) == 0) return (char)random_below(state, 256);
    return common[random_below(state, sizeof common - 1)];
}

static inline void test_mutations(read_text_fn *read, const char *sample, size_t size) {
    uint64_t state = 1;
    char text[1024];
    if (!CHECK(size <= sizeof text)) return;
    for (uint32_t round = 0; round < 20000; round++) {
        memcpy(text, sample, size);
        const uint32_t changes = 1 + random_below(&state, 4);
        for (uint32_t change = 0; change < changes; change++) {
            const uint32_t place = random_below(&state, (uint32_t)size);
            text[place] = random_byte(&state);
        }
        read_anything(read, text, size);
    }
}

#endif
