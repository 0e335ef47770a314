/* SPDX-License-Identifier: MIT */
#include "text.h"

#include "program.h"
#include "report.h"
#include <stb/stb_easy_font.h>
#include <stdio.h>

enum { QUADS_MAX = 8192, MARGIN = 5 }; // indices are 16 bits; dots

/// As stb_easy_font writes it.
typedef struct text_vertex {
    float x, y, z; ///< dots from the upper left corner
    uint8_t colour[4];
} text_vertex;

static const char vertex_source[] = "layout(location = 0) in vec2 position;\n"
                                    "layout(location = 1) in vec4 colour;\n"
                                    "uniform vec2 dots;\n"
                                    "out vec4 dot_colour;\n"
                                    "void main() {\n"
                                    "    dot_colour = colour;\n"
                                    "    vec2 corner = 2.0 * position / dots - 1.0;\n"
                                    "    gl_Position = vec4(corner.x, -corner.y, 0, 1);\n"
                                    "}\n";

static const char fragment_source[] = "in vec4 dot_colour;\n"
                                      "out vec4 color;\n"
                                      "void main() { color = dot_colour; }\n";

/// Two triangles for every four vertices.
static void upload_indices(view_text *text) {
    static uint16_t indices[QUADS_MAX][6];
    const view_gl *const gl = text->gl;
    for (uint32_t quad = 0; quad < QUADS_MAX; quad++) {
        static const uint8_t corners[6] = {0, 1, 2, 0, 2, 3};
        for (int i = 0; i < 6; i++)
            indices[quad][i] = (uint16_t)(4 * quad + corners[i]);
    }
    gl->GenVertexArrays(1, &text->layout);
    gl->BindVertexArray(text->layout);
    gl->GenBuffers(1, &text->indices);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, text->indices);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof indices, indices, GL_STATIC_DRAW);
}

bool view_text_create(view_text *text, const view_gl *gl) {
    *text = (view_text){.gl = gl, .vertices = view_stream_make(gl, sizeof(text_vertex))};
    text->program = view_program_create(gl, &(view_program_sources){.name = "text",
                                                                    .vertex = vertex_source,
                                                                    .fragment = fragment_source});
    upload_indices(text);
    return text->program && view_gl_check(gl, "preparing text");
}

static void write_panel(text_vertex panel[4], float width, float height) {
    const float x[4] = {0, width, width, 0}, y[4] = {0, 0, height, height};
    for (int corner = 0; corner < 4; corner++)
        panel[corner] = (text_vertex){x[corner], y[corner], 0, {2, 2, 3, 190}};
}

/// Returns the number of quads.
static int write_quads(text_vertex *vertices, const char *lines) {
    static char buffer[2048]; // stb_easy_font takes no constant
    static unsigned char light[4] = {200, 200, 190, 255};
    snprintf(buffer, sizeof buffer, "%s", lines);
    write_panel(vertices, (float)stb_easy_font_width(buffer) + 2 * MARGIN,
                (float)stb_easy_font_height(buffer) + 2 * MARGIN - 2);
    return 1 + stb_easy_font_print(MARGIN, MARGIN, buffer, light, vertices + 4,
                                   (QUADS_MAX - 1) * 4 * (int)sizeof(text_vertex));
}

static void set_layout(const view_text *text, size_t first) {
    const view_gl *const gl = text->gl;
    const size_t at = first * sizeof(text_vertex);
    gl->BindVertexArray(text->layout);
    gl->BindBuffer(GL_ARRAY_BUFFER, text->vertices.buffer);
    gl->EnableVertexAttribArray(0);
    gl->VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(text_vertex),
                            (const void *)(uintptr_t)at);
    gl->EnableVertexAttribArray(1);
    gl->VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(text_vertex),
                            (const void *)(uintptr_t)(at + offsetof(text_vertex, colour)));
}

bool view_text_draw(view_text *text, const char *lines, uint32_t width, uint32_t height,
                    float scale) {
    const view_gl *const gl = text->gl;
    text_vertex *const vertices = view_stream_map(&text->vertices, 4 * QUADS_MAX);
    if (!vertices) return false;
    const int quad_count = write_quads(vertices, lines);
    set_layout(text, view_stream_unmap(&text->vertices));
    gl->UseProgram(text->program);
    gl->Uniform2f(gl->GetUniformLocation(text->program, "dots"), (float)width / scale,
                  (float)height / scale);
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->DrawElements(GL_TRIANGLES, 6 * quad_count, GL_UNSIGNED_SHORT, NULL);
    gl->Disable(GL_BLEND);
    gl->Enable(GL_DEPTH_TEST);
    view_stream_fence(&text->vertices);
    return view_gl_check(gl, "drawing text");
}

void view_text_destroy(view_text *text) {
    if (!text->gl) return;
    text->gl->DeleteProgram(text->program);
    text->gl->DeleteVertexArrays(1, &text->layout);
    text->gl->DeleteBuffers(1, &text->indices);
    view_stream_destroy(&text->vertices);
    *text = (view_text){0};
}
