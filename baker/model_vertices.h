/* SPDX-License-Identifier: MIT */
/*
 * The vertices of one mesh: those of its parts, one behind the other, and the positions that they
 * become. Vertices with the same place are one position if joints and morph targets move them alike;
 * what else they differ in is left to channels.
 */
#ifndef LIMNI_MODEL_VERTICES_H
#define LIMNI_MODEL_VERTICES_H

#include "model_reader.h"

typedef struct limni_model_vertices {
    limni_model_reader *reader;
    const limni_model_node *node;
    uint32_t node_index;
    const limni_model_mesh *mesh;
    limni_label label; ///< of the mesh
    uint32_t count;
    uint32_t *moved; ///< [count] the position of each
} limni_model_vertices;

/// Makes equal records one, each the first of them. Returns how many are left; UINT32_MAX: out of
/// memory.
///
/// records  [count] of `size` bytes
/// moved    out: [count] the new index of each
uint32_t limni_model_merge(limni_context *context, const void *records, size_t size, uint32_t count,
                           uint32_t *moved);

/// Fills in the positions of a source, and what moves them.
limn_bake_status limni_model_read_vertices(limni_model_vertices *vertices, limni_source *source);

/// The influences of the skin of the node: LIMN_INFLUENCE_MAX for each vertex.
limn_bake_status limni_model_read_influences(const limni_model_vertices *vertices, uint16_t *joints,
                                             float *weights);

/// Texture coordinates and colours, each value by the corners of the faces that have it.
///
/// corners  [corner_count] vertices
limn_bake_status limni_model_read_channels(const limni_model_vertices *vertices,
                                           const uint32_t *corners, uint32_t corner_count,
                                           limni_source *source);

/// What the mesh says about sharpness.
limn_bake_status limni_model_read_tags(const limni_model_vertices *vertices, limni_tags *tags);

#endif
