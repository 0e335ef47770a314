/* SPDX-License-Identifier: MIT */
/* From a .limn file to a PNG file, without a window. */
#ifndef VIEW_PICTURE_H
#define VIEW_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct view_picture {
    const char *limn_path;
    const char *png_path;
    uint32_t level; ///< up to LIMN_LEVEL_MAX
    uint32_t width, height;
    long mesh_index; ///< or VIEW_ALL_MESHES
    bool wireframe;
    bool control_mesh;
} view_picture;

/// Reports why and returns false on failure, in which case nothing is written.
bool view_picture_make(const view_picture *picture);

#endif
