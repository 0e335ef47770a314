/* SPDX-License-Identifier: MIT */
/* Pictures of the frames of a scene, as limn-view draws them. */
#ifndef FRAME_WAY_DRAWN_H
#define FRAME_WAY_DRAWN_H

#include "way.h"

/// Draws one frame of a scene into a PNG file: triangles, the borders of patches, and a colour for
/// each level. False after a message.
///
/// width,height  of the picture, in pixels; levels are those of the scene's viewport
bool frame_draw_picture(const frame_host *host, uint32_t frame, uint32_t frame_count,
                        uint32_t width, uint32_t height, const char *path);

#endif
