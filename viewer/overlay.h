/* SPDX-License-Identifier: MIT */
/* Control meshes, drawn over the surfaces that they shape. */
#ifndef VIEW_OVERLAY_H
#define VIEW_OVERLAY_H

#include "geometry.h"
#include "renderer.h"
#include "stream.h"

typedef struct view_overlay {
    const view_gl *gl;
    view_surfaces drawn;
    GLuint lines, points;           ///< programs
    view_geometry *edges, *corners; ///< [drawn.count]
    view_stream controls;           ///< of float[3]
} view_overlay;

/// Reports why and returns false on failure; destroy the overlay in either case.
bool view_overlay_create(view_overlay *overlay, const view_gl *gl, const view_surfaces *drawn);

/// Reports why and returns false on failure.
bool view_overlay_draw(view_overlay *overlay, const view_frame *frame);

void view_overlay_destroy(view_overlay *overlay);

#endif
