/* SPDX-License-Identifier: MIT */
#include "discrete.h"

#include "../bench.h"
#include "../peers/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef float point[3];

/// All patches at one level.
static void evaluate(const frame_actor *actor, uint32_t level, point *positions, point *normals) {
    const limn_plan plan = limn_plan_uniform(&actor->mix.mesh, level);
    const limn_output output = {
        .vertices = positions, .normals = normals, .control_normals = actor->mix.control_normals};
    limn_evaluate(&plan, actor->mix.mesh.controls, 0, plan.patch_count, &output);
}

static void fill_level(frame_discrete *levels, const frame_actor *actor, uint32_t level) {
    const limn_mesh *const mesh = &actor->mix.mesh;
    const peer_scene *const scene = &levels->scenes[level];
    const size_t row_total = (size_t)mesh->patch_count * scene->row_count;
    point *const positions = bench_allocate(row_total, sizeof *positions);
    point *const normals = bench_allocate(row_total, sizeof *normals);
    levels->positions[level] = bench_allocate(scene->unique_count, sizeof(point));
    levels->normals[level] = bench_allocate(scene->unique_count, sizeof(point));
    evaluate(actor, level, positions, normals);
    for (size_t at = 0; at < row_total; at++) {
        const uint32_t vertex = scene_vertex(scene, mesh, (uint32_t)(at / scene->row_count),
                                             (uint32_t)(at % scene->row_count));
        memcpy(levels->positions[level][vertex], positions[at], sizeof(point));
        memcpy(levels->normals[level][vertex], normals[at], sizeof(point));
    }
    free(positions);
    free(normals);
}

static float distance(const point a, const point b) {
    return hypotf(hypotf(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/// How far the rows of a patch at the finest level are from where the triangles of a level have
/// them: between the parents of each.
static float find_deviation(const limn_domain *domain, uint32_t level, const point *rows) {
    point drawn[(LIMN_GRID_SIZE + 1) * (LIMN_GRID_SIZE + 1)];
    const uint32_t kept = domain->row_counts[level];
    float largest = 0;
    memcpy(drawn, rows, kept * sizeof *drawn);
    for (uint32_t r = kept; r < domain->row_counts[LIMN_LEVEL_MAX]; r++) {
        const uint16_t *const parents = domain->rows[r].parents;
        for (int axis = 0; axis < 3; axis++)
            drawn[r][axis] = (drawn[parents[0]][axis] + drawn[parents[1]][axis]) / 2;
        largest = fmaxf(largest, distance(drawn[r], rows[r]));
    }
    return largest;
}

/// The mean square of the edges of all patches at level 0.
static float find_mean_square(const limn_domain *domain, uint32_t patch_count, const point *rows) {
    double sum = 0;
    for (uint32_t p = 0; p < patch_count; p++, rows += domain->row_counts[LIMN_LEVEL_MAX]) {
        for (uint32_t e = 0; e < domain->corner_count; e++) {
            const double length = (double)distance(rows[e], rows[(e + 1) % domain->corner_count]);
            sum += length * length;
        }
    }
    return (float)(sum / patch_count / domain->corner_count);
}

static void find_errors(frame_discrete *levels, const frame_actor *actor) {
    const limn_mesh *const mesh = &actor->mix.mesh;
    const uint32_t row_count = mesh->domain->row_counts[LIMN_LEVEL_MAX];
    point *const rows = bench_allocate((size_t)mesh->patch_count * row_count, sizeof *rows);
    double *const found = bench_allocate(mesh->patch_count, sizeof *found);
    evaluate(actor, LIMN_LEVEL_MAX, rows, NULL);
    const float square = find_mean_square(mesh->domain, mesh->patch_count, (const point *)rows);
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        for (uint32_t p = 0; p < mesh->patch_count; p++)
            found[p] = (double)find_deviation(mesh->domain, level,
                                              (const point *)rows + (size_t)p * row_count);
        levels->deviations[level] = (float)bench_percentile(found, mesh->patch_count, 0.99);
        levels->lengths[level] = sqrtf(square) / (float)(1 << level);
    }
    free(rows);
    free(found);
}

bool frame_discrete_create(frame_discrete *levels, const frame_actor *actor, uint32_t low,
                           uint32_t high) {
    *levels = (frame_discrete){.low = low, .high = high};
    for (uint32_t level = low; level <= high; level++) {
        if (!scene_create_baked(&levels->scenes[level], &actor->mix.mesh, level)) return false;
        fill_level(levels, actor, level);
    }
    find_errors(levels, actor);
    return true;
}

void frame_discrete_destroy(frame_discrete *levels) {
    for (uint32_t level = levels->low; level <= levels->high; level++) {
        scene_destroy(&levels->scenes[level]);
        free(levels->positions[level]);
        free(levels->normals[level]);
    }
}

uint32_t frame_discrete_choose(const frame_discrete *levels, const frame_crowd *crowd,
                               uint32_t instance) {
    const limn_lod_desc *const lod = &crowd->script->lod;
    const float *const sizes = lod->lod == LIMN_LOD_ERROR ? levels->deviations : levels->lengths;
    if (lod->lod == LIMN_LOD_UNIFORM) return levels->high;
    const float scale = frame_crowd_scale(crowd, instance);
    uint32_t level = levels->low;
    while (level < levels->high && sizes[level] * scale > lod->pixels)
        level++;
    return level;
}

uint32_t frame_discrete_finest(const frame_script *script) {
    return script->lod.lod == LIMN_LOD_UNIFORM ? (uint32_t)ceilf(script->lod.level)
                                               : LIMN_LEVEL_MAX;
}
