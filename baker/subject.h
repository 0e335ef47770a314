/* SPDX-License-Identifier: MIT */
/* What was baked, read again to be compared: the mesh in a file, as OpenSubdiv takes it. */
#ifndef LIMNI_SUBJECT_H
#define LIMNI_SUBJECT_H

#include "base.h"
#include "deviation.h"
#include "opensubdiv.h"

/// A mesh twice, and how it was baked.
typedef struct limni_subject {
    limni_opensubdiv_scheme scheme;
    limni_rules rules;
    limni_mesh built;    ///< split where it is no manifold, if that was asked for
    limni_mesh whole;    ///< as OpenSubdiv takes it; with the same faces, half-edges and holes
    limni_source source; ///< of the latter
    limni_base base;     ///< of `built`
} limni_subject;

/// Reads the mesh that `mesh` was baked from. Fails when it was baked from something else, by a
/// scheme or weights that OpenSubdiv does not have, or with Lomont's rules where these differ.
///
/// subject  must stay where it is
limn_bake_status limni_subject_read(limni_context *context, const limn_pack *pack,
                                    const limn_mesh *mesh, const char *path,
                                    limni_subject *subject);

/// The whole mesh, with patches at level 4 that are the faces of the base.
limn_bake_status limni_subject_describe(limni_context *context, const limni_subject *subject,
                                        limni_opensubdiv_mesh *mesh);

/// The rows of faces at the places of those of patches, by rotation.
typedef uint32_t limni_unrotated[LIMN_CORNER_MAX][LIMNI_ROWS_MAX];
void limni_unrotate(const limn_domain *domain, limni_unrotated rows);

#endif
