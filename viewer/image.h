/* SPDX-License-Identifier: MIT */
/* Pictures in memory and as PNG files. */
#ifndef VIEW_IMAGE_H
#define VIEW_IMAGE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct view_image {
    uint8_t *pixels; ///< [height][width][3]: red, green, blue, encoded as sRGB
    uint32_t width, height;
} view_image;

/// Reports and returns false if memory ran out.
bool view_image_create(view_image *image, uint32_t width, uint32_t height);

/// Turns the image upside down: OpenGL's first row is the lowest, a file's the highest.
void view_image_flip(view_image *image);

/// Replaces 2x2 pixels by one with their mean light. Both sides must be even.
void view_image_halve(view_image *image);

/// Writes a PNG file beside `path` and then renames it, so that there is a complete file at `path`
/// or what was there before. Reports why and returns false on failure.
bool view_image_write_png(const view_image *image, const char *path);

void view_image_free(view_image *image);

#endif
