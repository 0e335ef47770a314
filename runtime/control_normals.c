/* SPDX-License-Identifier: MIT */
#include "kernels.h"
#include "require.h"

void limn_mesh_control_normals(const limn_mesh *mesh, const float *controls, float *normals) {
    LIMNI_REQUIRE(mesh && mesh->normals && controls && normals, );
    mesh->kernels->control_normals(mesh, controls, normals);
}
