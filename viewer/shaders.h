/* SPDX-License-Identifier: MIT */
/*
 * The shaders of surfaces and of what is behind them. Colours and light are linear; the framebuffer
 * encodes sRGB. Sources that differ between a plain and a wireframe picture look at WIREFRAME, which
 * renderer.c defines.
 */
#ifndef VIEW_SHADERS_H
#define VIEW_SHADERS_H

static const char background_vertex_source[] =
    "out float height;\n"
    "void main() {\n" // one triangle that covers the picture
    "    vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1);\n"
    "    height = 0.5 * corner.y + 0.5;\n"
    "    gl_Position = vec4(corner, 1, 1);\n"
    "}\n";

static const char background_fragment_source[] =
    "in float height;\n"
    "out vec4 color;\n"
    "void main() {\n"
    "    float t = smoothstep(0.0, 1.0, height);\n"
    "    color = vec4(mix(vec3(0.030, 0.029, 0.029), vec3(0.150, 0.157, 0.168), t), 1);\n"
    "}\n";

// Positions and normals go on with +Z towards the viewer.
static const char surface_vertex_source[] =
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in vec4 borders;\n"
    "layout(location = 3) in float level;\n"
    "layout(location = 4) in vec4 light;\n"
    "layout(location = 5) in vec2 uv;\n"
    "layout(location = 6) in vec4 material;\n"
    "uniform mat4 view, projection;\n"
    "out Surface { vec3 position, normal, light, texel, class_colour; float level; } surface;\n"
    "out vec4 vertex_borders;\n"
    "void main() {\n"
    "    surface.position = (view * vec4(position, 1)).xyz;\n"
    "    surface.normal = mat3(view) * normal;\n"
    "    surface.level = level;\n"
    "    surface.light = light.rgb;\n"
    "    surface.texel = vec3(uv, material.x);\n"
    "    surface.class_colour = material.yzw / 255.0;\n"
    "    vertex_borders = borders;\n"
    "    gl_Position = projection * vec4(surface.position, 1);\n"
    "}\n";

// Gives every corner its distance in pixels from each of the three sides, and from each border of
// the patch. The latter is right in triangles, too, that a wide border line crosses with no side of
// theirs on it: steps from the border divided by their gradient on the screen.
static const char wireframe_geometry_source[] =
    "layout(triangles) in;\n"
    "layout(triangle_strip, max_vertices = 3) out;\n"
    "uniform vec2 viewport;\n"
    "uniform float pixel_scale;\n"
    "in Surface { vec3 position, normal, light, texel, class_colour; float level; } corners[];\n"
    "in vec4 vertex_borders[];\n"
    "out Surface { vec3 position, normal, light, texel, class_colour; float level; } surface;\n"
    "noperspective out vec3 side_distance;\n"
    "noperspective out vec4 border_distance;\n"
    "flat out float side_strength;\n"
    "void main() {\n"
    "    vec2 p[3];\n"
    "    for (int i = 0; i < 3; i++)\n"
    "        p[i] = 0.5 * viewport * gl_in[i].gl_Position.xy / gl_in[i].gl_Position.w;\n"
    "    vec2 u = p[1] - p[0], v = p[2] - p[0];\n"
    "    float area = abs(u.x * v.y - u.y * v.x);\n"
    "    vec3 sides = vec3(distance(p[1], p[2]), length(v), length(u));\n"
    "    vec3 heights = area / max(sides, 1e-6);\n"
    "    vec4 step_pixels;\n"
    "    for (int e = 0; e < 4; e++) {\n"
    "        float along_u = vertex_borders[1][e] - vertex_borders[0][e];\n"
    "        float along_v = vertex_borders[2][e] - vertex_borders[0][e];\n"
    "        step_pixels[e] = area / max(length(along_u * v - along_v * u), 1e-6);\n"
    "    }\n"
    "    for (int i = 0; i < 3; i++) {\n"
    "        surface.position = corners[i].position;\n"
    "        surface.normal = corners[i].normal;\n"
    "        surface.level = corners[i].level;\n"
    "        surface.light = corners[i].light;\n"
    "        surface.texel = corners[i].texel;\n"
    "        surface.class_colour = corners[i].class_colour;\n"
    "        side_distance = vec3(0);\n"
    "        side_distance[i] = heights[i];\n"
    "        border_distance = vertex_borders[i] * step_pixels;\n"
    // Triangles of a few pixels would be all line: fade theirs, or the picture goes black.
    "        float smallest = min(heights.x, min(heights.y, heights.z)) / pixel_scale;\n"
    "        side_strength = 0.6 * smoothstep(1.0, 7.0, smallest);\n"
    "        gl_Position = gl_in[i].gl_Position;\n"
    "        EmitVertex();\n"
    "    }\n"
    "}\n";

// Materials, clay, or another kind of colours, between three lamps that stand still while the camera turns. The
// colours of levels are Okabe and Ito's, which differ for those who are colour-blind too.
static const char surface_fragment_source[] =
    "in Surface { vec3 position, normal, light, texel, class_colour; float level; } surface;\n"
    "out vec4 color;\n"
    "uniform float colours, vertex_light, flat_shading;\n"
    "uniform sampler2DArray materials;\n"
    "const vec3 clay = vec3(0.40, 0.345, 0.295);\n"
    "const vec3 palette[5] = vec3[5](vec3(0.000, 0.168, 0.445), vec3(0.093, 0.456, 0.815),\n"
    "                                vec3(0.000, 0.342, 0.171), vec3(0.871, 0.776, 0.054),\n"
    "                                vec3(0.665, 0.112, 0.000));\n"
    "vec3 level_colour(float level) {\n"
    "    int below = clamp(int(level), 0, 3);\n"
    "    return 0.6 * mix(palette[below], palette[below + 1], level - float(below));\n"
    "}\n"
    "vec3 chequer(vec2 uv) {\n"
    "    vec2 cell = floor(16.0 * uv);\n"
    "    float shade = mod(cell.x + cell.y, 2.0) < 0.5 ? 0.35 : 0.7;\n"
    "    return shade * vec3(0.3 + 0.7 * fract(uv.x), 0.3 + 0.7 * fract(uv.y), 0.6);\n"
    "}\n"
    "vec3 surface_colour() {\n" // view_colours
    "    vec3 material = texture(materials, surface.texel).rgb;\n"
    "    if (colours == 1.0) return level_colour(surface.level);\n"
    "    if (colours == 2.0) return surface.class_colour;\n"
    "    if (colours == 4.0) return chequer(surface.texel.xy);\n"
    "    return colours == 0.0 && surface.texel.z < 254.5 ? material : clay;\n"
    "}\n"
    "vec3 lamp(vec3 albedo, vec3 normal, vec3 eye, vec3 direction, vec3 light, float gloss) {\n"
    "    float facing = max(dot(normal, direction), 0.0);\n"
    "    float highlight = pow(max(dot(normal, normalize(eye + direction)), 0.0), 56.0);\n"
    "    return light * facing * (albedo + gloss * highlight);\n"
    "}\n"
    "vec3 shade(vec3 albedo, vec3 normal, vec3 eye) {\n"
    "    vec3 key = normalize(vec3(-0.62, 0.68, 0.52));\n"
    "    vec3 fill = normalize(vec3(0.85, 0.05, 0.55));\n"
    "    vec3 rim = normalize(vec3(0.50, 0.55, -0.80));\n"
    "    vec3 sum = albedo * mix(vec3(0.07, 0.06, 0.055), vec3(0.20, 0.215, 0.24),\n"
    "                            0.5 + 0.5 * normal.y);\n"
    "    sum += lamp(albedo, normal, eye, key, vec3(2.00, 1.84, 1.64), 0.17);\n"
    "    sum += lamp(albedo, normal, eye, fill, vec3(0.24, 0.29, 0.37), 0.12);\n"
    "    sum += lamp(albedo, normal, eye, rim, vec3(1.25, 1.28, 1.36), 0.30);\n"
    "    float edge = pow(1.0 - max(dot(normal, eye), 0.0), 4.0);\n"
    "    return sum + 0.08 * edge * vec3(0.8, 0.9, 1.0);\n"
    "}\n"
    "#ifdef WIREFRAME\n"
    "uniform float pixel_scale;\n"
    "noperspective in vec3 side_distance;\n"
    "noperspective in vec4 border_distance;\n"
    "flat in float side_strength;\n"
    "float line(float half_width, float distance) {\n"
    "    return clamp(half_width - distance / pixel_scale + 0.5, 0.0, 1.0);\n"
    "}\n"
    "float lines() {\n"
    "    vec3 s = side_distance;\n"
    "    vec2 b = min(border_distance.xy, border_distance.zw);\n"
    "    float side = side_strength * line(0.42, min(s.x, min(s.y, s.z)));\n"
    "    return max(side, 0.88 * line(1.0, min(b.x, b.y)));\n"
    "}\n"
    "#endif\n"
    "void main() {\n"
    "    vec3 eye = normalize(-surface.position);\n"
    "    vec3 normal = surface.normal / max(length(surface.normal), 1e-6);\n"
    "    if (flat_shading > 0.0) {\n" // of the triangle; it faces the viewer
    "        normal = normalize(cross(dFdx(surface.position), dFdy(surface.position)));\n"
    "        if (!gl_FrontFacing) normal = -normal;\n"
    "    }\n"
    "    vec3 albedo = surface_colour();\n"
    "    if (!gl_FrontFacing) {\n" // the inside of an open mesh
    "        normal = -normal;\n"
    "        albedo *= vec3(0.58, 0.62, 0.70);\n"
    "    }\n"
    "    vec3 light = vertex_light > 0.0 ? 2.0 * albedo * surface.light\n"
    "                                    : 1.0 - exp(-1.15 * shade(albedo, normal, eye));\n"
    "    if (colours == 3.0) light = pow(0.5 + 0.5 * normal, vec3(2.2));\n"
    "#ifdef WIREFRAME\n"
    "    light = mix(light, vec3(0.012, 0.014, 0.018), lines());\n"
    "#endif\n"
    "    color = vec4(light, 1);\n"
    "}\n";

#endif
