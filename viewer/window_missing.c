/* SPDX-License-Identifier: MIT */
/* What takes the place of window.c where there is no GLFW. */
#include "report.h"
#include "window.h"

bool view_window_run(const view_picture *options, const char *keys) {
    (void)options;
    (void)keys;
    return view_fail(
        "no output given: use --png OUT.png; this limn-view was built without windows");
}
