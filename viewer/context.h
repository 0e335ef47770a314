/* SPDX-License-Identifier: MIT */
/*
 * An OpenGL 3.3 core context without a window system. One file implements this for every way of
 * getting one (context_osmesa.c). Everything that draws sees neither this nor the window, but gl.h.
 */
#ifndef VIEW_CONTEXT_H
#define VIEW_CONTEXT_H

#include "gl.h"

typedef struct view_context view_context;

/// Creates a context and makes it current on this thread. It may have no usable default
/// framebuffer: draw into framebuffer objects. Reports why and returns NULL on failure.
view_context *view_context_create(void);

/// Finds functions for view_gl_load().
view_gl_fn view_context_function(const char *name);

/// Takes NULL as well.
void view_context_destroy(view_context *context);

#endif
