/* SPDX-License-Identifier: MIT */
/* The triangles that a frame draws of a mesh: what `limn export` writes. */
#ifndef LIMNI_DENSE_H
#define LIMNI_DENSE_H

#include "context.h"
#include "frame.h"

#include <stdio.h>

typedef struct limni_dense {
    const char *name;
    float (*vertices)[3]; ///< [vertex_count]
    uint32_t *indices;    ///< [index_count], three per triangle
    uint32_t vertex_count;
    uint64_t index_count;
    uint64_t evaluated_count; ///< vertices of the plan: before unused ones were dropped
} limni_dense;

/// Plans and evaluates the mesh with its own control points. Every vertex is used by a triangle. With `weld`, vertices
/// that neighbouring patches share become one where their positions have equal bits; otherwise
/// every patch keeps its own.
limn_bake_status limni_dense_build(limni_context *context, const limn_mesh *mesh,
                                   const limni_frame *frame, bool weld, limni_dense *dense);

/// Both write numbers so that they read back to the same bits; the stream keeps the error.
void limni_dense_write_obj(const limni_dense *meshes, uint32_t mesh_count, FILE *stream);
void limni_dense_write_ply(const limni_dense *meshes, uint32_t mesh_count, FILE *stream);

#endif
