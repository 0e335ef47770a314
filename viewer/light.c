/* SPDX-License-Identifier: MIT */
#include "light.h"

#include "report.h"
#include <math.h>

static const float default_cone = 20;

static limn_light make_spot(const view_light *light, const limni_bounds *bounds) {
    const float radians = 0.017453293f * (light->cone > 0 ? light->cone : default_cone);
    limn_light spot = {.kind = LIMN_LIGHT_SPOT,
                       .colour = {0.95f, 0.86f, 0.66f},
                       .inner_cosine = cosf(0.6f * radians),
                       .outer_cosine = cosf(radians)};
    float square = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float middle = 0.5f * bounds->min[axis] + 0.5f * bounds->max[axis];
        const float target = light->has_target ? light->target[axis] : middle;
        spot.position[axis] = light->spot[axis];
        spot.direction[axis] = target - light->spot[axis];
        square += spot.direction[axis] * spot.direction[axis];
    }
    for (int axis = 0; axis < 3; axis++)
        spot.direction[axis] /= sqrtf(square);
    return spot;
}

bool view_lamps_make(view_lamps *lamps, const view_light *light, const limni_bounds *bounds) {
    *lamps = (view_lamps){
        .lights = {{.colour = {0.16f, 0.19f, 0.25f}, .direction = {-0.36f, -0.48f, -0.8f}}},
        .lighting = {.mode = light->mode == VIEW_LIGHT_EXACT ? LIMN_LIGHT_EXACT
                                                             : LIMN_LIGHT_INTERPOLATED,
                     .ambient = {0.03f, 0.03f, 0.035f},
                     .lights = lamps->lights,
                     .light_count = 1}};
    if (light->has_spot) lamps->lights[lamps->lighting.light_count++] = make_spot(light, bounds);
    return limn_lights_check(lamps->lights, lamps->lighting.light_count, NULL) == LIMN_OK ||
           view_fail("--spot: it is where it looks to, or too far away");
}
