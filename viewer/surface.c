/* SPDX-License-Identifier: MIT */
#include "surface.h"

#include "limn/format.h"
#include "report.h"
#include <stdlib.h>
#include <string.h>

bool view_templates_make(view_templates *templates, const limn_domain *domain) {
    const limn_topology topology = LIMN_TOPOLOGY_TRIANGLES;
    if (templates->templates) return true;
    templates->index_count = limn_templates_write(domain, topology, 2, NULL, NULL);
    templates->indices = calloc(templates->index_count, sizeof *templates->indices);
    templates->templates = calloc(limn_template_count(domain), sizeof *templates->templates);
    if (!templates->indices || !templates->templates) return view_fail("out of memory");
    limn_templates_write(domain, topology, 2, templates->indices, templates->templates);
    return true;
}

void view_templates_free(view_templates *templates) {
    free(templates->indices);
    free(templates->templates);
    *templates = (view_templates){0};
}

/// Whether all corners of a class are inside and have the valence of a regular grid.
static bool is_regular(const limn_file_class *class, const limn_domain *domain) {
    const uint16_t regular = domain->kind == LIMN_DOMAIN_QUAD ? 4 : 6;
    for (uint32_t c = 0; c < domain->corner_count; c++) {
        if (class->valences[c] != regular) return false;
    }
    return class->boundary_corners == 0;
}

/// The class of a patch: grey where it is regular, and otherwise a hue far from that of the classes
/// before it. `run` may be any before that of the patch, and becomes it.
static void find_class_colour(const limn_mesh *mesh, uint32_t patch, uint32_t *run,
                              uint8_t colour[3]) {
    static const uint32_t golden = 2654435769u; // 2^32 by the golden ratio
    while (mesh->runs[*run].first_patch + mesh->runs[*run].patch_count <= patch)
        ++*run;
    const uint32_t class_index = mesh->runs[*run].class_index;
    const uint32_t hue = (class_index * golden) >> 16; // 65536 all around
    memset(colour, 90, 3);
    if (is_regular(&mesh->classes[class_index], mesh->domain)) return;
    for (uint32_t channel = 0; channel < 3; channel++) {
        const uint32_t turned = (hue + channel * 65536 / 3) % 65536;
        const uint32_t away =
            turned < 32768 ? turned : 65536 - turned; // from the channel's own hue
        colour[channel] = (uint8_t)(20 + (away < 21845 ? 150 * (21845 - away) / 21845 : 0));
    }
}

/// The first rows of a domain are its corners. Sides of a patch have grid vectors (dx, dy) with a
/// largest component of LIMN_GRID_SIZE, so the cross product below counts grid steps exactly.
static uint8_t border_steps(const limn_domain *domain, uint32_t edge, limn_row row) {
    if (edge >= domain->corner_count) return UINT8_MAX;
    const limn_row from = domain->rows[edge], to = domain->rows[(edge + 1) % domain->corner_count];
    const int dx = to.i - from.i, dy = to.j - from.j;
    return (uint8_t)((dx * (row.j - from.j) - dy * (row.i - from.i)) / LIMN_GRID_SIZE);
}

void view_vertices_describe(const view_surface *surface, uint32_t begin, uint32_t end,
                            view_vertex *vertices) {
    const limn_plan *const plan = &surface->plan;
    const limn_domain *const domain = plan->mesh->domain;
    uint32_t run = 0;
    for (uint32_t p = begin; p < end; p++) {
        const limn_plan_patch *const patch = &plan->patches[p];
        const float level = patch->level > 0 ? (float)(patch->level - 1) + patch->morph : 0;
        const uint8_t material =
            surface->materials ? surface->materials[patch->patch] : VIEW_ALBEDO_NONE;
        uint8_t colour[3];
        find_class_colour(plan->mesh, patch->patch, &run, colour);
        for (uint32_t row = 0; row < domain->row_counts[patch->level]; row++) {
            view_vertex *const vertex = &vertices[patch->first_vertex + row];
            vertex->level = level;
            vertex->material = material;
            memcpy(vertex->class_colour, colour, sizeof colour);
            for (uint32_t edge = 0; edge < sizeof vertex->borders; edge++)
                vertex->borders[edge] = border_steps(domain, edge, domain->rows[row]);
        }
    }
    if (surface->has_uv)
        limn_evaluate_channel(plan, &surface->uv, surface->uv.mesh.controls, begin, end,
                              &(limn_value_output){.values = vertices->uv,
                                                   .stride = sizeof(view_vertex),
                                                   .format = LIMN_VALUE_FLOAT2});
}
