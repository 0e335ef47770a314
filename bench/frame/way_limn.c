/* SPDX-License-Identifier: MIT */
/* Limn: some characters at a time go through all stages, in memory that the next ones take over. Those
 * that level 0 is enough for are drawn as base meshes. */
#include "way.h"

#include "../peers/allocate.h"

#include <stdlib.h>
#include <string.h>

enum { WAVE = 16 }; ///< characters that are together in a stage, for each thread

/// A character of a wave.
typedef struct body {
    uint32_t instance;
    float *controls, *normals;
    void *memory; ///< of the plan
    limn_plan plan;
    bool is_base;                        ///< there is no plan
    uint64_t first_vertex, vertex_count; ///< in the frame
} body;

/// What is written of each vertex.
typedef struct form {
    bool packed, normals, lit;
} form;

/// What a thread needs.
typedef struct worker {
    frame_pose_memory pose;
    double seconds[FRAME_STAGE_COUNT]; ///< of its part of a frame, up to plans
} worker;

typedef struct state {
    frame_host host;
    frame_crowd *crowd;
    worker *workers; ///< by thread
    body *bodies;    ///< [WAVE] for each thread
    uint32_t count;  ///< of the wave
    limn_template *templates;
    limn_base base;
    void *base_memory;
    float box[2][3]; ///< of packed positions, and of what a character may be in
    frame_buffer output;
    uint64_t first_vertex, end_vertex; ///< of the wave
    form scene, now;
    bool splits;    ///< whether light and packing are timed
    uint32_t turns; ///< waves that were evaluated
} state;

// -------------------------------------------------------------------------------------------------
// Stages

typedef void stage_fn(const state *self, worker *w, body *b);

static void skin(const state *self, worker *w, body *b) {
    const float seconds = frame_crowd_time(self->crowd, b->instance);
    frame_actor_move(self->host.actor, seconds, &w->pose);
    frame_actor_pose(self->host.actor, seconds, &w->pose, b->controls);
}

static void refine(const state *self, worker *w, body *b) {
    (void)w;
    limn_mesh_refine(&self->host.actor->mix.mesh, b->controls);
}

static void find_normals(const state *self, worker *w, body *b) {
    (void)w;
    limn_mesh_control_normals(&self->host.actor->mix.mesh, b->controls, b->normals);
}

static void plan(const state *self, worker *w, body *b) {
    (void)w;
    const limn_lod_desc *const lod = &self->host.script->lod;
    const limn_view *const view = &self->crowd->instances[b->instance].view;
    b->is_base = limn_base_suffices(&self->base, self->box[0], view, 1, lod);
    b->plan = (limn_plan){0};
    if (!b->is_base)
        b->plan = limn_plan_build(&self->host.actor->mix.mesh, b->controls, view, 1, lod,
                                  self->templates, b->memory);
}

/// Of bodies [begin, end).
static void time_stage(const state *self, worker *w, frame_stage stage, stage_fn *run,
                       uint32_t begin, uint32_t end) {
    const double start = self->host.clock();
    for (uint32_t i = begin; i < end; i++)
        run(self, w, &self->bodies[i]);
    w->seconds[stage] += self->host.clock() - start;
}

/// Each character by one thread.
static void prepare(void *state_, uint32_t part, uint32_t part_count) {
    const state *const self = state_;
    const limn_mesh *const mesh = &self->host.actor->mix.mesh;
    worker *const w = &self->workers[part];
    const uint32_t begin = team_share(self->count, part, part_count);
    const uint32_t end = team_share(self->count, part + 1, part_count);
    if (self->host.actor->moves) {
        time_stage(self, w, FRAME_SKIN, skin, begin, end);
        if (mesh->point_count > mesh->control_count)
            time_stage(self, w, FRAME_REFINE, refine, begin, end);
        time_stage(self, w, FRAME_NORMALS, find_normals, begin, end);
    }
    time_stage(self, w, FRAME_PLAN, plan, begin, end);
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

/// Those vertices of a character that are in [begin, end) of the frame, or the patches that begin
/// there.
static void evaluate_body(const state *self, const body *b, uint64_t begin, uint64_t end) {
    const uint64_t first = b->first_vertex, behind = first + b->vertex_count;
    if (behind <= begin || first >= end) return;
    limn_light lights[FRAME_LIGHT_MAX];
    limn_lighting lighting = {0};
    if (self->now.lit) lighting = frame_crowd_lighting(self->crowd, b->instance, lights);
    const limn_output output = output_of(self, b, &lighting);
    const uint64_t from = begin > first ? begin - first : 0;
    const uint64_t to = (end < behind ? end : behind) - first;
    if (b->is_base) {
        limn_base_evaluate(&self->base, b->controls, (uint32_t)from, (uint32_t)to, &output);
    } else {
        limn_evaluate(&b->plan, b->controls, find_patch(&b->plan, from), find_patch(&b->plan, to),
                      &output);
    }
}

/// Parts have as many vertices each, whosever they are.
static void evaluate(void *state_, uint32_t part, uint32_t part_count) {
    const state *const self = state_;
    const uint64_t count = self->end_vertex - self->first_vertex;
    const uint64_t begin = self->first_vertex + count * part / part_count;
    const uint64_t end = self->first_vertex + count * (part + 1) / part_count;
    for (uint32_t i = 0; i < self->count; i++)
        evaluate_body(self, &self->bodies[i], begin, end);
}

// -------------------------------------------------------------------------------------------------
// A frame

static double time_form(state *self, form f) {
    const double start = self->host.clock();
    self->now = f;
    frame_host_run(&self->host, evaluate, self);
    return self->host.clock() - start;
}

/// The frame's own evaluation, and it again without packing and without light, of which another one
/// begins each time. Returns what the other two took.
static double time_evaluation(state *self, frame_record *record) {
    enum { OWN, LIT, PLAIN, FORM_COUNT };
    const form forms[FORM_COUNT] = {self->scene,
                                    {false, self->scene.normals, self->scene.lit},
                                    {false, self->scene.normals, false}};
    double seconds[FORM_COUNT], *const stages = record->seconds;
    if (!self->splits) {
        stages[FRAME_EVALUATE] += time_form(self, self->scene);
        return 0;
    }
    for (uint32_t f = 0; f < FORM_COUNT; f++) {
        const uint32_t which = (self->turns + f) % FORM_COUNT;
        seconds[which] = time_form(self, forms[which]);
    }
    self->turns++;
    const double unwanted = seconds[LIT] + seconds[PLAIN];
    if (!self->scene.packed) seconds[LIT] = seconds[OWN];
    if (!self->scene.lit) seconds[PLAIN] = seconds[LIT];
    stages[FRAME_EVALUATE] += seconds[PLAIN];
    stages[FRAME_LIGHT] += seconds[LIT] - seconds[PLAIN];
    stages[FRAME_PACK] += seconds[OWN] - seconds[LIT];
    return unwanted;
}

static void count_patches(const limn_mesh *mesh, const body *b, frame_record *record) {
    if (b->is_base) record->patches[0] += mesh->patch_count;
    for (uint32_t p = 0; p < b->plan.patch_count; p++)
        record->patches[b->plan.patches ? b->plan.patches[p].level : b->plan.level]++;
}

/// Places the vertices of a wave behind those before.
static void place(state *self, frame_record *record) {
    self->first_vertex = record->vertices;
    for (uint32_t i = 0; i < self->count; i++) {
        body *const b = &self->bodies[i];
        b->first_vertex = record->vertices;
        b->vertex_count = b->is_base ? self->base.vertex_count : b->plan.vertex_count;
        record->vertices += b->vertex_count;
        record->triangles += (b->is_base ? self->base.index_count : b->plan.index_count) / 3;
        count_patches(&self->host.actor->mix.mesh, b, record);
    }
    self->end_vertex = record->vertices;
    frame_buffer_reserve(&self->output, record->vertices * vertex_size((form){false, true, true}));
}

/// Stages before evaluation take the mean of the threads.
static void add_stages(state *self, frame_record *record) {
    const uint32_t thread_count = frame_host_threads(&self->host);
    for (uint32_t t = 0; t < thread_count; t++) {
        for (int stage = 0; stage <= FRAME_PLAN; stage++)
            record->seconds[stage] += self->workers[t].seconds[stage] / thread_count;
        memset(self->workers[t].seconds, 0, sizeof self->workers[t].seconds);
    }
}

static uint32_t body_count(const state *self) {
    return WAVE * frame_host_threads(&self->host);
}

static void make(void *state_, frame_record *record) {
    state *const self = state_;
    const uint32_t room = body_count(self);
    const uint64_t all = (uint64_t)self->host.actor->mix.mesh.patch_count * self->crowd->count;
    const double seen = record->seconds[FRAME_PLAN], start = self->host.clock();
    double unwanted = 0;
    for (uint32_t first = 0; first < self->crowd->visible_count; first += room) {
        const uint32_t left = self->crowd->visible_count - first;
        self->count = left < room ? left : room;
        for (uint32_t i = 0; i < self->count; i++)
            self->bodies[i].instance = self->crowd->visible[first + i];
        frame_host_run(&self->host, prepare, self);
        place(self, record);
        unwanted += time_evaluation(self, record);
    }
    record->total = seen + self->host.clock() - start - unwanted;
    add_stages(self, record);
    record->culled = all;
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        record->culled -= record->patches[level];
    record->bytes = record->vertices * vertex_size(self->scene);
}

// -------------------------------------------------------------------------------------------------
// Preparation

static void create_body(const frame_actor *actor, body *b) {
    const limn_mesh *const mesh = &actor->mix.mesh;
    b->controls = bench_allocate(mesh->point_count + 1u, sizeof(float[3]));
    b->normals = bench_allocate(mesh->normal_count, sizeof(float[3]));
    b->memory = bench_allocate(1, limn_plan_size(mesh));
    memcpy(b->controls, mesh->controls, mesh->point_count * sizeof(float[3]));
    memcpy(b->normals, actor->mix.control_normals, mesh->normal_count * sizeof(float[3]));
}

static void create_wave(state *self) {
    self->bodies = bench_allocate(body_count(self), sizeof *self->bodies);
    for (uint32_t i = 0; i < body_count(self); i++)
        create_body(self->host.actor, &self->bodies[i]);
    self->workers = bench_allocate(frame_host_threads(&self->host), sizeof *self->workers);
    for (uint32_t t = 0; t < frame_host_threads(&self->host); t++)
        self->workers[t].pose = frame_pose_memory_create(self->host.actor);
}

static void set_crowd(void *state_, frame_crowd *crowd) {
    state *const self = state_;
    self->crowd = crowd;
}

static void destroy(void *state_) {
    state *const self = state_;
    for (uint32_t i = 0; i < body_count(self); i++) {
        free(self->bodies[i].controls);
        free(self->bodies[i].normals);
        free(self->bodies[i].memory);
    }
    for (uint32_t t = 0; t < frame_host_threads(&self->host); t++)
        frame_pose_memory_destroy(&self->workers[t].pose);
    free(self->bodies);
    free(self->workers);
    free(self->templates);
    free(self->base_memory);
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

static void create_base(state *self) {
    const bench_mix *const mix = &self->host.actor->mix;
    self->base_memory = bench_allocate(1, limn_base_size(&mix->mesh));
    self->base = limn_base_build(&mix->pack, &mix->mesh, self->base_memory);
}

static bool add_limn(frame_ways *ways, const frame_host *host, const char *name, form scene) {
    const limn_mesh *const mesh = &host->actor->mix.mesh;
    state *const self = bench_allocate(1, sizeof *self);
    self->host = *host;
    self->scene = scene;
    self->splits = self->scene.packed || self->scene.lit;
    self->templates = bench_allocate(limn_template_count(mesh->domain), sizeof *self->templates);
    limn_templates_write(mesh->domain, LIMN_TOPOLOGY_TRIANGLES, 2, NULL, self->templates);
    make_box(self);
    create_base(self);
    create_wave(self);
    *frame_ways_append(ways) =
        (frame_way){.name = name,
                    .shared_bytes = host->actor->mix.pack.blob_size + self->base.size,
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
