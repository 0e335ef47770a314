/* SPDX-License-Identifier: MIT */
/*
 * From a baked file to pixels: what a game does with Limn, once and in every frame. Draws one
 * frame, and of a file with clips the given moment of the first. docs/getting-started.md explains
 * it part by part.
 *
 *     first_frame FILE.limn OUT.png [SECONDS]
 */
#include "gpu.h"

#include <limn/character.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 640, HEIGHT = 480, THREADS = 4 };

static bool fail(const char *text) {
    fprintf(stderr, "first_frame: %s\n", text);
    return false;
}

// -------------------------------------------------------------------------------------------------
// Once: the file, the indices, and memory for all frames

/// The whole file, on a multiple of 64 bytes; NULL if it cannot be read. A mapped file will do, too.
static void *read_file(const char *path, size_t *size) {
    FILE *const file = fopen(path, "rb");
    if (!file) return NULL;
    const long length = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    *size = length < 0 ? 0 : (size_t)length;
    void *const blob = aligned_alloc(64, *size / 64 * 64 + 64);
    rewind(file);
    const bool good = blob && fread(blob, 1, *size, file) == *size;
    fclose(file);
    if (good) return blob;
    free(blob);
    return NULL;
}

/// How patches of one kind become triangles, at every level of theirs and of their edges. Depends on
/// nothing in the file: for a GPU, one static index buffer.
typedef struct game_indices {
    limn_template *templates;
    uint16_t *indices;
} game_indices;

static bool indices_open(game_indices *out, const limn_domain *domain) {
    const uint32_t count =
        limn_templates_write(domain, LIMN_TOPOLOGY_TRIANGLES, sizeof(uint16_t), NULL, NULL);
    out->templates = malloc(limn_template_count(domain) * sizeof *out->templates);
    out->indices = malloc(count * sizeof(uint16_t));
    if (!out->templates || !out->indices) return false;
    limn_templates_write(domain, LIMN_TOPOLOGY_TRIANGLES, sizeof(uint16_t), out->indices,
                         out->templates);
    return true;
}

/// One mesh, and all memory that a frame of it needs.
typedef struct game_actor {
    limn_mesh mesh;
    limn_skin skin;
    limn_morph_targets targets;
    float *weights;       ///< [targets.target_count] of the morph targets
    float *controls;      ///< [mesh.point_count][3] the control points of this frame
    float *normals;       ///< [mesh.normal_count][3] the normals at them
    void *plan_memory;    ///< [limn_plan_size()]
    gpu_vertex *vertices; ///< the vertex buffer, large enough for level 4 everywhere
} game_actor;

static bool actor_open(game_actor *actor, const limn_pack *pack, uint32_t mesh_index) {
    const limn_mesh mesh = limn_pack_mesh(pack, mesh_index);
    const limn_plan largest = limn_plan_uniform(&mesh, LIMN_LEVEL_MAX);
    if (!mesh.normals) return fail("the file has no normals; bake it with --normals exact");
    actor->mesh = mesh;
    actor->skin = limn_mesh_skin(pack, mesh_index);
    actor->targets = limn_mesh_morph_targets(pack, mesh_index);
    actor->weights = malloc((actor->targets.target_count + (size_t)1) * sizeof(float));
    actor->controls = malloc(mesh.point_count * sizeof(float[3]));
    actor->normals = malloc(mesh.normal_count * sizeof(float[3]));
    actor->plan_memory = malloc(limn_plan_size(&mesh));
    actor->vertices = malloc((size_t)largest.vertex_count * sizeof *actor->vertices);
    return (actor->weights && actor->controls && actor->normals && actor->plan_memory &&
            actor->vertices) ||
           fail("out of memory");
}

static void actor_close(game_actor *actor) {
    free(actor->weights);
    free(actor->controls);
    free(actor->normals);
    free(actor->plan_memory);
    free(actor->vertices);
}

/// All of a file.
typedef struct game_state {
    limn_pack pack;
    limn_skeleton skeleton; ///< without joints, where there is none
    float *matrices;        ///< [skeleton.joint_count][3][4]
    game_indices indices[LIMN_DOMAIN_COUNT];
    game_actor *actors; ///< [pack.mesh_count]
} game_state;

static bool game_open(game_state *game, const void *blob, size_t size) {
    const limn_result result = limn_pack_open(&game->pack, blob, size); // checks everything, once
    if (result != LIMN_OK) return fail(limn_result_text(result));
    game->skeleton = limn_pack_skeleton(&game->pack);
    game->matrices = malloc((game->skeleton.joint_count + (size_t)1) * sizeof(float[3][4]));
    game->actors = calloc(game->pack.mesh_count + (size_t)1, sizeof *game->actors);
    if (!game->matrices || !game->actors) return fail("out of memory");
    for (int kind = 0; kind < LIMN_DOMAIN_COUNT; kind++) {
        if (!indices_open(&game->indices[kind], limn_domain_get((limn_domain_kind)kind)))
            return fail("out of memory");
    }
    for (uint32_t m = 0; m < game->pack.mesh_count; m++) {
        if (!actor_open(&game->actors[m], &game->pack, m)) return false;
    }
    return true;
}

static void game_close(game_state *game) {
    for (uint32_t m = 0; game->actors && m < game->pack.mesh_count; m++)
        actor_close(&game->actors[m]);
    for (int kind = 0; kind < LIMN_DOMAIN_COUNT; kind++) {
        free(game->indices[kind].templates);
        free(game->indices[kind].indices);
    }
    free(game->actors);
    free(game->matrices);
}

// -------------------------------------------------------------------------------------------------
// Every frame: of Limn, nothing below allocates

/// Moves the control points of mesh `m`: morph targets, then joints, then what follows from them.
static void pose_actor(const game_state *game, uint32_t m, const limn_clip *clip, float seconds) {
    game_actor *const actor = &game->actors[m];
    const limn_mesh *const mesh = &actor->mesh;
    memcpy(actor->controls, mesh->controls, mesh->control_count * sizeof(float[3]));
    if (actor->targets.target_count > 0) {
        limn_clip_morph_weights(&game->pack, m, clip, seconds, LIMN_WRAP_REPEAT, actor->weights);
        limn_morph_points(&actor->targets, actor->weights, mesh->controls, 0,
                          actor->targets.point_count, actor->controls);
    }
    if (actor->skin.point_count > 0) {
        const limn_pose pose = {.skin = &actor->skin, .matrices = game->matrices};
        limn_pose_points(&pose, actor->controls, 0, actor->skin.point_count, actor->controls);
    }
    limn_mesh_refine(mesh, actor->controls); // the further points of isolated and divided meshes
    limn_mesh_control_normals(mesh, actor->controls, actor->normals);
}

static void pose(const game_state *game, float seconds) {
    limn_clip first;
    const limn_clip *clip = NULL; // everything at rest
    if (limn_pack_clip_count(&game->pack) > 0) {
        first = limn_pack_clip(&game->pack, 0);
        clip = &first;
    }
    limn_clip_pose(&game->skeleton, clip, seconds, LIMN_WRAP_REPEAT, game->matrices);
    for (uint32_t m = 0; m < game->pack.mesh_count; m++)
        pose_actor(game, m, clip, seconds);
}

/// A plan of which threads take range after range.
typedef struct evaluation {
    const limn_plan *plan;
    const float *controls;
    limn_output output;
    atomic_uint next;
} evaluation;

static void *evaluate_ranges(void *user) {
    enum { RANGE = 64 }; // patches: tens of microseconds
    evaluation *const work = user;
    const uint32_t count = work->plan->patch_count;
    for (;;) {
        const uint32_t begin = atomic_fetch_add(&work->next, RANGE);
        if (begin >= count) return NULL;
        const uint32_t end = count - begin < RANGE ? count : begin + RANGE;
        limn_evaluate(work->plan, work->controls, begin, end, &work->output);
    }
}

/// A game gives this work to the threads that it has. Here are some for one frame.
static void evaluate(evaluation *work) {
    pthread_t threads[THREADS - 1];
    int count = 0;
    while (count < THREADS - 1 && pthread_create(&threads[count], NULL, evaluate_ranges, work) == 0)
        count++;
    evaluate_ranges(work);
    while (count > 0)
        pthread_join(threads[--count], NULL);
}

/// Plans, evaluates and draws a mesh as its control points are now.
static void draw_actor(const game_actor *actor, const game_indices *indices, const limn_view *view,
                       const limn_lighting *lighting, gpu_picture *picture) {
    const limn_lod_desc lod = {.lod = LIMN_LOD_ERROR, .pixels = 0.5f, .min_level = 1};
    const limn_plan plan = limn_plan_build(&actor->mesh, actor->controls, view, 1, &lod,
                                           indices->templates, actor->plan_memory);
    gpu_vertex *const vertices = actor->vertices;
    evaluation work = {.plan = &plan,
                       .controls = actor->controls,
                       .output = {.vertices = vertices->position,
                                  .stride = sizeof *vertices,
                                  .colours = vertices->colour,
                                  .colour_stride = sizeof *vertices,
                                  .lighting = lighting,
                                  .control_normals = actor->normals}};
    evaluate(&work);
    gpu_multi_draw_elements_indirect(picture, vertices, indices->indices, plan.draws,
                                     plan.patch_count);
    printf("%s: %u of %u patches, up to level %u: %llu vertices, %llu triangles\n",
           actor->mesh.name, plan.patch_count, actor->mesh.patch_count, plan.level,
           (unsigned long long)plan.vertex_count, (unsigned long long)plan.index_count / 3);
}

/// Looks at all meshes as they are now: from the front, from their left and a little above.
static limn_view look(const game_state *game, gpu_picture *picture) {
    static const float up[3] = {0, 1, 0}, fov = 0.6f;
    static const float way[3] = {0.45f, 0.25f, 0.86f}; // from the middle to the eye
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t m = 0; m < game->pack.mesh_count; m++) {
        const game_actor *const actor = &game->actors[m];
        for (uint32_t i = 0; i < 3 * actor->mesh.control_count; i++) {
            low[i % 3] = fminf(low[i % 3], actor->controls[i]);
            high[i % 3] = fmaxf(high[i % 3], actor->controls[i]);
        }
    }
    const float size = hypotf(hypotf(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
    float middle[3], eye[3];
    for (int i = 0; i < 3; i++) {
        middle[i] = (low[i] + high[i]) / 2;
        eye[i] = middle[i] + 1.6f * size * way[i];
    }
    gpu_picture_look(picture, eye, middle, up, fov);
    return limn_view_perspective(eye, middle, up, fov, WIDTH, HEIGHT, 0.01f * size, 10 * size);
}

static void frame(const game_state *game, float seconds, gpu_picture *picture) {
    static const limn_light lights[2] = {
        {.colour = {0.75f, 0.70f, 0.62f}, .direction = {0.48f, -0.64f, -0.6f}},
        {.colour = {0.10f, 0.13f, 0.18f}, .direction = {-0.8f, 0, -0.6f}},
    };
    static const limn_lighting lighting = {.mode = LIMN_LIGHT_EXACT,
                                           .ambient = {0.06f, 0.06f, 0.07f},
                                           .lights = lights,
                                           .light_count = 2};
    pose(game, seconds);
    const limn_view view = look(game, picture);
    for (uint32_t m = 0; m < game->pack.mesh_count; m++) {
        const game_actor *const actor = &game->actors[m];
        draw_actor(actor, &game->indices[actor->mesh.domain->kind], &view, &lighting, picture);
    }
}

// -------------------------------------------------------------------------------------------------
// The program

static bool run(const void *blob, size_t size, const char *picture_path, float seconds) {
    game_state game = {0};
    gpu_picture picture = {0};
    bool good = game_open(&game, blob, size);
    if (good && !gpu_picture_create(&picture, WIDTH, HEIGHT)) good = fail("out of memory");
    if (good) {
        frame(&game, seconds, &picture);
        good =
            gpu_picture_write_png(&picture, picture_path) || fail("the picture cannot be written");
    }
    gpu_picture_free(&picture);
    game_close(&game);
    return good;
}

int main(int argc, char **argv) {
    if (argc != 3 && argc != 4) {
        fprintf(stderr, "usage: first_frame FILE.limn OUT.png [SECONDS]\n");
        return 2;
    }
    size_t size;
    void *const blob = read_file(argv[1], &size);
    const bool good = blob ? run(blob, size, argv[2], argc == 4 ? strtof(argv[3], NULL) : 0)
                           : fail("the file cannot be read");
    free(blob);
    return good ? 0 : 1;
}
