/* SPDX-License-Identifier: MIT */
#include "mesh.h"
#include "require.h"

static uint32_t position_size(limn_position_format format) {
    return format == LIMN_POSITION_UNORM16X4 ? 8 : 12;
}

static uint32_t normal_size(limn_normal_format format) {
    static const uint8_t sizes[] = {[LIMN_NORMAL_FLOAT3] = 12,
                                    [LIMN_NORMAL_OCT16X2] = 4,
                                    [LIMN_NORMAL_OCT8X2] = 2,
                                    [LIMN_NORMAL_SNORM8X4] = 4};
    return sizes[format];
}

/// Whether memory that starts at `start` may hold elements of `size` bytes every `stride` bytes; a
/// stride of 0 stands for `size`.
static bool fits(const void *start, uint32_t stride, uint32_t size) {
    const uint32_t alignment = size % 4 == 0 ? 4 : 2;
    return (uintptr_t)start % alignment == 0 && stride % alignment == 0 &&
           (stride == 0 || stride >= size);
}

/// Streams of their own lie apart; inside the same vertices, positions and normals have one stride
/// and do not overlap.
static bool are_apart(const limn_output *output) {
    const uint32_t size = position_size(output->position_format);
    const uint32_t normals = normal_size(output->normal_format);
    const uint32_t stride = output->stride ? output->stride : size;
    const uint32_t normal_stride = output->normal_stride ? output->normal_stride : normals;
    const uintptr_t behind = (uintptr_t)output->normals - (uintptr_t)output->vertices;
    if (behind >= stride && -behind >= normal_stride) return true;
    if (stride != normal_stride) return false;
    return behind < stride ? behind >= size && behind + normals <= stride
                           : -behind >= normals && -behind + size <= stride;
}

static bool is_valid(const limn_mesh *mesh, const limn_output *output) {
    if ((unsigned)output->position_format > LIMN_POSITION_UNORM16X4) return false;
    if ((unsigned)output->normal_format > LIMN_NORMAL_SNORM8X4) return false;
    if (!output->vertices ||
        !fits(output->vertices, output->stride, position_size(output->position_format)))
        return false;
    if (!output->normals) return true;
    return mesh->normals && output->control_normals &&
           fits(output->normals, output->normal_stride, normal_size(output->normal_format)) &&
           are_apart(output);
}

static limni_target make_target(const limn_mesh *mesh, const limn_output *output) {
    limni_target target = {
        .stride = output->stride ? output->stride : position_size(output->position_format),
        .normal_stride =
            output->normal_stride ? output->normal_stride : normal_size(output->normal_format),
        .position_format = output->position_format,
        .normal_format = output->normal_format,
        .streaming = output->streaming,
    };
    for (int axis = 0; axis < 3; axis++) {
        const float low = output->box ? output->box[axis] : mesh->bounds_min[axis];
        const float high = output->box ? output->box[3 + axis] : mesh->bounds_max[axis];
        target.box_min[axis] = low;
        target.box_scale[axis] = high > low ? 65535.0f / (high - low) : 0.0f;
    }
    return target;
}

/// The patches from `begin` on, before `end`, that are of one class. Returns how many.
static uint32_t take_run(const limn_plan *plan, uint32_t begin, uint32_t end, limni_run *part) {
    const limn_mesh *const mesh = plan->mesh;
    const limn_plan_patch *const items = plan->patches;
    const limn_file_run *const run =
        &mesh->runs[limni_find_run(mesh, items ? items[begin].patch : begin)];
    const uint32_t run_end = run->first_patch + run->patch_count;
    if (!items) {
        const uint32_t part_end = end < run_end ? end : run_end;
        *part = limni_run_part(mesh, run, begin - run->first_patch, part_end - run->first_patch);
        return part_end - begin;
    }
    uint32_t count = 1;
    while (begin + count < end && items[begin + count].patch < run_end)
        count++;
    *part = limni_run_part(mesh, run, 0, count);
    part->items = items + begin;
    part->first_patch = run->first_patch;
    return count;
}

void limn_evaluate(const limn_plan *plan, const float *controls, uint32_t begin, uint32_t end,
                   const limn_output *output) {
    LIMNI_REQUIRE(plan && controls && output && begin <= end && end <= plan->patch_count, );
    if (begin == end) return;
    const limn_mesh *const mesh = plan->mesh;
    LIMNI_REQUIRE(is_valid(mesh, output), );
    limni_target target = make_target(mesh, output);
    target.level = plan->level;
    target.domain = mesh->domain;
    const limni_points points = {.controls = controls,
                                 .origin = mesh->origin,
                                 .normals = output->normals ? output->control_normals : NULL};
    while (begin < end) {
        limni_run part;
        const uint32_t count = take_run(plan, begin, end, &part);
        const uint64_t first = plan->patches ? 0 : limn_plan_first_vertex(plan, begin);
        target.vertices = (unsigned char *)output->vertices + (size_t)first * target.stride;
        if (output->normals)
            target.normals =
                (unsigned char *)output->normals + (size_t)first * target.normal_stride;
        mesh->kernels->evaluate(&part, &points, &target);
        begin += count;
    }
}
