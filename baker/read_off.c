/* SPDX-License-Identifier: MIT */
/*
 * The Object File Format of Geomview as text, one vertex or face per line. What vertices have
 * beyond positions is checked and dropped, and so are the colours of faces.
 */
#include "source.h"
#include "text_scanner.h"

typedef struct off_header {
    const char *word;
    uint32_t least_numbers; ///< per vertex
    uint32_t most_numbers;
} off_header;

typedef struct off_reader {
    limni_scanner scanner;
    limni_source *source;
    off_header header;
    uint32_t corner_count;
} off_reader;

static limn_bake_status find_header(const limni_scanner *scanner, limni_token word,
                                    off_header *found) {
    static const off_header headers[] = {
        {"OFF", 3, 3},
        {"COFF", 6, 7}, /* colour, with or without alpha */
        {"NOFF", 6, 6}, /* normal */
        {"STOFF", 5, 5} /* texture coordinate */
    };
    for (size_t header = 0; header < sizeof headers / sizeof headers[0]; header++) {
        if (limni_token_is(word, headers[header].word)) {
            *found = headers[header];
            return LIMN_BAKE_OK;
        }
    }
    return limni_scanner_fail(scanner, scanner->line,
                              "'%.*s' is not a known header; OFF, COFF, NOFF or STOFF is expected",
                              limni_token_shown(word), word.text);
}

static limn_bake_status fail_extra(const limni_scanner *scanner, limni_token extra,
                                   const char *place) {
    return limni_scanner_fail(scanner, scanner->line, "'%.*s' after %s", limni_token_shown(extra),
                              extra.text, place);
}

static size_t bytes_left(const limni_scanner *scanner) {
    return (size_t)(scanner->end - scanner->cursor);
}

/// The counts of vertices, faces and, often left out or wrong, edges.
static limn_bake_status read_counts(off_reader *reader, limni_token first) {
    limni_scanner *scanner = &reader->scanner;
    limni_source *source = reader->source;
    uint32_t edge_count;
    LIMNI_TRY(limni_scanner_whole(scanner, first, "vertex count", &source->position_count));
    const limni_token faces = limni_scanner_next_token(scanner);
    if (faces.size == 0) {
        return limni_scanner_fail(scanner, scanner->line, "the face count is missing");
    }
    LIMNI_TRY(limni_scanner_whole(scanner, faces, "face count", &source->face_count));
    const limni_token edges = limni_scanner_next_token(scanner);
    if (edges.size == 0) return LIMN_BAKE_OK;
    LIMNI_TRY(limni_scanner_whole(scanner, edges, "edge count", &edge_count));
    const limni_token extra = limni_scanner_next_token(scanner);
    return extra.size == 0 ? LIMN_BAKE_OK : fail_extra(scanner, extra, "the counts");
}

/// Refuses counts that the rest of the file cannot hold, before memory is asked for.
static limn_bake_status check_counts(const off_reader *reader) {
    const limni_scanner *scanner = &reader->scanner;
    const limni_source *source = reader->source;
    if (source->position_count == 0 || source->face_count == 0) {
        return limni_fail(scanner->context, LIMN_BAKE_BAD_INPUT, "%s: the file has no %s",
                          scanner->path, source->position_count == 0 ? "vertices" : "faces");
    }
    const uint64_t vertex_bytes = 6; /* "0 0 0" and a line end before it */
    const uint64_t face_bytes = 8;   /* "3 0 0 0" likewise */
    const uint64_t needed = vertex_bytes * source->position_count + face_bytes * source->face_count;
    if (needed > bytes_left(scanner)) {
        return limni_scanner_fail(scanner, scanner->line,
                                  "the file ends too early for %u vertices and %u faces",
                                  source->position_count, source->face_count);
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_header(off_reader *reader) {
    limni_scanner *scanner = &reader->scanner;
    limni_token token;
    if (!limni_scanner_next_line(scanner, &token)) {
        return limni_fail(scanner->context, LIMN_BAKE_BAD_INPUT, "%s: the file is empty",
                          scanner->path);
    }
    LIMNI_TRY(find_header(scanner, token, &reader->header));
    token = limni_scanner_next_token(scanner);
    if (token.size == 0 && !limni_scanner_next_line(scanner, &token)) {
        return limni_scanner_fail(scanner, scanner->line,
                                  "the file ends before the counts of vertices and faces");
    }
    LIMNI_TRY(read_counts(reader, token));
    return check_counts(reader);
}

static limn_bake_status read_vertices(off_reader *reader) {
    limni_scanner *scanner = &reader->scanner;
    limni_source *source = reader->source;
    const uint32_t count = source->position_count;
    source->positions = limni_allocate(scanner->context, count, sizeof(float[3]));
    source->position_lines = limni_allocate(scanner->context, count, sizeof(uint32_t));
    if (!source->positions || !source->position_lines) return LIMN_BAKE_MEMORY;

    for (uint32_t vertex = 0; vertex < count; vertex++) {
        limni_token first;
        if (!limni_scanner_next_line(scanner, &first)) {
            return limni_scanner_fail(scanner, scanner->line,
                                      "the file ends after %u of %u vertices", vertex, count);
        }
        limni_scanner_put_back(scanner, first);
        source->position_lines[vertex] = scanner->line;
        LIMNI_TRY(limni_scanner_numbers(scanner, "vertex", reader->header.least_numbers,
                                        reader->header.most_numbers, source->positions[vertex]));
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_corners(off_reader *reader, uint32_t size) {
    limni_scanner *scanner = &reader->scanner;
    limni_source *source = reader->source;
    for (uint32_t corner = 0; corner < size; corner++) {
        const limni_token token = limni_scanner_next_token(scanner);
        uint32_t index = 0;
        if (token.size == 0) {
            return limni_scanner_fail(scanner, scanner->line,
                                      "face states %u corners, but %u follow", size, corner);
        }
        LIMNI_TRY(limni_scanner_whole(scanner, token, "vertex index", &index));
        if (index >= source->position_count) {
            return limni_scanner_fail(scanner, scanner->line,
                                      "face refers to vertex %u, but the last one is %u", index,
                                      source->position_count - 1);
        }
        source->face_corners[reader->corner_count++] = index;
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_face(off_reader *reader, limni_token first) {
    const uint32_t most_colour_numbers = 4;
    uint32_t size = 0;
    LIMNI_TRY(limni_scanner_whole(&reader->scanner, first, "corner count", &size));
    if (size < 3) {
        return limni_scanner_fail(&reader->scanner, reader->scanner.line,
                                  "face has %u corner%s; at least 3 are needed", size,
                                  size == 1 ? "" : "s");
    }
    LIMNI_TRY(read_corners(reader, size));
    return limni_scanner_numbers(&reader->scanner, "face colour", 0, most_colour_numbers, NULL);
}

static limn_bake_status read_faces(off_reader *reader) {
    limni_scanner *scanner = &reader->scanner;
    limni_context *context = scanner->context;
    limni_source *source = reader->source;
    const uint32_t count = source->face_count;
    source->face_offsets = limni_allocate(context, (size_t)count + 1, sizeof(uint32_t));
    source->face_lines = limni_allocate(context, count, sizeof(uint32_t));
    /* A corner takes at least a blank and a digit. */
    source->face_corners = limni_allocate(context, bytes_left(scanner) / 2, sizeof(uint32_t));
    if (!source->face_offsets || !source->face_lines || !source->face_corners) {
        return LIMN_BAKE_MEMORY;
    }
    for (uint32_t face = 0; face < count; face++) {
        limni_token first;
        if (!limni_scanner_next_line(scanner, &first)) {
            return limni_scanner_fail(scanner, scanner->line, "the file ends after %u of %u faces",
                                      face, count);
        }
        source->face_offsets[face] = reader->corner_count;
        source->face_lines[face] = scanner->line;
        LIMNI_TRY(read_face(reader, first));
    }
    source->face_offsets[count] = reader->corner_count;
    uint32_t *corners =
        limni_resize(context, source->face_corners, reader->corner_count, sizeof(uint32_t));
    if (!corners) return LIMN_BAKE_MEMORY;
    source->face_corners = corners;
    return LIMN_BAKE_OK;
}

static limn_bake_status read_all(off_reader *reader) {
    limni_token extra;
    LIMNI_TRY(read_header(reader));
    LIMNI_TRY(read_vertices(reader));
    LIMNI_TRY(read_faces(reader));
    if (limni_scanner_next_line(&reader->scanner, &extra)) {
        return fail_extra(&reader->scanner, extra, "the last face");
    }
    return LIMN_BAKE_OK;
}

limn_bake_status limni_read_off(limni_context *context, const char *text, size_t size,
                                limni_source *source) {
    *source = (limni_source){.name = source->name, .path = source->path};
    off_reader reader = {.source = source};
    LIMNI_TRY(limni_scanner_open(&reader.scanner, context, source->path, text, size));
    const limn_bake_status status = read_all(&reader);
    limni_scanner_close(&reader.scanner);
    return status;
}
