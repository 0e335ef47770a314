/* SPDX-License-Identifier: MIT */
/*
 * PLY, as text or binary of either byte order: the properties x, y and z of the element vertex, and
 * the list vertex_indices of the element face. Everything else is skipped.
 */
#include "ply_header.h"
#include "source_builder.h"

#include <math.h>
#include <string.h>

typedef struct ply_reader {
    limni_scanner scanner; ///< of text; a binary file uses its path and context only
    limni_source_builder builder;
    limni_ply_header header;
    const unsigned char *begin, *bytes, *end; ///< of the file; what is to be read of it
    const limni_ply_element *element;         ///< being read
    uint32_t index;                           ///< in it
} ply_reader;

// ---- Values

/// Of an element: its line, or in a binary file its number.
static limn_bake_status fail_element(const ply_reader *reader, const char *text) {
    if (reader->header.format == LIMNI_PLY_ASCII)
        return limni_scanner_fail(&reader->scanner, reader->scanner.line, "%s", text);
    return limni_fail(reader->scanner.context, LIMN_BAKE_BAD_INPUT, "%s: %.*s %u, byte %zu: %s",
                      reader->scanner.path, limni_token_shown(reader->element->name),
                      reader->element->name.text, reader->index,
                      (size_t)(reader->bytes - reader->begin), text);
}

static double decode(const unsigned char *bytes, limni_ply_type type) {
    uint64_t bits = 0;
    for (uint32_t b = 0; b < limni_ply_type_sizes[type]; b++)
        bits |= (uint64_t)bytes[b] << 8 * b;
    const uint32_t low = (uint32_t)bits;
    float narrow;
    double wide;
    switch (type) {
    case LIMNI_PLY_INT8:
        return low < 0x80 ? (double)low : (double)low - 0x100;
    case LIMNI_PLY_INT16:
        return low < 0x8000 ? (double)low : (double)low - 0x10000;
    case LIMNI_PLY_INT32:
        return low < 0x80000000u ? (double)low : (double)low - 4294967296.0;
    case LIMNI_PLY_FLOAT32:
        memcpy(&narrow, &low, sizeof narrow);
        return (double)narrow;
    case LIMNI_PLY_FLOAT64:
        memcpy(&wide, &bits, sizeof wide);
        return wide;
    default:
        return (double)low;
    }
}

static limn_bake_status read_binary(ply_reader *reader, limni_ply_type type, double *value) {
    unsigned char ordered[8];
    const uint32_t size = limni_ply_type_sizes[type];
    if ((size_t)(reader->end - reader->bytes) < size)
        return fail_element(reader, "the file ends too early");
    for (uint32_t b = 0; b < size; b++)
        ordered[b] =
            reader->bytes[reader->header.format == LIMNI_PLY_BIG_ENDIAN ? size - 1 - b : b];
    *value = decode(ordered, type);
    reader->bytes += size;
    return LIMN_BAKE_OK;
}

/// A token of an element's line. Whole numbers that are negative fail, which no count or index is.
static limn_bake_status read_text(ply_reader *reader, limni_ply_type type, double *value) {
    const limni_token token = limni_scanner_next_token(&reader->scanner);
    uint32_t whole = 0;
    float number = 0;
    if (token.size == 0) return fail_element(reader, "the line ends too early");
    if (type < LIMNI_PLY_FLOAT32) {
        LIMNI_TRY(limni_scanner_whole(&reader->scanner, token, "whole number", &whole));
    } else {
        LIMNI_TRY(limni_scanner_number(&reader->scanner, token, "coordinate", &number));
    }
    *value = type < LIMNI_PLY_FLOAT32 ? (double)whole : (double)number;
    return LIMN_BAKE_OK;
}

static limn_bake_status read_value(ply_reader *reader, limni_ply_type type, double *value) {
    return reader->header.format == LIMNI_PLY_ASCII ? read_text(reader, type, value)
                                                    : read_binary(reader, type, value);
}

/// Skipped values may be anything.
static limn_bake_status skip_value(ply_reader *reader, limni_ply_type type) {
    double ignored;
    if (reader->header.format != LIMNI_PLY_ASCII) return read_binary(reader, type, &ignored);
    if (limni_scanner_next_token(&reader->scanner).size > 0) return LIMN_BAKE_OK;
    return fail_element(reader, "the line ends too early");
}

static limn_bake_status read_list_size(ply_reader *reader, const limni_ply_property *property,
                                       uint32_t *size) {
    double value = 0;
    LIMNI_TRY(read_value(reader, property->count_type, &value));
    if (value < 0) return fail_element(reader, "a list has a negative size");
    *size = (uint32_t)value;
    return LIMN_BAKE_OK;
}

static limn_bake_status read_coordinate(ply_reader *reader, const limni_ply_property *property,
                                        float *coordinate) {
    double value = 0;
    // Coordinates of whole numbers may be negative, and are small enough for a float's reader.
    const bool whole_text =
        reader->header.format == LIMNI_PLY_ASCII && property->type < LIMNI_PLY_FLOAT32;
    LIMNI_TRY(read_value(reader, whole_text ? LIMNI_PLY_FLOAT32 : property->type, &value));
    *coordinate = (float)value;
    if (isfinite(*coordinate)) return LIMN_BAKE_OK;
    return fail_element(reader, "coordinate is not finite");
}

static limn_bake_status read_corners(ply_reader *reader, const limni_ply_property *property) {
    uint32_t size = 0;
    LIMNI_TRY(read_list_size(reader, property, &size));
    if (size < 3) return fail_element(reader, "face has fewer than 3 corners");
    for (uint32_t corner = 0; corner < size; corner++) {
        double index = 0;
        LIMNI_TRY(read_value(reader, property->type, &index));
        if (!(index >= 0 && index < reader->header.vertex_count))
            return fail_element(reader, "face refers to a vertex that is not there");
        LIMNI_TRY(limni_builder_add_corner(&reader->builder, (uint32_t)index));
    }
    return limni_builder_end_face(&reader->builder, reader->scanner.line);
}

static limn_bake_status skip_property(ply_reader *reader, const limni_ply_property *property) {
    uint32_t size = 1;
    if (property->count_type != LIMNI_PLY_NO_TYPE)
        LIMNI_TRY(read_list_size(reader, property, &size));
    for (uint32_t k = 0; k < size; k++)
        LIMNI_TRY(skip_value(reader, property->type));
    return LIMN_BAKE_OK;
}

// ---- Elements

static limn_bake_status read_properties(ply_reader *reader) {
    const limni_ply_element *const element = reader->element;
    float position[3];
    const bool is_vertex = limni_token_is(element->name, "vertex");
    for (uint32_t p = 0; p < element->property_count; p++) {
        const limni_ply_property *const property =
            &reader->header.properties[element->first_property + p];
        if (property->role == LIMNI_PLY_SKIPPED) {
            LIMNI_TRY(skip_property(reader, property));
        } else if (property->role == LIMNI_PLY_CORNERS) {
            LIMNI_TRY(read_corners(reader, property));
        } else {
            LIMNI_TRY(read_coordinate(reader, property, &position[property->role - LIMNI_PLY_X]));
        }
    }
    if (!is_vertex) return LIMN_BAKE_OK;
    return limni_builder_add_position(&reader->builder, position, reader->scanner.line);
}

static limn_bake_status end_item(ply_reader *reader) {
    const limni_token extra = limni_scanner_next_token(&reader->scanner);
    if (extra.size == 0) return LIMN_BAKE_OK;
    return limni_scanner_fail(&reader->scanner, reader->scanner.line, "'%.*s' is too much here",
                              limni_token_shown(extra), extra.text);
}

static limn_bake_status read_item(ply_reader *reader) {
    limni_token first;
    if (reader->header.format != LIMNI_PLY_ASCII) return read_properties(reader);
    if (!limni_scanner_next_line(&reader->scanner, &first))
        return limni_scanner_fail(&reader->scanner, reader->scanner.line,
                                  "the file ends after %u of %u elements '%.*s'", reader->index,
                                  reader->element->count, limni_token_shown(reader->element->name),
                                  reader->element->name.text);
    limni_scanner_put_back(&reader->scanner, first);
    LIMNI_TRY(read_properties(reader));
    return end_item(reader);
}

/// The least that an item takes: the bytes of its values, or a digit and a blank for each.
static uint64_t least_size(const ply_reader *reader, const limni_ply_element *element) {
    uint64_t size = 0;
    for (uint32_t p = 0; p < element->property_count; p++) {
        const limni_ply_property *const property =
            &reader->header.properties[element->first_property + p];
        const bool list = property->count_type != LIMNI_PLY_NO_TYPE;
        const limni_ply_type type = list ? property->count_type : property->type;
        size += reader->header.format == LIMNI_PLY_ASCII ? 2 : limni_ply_type_sizes[type];
    }
    return size;
}

/// Refuses counts that the rest of the file cannot hold, before anything is read.
static limn_bake_status check_size(const ply_reader *reader) {
    uint64_t least = 0, left = (uint64_t)(reader->end - reader->bytes);
    for (uint32_t e = 0; e < reader->header.element_count; e++) {
        const limni_ply_element *const element = &reader->header.elements[e];
        const uint64_t item = least_size(reader, element);
        if (item > 0 && element->count > (left + 1 - least) / item)
            return limni_fail(reader->scanner.context, LIMN_BAKE_BAD_INPUT,
                              "%s: the file ends too early for %u elements '%.*s'",
                              reader->scanner.path, element->count,
                              limni_token_shown(element->name), element->name.text);
        least += item * element->count;
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_elements(ply_reader *reader) {
    LIMNI_TRY(check_size(reader));
    for (uint32_t e = 0; e < reader->header.element_count; e++) {
        reader->element = &reader->header.elements[e];
        if (reader->element->property_count == 0) continue; // takes no room
        for (reader->index = 0; reader->index < reader->element->count; reader->index++)
            LIMNI_TRY(read_item(reader));
    }
    const limni_source *const source = reader->builder.source;
    if (source->position_count == 0 || source->face_count == 0)
        return limni_fail(reader->scanner.context, LIMN_BAKE_BAD_INPUT, "%s: the file has no %s",
                          source->path, source->position_count == 0 ? "vertices" : "faces");
    return LIMN_BAKE_OK;
}

static limn_bake_status read_text_elements(ply_reader *reader) {
    limni_token extra;
    LIMNI_TRY(read_elements(reader));
    if (!limni_scanner_next_line(&reader->scanner, &extra)) return LIMN_BAKE_OK;
    return limni_scanner_fail(&reader->scanner, reader->scanner.line,
                              "'%.*s' after the last element", limni_token_shown(extra),
                              extra.text);
}

/// Elements of a binary file have no lines.
static limn_bake_status read_binary_elements(ply_reader *reader) {
    limni_context *const context = reader->scanner.context;
    limni_source *const source = reader->builder.source;
    LIMNI_TRY(read_elements(reader));
    limni_release(context, source->position_lines);
    limni_release(context, source->face_lines);
    source->position_lines = source->face_lines = NULL;
    if (reader->bytes == reader->end) return LIMN_BAKE_OK;
    return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: %zu bytes after the last element",
                      source->path, (size_t)(reader->end - reader->bytes));
}

static limn_bake_status scan_elements(ply_reader *reader, const char *text, size_t size) {
    if (reader->header.format != LIMNI_PLY_ASCII) return read_binary_elements(reader);
    LIMNI_TRY(limni_scanner_open(&reader->scanner, reader->scanner.context, reader->scanner.path,
                                 text, size));
    reader->scanner.cursor = text + reader->header.size;
    reader->scanner.line = reader->header.line_count + 1;
    const limn_bake_status status = read_text_elements(reader);
    limni_scanner_close(&reader->scanner);
    return status;
}

limn_bake_status limni_read_ply(limni_context *context, const char *text, size_t size,
                                limni_source *source) {
    ply_reader *const reader = limni_allocate_zeroed(context, 1, sizeof *reader);
    if (!reader) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_ply_header_read(context, source->path, text, &reader->header));
    reader->builder = limni_builder_begin(context, source);
    reader->scanner = (limni_scanner){.context = context, .path = source->path};
    reader->begin = (const unsigned char *)text;
    reader->bytes = reader->begin + reader->header.size;
    reader->end = reader->begin + size;
    LIMNI_TRY(scan_elements(reader, text, size));
    limni_release(context, reader->header.text);
    limni_release(context, reader);
    return LIMN_BAKE_OK;
}
