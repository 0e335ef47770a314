/* SPDX-License-Identifier: MIT */
#include "limn/limn.h"
#include "require.h"

limn_plan limn_plan_uniform(const limn_mesh *mesh, uint32_t level) {
    LIMNI_REQUIRE(mesh && level <= LIMN_LEVEL_MAX, (limn_plan){0});
    return (limn_plan){
        .mesh = mesh,
        .level = level,
        .patch_count = mesh->patch_count,
        .vertex_count = (uint64_t)mesh->patch_count * mesh->domain->row_counts[level],
        .index_count = (uint64_t)mesh->patch_count * mesh->domain->index_counts[level],
    };
}

uint64_t limn_plan_first_vertex(const limn_plan *plan, uint32_t patch_index) {
    LIMNI_REQUIRE(plan && patch_index < plan->patch_count, 0);
    return (uint64_t)patch_index * plan->mesh->domain->row_counts[plan->level];
}
