/* SPDX-License-Identifier: MIT */
/* Shader programs. */
#ifndef VIEW_PROGRAM_H
#define VIEW_PROGRAM_H

#include "gl.h"

typedef struct view_program_sources {
    const char *name; ///< for messages
    const char *vertex;
    const char *geometry; ///< or NULL
    const char *fragment;
    const char *definitions; ///< lines that go before every stage; or NULL
} view_program_sources;

/// Compiles and links a program for GLSL 3.30. Reports the compiler's words and returns 0 on
/// failure.
GLuint view_program_create(const view_gl *gl, const view_program_sources *sources);

#endif
