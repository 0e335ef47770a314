/* SPDX-License-Identifier: MIT */
/*
 * Wavefront OBJ: vertices, texture coordinates, polygons, and OpenSubdiv's tags. Normals are checked
 * and dropped; free-form geometry, groups and materials are skipped.
 */
#include "read_lomont.h"
#include "read_tag.h"

enum { POSITION, TEXTURE, NORMAL, ELEMENT_COUNT };

/// The channel that texture coordinates go to.
enum { UV };

/// What face corners refer to. Faces may refer to elements that come later in the file, so the
/// highest reference is checked at the end.
typedef struct obj_element {
    uint32_t count;
    uint32_t highest_number; ///< from 1 as in the file; 0: no reference yet
    uint32_t highest_line;
} obj_element;

static const char *const element_nouns[ELEMENT_COUNT] = {"vertex", "texture coordinate", "normal"};

typedef struct obj_reader {
    limni_scanner scanner;
    limni_source_builder builder;
    obj_element elements[ELEMENT_COUNT];
    limni_word_list noted_keywords;
    limni_word_list noted_tags;
} obj_reader;

/// v x y z, and then a weight or a colour, which are dropped.
static limn_bake_status read_position(obj_reader *reader) {
    float position[3];
    const uint32_t line = reader->scanner.line;
    LIMNI_TRY(limni_scanner_numbers(&reader->scanner, "vertex", 3, 7, position));
    reader->elements[POSITION].count++;
    return limni_builder_add_position(&reader->builder, position, line);
}

/// vt u v w, of which v is 0 if it is missing, and w is dropped.
static limn_bake_status read_texture(obj_reader *reader) {
    float value[3] = {0, 0, 0};
    reader->elements[TEXTURE].count++;
    LIMNI_TRY(limni_scanner_numbers(&reader->scanner, element_nouns[TEXTURE], 1, 3, value));
    value[2] = 0;
    return limni_builder_add_value(&reader->builder, UV, value);
}

static limn_bake_status read_normal(obj_reader *reader) {
    reader->elements[NORMAL].count++;
    return limni_scanner_numbers(&reader->scanner, element_nouns[NORMAL], 3, 3, NULL);
}

static limn_bake_status fail_corner(const obj_reader *reader, limni_token corner) {
    return limni_scanner_fail(&reader->scanner, reader->scanner.line,
                              "'%.*s' is not a corner; v, v/vt, v//vn or v/vt/vn is expected",
                              limni_token_shown(corner), corner.text);
}

/// Turns a number of the file, from 1 or relative from -1, into an index from 0. `line` is where
/// the face starts.
static limn_bake_status resolve(obj_reader *reader, uint32_t kind, bool relative, uint64_t number,
                                uint32_t line, uint32_t *index) {
    obj_element *element = &reader->elements[kind];
    const limni_scanner *scanner = &reader->scanner;
    const char *noun = element_nouns[kind];
    if (number == 0) {
        return limni_scanner_fail(scanner, line, "face refers to %s 0, but they count from 1",
                                  noun);
    }
    if (number > UINT32_MAX) {
        return limni_scanner_fail(scanner, line, "face refers to a %s beyond 32 bits", noun);
    }
    if (relative && number > element->count) {
        return limni_scanner_fail(scanner, line, "face refers to %s -%u, but %u come before it",
                                  noun, (uint32_t)number, element->count);
    }
    if (relative) number = element->count + 1 - number;
    if (number > element->highest_number) {
        element->highest_number = (uint32_t)number;
        element->highest_line = line;
    }
    *index = (uint32_t)number - 1;
    return LIMN_BAKE_OK;
}

static limn_bake_status add_reference(obj_reader *reader, uint32_t kind, uint32_t index) {
    limni_source_builder *const builder = &reader->builder;
    if (kind == POSITION) {
        LIMNI_TRY(limni_builder_add_corner(builder, index));
        return limni_builder_set_corner_value(builder, UV, LIMNI_NO_VALUE);
    }
    if (kind == TEXTURE) return limni_builder_set_corner_value(builder, UV, index);
    return LIMN_BAKE_OK;
}

/// One corner of a face: up to three numbers with '/' between them; the second may be missing.
static limn_bake_status read_corner(obj_reader *reader, limni_token corner, uint32_t line) {
    const char *const end = corner.text + corner.size;
    const char *c = corner.text;
    for (uint32_t kind = POSITION; kind < ELEMENT_COUNT; kind++) {
        if (kind == TEXTURE && *c == '/') {
            c++;
            continue;
        }
        const bool relative = *c == '-';
        c += relative;
        uint64_t number = 0;
        uint32_t index = 0;
        if (!limni_parse_digits(&c, &number)) return fail_corner(reader, corner);
        LIMNI_TRY(resolve(reader, kind, relative, number, line, &index));
        LIMNI_TRY(add_reference(reader, kind, index));
        if (c == end) return LIMN_BAKE_OK;
        if (*c++ != '/') break;
    }
    return fail_corner(reader, corner);
}

static limn_bake_status read_face(obj_reader *reader) {
    const uint32_t line = reader->scanner.line;
    for (;;) {
        const limni_token corner = limni_scanner_next_token(&reader->scanner);
        if (corner.size == 0) break;
        LIMNI_TRY(read_corner(reader, corner, line));
    }
    const uint32_t size = limni_builder_face_size(&reader->builder);
    if (size < 3) {
        return limni_scanner_fail(&reader->scanner, line,
                                  "face has %u corner%s; at least 3 are needed", size,
                                  size == 1 ? "" : "s");
    }
    return limni_builder_end_face(&reader->builder, line);
}

/// Keywords that change nothing about the polygons, or that are read elsewhere: names, materials,
/// display, points and lines, free-form curves and surfaces.
static bool is_ignored(limni_token keyword) {
    static const char *const words[] = {
        "bevel",     "bmat",     "c_interp",   "con",    "cstype", "ctech", "curv",
        "curv2",     "d_interp", "deg",        "end",    "g",      "hole",  "l",
        "lod",       "maplib",   "mg",         "mtllib", "o",      "p",     "parm",
        "s",         "scrv",     "shadow_obj", "sp",     "stech",  "step",  "surf",
        "trace_obj", "trim",     "usemap",     "usemtl", "vp",
    };
    for (size_t word = 0; word < sizeof words / sizeof words[0]; word++) {
        if (limni_token_is(keyword, words[word])) return true;
    }
    return false;
}

static void note_unknown(obj_reader *reader, limni_token keyword) {
    if (!limni_word_list_add(&reader->noted_keywords, keyword)) return;
    limni_note(reader->scanner.context, "%s:%u: unknown keyword '%.*s' is ignored",
               reader->scanner.path, reader->scanner.line, limni_token_shown(keyword),
               keyword.text);
}

static limn_bake_status read_line(obj_reader *reader, limni_token keyword) {
    if (limni_token_is(keyword, "v")) return read_position(reader);
    if (limni_token_is(keyword, "f")) return read_face(reader);
    if (limni_token_is(keyword, "vt")) return read_texture(reader);
    if (limni_token_is(keyword, "vn")) return read_normal(reader);
    if (limni_token_is(keyword, "t"))
        return limni_read_tag(&reader->scanner, &reader->builder, &reader->noted_tags);
    if (!is_ignored(keyword)) note_unknown(reader, keyword);
    limni_scanner_skip_line(&reader->scanner);
    return LIMN_BAKE_OK;
}

static limn_bake_status check_references(const obj_reader *reader) {
    for (uint32_t kind = 0; kind < ELEMENT_COUNT; kind++) {
        const obj_element *element = &reader->elements[kind];
        if (element->highest_number > element->count) {
            return limni_scanner_fail(&reader->scanner, element->highest_line,
                                      "face refers to %s %u, but the file has %u",
                                      element_nouns[kind], element->highest_number, element->count);
        }
    }
    return LIMN_BAKE_OK;
}

/// Corners without texture coordinates get (0, 0), in a file that has others.
static limn_bake_status complete_uv(obj_reader *reader) {
    limni_source *const source = reader->builder.source;
    limni_source_channel *const uv = &source->channels[UV];
    const uint32_t corner_count = reader->builder.corner_count, none = uv->value_count;
    uint32_t missing = 0;
    for (uint32_t c = 0; c < corner_count; c++) {
        if (uv->corner_values[c] != LIMNI_NO_VALUE) continue;
        uv->corner_values[c] = none;
        missing++;
    }
    if (missing == corner_count) {
        limni_release(reader->scanner.context, uv->values);
        limni_release(reader->scanner.context, uv->corner_values);
        source->channel_count = 0;
        return LIMN_BAKE_OK;
    }
    if (missing == 0) return LIMN_BAKE_OK;
    limni_note(reader->scanner.context,
               "%s: %u of %u corners of faces have no texture coordinates, and get (0, 0)",
               reader->scanner.path, missing, corner_count);
    return limni_builder_add_value(&reader->builder, UV, (const float[3]){0, 0, 0});
}

static limn_bake_status read_lines(obj_reader *reader) {
    limni_scanner *scanner = &reader->scanner;
    limni_token keyword;
    while (limni_scanner_next_line(scanner, &keyword)) {
        LIMNI_TRY(read_line(reader, keyword));
    }
    if (reader->builder.source->position_count == 0) {
        return limni_fail(scanner->context, LIMN_BAKE_BAD_INPUT, "%s: the file has no vertices",
                          scanner->path);
    }
    if (reader->builder.source->face_count == 0) {
        return limni_fail(scanner->context, LIMN_BAKE_BAD_INPUT, "%s: the file has no faces",
                          scanner->path);
    }
    LIMNI_TRY(check_references(reader));
    return complete_uv(reader);
}

limn_bake_status limni_read_obj(limni_context *context, const char *text, size_t size,
                                limni_source *source) {
    if (limni_is_lomont(text)) return limni_read_lomont(context, text, size, source);
    obj_reader reader = {.builder = limni_builder_begin(context, source)};
    source->index_base = 1;
    LIMNI_TRY(limni_builder_add_channel(&reader.builder, "uv", LIMN_CHANNEL_UV, 2));
    LIMNI_TRY(limni_scanner_open(&reader.scanner, context, source->path, text, size));
    const limn_bake_status status = read_lines(&reader);
    limni_scanner_close(&reader.scanner);
    limni_builder_end(&reader.builder);
    return status;
}
