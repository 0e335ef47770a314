/* SPDX-License-Identifier: MIT */
/*
 * The frames of viewer/game_loop.c without a GPU: they have the bits that one thread writes into
 * memory for the same moment, and only the first of them allocates.
 *
 *     test_game_loop FILE...
 */
#include "check.h"
#include "game_loop.h"
#include "report.h"
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

const char view_program_name[] = "test_game_loop";

// -------------------------------------------------------------------------------------------------
// Calls of the allocator, which the linker leads here (--wrap)

static atomic_int allocation_count;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);

void *__wrap_malloc(size_t size) {
    allocation_count++;
    return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size) {
    allocation_count++;
    return __real_calloc(count, size);
}

void *__wrap_realloc(void *memory, size_t size) {
    allocation_count++;
    return __real_realloc(memory, size);
}

// -------------------------------------------------------------------------------------------------
// A renderer that draws nothing

struct view_renderer {
    view_vertex *vertices;
    uint64_t room;
};

view_vertex *view_renderer_map(view_renderer *renderer, uint64_t vertex_count) {
    if (vertex_count > renderer->room) {
        free(renderer->vertices);
        renderer->room = 2 * vertex_count;
        renderer->vertices = calloc(renderer->room, sizeof *renderer->vertices);
    }
    return renderer->vertices;
}

bool view_renderer_draw(view_renderer *renderer, const view_frame *frame) {
    (void)renderer;
    (void)frame;
    return true;
}

// -------------------------------------------------------------------------------------------------
// Frames

/// A view of everything from in front of it, closer with every frame.
static view_moment make_moment(const view_scene *scene, const limn_clip *clip, int frame) {
    const limni_bounds *const bounds = &scene->bounds;
    float middle[3], eye[3], size = 0;
    for (int axis = 0; axis < 3; axis++) {
        middle[axis] = eye[axis] = bounds->min[axis] / 2 + bounds->max[axis] / 2;
        size += bounds->max[axis] - bounds->min[axis];
    }
    eye[2] += size * (2 - 0.1f * (float)frame);
    return (view_moment){
        .clip = clip,
        .time = 0.05f * (float)frame,
        .view = limn_view_perspective(eye, middle, (const float[]){0, 1, 0}, 0.7f, 1280, 720,
                                      size / 1000, size * 10),
        .lod = {.lod = LIMN_LOD_LENGTH, .pixels = 4},
        .frame = {.colours = VIEW_COLOURS_LEVELS},
    };
}

/// The same moment by other means: limni_moment_make(), and one call for all patches.
static void check_vertices(const view_game *game, const view_moment *moment,
                           const view_vertex *vertices) {
    limni_frame_options options = {.clip = moment->clip ? moment->clip->name : NULL,
                                   .time = moment->time};
    limni_moment expected;
    CHECK(limni_moment_make(&expected, game->pack, 0, game->actor_count, &options));
    for (uint32_t a = 0; a < game->actor_count; a++) {
        const limn_mesh *const mesh = &expected.meshes[a].mesh;
        const view_surface *const surface = game->actors[a].surface;
        const limn_plan *const plan = &surface->plan;
        const size_t count = (size_t)plan->vertex_count;
        float(*const positions)[3] = calloc(count + 1, sizeof *positions);
        float(*const normals)[3] = calloc(count + 1, sizeof *normals);
        float *const control_normals = calloc(mesh->normal_count + (size_t)1, sizeof(float[3]));
        limn_mesh_control_normals(mesh, mesh->controls, control_normals);
        limn_evaluate(plan, mesh->controls, 0, plan->patch_count,
                      &(limn_output){.vertices = positions,
                                     .normals = normals,
                                     .control_normals = control_normals});
        size_t difference_count = 0;
        for (size_t v = 0; v < count; v++) {
            const view_vertex *const vertex = &vertices[surface->first_vertex + v];
            difference_count += memcmp(vertex->position, positions[v], sizeof(float[3])) != 0 ||
                                memcmp(vertex->normal, normals[v], sizeof(float[3])) != 0;
        }
        CHECK(count > 0 && difference_count == 0);
        free(positions);
        free(normals);
        free(control_normals);
    }
    limni_moment_free(&expected);
}

static void check_frames(view_game *game, view_scene *scene) {
    enum { FRAMES = 12 };
    view_renderer renderer = {0};
    limn_clip clip;
    const bool moves = limn_pack_clip_count(&scene->pack) > 0;
    if (moves) clip = limn_pack_clip(&scene->pack, 0);
    for (int frame = FRAMES; frame >= 0;
         frame--) { // the nearest first, which has the most vertices
        const view_moment moment = make_moment(scene, moves ? &clip : NULL, frame);
        const int before = allocation_count;
        CHECK(view_game_frame(game, &renderer, &moment));
        if (frame == FRAMES) {
            CHECK(allocation_count > before); // that of the renderer: the count counts
        } else {
            CHECK(allocation_count == before);
        }
        if (frame % 4 == 0) check_vertices(game, &moment, renderer.vertices);
    }
    free(renderer.vertices);
}

int main(int argc, char **argv) {
    const limni_frame_options options = {.live = true, .max_level = LIMN_LEVEL_MAX};
    const view_light light = {0};
    view_workers *const workers = view_workers_create(3);
    CHECK(workers && argc > 1);
    for (int file = 1; file < argc; file++) {
        view_scene scene;
        view_game game = {0};
        if (view_scene_open(&scene, argv[file], &options, &light, VIEW_ALL_MESHES) &&
            view_game_open(&game, &scene, workers)) {
            check_frames(&game, &scene);
        } else {
            CHECK(false);
        }
        view_game_close(&game);
        view_scene_close(&scene);
    }
    view_workers_destroy(workers);
    return check_report();
}
