/* SPDX-License-Identifier: MIT */
#include "stream.h"

#include "report.h"

static const GLbitfield persistent_write =
    GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

view_stream view_stream_make(const view_gl *gl, size_t granule) {
    return (view_stream){.gl = gl, .granule = granule};
}

/// Blocks until the GPU has passed the fence of the region, which is rare: it is two frames behind.
static void wait_for_region(view_stream *stream) {
    static const GLuint64 second = 1000000000;
    GLsync *const fence = &stream->fences[stream->region];
    if (!*fence) return;
    while (stream->gl->ClientWaitSync(*fence, GL_SYNC_FLUSH_COMMANDS_BIT, second) ==
           GL_TIMEOUT_EXPIRED) {
    }
    stream->gl->DeleteSync(*fence);
    *fence = NULL;
}

/// Another buffer, half as large again as it must be. OpenGL keeps the old one while it is drawn.
static bool grow(view_stream *stream, size_t count) {
    const view_gl *const gl = stream->gl;
    const view_stream empty = view_stream_make(gl, stream->granule);
    view_stream_destroy(stream);
    *stream = empty;
    stream->region_size = (count + count / 2 + 1) * stream->granule;
    const GLsizeiptr size = (GLsizeiptr)(VIEW_STREAM_REGIONS * stream->region_size);
    gl->GenBuffers(1, &stream->buffer);
    gl->BindBuffer(GL_ARRAY_BUFFER, stream->buffer);
    if (gl->BufferStorage) {
        gl->BufferStorage(GL_ARRAY_BUFFER, size, NULL, persistent_write);
        stream->mapped = gl->MapBufferRange(GL_ARRAY_BUFFER, 0, size, persistent_write);
    } else {
        gl->BufferData(GL_ARRAY_BUFFER, size, NULL, GL_STREAM_DRAW);
    }
    return view_gl_check(gl, "making room for vertices");
}

void *view_stream_map(view_stream *stream, size_t count) {
    if (stream->region_size < count * stream->granule || !stream->buffer) {
        if (!grow(stream, count)) return NULL;
    }
    stream->region = (stream->region + 1) % VIEW_STREAM_REGIONS;
    wait_for_region(stream);
    const size_t offset = stream->region * stream->region_size;
    if (stream->mapped) return stream->mapped + offset;
    stream->gl->BindBuffer(GL_ARRAY_BUFFER, stream->buffer);
    void *const region = stream->gl->MapBufferRange(
        GL_ARRAY_BUFFER, (GLintptr)offset, (GLsizeiptr)stream->region_size,
        GL_MAP_WRITE_BIT | GL_MAP_UNSYNCHRONIZED_BIT | GL_MAP_INVALIDATE_RANGE_BIT);
    if (!region) view_gl_check(stream->gl, "mapping vertices");
    return region;
}

size_t view_stream_unmap(view_stream *stream) {
    if (!stream->mapped) {
        stream->gl->BindBuffer(GL_ARRAY_BUFFER, stream->buffer);
        stream->gl->UnmapBuffer(GL_ARRAY_BUFFER);
    }
    return stream->region * (stream->region_size / stream->granule);
}

void view_stream_fence(view_stream *stream) {
    stream->fences[stream->region] = stream->gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void view_stream_destroy(view_stream *stream) {
    if (!stream->gl) return;
    for (int region = 0; region < VIEW_STREAM_REGIONS; region++) {
        if (stream->fences[region]) stream->gl->DeleteSync(stream->fences[region]);
    }
    stream->gl->DeleteBuffers(1, &stream->buffer);
    *stream = (view_stream){0};
}
