/* SPDX-License-Identifier: MIT */
/*
 * What a test does in the place of a user: names of keys, one in each frame, numbers of frames
 * without a key, and files that are dropped, with commas, "t,10,f12,+fox.glb". At its end the window
 * closes.
 */
#ifndef VIEW_SCRIPT_H
#define VIEW_SCRIPT_H

#include "keys.h"
#include <stdbool.h>
#include <stdint.h>

typedef struct view_script {
    const char *rest; ///< of the text
    uint32_t wait;    ///< frames
} view_script;

enum { VIEW_SCRIPT_WORD_MAX = 256 };

/// What happens before a frame.
typedef struct view_script_event {
    bool is_key;
    view_key key;
    char dropped[VIEW_SCRIPT_WORD_MAX]; ///< a path; "": nothing was
} view_script_event;

/// Whether all words are keys, numbers or files.
bool view_script_check(const char *text);

view_script_event view_script_next(view_script *script);

#endif
