/* SPDX-License-Identifier: MIT */
/* Smooth normals from triangles, for files that are baked without exact ones. */
#ifndef VIEW_NORMALS_H
#define VIEW_NORMALS_H

#include "scene.h"
#include <stdbool.h>

/// Sets the normals of all vertices of an evaluated plan. Vertices of different patches with the
/// same position are the same vertex of the surface, to the bit: that is what Limn promises.
/// `indices` are those of the templates. False if memory ran out; says nothing.
bool view_normals_compute(const limn_plan *plan, const uint16_t *indices, view_vertex *vertices);

#endif
