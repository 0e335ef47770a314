/* SPDX-License-Identifier: MIT */
/* From a .limn file to a PNG file, without a window. */
#ifndef VIEW_PICTURE_H
#define VIEW_PICTURE_H

#include "frame_options.h"
#include "light.h"
#include "renderer.h"

typedef struct view_picture {
    const char *limn_path;
    const char *png_path;      ///< NULL: a window instead
    const char *keys;          ///< pressed in the window, for tests; or NULL
    limni_frame_options frame; ///< checked
    uint32_t width, height;
    view_light light;
    long mesh_index; ///< or VIEW_ALL_MESHES
    view_colours colours;
    bool flat_shading;
    bool wireframe;
    bool control_mesh;
    bool overview; ///< not from the eye of the frame
} view_picture;

/// Reports why and returns false on failure, in which case nothing is written.
bool view_picture_make(const view_picture *picture);

#endif
