/* SPDX-License-Identifier: MIT */
#include "scene.h"

#include "normals.h"
#include "report.h"
#include <stdlib.h>
#include <string.h>

/// Base vertices are GLint, and every buffer must fit into memory.
static bool can_be_drawn(const limn_plan *plan) {
    return plan->vertex_count <= INT32_MAX && plan->vertex_count <= SIZE_MAX / sizeof(view_vertex);
}

/// The first rows of a domain are its corners. Sides of a patch have grid vectors (dx, dy) with a
/// largest component of LIMN_GRID_SIZE, so the cross product below counts grid steps exactly.
static uint8_t border_steps(const limn_domain *domain, uint32_t edge, limn_row row) {
    if (edge >= domain->corner_count) return UINT8_MAX;
    const limn_row from = domain->rows[edge], to = domain->rows[(edge + 1) % domain->corner_count];
    const int dx = to.i - from.i, dy = to.j - from.j;
    return (uint8_t)((dx * (row.j - from.j) - dy * (row.i - from.i)) / LIMN_GRID_SIZE);
}

/// All patches are alike: the first one is worked out and the others copy it.
static void set_borders(const limn_plan *plan, view_vertex *vertices) {
    if (plan->patch_count == 0) return;
    const limn_domain *const domain = plan->mesh->domain;
    const uint32_t row_count = domain->row_counts[plan->level];
    for (uint32_t row = 0; row < row_count; row++) {
        for (uint32_t edge = 0; edge < sizeof vertices->borders; edge++)
            vertices[row].borders[edge] = border_steps(domain, edge, domain->rows[row]);
    }
    for (uint32_t patch = 1; patch < plan->patch_count; patch++) {
        view_vertex *const first = vertices + limn_plan_first_vertex(plan, patch);
        for (uint32_t row = 0; row < row_count; row++)
            memcpy(first[row].borders, vertices[row].borders, sizeof first[row].borders);
    }
}

static bool evaluate_surface(view_surface *surface, limn_mesh mesh, uint32_t level) {
    surface->mesh = mesh;
    surface->plan = limn_plan_uniform(&surface->mesh, level);
    const limn_plan *const plan = &surface->plan;
    if (!can_be_drawn(plan)) return view_fail("mesh '%s' has too many vertices", mesh.name);
    surface->vertices = calloc((size_t)plan->vertex_count + 1, sizeof *surface->vertices);
    if (!surface->vertices) return view_fail("out of memory for mesh '%s'", mesh.name);

    limn_evaluate(plan, surface->mesh.controls, 0, plan->patch_count,
                  &(limn_output){.vertices = surface->vertices, .stride = sizeof(view_vertex)});
    set_borders(plan, surface->vertices);
    if (!view_normals_compute(plan, surface->vertices) ||
        !view_control_mesh_find(&surface->control_mesh, &surface->mesh)) {
        return view_fail("out of memory for mesh '%s'", mesh.name);
    }
    return true;
}

static bool evaluate_meshes(view_scene *scene, uint32_t level, uint32_t first, uint32_t count) {
    scene->surfaces = calloc((size_t)count + 1, sizeof *scene->surfaces);
    if (!scene->surfaces) return view_fail("out of memory for %u meshes", count);
    for (uint32_t i = 0; i < count; i++) {
        scene->surface_count = i + 1;
        const limn_mesh mesh = limn_pack_mesh(&scene->pack, first + i);
        if (!evaluate_surface(&scene->surfaces[i], mesh, level)) return false;
    }
    return true;
}

bool view_scene_open(view_scene *scene, const char *path, uint32_t level, long mesh_index) {
    *scene = (view_scene){0};
    char error[512];
    if (!limni_blob_file_open(&scene->blob, path, error, sizeof error))
        return view_fail("%s", error);
    const limn_result result = limn_pack_open(&scene->pack, scene->blob.bytes, scene->blob.size);
    if (result != LIMN_OK) return view_fail("%s: %s", path, limn_result_text(result));

    const uint32_t mesh_count = scene->pack.mesh_count;
    if (mesh_index == VIEW_ALL_MESHES) return evaluate_meshes(scene, level, 0, mesh_count);
    if ((unsigned long)mesh_index >= mesh_count) {
        return view_fail("%s: there is no mesh %ld; the file has %u, counted from 0", path,
                         mesh_index, mesh_count);
    }
    return evaluate_meshes(scene, level, (uint32_t)mesh_index, 1);
}

void view_scene_close(view_scene *scene) {
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        free(scene->surfaces[i].vertices);
        view_control_mesh_free(&scene->surfaces[i].control_mesh);
    }
    free(scene->surfaces);
    limni_blob_file_close(&scene->blob);
    *scene = (view_scene){0};
}

static bool include_finest(view_framing *framing, const limn_mesh *mesh) {
    const limn_plan plan = limn_plan_uniform(mesh, LIMN_LEVEL_MAX);
    if (!can_be_drawn(&plan)) return view_fail("mesh '%s' has too many vertices", mesh->name);
    float(*const positions)[3] = malloc(((size_t)plan.vertex_count + 1) * sizeof *positions);
    if (!positions) return view_fail("out of memory for mesh '%s'", mesh->name);
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count,
                  &(limn_output){.vertices = positions});
    for (size_t vertex = 0; vertex < plan.vertex_count; vertex++)
        view_framing_include(framing, positions[vertex]);
    free(positions);
    return true;
}

static void include_controls(view_framing *framing, const view_surface *surface) {
    for (size_t i = 0; i < surface->control_mesh.point_count; i++) {
        const size_t point = surface->control_mesh.points[i];
        view_framing_include(framing, surface->mesh.controls + 3 * point);
    }
}

bool view_scene_frame(const view_scene *scene, double aspect, bool with_controls,
                      view_camera *camera) {
    view_framing framing = view_framing_start(aspect);
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        if (!include_finest(&framing, &scene->surfaces[i].mesh)) return false;
        if (with_controls) include_controls(&framing, &scene->surfaces[i]);
    }
    if (view_framing_camera(&framing, aspect, camera)) return true;
    return view_fail("nothing to draw: no patches, or coordinates that are too large");
}
