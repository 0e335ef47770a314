/* SPDX-License-Identifier: MIT */
/* Indices on the GPU, and how the vertices are laid out that they are used with. */
#ifndef VIEW_GEOMETRY_H
#define VIEW_GEOMETRY_H

#include "gl.h"
#include <stddef.h>

typedef struct view_geometry {
    GLuint layout;
    GLuint index_buffer;
} view_geometry;

/// Uploads indices, of `size` bytes. The attributes of the layout are set when it is drawn.
view_geometry view_geometry_create(const view_gl *gl, const void *indices, size_t size);
void view_geometry_destroy(const view_gl *gl, const view_geometry *geometry);

/// An attribute of the layout that is bound, from the buffer that is bound: `count` floats.
void view_attribute_floats(const view_gl *gl, GLuint attribute, GLint count, size_t stride,
                           size_t offset);

/// Four bytes; `normalised`: 255 stands for 1.
void view_attribute_bytes(const view_gl *gl, GLuint attribute, GLboolean normalised, size_t stride,
                          size_t offset);

#endif
