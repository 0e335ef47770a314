/* SPDX-License-Identifier: MIT */
/* Limn: a pass over all characters in view for each stage. */
#include "way.h"

#include "../peers/allocate.h"

#include <stdlib.h>
#include <string.h>

/// What is kept of a character.
typedef struct body {
    float *controls, *normals;
    void *memory; ///< of the plan
    limn_plan plan;
    uint64_t first_vertex; ///< in the frame
} body;

/// What is written of each vertex.
typedef struct form {
    bool packed, normals, lit;
} form;

typedef struct state state;

/// What a stage before evaluation does with a character.
typedef void step_fn(const state *self, uint32_t instance, uint32_t thread);

struct state {
    frame_host host;
    frame_crowd *crowd;
    body *bodies;             ///< [crowd->count]
    frame_pose_memory *poses; ///< by thread
    limn_template *templates;
    float box[2][3]; ///< of packed positions
    frame_buffer output;
    uint64_t vertex_count; ///< of the frame
    form scene, now;
    step_fn *step;  ///< of the pass
    bool splits;    ///< whether light and packing are timed
    uint32_t turns; ///< frames that were made
};

// -------------------------------------------------------------------------------------------------
// Stages

static void skin(const state *self, uint32_t i, uint32_t thread) {
    const float seconds = frame_crowd_time(self->crowd, i);
    frame_actor_move(self->host.actor, seconds, &self->poses[thread]);
    frame_actor_pose(self->host.actor, seconds, &self->poses[thread], self->bodies[i].controls);
}

static void refine(const state *self, uint32_t i, uint32_t thread) {
    (void)thread;
    limn_mesh_refine(&self->host.actor->mix.mesh, self->bodies[i].controls);
}

static void find_normals(const state *self, uint32_t i, uint32_t thread) {
    (void)thread;
    limn_mesh_control_normals(&self->host.actor->mix.mesh, self->bodies[i].controls,
                              self->bodies[i].normals);
}

static void plan(const state *self, uint32_t i, uint32_t thread) {
    (void)thread;
    body *const b = &self->bodies[i];
    b->plan =
        limn_plan_build(&self->host.actor->mix.mesh, b->controls, &self->crowd->instances[i].view,
                        1, &self->host.script->lod, self->templates, b->memory);
}

/// A part of the characters in view.
static void run_step(void *state_, uint32_t part, uint32_t part_count) {
    const state *const self = state_;
    const uint32_t count = self->crowd->visible_count;
    for (uint32_t v = team_share(count, part, part_count);
         v < team_share(count, part + 1, part_count); v++)
        self->step(self, self->crowd->visible[v], part);
}

/// The first patch of a plan that begins at a vertex or behind it.
static uint32_t find_patch(const limn_plan *plan, uint64_t vertex) {
    uint32_t low = 0, high = plan->patch_count;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (limn_plan_first_vertex(plan, middle) < vertex)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static uint32_t vertex_size(form f) {
    return (f.packed ? 8u : 12u) + (f.normals ? (f.packed ? 4u : 12u) : 0u) + (f.lit ? 4u : 0u);
}

static limn_output output_of(const state *self, const body *b, const limn_lighting *lighting) {
    const form f = self->now;
    const uint32_t stride = vertex_size(f);
    unsigned char *const first = self->output.bytes + b->first_vertex * stride;
    return (limn_output){.vertices = first,
                         .stride = stride,
                         .position_format =
                             f.packed ? LIMN_POSITION_UNORM16X4 : LIMN_POSITION_FLOAT3,
                         .box = self->box[0],
                         .normals = f.normals ? first + (f.packed ? 8 : 12) : NULL,
                         .normal_stride = stride,
                         .normal_format = f.packed ? LIMN_NORMAL_OCT16X2 : LIMN_NORMAL_FLOAT3,
                         .colours = f.lit ? first + stride - 4 : NULL,
                         .colour_stride = stride,
                         .lighting = lighting,
                         .control_normals = b->normals};
}

/// Those patches of a character that begin in vertices [begin, end) of the frame.
static void evaluate_body(const state *self, uint32_t i, uint64_t begin, uint64_t end) {
    const body *const b = &self->bodies[i];
    const uint64_t first = b->first_vertex;
    if (first + b->plan.vertex_count <= begin || first >= end) return;
    const frame_script *const script = self->host.script;
    limn_light lights[FRAME_LIGHT_MAX];
    limn_lighting lighting = {.mode = script->light == FRAME_LIGHT_EXACT ? LIMN_LIGHT_EXACT
                                                                         : LIMN_LIGHT_INTERPOLATED,
                              .lights = lights,
                              .light_count = script->light_count};
    memcpy(lighting.ambient, script->ambient, sizeof lighting.ambient);
    if (self->now.lit) frame_crowd_lights(self->crowd, i, lights);
    const limn_output output = output_of(self, b, &lighting);
    limn_evaluate(&b->plan, b->controls, find_patch(&b->plan, begin > first ? begin - first : 0),
                  find_patch(&b->plan, end - first), &output);
}

/// Parts have as many vertices each, whosever they are.
static void evaluate(void *state_, uint32_t part, uint32_t part_count) {
    const state *const self = state_;
    const uint64_t begin = self->vertex_count * part / part_count;
    const uint64_t end = self->vertex_count * (part + 1) / part_count;
    for (uint32_t v = 0; v < self->crowd->visible_count; v++)
        evaluate_body(self, self->crowd->visible[v], begin, end);
}

// -------------------------------------------------------------------------------------------------
// A frame

static double time_pass(state *self, team_work *work) {
    const double start = self->host.clock();
    frame_host_run(&self->host, work, self);
    return self->host.clock() - start;
}

static double time_step(state *self, step_fn *step) {
    self->step = step;
    return time_pass(self, run_step);
}

static void time_preparation(state *self, frame_record *record) {
    const limn_mesh *const mesh = &self->host.actor->mix.mesh;
    if (self->host.actor->moves) {
        record->seconds[FRAME_SKIN] = time_step(self, skin);
        if (mesh->point_count > mesh->control_count)
            record->seconds[FRAME_REFINE] = time_step(self, refine);
        record->seconds[FRAME_NORMALS] = time_step(self, find_normals);
    }
    record->seconds[FRAME_PLAN] += time_step(self, plan);
}

static void count(state *self, frame_record *record) {
    const uint64_t all = (uint64_t)self->host.actor->mix.mesh.patch_count * self->crowd->count;
    uint64_t drawn = 0;
    for (uint32_t v = 0; v < self->crowd->visible_count; v++) {
        body *const b = &self->bodies[self->crowd->visible[v]];
        b->first_vertex = record->vertices;
        record->vertices += b->plan.vertex_count;
        record->triangles += b->plan.index_count / 3;
        drawn += b->plan.patch_count;
        for (uint32_t p = 0; p < b->plan.patch_count; p++)
            record->patches[b->plan.patches ? b->plan.patches[p].level : b->plan.level]++;
    }
    self->vertex_count = record->vertices;
    record->culled = all - drawn;
    record->bytes = record->vertices * vertex_size(self->scene);
}

static double time_form(state *self, form f) {
    self->now = f;
    return time_pass(self, evaluate);
}

/// The frame's own evaluation, and it again without packing and without light, of which another one
/// begins in each frame. Returns what the first took.
static double time_evaluation(state *self, frame_record *record) {
    enum { OWN, LIT, PLAIN, FORM_COUNT };
    const form forms[FORM_COUNT] = {self->scene,
                                    {false, self->scene.normals, self->scene.lit},
                                    {false, self->scene.normals, false}};
    double seconds[FORM_COUNT];
    if (!self->splits) return record->seconds[FRAME_EVALUATE] = time_form(self, self->scene);
    for (uint32_t f = 0; f < FORM_COUNT; f++) {
        const uint32_t which = (self->turns + f) % FORM_COUNT;
        seconds[which] = time_form(self, forms[which]);
    }
    if (!self->scene.packed) seconds[LIT] = seconds[OWN];
    if (!self->scene.lit) seconds[PLAIN] = seconds[LIT];
    record->seconds[FRAME_EVALUATE] = seconds[PLAIN];
    record->seconds[FRAME_LIGHT] = seconds[LIT] - seconds[PLAIN];
    record->seconds[FRAME_PACK] = seconds[OWN] - seconds[LIT];
    return seconds[OWN];
}

static void make(void *state_, frame_record *record) {
    state *const self = state_;
    time_preparation(self, record);
    count(self, record);
    frame_buffer_reserve(&self->output, record->vertices * vertex_size((form){false, true, true}));
    record->total = time_evaluation(self, record);
    self->turns++;
    for (int stage = 0; stage <= FRAME_PLAN; stage++)
        record->total += record->seconds[stage];
}

// -------------------------------------------------------------------------------------------------
// Preparation

static void create_body(const state *self, body *b) {
    const frame_actor *const actor = self->host.actor;
    const limn_mesh *const mesh = &actor->mix.mesh;
    b->controls = bench_allocate(mesh->point_count + 1u, sizeof(float[3]));
    b->normals = bench_allocate(mesh->normal_count, sizeof(float[3]));
    b->memory = bench_allocate(1, limn_plan_size(mesh));
    memcpy(b->controls, mesh->controls, mesh->point_count * sizeof(float[3]));
    memcpy(b->normals, actor->mix.control_normals, mesh->normal_count * sizeof(float[3]));
}

static void free_bodies(state *self) {
    for (uint32_t i = 0; self->bodies && i < self->crowd->count; i++) {
        free(self->bodies[i].controls);
        free(self->bodies[i].normals);
        free(self->bodies[i].memory);
    }
    free(self->bodies);
    self->bodies = NULL;
}

static void set_crowd(void *state_, frame_crowd *crowd) {
    state *const self = state_;
    free_bodies(self);
    self->crowd = crowd;
    if (!crowd) return;
    self->bodies = bench_allocate(crowd->count, sizeof *self->bodies);
    for (uint32_t i = 0; i < crowd->count; i++)
        create_body(self, &self->bodies[i]);
}

static void destroy(void *state_) {
    state *const self = state_;
    free_bodies(self);
    frame_host_free_poses(&self->host, self->poses);
    free(self->templates);
    free(self->output.bytes);
    free(self);
}

/// Moving takes characters out of their bounds: on each side by half a diagonal.
static void make_box(state *self) {
    const frame_actor *const actor = self->host.actor;
    for (int axis = 0; axis < 3; axis++) {
        self->box[0][axis] = actor->mix.mesh.bounds_min[axis] - actor->diagonal / 2;
        self->box[1][axis] = actor->mix.mesh.bounds_max[axis] + actor->diagonal / 2;
    }
}

static bool add_limn(frame_ways *ways, const frame_host *host, const char *name, form scene) {
    const limn_mesh *const mesh = &host->actor->mix.mesh;
    state *const self = bench_allocate(1, sizeof *self);
    self->host = *host;
    self->scene = scene;
    self->splits = self->scene.packed || self->scene.lit;
    self->templates = bench_allocate(limn_template_count(mesh->domain), sizeof *self->templates);
    limn_templates_write(mesh->domain, LIMN_TOPOLOGY_TRIANGLES, 2, NULL, self->templates);
    self->poses = frame_host_create_poses(host);
    make_box(self);
    *frame_ways_append(ways) = (frame_way){
        .name = name,
        .shared_bytes = host->actor->mix.pack.blob_size,
        .instance_bytes = (mesh->point_count + (uint64_t)mesh->normal_count) * sizeof(float[3]) +
                          limn_plan_size(mesh),
        .state = self,
        .set_crowd = set_crowd,
        .make = make,
        .destroy = destroy};
    return true;
}

bool frame_ways_add_limn(frame_ways *ways, const frame_host *host) {
    return add_limn(ways, host, "limn",
                    (form){host->script->packed, host->script->normals,
                           host->script->light != FRAME_LIGHT_NONE});
}

bool frame_ways_add_floats(frame_ways *ways, const frame_host *host) {
    return add_limn(ways, host, "floats", (form){.normals = true});
}
