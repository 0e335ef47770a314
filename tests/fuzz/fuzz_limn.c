/* SPDX-License-Identifier: MIT */
/*
 * Opening a .limn file, and evaluating what could be opened: after that nothing may read outside.
 * The checksum is put right first, or nothing behind it would ever be tried.
 */
#include "../../runtime/checksum.h"
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

static void evaluate(const limn_mesh *mesh, uint32_t level) {
    const limn_plan plan = limn_plan_uniform(mesh, level);
    if (plan.vertex_count == 0 || plan.vertex_count > VERTICES_MAX ||
        mesh->control_count > VERTICES_MAX || mesh->normal_count > VERTICES_MAX)
        return;
    const size_t vertex_size = 3 * sizeof(float);
    float *const vertices = malloc((size_t)plan.vertex_count * vertex_size);
    float *const normals = malloc((size_t)plan.vertex_count * vertex_size);
    float *const control_normals = malloc(mesh->normal_count * vertex_size);
    FUZZ_REQUIRE(vertices && normals && (control_normals || mesh->normal_count == 0));
    limn_output output = {.vertices = vertices};
    if (mesh->normals) {
        limn_mesh_control_normals(mesh, mesh->controls, control_normals);
        output.normals = normals;
        output.control_normals = control_normals;
    }
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count, &output);
    free(vertices);
    free(normals);
    free(control_normals);
}

static void visit(const limn_mesh *mesh) {
    for (uint32_t p = 0; p < mesh->patch_count; p++) {
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(mesh, p, corners);
        for (uint32_t c = 0; c < mesh->domain->corner_count; c++)
            FUZZ_REQUIRE(corners[c] < mesh->control_count);
        FUZZ_REQUIRE(limn_mesh_face(mesh, p).face < mesh->face_count);
    }
    FUZZ_REQUIRE(mesh->name && strlen(mesh->name) < SIZE_MAX);
    evaluate(mesh, 0);
    evaluate(mesh, LIMN_LEVEL_MAX);
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
        }
    }
    free(memory);
    return 0;
}
