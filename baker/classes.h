/* SPDX-License-Identifier: MIT */
/*
 * The classes of a file: a dictionary from keys to stencil tables, shared by all its meshes.
 *
 * A key names all control points around a face, but at a boundary not all of them have a say.
 * Columns that are zero everywhere are left out of the tables, and keys whose tables turn out equal
 * share one.
 */
#ifndef LIMNI_CLASSES_H
#define LIMNI_CLASSES_H

#include "../runtime/domain.h"
#include "classify.h"
#include "limn/format.h"

enum {
    LIMNI_SLOT_UNUSED = 0xffff, ///< of a control point without a column
};

/// What one column says along one edge of the patch, as numbers: 0 if it is zero there. Two
/// classes agree on an edge if their columns along it do.
typedef struct limni_edge_print {
    uint64_t positions, tangents;
} limni_edge_print;

typedef struct limni_edge_prints {
    limni_edge_print along[LIMN_CORNER_MAX];   ///< read in the direction of edge e
    limni_edge_print against[LIMN_CORNER_MAX]; ///< read the other way, as the neighbour sees it
} limni_edge_prints;

/// What a table is for: a patch at all its levels, or one piece of an isolated patch.
typedef enum limni_table_kind {
    LIMNI_TABLE_PATCH,
    LIMNI_TABLE_CORNER, ///< see limni_piece_kind
    LIMNI_TABLE_MIDDLE
} limni_table_kind;

/// A stencil table; or what a class is that has pieces in its place.
typedef struct limni_class {
    limn_domain_kind domain;
    limni_table_kind kind;
    uint32_t control_count;
    uint32_t valences[LIMN_CORNER_MAX]; ///< of the first key that has this table
    uint32_t boundary_corners;          ///< bit c
    uint32_t pair_count;                ///< of columns, if the class is its own mirror image
    uint32_t table_count;               ///< 1, or 3 with the tangents
    uint32_t row_stride;                ///< rows of a column in the file
    float negative;                     ///< see limn_file_class; of pieces, the largest of theirs
    float *table; ///< [table_count][control_count][row_stride]; NULL: in pieces
    uint16_t *
        parts; ///< [LIMN_FORMAT_PIECE_COUNT] the pieces, and [LIMN_FORMAT_PIECE_COUNT][control_count] the
               ///< column of each slot; NULL: it has a table
    limni_edge_prints *prints; ///< [control_count]
} limni_class;

/// Bytes of the tables of a class; 0 of one in pieces.
static inline size_t limni_class_table_size(const limni_class *class) {
    return (size_t) class->table_count * class->control_count * class->row_stride * sizeof(float);
}

/// Bytes of what a class in pieces has instead.
static inline size_t limni_class_parts_size(const limni_class *class) {
    return LIMN_FORMAT_PIECE_COUNT * (1 + (size_t) class->control_count) * sizeof *class->parts;
}

/// As it is stored, its table at the start of the tables.
limn_file_class limni_class_record(const limni_class *class);
limn_file_piece limni_piece_record(const limni_class *piece);

/// A topology, and the table that it uses.
typedef struct limni_class_key {
    limn_scheme scheme;
    limn_domain_kind domain;
    limni_table_kind kind;
    uint32_t table_count;
    uint32_t *words; ///< [size]
    uint32_t size;
    uint32_t class_index;
    uint16_t *slots; ///< [control count of the local base] the column of each, or LIMNI_SLOT_UNUSED
} limni_class_key;

/// Indices by hash, LIMNI_NONE where free. The size is a power of two.
typedef struct limni_index_table {
    uint32_t *indices;
    uint32_t size;
} limni_index_table;

typedef struct limni_classes {
    limni_class *items;
    limni_class_key *keys;
    uint32_t count, key_count, capacity;
    limni_index_table by_key, by_table;
} limni_classes;

/// The index of the key of a local base. Its class is made on first sight. Where no normals are asked
/// for, it may have them.
limn_bake_status limni_classes_find(limni_context *context, limni_classes *classes,
                                    const limni_rules *rules, const limni_local_base *base,
                                    limni_table_kind kind, uint32_t *key_index);

/// The index of the class that is made of these pieces, which is made on first sight.
///
/// class  without a table; its parts are copied
limn_bake_status limni_classes_find_parts(limni_context *context, limni_classes *classes,
                                          const limni_class *class, uint32_t *class_index);

#endif
