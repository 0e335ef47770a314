/* SPDX-License-Identifier: MIT */
/* What the materials of a file look like: base colours, and images where the file has them. */
#ifndef VIEW_ALBEDO_H
#define VIEW_ALBEDO_H

#include "limn/limn.h"

enum {
    VIEW_ALBEDO_LAYERS = 255, ///< further materials look like clay
    VIEW_ALBEDO_NONE = 255,   ///< no layer
    VIEW_ALBEDO_SIZE_MAX =
        2048 ///< of an image that is larger, every other pixel is taken, and so on
};

/// One layer for each material, all of one size.
typedef struct view_albedo {
    uint8_t *texels; ///< [layer_count][height][width][4], encoded as sRGB, first row on top; NULL:
                     ///< no materials
    uint32_t width, height, layer_count;
} view_albedo;

/// Notes the images that are not in the file or cannot be read. Reports why and returns false on failure.
bool view_albedo_make(view_albedo *albedo, const limn_pack *pack);
void view_albedo_free(view_albedo *albedo);

#endif
