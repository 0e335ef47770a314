/* SPDX-License-Identifier: MIT */
#include "picture.h"

#include "context.h"
#include "renderer.h"
#include "report.h"
#include "scene.h"
#include "target.h"
#include <string.h>

static bool upload_vertices(view_renderer *renderer, const view_scene *scene) {
    uint64_t vertex_count = 0;
    for (uint32_t i = 0; i < scene->surface_count; i++)
        vertex_count += scene->surfaces[i].plan.vertex_count;
    view_vertex *const vertices = view_renderer_map(renderer, vertex_count);
    for (uint32_t i = 0; i < scene->surface_count && vertices; i++) {
        const view_surface *const surface = &scene->surfaces[i];
        memcpy(vertices + surface->first_vertex, surface->vertices,
               (size_t)surface->plan.vertex_count * sizeof *vertices);
    }
    return vertices;
}

static bool draw(const view_gl *gl, const view_scene *scene, const view_picture *picture,
                 const view_target *target) {
    view_frame frame = {
        .width = target->width,
        .height = target->height,
        .pixel_scale =
            (float)target->pixel_scale * view_line_scale(picture->width, picture->height),
        .colours = picture->colours,
        .vertex_light = scene->light_mode != VIEW_LIGHT_NONE,
        .flat_shading = picture->flat_shading,
        .wireframe = picture->wireframe,
        .control_mesh = picture->control_mesh,
    };
    const double aspect = (double)picture->width / picture->height;
    limni_camera camera = scene->frame.camera;
    if ((!scene->frame.has_camera || picture->overview) &&
        !view_scene_frame(scene, aspect, picture->control_mesh, &camera))
        return false;
    frame.camera = view_camera_matrices(&camera, aspect);

    const view_surfaces surfaces = view_scene_surfaces(scene);
    view_renderer *const renderer = view_renderer_create(gl, &surfaces);
    const bool drawn =
        renderer && upload_vertices(renderer, scene) && view_renderer_draw(renderer, &frame);
    view_renderer_destroy(renderer);
    return drawn;
}

static bool draw_and_write(const view_scene *scene, const view_picture *picture) {
    view_gl gl;
    if (!view_gl_load(&gl, view_context_function)) return false;
    view_target target;
    view_image image = {0};
    const bool done = view_target_create(&target, &gl, picture->width, picture->height, true) &&
                      draw(&gl, scene, picture, &target) && view_target_read(&target, &image) &&
                      view_image_write_png(&image, picture->png_path);
    view_image_free(&image);
    view_target_destroy(&target);
    return done;
}

/// A picture of texture coordinates needs some; in a window one sees that there are none.
static bool check_colours(const view_scene *scene, const view_picture *picture) {
    bool has_uv = picture->colours != VIEW_COLOURS_UV;
    for (uint32_t i = 0; i < scene->surface_count; i++)
        has_uv |= scene->surfaces[i].has_uv;
    return has_uv || view_fail("%s: --colour uv: there are no texture coordinates in what is drawn",
                               picture->limn_path);
}

bool view_picture_make(const view_picture *picture) {
    view_scene scene;
    bool done = view_scene_open(&scene, picture->limn_path, &picture->frame, &picture->light,
                                picture->mesh_index);
    done = done && check_colours(&scene, picture) && view_scene_evaluate(&scene);
    if (done) {
        view_context *const context = view_context_create();
        done = context && draw_and_write(&scene, picture);
        view_context_destroy(context);
    }
    view_scene_close(&scene);
    return done;
}
