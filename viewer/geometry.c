/* SPDX-License-Identifier: MIT */
#include "geometry.h"

#include <stdint.h>

view_geometry view_geometry_create(const view_gl *gl, const void *indices, size_t size) {
    view_geometry result;
    gl->GenVertexArrays(1, &result.layout);
    gl->BindVertexArray(result.layout);
    gl->GenBuffers(1, &result.index_buffer);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, result.index_buffer);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)size, indices, GL_STATIC_DRAW);
    return result;
}

void view_geometry_destroy(const view_gl *gl, const view_geometry *geometry) {
    gl->DeleteVertexArrays(1, &geometry->layout);
    gl->DeleteBuffers(1, &geometry->index_buffer);
}

void view_attribute_floats(const view_gl *gl, GLuint attribute, GLint count, size_t stride,
                           size_t offset) {
    gl->EnableVertexAttribArray(attribute);
    gl->VertexAttribPointer(attribute, count, GL_FLOAT, GL_FALSE, (GLsizei)stride,
                            (const void *)(uintptr_t)offset);
}

void view_attribute_bytes(const view_gl *gl, GLuint attribute, GLboolean normalised, size_t stride,
                          size_t offset) {
    gl->EnableVertexAttribArray(attribute);
    gl->VertexAttribPointer(attribute, 4, GL_UNSIGNED_BYTE, normalised, (GLsizei)stride,
                            (const void *)(uintptr_t)offset);
}
