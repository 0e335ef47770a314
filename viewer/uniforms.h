/* SPDX-License-Identifier: MIT */
/* What all shader programs are told of a frame. */
#ifndef VIEW_UNIFORMS_H
#define VIEW_UNIFORMS_H

#include "renderer.h"

/// Uses a program for a frame.
void view_uniforms_use(const view_gl *gl, GLuint program, const view_frame *frame);

/// Where what is drawn next stands: [16], or NULL for where it is.
void view_uniforms_place(const view_gl *gl, GLuint program, const view_frame *frame,
                         const float *place);

#endif
