/* SPDX-License-Identifier: MIT */
/* Limn itself, from control points and from bones: with every kernel, each of `outputs`. */
#include "peer.h"

#include "../bench.h"
#include "allocate.h"
#include "skin.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct state {
    const peer_scene *scene;
    limn_pack pack;
    limn_mesh mesh;
    limn_plan plan;
    limn_output output;
    float (*points)[3];                ///< [point_count], and one float: control points first
    float (*control_normals)[3];       ///< [normal_count]; NULL: positions only
    uint32_t *patches;                 ///< [patch_count] Limn's patch of one of the scene
    uint16_t (*rows)[LIMN_CORNER_MAX]; ///< [row_count] its row, with that rotation
    skin_mesh skin;
    skin_fn *skin_controls;
} state;

/// What Limn can write so far. Adding PEER_POSITION_NORMAL here gives all peers with derivatives or
/// normals their ratio.
static const peer_output outputs[] = {PEER_POSITION, PEER_POSITION_NORMAL};

enum { OUTPUT_COUNT = sizeof outputs / sizeof *outputs };

static void set_output(state *self, peer_output output) {
    const size_t count = (size_t)self->plan.vertex_count;
    self->output = (limn_output){.stride = 3 * sizeof(float)};
    self->output.vertices = bench_allocate(count, self->output.stride);
    if (output == PEER_POSITION) return;
    self->control_normals = bench_allocate(self->mesh.normal_count, sizeof *self->control_normals);
    self->output.normals = bench_allocate(count, 3 * sizeof(float));
    self->output.control_normals = self->control_normals[0];
}

/// What a frame begins with: the points of level 1 of an isolated mesh, and the normals of corners.
static void prepare_points(state *self) {
    limn_mesh_refine(&self->mesh, self->points[0]);
    if (!self->control_normals) return;
    limn_mesh_control_normals(&self->mesh, self->points[0], self->control_normals[0]);
}

static void evaluate(void *self_state) {
    state *const self = self_state;
    prepare_points(self);
    limn_evaluate(&self->plan, self->points[0], 0, self->plan.patch_count, &self->output);
}

static void evaluate_part(void *self_state, uint32_t part, uint32_t part_count) {
    const state *const self = self_state;
    const uint32_t begin = team_share(self->plan.patch_count, part, part_count);
    const uint32_t end = team_share(self->plan.patch_count, part + 1, part_count);
    limn_evaluate(&self->plan, self->points[0], begin, end, &self->output);
}

static void evaluate_in_parts(void *self_state) {
    state *const self = self_state;
    prepare_points(self);
    team_run(self->scene->threads, evaluate_part, self);
}

static void skin_and_evaluate(void *self_state) {
    state *const self = self_state;
    self->skin_controls(&self->skin, (const scene_bone *)self->scene->bones, self->points[0]);
    evaluate(self);
}

static const float *position(const void *self_state, uint32_t scene_patch, uint32_t row) {
    const state *const self = self_state;
    const uint32_t patch = self->patches[scene_patch];
    const uint32_t rotation = limn_mesh_face(&self->mesh, patch).rotation;
    const size_t vertex =
        (size_t)limn_plan_first_vertex(&self->plan, patch) + self->rows[row][rotation];
    return (const float *)((const char *)self->output.vertices + vertex * self->output.stride);
}

static void destroy(void *self_state) {
    state *const self = self_state;
    free(self->patches);
    free(self->rows);
    free(self->output.vertices);
    free(self->output.normals);
    free(self->control_normals);
    free(self->points);
    skin_destroy(&self->skin);
    free(self);
}

/// A patch of the scene is one of Limn's faces.
static void find_rows(state *self) {
    const peer_scene *const scene = self->scene;
    self->rows = bench_allocate(scene->row_count, sizeof *self->rows);
    for (uint16_t r = 0; r < scene->row_count; r++) {
        for (uint32_t rotation = 0; rotation < scene->domain->corner_count; rotation++)
            self->rows[scene_row(scene, r, rotation)][rotation] = r;
    }
    self->patches = bench_allocate(scene->patch_count, sizeof *self->patches);
    for (uint32_t p = 0; p < self->mesh.patch_count; p++)
        self->patches[limn_mesh_face(&self->mesh, p).face] = p;
}

static void copy_controls(state *self) {
    const peer_scene *const scene = self->scene;
    self->points = bench_allocate((size_t)self->mesh.point_count + 1, sizeof *self->points);
    memcpy(self->points, scene->controls, scene->control_count * sizeof *scene->controls);
}

/// The median of some loads, as all of the file is read once.
static double time_load(const scene_baked *baked, limn_pack *pack) {
    enum { LOADS = 9 };
    double seconds[LOADS];
    for (int load = 0; load < LOADS; load++) {
        const double start = bench_seconds();
        if (limn_pack_open(pack, baked->blob, baked->blob_size) != LIMN_OK) exit(1);
        seconds[load] = bench_seconds() - start;
    }
    return 1e3 * bench_median(seconds, LOADS);
}

static peer *append(peer_list *list, const peer_scene *scene, const limn_kernels *kernels,
                    peer_output output) {
    state *const self = bench_allocate(1, sizeof *self);
    self->scene = scene;
    const scene_baked *const baked =
        output == PEER_POSITION ? &scene->baked : &scene->baked_with_normals;
    const double load_ms = time_load(baked, &self->pack);
    self->pack.kernels = kernels;
    self->mesh = limn_pack_mesh(&self->pack, 0);
    self->plan = limn_plan_uniform(&self->mesh, scene->level);
    copy_controls(self);
    set_output(self, output);
    find_rows(self);
    peer *const added = peer_append(list);
    *added = (peer){
        .name = "limn",
        .output = output,
        .points = PEER_PATCH_POINTS,
        .isa = limn_kernels_name(kernels),
        .family = limn_kernels_family(kernels) == LIMN_FAMILY_FAST ? "fast" : "reproducible",
        .threads = 1,
        .build_ms = baked->ms,
        .load_ms = load_ms,
        // All but the bind pose, which is an input of the others too.
        .byte_count = baked->blob_size - self->mesh.point_count * sizeof *self->points,
        .state = self,
        .run = evaluate,
        .position = position,
        .destroy = destroy,
    };
    return added;
}

static void append_threaded(peer_list *list, const peer_scene *scene, const limn_kernels *kernels,
                            peer_output output) {
    peer *const added = append(list, scene, kernels, output);
    added->threads = team_size(scene->threads);
    added->run = evaluate_in_parts;
    added->best_limn = true;
}

static void append_skinned(peer_list *list, const peer_scene *scene, const limn_kernels *kernels,
                           peer_output output) {
    peer *const added = append(list, scene, kernels, output);
    state *const self = added->state;
    added->name = "skin+limn";
    self->skin = skin_create((const float(*)[3])scene->controls, NULL, scene->control_count);
    const char *name;
    self->skin_controls = skin_select(LIMN_ISA_ALL, &name);
    added->byte_count += self->skin.byte_count;
    added->skinned = true;
    added->best_limn = true;
    added->run = skin_and_evaluate;
}

static void append_kernels(peer_list *list, const peer_scene *scene, uint32_t isa,
                           limn_family family, peer_output output) {
    const limn_kernels *const kernels = limn_kernels_select(isa, family);
    if (limn_kernels_family(kernels) != family) return;
    peer *const added = append(list, scene, kernels, output);
    added->best_limn = kernels == limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_FAST);
}

/// Whether Limn numbers its faces as the scene its patches.
static bool has_same_patches(const peer_scene *scene) {
    limn_pack pack;
    if (limn_pack_open(&pack, scene->baked.blob, scene->baked.blob_size) != LIMN_OK) return false;
    const limn_mesh mesh = limn_pack_mesh(&pack, 0);
    if (mesh.patch_count == scene->patch_count && mesh.domain == scene->domain) return true;
    fprintf(stderr, "limn-bench: %s: Limn has other patches than its peers\n", scene->name);
    return false;
}

bool peers_add_limn(peer_list *list, const peer_scene *scene) {
    if (!has_same_patches(scene)) return false;
    const limn_kernels *const best = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_FAST);
    for (int o = 0; o < OUTPUT_COUNT; o++) {
        for (uint32_t isa = LIMN_ISA_SCALAR; isa <= LIMN_ISA_NEON; isa *= 2) {
            if (!(isa & limn_isa_supported())) continue;
            append_kernels(list, scene, isa, LIMN_FAMILY_REPRODUCIBLE, outputs[o]);
            append_kernels(list, scene, isa, LIMN_FAMILY_FAST, outputs[o]);
        }
        if (scene->threads) append_threaded(list, scene, best, outputs[o]);
        append_skinned(list, scene, best, outputs[o]);
    }
    return true;
}
