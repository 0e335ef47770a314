/* SPDX-License-Identifier: MIT */
#include "renderer.h"

#include "commands.h"
#include "overlay.h"
#include "program.h"
#include "report.h"
#include "shaders.h"
#include "uniforms.h"
#include <stddef.h>
#include <stdlib.h>

struct view_renderer {
    const view_gl *gl;
    view_surfaces drawn;
    GLuint background, shaded, wireframe; ///< programs
    GLuint empty_layout;
    view_geometry templates[LIMN_DOMAIN_COUNT];
    GLuint albedo;        ///< a texture array: layers are materials
    view_stream vertices; ///< of view_vertex, written by the caller
    view_commands commands;
    view_overlay overlay;
};

// -------------------------------------------------------------------------------------------------
// Creation

static bool create_programs(view_renderer *renderer) {
    const view_gl *const gl = renderer->gl;
    renderer->background =
        view_program_create(gl, &(view_program_sources){.name = "background",
                                                        .vertex = background_vertex_source,
                                                        .fragment = background_fragment_source});
    renderer->shaded =
        view_program_create(gl, &(view_program_sources){.name = "surface",
                                                        .vertex = surface_vertex_source,
                                                        .fragment = surface_fragment_source});
    renderer->wireframe =
        view_program_create(gl, &(view_program_sources){.name = "wireframe",
                                                        .vertex = surface_vertex_source,
                                                        .geometry = wireframe_geometry_source,
                                                        .fragment = surface_fragment_source,
                                                        .definitions = "#define WIREFRAME\n"});
    return renderer->background && renderer->shaded && renderer->wireframe;
}

static void create_albedo(view_renderer *renderer, const view_albedo *albedo) {
    const view_gl *const gl = renderer->gl;
    if (!albedo->texels) return;
    gl->GenTextures(1, &renderer->albedo);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D_ARRAY, renderer->albedo);
    gl->TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_SRGB8_ALPHA8, (GLsizei)albedo->width,
                   (GLsizei)albedo->height, (GLsizei)albedo->layer_count, 0, GL_RGBA,
                   GL_UNSIGNED_BYTE, albedo->texels);
    gl->TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl->GenerateMipmap(GL_TEXTURE_2D_ARRAY);
}

static void create_templates(view_renderer *renderer) {
    for (int d = 0; d < LIMN_DOMAIN_COUNT; d++) {
        const view_templates *const templates = &renderer->drawn.templates[d];
        renderer->templates[d] = view_geometry_create(
            renderer->gl, templates->indices, templates->index_count * sizeof *templates->indices);
    }
}

view_renderer *view_renderer_create(const view_gl *gl, const view_surfaces *drawn) {
    view_renderer *const renderer = calloc(1, sizeof *renderer);
    if (!renderer) {
        view_fail("out of memory");
        return NULL;
    }
    renderer->gl = gl;
    renderer->drawn = *drawn;
    renderer->vertices = view_stream_make(gl, sizeof(view_vertex));
    gl->GenVertexArrays(1, &renderer->empty_layout);
    create_albedo(renderer, drawn->albedo);
    create_templates(renderer);
    if (create_programs(renderer) && view_commands_create(&renderer->commands, gl, drawn) &&
        view_overlay_create(&renderer->overlay, gl, drawn) &&
        view_gl_check(gl, "uploading the meshes"))
        return renderer;
    view_renderer_destroy(renderer);
    return NULL;
}

// -------------------------------------------------------------------------------------------------
// Drawing

static void draw_background(const view_renderer *renderer, const view_frame *frame) {
    const view_gl *const gl = renderer->gl;
    gl->Disable(GL_DEPTH_TEST);
    view_uniforms_use(gl, renderer->background, frame);
    gl->BindVertexArray(renderer->empty_layout);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->Enable(GL_DEPTH_TEST);
}

/// `first_vertex`: of the buffer, the first of the frame.
static void set_surface_layout(const view_renderer *renderer, limn_domain_kind domain,
                               size_t first_vertex) {
    const view_gl *const gl = renderer->gl;
    const size_t size = sizeof(view_vertex), at = first_vertex * size;
    gl->BindVertexArray(renderer->templates[domain].layout);
    gl->BindBuffer(GL_ARRAY_BUFFER, renderer->vertices.buffer);
    view_attribute_floats(gl, 0, 3, size, at + offsetof(view_vertex, position));
    view_attribute_floats(gl, 1, 3, size, at + offsetof(view_vertex, normal));
    view_attribute_floats(gl, 3, 1, size, at + offsetof(view_vertex, level));
    view_attribute_bytes(gl, 2, GL_FALSE, size, at + offsetof(view_vertex, borders));
    view_attribute_bytes(gl, 4, GL_TRUE, size, at + offsetof(view_vertex, light));
    view_attribute_floats(gl, 5, 2, size, at + offsetof(view_vertex, uv));
    view_attribute_bytes(gl, 6, GL_FALSE, size, at + offsetof(view_vertex, material));
}

static void draw_surface(const view_renderer *renderer, const view_frame *frame, GLuint program,
                         uint32_t index, size_t first_vertex) {
    const view_gl *const gl = renderer->gl;
    const view_surface *const surface = &renderer->drawn.surfaces[index];
    gl->Uniform1f(gl->GetUniformLocation(program, "vertex_light"),
                  frame->vertex_light && !surface->faceted);
    gl->Uniform1f(gl->GetUniformLocation(program, "flat_shading"),
                  frame->flat_shading || surface->faceted);
    view_uniforms_place(gl, program, frame, surface->place);
    set_surface_layout(renderer, surface->mesh.domain->kind, first_vertex);
    view_commands_draw(&renderer->commands, index);
}

static bool draw_surfaces(view_renderer *renderer, const view_frame *frame) {
    const GLuint program = frame->wireframe ? renderer->wireframe : renderer->shaded;
    const size_t first_vertex = view_stream_unmap(&renderer->vertices);
    if (!view_commands_write(&renderer->commands, frame->unsewn)) return false;
    view_uniforms_use(renderer->gl, program, frame);
    for (uint32_t i = 0; i < renderer->drawn.count; i++) {
        if (renderer->drawn.surfaces[i].plan.patch_count > 0)
            draw_surface(renderer, frame, program, i, first_vertex);
    }
    view_stream_fence(&renderer->vertices);
    view_commands_end(&renderer->commands);
    return true;
}

float view_line_scale(uint32_t width, uint32_t height) {
    static const float usual = 960;
    const float scale = (float)(width < height ? width : height) / usual;
    return scale > 0.7f ? scale : 0.7f;
}

view_vertex *view_renderer_map(view_renderer *renderer, uint64_t vertex_count) {
    if (vertex_count <= INT32_MAX && vertex_count <= SIZE_MAX / sizeof(view_vertex) / 8)
        return view_stream_map(&renderer->vertices, (size_t)vertex_count);
    view_fail("a frame has too many vertices");
    return NULL;
}

bool view_renderer_draw(view_renderer *renderer, const view_frame *frame) {
    const view_gl *const gl = renderer->gl;
    gl->Viewport(0, 0, (GLsizei)frame->width, (GLsizei)frame->height);
    gl->Enable(GL_FRAMEBUFFER_SRGB);
    gl->Enable(GL_MULTISAMPLE);
    gl->Clear(GL_DEPTH_BUFFER_BIT);
    draw_background(renderer, frame);
    if (!draw_surfaces(renderer, frame)) return false;
    if (frame->control_mesh && !view_overlay_draw(&renderer->overlay, frame)) return false;
    return view_gl_check(gl, "drawing");
}

// -------------------------------------------------------------------------------------------------
// Destruction

void view_renderer_destroy(view_renderer *renderer) {
    if (!renderer) return;
    const view_gl *const gl = renderer->gl;
    const GLuint programs[] = {renderer->background, renderer->shaded, renderer->wireframe};
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++)
        gl->DeleteProgram(programs[i]);
    gl->DeleteTextures(1, &renderer->albedo);
    gl->DeleteVertexArrays(1, &renderer->empty_layout);
    for (int d = 0; d < LIMN_DOMAIN_COUNT; d++)
        view_geometry_destroy(gl, &renderer->templates[d]);
    view_stream_destroy(&renderer->vertices);
    view_commands_destroy(&renderer->commands);
    view_overlay_destroy(&renderer->overlay);
    free(renderer);
}
