/* SPDX-License-Identifier: MIT */
/* Draws a scene into the framebuffer that is bound. Knows no window, file or picture. */
#ifndef VIEW_RENDERER_H
#define VIEW_RENDERER_H

#include "camera.h"
#include "gl.h"
#include "surface.h"

typedef struct view_renderer view_renderer;

/// What surfaces are coloured by. The shader knows them by number.
typedef enum view_colours {
    VIEW_COLOURS_MATERIALS, ///< and clay where there are none
    VIEW_COLOURS_LEVELS,
    VIEW_COLOURS_CLASSES,
    VIEW_COLOURS_NORMALS, ///< and no light
    VIEW_COLOURS_UV,      ///< a chequered pattern in texture coordinates
    VIEW_COLOURS_CLAY,
    VIEW_COLOURS_COUNT
} view_colours;

/// One picture.
typedef struct view_frame {
    view_camera camera;
    uint32_t width, height; ///< of the framebuffer, which must encode sRGB
    float pixel_scale;      ///< framebuffer pixels per pixel of line width
    view_colours colours;
    bool vertex_light; ///< that of the vertices, instead of the shader's own
    bool flat_shading; ///< a normal for each triangle
    bool wireframe;
    bool control_mesh;
    bool unsewn; ///< patches are not sewn to coarser neighbours: cracks show
} view_frame;

/// The size of a pixel of line width in a picture: lines keep their proportion to it, but stay
/// visible in a small one.
float view_line_scale(uint32_t width, uint32_t height);

/// Uploads what stays the same in all frames: templates, materials, control meshes. What is drawn
/// must outlive the renderer, as must `gl`. Reports why and returns NULL on failure.
view_renderer *view_renderer_create(const view_gl *gl, const view_surfaces *drawn);

/// Memory on the GPU for the vertices of the next frame, to be written by any thread, and not read:
/// of all surfaces, each from its `first_vertex` on. Reports why and returns NULL on failure.
view_vertex *view_renderer_map(view_renderer *renderer, uint64_t vertex_count);

/// Draws the plans of all surfaces with the vertices that were written. Reports why and returns
/// false on failure.
bool view_renderer_draw(view_renderer *renderer, const view_frame *frame);

/// Takes NULL as well. The context must still be current.
void view_renderer_destroy(view_renderer *renderer);

#endif
