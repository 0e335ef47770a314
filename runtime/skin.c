/* SPDX-License-Identifier: MIT */
#include "kernels.h"
#include "require.h"

static bool is_usable(const limn_pose *pose) {
    if (!pose || !pose->skin || (!pose->matrices && !pose->dual_quaternions)) return false;
    const limn_skin *const skin = pose->skin;
    return skin->kernels && skin->influence_count >= 1 &&
           skin->influence_count <= LIMN_INFLUENCE_MAX;
}

void limn_pose_points(const limn_pose *pose, const float *points, uint32_t begin, uint32_t end,
                      float *out) {
    LIMNI_REQUIRE(is_usable(pose) && points && out, );
    LIMNI_REQUIRE(begin <= end && end <= pose->skin->point_count, );
    pose->skin->kernels->skin(pose, NULL, points, begin, end, out);
}

void limn_pose_normals(const limn_pose *pose, const limn_mesh *mesh, const float *normals,
                       uint32_t begin, uint32_t end, float *out) {
    LIMNI_REQUIRE(is_usable(pose) && mesh && normals && out, );
    LIMNI_REQUIRE(mesh->normals && pose->skin->point_count == mesh->control_count, );
    LIMNI_REQUIRE(mesh->base_first == 0, );
    LIMNI_REQUIRE(begin <= end && end <= mesh->normal_count, );
    pose->skin->kernels->skin(pose, mesh, normals, begin, end, out);
}
