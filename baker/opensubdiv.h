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

/// What the surface is, and what its patches are.
typedef enum limni_opensubdiv_scheme {
    LIMNI_OPENSUBDIV_LOOP,    ///< triangles only; patches of the triangle domain
    LIMNI_OPENSUBDIV_CATMARK, ///< Catmull-Clark; patches of the quad domain
    LIMNI_OPENSUBDIV_BILINEAR ///< bilinear faces, with the same patches; sharpness has no effect
} limni_opensubdiv_scheme;

/// A mesh, its patches and the grid that is asked for. Unused positions are fine. Zero stands for
/// whole triangles in Loop's scheme without tags.
///
/// Faces are patches with the face's corner c as their corner c. Divided, with Catmull-Clark and
/// bilinear, a face of n corners is n patches, in the order of its corners k. Patch k has its corner
/// 0 at the face's corner k, corner 1 in the middle of edge k, which leads to corner k + 1, corner 2
/// in the middle of the face, and corner 3 in the middle of edge k - 1: of a quad a quarter, of
/// another face the ptex face. Faces that are not quads have no other patches.
typedef struct limni_opensubdiv_mesh {
    const float *positions;     ///< [position_count][3]; may be NULL for the stencil count
    const uint32_t *faces;      ///< the corners of all faces, one face after the other,
                                ///< counter-clockwise
    const uint32_t *face_sizes; ///< [face_count] corners of each; NULL: all triangles
    uint32_t position_count;
    uint32_t face_count;
    limni_opensubdiv_scheme scheme;
    bool divided; ///< whether a patch is not a face, but what one step of subdivision makes at a
                  ///< corner of it
    limn_boundary boundary;
    uint32_t level; ///< of the grid of a patch, 0 to LIMN_LEVEL_MAX; no default: 0 is the corners
                    ///< alone
    const float *edge_sharpness;   ///< of the edges that begin at each of `faces`; NULL: 0
    const float *vertex_sharpness; ///< [position_count]; NULL: 0
    const bool *holes;             ///< [face_count]; NULL: none
    limn_creasing creasing;
} limni_opensubdiv_mesh;

/// How many patches the mesh has; at most a million are answered for.
uint32_t limni_opensubdiv_patch_count(const limni_opensubdiv_mesh *mesh);

/// Limit positions at every grid vertex of every patch, in double precision: true limits, for which
/// all sharpness has decayed. Without sharpness and holes: uniform refinement to mesh->level, then
/// PrimvarRefiner::Limit. At level 4 it takes some 60 KB and 0.1 ms for each patch. Otherwise, and
/// always with bilinear faces, whose vertices have no tangents: Bfr's surfaces at level 10, where
/// all sharpness has decayed; with Chaikin's method, in which they are wrong in places, again
/// uniform refinement, to the level where it has. What is not manifold is sharp. Where OpenSubdiv's
/// limits depend on the level, at the ends of creases and with Catmull-Clark at vertices of two
/// faces, they are those of level 15; at the latter there need be no tangent plane.
/// Returns false, with a text in `error`, when an index is out of range, when the scheme or the
/// patches cannot have a face of so many corners, when OpenSubdiv refuses or is known to fail, or
/// when out of memory.
///
/// limit             out: [patch_count][domain->row_counts[level]], the rows of the domain; not a
///                   number where OpenSubdiv has no surface
/// tangents          out, or NULL: two tangents at the same places, of any length, of the face's
///                   own side of a crease, or with Chaikin's method of either; their cross product
///                   is the normal
/// error             [error_size] bytes, error_size > 0; "" on success
bool limni_opensubdiv_limit(const limni_opensubdiv_mesh *mesh, double (*limit)[3],
                            double (*tangents)[2][3], char *error, size_t error_size);

/// Values that belong to the corners of faces.
typedef struct limni_opensubdiv_channel {
    const float *values; ///< [value_count][3]
    uint32_t value_count;
    const uint32_t *corner_values;  ///< one for each of the mesh's `faces`
    limn_face_varying face_varying; ///< not the default
} limni_opensubdiv_channel;

/// Limits of a channel's values, as limni_opensubdiv_limit() has positions: uniform refinement to
/// the level at which nothing is semi-sharp, and PrimvarRefiner::LimitFaceVarying. Where that limit
/// depends on the level (see there), it is not a number.
///
/// limit  out: [patch_count][domain->row_counts[level]]
bool limni_opensubdiv_values(const limni_opensubdiv_mesh *mesh,
                             const limni_opensubdiv_channel *channel, double (*limit)[3],
                             char *error, size_t error_size);

/// What a Far::LimitStencilTable (float, positions only) occupies.
typedef struct limni_opensubdiv_stencils {
    uint64_t stencil_count;
    uint64_t weight_count;
    uint64_t byte_count; ///< sizes, offsets, indices and weights
} limni_opensubdiv_stencils;

/// Builds OpenSubdiv's limit stencils for the grid of every face and measures them; of Loop's scheme
/// only. They come from
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
