/* SPDX-License-Identifier: MIT */
#include "show.h"

#include "report.h"
#include <stdlib.h>

view_show *view_show_open(const view_gl *gl, view_workers *workers, const char *path,
                          const view_picture *options) {
    // Lamps stand elsewhere in every frame.
    const view_light no_light = {.mode = VIEW_LIGHT_NONE};
    view_show *const show = calloc(1, sizeof *show);
    if (!show) {
        view_fail("out of memory");
        return NULL;
    }
    if (view_scene_open(&show->scene, path, &options->frame, &no_light, options->mesh_index)) {
        const view_surfaces surfaces = view_scene_surfaces(&show->scene);
        show->renderer = view_renderer_create(gl, &surfaces);
        if (show->renderer && view_game_open(&show->game, &show->scene, workers)) return show;
    }
    view_show_close(show);
    return NULL;
}

void view_show_close(view_show *show) {
    if (!show) return;
    view_game_close(&show->game);
    view_renderer_destroy(show->renderer);
    view_scene_close(&show->scene);
    free(show);
}
