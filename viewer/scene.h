/* SPDX-License-Identifier: MIT */
/* The meshes of a .limn file, evaluated: everything that a picture shows, and no OpenGL. */
#ifndef VIEW_SCENE_H
#define VIEW_SCENE_H

#include "asset.h"
#include "camera.h"
#include "light.h"
#include "moment.h"
#include "surface.h"
#include <stdbool.h>

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

/// The surfaces of a scene, for a renderer.
view_surfaces view_scene_surfaces(const view_scene *scene);

/// A camera that sees all surfaces at their finest level, whatever level the scene has, so that
/// pictures of different levels lie on top of each other; and the control points, if asked to.
/// Reports why and returns false on failure.
bool view_scene_frame(const view_scene *scene, double aspect, bool with_controls,
                      limni_camera *camera);

#endif
