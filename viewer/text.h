/* SPDX-License-Identifier: MIT */
/* Lines of text over a picture. */
#ifndef VIEW_TEXT_H
#define VIEW_TEXT_H

#include "stream.h"

typedef struct view_text {
    const view_gl *gl;
    GLuint program, layout, indices;
    view_stream vertices;
} view_text;

/// Reports why and returns false on failure; destroy it in either case.
bool view_text_create(view_text *text, const view_gl *gl);

/// Draws lines of ASCII in the upper left corner of a framebuffer that encodes sRGB, on a panel.
/// What is too long is left out. Reports why and returns false on failure.
///
/// scale  pixels of the dots that letters are made of
bool view_text_draw(view_text *text, const char *lines, uint32_t width, uint32_t height,
                    float scale);

void view_text_destroy(view_text *text);

#endif
