/* SPDX-License-Identifier: MIT */
/* Makes small binary glTF files: bytes with their accessors, and the rest of the JSON as text. */
#ifndef GLB_H
#define GLB_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct glb {
    char views[1 << 13], accessors[1 << 14], rest[1 << 14];
    unsigned char bytes[1 << 15];
    size_t size;
    int view_count, accessor_count;
} glb;

static inline void glb_append(char *text, size_t room, const char *format, ...) {
    const size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, room - length, format, arguments);
    va_end(arguments);
}

/// Returns the index of a new buffer view.
static inline int glb_view(glb *file, const void *data, size_t size) {
    glb_append(file->views, sizeof file->views,
               "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
               file->view_count ? "," : "", file->size, size);
    memcpy(file->bytes + file->size, data, size);
    file->size += (size + 3) / 4 * 4;
    return file->view_count++;
}

/// An accessor with its own view; `more` is further JSON. Returns its index.
static inline int glb_accessor(glb *file, const char *name, const void *data, size_t size,
                               int component_type, const char *type, size_t count,
                               const char *more) {
    char view[32] = "";
    if (data) snprintf(view, sizeof view, "\"bufferView\":%d,", glb_view(file, data, size));
    glb_append(file->accessors, sizeof file->accessors,
               "%s{\"name\":\"%s\",%s\"componentType\":%d,\"type\":\"%s\",\"count\":%zu%s}",
               file->accessor_count ? "," : "", name, view, component_type, type, count, more);
    return file->accessor_count++;
}

static inline int glb_floats(glb *file, const char *name, const float *data, const char *type,
                             size_t width, size_t count) {
    return glb_accessor(file, name, data, count * width * sizeof *data, 5126, type, count, "");
}

/// The JSON of a file: what it says about bytes, and the rest.
static inline void glb_json(const glb *file, char *json, size_t room) {
    snprintf(json, room,
             "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu}],"
             "\"bufferViews\":[%s],\"accessors\":[%s],%s}",
             file->size, file->views, file->accessors, file->rest);
}

static inline void glb_put(unsigned char **at, uint32_t word) {
    memcpy(*at, &word, sizeof word);
    *at += sizeof word;
}

/// A .glb in memory, for the caller to free.
static inline unsigned char *glb_make(const char *json, const unsigned char *bytes, size_t size,
                                      size_t *file_size) {
    const size_t json_size = (strlen(json) + 3) / 4 * 4;
    *file_size = 12 + 8 + json_size + 8 + size;
    unsigned char *const file = malloc(*file_size), *at = file;
    if (!file) abort();
    memcpy(at, "glTF", 4);
    at += 4;
    glb_put(&at, 2);
    glb_put(&at, (uint32_t)*file_size);
    glb_put(&at, (uint32_t)json_size);
    glb_put(&at, 0x4e4f534a);
    memset(at, ' ', json_size);
    memcpy(at, json, strlen(json));
    at += json_size;
    glb_put(&at, (uint32_t)size);
    glb_put(&at, 0x004e4942);
    memcpy(at, bytes, size);
    return file;
}

#endif
