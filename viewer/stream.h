/* SPDX-License-Identifier: MIT */
/*
 * A buffer that the CPU writes frame by frame while the GPU still draws the frames before: a ring
 * of three regions, each with a fence that says when the GPU is done with it. Mapped once and for
 * all where the driver has buffer storage, and otherwise without synchronisation in every frame.
 */
#ifndef VIEW_STREAM_H
#define VIEW_STREAM_H

#include "gl.h"
#include <stddef.h>
#include <stdint.h>

enum { VIEW_STREAM_REGIONS = 3 };

typedef struct view_stream {
    const view_gl *gl;
    size_t granule; ///< bytes of an element: regions begin at whole ones
    GLuint buffer;  ///< another one after the stream has grown
    size_t region_size;
    uint32_t region; ///< of this frame
    uint8_t *mapped; ///< all regions; NULL: they are mapped one at a time
    GLsync fences[VIEW_STREAM_REGIONS];
} view_stream;

/// An empty stream of elements of `granule` bytes.
view_stream view_stream_make(const view_gl *gl, size_t granule);

/// The next region, of at least `count` elements, to be written and not to be read: from any
/// thread. Waits until the GPU has drawn what was in it three frames before. Allocates only where
/// it must grow. Reports why and returns NULL on failure.
void *view_stream_map(view_stream *stream, size_t count);

/// To be called before the GPU reads the region. Returns its first element, counted from the start
/// of the buffer.
size_t view_stream_unmap(view_stream *stream);

/// To be called after the last draw that reads the region.
void view_stream_fence(view_stream *stream);

void view_stream_destroy(view_stream *stream);

#endif
