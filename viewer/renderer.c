/* SPDX-License-Identifier: MIT */
#include "renderer.h"

#include "program.h"
#include "report.h"
#include "shaders.h"
#include "stream.h"
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/// Indices on the GPU, and how the vertices are laid out that they are used with.
typedef struct geometry {
    GLuint layout;
    GLuint index_buffer;
} geometry;

/// A surface: one draw per patch, all with the indices of templates, in one call.
typedef struct drawable {
    geometry control_edges;
    geometry control_points;
    size_t first_draw;     ///< among the commands of the frame
    GLsizei *index_counts; ///< [patch_count], as are the others: where commands must be arguments
    const void **index_offsets;
    GLint *base_vertices;
    const view_surface *source;
} drawable;

struct view_renderer {
    const view_gl *gl;
    GLuint background, shaded, wireframe, lines, points; ///< programs
    GLuint empty_layout;
    geometry templates[LIMN_DOMAIN_COUNT];
    GLuint albedo;        ///< a texture array: layers are materials
    view_stream vertices; ///< of view_vertex, written by the caller
    view_stream draws;    ///< of limn_draw, as commands
    view_stream controls; ///< of float[3], for the overlay
    const view_scene *scene;
    drawable *drawables;
    uint32_t drawable_count;
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
    renderer->lines =
        view_program_create(gl, &(view_program_sources){.name = "line",
                                                        .vertex = overlay_vertex_source,
                                                        .geometry = line_geometry_source,
                                                        .fragment = overlay_fragment_source});
    renderer->points =
        view_program_create(gl, &(view_program_sources){.name = "point",
                                                        .vertex = overlay_vertex_source,
                                                        .geometry = point_geometry_source,
                                                        .fragment = overlay_fragment_source});
    return renderer->background && renderer->shaded && renderer->wireframe && renderer->lines &&
           renderer->points;
}

/// Uploads indices, of `size` bytes. The attributes of the layout are set when it is drawn.
static geometry create_geometry(const view_gl *gl, const void *indices, size_t size) {
    geometry result;
    gl->GenVertexArrays(1, &result.layout);
    gl->BindVertexArray(result.layout);
    gl->GenBuffers(1, &result.index_buffer);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, result.index_buffer);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)size, indices, GL_STATIC_DRAW);
    return result;
}

static void set_floats(const view_gl *gl, GLuint attribute, GLint count, size_t stride,
                       size_t offset) {
    gl->EnableVertexAttribArray(attribute);
    gl->VertexAttribPointer(attribute, count, GL_FLOAT, GL_FALSE, (GLsizei)stride,
                            (const void *)(uintptr_t)offset);
}

/// Four of a vertex; `normalised`: 255 stands for 1.
static void set_bytes(const view_gl *gl, GLuint attribute, GLboolean normalised, size_t offset) {
    gl->EnableVertexAttribArray(attribute);
    gl->VertexAttribPointer(attribute, 4, GL_UNSIGNED_BYTE, normalised,
                            (GLsizei)sizeof(view_vertex), (const void *)(uintptr_t)offset);
}

static void create_control_mesh(const view_gl *gl, drawable *target) {
    const view_control_mesh *const mesh = &target->source->control_mesh;
    target->control_edges =
        create_geometry(gl, mesh->edges, mesh->edge_count * sizeof *mesh->edges);
    target->control_points =
        create_geometry(gl, mesh->points, mesh->point_count * sizeof *mesh->points);
}

/// Room for the draws of a frame as arguments.
static bool create_arguments(drawable *target) {
    const size_t room = (size_t)target->source->mesh.patch_count + 1;
    target->index_counts = calloc(room, sizeof *target->index_counts);
    target->index_offsets = calloc(room, sizeof *target->index_offsets);
    target->base_vertices = calloc(room, sizeof *target->base_vertices);
    return target->index_counts && target->index_offsets && target->base_vertices;
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

static bool create_drawables(view_renderer *renderer, const view_scene *scene) {
    renderer->drawables = calloc((size_t)scene->surface_count + 1, sizeof *renderer->drawables);
    if (!renderer->drawables) return view_fail("out of memory");
    renderer->drawable_count = scene->surface_count;
    for (int d = 0; d < LIMN_DOMAIN_COUNT; d++) {
        const view_templates *const templates = &scene->templates[d];
        renderer->templates[d] = create_geometry(
            renderer->gl, templates->indices, templates->index_count * sizeof *templates->indices);
    }
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        drawable *const target = &renderer->drawables[i];
        target->source = &scene->surfaces[i];
        if (!renderer->gl->MultiDrawElementsIndirect && !create_arguments(target))
            return view_fail("out of memory");
        create_control_mesh(renderer->gl, target);
    }
    return view_gl_check(renderer->gl, "uploading the meshes");
}

view_renderer *view_renderer_create(const view_gl *gl, const view_scene *scene) {
    view_renderer *const renderer = calloc(1, sizeof *renderer);
    if (!renderer) {
        view_fail("out of memory");
        return NULL;
    }
    renderer->gl = gl;
    renderer->scene = scene;
    renderer->vertices = view_stream_make(gl, sizeof(view_vertex));
    renderer->draws = view_stream_make(gl, sizeof(limn_draw));
    renderer->controls = view_stream_make(gl, sizeof(float[3]));
    gl->GenVertexArrays(1, &renderer->empty_layout);
    create_albedo(renderer, &scene->albedo);
    if (!create_programs(renderer) || !create_drawables(renderer, scene)) {
        view_renderer_destroy(renderer);
        return NULL;
    }
    return renderer;
}

// -------------------------------------------------------------------------------------------------
// Drawing

static void use_program(const view_gl *gl, GLuint program, const view_frame *frame) {
    gl->UseProgram(program);
    // A uniform that a program does not have is at -1, where setting it does nothing.
    gl->UniformMatrix4fv(gl->GetUniformLocation(program, "view"), 1, GL_FALSE, frame->camera.view);
    gl->UniformMatrix4fv(gl->GetUniformLocation(program, "projection"), 1, GL_FALSE,
                         frame->camera.projection);
    gl->Uniform2f(gl->GetUniformLocation(program, "viewport"), (float)frame->width,
                  (float)frame->height);
    gl->Uniform1f(gl->GetUniformLocation(program, "pixel_scale"), frame->pixel_scale);
    gl->Uniform1f(gl->GetUniformLocation(program, "colours"), (float)frame->colours);
}

static void draw_background(const view_renderer *renderer, const view_frame *frame) {
    const view_gl *const gl = renderer->gl;
    gl->Disable(GL_DEPTH_TEST);
    use_program(gl, renderer->background, frame);
    gl->BindVertexArray(renderer->empty_layout);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->Enable(GL_DEPTH_TEST);
}

/// `first_vertex`: of the buffer, the first of the frame.
static void set_surface_layout(const view_renderer *renderer, limn_domain_kind domain,
                               size_t first_vertex) {
    const view_gl *const gl = renderer->gl;
    const size_t at = first_vertex * sizeof(view_vertex);
    gl->BindVertexArray(renderer->templates[domain].layout);
    gl->BindBuffer(GL_ARRAY_BUFFER, renderer->vertices.buffer);
    set_floats(gl, 0, 3, sizeof(view_vertex), at + offsetof(view_vertex, position));
    set_floats(gl, 1, 3, sizeof(view_vertex), at + offsetof(view_vertex, normal));
    set_floats(gl, 3, 1, sizeof(view_vertex), at + offsetof(view_vertex, level));
    set_bytes(gl, 2, GL_FALSE, at + offsetof(view_vertex, borders));
    set_bytes(gl, 4, GL_TRUE, at + offsetof(view_vertex, light));
    set_floats(gl, 5, 2, sizeof(view_vertex), at + offsetof(view_vertex, uv));
    set_bytes(gl, 6, GL_FALSE, at + offsetof(view_vertex, material));
}

/// A draw among those of all surfaces. Not sewn, its edges are as fine as itself.
static limn_draw place_draw(const view_renderer *renderer, const view_frame *frame,
                            const view_surface *source, uint32_t d) {
    limn_draw draw = source->plan.draws[d];
    if (frame->unsewn) {
        const limn_domain *const domain = source->mesh.domain;
        const uint8_t level = source->plan.patches[draw.base_instance].level;
        const uint8_t levels[LIMN_CORNER_MAX] = {level, level, level, level};
        const limn_template whole = renderer->scene->templates[domain->kind]
                                        .templates[limn_template_find(domain, level, levels)];
        draw.first_index = whole.first_index;
        draw.index_count = whole.index_count;
    }
    draw.base_vertex += (int32_t)source->first_vertex;
    draw.base_instance = 0; // OpenGL 4.2 and later would take another
    return draw;
}

/// Writes the draws of all surfaces as commands into a buffer.
static bool write_commands(view_renderer *renderer, const view_frame *frame) {
    size_t count = 0;
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        renderer->drawables[i].first_draw = count;
        count += renderer->drawables[i].source->plan.patch_count;
    }
    limn_draw *command = view_stream_map(&renderer->draws, count);
    if (!command) return false;
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        const view_surface *const source = renderer->drawables[i].source;
        for (uint32_t d = 0; d < source->plan.patch_count; d++)
            *command++ = place_draw(renderer, frame, source, d);
    }
    const size_t first = view_stream_unmap(&renderer->draws);
    for (uint32_t i = 0; i < renderer->drawable_count; i++)
        renderer->drawables[i].first_draw += first;
    return true;
}

/// The same as arguments.
static void write_arguments(const view_renderer *renderer, const view_frame *frame) {
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        const drawable *const target = &renderer->drawables[i];
        for (uint32_t d = 0; d < target->source->plan.patch_count; d++) {
            const limn_draw draw = place_draw(renderer, frame, target->source, d);
            target->index_counts[d] = (GLsizei)draw.index_count;
            target->index_offsets[d] =
                (const void *)(uintptr_t)(draw.first_index * sizeof(uint16_t));
            target->base_vertices[d] = draw.base_vertex;
        }
    }
}

static void draw_surface(const view_renderer *renderer, const drawable *target) {
    const view_gl *const gl = renderer->gl;
    const GLsizei count = (GLsizei)target->source->plan.patch_count;
    if (gl->MultiDrawElementsIndirect) {
        gl->BindBuffer(GL_DRAW_INDIRECT_BUFFER, renderer->draws.buffer);
        gl->MultiDrawElementsIndirect(
            GL_TRIANGLES, GL_UNSIGNED_SHORT,
            (const void *)(uintptr_t)(target->first_draw * sizeof(limn_draw)), count, 0);
    } else {
        gl->MultiDrawElementsBaseVertex(GL_TRIANGLES, target->index_counts, GL_UNSIGNED_SHORT,
                                        target->index_offsets, count, target->base_vertices);
    }
}

static bool draw_surfaces(view_renderer *renderer, const view_frame *frame) {
    const view_gl *const gl = renderer->gl;
    const size_t first_vertex = view_stream_unmap(&renderer->vertices);
    if (!gl->MultiDrawElementsIndirect) {
        write_arguments(renderer, frame);
    } else if (!write_commands(renderer, frame)) {
        return false;
    }
    const GLuint program = frame->wireframe ? renderer->wireframe : renderer->shaded;
    use_program(gl, program, frame);
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        const drawable *const target = &renderer->drawables[i];
        const bool faceted = target->source->faceted;
        gl->Uniform1f(gl->GetUniformLocation(program, "vertex_light"),
                      frame->vertex_light && !faceted);
        gl->Uniform1f(gl->GetUniformLocation(program, "flat_shading"),
                      frame->flat_shading || faceted);
        set_surface_layout(renderer, target->source->mesh.domain->kind, first_vertex);
        draw_surface(renderer, target);
    }
    view_stream_fence(&renderer->vertices);
    if (gl->MultiDrawElementsIndirect) view_stream_fence(&renderer->draws);
    return true;
}

/// How a part of the control mesh looks.
typedef struct overlay_style {
    float red, green, blue, opacity;
    float line_radius, point_radius; ///< pixels
} overlay_style;

static void set_style(const view_gl *gl, GLuint program, const overlay_style *style, float radius) {
    gl->Uniform4f(gl->GetUniformLocation(program, "overlay_color"), style->red, style->green,
                  style->blue, style->opacity);
    gl->Uniform1f(gl->GetUniformLocation(program, "radius"), radius);
}

static void set_control_layout(const view_renderer *renderer, const geometry *elements,
                               size_t first_point) {
    renderer->gl->BindVertexArray(elements->layout);
    renderer->gl->BindBuffer(GL_ARRAY_BUFFER, renderer->controls.buffer);
    set_floats(renderer->gl, 0, 3, sizeof(float[3]), first_point * sizeof(float[3]));
}

static void draw_control_meshes(const view_renderer *renderer, const view_frame *frame,
                                const overlay_style *style, size_t first_point) {
    const view_gl *const gl = renderer->gl;
    size_t first = first_point;
    use_program(gl, renderer->lines, frame);
    set_style(gl, renderer->lines, style, style->line_radius * frame->pixel_scale);
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        const drawable *const target = &renderer->drawables[i];
        set_control_layout(renderer, &target->control_edges, first);
        gl->DrawElements(GL_LINES, (GLsizei)(2 * target->source->control_mesh.edge_count),
                         GL_UNSIGNED_INT, NULL);
        first += target->source->mesh.point_count;
    }
    first = first_point;
    use_program(gl, renderer->points, frame);
    set_style(gl, renderer->points, style, style->point_radius * frame->pixel_scale);
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        const drawable *const target = &renderer->drawables[i];
        set_control_layout(renderer, &target->control_points, first);
        gl->DrawElements(GL_POINTS, (GLsizei)target->source->control_mesh.point_count,
                         GL_UNSIGNED_INT, NULL);
        first += target->source->mesh.point_count;
    }
}

static bool upload_controls(view_renderer *renderer, size_t *first_point) {
    size_t count = 0;
    for (uint32_t i = 0; i < renderer->drawable_count; i++)
        count += renderer->drawables[i].source->mesh.point_count;
    float *to = view_stream_map(&renderer->controls, count);
    if (!to) return false;
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        const limn_mesh *const mesh = &renderer->drawables[i].source->mesh;
        const size_t values = (size_t)mesh->point_count * 3;
        memcpy(to, mesh->controls, values * sizeof *to);
        to += values;
    }
    *first_point = view_stream_unmap(&renderer->controls);
    return true;
}

/// What the surface hides first, faintly; then what stands in front of it.
static bool draw_overlay(view_renderer *renderer, const view_frame *frame) {
    static const overlay_style hidden = {0.01f, 0.06f, 0.15f, 0.24f, 0.5f, 1.6f};
    static const overlay_style visible = {0.02f, 0.13f, 0.34f, 0.95f, 0.7f, 2.8f};
    const view_gl *const gl = renderer->gl;
    size_t first_point;
    if (!upload_controls(renderer, &first_point)) return false;
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->DepthMask(GL_FALSE);
    gl->DepthFunc(GL_GREATER);
    draw_control_meshes(renderer, frame, &hidden, first_point);
    gl->DepthFunc(GL_LEQUAL);
    draw_control_meshes(renderer, frame, &visible, first_point);
    gl->DepthMask(GL_TRUE);
    gl->DepthFunc(GL_LESS);
    gl->Disable(GL_BLEND);
    view_stream_fence(&renderer->controls);
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
    if (frame->control_mesh && !draw_overlay(renderer, frame)) return false;
    return view_gl_check(gl, "drawing");
}

// -------------------------------------------------------------------------------------------------
// Destruction

static void delete_geometry(const view_gl *gl, const geometry *old) {
    gl->DeleteVertexArrays(1, &old->layout);
    gl->DeleteBuffers(1, &old->index_buffer);
}

void view_renderer_destroy(view_renderer *renderer) {
    if (!renderer) return;
    const view_gl *const gl = renderer->gl;
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        drawable *const target = &renderer->drawables[i];
        delete_geometry(gl, &target->control_edges);
        delete_geometry(gl, &target->control_points);
        free(target->index_counts);
        free(target->index_offsets);
        free(target->base_vertices);
    }
    free(renderer->drawables);
    const GLuint programs[] = {renderer->background, renderer->shaded, renderer->wireframe,
                               renderer->lines, renderer->points};
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++)
        gl->DeleteProgram(programs[i]);
    gl->DeleteTextures(1, &renderer->albedo);
    gl->DeleteVertexArrays(1, &renderer->empty_layout);
    for (int d = 0; d < LIMN_DOMAIN_COUNT; d++)
        delete_geometry(gl, &renderer->templates[d]);
    view_stream_destroy(&renderer->vertices);
    view_stream_destroy(&renderer->draws);
    view_stream_destroy(&renderer->controls);
    free(renderer);
}
