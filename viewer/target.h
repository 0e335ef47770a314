/* SPDX-License-Identifier: MIT */
/* A framebuffer to draw an antialiased picture into, and to read it back from. */
#ifndef VIEW_TARGET_H
#define VIEW_TARGET_H

#include "gl.h"
#include "image.h"

/// Longest side of a picture: twice as much, for supersampling, is what OpenGL drivers have.
enum { VIEW_TARGET_SIZE_MAX = 8192 };

typedef struct view_target {
    const view_gl *gl;
    uint32_t width, height; ///< of the framebuffer: the picture's, times pixel_scale
    uint32_t pixel_scale;   ///< framebuffer pixels per picture pixel, along each side
    GLuint framebuffers[2]; ///< multisampled; resolved
    GLuint color_buffers[2];
    GLuint depth_buffer;
} view_target;

/// Creates and binds a target for a picture of the given size: four samples per pixel, or four
/// times as many where `fine` and not too much. Reports why and returns false on failure; destroy
/// the target in either case.
bool view_target_create(view_target *target, const view_gl *gl, uint32_t width, uint32_t height,
                        bool fine);

/// Binds the target to be drawn into again.
void view_target_bind(const view_target *target);

/// Copies what was drawn to the window, which must have the size of the target.
void view_target_show(const view_target *target);

/// Reads what was drawn. Reports why and returns false on failure; free the image in either case.
bool view_target_read(const view_target *target, view_image *image);

void view_target_destroy(view_target *target);

#endif
