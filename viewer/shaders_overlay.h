/* SPDX-License-Identifier: MIT */
/* The shaders of control meshes. */
#ifndef VIEW_SHADERS_OVERLAY_H
#define VIEW_SHADERS_OVERLAY_H

// Lines and points of the control mesh become rectangles of a width in pixels.
static const char overlay_vertex_source[] =
    "layout(location = 0) in vec3 position;\n"
    "uniform mat4 view, projection;\n"
    "void main() {\n"
    "    gl_Position = projection * (view * vec4(position, 1));\n"
    "    gl_Position.z -= 2e-4 * gl_Position.w;\n" // in front of a surface it lies on
    "}\n";

static const char line_geometry_source[] =
    "layout(lines) in;\n"
    "layout(triangle_strip, max_vertices = 4) out;\n"
    "uniform vec2 viewport;\n"
    "uniform float radius, pixel_scale;\n"
    "noperspective out vec2 offset;\n"
    "void main() {\n"
    "    vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;\n"
    "    vec2 along = viewport * (b.xy / b.w - a.xy / a.w);\n"
    "    along /= max(length(along), 1e-6);\n"
    "    float reach = radius + pixel_scale;\n"
    "    vec2 across = 2.0 * reach * vec2(-along.y, along.x) / viewport;\n"
    "    for (int i = 0; i < 4; i++) {\n"
    "        vec4 end = i < 2 ? a : b;\n"
    "        float side = (i & 1) == 0 ? -1.0 : 1.0;\n"
    "        offset = vec2(0, side * reach);\n"
    "        gl_Position = end + vec4(side * across * end.w, 0, 0);\n"
    "        EmitVertex();\n"
    "    }\n"
    "}\n";

static const char point_geometry_source[] =
    "layout(points) in;\n"
    "layout(triangle_strip, max_vertices = 4) out;\n"
    "uniform vec2 viewport;\n"
    "uniform float radius, pixel_scale;\n"
    "noperspective out vec2 offset;\n"
    "void main() {\n"
    "    vec4 center = gl_in[0].gl_Position;\n"
    "    for (int i = 0; i < 4; i++) {\n"
    "        offset = (radius + pixel_scale) * (2.0 * vec2(i & 1, i >> 1) - 1.0);\n"
    "        gl_Position = center + vec4(2.0 * offset / viewport * center.w, 0, 0);\n"
    "        EmitVertex();\n"
    "    }\n"
    "}\n";

static const char overlay_fragment_source[] =
    "uniform float radius, pixel_scale;\n"
    "uniform vec4 overlay_color;\n"
    "noperspective in vec2 offset;\n"
    "out vec4 color;\n"
    "void main() {\n"
    "    float covered = clamp((radius - length(offset)) / pixel_scale + 0.5, 0.0, 1.0);\n"
    "    color = vec4(overlay_color.rgb, overlay_color.a * covered);\n"
    "}\n";

#endif
