/* SPDX-License-Identifier: MIT */
#include "frames.h"

#include "peers/allocate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CROWD_SIDE = 8 };

static bench_frame make_frame(const bench_mix *mix, const char *name, uint32_t count) {
    bench_frame frame = {.mix = mix, .instance_count = count};
    snprintf(frame.name, sizeof frame.name, "%s", name);
    frame.plans = bench_allocate(count, sizeof *frame.plans);
    return frame;
}

static void add_planning(bench_frame *frame, const limn_lod_desc *desc) {
    const uint32_t count = frame->instance_count;
    frame->is_planned = true;
    frame->desc = *desc;
    frame->views = bench_allocate(count, sizeof *frame->views);
    frame->memory = bench_allocate(count, sizeof *frame->memory);
    for (uint32_t i = 0; i < count; i++)
        frame->memory[i] = bench_allocate(1, limn_plan_size(&frame->mix->mesh));
}

void bench_frame_destroy(bench_frame *frame) {
    for (uint32_t i = 0; i < frame->instance_count && frame->memory; i++)
        free(frame->memory[i]);
    free(frame->memory);
    free(frame->views);
    free(frame->plans);
}

static float find_diagonal(const limn_mesh *mesh) {
    float diagonal = 0;
    for (int axis = 0; axis < 3; axis++)
        diagonal = hypotf(diagonal, mesh->bounds_max[axis] - mesh->bounds_min[axis]);
    return diagonal;
}

/// A view of a mesh, with eye and target in diagonals of its bounds, from their middle.
static limn_view make_view(const limn_mesh *mesh, const float eye[3], const float target[3]) {
    static const float up[3] = {0, 1, 0};
    const float diagonal = find_diagonal(mesh);
    float from[3], to[3];
    for (int axis = 0; axis < 3; axis++) {
        const float middle = (mesh->bounds_min[axis] + mesh->bounds_max[axis]) / 2;
        from[axis] = middle + eye[axis] * diagonal;
        to[axis] = middle + target[axis] * diagonal;
    }
    return limn_view_perspective(from, to, up, 0.698f, 1280, 720, diagonal / 1000, diagonal * 100);
}

bench_frame bench_frame_uniform(const bench_mix *mix, uint32_t level) {
    char name[16];
    snprintf(name, sizeof name, "level %u", level);
    bench_frame frame = make_frame(mix, name, 1);
    frame.plans[0] = limn_plan_uniform(&mix->mesh, level);
    return frame;
}

bench_frame bench_frame_near(const bench_mix *mix, const bench_lod *lod, float pixels, bool culls) {
    static const float eye[3] = {0.5f, 0.3f, 0.8f}, target[3] = {0.2f, 0.2f, 0};
    char name[32];
    snprintf(name, sizeof name, "%s%s", lod->name, culls ? ", culled" : "");
    bench_frame frame = make_frame(mix, name, 1);
    limn_lod_desc desc = lod->desc;
    desc.pixels = pixels;
    add_planning(&frame, &desc);
    frame.views[0] = make_view(&mix->mesh, eye, target);
    if (!culls) frame.views[0].plane_count = 0;
    return frame;
}

bench_frame bench_frame_crowd(const bench_mix *mix, float pixels, bool no_morph) {
    const limn_lod_desc desc = {.pixels = pixels, .no_morph = no_morph};
    bench_frame frame =
        make_frame(mix, no_morph ? "crowd, no morph" : "crowd", CROWD_SIDE * CROWD_SIDE);
    add_planning(&frame, &desc);
    for (uint32_t i = 0; i < frame.instance_count; i++) {
        const float x = (float)(i % CROWD_SIDE) - (CROWD_SIDE - 1) / 2.0f;
        const float z = -(float)(i / CROWD_SIDE); // the camera moves by the opposite
        const float eye[3] = {-x, 0.8f, 1.5f - z}, target[3] = {-x, 0, -2 - z};
        frame.views[i] = make_view(&mix->mesh, eye, target);
    }
    return frame;
}

void bench_frame_plan(const bench_frame *frame) {
    const limn_mesh *const mesh = &frame->mix->mesh;
    for (uint32_t i = 0; i < frame->instance_count && frame->is_planned; i++)
        frame->plans[i] = limn_plan_build(mesh, mesh->controls, &frame->views[i], 1, &frame->desc,
                                          NULL, frame->memory[i]);
}

uint64_t bench_frame_faces(const bench_frame *frame) {
    return (uint64_t)frame->mix->mesh.patch_count * frame->instance_count;
}

uint64_t bench_frame_patches(const bench_frame *frame) {
    uint64_t count = 0;
    for (uint32_t i = 0; i < frame->instance_count; i++)
        count += frame->plans[i].patch_count;
    return count;
}

uint64_t bench_frame_vertices(const bench_frame *frame) {
    uint64_t count = 0;
    for (uint32_t i = 0; i < frame->instance_count; i++)
        count += frame->plans[i].vertex_count;
    return count;
}

double bench_frame_level(const bench_frame *frame) {
    double sum = 0;
    for (uint32_t i = 0; i < frame->instance_count; i++) {
        const limn_plan *const plan = &frame->plans[i];
        for (uint32_t p = 0; p < plan->patch_count; p++)
            sum += plan->patches ? plan->patches[p].level : plan->level;
    }
    return sum / (double)bench_frame_patches(frame);
}
