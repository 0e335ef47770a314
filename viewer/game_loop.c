/* SPDX-License-Identifier: MIT */
#include "game_loop.h"

#include "report.h"
#include <stdlib.h>
#include <string.h>
#include <time.h>

// -------------------------------------------------------------------------------------------------
// Once: memory for all frames

static bool open_actor(view_actor *actor, const limn_pack *pack, uint32_t mesh_index,
                       view_surface *surface) {
    const limn_mesh mesh = limn_pack_mesh(pack, mesh_index);
    const size_t point_size = sizeof(float[3]);
    *actor = (view_actor){
        .mesh = mesh,
        .mesh_index = mesh_index,
        .skin = limn_mesh_skin(pack, mesh_index),
        .targets = limn_mesh_morph_targets(pack, mesh_index),
        .controls = malloc((mesh.point_count + (size_t)1) * point_size),
        .normals = malloc((mesh.normal_count + (size_t)1) * point_size),
        .plan_memory = malloc(limn_plan_size(&mesh) + 1),
        .surface = surface,
    };
    actor->weights = malloc((actor->targets.target_count + (size_t)1) * sizeof(float));
    if (!actor->weights || !actor->controls || !actor->normals || !actor->plan_memory) return false;
    memcpy(actor->controls, surface->mesh.controls, mesh.point_count * point_size);
    surface->mesh.controls = actor->controls;
    surface->faceted = !mesh.normals;
    return true;
}

bool view_game_open(view_game *game, view_scene *scene, view_workers *workers) {
    *game = (view_game){.pack = &scene->pack,
                        .scene = scene,
                        .skeleton = limn_pack_skeleton(&scene->pack),
                        .workers = workers};
    game->matrices = malloc((game->skeleton.joint_count + (size_t)1) * sizeof(float[3][4]));
    game->actors = calloc(scene->surface_count + (size_t)1, sizeof *game->actors);
    if (!game->matrices || !game->actors) return view_fail("out of memory");
    for (uint32_t a = 0; a < scene->surface_count; a++) {
        game->actor_count = a + 1;
        if (!open_actor(&game->actors[a], game->pack, scene->first_mesh + a, &scene->surfaces[a]))
            return view_fail("out of memory for mesh '%s'", scene->surfaces[a].mesh.name);
    }
    return true;
}

void view_game_close(view_game *game) {
    for (uint32_t a = 0; a < game->actor_count; a++) {
        free(game->actors[a].weights);
        free(game->actors[a].controls);
        free(game->actors[a].normals);
        free(game->actors[a].plan_memory);
    }
    free(game->matrices);
    free(game->actors);
    *game = (view_game){0};
}

// -------------------------------------------------------------------------------------------------
// Every frame: nothing below allocates, but for the ring of vertices where it must grow

typedef struct skin_work {
    const view_actor *actor;
    limn_pose pose;
} skin_work;

static void skin_range(void *user, uint32_t begin, uint32_t end) {
    const skin_work *const work = user;
    float *const controls = work->actor->controls;
    limn_pose_points(&work->pose, controls, begin, end, controls);
}

/// From the bind pose to the control points of this moment: morph targets, then the skin, then the
/// points that follow from control points.
static void pose_actor(const view_game *game, view_actor *actor, const view_moment *moment) {
    enum { POINTS = 2048 }; // of a range: some 50 microseconds
    const limn_mesh *const mesh = &actor->mesh;
    memcpy(actor->controls, mesh->controls, mesh->control_count * sizeof(float[3]));
    if (actor->targets.target_count > 0) {
        limn_clip_morph_weights(game->pack, actor->mesh_index, moment->clip, moment->time,
                                LIMN_WRAP_REPEAT, actor->weights);
        limn_morph_points(&actor->targets, actor->weights, mesh->controls, 0,
                          actor->targets.point_count, actor->controls);
    }
    if (actor->skin.point_count > 0) {
        skin_work work = {actor, {.skin = &actor->skin, .matrices = game->matrices}};
        view_workers_run(game->workers, skin_range, &work, actor->skin.point_count, POINTS);
    }
    limn_mesh_refine(mesh, actor->controls);
}

static void pose(view_game *game, const view_moment *moment) {
    limn_clip_pose(&game->skeleton, moment->clip, moment->time, LIMN_WRAP_REPEAT, game->matrices);
    for (uint32_t a = 0; a < game->actor_count; a++)
        pose_actor(game, &game->actors[a], moment);
}

static void find_normals(view_game *game) {
    for (uint32_t a = 0; a < game->actor_count; a++) {
        const view_actor *const actor = &game->actors[a];
        if (actor->mesh.normals)
            limn_mesh_control_normals(&actor->mesh, actor->controls, actor->normals);
    }
}

/// Which patches are drawn, at which level, and where their vertices go: those of one mesh behind
/// those of another.
static void plan(view_game *game, const view_moment *moment) {
    game->vertex_count = 0;
    for (uint32_t a = 0; a < game->actor_count; a++) {
        const view_actor *const actor = &game->actors[a];
        const limn_template *const templates =
            game->scene->templates[actor->mesh.domain->kind].templates;
        actor->surface->plan = limn_plan_build(&actor->mesh, actor->controls, &moment->view, 1,
                                               &moment->lod, templates, actor->plan_memory);
        actor->surface->first_vertex = (uint32_t)game->vertex_count;
        game->vertex_count += actor->surface->plan.vertex_count;
    }
}

typedef struct evaluation {
    const view_surface *surface;
    const limn_plan *plan;
    const float *controls;
    limn_output output;
    view_vertex *vertices;
} evaluation;

static void evaluate_range(void *user, uint32_t begin, uint32_t end) {
    const evaluation *const work = user;
    limn_evaluate(work->plan, work->controls, begin, end, &work->output);
    // Texture coordinates; and what a game does not show: levels and borders of patches.
    view_vertices_describe(work->surface, begin, end, work->vertices);
}

/// Writes all vertices, from several threads, straight to where the GPU reads them.
static void evaluate(view_game *game, const view_moment *moment, view_vertex *vertices) {
    enum { PATCHES = 64 }; // of a range: tens of microseconds
    for (uint32_t a = 0; a < game->actor_count; a++) {
        const view_actor *const actor = &game->actors[a];
        view_vertex *const first = vertices + actor->surface->first_vertex;
        evaluation work = {
            .surface = actor->surface,
            .plan = &actor->surface->plan,
            .controls = actor->controls,
            .output = {.vertices = first->position, .stride = sizeof *first},
            .vertices = first,
        };
        if (actor->mesh.normals) {
            work.output.normals = first->normal;
            work.output.normal_stride = sizeof *first;
            work.output.control_normals = actor->normals;
            work.output.lighting = moment->lighting;
            work.output.colours = moment->lighting ? first->light : NULL;
            work.output.colour_stride = sizeof *first;
        }
        view_workers_run(game->workers, evaluate_range, &work, work.plan->patch_count, PATCHES);
    }
}

/// Says how long the stage took that ends here, and begins the next.
static void end_stage(view_game *game, view_stage stage, struct timespec *begin) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    game->seconds[stage] =
        (double)(now.tv_sec - begin->tv_sec) + 1e-9 * (double)(now.tv_nsec - begin->tv_nsec);
    *begin = now;
}

bool view_game_frame(view_game *game, view_renderer *renderer, const view_moment *moment) {
    struct timespec begin;
    clock_gettime(CLOCK_MONOTONIC, &begin);
    pose(game, moment);
    end_stage(game, VIEW_STAGE_POSE, &begin);
    find_normals(game);
    end_stage(game, VIEW_STAGE_NORMALS, &begin);
    plan(game, moment);
    end_stage(game, VIEW_STAGE_PLAN, &begin);

    // The third of a ring that the GPU is done with: it may still be drawing the other two.
    view_vertex *const vertices = view_renderer_map(renderer, game->vertex_count);
    if (!vertices) return false;
    end_stage(game, VIEW_STAGE_MAP, &begin);
    evaluate(game, moment, vertices);
    end_stage(game, VIEW_STAGE_EVALUATE, &begin);

    // Indices are static, and on the GPU since the start: a draw names a template and a place.
    const bool drawn = view_renderer_draw(renderer, &moment->frame);
    end_stage(game, VIEW_STAGE_DRAW, &begin);
    return drawn;
}
