/* SPDX-License-Identifier: MIT */
#include "limn/format.h"
#include "limn/limn.h"
#include "require.h"

#include <float.h>
#include <math.h>

/// A weighted sum of a control point and its ring, relative to the origin.
static void sum_tangent(const limn_mesh *mesh, const float *controls, uint32_t control,
                        const float *weights, float tangent[3]) {
    const limn_file_normal *const normal = &mesh->normals[control];
    for (int axis = 0; axis < 3; axis++) {
        const float origin = mesh->origin[axis];
        float sum = weights[0] * (controls[3 * (size_t)control + (size_t)axis] - origin);
        for (uint32_t r = 0; r < normal->ring_count; r++) {
            const size_t other = mesh->ring[normal->first_ring + r];
            sum += weights[1 + r] * (controls[3 * other + (size_t)axis] - origin);
        }
        tangent[axis] = sum;
    }
}

/// The same arithmetic as the kernels' for a row.
static void normalise_cross(const float a[3], const float b[3], float normal[3]) {
    const float x = a[1] * b[2] - a[2] * b[1];
    const float y = a[2] * b[0] - a[0] * b[2];
    const float z = a[0] * b[1] - a[1] * b[0];
    const float square = x * x + y * y + z * z;
    const bool degenerate = !(square > FLT_MIN);
    const float scale = 1.0f / sqrtf(square);
    normal[0] = degenerate ? 0.0f : x * scale + 0.0f;
    normal[1] = degenerate ? 0.0f : y * scale + 0.0f;
    normal[2] = degenerate ? 1.0f : z * scale + 0.0f;
}

void limn_mesh_control_normals(const limn_mesh *mesh, const float *controls, float *normals) {
    LIMNI_REQUIRE(mesh && mesh->normals && controls && normals, );
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        const limn_file_normal *const record = &mesh->normals[c];
        const float *const weights = mesh->weights + record->first_weight;
        float along[3], across[3];
        sum_tangent(mesh, controls, c, weights, along);
        sum_tangent(mesh, controls, c, weights + 1 + record->ring_count, across);
        normalise_cross(along, across, normals + 3 * (size_t)c);
    }
}
