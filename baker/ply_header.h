/* SPDX-License-Identifier: MIT */
/* The header of a PLY file: which elements there are, and how their properties lie. */
#ifndef LIMNI_PLY_HEADER_H
#define LIMNI_PLY_HEADER_H

#include "text_scanner.h"

enum { LIMNI_PLY_ELEMENTS_MAX = 16, LIMNI_PLY_PROPERTIES_MAX = 128 };

typedef enum limni_ply_format {
    LIMNI_PLY_NO_FORMAT,
    LIMNI_PLY_ASCII,
    LIMNI_PLY_LITTLE_ENDIAN,
    LIMNI_PLY_BIG_ENDIAN
} limni_ply_format;

/// Whole numbers come first.
typedef enum limni_ply_type {
    LIMNI_PLY_INT8,
    LIMNI_PLY_UINT8,
    LIMNI_PLY_INT16,
    LIMNI_PLY_UINT16,
    LIMNI_PLY_INT32,
    LIMNI_PLY_UINT32,
    LIMNI_PLY_FLOAT32,
    LIMNI_PLY_FLOAT64,
    LIMNI_PLY_NO_TYPE
} limni_ply_type;

/// In bytes, by type.
extern const uint32_t limni_ply_type_sizes[];

/// What a property is to a mesh.
typedef enum limni_ply_role {
    LIMNI_PLY_SKIPPED,
    LIMNI_PLY_X,
    LIMNI_PLY_Y,
    LIMNI_PLY_Z,
    LIMNI_PLY_CORNERS
} limni_ply_role;

typedef struct limni_ply_property {
    limni_ply_role role;
    limni_ply_type count_type; ///< of a list; otherwise LIMNI_PLY_NO_TYPE
    limni_ply_type type;
} limni_ply_property;

typedef struct limni_ply_element {
    limni_token name;
    uint32_t count;
    uint32_t first_property, property_count;
} limni_ply_element;

typedef struct limni_ply_header {
    char *text; ///< a copy, which names of elements are in
    size_t size;
    uint32_t line_count;
    limni_ply_format format;
    limni_ply_element elements[LIMNI_PLY_ELEMENTS_MAX];
    limni_ply_property properties[LIMNI_PLY_PROPERTIES_MAX];
    uint32_t element_count, property_count;
    uint32_t vertex_count; ///< of the element vertex
} limni_ply_header;

/// Reads the header at the start of `text`, which ends with a zero and may go on with anything.
/// After success there is a format, the element vertex has x, y and z once each, and the element
/// face has one list of whole numbers, its corners. The counts are as stated. Memory belongs to the
/// context.
limn_bake_status limni_ply_header_read(limni_context *context, const char *path, const char *text,
                                       limni_ply_header *header);

#endif
