/* SPDX-License-Identifier: MIT */
#include "skin.h"

#include "allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void blend(const skin_mesh *mesh, const scene_bone *bones, uint32_t v, float sum[16]) {
    for (int i = 0; i < 16; i++)
        sum[i] = 0;
    for (int k = 0; k < 4; k++) {
        const float weight = mesh->weights[v][k];
        const float *const bone = bones[mesh->bones[v][k]];
        for (int i = 0; i < 16; i++)
            sum[i] += weight * bone[i];
    }
}

static void turn(const float matrix[16], const float normal[3], float out[3]) {
    float turned[3], squares = 0;
    for (int axis = 0; axis < 3; axis++) {
        turned[axis] =
            matrix[axis] * normal[0] + matrix[4 + axis] * normal[1] + matrix[8 + axis] * normal[2];
        squares += turned[axis] * turned[axis];
    }
    for (int axis = 0; axis < 3; axis++)
        out[axis] = turned[axis] / sqrtf(squares);
}

void skin_scalar(const skin_mesh *mesh, const scene_bone *bones, float *out) {
    for (uint32_t v = 0; v < mesh->count; v++) {
        const float *const p = mesh->positions[v];
        float matrix[16];
        blend(mesh, bones, v, matrix);
        for (int axis = 0; axis < 3; axis++)
            *out++ = matrix[axis] * p[0] + matrix[4 + axis] * p[1] + matrix[8 + axis] * p[2] +
                     matrix[12 + axis];
        if (!mesh->normals) continue;
        turn(matrix, mesh->normals[v], out);
        out += 3;
    }
}

skin_fn *skin_select(uint32_t isa_mask, const char **name) {
    isa_mask &= limn_isa_supported();
#ifdef BENCH_WITH_X86
    if (isa_mask & LIMN_ISA_AVX2) {
        *name = "avx2";
        return skin_avx2;
    }
    if (isa_mask & LIMN_ISA_SSE2) {
        *name = "sse2";
        return skin_sse2;
    }
#endif
    *name = "scalar";
    return skin_scalar;
}

static void attach(skin_mesh *mesh, uint32_t v, uint32_t *seed) {
    float sum = 0;
    for (int k = 0; k < 4; k++) {
        mesh->bones[v][k] = (uint8_t)(scene_random(seed) * SCENE_BONE_COUNT);
        mesh->weights[v][k] = scene_random(seed) + 0.01f;
        sum += mesh->weights[v][k];
    }
    for (int k = 0; k < 4; k++)
        mesh->weights[v][k] /= sum;
}

skin_mesh skin_create(const float (*positions)[3], const float (*normals)[3], uint32_t count) {
    skin_mesh mesh = {
        .positions = bench_allocate(count, sizeof *mesh.positions),
        .bones = bench_allocate(count, sizeof *mesh.bones),
        .weights = bench_allocate(count, sizeof *mesh.weights),
        .count = count,
        .byte_count =
            (uint64_t)count * (sizeof *mesh.positions + sizeof *mesh.bones + sizeof *mesh.weights),
    };
    memcpy(mesh.positions, positions, count * sizeof *positions);
    if (normals) {
        mesh.normals = bench_allocate(count, sizeof *mesh.normals);
        memcpy(mesh.normals, normals, count * sizeof *normals);
        mesh.byte_count += (uint64_t)count * sizeof *mesh.normals;
    }
    uint32_t seed = 7;
    for (uint32_t v = 0; v < count; v++)
        attach(&mesh, v, &seed);
    return mesh;
}

void skin_destroy(skin_mesh *mesh) {
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->bones);
    free(mesh->weights);
}
