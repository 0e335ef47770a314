/* SPDX-License-Identifier: MIT */
/* Coordinates and values so large that sums of them might overflow. */
#include "mesh.h"

/// A thirtieth of what floats hold, 3.4e38: differences of two are at most twice as large, and the
/// weights of a sum, some of which are negative, may make several times that.
#define COORDINATE_MAX 1e37f

static float largest_of(const float values[3]) {
    float largest = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float size = values[axis] < 0 ? -values[axis] : values[axis];
        if (size > largest) largest = size;
    }
    return largest;
}

limn_bake_status limni_check_extent(limni_context *context, const limni_source *source,
                                    const limni_mesh *mesh) {
    const char *const file = mesh->path ? mesh->path : mesh->name;
    limni_place text;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        const float largest = largest_of(mesh->controls[c]);
        if (largest > COORDINATE_MAX)
            return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                              "%s: a coordinate of %s is too large: %g; 1e37 is the most", file,
                              limni_control_place(mesh, c, text), (double)largest);
    }
    for (uint32_t c = 0; c < source->channel_count; c++) {
        const limni_source_channel *const channel = &source->channels[c];
        for (uint32_t v = 0; v < channel->value_count; v++) {
            const float largest = largest_of(channel->values[v]);
            if (largest > COORDINATE_MAX)
                return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                                  "%s: value %u of %s is too large: %g; 1e37 is the most", file,
                                  v + mesh->index_base, channel->name, (double)largest);
        }
    }
    return LIMN_BAKE_OK;
}
