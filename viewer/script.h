/* SPDX-License-Identifier: MIT */
/*
 * Keys that a test presses: names of keys, one in each frame, and numbers of frames without a key,
 * with commas, "t,10,f12". At its end the window closes.
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

/// Whether all words are keys or numbers.
bool view_script_check(const char *text);

/// The key to be pressed before this frame. False: there is none.
bool view_script_next(view_script *script, view_key *key);

#endif
