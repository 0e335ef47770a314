/* SPDX-License-Identifier: MIT */
#include "mesh.h"
#include "require.h"

void limn_evaluate(const limn_plan *plan, const float *controls, uint32_t begin, uint32_t end,
                   const limn_output *output) {
    LIMNI_REQUIRE(plan && controls && output && begin <= end && end <= plan->patch_count, );
    if (begin == end) return;
    LIMNI_REQUIRE(output->vertices && (uintptr_t)output->vertices % sizeof(float) == 0, );
    LIMNI_REQUIRE(output->stride == 0 || output->stride >= 3 * sizeof(float), );
    LIMNI_REQUIRE(output->stride % sizeof(float) == 0, );

    LIMNI_REQUIRE(!output->normals || (output->control_normals && plan->mesh->normals), );
    LIMNI_REQUIRE((uintptr_t)output->normals % sizeof(float) == 0, );
    LIMNI_REQUIRE(output->normal_stride == 0 || output->normal_stride >= 3 * sizeof(float), );
    LIMNI_REQUIRE(output->normal_stride % sizeof(float) == 0, );

    const limn_mesh *const mesh = plan->mesh;
    limni_target target = {
        .normal_stride = output->normal_stride ? output->normal_stride : 3 * sizeof(float),
        .stride = output->stride ? output->stride : 3 * sizeof(float),
        .row_count = mesh->domain->row_counts[plan->level],
        .padded_row_count = mesh->domain->padded_row_counts[plan->level],
    };
    const limni_points points = {.controls = controls,
                                 .origin = mesh->origin,
                                 .normals = output->normals ? output->control_normals : NULL};
    for (uint32_t r = limni_find_run(mesh, begin); begin < end; r++) {
        const limn_file_run *const run = &mesh->runs[r];
        const uint32_t run_end = run->first_patch + run->patch_count;
        const uint32_t part_end = end < run_end ? end : run_end;
        const limni_run part =
            limni_run_part(mesh, run, begin - run->first_patch, part_end - run->first_patch);
        target.vertices = (unsigned char *)output->vertices +
                          (size_t)limn_plan_first_vertex(plan, begin) * target.stride;
        if (output->normals)
            target.normals = (unsigned char *)output->normals +
                             (size_t)limn_plan_first_vertex(plan, begin) * target.normal_stride;
        mesh->kernels->evaluate(&part, &points, &target);
        begin = part_end;
    }
}
