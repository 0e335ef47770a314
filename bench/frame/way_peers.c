/* SPDX-License-Identifier: MIT */
/* Other evaluators of subdivision surfaces, at a level for each character. */
#include "discrete.h"

#include "../peers/allocate.h"
#include "../peers/peer.h"

#include <stdlib.h>
#include <string.h>

typedef struct state {
    frame_host host;
    frame_crowd *crowd;
    frame_discrete levels;
    peer_list peers[LIMN_LEVEL_COUNT]; ///< by level and thread
    frame_pose_memory *poses;          ///< by thread
    float (**controls)[3];             ///< [crowd->count] skinned
    uint8_t *chosen;                   ///< [crowd->count]
} state;

static void skin(void *state_, uint32_t part, uint32_t part_count) {
    state *const self = state_;
    const uint32_t count = self->crowd->visible_count;
    for (uint32_t v = team_share(count, part, part_count);
         v < team_share(count, part + 1, part_count); v++) {
        const uint32_t i = self->crowd->visible[v];
        const float seconds = frame_crowd_time(self->crowd, i);
        frame_actor_move(self->host.actor, seconds, &self->poses[part]);
        frame_actor_pose(self->host.actor, seconds, &self->poses[part], self->controls[i][0]);
    }
}

/// Into the peer's own memory, which one character after the other uses.
static void evaluate(void *state_, uint32_t part, uint32_t part_count) {
    state *const self = state_;
    const uint32_t count = self->crowd->visible_count;
    for (uint32_t v = team_share(count, part, part_count);
         v < team_share(count, part + 1, part_count); v++) {
        const uint32_t i = self->crowd->visible[v];
        const peer *const by = &self->peers[self->chosen[i]].peers[part];
        for (uint32_t c = 0; c < self->host.actor->mix.mesh.control_count; c++)
            memcpy(by->controls + (size_t)c * by->control_size, self->controls[i][c],
                   sizeof(float[3]));
        by->run(by->state);
    }
}

static void choose(state *self, frame_record *record) {
    for (uint32_t v = 0; v < self->crowd->visible_count; v++) {
        const uint32_t i = self->crowd->visible[v];
        const uint32_t level = frame_discrete_choose(&self->levels, self->crowd, i);
        const peer_scene *const scene = &self->levels.scenes[level];
        self->chosen[i] = (uint8_t)level;
        record->vertices += self->peers[level].peers[0].points == PEER_UNIQUE_POINTS
                                ? scene->unique_count
                                : (uint64_t)scene->patch_count * scene->row_count;
        record->triangles += (uint64_t)scene->patch_count * scene->domain->index_counts[level] / 3;
    }
    const uint32_t floats = 3 * self->peers[self->levels.high].peers[0].control_size;
    record->bytes = record->vertices * floats * sizeof(float);
}

static double time_pass(state *self, team_work *work) {
    const double start = self->host.clock();
    frame_host_run(&self->host, work, self);
    return self->host.clock() - start;
}

static void make(void *state_, frame_record *record) {
    state *const self = state_;
    const double start = self->host.clock();
    choose(self, record);
    record->seconds[FRAME_PLAN] += self->host.clock() - start;
    record->seconds[FRAME_SKIN] = time_pass(self, skin);
    record->seconds[FRAME_EVALUATE] = time_pass(self, evaluate);
    for (int stage = 0; stage < FRAME_STAGE_COUNT; stage++)
        record->total += record->seconds[stage];
}

static void set_crowd(void *state_, frame_crowd *crowd) {
    state *const self = state_;
    const limn_mesh *const mesh = &self->host.actor->mix.mesh;
    for (uint32_t i = 0; self->crowd && i < self->crowd->count; i++)
        free(self->controls[i]);
    free(self->controls);
    free(self->chosen);
    self->controls = NULL, self->chosen = NULL;
    self->crowd = crowd;
    if (!crowd) return;
    self->chosen = bench_allocate(crowd->count, sizeof *self->chosen);
    self->controls = bench_allocate(crowd->count, sizeof *self->controls);
    for (uint32_t i = 0; i < crowd->count; i++) {
        self->controls[i] = bench_allocate(mesh->control_count + 1u, sizeof(float[3]));
        memcpy(self->controls[i], mesh->controls, mesh->control_count * sizeof(float[3]));
    }
}

static void destroy(void *state_) {
    state *const self = state_;
    set_crowd(self, NULL);
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++) {
        for (uint32_t p = 0; p < self->peers[level].count; p++)
            self->peers[level].peers[p].destroy(self->peers[level].peers[p].state);
    }
    frame_host_free_poses(&self->host, self->poses);
    frame_discrete_destroy(&self->levels);
    free(self);
}

/// Tables are of a level each; what Bfr has serves them all.
static bool create_peers(state *self, peers_add_copies *add, uint64_t *bytes) {
    for (uint32_t level = self->levels.low; level <= self->levels.high; level++) {
        if (!add(&self->peers[level], &self->levels.scenes[level], frame_host_threads(&self->host)))
            return false;
        const uint64_t own = self->peers[level].peers[0].byte_count;
        *bytes = add == peers_add_bfr_copies ? own : *bytes + own;
    }
    return true;
}

static bool add_peers(frame_ways *ways, const frame_host *host, const char *name,
                      peers_add_copies *add) {
    state *const self = bench_allocate(1, sizeof *self);
    const uint32_t finest = frame_discrete_finest(host->script);
    const bool uniform = host->script->lod.lod == LIMN_LOD_UNIFORM;
    self->host = *host;
    self->poses = frame_host_create_poses(host);
    frame_way *const added = frame_ways_append(ways);
    *added = (frame_way){.name = name,
                         .instance_bytes =
                             (uint64_t)host->actor->mix.mesh.control_count * sizeof(float[3]),
                         .state = self,
                         .set_crowd = set_crowd,
                         .make = make,
                         .destroy = destroy};
    return frame_discrete_create(&self->levels, host->actor, uniform ? finest : 0, finest) &&
           create_peers(self, add, &added->shared_bytes);
}

bool frame_ways_add_stencils(frame_ways *ways, const frame_host *host) {
    return add_peers(ways, host, "stencils", peers_add_stencil_copies);
}

bool frame_ways_add_bfr(frame_ways *ways, const frame_host *host) {
    return add_peers(ways, host, "bfr", peers_add_bfr_copies);
}
