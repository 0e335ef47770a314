/* SPDX-License-Identifier: MIT */
#include "mesh.h"
#include "require.h"

static uint32_t size_of(limni_format format) {
    return 4 * limni_format_words(format);
}

static limni_format position_format(limn_position_format format) {
    return format == LIMN_POSITION_UNORM16X4 ? LIMNI_UNORM16X4 : LIMNI_FLOAT3;
}

static limni_format value_format(limn_value_format format) {
    static const uint8_t formats[] = {[LIMN_VALUE_FLOAT3] = LIMNI_FLOAT3,
                                      [LIMN_VALUE_FLOAT2] = LIMNI_FLOAT2,
                                      [LIMN_VALUE_HALF2] = LIMNI_HALF2,
                                      [LIMN_VALUE_UNORM16X2] = LIMNI_UNORM16X2,
                                      [LIMN_VALUE_RGBA8] = LIMNI_RGBA8};
    return (limni_format)formats[format];
}

static uint32_t normal_size(limn_normal_format format) {
    static const uint8_t sizes[] = {[LIMN_NORMAL_FLOAT3] = 12,
                                    [LIMN_NORMAL_OCT16X2] = 4,
                                    [LIMN_NORMAL_OCT8X2] = 2,
                                    [LIMN_NORMAL_SNORM8X4] = 4};
    return sizes[format];
}

enum { COLOUR_SIZE = 4, STREAM_COUNT = 3 };

/// One thing that vertices have, and where it goes.
typedef struct stream {
    const void *start; ///< NULL: nowhere
    uint32_t size, stride;
} stream;

static stream make_stream(const void *start, uint32_t stride, uint32_t size) {
    return (stream){start, size, stride ? stride : size};
}

static bool is_aligned(const stream *s) {
    const uint32_t alignment = s->size % 4 == 0 ? 4 : 2;
    return (uintptr_t)s->start % alignment == 0 && s->stride % alignment == 0 &&
           s->stride >= s->size;
}

/// Streams of their own lie apart; inside the same vertices, two have one stride and do not overlap.
static bool are_apart(const stream *a, const stream *b) {
    const uintptr_t behind = (uintptr_t)b->start - (uintptr_t)a->start;
    if (behind >= a->stride && -behind >= b->stride) return true;
    if (a->stride != b->stride) return false;
    return behind < a->stride ? behind >= a->size && behind + b->size <= a->stride
                              : -behind >= b->size && -behind + a->size <= a->stride;
}

static bool can_write(const limn_output *output) {
    const stream streams[STREAM_COUNT] = {
        make_stream(output->vertices, output->stride,
                    size_of(position_format(output->position_format))),
        make_stream(output->normals, output->normal_stride, normal_size(output->normal_format)),
        make_stream(output->colours, output->colour_stride, COLOUR_SIZE)};
    for (int i = 0; i < STREAM_COUNT; i++) {
        if (!streams[i].start) continue;
        if (!is_aligned(&streams[i])) return false;
        for (int k = 0; k < i; k++) {
            if (streams[k].start && !are_apart(&streams[k], &streams[i])) return false;
        }
    }
    return output->vertices;
}

static bool needs_tangents(const limn_output *output) {
    return output->normals || (output->colours && output->lighting->mode == LIMN_LIGHT_EXACT);
}

static bool is_valid(const limn_mesh *mesh, const limn_output *output) {
    const limn_lighting *const lighting = output->lighting;
    if ((unsigned)output->position_format > LIMN_POSITION_UNORM16X4) return false;
    if ((unsigned)output->normal_format > LIMN_NORMAL_SNORM8X4) return false;
    if (!can_write(output)) return false;
    if (output->colours && (!lighting || (unsigned)lighting->mode > LIMN_LIGHT_EXACT ||
                            (lighting->light_count > 0 && !lighting->lights)))
        return false;
    if (needs_tangents(output) && !mesh->normals) return false;
    return output->control_normals || !(output->normals || output->colours);
}

/// The box that packed coordinates are in.
static void set_box(const limn_mesh *mesh, const float *box, limni_target *target) {
    for (int axis = 0; axis < 3; axis++) {
        const float low = box ? box[axis] : mesh->bounds_min[axis];
        const float high = box ? box[3 + axis] : mesh->bounds_max[axis];
        target->box_min[axis] = low;
        target->box_scale[axis] = high > low ? 65535.0f / (high - low) : 0.0f;
    }
}

static limni_target make_target(const limn_mesh *mesh, const limn_output *output) {
    const limni_format format = position_format(output->position_format);
    limni_target target = {
        .vertices = output->vertices,
        .stride = output->stride ? output->stride : size_of(format),
        .normals = output->normals,
        .normal_stride =
            output->normal_stride ? output->normal_stride : normal_size(output->normal_format),
        .colours = output->colours,
        .colour_stride = output->colour_stride ? output->colour_stride : COLOUR_SIZE,
        .lighting = output->lighting,
        .grid = limni_grid_get(mesh->domain->kind),
        .tangents = needs_tangents(output),
        .format = format,
        .normal_format = output->normal_format,
        .streaming = output->streaming,
    };
    set_box(mesh, output->box, &target);
    return target;
}

/// The patches from `begin` on, before `end`, that are of one class of `mesh`: that of the plan, or
/// a channel of it. Returns how many.
static uint32_t take_run(const limn_plan *plan, const limn_mesh *mesh, uint32_t begin, uint32_t end,
                         limni_run *part) {
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

/// Evaluates patches of the plan, run by run.
///
/// to  where vertex 0 of the plan goes
static void evaluate(const limn_plan *plan, const limn_mesh *mesh, const limni_points *points,
                     uint32_t begin, uint32_t end, const limni_target *to) {
    limni_target target = *to;
    target.level = plan->level;
    target.domain = mesh->domain;
    while (begin < end) {
        limni_run part;
        const uint32_t count = take_run(plan, mesh, begin, end, &part);
        const uint64_t first = plan->patches ? 0 : limn_plan_first_vertex(plan, begin);
        target.vertices = to->vertices + (size_t)first * target.stride;
        if (to->normals) target.normals = to->normals + (size_t)first * target.normal_stride;
        if (to->colours) target.colours = to->colours + (size_t)first * target.colour_stride;
        mesh->kernels->evaluate(&part, points, &target);
        begin += count;
    }
}

static limni_points make_points(const limn_mesh *mesh, const float *controls,
                                const limn_output *output) {
    const bool shaded = output->normals || output->colours;
    return (limni_points){.controls = controls,
                          .origin = mesh->origin,
                          .normals = shaded ? output->control_normals : NULL};
}

void limn_evaluate(const limn_plan *plan, const float *controls, uint32_t begin, uint32_t end,
                   const limn_output *output) {
    LIMNI_REQUIRE(plan && controls && output && begin <= end && end <= plan->patch_count, );
    if (begin == end) return;
    const limn_mesh *const mesh = plan->mesh;
    LIMNI_REQUIRE(is_valid(mesh, output), );
    const limni_points points = make_points(mesh, controls, output);
    const limni_target target = make_target(mesh, output);
    evaluate(plan, mesh, &points, begin, end, &target);
}

void limn_base_evaluate(const limn_base *base, const float *controls, uint32_t begin, uint32_t end,
                        const limn_output *output) {
    LIMNI_REQUIRE(base && controls && output && begin <= end && end <= base->vertex_count, );
    if (begin == end) return;
    const limn_mesh *const mesh = base->mesh;
    LIMNI_REQUIRE(is_valid(mesh, output), );
    const limni_points points = make_points(mesh, controls, output);
    const limni_target target = make_target(mesh, output);
    mesh->kernels->evaluate_base(base, &points, begin, end, &target);
}

/// Whether memory that starts at `start` may hold elements of a format every `stride` bytes.
static bool fits(const void *start, uint32_t stride, limni_format format) {
    const stream values = make_stream(start, stride, size_of(format));
    return start && is_aligned(&values);
}

void limn_evaluate_channel(const limn_plan *plan, const limn_channel *channel, const float *values,
                           uint32_t begin, uint32_t end, const limn_value_output *output) {
    LIMNI_REQUIRE(plan && channel && values && output && begin <= end &&
                      end <= plan->patch_count, );
    if (begin == end) return;
    const limn_mesh *const mesh = &channel->mesh;
    LIMNI_REQUIRE(mesh->patch_count == plan->mesh->patch_count &&
                      mesh->domain == plan->mesh->domain &&
                      (unsigned)output->format <= LIMN_VALUE_RGBA8, );
    const limni_format format = value_format(output->format);
    LIMNI_REQUIRE(fits(output->values, output->stride, format), );
    limni_target target = {.vertices = output->values,
                           .stride = output->stride ? output->stride : size_of(format),
                           .format = format,
                           .streaming = output->streaming};
    const limni_points points = {.controls = values, .origin = mesh->origin};
    set_box(mesh, output->box, &target);
    evaluate(plan, mesh, &points, begin, end, &target);
}
