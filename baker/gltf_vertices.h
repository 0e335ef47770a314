/* SPDX-License-Identifier: MIT */
/*
 * The vertices of the triangles of one mesh: those of its primitives, one behind the other, and the
 * positions that they become. Vertices with the same place are one position if joints and morph
 * targets move them alike; what else they differ in is left to channels.
 */
#ifndef LIMNI_GLTF_VERTICES_H
#define LIMNI_GLTF_VERTICES_H

#include "gltf_reader.h"

/// A primitive of triangles.
typedef struct limni_gltf_part {
    const limni_gltf_primitive *primitive;
    char label[128];       ///< "mesh 0 'body', primitive 1"
    uint32_t first, count; ///< vertices
} limni_gltf_part;

typedef struct limni_gltf_vertices {
    limni_gltf_reader *reader;
    const limni_gltf_node *node;
    uint32_t node_index;
    const limni_gltf_mesh *mesh;
    limni_gltf_label label; ///< of the mesh
    limni_gltf_part *parts; ///< [part_count]
    uint32_t part_count;
    uint32_t count;
    uint32_t *moved; ///< [count] the position of each
} limni_gltf_vertices;

/// The accessor of an attribute, or -1.
int limni_gltf_attribute_of(const limni_gltf_attributes *attributes, const char *name);

/// Makes equal records one, each the first of them. Returns how many are left; UINT32_MAX: out of
/// memory.
///
/// records  [count] of `size` bytes
/// moved    out: [count] the new index of each
uint32_t limni_gltf_merge(limni_context *context, const void *records, size_t size, uint32_t count,
                          uint32_t *moved);

/// Reads the positions of all parts and what moves them, and fills in those of the source.
limn_bake_status limni_gltf_read_vertices(limni_gltf_vertices *vertices, limni_source *source);

/// Reads the influences of the skin of the node: LIMN_INFLUENCE_MAX for each vertex.
limn_bake_status limni_gltf_read_influences(const limni_gltf_vertices *vertices, uint16_t *joints,
                                            float *weights);

/// Texture coordinates and colours, each value by the corners of the faces that have it.
///
/// corners  [corner_count] vertices
limn_bake_status limni_gltf_read_channels(const limni_gltf_vertices *vertices,
                                          const uint32_t *corners, uint32_t corner_count,
                                          limni_source *source);

#endif
