/* SPDX-License-Identifier: MIT */
/* The lamps of a picture whose vertices the runtime lights. */
#ifndef VIEW_LIGHT_H
#define VIEW_LIGHT_H

#include "frame.h"
#include "limn/limn.h"
#include <stdbool.h>

typedef enum view_light_mode {
    VIEW_LIGHT_NONE,         ///< the shader lights the picture
    VIEW_LIGHT_BASE,         ///< all of it is found at the base vertices, and linear between them
    VIEW_LIGHT_INTERPOLATED, ///< LIMN_LIGHT_INTERPOLATED
    VIEW_LIGHT_EXACT         ///< LIMN_LIGHT_EXACT
} view_light_mode;

/// What the command line says.
typedef struct view_light {
    view_light_mode mode;
    bool has_spot, has_target;
    float spot[3], target[3];
    float cone; ///< degrees from its axis to its edge; 0: a default
} view_light;

enum { VIEW_LAMP_COUNT = 2 };

typedef struct view_lamps {
    limn_light lights[VIEW_LAMP_COUNT];
    limn_lighting lighting; ///< points to `lights`, so it must stay where it is
} view_lamps;

/// A faint light from the front and above; and a spot, if there is one, towards its target or the
/// middle of the bounds. Reports why and returns false on failure.
bool view_lamps_make(view_lamps *lamps, const view_light *light, const limni_bounds *bounds);

#endif
