/* SPDX-License-Identifier: MIT */
#include "commands.h"

#include "report.h"
#include <stdlib.h>

bool view_commands_create(view_commands *commands, const view_gl *gl, const view_surfaces *drawn) {
    *commands = (view_commands){
        .gl = gl, .drawn = *drawn, .buffer = view_stream_make(gl, sizeof(limn_draw))};
    size_t room = 1;
    for (uint32_t i = 0; i < drawn->count; i++)
        room += drawn->surfaces[i].mesh.patch_count;
    commands->first = calloc((size_t)drawn->count + 1, sizeof *commands->first);
    if (!commands->first) return view_fail("out of memory");
    if (gl->MultiDrawElementsIndirect) return true;
    commands->index_counts = calloc(room, sizeof *commands->index_counts);
    commands->index_offsets = calloc(room, sizeof *commands->index_offsets);
    commands->base_vertices = calloc(room, sizeof *commands->base_vertices);
    return (commands->index_counts && commands->index_offsets && commands->base_vertices) ||
           view_fail("out of memory");
}

/// A draw among those of all surfaces. Not sewn, its edges are as fine as itself.
static limn_draw place_draw(const view_commands *commands, const view_surface *surface, uint32_t d,
                            bool unsewn) {
    limn_draw draw = surface->plan.draws[d];
    if (unsewn) {
        const limn_domain *const domain = surface->mesh.domain;
        const uint8_t level = surface->plan.patches[draw.base_instance].level;
        const uint8_t levels[LIMN_CORNER_MAX] = {level, level, level, level};
        const limn_template whole = commands->drawn.templates[domain->kind]
                                        .templates[limn_template_find(domain, level, levels)];
        draw.first_index = whole.first_index;
        draw.index_count = whole.index_count;
    }
    draw.base_vertex += (int32_t)surface->first_vertex;
    draw.base_instance = 0; // OpenGL 4.2 and later would take another
    return draw;
}

static bool write_buffer(view_commands *commands, size_t count, bool unsewn) {
    limn_draw *to = view_stream_map(&commands->buffer, count);
    if (!to) return false;
    for (uint32_t i = 0; i < commands->drawn.count; i++) {
        const view_surface *const surface = &commands->drawn.surfaces[i];
        for (uint32_t d = 0; d < surface->plan.patch_count; d++)
            *to++ = place_draw(commands, surface, d, unsewn);
    }
    const size_t first = view_stream_unmap(&commands->buffer);
    for (uint32_t i = 0; i < commands->drawn.count; i++)
        commands->first[i] += first;
    return true;
}

static void write_arguments(view_commands *commands, bool unsewn) {
    size_t at = 0;
    for (uint32_t i = 0; i < commands->drawn.count; i++) {
        const view_surface *const surface = &commands->drawn.surfaces[i];
        for (uint32_t d = 0; d < surface->plan.patch_count; d++, at++) {
            const limn_draw draw = place_draw(commands, surface, d, unsewn);
            commands->index_counts[at] = (GLsizei)draw.index_count;
            commands->index_offsets[at] =
                (const void *)(uintptr_t)(draw.first_index * sizeof(uint16_t));
            commands->base_vertices[at] = draw.base_vertex;
        }
    }
}

bool view_commands_write(view_commands *commands, bool unsewn) {
    size_t count = 0;
    for (uint32_t i = 0; i < commands->drawn.count; i++) {
        commands->first[i] = count;
        count += commands->drawn.surfaces[i].plan.patch_count;
    }
    if (commands->gl->MultiDrawElementsIndirect) return write_buffer(commands, count, unsewn);
    write_arguments(commands, unsewn);
    return true;
}

void view_commands_draw(const view_commands *commands, uint32_t surface) {
    const view_gl *const gl = commands->gl;
    const size_t first = commands->first[surface];
    const GLsizei count = (GLsizei)commands->drawn.surfaces[surface].plan.patch_count;
    if (gl->MultiDrawElementsIndirect) {
        gl->BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands->buffer.buffer);
        gl->MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT,
                                      (const void *)(uintptr_t)(first * sizeof(limn_draw)), count,
                                      0);
    } else {
        gl->MultiDrawElementsBaseVertex(GL_TRIANGLES, commands->index_counts + first,
                                        GL_UNSIGNED_SHORT, commands->index_offsets + first, count,
                                        commands->base_vertices + first);
    }
}

void view_commands_end(view_commands *commands) {
    if (commands->gl->MultiDrawElementsIndirect) view_stream_fence(&commands->buffer);
}

void view_commands_destroy(view_commands *commands) {
    view_stream_destroy(&commands->buffer);
    free(commands->first);
    free(commands->index_counts);
    free(commands->index_offsets);
    free(commands->base_vertices);
    *commands = (view_commands){0};
}
