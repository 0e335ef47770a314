/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_TRIANGULATE_H
#define LIMNI_TRIANGULATE_H

#include "mesh.h"

/// Cuts the polygons of a source into the triangles of a mesh, which has room for corners, with
/// those of the source, and polygons, and no faces yet.
limn_bake_status limni_triangulate(limni_context *context, const limni_source *source,
                                   limni_mesh *mesh);

#endif
