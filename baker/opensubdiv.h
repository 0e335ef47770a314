/* SPDX-License-Identifier: MIT */
/*
 * OpenSubdiv's answers, for comparison: an oracle for `limn verify`, the tests and the benchmarks.
 * Nothing of it goes into a .limn file.
 *
 * OpenSubdiv reports errors through one callback of the process; the functions here set it and put
 * back the default, so call them from one thread at a time, and from none while another part of the
 * program uses OpenSubdiv. Nothing is printed, and no exception leaves.
 */
#ifndef LIMNI_OPENSUBDIV_H
#define LIMNI_OPENSUBDIV_H

#include "limn/bake.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A triangle mesh and the grid that is asked for. Unused positions are fine.
typedef struct limni_opensubdiv_mesh {
    const float *positions; ///< [position_count][3]; may be NULL for the stencil count
    const uint32_t *faces;  ///< [face_count][3], counter-clockwise
    uint32_t position_count;
    uint32_t face_count; ///< at most a million
    limn_boundary boundary;
    uint32_t level; ///< of the grid, 0 to LIMN_LEVEL_MAX; no default: 0 is the corners alone
    const float *edge_sharpness; ///< [face_count][3] of the edges from corners 0, 1 and 2; NULL: 0
    const float *vertex_sharpness; ///< [position_count]; NULL: 0
    const bool *holes;             ///< [face_count]; NULL: none
    limn_creasing creasing;
} limni_opensubdiv_mesh;

/// Limit positions of Loop's scheme at every grid vertex of every face, in double precision.
/// Without sharpness and holes: uniform refinement to mesh->level, then PrimvarRefiner::Limit.
/// At level 4 it takes some 60 KB and 0.1 ms for each face. Otherwise Bfr's surfaces at level
/// 10, where all sharpness has decayed; with Chaikin's method, in which they are wrong in
/// places, again uniform refinement, to the level where it has. What is not manifold is sharp.
/// Returns false, with a text in `error`, when an index is out of range, when OpenSubdiv refuses,
/// or when out of memory.
///
/// limit             out: [face_count][domain->row_counts[level]], the rows of the triangle domain
///                   with corner c of the face as corner c of the domain; not a number where
///                   OpenSubdiv has no surface
/// tangents          out, or NULL: two tangents at the same places, of any length, of the face's
///                   own side of a crease, or with Chaikin's method of either; their cross product
///                   is the normal
/// error             [error_size] bytes, error_size > 0; "" on success
bool limni_opensubdiv_limit(const limni_opensubdiv_mesh *mesh, double (*limit)[3],
                            double (*tangents)[2][3], char *error, size_t error_size);

/// What a Far::LimitStencilTable (float, positions only) occupies.
typedef struct limni_opensubdiv_stencils {
    uint64_t stencil_count;
    uint64_t weight_count;
    uint64_t byte_count; ///< sizes, offsets, indices and weights
} limni_opensubdiv_stencils;

/// Builds OpenSubdiv's limit stencils for the grid of every face and measures them. They come from
/// adaptive refinement to level 6 (from level 4 on they equal limni_opensubdiv_limit() to rounding,
/// except at rounded corners of the boundary, where 1e-7 of the diagonal is left at level 6). Fails
/// as limni_opensubdiv_limit() does.
///
/// shared            true: one stencil for each distinct vertex of the refined mesh, the smallest
///                   table that OpenSubdiv can make; false: one for each row of each face, which is
///                   what independent patches need
/// stencils          out; untouched on failure
bool limni_opensubdiv_stencil_bytes(const limni_opensubdiv_mesh *mesh, bool shared,
                                    limni_opensubdiv_stencils *stencils, char *error,
                                    size_t error_size);

#ifdef __cplusplus
}
#endif

#endif
