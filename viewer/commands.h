/* SPDX-License-Identifier: MIT */
/* The draws of a frame: for the GPU to read from a buffer, where the driver can do that, or else as
 * arguments. A draw names a template and the first vertex of a patch. */
#ifndef VIEW_COMMANDS_H
#define VIEW_COMMANDS_H

#include "gl.h"
#include "stream.h"
#include "surface.h"

typedef struct view_commands {
    const view_gl *gl;
    view_surfaces drawn;
    size_t *first;      ///< [drawn.count] the first draw of each surface
    view_stream buffer; ///< of limn_draw
    GLsizei
        *index_counts; ///< [all patches], as are the others: arguments, where there is no buffer
    const void **index_offsets;
    GLint *base_vertices;
} view_commands;

/// Reports why and returns false on failure; destroy the commands in either case.
bool view_commands_create(view_commands *commands, const view_gl *gl, const view_surfaces *drawn);

/// Writes the draws of the plans of all surfaces. `unsewn`: patches do not fit coarser neighbours.
/// Reports why and returns false on failure.
bool view_commands_write(view_commands *commands, bool unsewn);

/// Draws a surface, whose layout is bound.
void view_commands_draw(const view_commands *commands, uint32_t surface);

/// To be called when all are drawn.
void view_commands_end(view_commands *commands);

void view_commands_destroy(view_commands *commands);

#endif
