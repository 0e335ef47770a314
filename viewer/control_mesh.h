/* SPDX-License-Identifier: MIT */
/* The edges of the base mesh, found again in the patches of a baked mesh. */
#ifndef VIEW_CONTROL_MESH_H
#define VIEW_CONTROL_MESH_H

#include "limn/limn.h"
#include <stdbool.h>

typedef struct view_control_mesh {
    uint32_t (*edges)[2]; ///< pairs of control points, each edge once
    uint32_t *points;     ///< the control points that have an edge, ascending
    uint32_t edge_count;
    uint32_t point_count;
} view_control_mesh;

/// Finds the control mesh of a baked mesh. False if memory ran out; says nothing.
bool view_control_mesh_find(view_control_mesh *control_mesh, const limn_mesh *mesh);

void view_control_mesh_free(view_control_mesh *control_mesh);

#endif
