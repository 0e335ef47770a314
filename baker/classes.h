/* SPDX-License-Identifier: MIT */
/* The classes of a file: a dictionary from keys to stencil tables, shared by all its meshes. */
#ifndef LIMNI_CLASSES_H
#define LIMNI_CLASSES_H

#include "classify.h"

enum { LIMNI_TABLE_STRIDE = 160 }; ///< rows of a table column, padded

/// One column of a table, along one edge of the triangle, as a number: 0 if it is zero there. Two
/// classes agree on an edge if their columns along it do.
typedef struct limni_edge_prints {
    uint64_t along[3];   ///< read in the direction of edge e
    uint64_t against[3]; ///< read the other way, as the neighbour sees it
} limni_edge_prints;

typedef struct limni_class {
    uint32_t *key;
    uint32_t key_size;
    uint32_t control_count;
    uint32_t valences[3];
    uint32_t boundary_corners; ///< bit c
    float *table;              ///< [control_count][LIMNI_TABLE_STRIDE]
    limni_edge_prints *prints; ///< [control_count]
} limni_class;

typedef struct limni_classes {
    limni_class *items;
    uint32_t count, capacity;
    uint32_t *hash_table; ///< [hash_size] indices of items, or LIMNI_NONE
    uint32_t hash_size;
} limni_classes;

/// The index of the class of a local base, made on first sight.
limn_bake_status limni_classes_find(limni_context *context, limni_classes *classes,
                                    const limni_rules *rules, const limni_local_base *base,
                                    uint32_t *class_index);

#endif
