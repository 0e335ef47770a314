/* SPDX-License-Identifier: MIT */
#include "ply_header.h"

#include <string.h>

const uint32_t limni_ply_type_sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};

typedef struct header_reader {
    limni_scanner scanner;
    limni_ply_header *header;
} header_reader;

static limn_bake_status fail_header(const header_reader *reader, const char *what,
                                    limni_token token) {
    return limni_scanner_fail(&reader->scanner, reader->scanner.line, "'%.*s' is not %s",
                              limni_token_shown(token), token.text, what);
}

static limni_ply_type find_type(limni_token word) {
    static const char *const names[][2] = {
        {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
        {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
    for (int type = 0; type < LIMNI_PLY_NO_TYPE; type++) {
        if (limni_token_is(word, names[type][0]) || limni_token_is(word, names[type][1]))
            return (limni_ply_type)type;
    }
    return LIMNI_PLY_NO_TYPE;
}

static limn_bake_status next_type(header_reader *reader, bool whole, limni_ply_type *type) {
    const limni_token word = limni_scanner_next_token(&reader->scanner);
    *type = find_type(word);
    if (*type < (whole ? LIMNI_PLY_FLOAT32 : LIMNI_PLY_NO_TYPE)) return LIMN_BAKE_OK;
    return fail_header(reader, whole ? "a type of whole numbers" : "a type", word);
}

static limn_bake_status end_line(header_reader *reader) {
    const limni_token extra = limni_scanner_next_token(&reader->scanner);
    if (extra.size == 0) return LIMN_BAKE_OK;
    return limni_scanner_fail(&reader->scanner, reader->scanner.line, "'%.*s' is too much here",
                              limni_token_shown(extra), extra.text);
}

/// format ascii 1.0
static limn_bake_status read_format(header_reader *reader) {
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const limni_token name = limni_scanner_next_token(&reader->scanner);
    const limni_token version = limni_scanner_next_token(&reader->scanner);
    for (int f = 0; f < 3; f++) {
        if (limni_token_is(name, names[f])) reader->header->format = (limni_ply_format)(f + 1);
    }
    if (reader->header->format == LIMNI_PLY_NO_FORMAT)
        return fail_header(reader,
                           "a format; ascii, binary_little_endian or binary_big_endian is "
                           "expected",
                           name);
    if (!limni_token_is(version, "1.0"))
        return fail_header(reader, "a known version; 1.0 is", version);
    return end_line(reader);
}

static bool same_token(limni_token a, limni_token b) {
    return a.size == b.size && memcmp(a.text, b.text, a.size) == 0;
}

/// element NAME COUNT
static limn_bake_status read_element(header_reader *reader) {
    const limni_token name = limni_scanner_next_token(&reader->scanner);
    const limni_token count = limni_scanner_next_token(&reader->scanner);
    if (reader->header->element_count == LIMNI_PLY_ELEMENTS_MAX)
        return limni_scanner_fail(&reader->scanner, reader->scanner.line,
                                  "the file has more than %d elements", LIMNI_PLY_ELEMENTS_MAX);
    for (uint32_t e = 0; e < reader->header->element_count; e++) {
        if (same_token(reader->header->elements[e].name, name))
            return limni_scanner_fail(&reader->scanner, reader->scanner.line,
                                      "the element '%.*s' comes twice", limni_token_shown(name),
                                      name.text);
    }
    limni_ply_element *const element = &reader->header->elements[reader->header->element_count++];
    *element = (limni_ply_element){.name = name, .first_property = reader->header->property_count};
    LIMNI_TRY(limni_scanner_whole(&reader->scanner, count, "element count", &element->count));
    if (limni_token_is(name, "vertex")) reader->header->vertex_count = element->count;
    return end_line(reader);
}

static limni_ply_role find_role(const limni_ply_element *element, limni_token name, bool list) {
    if (limni_token_is(element->name, "vertex") && !list) {
        if (limni_token_is(name, "x")) return LIMNI_PLY_X;
        if (limni_token_is(name, "y")) return LIMNI_PLY_Y;
        if (limni_token_is(name, "z")) return LIMNI_PLY_Z;
    }
    if (limni_token_is(element->name, "face") && list &&
        (limni_token_is(name, "vertex_indices") || limni_token_is(name, "vertex_index")))
        return LIMNI_PLY_CORNERS;
    return LIMNI_PLY_SKIPPED;
}

/// property TYPE NAME, or property list COUNT_TYPE TYPE NAME
static limn_bake_status read_property(header_reader *reader) {
    limni_scanner *const scanner = &reader->scanner;
    if (reader->header->element_count == 0)
        return limni_scanner_fail(scanner, scanner->line, "a property before the first element");
    if (reader->header->property_count == LIMNI_PLY_PROPERTIES_MAX)
        return limni_scanner_fail(scanner, scanner->line, "the file has more than %d properties",
                                  LIMNI_PLY_PROPERTIES_MAX);
    limni_ply_element *const element = &reader->header->elements[reader->header->element_count - 1];
    limni_ply_property property = {.count_type = LIMNI_PLY_NO_TYPE};
    const limni_token word = limni_scanner_next_token(scanner);
    const bool list = limni_token_is(word, "list");
    if (list) {
        LIMNI_TRY(next_type(reader, true, &property.count_type));
    } else {
        limni_scanner_put_back(scanner, word);
    }
    LIMNI_TRY(next_type(reader, false, &property.type));
    const limni_token name = limni_scanner_next_token(scanner);
    property.role = find_role(element, name, list);
    if (property.role == LIMNI_PLY_CORNERS && property.type >= LIMNI_PLY_FLOAT32)
        return fail_header(reader, "a list of whole numbers", name);
    for (uint32_t p = 0; p < element->property_count && property.role != LIMNI_PLY_SKIPPED; p++) {
        if (reader->header->properties[element->first_property + p].role == property.role)
            return limni_scanner_fail(scanner, scanner->line, "the property '%.*s' comes twice",
                                      limni_token_shown(name), name.text);
    }
    reader->header->properties[reader->header->property_count++] = property;
    element->property_count++;
    return end_line(reader);
}

/// Comments may hold anything, a backslash at the end too.
static void skip_comment(limni_scanner *scanner) {
    scanner->cursor += strcspn(scanner->cursor, "\r\n");
}

static limn_bake_status read_header_line(header_reader *reader, limni_token word) {
    if (limni_token_is(word, "format")) return read_format(reader);
    if (limni_token_is(word, "element")) return read_element(reader);
    if (limni_token_is(word, "property")) return read_property(reader);
    if (!limni_token_is(word, "comment") && !limni_token_is(word, "obj_info"))
        return fail_header(reader, "a word of the header", word);
    skip_comment(&reader->scanner);
    return LIMN_BAKE_OK;
}

/// Whether the element has the property.
static bool has_role(const header_reader *reader, const char *name, limni_ply_role role) {
    for (uint32_t e = 0; e < reader->header->element_count; e++) {
        const limni_ply_element *const element = &reader->header->elements[e];
        if (!limni_token_is(element->name, name)) continue;
        for (uint32_t p = 0; p < element->property_count; p++) {
            if (reader->header->properties[element->first_property + p].role == role) return true;
        }
    }
    return false;
}

static limn_bake_status check_header(const header_reader *reader) {
    limni_context *const context = reader->scanner.context;
    const char *const path = reader->scanner.path;
    if (reader->header->format == LIMNI_PLY_NO_FORMAT)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: the header states no format", path);
    for (int role = LIMNI_PLY_X; role <= LIMNI_PLY_Z; role++) {
        if (!has_role(reader, "vertex", (limni_ply_role)role))
            return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                              "%s: the element vertex has no property %c", path,
                              'x' + role - LIMNI_PLY_X);
    }
    if (!has_role(reader, "face", LIMNI_PLY_CORNERS))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: the element face has no list vertex_indices", path);
    return LIMN_BAKE_OK;
}

static limn_bake_status read_header(header_reader *reader) {
    limni_token word;
    while (limni_scanner_next_line(&reader->scanner, &word)) {
        if (limni_token_is(word, "end_header")) return check_header(reader);
        LIMNI_TRY(read_header_line(reader, word));
    }
    return limni_scanner_fail(&reader->scanner, reader->scanner.line, "the header does not end");
}

/// Where the elements begin: behind the line end_header, which ends like the first line. NULL if
/// there is none.
static const char *find_elements(const char *text) {
    static const char last[] = "end_header";
    const size_t last_size = sizeof last - 1;
    const char *const first_end = text + strcspn(text, "\r\n");
    const bool two_bytes = first_end[0] == '\r' && first_end[1] == '\n';
    for (const char *line = text;;) {
        const size_t size = strcspn(line, "\r\n");
        if (line[size] == '\0') return NULL;
        const bool is_two = two_bytes && line[size] == '\r' && line[size + 1] == '\n';
        const char *const next = line + size + (is_two ? 2 : 1);
        if (strncmp(line, last, last_size) == 0 &&
            last_size + strspn(line + last_size, " \t") == size)
            return next;
        line = next;
    }
}

/// The scanner takes nothing but text: it gets a copy that ends with the header.
static limn_bake_status copy_header(limni_context *context, const char *path, const char *text,
                                    limni_ply_header *header) {
    if (strncmp(text, "ply", 3) != 0 || (text[3] != '\n' && text[3] != '\r'))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s:1: the first line must be 'ply'", path);
    const char *const elements = find_elements(text);
    if (!elements)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: the header does not end", path);
    *header = (limni_ply_header){.size = (size_t)(elements - text)};
    header->text = limni_allocate(context, header->size + 1, 1);
    if (!header->text) return LIMN_BAKE_MEMORY;
    memcpy(header->text, text, header->size);
    header->text[header->size] = '\0';
    return LIMN_BAKE_OK;
}

limn_bake_status limni_ply_header_read(limni_context *context, const char *path, const char *text,
                                       limni_ply_header *header) {
    limni_token magic;
    header_reader reader = {.header = header};
    LIMNI_TRY(copy_header(context, path, text, header));
    LIMNI_TRY(limni_scanner_open(&reader.scanner, context, path, header->text, header->size));
    limni_scanner_next_line(&reader.scanner, &magic);
    const limn_bake_status status = read_header(&reader);
    header->line_count = reader.scanner.line;
    limni_scanner_close(&reader.scanner);
    return status;
}
