/* SPDX-License-Identifier: MIT */
/* Limn, and its surfaces are drawn: what limn-view does in a frame, with its renderer. Vertices are
 * limn-view's, too, written straight into the buffer that is drawn. */
#include "way_drawn.h"

#include "../../viewer/context.h"
#include "../../viewer/renderer.h"
#include "../../viewer/report.h"
#include "../../viewer/target.h"
#include "../peers/allocate.h"

#include <stdlib.h>
#include <string.h>

const char view_program_name[] = "limn-bench";

/// What is kept of a character.
typedef struct body {
    float *controls, *normals;
    void *memory; ///< of the plan
    float place[16];
} body;

typedef struct state {
    frame_host host;
    frame_crowd *crowd;
    body *bodies;           ///< [crowd->count]
    view_surface *surfaces; ///< [crowd->count]
    frame_pose_memory pose;
    view_templates templates[LIMN_DOMAIN_COUNT];
    view_albedo albedo; ///< none
    view_context *context;
    view_gl gl;
    view_target target;
    view_frame frame; ///< how it is drawn
    view_renderer *renderer;
} state;

// -------------------------------------------------------------------------------------------------
// A frame

static void pose(const state *self, uint32_t i, frame_record *record) {
    const limn_mesh *const mesh = &self->host.actor->mix.mesh;
    const body *const b = &self->bodies[i];
    const float seconds = frame_crowd_time(self->crowd, i);
    const double start = self->host.clock();
    frame_pose_memory memory = self->pose;
    frame_actor_move(self->host.actor, seconds, &memory);
    frame_actor_pose(self->host.actor, seconds, &memory, b->controls);
    const double posed = self->host.clock();
    limn_mesh_refine(mesh, b->controls);
    const double refined = self->host.clock();
    limn_mesh_control_normals(mesh, b->controls, b->normals);
    record->seconds[FRAME_SKIN] += posed - start;
    record->seconds[FRAME_REFINE] += refined - posed;
    record->seconds[FRAME_NORMALS] += self->host.clock() - refined;
}

/// Those out of view have no patches.
static void plan(state *self, frame_record *record) {
    const limn_mesh *const mesh = &self->host.actor->mix.mesh;
    const double start = self->host.clock();
    for (uint32_t i = 0; i < self->crowd->count; i++) {
        view_surface *const surface = &self->surfaces[i];
        surface->plan = (limn_plan){.mesh = mesh};
        if (!self->crowd->instances[i].visible) continue;
        const body *const b = &self->bodies[i];
        surface->plan = limn_plan_build(mesh, b->controls, &self->crowd->instances[i].view, 1,
                                        &self->host.script->lod,
                                        self->templates[mesh->domain->kind].templates, b->memory);
        surface->first_vertex = (uint32_t)record->vertices;
        record->vertices += surface->plan.vertex_count;
        record->triangles += surface->plan.index_count / 3;
    }
    record->seconds[FRAME_PLAN] += self->host.clock() - start;
    record->bytes = record->vertices * sizeof(view_vertex);
}

static void evaluate(const state *self, uint32_t i, view_vertex *vertices) {
    const frame_script *const script = self->host.script;
    const body *const b = &self->bodies[i];
    const view_surface *const surface = &self->surfaces[i];
    view_vertex *const first = vertices + surface->first_vertex;
    limn_light lights[FRAME_LIGHT_MAX];
    const limn_lighting lighting = frame_crowd_lighting(self->crowd, i, lights);
    const limn_output output = {.vertices = first->position,
                                .stride = sizeof *first,
                                .normals = first->normal,
                                .normal_stride = sizeof *first,
                                .control_normals = b->normals,
                                .lighting = &lighting,
                                .colours = script->light != FRAME_LIGHT_NONE ? first->light : NULL,
                                .colour_stride = sizeof *first};
    limn_evaluate(&surface->plan, b->controls, 0, surface->plan.patch_count, &output);
    view_vertices_describe(surface, 0, surface->plan.patch_count, first);
}

static void aim(state *self) {
    const frame_script *const script = self->host.script;
    limni_camera camera = {
        .up = {0, 1, 0}, .fov = script->fov, .near_plane = 0.01f, .far_plane = 1000};
    memcpy(camera.eye, self->crowd->eye, sizeof camera.eye);
    memcpy(camera.target, self->crowd->target, sizeof camera.target);
    limni_camera_orient(&camera);
    self->frame.camera =
        view_camera_matrices(&camera, (double)self->frame.width / self->frame.height);
}

static bool draw(state *self, frame_record *record) {
    view_vertex *const vertices = view_renderer_map(self->renderer, record->vertices);
    if (!vertices) return false;
    const double start = self->host.clock();
    for (uint32_t v = 0; v < self->crowd->visible_count; v++)
        evaluate(self, self->crowd->visible[v], vertices);
    const double evaluated = self->host.clock();
    aim(self);
    const bool good = view_renderer_draw(self->renderer, &self->frame);
    self->gl.Finish();
    record->seconds[FRAME_EVALUATE] = evaluated - start;
    record->seconds[FRAME_DRAW] = self->host.clock() - evaluated;
    return good;
}

static void make(void *state_, frame_record *record) {
    state *const self = state_;
    for (uint32_t v = 0; v < self->crowd->visible_count && self->host.actor->moves; v++)
        pose(self, self->crowd->visible[v], record);
    plan(self, record);
    if (!draw(self, record)) exit(1); // after a message
    for (int stage = 0; stage < FRAME_STAGE_COUNT; stage++)
        record->total += record->seconds[stage];
}

// -------------------------------------------------------------------------------------------------
// Preparation

static void create_body(const state *self, uint32_t i) {
    const frame_actor *const actor = self->host.actor;
    const limn_mesh *const mesh = &actor->mix.mesh;
    body *const b = &self->bodies[i];
    b->controls = bench_allocate(mesh->point_count + 1u, sizeof(float[3]));
    b->normals = bench_allocate(mesh->normal_count, sizeof(float[3]));
    b->memory = bench_allocate(1, limn_plan_size(mesh));
    memcpy(b->controls, mesh->controls, mesh->point_count * sizeof(float[3]));
    memcpy(b->normals, actor->mix.control_normals, mesh->normal_count * sizeof(float[3]));
    frame_crowd_place(self->crowd, i, b->place);
    self->surfaces[i] = (view_surface){.mesh = *mesh, .place = b->place};
}

static void free_bodies(state *self) {
    view_renderer_destroy(self->renderer);
    self->renderer = NULL;
    for (uint32_t i = 0; self->bodies && i < self->crowd->count; i++) {
        free(self->bodies[i].controls);
        free(self->bodies[i].normals);
        free(self->bodies[i].memory);
    }
    free(self->bodies);
    free(self->surfaces);
    self->bodies = NULL;
    self->surfaces = NULL;
}

static void set_crowd(void *state_, frame_crowd *crowd) {
    state *const self = state_;
    free_bodies(self);
    self->crowd = crowd;
    if (!crowd) return;
    self->bodies = bench_allocate(crowd->count, sizeof *self->bodies);
    self->surfaces = bench_allocate(crowd->count, sizeof *self->surfaces);
    for (uint32_t i = 0; i < crowd->count; i++)
        create_body(self, i);
    self->renderer = view_renderer_create(&self->gl, &(view_surfaces){.surfaces = self->surfaces,
                                                                      .count = crowd->count,
                                                                      .templates = self->templates,
                                                                      .albedo = &self->albedo});
    if (!self->renderer) exit(1); // after a message
}

static void destroy(void *state_) {
    state *const self = state_;
    free_bodies(self);
    view_target_destroy(&self->target);
    view_context_destroy(self->context);
    for (int domain = 0; domain < LIMN_DOMAIN_COUNT; domain++)
        view_templates_free(&self->templates[domain]);
    frame_pose_memory_destroy(&self->pose);
    free(self);
}

/// `fine`: for a picture to look at. NULL after a message.
static state *create(const frame_host *host, uint32_t width, uint32_t height, bool fine) {
    const limn_domain *const domain = host->actor->mix.mesh.domain;
    state *const self = bench_allocate(1, sizeof *self);
    *self = (state){.host = *host, .pose = frame_pose_memory_create(host->actor)};
    self->context = view_context_create();
    if (self->context && view_templates_make(&self->templates[domain->kind], domain) &&
        view_gl_load(&self->gl, view_context_function) &&
        view_target_create(&self->target, &self->gl, width, height, fine)) {
        self->frame = (view_frame){.width = self->target.width,
                                   .height = self->target.height,
                                   .pixel_scale = (float)self->target.pixel_scale *
                                                  view_line_scale(width, height),
                                   .vertex_light = host->script->light != FRAME_LIGHT_NONE};
        return self;
    }
    destroy(self);
    return NULL;
}

bool frame_ways_add_drawn(frame_ways *ways, const frame_host *host) {
    const limn_mesh *const mesh = &host->actor->mix.mesh;
    state *const self = create(host, (uint32_t)host->script->viewport[0],
                               (uint32_t)host->script->viewport[1], false);
    if (!self) return false;
    *frame_ways_append(ways) = (frame_way){
        .name = "drawn",
        .shared_bytes = host->actor->mix.pack.blob_size,
        .instance_bytes = (mesh->point_count + (uint64_t)mesh->normal_count) * sizeof(float[3]) +
                          limn_plan_size(mesh),
        .state = self,
        .set_crowd = set_crowd,
        .make = make,
        .destroy = destroy};
    return true;
}

bool frame_draw_picture(const frame_host *host, uint32_t frame, uint32_t frame_count,
                        uint32_t width, uint32_t height, const char *path) {
    state *const self = create(host, width, height, true);
    if (!self) return false;
    frame_crowd crowd = frame_crowd_create(host->script, host->actor, host->script->count);
    frame_record record = {0};
    view_image image = {0};
    self->frame.colours = VIEW_COLOURS_LEVELS;
    self->frame.vertex_light = false;
    self->frame.wireframe = true;
    set_crowd(self, &crowd);
    frame_crowd_see(&crowd, frame, frame_count);
    make(self, &record);
    const bool good = view_target_read(&self->target, &image) && view_image_write_png(&image, path);
    view_image_free(&image);
    destroy(self);
    frame_crowd_destroy(&crowd);
    return good;
}
