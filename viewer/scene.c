/* SPDX-License-Identifier: MIT */
#include "scene.h"

#include "limn/character.h"
#include "normals.h"
#include "report.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool has_too_many(const limn_mesh *mesh, uint64_t vertex_count) {
    // Base vertices are GLint, and every buffer must fit into memory.
    if (vertex_count <= INT32_MAX && vertex_count <= SIZE_MAX / sizeof(view_vertex)) return false;
    return !view_fail("mesh '%s' has too many vertices", mesh->name);
}

static void find_corner_weights(const limn_domain *domain, limn_row row, float weights[4]) {
    const float u = (float)row.i / LIMN_GRID_SIZE, v = (float)row.j / LIMN_GRID_SIZE;
    const bool quad = domain->kind == LIMN_DOMAIN_QUAD;
    weights[0] = quad ? (1 - u) * (1 - v) : 1 - u - v;
    weights[1] = quad ? u * (1 - v) : u;
    weights[2] = quad ? u * v : v;
    weights[3] = quad ? (1 - u) * v : 0;
}

/// At every row, what is drawn between the colours of the corners.
static void spread_light(const limn_plan *plan, view_vertex *vertices) {
    const limn_domain *const domain = plan->mesh->domain;
    for (uint32_t p = 0; p < plan->patch_count; p++) {
        view_vertex *const patch = vertices + plan->patches[p].first_vertex;
        const uint32_t row_count = domain->row_counts[plan->patches[p].level];
        for (uint32_t row = domain->corner_count; row < row_count; row++) {
            float weights[4];
            find_corner_weights(domain, domain->rows[row], weights);
            for (int colour = 0; colour < 3; colour++) {
                float sum = 0.5f; // to round
                for (uint32_t corner = 0; corner < domain->corner_count; corner++)
                    sum += weights[corner] * patch[corner].light[colour];
                patch[row].light[colour] = (uint8_t)sum;
            }
        }
    }
}

/// Positions, and the limit's normals if the file has them; otherwise those of the triangles.
static bool evaluate_vertices(const view_scene *scene, const limn_plan *plan,
                              const uint16_t *indices, view_vertex *vertices) {
    const limn_mesh *const mesh = plan->mesh;
    limn_output output = {.vertices = vertices, .stride = sizeof(view_vertex)};
    float *control_normals = NULL;
    if (mesh->normals) {
        control_normals = malloc(((size_t)mesh->normal_count + 1) * sizeof(float[3]));
        if (!control_normals) return false;
        limn_mesh_control_normals(mesh, mesh->controls, control_normals);
        output.normals = vertices->normal;
        output.normal_stride = sizeof(view_vertex);
        output.control_normals = control_normals;
        output.colours = scene->light_mode == VIEW_LIGHT_NONE ? NULL : vertices->light;
        output.colour_stride = sizeof(view_vertex);
        output.lighting = &scene->lamps.lighting;
    }
    limn_evaluate(plan, mesh->controls, 0, plan->patch_count, &output);
    free(control_normals);
    if (scene->light_mode == VIEW_LIGHT_BASE) spread_light(plan, vertices);
    return mesh->normals || view_normals_compute(plan, indices, vertices);
}

static bool evaluate_surface(const view_scene *scene, view_surface *surface) {
    const limn_mesh *const mesh = &surface->mesh;
    const view_templates *const templates = &scene->templates[mesh->domain->kind];
    if (has_too_many(mesh, limni_frame_vertex_bound(&scene->frame, mesh))) return false;
    if (scene->light_mode != VIEW_LIGHT_NONE && !mesh->normals)
        return view_fail("--light: mesh '%s' has no normals; bake it with --normals exact",
                         mesh->name);
    surface->plan_memory = malloc(limn_plan_size(mesh) + 1);
    if (!surface->plan_memory) return view_fail("out of memory for mesh '%s'", mesh->name);
    surface->plan = limn_plan_build(mesh, mesh->controls, &scene->frame.view, 1, &scene->frame.desc,
                                    templates->templates, surface->plan_memory);
    const limn_plan *const plan = &surface->plan;
    surface->vertices = calloc((size_t)plan->vertex_count + 1, sizeof *surface->vertices);
    if (!surface->vertices) return view_fail("out of memory for mesh '%s'", mesh->name);

    view_vertices_describe(surface, 0, plan->patch_count, surface->vertices);
    return evaluate_vertices(scene, plan, templates->indices, surface->vertices) ||
           view_fail("out of memory for mesh '%s'", mesh->name);
}

bool view_scene_evaluate(view_scene *scene) {
    uint64_t vertex_count = 0;
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        view_surface *const surface = &scene->surfaces[i];
        if (!evaluate_surface(scene, surface)) return false;
        surface->first_vertex = (uint32_t)vertex_count;
        vertex_count += surface->plan.vertex_count;
        if (has_too_many(&surface->mesh, vertex_count)) return false;
    }
    return true;
}

/// Channel `number` of those that are texture coordinates.
static void find_uv(const limn_pack *pack, uint32_t number, view_surface *surface) {
    for (uint32_t c = 0; c < surface->mesh.channel_count; c++) {
        surface->uv = limn_mesh_channel(pack, &surface->mesh, c);
        surface->has_uv = surface->uv.kind == LIMN_CHANNEL_UV && number-- == 0;
        if (surface->has_uv) return;
    }
}

static bool find_materials(const limn_pack *pack, uint32_t mesh_index, view_surface *surface) {
    const uint32_t count = limn_mesh_material_range_count(pack, mesh_index);
    uint32_t uv_number = 0;
    if (count > 0) {
        surface->materials = malloc((size_t)surface->mesh.patch_count + 1);
        if (!surface->materials)
            return view_fail("out of memory for mesh '%s'", surface->mesh.name);
    }
    for (uint32_t r = 0; r < count; r++) {
        const limn_material_range range = limn_mesh_material_range(pack, mesh_index, r);
        const bool shown = range.material < VIEW_ALBEDO_LAYERS;
        memset(surface->materials + range.first_patch,
               shown ? (int)range.material : VIEW_ALBEDO_NONE, range.patch_count);
        if (!shown) continue;
        const limn_material material = limn_pack_material(pack, range.material);
        if (r == 0) uv_number = material.texture_channel;
        if (material.image_name && material.texture_channel != uv_number)
            fprintf(stderr,
                    "limn-view: note: mesh '%s': the texture of material '%s' is shown by the "
                    "texture coordinates of the first material\n",
                    surface->mesh.name, material.name);
    }
    find_uv(pack, uv_number, surface);
    return true;
}

static bool open_meshes(view_scene *scene, limni_frame_options options, const view_light *light,
                        uint32_t first, uint32_t count) {
    if (!limni_moment_make(&scene->moment, &scene->pack, first, count, &options))
        return view_fail("%s", options.error);
    scene->first_mesh = first;
    scene->bounds = limni_moment_bounds(&scene->moment);
    if (!limni_frame_resolve(&options, &scene->bounds, &scene->frame))
        return view_fail("%s", options.error);
    scene->light_mode = light->mode;
    if (light->mode != VIEW_LIGHT_NONE && !view_lamps_make(&scene->lamps, light, &scene->bounds))
        return false;
    if (!view_albedo_make(&scene->albedo, &scene->pack)) return false;
    scene->surfaces = calloc((size_t)count + 1, sizeof *scene->surfaces);
    if (!scene->surfaces) return view_fail("out of memory for %u meshes", count);
    for (uint32_t i = 0; i < count; i++) {
        scene->surface_count = i + 1;
        scene->surfaces[i].mesh = scene->moment.meshes[i].mesh;
        const limn_domain *const domain = scene->surfaces[i].mesh.domain;
        if (!view_templates_make(&scene->templates[domain->kind], domain) ||
            !find_materials(&scene->pack, first + i, &scene->surfaces[i]))
            return false;
        if (!view_control_mesh_find(&scene->surfaces[i].control_mesh, &scene->surfaces[i].mesh))
            return view_fail("out of memory for mesh '%s'", scene->surfaces[i].mesh.name);
    }
    return true;
}

bool view_scene_open(view_scene *scene, const char *path, const limni_frame_options *options,
                     const view_light *light, long mesh_index) {
    *scene = (view_scene){0};
    if (!view_asset_open(&scene->asset, path)) return false;
    const limn_result result = limn_pack_open(&scene->pack, scene->asset.bytes, scene->asset.size);
    if (result != LIMN_OK) return view_fail("%s: %s", path, limn_result_text(result));

    const uint32_t mesh_count = scene->pack.mesh_count;
    if (mesh_index == VIEW_ALL_MESHES) return open_meshes(scene, *options, light, 0, mesh_count);
    if ((unsigned long)mesh_index >= mesh_count) {
        return view_fail("%s: there is no mesh %ld; the file has %u, counted from 0", path,
                         mesh_index, mesh_count);
    }
    return open_meshes(scene, *options, light, (uint32_t)mesh_index, 1);
}

void view_scene_close(view_scene *scene) {
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        free(scene->surfaces[i].vertices);
        free(scene->surfaces[i].plan_memory);
        free(scene->surfaces[i].materials);
        view_control_mesh_free(&scene->surfaces[i].control_mesh);
    }
    free(scene->surfaces);
    limni_moment_free(&scene->moment);
    view_albedo_free(&scene->albedo);
    for (int domain = 0; domain < LIMN_DOMAIN_COUNT; domain++)
        view_templates_free(&scene->templates[domain]);
    view_asset_close(&scene->asset);
    *scene = (view_scene){0};
}

view_surfaces view_scene_surfaces(const view_scene *scene) {
    return (view_surfaces){.surfaces = scene->surfaces,
                           .count = scene->surface_count,
                           .templates = scene->templates,
                           .albedo = &scene->albedo};
}

static bool include_finest(view_framing *framing, const limn_mesh *mesh) {
    const limn_plan plan = limn_plan_uniform(mesh, LIMN_LEVEL_MAX);
    if (has_too_many(mesh, plan.vertex_count)) return false;
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
                      limni_camera *camera) {
    view_framing framing = view_framing_start(aspect);
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        if (!include_finest(&framing, &scene->surfaces[i].mesh)) return false;
        if (with_controls) include_controls(&framing, &scene->surfaces[i]);
    }
    if (view_framing_camera(&framing, aspect, camera)) return true;
    return view_fail("nothing to draw: no patches, or coordinates that are too large");
}
