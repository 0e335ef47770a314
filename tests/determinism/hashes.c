/* SPDX-License-Identifier: MIT */
/*
 * Prints a line `file what hash` for the bytes of each file and for the bits of what is evaluated
 * from it: determinism_test.sh compares them with table.txt. Every instruction set of this CPU and
 * THREADS of them must give what one thread gives with plain C. Links the runtime alone.
 *
 * usage: hashes THREADS FILE.limn...
 */
#include "../../runtime/checksum.h"
#include "blob_file.h"

#include "limn/character.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { THREADS_MAX = 16, VERTEX_SIZE = 28 };

/// What is hashed, of all meshes of a file together.
typedef enum item {
    UNIFORM, ///< plans of levels 0 to 4: positions, normals and colours
    PACKED = UNIFORM + LIMN_LEVEL_COUNT,
    LENGTH_FRAME,
    ERROR_FRAME,
    CHANNELS,
    POSES,
    ITEMS
} item;

static const char *const item_names[ITEMS] = {"level-0",  "level-1", "level-2",      "level-3",
                                              "level-4",  "packed",  "length-frame", "error-frame",
                                              "channels", "poses"};

typedef uint64_t hash_list[ITEMS];

/// Adds bytes to a hash of all that was added before.
static void add(uint64_t *hash, const void *bytes, size_t size) {
    const uint64_t pair[2] = {*hash, limni_checksum(bytes, size)};
    *hash = limni_checksum(pair, sizeof pair);
}

static void *room(size_t size) {
    void *const memory = calloc(size + (size == 0), 1);
    if (!memory) abort();
    return memory;
}

// ---- Evaluating by several threads

typedef struct job {
    const limn_plan *plan;
    const float *controls;
    const limn_output *output;
    uint32_t begin, end;
} job;

static void *run_job(void *argument) {
    const job *const j = argument;
    limn_evaluate(j->plan, j->controls, j->begin, j->end, j->output);
    return NULL;
}

static void evaluate(const limn_plan *plan, const float *controls, uint32_t thread_count,
                     const limn_output *output) {
    pthread_t threads[THREADS_MAX];
    job jobs[THREADS_MAX];
    const uint32_t step = plan->patch_count / thread_count;
    for (uint32_t t = 0; t < thread_count; t++) {
        const uint32_t end = t + 1 < thread_count ? (t + 1) * step : plan->patch_count;
        jobs[t] = (job){plan, controls, output, t * step, end};
        if (t > 0 && pthread_create(&threads[t], NULL, run_job, &jobs[t]) != 0) abort();
    }
    run_job(&jobs[0]);
    for (uint32_t t = 1; t < thread_count; t++)
        pthread_join(threads[t], NULL);
}

// ---- Vertices

/// One mesh of a file in one pose.
typedef struct scene {
    const limn_mesh *mesh;
    const float *controls;  ///< refined
    float *control_normals; ///< NULL: the mesh has none
    uint32_t thread_count;
} scene;

static const limn_light lights[] = {
    {.kind = LIMN_LIGHT_DIRECTIONAL, .colour = {0.5f, 0.25f, 0.125f}, .direction = {0, -1, 0}},
    {.kind = LIMN_LIGHT_SPOT,
     .colour = {1, 2, 3},
     .position = {1, 2, 3},
     .direction = {0, 0, -1},
     .attenuation = {1, 0.5f, 0.25f},
     .range = 9,
     .inner_cosine = 0.75f,
     .outer_cosine = 0.5f}};

static void add_vertices(const scene *s, const limn_plan *plan, bool packed, uint64_t *hash) {
    const limn_lighting lighting = {.mode = packed ? LIMN_LIGHT_INTERPOLATED : LIMN_LIGHT_EXACT,
                                    .ambient = {0.125f, 0.125f, 0.125f},
                                    .lights = lights,
                                    .light_count = sizeof lights / sizeof *lights};
    const size_t size = (size_t)plan->vertex_count * VERTEX_SIZE;
    unsigned char *const bytes = room(size);
    limn_output output = {.vertices = bytes, .stride = VERTEX_SIZE};
    if (s->control_normals) {
        output.normals = bytes + 12;
        output.colours = bytes + 24;
        output.normal_stride = output.colour_stride = VERTEX_SIZE;
        output.control_normals = s->control_normals;
        output.lighting = &lighting;
    }
    if (packed) {
        output.position_format = LIMN_POSITION_UNORM16X4;
        output.normal_format = LIMN_NORMAL_OCT16X2;
    }
    evaluate(plan, s->controls, s->thread_count, &output);
    add(hash, bytes, size);
    free(bytes);
}

/// As seen from beside the mesh, with patches of all levels.
static void add_frame(const scene *s, limn_lod lod, uint64_t *hash) {
    const float up[3] = {0, 1, 0}, *const low = s->mesh->bounds_min,
                *const high = s->mesh->bounds_max;
    const float target[3] = {low[0], low[1], low[2]};
    const float eye[3] = {high[0] + (high[0] - low[0]), high[1] + 0.5f, high[2] + 1};
    const limn_view view = limn_view_perspective(eye, target, up, 1, 640, 480, 0.01f, 1000);
    const limn_lod_desc desc = {.lod = lod, .pixels = lod == LIMN_LOD_ERROR ? 0.25f : 12};
    void *const memory = room(limn_plan_size(s->mesh));
    const limn_plan plan = limn_plan_build(s->mesh, s->controls, &view, 1, &desc, NULL, memory);
    add(hash, plan.patches, plan.patch_count * sizeof *plan.patches);
    add_vertices(s, &plan, false, hash);
    free(memory);
}

static void add_channels(const limn_pack *pack, const limn_mesh *mesh, uint64_t *hash) {
    const limn_plan plan = limn_plan_uniform(mesh, 3);
    for (uint32_t c = 0; c < mesh->channel_count; c++) {
        const limn_channel channel = limn_mesh_channel(pack, mesh, c);
        for (int format = LIMN_VALUE_FLOAT3; format <= LIMN_VALUE_RGBA8; format++) {
            const size_t size = (size_t)plan.vertex_count * 12;
            void *const values = room(size);
            limn_evaluate_channel(
                &plan, &channel, channel.mesh.controls, 0, plan.patch_count,
                &(limn_value_output){.values = values, .format = (limn_value_format)format});
            add(hash, values, size);
            free(values);
        }
    }
}

/// The moment `time` of a clip, by morph targets and either way of blending.
static void pose(const limn_pack *pack, uint32_t m, const limn_mesh *mesh, float time,
                 bool by_dual_quaternions, float *controls) {
    const limn_skeleton skeleton = limn_pack_skeleton(pack);
    const limn_clip clip = limn_pack_clip(pack, 0);
    const limn_morph_targets targets = limn_mesh_morph_targets(pack, m);
    const limn_skin skin = limn_mesh_skin(pack, m);
    float *const weights = room(targets.target_count * sizeof(float));
    float *const matrices = room(skeleton.joint_count * sizeof(float[12]));
    limn_dual_quaternion *const quaternions = room(skeleton.joint_count * sizeof *quaternions);
    limn_clip_morph_weights(pack, m, &clip, time, LIMN_WRAP_REPEAT, weights);
    limn_clip_pose(&skeleton, &clip, time, LIMN_WRAP_REPEAT, matrices);
    limn_dual_quaternions_make(matrices, skeleton.joint_count, quaternions);
    memcpy(controls, mesh->controls, mesh->control_count * sizeof(float[3]));
    if (targets.target_count)
        limn_morph_points(&targets, weights, mesh->controls, 0, targets.point_count, controls);
    if (skin.point_count) {
        const limn_pose p = {.skin = &skin,
                             .matrices = matrices,
                             .dual_quaternions = by_dual_quaternions ? quaternions : NULL};
        limn_pose_points(&p, controls, 0, skin.point_count, controls);
    }
    free(weights);
    free(matrices);
    free(quaternions);
}

static void add_poses(const limn_pack *pack, uint32_t m, const scene *bind, uint64_t *hash) {
    if (limn_pack_clip_count(pack) == 0) return;
    float *const controls = room(bind->mesh->point_count * sizeof(float[3]));
    for (int step = 0; step < 4; step++) {
        scene s = *bind;
        pose(pack, m, s.mesh, 0.2f * (float)step, step % 2, controls);
        limn_mesh_refine(s.mesh, controls);
        if (s.control_normals) limn_mesh_control_normals(s.mesh, controls, s.control_normals);
        s.controls = controls;
        const limn_plan plan = limn_plan_uniform(s.mesh, 2);
        add_vertices(&s, &plan, false, hash);
    }
    free(controls);
}

static void hash_mesh(const limn_pack *pack, uint32_t m, uint32_t thread_count, hash_list hashes) {
    const limn_mesh mesh = limn_pack_mesh(pack, m);
    float *const controls = room(mesh.point_count * sizeof(float[3]));
    memcpy(controls, mesh.controls, mesh.control_count * sizeof(float[3]));
    limn_mesh_refine(&mesh, controls);
    scene s = {.mesh = &mesh, .controls = controls, .thread_count = thread_count};
    if (mesh.normals) {
        s.control_normals = room(mesh.normal_count * sizeof(float[3]));
        limn_mesh_control_normals(&mesh, controls, s.control_normals);
    }
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        const limn_plan plan = limn_plan_uniform(&mesh, level);
        add_vertices(&s, &plan, false, &hashes[UNIFORM + level]);
        if (level == 2) add_vertices(&s, &plan, true, &hashes[PACKED]);
    }
    add_frame(&s, LIMN_LOD_LENGTH, &hashes[LENGTH_FRAME]);
    add_frame(&s, LIMN_LOD_ERROR, &hashes[ERROR_FRAME]);
    add_channels(pack, &mesh, &hashes[CHANNELS]);
    add_poses(pack, m, &s, &hashes[POSES]);
    free(s.control_normals);
    free(controls);
}

// ---- Files

static void hash_pack(const limn_pack *pack, uint32_t threads, hash_list hashes) {
    memset(hashes, 0, sizeof(hash_list));
    for (uint32_t m = 0; m < pack->mesh_count; m++)
        hash_mesh(pack, m, threads, hashes);
}

static bool are_same(const char *name, const limn_pack *pack, uint32_t threads,
                     const hash_list expected) {
    hash_list hashes;
    hash_pack(pack, threads, hashes);
    if (memcmp(hashes, expected, sizeof hashes) == 0) return true;
    fprintf(stderr, "%s: other bits with %s and %u threads\n", name,
            limn_kernels_name(pack->kernels), threads);
    return false;
}

/// Whether kernels and threads make no difference to the hashes of plain C and one thread.
static bool hash_all(const char *name, limn_pack pack, uint32_t threads, hash_list hashes) {
    bool same = true;
    pack.kernels = limn_kernels_select(LIMN_ISA_SCALAR, LIMN_FAMILY_REPRODUCIBLE);
    hash_pack(&pack, 1, hashes);
    for (uint32_t isa = LIMN_ISA_SSE2; isa <= LIMN_ISA_NEON; isa <<= 1) {
        if (!(limn_isa_supported() & isa)) continue;
        pack.kernels = limn_kernels_select(isa, LIMN_FAMILY_REPRODUCIBLE);
        same &= are_same(name, &pack, 1, hashes);
    }
    return are_same(name, &pack, threads, hashes) && same;
}

static void print(const char *name, const char *what, uint64_t hash) {
    if (hash) printf("%s %s %016" PRIx64 "\n", name, what, hash);
}

static bool hash_file(const char *path, uint32_t threads) {
    char error[1024], name[256];
    limni_blob_file file;
    limn_pack pack;
    hash_list hashes;
    const char *const slash = strrchr(path, '/');
    snprintf(name, sizeof name, "%s", slash ? slash + 1 : path);
    name[strcspn(name, ".")] = '\0';
    if (!limni_blob_file_open(&file, path, error, sizeof error)) {
        fprintf(stderr, "%s\n", error);
        return false;
    }
    const limn_result result = limn_pack_open(&pack, file.bytes, file.size);
    if (result != LIMN_OK) fprintf(stderr, "%s: %s\n", path, limn_result_text(result));
    const bool same = result == LIMN_OK && hash_all(name, pack, threads, hashes);
    if (result == LIMN_OK) {
        print(name, "file", limni_checksum(file.bytes, file.size));
        for (int i = 0; i < ITEMS; i++)
            print(name, item_names[i], hashes[i]);
    }
    limni_blob_file_close(&file);
    return same;
}

int main(int argc, char **argv) {
    const unsigned long threads = argc > 2 ? strtoul(argv[1], NULL, 10) : 0;
    if (threads < 1 || threads > THREADS_MAX) {
        fprintf(stderr, "usage: hashes THREADS FILE.limn...\n");
        return 2;
    }
    bool same = true;
    for (int i = 2; i < argc; i++)
        same &= hash_file(argv[i], (uint32_t)threads);
    return !same;
}
