/* SPDX-License-Identifier: MIT */
/*
 * Opening a .limn file, and refining, planning and evaluating what could be opened: after that
 * nothing may read outside.
 * The checksum is put right first, or nothing behind it would ever be tried.
 */
#include "../../runtime/checksum.h"
#include "../characters.h"
#include "fuzz.h"

#include "limn/format.h"
#include "limn/limn.h"

#include <string.h>

enum { VERTICES_MAX = 1 << 16 };

static void put_right(unsigned char *blob, size_t size) {
    limn_file_header header;
    const size_t summed = offsetof(limn_file_header, chunk_count);
    if (size < sizeof header) return;
    memcpy(&header, blob, sizeof header);
    memcpy(header.magic, LIMN_FORMAT_MAGIC, sizeof header.magic);
    header.version = LIMN_FORMAT_VERSION;
    header.size = size;
    header.checksum = limni_checksum(blob + summed, size - summed);
    memcpy(blob, &header, summed);
}

static void *allocate(size_t size) {
    void *const memory = malloc(size + (size == 0));
    FUZZ_REQUIRE(memory);
    return memory;
}

static const limn_light lights[] = {
    {.kind = LIMN_LIGHT_DIRECTIONAL, .colour = {1, 1, 1}, .direction = {0, -1, 0}},
    {.kind = LIMN_LIGHT_SPOT,
     .colour = {1, 2, 3},
     .position = {0, 1, 2},
     .direction = {0, 0, -1},
     .attenuation = {0, 0, 1},
     .range = 5,
     .inner_cosine = 0.9f,
     .outer_cosine = 0.5f}};

static void evaluate(const limn_mesh *mesh, const float *points, const limn_plan *plan) {
    if (plan->vertex_count > VERTICES_MAX) return;
    const size_t vertex_size = 3 * sizeof(float);
    const limn_lighting lighting = {.mode = plan->level % 2 ? LIMN_LIGHT_EXACT
                                                            : LIMN_LIGHT_INTERPOLATED,
                                    .lights = lights,
                                    .light_count = 2};
    uint32_t *const colours = allocate((size_t)plan->vertex_count * sizeof *colours);
    float *const vertices = allocate((size_t)plan->vertex_count * vertex_size);
    float *const normals = allocate((size_t)plan->vertex_count * vertex_size);
    float *const control_normals = allocate(mesh->normal_count * vertex_size);
    limn_output output = {.vertices = vertices};
    if (mesh->normals) {
        limn_mesh_control_normals(mesh, points, control_normals);
        output.normals = normals;
        output.control_normals = control_normals;
        output.colours = colours;
        output.lighting = &lighting;
    }
    limn_evaluate(plan, points, 0, plan->patch_count, &output);
    free(vertices);
    free(normals);
    free(colours);
    free(control_normals);
}

/// From the middle of the box of its control points outwards: some patches are seen, some are not.
static void evaluate_frame(const limn_mesh *mesh, const float *points, limn_lod lod) {
    const float target[3] = {mesh->bounds_max[0], mesh->bounds_max[1], mesh->bounds_max[2]};
    const float up[3] = {0, 0, 1};
    float eye[3];
    for (int axis = 0; axis < 3; axis++)
        eye[axis] = (mesh->bounds_min[axis] + mesh->bounds_max[axis]) / 2;
    const limn_view view = limn_view_perspective(eye, target, up, 1, 640, 480, 1e-3f, 1e3f);
    void *const memory = allocate(limn_plan_size(mesh));
    const limn_plan plan =
        limn_plan_build(mesh, points, &view, 1, &(limn_lod_desc){.lod = lod}, NULL, memory);
    evaluate(mesh, points, &plan);
    free(memory);
}

/// In a room of just the points of the mesh.
static void draw(const limn_mesh *mesh) {
    const size_t point_size = 3 * sizeof(float);
    float *const points = allocate(mesh->point_count * point_size);
    if (mesh->point_count) memcpy(points, mesh->controls, mesh->control_count * point_size);
    limn_mesh_refine(mesh, points);
    for (uint32_t level = 0; level <= LIMN_LEVEL_MAX; level++) {
        const limn_plan plan = limn_plan_uniform(mesh, level);
        evaluate(mesh, points, &plan);
    }
    evaluate_frame(mesh, points, LIMN_LOD_LENGTH);
    evaluate_frame(mesh, points, LIMN_LOD_ERROR);
    free(points);
}

static void evaluate_channels(const limn_pack *pack, const limn_mesh *mesh) {
    const limn_plan plan = limn_plan_uniform(mesh, 2);
    for (uint32_t c = 0; c < mesh->channel_count; c++) {
        const limn_channel channel = limn_mesh_channel(pack, mesh, c);
        FUZZ_REQUIRE(channel.mesh.name && strlen(channel.mesh.name) < SIZE_MAX);
        if (plan.vertex_count > VERTICES_MAX) continue;
        void *const values = allocate((size_t)plan.vertex_count * sizeof(uint32_t));
        limn_evaluate_channel(
            &plan, &channel, channel.mesh.controls, 0, plan.patch_count,
            &(limn_value_output){.values = values, .format = LIMN_VALUE_UNORM16X2});
        free(values);
    }
}

static void visit(const limn_mesh *mesh) {
    for (uint32_t p = 0; p < mesh->patch_count; p++) {
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(mesh, p, corners);
        for (uint32_t c = 0; c < mesh->domain->corner_count; c++)
            FUZZ_REQUIRE(corners[c] - mesh->base_first < mesh->base_count);
        FUZZ_REQUIRE(limn_mesh_face(mesh, p).face < mesh->face_count);
    }
    FUZZ_REQUIRE(mesh->name && strlen(mesh->name) < SIZE_MAX);
    if (mesh->patch_count > 0 && mesh->point_count <= VERTICES_MAX &&
        mesh->normal_count <= VERTICES_MAX)
        draw(mesh);
}

static void use_base(const limn_pack *pack, const limn_mesh *mesh) {
    if (mesh->base_count > VERTICES_MAX || mesh->patch_count > VERTICES_MAX) return;
    void *const memory = allocate(limn_base_size(mesh));
    const limn_base base = limn_base_build(pack, mesh, memory);
    float *const positions = allocate(base.vertex_count * sizeof(float[3]));
    const limn_output output = {.vertices = positions};
    for (uint32_t i = 0; i < base.index_count; i++)
        FUZZ_REQUIRE(base.indices[i] < base.vertex_count);
    limn_base_evaluate(&base, mesh->controls, 0, base.vertex_count, &output);
    free(positions);
    free(memory);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    void *memory = NULL; // exactly as large, for the address sanitizer
    FUZZ_REQUIRE(posix_memalign(&memory, LIMN_FORMAT_ALIGNMENT, size + (size == 0)) == 0);
    if (size > 0) memcpy(memory, bytes, size);
    put_right(memory, size);
    limn_pack pack;
    if (limn_pack_open(&pack, memory, size) == LIMN_OK) {
        for (uint32_t m = 0; m < pack.mesh_count; m++) {
            const limn_mesh mesh = limn_pack_mesh(&pack, m);
            visit(&mesh);
            use_base(&pack, &mesh);
            evaluate_channels(&pack, &mesh);
        }
        use_character(&pack);
    }
    free(memory);
    return 0;
}
