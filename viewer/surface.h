/* SPDX-License-Identifier: MIT */
/* A mesh as a frame draws it, and its vertices. */
#ifndef VIEW_SURFACE_H
#define VIEW_SURFACE_H

#include "albedo.h"
#include "control_mesh.h"
#include "limn/limn.h"
#include <stdbool.h>

/// One vertex as it is drawn.
typedef struct view_vertex {
    float position[3];
    float normal[3];
    float level;        ///< of the patch, a real number
    uint8_t borders[4]; ///< grid steps, at most 16, from each edge of the patch; 255: no such edge
    uint8_t light[4];   ///< where there are lamps: red, green, blue
    float uv[2];        ///< texture coordinates; 0 where the mesh has none
    uint8_t material;   ///< the layer of its albedo, or VIEW_ALBEDO_NONE
    uint8_t class_colour[3]; ///< of the class of its patch, linear
} view_vertex;

/// The index templates of a domain; empty unless a surface has it.
typedef struct view_templates {
    uint16_t *indices;
    limn_template *templates;
    uint32_t index_count;
} view_templates;

/// One mesh as the frame draws it.
typedef struct view_surface {
    limn_mesh mesh;
    void *plan_memory;
    limn_plan plan;        ///< of `mesh` above
    uint32_t first_vertex; ///< among those of all surfaces
    view_vertex *vertices; ///< [plan.vertex_count]; NULL where they go to the GPU at once
    bool faceted;          ///< vertices have no normals
    const float *place;    ///< [16] a matrix as in view_camera, from its space into that of the
                           ///< picture; NULL: they are the same
    view_control_mesh control_mesh;
    limn_channel uv; ///< where has_uv: the texture coordinates of its first material
    bool has_uv;
    uint8_t *materials; ///< [patch_count] VIEW_ALBEDO_NONE or a layer; NULL: nothing is said
} view_surface;

/// What a renderer draws: a view, of what somebody else owns.
typedef struct view_surfaces {
    const view_surface *surfaces; ///< [count]
    uint32_t count;
    const view_templates *templates; ///< [LIMN_DOMAIN_COUNT]
    const view_albedo *albedo;
} view_surfaces;

/// The templates of a domain, unless they are there already. Reports why and returns false on
/// failure.
bool view_templates_make(view_templates *templates, const limn_domain *domain);
void view_templates_free(view_templates *templates);

/// Writes what vertices of patches [begin, end) of the plan of a surface have besides positions and
/// normals.
void view_vertices_describe(const view_surface *surface, uint32_t begin, uint32_t end,
                            view_vertex *vertices);

#endif
