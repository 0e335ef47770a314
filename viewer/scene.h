/* SPDX-License-Identifier: MIT */
/* The meshes of a .limn file, evaluated: everything that a picture shows, and no OpenGL. */
#ifndef VIEW_SCENE_H
#define VIEW_SCENE_H

#include "albedo.h"
#include "asset.h"
#include "camera.h"
#include "control_mesh.h"
#include "light.h"
#include "limn/limn.h"
#include "moment.h"
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
    uint8_t reserved[3];
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
    view_control_mesh control_mesh;
    limn_channel uv; ///< where has_uv: the texture coordinates of its first material
    bool has_uv;
    uint8_t *materials; ///< [patch_count] VIEW_ALBEDO_NONE or a layer; NULL: nothing is said
} view_surface;

typedef struct view_scene {
    view_asset asset;
    limn_pack pack;
    limni_moment moment;
    limni_bounds bounds; ///< in that moment
    limni_frame frame;
    view_light_mode light_mode;
    view_lamps lamps; ///< unless that is VIEW_LIGHT_NONE
    view_albedo albedo;
    view_templates templates[LIMN_DOMAIN_COUNT]; ///< of the domains that surfaces have
    view_surface *surfaces;
    uint32_t surface_count;
    uint32_t first_mesh; ///< of the pack, that the first surface shows
} view_scene;

enum { VIEW_ALL_MESHES = -1 };

/// Opens a file with one of its meshes, or VIEW_ALL_MESHES, in the moment that the options say.
/// Reports why and returns false on failure. The scene must stay where it is, and be closed in
/// either case.
bool view_scene_open(view_scene *scene, const char *path, const limni_frame_options *options,
                     const view_light *light, long mesh_index);

void view_scene_close(view_scene *scene);

/// Plans and evaluates a frame of all surfaces in memory. Reports why and returns false on failure.
bool view_scene_evaluate(view_scene *scene);

/// Writes what vertices of patches [begin, end) of the plan of a surface have besides positions and
/// normals.
void view_vertices_describe(const view_surface *surface, uint32_t begin, uint32_t end,
                            view_vertex *vertices);

/// A camera that sees all surfaces at their finest level, whatever level the scene has, so that
/// pictures of different levels lie on top of each other; and the control points, if asked to.
/// Reports why and returns false on failure.
bool view_scene_frame(const view_scene *scene, double aspect, bool with_controls,
                      limni_camera *camera);

#endif
