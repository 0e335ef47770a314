/* SPDX-License-Identifier: MIT */
#include "crowd.h"

#include "../peers/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static float part_of(double x) {
    return (float)(x - floor(x));
}

/// Of R2, the sequence of Roberts, which has low discrepancy.
static void place(frame_instance *to, const frame_script *script, uint32_t index) {
    if (script->area[0] <= 0 && script->area[1] <= 0) return;
    const double n = index + 1;
    to->place[0] = (part_of(0.7548776662466927 * n) - 0.5f) * script->area[0];
    to->place[2] = -part_of(0.5698402909980532 * n) * script->area[1];
    to->yaw = 6.2831853f * part_of(0.6180339887498949 * n);
    to->start = 7 * part_of(0.4142135623730951 * n);
}

frame_crowd frame_crowd_create(const frame_script *script, const frame_actor *actor,
                               uint32_t count) {
    frame_crowd crowd = {.script = script,
                         .actor = actor,
                         .count = count,
                         .instances = bench_allocate(count, sizeof *crowd.instances),
                         .visible = bench_allocate(count, sizeof *crowd.visible)};
    for (uint32_t i = 0; i < count; i++)
        place(&crowd.instances[i], script, i);
    return crowd;
}

void frame_crowd_destroy(frame_crowd *crowd) {
    free(crowd->instances);
    free(crowd->visible);
}

// -------------------------------------------------------------------------------------------------
// Spaces

static void turn(const float v[3], float angle, float out[3]) {
    const float c = cosf(angle), s = sinf(angle);
    out[0] = c * v[0] + s * v[2];
    out[1] = v[1];
    out[2] = c * v[2] - s * v[0];
}

/// From the scene into the space of an instance.
static void enter(const frame_actor *actor, const frame_instance *instance, const float point[3],
                  float out[3]) {
    float relative[3];
    for (int axis = 0; axis < 3; axis++)
        relative[axis] = actor->diagonal * (point[axis] - instance->place[axis]);
    turn(relative, -instance->yaw, out);
    for (int axis = 0; axis < 3; axis++)
        out[axis] += actor->middle[axis];
}

void frame_crowd_place(const frame_crowd *crowd, uint32_t instance, float *matrix) {
    const frame_actor *const actor = crowd->actor;
    const frame_instance *const where = &crowd->instances[instance];
    float middle[3];
    memset(matrix, 0, 16 * sizeof *matrix);
    for (int axis = 0; axis < 3; axis++) {
        const float unit[3] = {axis == 0, axis == 1, axis == 2};
        turn(unit, where->yaw, matrix + 4 * axis);
        for (int row = 0; row < 3; row++)
            matrix[4 * axis + row] /= actor->diagonal;
    }
    turn(actor->middle, where->yaw, middle);
    for (int row = 0; row < 3; row++)
        matrix[12 + row] = where->place[row] - middle[row] / actor->diagonal;
    matrix[15] = 1;
}

// -------------------------------------------------------------------------------------------------
// The camera

/// Straight from key to key.
static void find_camera(const frame_script *script, float time, float eye[3], float target[3]) {
    uint32_t next = 0;
    while (next + 1 < script->key_count && script->keys[next].time < time)
        next++;
    const frame_key *const b = &script->keys[next], *const a = next > 0 ? b - 1 : b;
    const float span = b->time - a->time;
    const float t = span > 0 ? fminf(fmaxf((time - a->time) / span, 0), 1) : 1;
    for (int axis = 0; axis < 3; axis++) {
        eye[axis] = a->eye[axis] + t * (b->eye[axis] - a->eye[axis]);
        target[axis] = a->target[axis] + t * (b->target[axis] - a->target[axis]);
    }
}

static bool is_visible(const frame_actor *actor, const limn_view *view) {
    const float radius = 0.75f * actor->diagonal;
    for (uint32_t p = 0; p < view->plane_count; p++) {
        const float *const plane = view->planes[p];
        float distance = plane[3], length = 0;
        for (int axis = 0; axis < 3; axis++) {
            distance += plane[axis] * actor->middle[axis];
            length += plane[axis] * plane[axis];
        }
        if (distance < -radius * sqrtf(length)) return false;
    }
    return true;
}

static void see(const frame_crowd *crowd, frame_instance *instance) {
    static const float up[3] = {0, 1, 0};
    const frame_actor *const actor = crowd->actor;
    const frame_script *const script = crowd->script;
    float from[3], to[3];
    enter(actor, instance, crowd->eye, from);
    enter(actor, instance, crowd->target, to);
    instance->view =
        limn_view_perspective(from, to, up, script->fov, script->viewport[0], script->viewport[1],
                              actor->diagonal / 100, actor->diagonal * 1000);
    instance->visible = is_visible(actor, &instance->view);
}

void frame_crowd_see(frame_crowd *crowd, uint32_t frame, uint32_t frame_count) {
    find_camera(crowd->script, (float)frame / (float)(frame_count > 1 ? frame_count - 1 : 1),
                crowd->eye, crowd->target);
    crowd->seconds = (float)frame / FRAME_RATE;
    crowd->visible_count = 0;
    for (uint32_t i = 0; i < crowd->count; i++) {
        see(crowd, &crowd->instances[i]);
        if (crowd->instances[i].visible) crowd->visible[crowd->visible_count++] = i;
    }
}

float frame_crowd_time(const frame_crowd *crowd, uint32_t instance) {
    return crowd->seconds + crowd->instances[instance].start;
}

limn_lighting frame_crowd_lighting(const frame_crowd *crowd, uint32_t instance,
                                   limn_light *lights) {
    const frame_actor *const actor = crowd->actor;
    const frame_script *const script = crowd->script;
    limn_lighting lighting = {.mode = script->light == FRAME_LIGHT_EXACT ? LIMN_LIGHT_EXACT
                                                                         : LIMN_LIGHT_INTERPOLATED,
                              .lights = lights,
                              .light_count = script->light_count};
    memcpy(lighting.ambient, script->ambient, sizeof lighting.ambient);
    for (uint32_t l = 0; l < script->light_count; l++) {
        lights[l] = script->lights[l];
        turn(script->lights[l].direction, -crowd->instances[instance].yaw, lights[l].direction);
        lights[l].range *= actor->diagonal;
        for (int axis = 0; axis < 3; axis++)
            lights[l].position[axis] =
                actor->middle[axis] + actor->diagonal * lights[l].position[axis];
    }
    return lighting;
}

float frame_crowd_scale(const frame_crowd *crowd, uint32_t instance) {
    const limn_view *const view = &crowd->instances[instance].view;
    float squares = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float way = crowd->actor->middle[axis] - view->eye[axis];
        squares += way * way;
    }
    return view->pixels / fmaxf(sqrtf(squares), view->nearest);
}
