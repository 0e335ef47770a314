/* SPDX-License-Identifier: MIT */
#include "compare.h"

#include "subject.h"

#include <math.h>

/// OpenSubdiv's values: [faces of the base mesh][rows].
static limn_bake_status oracle(limni_context *context, const limni_subject *s,
                               const limn_channel *channel, uint32_t channel_index,
                               double (**limit)[3]) {
    char error[512];
    limni_opensubdiv_mesh mesh;
    const limni_source_channel *const source = &s->source.channels[channel_index];
    const uint32_t row_count = channel->mesh.domain->row_counts[LIMN_LEVEL_MAX];
    const uint32_t corner_count = s->whole.half_edge_count;
    uint32_t *const corner_values = limni_allocate(context, corner_count, sizeof *corner_values);
    *limit = limni_allocate(context, (size_t)s->base.mesh->face_count * row_count, sizeof **limit);
    if (!corner_values || !*limit) return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < corner_count; h++)
        corner_values[h] = source->corner_values[s->whole.source_corners[h]];
    const limni_opensubdiv_channel values = {.values = source->values[0],
                                             .value_count = source->value_count,
                                             .corner_values = corner_values,
                                             .face_varying =
                                                 (limn_face_varying)channel->face_varying};
    LIMNI_TRY(limni_subject_describe(context, s, &mesh));
    if (limni_opensubdiv_values(&mesh, &values, *limit, error, sizeof error)) return LIMN_BAKE_OK;
    return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: OpenSubdiv: %s", s->whole.path, error);
}

static void compare_row(const float *value, const double *limit, uint32_t face,
                        limni_channel_comparison *comparison) {
    if (isnan(limit[0])) return;
    double difference = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double along = fabs((double)value[axis] - limit[axis]) / comparison->extent;
        if (!(along <= difference)) difference = along;
    }
    comparison->value_count++;
    if (difference <= comparison->largest) return;
    comparison->largest = difference;
    comparison->largest_face = face;
}

static void compare_values(const limn_mesh *mesh, const float (*values)[3],
                           const double (*limit)[3], limni_channel_comparison *comparison) {
    const uint32_t row_count = mesh->domain->row_counts[LIMN_LEVEL_MAX];
    limni_unrotated unrotated;
    limni_unrotate(mesh->domain, unrotated);
    for (uint32_t patch = 0; patch < mesh->patch_count; patch++) {
        const limn_patch_face face = limn_mesh_face(mesh, patch);
        for (uint32_t row = 0; row < row_count; row++)
            compare_row(values[(size_t)patch * row_count + row],
                        limit[(size_t)face.face * row_count + unrotated[face.rotation][row]],
                        face.face, comparison);
    }
}

limn_bake_status limni_compare_channel(limni_context *context, const limn_pack *pack,
                                       const limn_mesh *mesh, uint32_t channel_index,
                                       const char *path, limni_channel_comparison *comparison) {
    limni_subject read;
    double(*limit)[3];
    const limn_channel channel = limn_mesh_channel(pack, mesh, channel_index);
    LIMNI_TRY(limni_subject_read(context, pack, mesh, path, &read));
    if (channel_index >= read.source.channel_count)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: it has no channel %u", path,
                          channel_index);
    LIMNI_TRY(oracle(context, &read, &channel, channel_index, &limit));
    const limn_plan plan = limn_plan_uniform(mesh, LIMN_LEVEL_MAX);
    float(*const values)[3] = limni_allocate(context, (size_t)plan.vertex_count, sizeof *values);
    if (!values) return LIMN_BAKE_MEMORY;
    limn_evaluate_channel(&plan, &channel, channel.mesh.controls, 0, plan.patch_count,
                          &(limn_value_output){.values = values});
    *comparison = (limni_channel_comparison){0};
    for (int axis = 0; axis < 3; axis++)
        comparison->extent = fmax(comparison->extent, (double)channel.mesh.bounds_max[axis] -
                                                          (double)channel.mesh.bounds_min[axis]);
    if (!(comparison->extent > 0)) comparison->extent = 1;
    compare_values(&channel.mesh, (const float(*)[3])values, (const double(*)[3])limit, comparison);
    return LIMN_BAKE_OK;
}
