/* SPDX-License-Identifier: MIT */
#include "control_mesh.h"

#include <stdlib.h>
#include <string.h>

static int compare_edges(const void *left, const void *right) {
    const uint32_t *const a = left, *const b = right;
    if (a[0] != b[0]) return a[0] < b[0] ? -1 : 1;
    return a[1] == b[1] ? 0 : a[1] < b[1] ? -1 : 1;
}

/// Sorts edges and removes repeated ones; returns how many are left.
static uint32_t remove_duplicates(uint32_t (*edges)[2], size_t edge_count) {
    qsort(edges, edge_count, sizeof *edges, compare_edges);
    size_t kept = 0;
    for (size_t edge = 0; edge < edge_count; edge++) {
        if (kept > 0 && compare_edges(edges[edge], edges[kept - 1]) == 0) continue;
        memmove(edges[kept++], edges[edge], sizeof *edges);
    }
    return (uint32_t)kept;
}

static uint32_t collect_edges(const limn_mesh *mesh, uint32_t (*edges)[2]) {
    const uint32_t corner_count = mesh->domain->corner_count;
    size_t count = 0;
    for (uint32_t patch = 0; patch < mesh->patch_count; patch++) {
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(mesh, patch, corners);
        for (uint32_t corner = 0; corner < corner_count; corner++) {
            const uint32_t a = corners[corner], b = corners[(corner + 1) % corner_count];
            edges[count][0] = a < b ? a : b;
            edges[count++][1] = a < b ? b : a;
        }
    }
    return remove_duplicates(edges, count);
}

/// The ends of all edges, once each: points[c] counts the edges of point c at first.
static uint32_t collect_points(const view_control_mesh *control_mesh, uint32_t point_count,
                               uint32_t *points) {
    for (uint32_t edge = 0; edge < control_mesh->edge_count; edge++) {
        points[control_mesh->edges[edge][0]]++;
        points[control_mesh->edges[edge][1]]++;
    }
    uint32_t kept = 0;
    for (uint32_t control = 0; control < point_count; control++) {
        if (points[control] > 0) points[kept++] = control;
    }
    return kept;
}

bool view_control_mesh_find(view_control_mesh *control_mesh, const limn_mesh *mesh) {
    const size_t edge_bound = (size_t)mesh->patch_count * mesh->domain->corner_count;
    *control_mesh = (view_control_mesh){
        .edges = calloc(edge_bound + 1, sizeof *control_mesh->edges),
        .points = calloc((size_t)mesh->point_count + 1, sizeof *control_mesh->points),
    };
    if (!control_mesh->edges || !control_mesh->points) {
        view_control_mesh_free(control_mesh);
        return false;
    }
    control_mesh->edge_count = collect_edges(mesh, control_mesh->edges);
    control_mesh->point_count =
        collect_points(control_mesh, mesh->point_count, control_mesh->points);
    return true;
}

void view_control_mesh_free(view_control_mesh *control_mesh) {
    free(control_mesh->edges);
    free(control_mesh->points);
    *control_mesh = (view_control_mesh){0};
}
