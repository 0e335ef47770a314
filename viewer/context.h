/* SPDX-License-Identifier: MIT */
/*
 * An OpenGL 3.3 core context, wherever it comes from. One file implements this for every way of
 * getting one (context_osmesa.c); everything that draws sees only this interface and gl.h.
 */
#ifndef VIEW_CONTEXT_H
#define VIEW_CONTEXT_H

typedef struct view_context view_context;

/// Any OpenGL function; the caller casts it to its type.
typedef void (*view_gl_fn)(void);

/// Creates a context and makes it current on this thread. It may have no usable default
/// framebuffer: draw into framebuffer objects. Reports why and returns NULL on failure.
view_context *view_context_create(void);

/// The OpenGL function `name` ("glClear"), or NULL if there is none.
view_gl_fn view_context_function(const view_context *context, const char *name);

/// Takes NULL as well.
void view_context_destroy(view_context *context);

#endif
