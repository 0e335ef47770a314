/* SPDX-License-Identifier: MIT */
#include "target.h"

#include "report.h"

enum { MULTISAMPLED, RESOLVED, SAMPLE_COUNT = 4 };

/// Sixteen samples per pixel where a picture is of a usual size; four, for the sake of memory, in
/// pictures so large that their pixels are small.
static uint32_t choose_pixel_scale(uint32_t width, uint32_t height, uint32_t size_max) {
    static const uint64_t usual_pixels = 1920 * 1440;
    const bool fits = 2 * width <= size_max && 2 * height <= size_max;
    return fits && (uint64_t)width * height <= usual_pixels ? 2 : 1;
}

static void create_color_buffer(view_target *target, int which, GLsizei sample_count) {
    const view_gl *const gl = target->gl;
    gl->BindRenderbuffer(GL_RENDERBUFFER, target->color_buffers[which]);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, sample_count, GL_SRGB8_ALPHA8,
                                       (GLsizei)target->width, (GLsizei)target->height);
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffers[which]);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                target->color_buffers[which]);
}

static void create_depth_buffer(view_target *target, GLsizei sample_count) {
    const view_gl *const gl = target->gl;
    gl->BindRenderbuffer(GL_RENDERBUFFER, target->depth_buffer);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, sample_count, GL_DEPTH_COMPONENT24,
                                       (GLsizei)target->width, (GLsizei)target->height);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                target->depth_buffer);
}

bool view_target_create(view_target *target, const view_gl *gl, uint32_t width, uint32_t height,
                        bool fine) {
    GLint size_max = 0, sample_max = 0;
    gl->GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &size_max);
    gl->GetIntegerv(GL_MAX_SAMPLES, &sample_max);
    const uint32_t scale = fine ? choose_pixel_scale(width, height, (uint32_t)size_max) : 1;
    *target = (view_target){
        .gl = gl, .width = width * scale, .height = height * scale, .pixel_scale = scale};
    gl->GenFramebuffers(2, target->framebuffers);
    gl->GenRenderbuffers(2, target->color_buffers);
    gl->GenRenderbuffers(1, &target->depth_buffer);

    const GLsizei sample_count = sample_max < SAMPLE_COUNT ? sample_max : SAMPLE_COUNT;
    create_color_buffer(target, RESOLVED, 0);
    create_color_buffer(target, MULTISAMPLED, sample_count);
    create_depth_buffer(target, sample_count);
    if (!view_gl_check(gl, "creating a framebuffer")) return false;
    const GLenum status = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return true;
    return view_fail("OpenGL: a framebuffer of %ux%u pixels is refused (0x%04x)", target->width,
                     target->height, status);
}

void view_target_bind(const view_target *target) {
    target->gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffers[MULTISAMPLED]);
}

static void copy(const view_target *target, GLuint from, GLuint to) {
    const view_gl *const gl = target->gl;
    const GLint width = (GLint)target->width, height = (GLint)target->height;
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, from);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    gl->BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void view_target_show(const view_target *target) {
    copy(target, target->framebuffers[MULTISAMPLED], target->framebuffers[RESOLVED]);
    target->gl->Disable(GL_FRAMEBUFFER_SRGB); // the bytes as they are, already encoded
    copy(target, target->framebuffers[RESOLVED], 0);
}

bool view_target_read(const view_target *target, view_image *image) {
    const view_gl *const gl = target->gl;
    const GLint width = (GLint)target->width, height = (GLint)target->height;
    if (!view_image_create(image, target->width, target->height)) return false;
    copy(target, target->framebuffers[MULTISAMPLED], target->framebuffers[RESOLVED]);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffers[RESOLVED]);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl->ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image->pixels);
    view_target_bind(target);
    if (!view_gl_check(gl, "reading the picture")) return false;
    view_image_flip(image);
    if (target->pixel_scale == 2) view_image_halve(image);
    return true;
}

void view_target_destroy(view_target *target) {
    const view_gl *const gl = target->gl;
    if (!gl) return;
    gl->DeleteFramebuffers(2, target->framebuffers);
    gl->DeleteRenderbuffers(2, target->color_buffers);
    gl->DeleteRenderbuffers(1, &target->depth_buffer);
    *target = (view_target){0};
}
