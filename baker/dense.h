/* SPDX-License-Identifier: MIT */
/* A mesh evaluated at one level: what `limn export` writes. */
#ifndef LIMNI_DENSE_H
#define LIMNI_DENSE_H

#include "context.h"
#include "limn/limn.h"

#include <stdio.h>

typedef struct limni_dense {
    const char *name;
    float (*vertices)[3]; ///< [vertex_count]
    uint32_t *indices;    ///< [index_count], three per triangle
    uint32_t vertex_count;
    uint64_t index_count;
} limni_dense;

/// Evaluates the bind pose at `level`. With `weld`, vertices whose positions have equal bits become
/// one; otherwise every patch keeps its own.
limn_bake_status limni_dense_build(limni_context *context, const limn_mesh *mesh, uint32_t level,
                                   bool weld, limni_dense *dense);

/// Both write numbers so that they read back to the same bits; the stream keeps the error.
void limni_dense_write_obj(const limni_dense *meshes, uint32_t mesh_count, FILE *stream);
void limni_dense_write_ply(const limni_dense *meshes, uint32_t mesh_count, FILE *stream);

#endif
