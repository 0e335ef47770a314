/* SPDX-License-Identifier: MIT */
#include "renderer.h"

#include "program.h"
#include "report.h"
#include "shaders.h"
#include <stddef.h>
#include <stdlib.h>

/// Vertices on the GPU, and how they and their indices are laid out.
typedef struct geometry {
    GLuint layout;
    GLuint vertex_buffer;
    GLuint index_buffer; ///< of its own; 0: shared
} geometry;

/// A surface: one draw per patch, all with the indices of templates, in one call.
typedef struct drawable {
    geometry surface;
    geometry control_edges;
    geometry control_points;
    GLsizei *index_counts; ///< [patch_count], as are the others
    const void **index_offsets;
    GLint *base_vertices;
    const view_surface *source;
} drawable;

struct view_renderer {
    const view_gl *gl;
    GLuint background, shaded, wireframe, lines, points; ///< programs
    GLuint empty_layout;
    GLuint templates[LIMN_DOMAIN_COUNT]; ///< index buffers
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

/// Fills a buffer that is bound from then on.
static GLuint create_buffer(const view_gl *gl, GLenum target, const void *data, size_t size) {
    GLuint buffer;
    gl->GenBuffers(1, &buffer);
    gl->BindBuffer(target, buffer);
    gl->BufferData(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    return buffer;
}

/// Makes a layout, and leaves it bound for the index buffer and the attributes.
static geometry create_geometry(const view_gl *gl, const void *vertices, size_t vertices_size) {
    geometry result = {0};
    gl->GenVertexArrays(1, &result.layout);
    gl->BindVertexArray(result.layout);
    result.vertex_buffer = create_buffer(gl, GL_ARRAY_BUFFER, vertices, vertices_size);
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

static void upload_surface(const view_gl *gl, drawable *target, const view_surface *source,
                           GLuint templates) {
    target->surface = create_geometry(gl, source->vertices,
                                      (size_t)source->plan.vertex_count * sizeof(view_vertex));
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, templates);
    set_floats(gl, 0, 3, sizeof(view_vertex), offsetof(view_vertex, position));
    set_floats(gl, 1, 3, sizeof(view_vertex), offsetof(view_vertex, normal));
    set_floats(gl, 3, 1, sizeof(view_vertex), offsetof(view_vertex, level));
    set_bytes(gl, 2, GL_FALSE, offsetof(view_vertex, borders));
    set_bytes(gl, 4, GL_TRUE, offsetof(view_vertex, light));
}

/// Control points, and indices of theirs.
static geometry create_overlay(const view_gl *gl, const limn_mesh *mesh, const uint32_t *indices,
                               size_t index_count) {
    geometry result =
        create_geometry(gl, mesh->controls, (size_t)mesh->point_count * sizeof(float[3]));
    result.index_buffer =
        create_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, indices, index_count * sizeof *indices);
    set_floats(gl, 0, 3, sizeof(float[3]), 0);
    return result;
}

static void upload_control_mesh(const view_gl *gl, drawable *target, const view_surface *source) {
    const view_control_mesh *const control_mesh = &source->control_mesh;
    target->control_edges = create_overlay(gl, &source->mesh, control_mesh->edges[0],
                                           (size_t)control_mesh->edge_count * 2);
    target->control_points =
        create_overlay(gl, &source->mesh, control_mesh->points, control_mesh->point_count);
}

static bool list_draws(drawable *target, const view_surface *source) {
    const limn_plan *const plan = &source->plan;
    const size_t room = (size_t)plan->patch_count + 1;
    target->index_counts = calloc(room, sizeof *target->index_counts);
    target->index_offsets = calloc(room, sizeof *target->index_offsets);
    target->base_vertices = calloc(room, sizeof *target->base_vertices);
    if (!target->index_counts || !target->index_offsets || !target->base_vertices) return false;
    for (uint32_t d = 0; d < plan->patch_count; d++) {
        const limn_draw *const draw = &plan->draws[d];
        target->index_counts[d] = (GLsizei)draw->index_count;
        target->index_offsets[d] = (const void *)(uintptr_t)(draw->first_index * sizeof(uint16_t));
        target->base_vertices[d] = draw->base_vertex;
    }
    return true;
}

static bool create_drawables(view_renderer *renderer, const view_scene *scene) {
    renderer->drawables = calloc((size_t)scene->surface_count + 1, sizeof *renderer->drawables);
    if (!renderer->drawables) return view_fail("out of memory");
    renderer->drawable_count = scene->surface_count;
    for (int d = 0; d < LIMN_DOMAIN_COUNT; d++) {
        const view_templates *const templates = &scene->templates[d];
        renderer->templates[d] = create_buffer(renderer->gl, GL_ARRAY_BUFFER, templates->indices,
                                               templates->index_count * sizeof *templates->indices);
    }
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        drawable *const target = &renderer->drawables[i];
        target->source = &scene->surfaces[i];
        if (!list_draws(target, target->source)) return view_fail("out of memory");
        upload_surface(renderer->gl, target, target->source,
                       renderer->templates[target->source->mesh.domain->kind]);
        upload_control_mesh(renderer->gl, target, target->source);
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
    gl->GenVertexArrays(1, &renderer->empty_layout);
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
    gl->Uniform1f(gl->GetUniformLocation(program, "level_colours"), frame->level_colours);
    gl->Uniform1f(gl->GetUniformLocation(program, "vertex_light"), frame->vertex_light);
    gl->Uniform1f(gl->GetUniformLocation(program, "flat_shading"), frame->flat_shading);
}

static void draw_background(const view_renderer *renderer, const view_frame *frame) {
    const view_gl *const gl = renderer->gl;
    gl->Disable(GL_DEPTH_TEST);
    use_program(gl, renderer->background, frame);
    gl->BindVertexArray(renderer->empty_layout);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->Enable(GL_DEPTH_TEST);
}

static void draw_surfaces(const view_renderer *renderer, const view_frame *frame) {
    const view_gl *const gl = renderer->gl;
    use_program(gl, frame->wireframe ? renderer->wireframe : renderer->shaded, frame);
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        const drawable *const target = &renderer->drawables[i];
        gl->BindVertexArray(target->surface.layout);
        gl->MultiDrawElementsBaseVertex(
            GL_TRIANGLES, target->index_counts, GL_UNSIGNED_SHORT, target->index_offsets,
            (GLsizei)target->source->plan.patch_count, target->base_vertices);
    }
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

static void draw_control_meshes(const view_renderer *renderer, const view_frame *frame,
                                const overlay_style *style) {
    const view_gl *const gl = renderer->gl;
    use_program(gl, renderer->lines, frame);
    set_style(gl, renderer->lines, style, style->line_radius * frame->pixel_scale);
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        const drawable *const target = &renderer->drawables[i];
        gl->BindVertexArray(target->control_edges.layout);
        gl->DrawElements(GL_LINES, (GLsizei)(2 * target->source->control_mesh.edge_count),
                         GL_UNSIGNED_INT, NULL);
    }
    use_program(gl, renderer->points, frame);
    set_style(gl, renderer->points, style, style->point_radius * frame->pixel_scale);
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        const drawable *const target = &renderer->drawables[i];
        gl->BindVertexArray(target->control_points.layout);
        gl->DrawElements(GL_POINTS, (GLsizei)target->source->control_mesh.point_count,
                         GL_UNSIGNED_INT, NULL);
    }
}

/// What the surface hides first, faintly; then what stands in front of it.
static void draw_overlay(const view_renderer *renderer, const view_frame *frame) {
    static const overlay_style hidden = {0.01f, 0.06f, 0.15f, 0.24f, 0.5f, 1.6f};
    static const overlay_style visible = {0.02f, 0.13f, 0.34f, 0.95f, 0.7f, 2.8f};
    const view_gl *const gl = renderer->gl;
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->DepthMask(GL_FALSE);
    gl->DepthFunc(GL_GREATER);
    draw_control_meshes(renderer, frame, &hidden);
    gl->DepthFunc(GL_LEQUAL);
    draw_control_meshes(renderer, frame, &visible);
    gl->DepthMask(GL_TRUE);
    gl->DepthFunc(GL_LESS);
    gl->Disable(GL_BLEND);
}

bool view_renderer_draw(const view_renderer *renderer, const view_frame *frame) {
    const view_gl *const gl = renderer->gl;
    gl->Viewport(0, 0, (GLsizei)frame->width, (GLsizei)frame->height);
    gl->Enable(GL_FRAMEBUFFER_SRGB);
    gl->Enable(GL_MULTISAMPLE);
    gl->Clear(GL_DEPTH_BUFFER_BIT);
    draw_background(renderer, frame);
    draw_surfaces(renderer, frame);
    if (frame->control_mesh) draw_overlay(renderer, frame);
    return view_gl_check(gl, "drawing");
}

// -------------------------------------------------------------------------------------------------
// Destruction

static void delete_geometry(const view_gl *gl, const geometry *old) {
    gl->DeleteVertexArrays(1, &old->layout);
    gl->DeleteBuffers(1, &old->vertex_buffer);
    gl->DeleteBuffers(1, &old->index_buffer);
}

void view_renderer_destroy(view_renderer *renderer) {
    if (!renderer) return;
    const view_gl *const gl = renderer->gl;
    for (uint32_t i = 0; i < renderer->drawable_count; i++) {
        drawable *const target = &renderer->drawables[i];
        delete_geometry(gl, &target->surface);
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
    gl->DeleteVertexArrays(1, &renderer->empty_layout);
    gl->DeleteBuffers(LIMN_DOMAIN_COUNT, renderer->templates);
    free(renderer);
}
