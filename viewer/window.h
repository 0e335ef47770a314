/* SPDX-License-Identifier: MIT */
/* A window in which one moves around. */
#ifndef VIEW_WINDOW_H
#define VIEW_WINDOW_H

#include "picture.h"

/// Opens a window that begins with what a picture of the options would show, and returns when it
/// is closed. Reports why and returns false on failure.
///
/// keys  NULL, or what is pressed for the user, see script.h: frames then are a 60th of a second
bool view_window_run(const view_picture *options, const char *keys);

#endif
