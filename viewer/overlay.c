/* SPDX-License-Identifier: MIT */
#include "overlay.h"

#include "program.h"
#include "report.h"
#include "shaders_overlay.h"
#include "uniforms.h"
#include <stdlib.h>
#include <string.h>

static bool create_programs(view_overlay *overlay) {
    overlay->lines = view_program_create(
        overlay->gl, &(view_program_sources){.name = "line",
                                             .vertex = overlay_vertex_source,
                                             .geometry = line_geometry_source,
                                             .fragment = overlay_fragment_source});
    overlay->points = view_program_create(
        overlay->gl, &(view_program_sources){.name = "point",
                                             .vertex = overlay_vertex_source,
                                             .geometry = point_geometry_source,
                                             .fragment = overlay_fragment_source});
    return overlay->lines && overlay->points;
}

bool view_overlay_create(view_overlay *overlay, const view_gl *gl, const view_surfaces *drawn) {
    *overlay = (view_overlay){
        .gl = gl, .drawn = *drawn, .controls = view_stream_make(gl, sizeof(float[3]))};
    overlay->edges = calloc((size_t)drawn->count + 1, sizeof *overlay->edges);
    overlay->corners = calloc((size_t)drawn->count + 1, sizeof *overlay->corners);
    if (!overlay->edges || !overlay->corners) return view_fail("out of memory");
    for (uint32_t i = 0; i < drawn->count; i++) {
        const view_control_mesh *const mesh = &drawn->surfaces[i].control_mesh;
        overlay->edges[i] =
            view_geometry_create(gl, mesh->edges, mesh->edge_count * sizeof *mesh->edges);
        overlay->corners[i] =
            view_geometry_create(gl, mesh->points, mesh->point_count * sizeof *mesh->points);
    }
    return create_programs(overlay);
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

static void set_control_layout(const view_overlay *overlay, const view_geometry *elements,
                               size_t first_point) {
    overlay->gl->BindVertexArray(elements->layout);
    overlay->gl->BindBuffer(GL_ARRAY_BUFFER, overlay->controls.buffer);
    view_attribute_floats(overlay->gl, 0, 3, sizeof(float[3]), first_point * sizeof(float[3]));
}

static void draw_control_meshes(const view_overlay *overlay, const view_frame *frame,
                                const overlay_style *style, size_t first_point) {
    const view_gl *const gl = overlay->gl;
    size_t first = first_point;
    view_uniforms_use(gl, overlay->lines, frame);
    set_style(gl, overlay->lines, style, style->line_radius * frame->pixel_scale);
    for (uint32_t i = 0; i < overlay->drawn.count; i++) {
        const view_surface *const surface = &overlay->drawn.surfaces[i];
        set_control_layout(overlay, &overlay->edges[i], first);
        gl->DrawElements(GL_LINES, (GLsizei)(2 * surface->control_mesh.edge_count), GL_UNSIGNED_INT,
                         NULL);
        first += surface->mesh.point_count;
    }
    first = first_point;
    view_uniforms_use(gl, overlay->points, frame);
    set_style(gl, overlay->points, style, style->point_radius * frame->pixel_scale);
    for (uint32_t i = 0; i < overlay->drawn.count; i++) {
        const view_surface *const surface = &overlay->drawn.surfaces[i];
        set_control_layout(overlay, &overlay->corners[i], first);
        gl->DrawElements(GL_POINTS, (GLsizei)surface->control_mesh.point_count, GL_UNSIGNED_INT,
                         NULL);
        first += surface->mesh.point_count;
    }
}

static bool upload_controls(view_overlay *overlay, size_t *first_point) {
    size_t count = 0;
    for (uint32_t i = 0; i < overlay->drawn.count; i++)
        count += overlay->drawn.surfaces[i].mesh.point_count;
    float *to = view_stream_map(&overlay->controls, count);
    if (!to) return false;
    for (uint32_t i = 0; i < overlay->drawn.count; i++) {
        const limn_mesh *const mesh = &overlay->drawn.surfaces[i].mesh;
        const size_t values = (size_t)mesh->point_count * 3;
        memcpy(to, mesh->controls, values * sizeof *to);
        to += values;
    }
    *first_point = view_stream_unmap(&overlay->controls);
    return true;
}

/// What the surface hides first, faintly; then what stands in front of it.
bool view_overlay_draw(view_overlay *overlay, const view_frame *frame) {
    static const overlay_style hidden = {0.01f, 0.06f, 0.15f, 0.24f, 0.5f, 1.6f};
    static const overlay_style visible = {0.02f, 0.13f, 0.34f, 0.95f, 0.7f, 2.8f};
    const view_gl *const gl = overlay->gl;
    size_t first_point;
    if (!upload_controls(overlay, &first_point)) return false;
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->DepthMask(GL_FALSE);
    gl->DepthFunc(GL_GREATER);
    draw_control_meshes(overlay, frame, &hidden, first_point);
    gl->DepthFunc(GL_LEQUAL);
    draw_control_meshes(overlay, frame, &visible, first_point);
    gl->DepthMask(GL_TRUE);
    gl->DepthFunc(GL_LESS);
    gl->Disable(GL_BLEND);
    view_stream_fence(&overlay->controls);
    return true;
}

void view_overlay_destroy(view_overlay *overlay) {
    const view_gl *const gl = overlay->gl;
    if (!gl) return;
    for (uint32_t i = 0; i < overlay->drawn.count && overlay->edges && overlay->corners; i++) {
        view_geometry_destroy(gl, &overlay->edges[i]);
        view_geometry_destroy(gl, &overlay->corners[i]);
    }
    free(overlay->edges);
    free(overlay->corners);
    gl->DeleteProgram(overlay->lines);
    gl->DeleteProgram(overlay->points);
    view_stream_destroy(&overlay->controls);
    *overlay = (view_overlay){0};
}
