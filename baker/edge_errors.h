/* SPDX-License-Identifier: MIT */
/* The errors of levels of detail in the bind pose, edge by edge. */
#ifndef LIMNI_EDGE_ERRORS_H
#define LIMNI_EDGE_ERRORS_H

#include "mesh.h"
#include "patches.h"

/// Measures every patch, and fills patches->errors. The patches must have all else.
limn_bake_status limni_edge_errors_build(limni_context *context, const limni_mesh *mesh,
                                         const limni_classes *classes, const limni_classes *pieces,
                                         limni_patches *patches);

#endif
