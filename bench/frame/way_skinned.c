/* SPDX-License-Identifier: MIT */
/* No subdivision in a frame: refined meshes, every vertex of them with bones and weights. One level,
 * or for each character one of all. */
#include "discrete.h"

#include "../peers/allocate.h"
#include "../peers/skin.h"

#include <stdlib.h>

typedef struct state {
    frame_host host;
    frame_crowd *crowd;
    frame_discrete levels;
    skin_mesh meshes[LIMN_LEVEL_COUNT];
    skin_fn *apply;
    frame_pose_memory *poses; ///< by thread
    uint8_t *chosen;          ///< [crowd->count]
    uint64_t *firsts;         ///< [crowd->count] the vertex that each begins with
    frame_buffer output;
} state;

enum { VERTEX_FLOATS = 6 };

/// Level, and place: with a vertex between characters, as skin_fn wants it. Returns the vertices that
/// there must be room for.
static uint64_t choose(state *self, frame_record *record) {
    uint64_t first = 0;
    for (uint32_t v = 0; v < self->crowd->visible_count; v++) {
        const uint32_t i = self->crowd->visible[v];
        const uint32_t level = frame_discrete_choose(&self->levels, self->crowd, i);
        const uint64_t count = self->meshes[level].count;
        self->chosen[i] = (uint8_t)level;
        self->firsts[i] = first;
        first += count + 1;
        record->vertices += count;
        record->triangles += (uint64_t)self->levels.scenes[level].patch_count *
                             self->levels.scenes[level].domain->index_counts[level] / 3;
    }
    record->bytes = record->vertices * VERTEX_FLOATS * sizeof(float);
    return first;
}

/// The bones are not those of the clip, of which there may be more: the time is the same.
static void skin(void *state_, uint32_t part, uint32_t part_count) {
    state *const self = state_;
    const uint32_t count = self->crowd->visible_count;
    for (uint32_t v = team_share(count, part, part_count);
         v < team_share(count, part + 1, part_count); v++) {
        const uint32_t i = self->crowd->visible[v], level = self->chosen[i];
        frame_actor_move(self->host.actor, frame_crowd_time(self->crowd, i), &self->poses[part]);
        self->apply(&self->meshes[level], (const scene_bone *)self->levels.scenes[level].bones,
                    (float *)(void *)self->output.bytes + self->firsts[i] * VERTEX_FLOATS);
    }
}

static void make(void *state_, frame_record *record) {
    state *const self = state_;
    const double start = self->host.clock();
    const uint64_t room = choose(self, record);
    record->seconds[FRAME_PLAN] += self->host.clock() - start;
    frame_buffer_reserve(&self->output, room * VERTEX_FLOATS * sizeof(float));
    const double chosen = self->host.clock();
    frame_host_run(&self->host, skin, self);
    record->seconds[FRAME_SKIN] = self->host.clock() - chosen;
    record->total = record->seconds[FRAME_PLAN] + record->seconds[FRAME_SKIN];
}

static void set_crowd(void *state_, frame_crowd *crowd) {
    state *const self = state_;
    free(self->chosen);
    free(self->firsts);
    self->chosen = NULL, self->firsts = NULL;
    self->crowd = crowd;
    if (!crowd) return;
    self->chosen = bench_allocate(crowd->count, sizeof *self->chosen);
    self->firsts = bench_allocate(crowd->count, sizeof *self->firsts);
}

static void destroy(void *state_) {
    state *const self = state_;
    set_crowd(self, NULL);
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++)
        skin_destroy(&self->meshes[level]);
    frame_host_free_poses(&self->host, self->poses);
    frame_discrete_destroy(&self->levels);
    free(self->output.bytes);
    free(self);
}

/// Vertices, and indices of two bytes where they are enough. Returns the bytes of all.
static uint64_t create_meshes(state *self) {
    uint64_t bytes = 0;
    for (uint32_t level = self->levels.low; level <= self->levels.high; level++) {
        const peer_scene *const scene = &self->levels.scenes[level];
        self->meshes[level] =
            skin_create((const float(*)[3])self->levels.positions[level],
                        (const float(*)[3])self->levels.normals[level], scene->unique_count);
        const uint64_t index_size = scene->unique_count > UINT16_MAX ? 4 : 2;
        bytes += self->meshes[level].byte_count +
                 (uint64_t)scene->patch_count * scene->domain->index_counts[level] * index_size;
    }
    return bytes;
}

static bool add_skinned(frame_ways *ways, const frame_host *host, bool discrete) {
    state *const self = bench_allocate(1, sizeof *self);
    const char *isa;
    const uint32_t finest = frame_discrete_finest(host->script);
    self->host = *host;
    self->apply = skin_select(LIMN_ISA_ALL, &isa);
    self->poses = frame_host_create_poses(host);
    frame_way *const added = frame_ways_append(ways);
    *added = (frame_way){.name = discrete ? "discrete" : "dense",
                         .state = self,
                         .set_crowd = set_crowd,
                         .make = make,
                         .destroy = destroy};
    if (!frame_discrete_create(&self->levels, host->actor, discrete ? 0 : finest, finest))
        return false;
    added->shared_bytes = create_meshes(self);
    return true;
}

bool frame_ways_add_dense(frame_ways *ways, const frame_host *host) {
    return add_skinned(ways, host, false);
}

/// Where all levels are one, that is the dense mesh.
bool frame_ways_add_discrete(frame_ways *ways, const frame_host *host) {
    return host->script->lod.lod == LIMN_LOD_UNIFORM || add_skinned(ways, host, true);
}
