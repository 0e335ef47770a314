/* SPDX-License-Identifier: MIT */
#include "limn/limn.h"
#include "require.h"

#include <math.h>

static bool are_finite(const float values[3]) {
    return isfinite(values[0]) && isfinite(values[1]) && isfinite(values[2]);
}

static bool is_unit(const float v[3]) {
    const float square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return fabsf(square - 1) <= 2e-3f;
}

static bool is_cone(float inner, float outer) {
    return outer >= -1 && inner >= outer && inner <= 1;
}

static bool is_light(const limn_light *light) {
    const float *const a = light->attenuation;
    if ((unsigned)light->kind > LIMN_LIGHT_SPOT || !are_finite(light->colour)) return false;
    if (light->kind != LIMN_LIGHT_POINT && !is_unit(light->direction)) return false;
    if (light->kind == LIMN_LIGHT_DIRECTIONAL) return true;
    if (!are_finite(light->position) || !are_finite(a) || !isfinite(light->range)) return false;
    if (!(a[0] >= 0 && a[1] >= 0 && a[2] >= 0 && light->range >= 0)) return false;
    return light->kind == LIMN_LIGHT_POINT || is_cone(light->inner_cosine, light->outer_cosine);
}

limn_result limn_lights_check(const limn_light *lights, uint32_t light_count, uint32_t *index) {
    LIMNI_REQUIRE(lights || light_count == 0, LIMN_ERROR_LIGHT);
    for (uint32_t i = 0; i < light_count; i++) {
        if (is_light(&lights[i])) continue;
        if (index) *index = i;
        return LIMN_ERROR_LIGHT;
    }
    return LIMN_OK;
}
