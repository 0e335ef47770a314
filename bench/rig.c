/* SPDX-License-Identifier: MIT */
#include "rig.h"

#include <math.h>
#include <stdlib.h>

static int find_longest_axis(const limn_mesh *mesh) {
    int longest = 0;
    for (int axis = 1; axis < 3; axis++) {
        if (mesh->bounds_max[axis] - mesh->bounds_min[axis] >
            mesh->bounds_max[longest] - mesh->bounds_min[longest])
            longest = axis;
    }
    return longest;
}

/// Where a control point is among the joints, from 0 to joint_count - 1.
static float find_place(const limn_mesh *mesh, int axis, uint32_t point, uint32_t joint_count) {
    const float low = mesh->bounds_min[axis], high = mesh->bounds_max[axis];
    const float share = (mesh->controls[3 * point + (uint32_t)axis] - low) / (high - low);
    return fminf(fmaxf(share, 0), 1) * (float)(joint_count - 1);
}

bool bench_rig_attach(limn_skin *skin, const limn_mesh *mesh, uint32_t joint_count,
                      uint32_t influence_count) {
    const size_t count = (size_t)mesh->control_count * influence_count;
    uint16_t *const joints = malloc(count * sizeof *joints);
    float *const weights = malloc(count * sizeof *weights);
    *skin = (limn_skin){mesh->control_count, joint_count, influence_count, joints, weights,
                        mesh->kernels};
    if (!joints || !weights) return false;
    const int axis = find_longest_axis(mesh);
    for (size_t i = 0; i < count; i++) {
        const float place = find_place(mesh, axis, (uint32_t)(i / influence_count), joint_count);
        const float first = fmaxf(place - 0.5f * (float)influence_count, 0);
        const uint32_t last = joint_count - influence_count;
        joints[i] = (uint16_t)(fminf(first, (float)last) + (float)(i % influence_count));
        weights[i] = 1 / (0.5f + fabsf(place - joints[i]));
    }
    return limn_skin_normalise(mesh->control_count, influence_count, joints, weights, NULL) ==
           LIMN_OK;
}

void bench_rig_free(limn_skin *skin) {
    free((void *)(uintptr_t)skin->joints); // the arrays are this file's own
    free((void *)(uintptr_t)skin->weights);
}

void bench_rig_wobble(const limn_mesh *mesh, uint32_t joint_count, float seconds, float *matrices) {
    const int axis = find_longest_axis(mesh), a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (uint32_t j = 0; j < joint_count; j++) {
        const float angle = 0.2f * sinf(4 * seconds + 0.1f * (float)j);
        const float share = ((float)j + 0.5f) / (float)joint_count;
        const float pivot[2] = {
            (mesh->bounds_min[a] + mesh->bounds_max[a]) / 2,
            mesh->bounds_min[axis] + share * (mesh->bounds_max[axis] - mesh->bounds_min[axis]),
        };
        float *const m = matrices + 12 * j;
        const float c = cosf(angle), s = sinf(angle);
        for (int i = 0; i < 12; i++)
            m[i] = 0;
        m[4 * b + b] = 1;
        m[4 * a + a] = m[4 * axis + axis] = c;
        m[4 * a + axis] = -s, m[4 * axis + a] = s;
        m[4 * a + 3] = pivot[0] - c * pivot[0] + s * pivot[1];
        m[4 * axis + 3] = pivot[1] - s * pivot[0] - c * pivot[1];
    }
}
