/* SPDX-License-Identifier: MIT */
/* A file as it is shown in a window: what is opened together, and closed when another one comes. */
#ifndef VIEW_SHOW_H
#define VIEW_SHOW_H

#include "game_loop.h"
#include "picture.h"

typedef struct view_show {
    view_scene scene;
    view_renderer *renderer;
    view_game game;
} view_show;

/// Opens a file as the options of a picture say. Reports why and returns NULL on failure.
view_show *view_show_open(const view_gl *gl, view_workers *workers, const char *path,
                          const view_picture *options);

/// Takes NULL as well.
void view_show_close(view_show *show);

#endif
