/* SPDX-License-Identifier: MIT */
/* The lines of text in the window. */
#ifndef VIEW_STATISTICS_H
#define VIEW_STATISTICS_H

#include "session.h"
#include <stddef.h>

/// Means over the last frames, so that they can be read.
typedef struct view_statistics {
    char name[128]; ///< of the file
    double frame_seconds;
    double stage_seconds[VIEW_STAGE_COUNT];
    uint32_t thread_count;
    bool persistent, indirect; ///< the driver has buffer storage; indirect draws
} view_statistics;

/// Takes a frame in that took `seconds` from the one before.
void view_statistics_add(view_statistics *statistics, const view_game *game, double seconds);

void view_statistics_write(const view_statistics *statistics, const view_session *session,
                           const view_game *game, char *lines, size_t size);

#endif
