/* SPDX-License-Identifier: MIT */
#include "dense.h"

#include "hash.h"
#include "mesh.h"

#include <string.h>

static uint64_t position_hash(const float position[3]) {
    uint32_t bits[3];
    memcpy(bits, position, sizeof bits);
    return limni_hash_mix(limni_hash_mix(bits[0], bits[1]), bits[2]);
}

/// Moves distinct positions to the front. Fills `moved` with the new index of each vertex.
static uint32_t weld_vertices(float (*vertices)[3], uint32_t count, uint32_t *table, uint32_t mask,
                              uint32_t *moved) {
    uint32_t kept = 0;
    for (uint32_t v = 0; v < count; v++) {
        uint32_t at = (uint32_t)position_hash(vertices[v]) & mask;
        while (table[at] != LIMNI_NONE &&
               memcmp(vertices[table[at]], vertices[v], sizeof *vertices) != 0)
            at = (at + 1) & mask;
        if (table[at] == LIMNI_NONE) {
            table[at] = kept;
            memmove(vertices[kept++], vertices[v], sizeof *vertices);
        }
        moved[v] = table[at];
    }
    return kept;
}

static limn_bake_status weld(limni_context *context, limni_dense *dense) {
    const uint32_t size = limni_hash_size(dense->vertex_count);
    uint32_t *const table = limni_allocate(context, size, sizeof *table);
    uint32_t *const moved = limni_allocate(context, dense->vertex_count, sizeof *moved);
    if (!table || !moved) return LIMN_BAKE_MEMORY;
    memset(table, 0xff, size * sizeof *table);
    dense->vertex_count =
        weld_vertices(dense->vertices, dense->vertex_count, table, size - 1, moved);
    for (uint64_t i = 0; i < dense->index_count; i++)
        dense->indices[i] = moved[dense->indices[i]];
    limni_release(context, table);
    limni_release(context, moved);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_dense_build(limni_context *context, const limn_mesh *mesh, uint32_t level,
                                   bool weld_equal, limni_dense *dense) {
    const limn_plan plan = limn_plan_uniform(mesh, level);
    if (plan.vertex_count > UINT32_MAX / 4)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: level %u has too many vertices for one mesh", mesh->name, level);
    *dense = (limni_dense){
        .name = mesh->name,
        .vertices = limni_allocate(context, (size_t)plan.vertex_count, sizeof *dense->vertices),
        .indices = limni_allocate(context, (size_t)plan.index_count, sizeof *dense->indices),
        .vertex_count = (uint32_t)plan.vertex_count,
        .index_count = plan.index_count,
    };
    if (!dense->vertices || !dense->indices) return LIMN_BAKE_MEMORY;
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count,
                  &(limn_output){.vertices = dense->vertices});

    const uint16_t *const indices = mesh->domain->indices[level];
    const uint32_t index_count = mesh->domain->index_counts[level];
    uint32_t *dst = dense->indices;
    for (uint32_t patch = 0; patch < plan.patch_count; patch++) {
        const uint32_t first = (uint32_t)limn_plan_first_vertex(&plan, patch);
        for (uint32_t i = 0; i < index_count; i++)
            *dst++ = first + indices[i];
    }
    return weld_equal ? weld(context, dense) : LIMN_BAKE_OK;
}

void limni_dense_release(limni_context *context, limni_dense *dense) {
    limni_release(context, dense->vertices);
    limni_release(context, dense->indices);
}

void limni_dense_write_obj(const limni_dense *meshes, uint32_t mesh_count, FILE *stream) {
    uint32_t first = 1;
    for (uint32_t m = 0; m < mesh_count; m++) {
        const limni_dense *const dense = &meshes[m];
        fprintf(stream, "o %s\n", dense->name);
        for (uint32_t v = 0; v < dense->vertex_count; v++)
            fprintf(stream, "v %.9g %.9g %.9g\n", (double)dense->vertices[v][0],
                    (double)dense->vertices[v][1], (double)dense->vertices[v][2]);
        for (uint64_t i = 0; i < dense->index_count; i += 3)
            fprintf(stream, "f %u %u %u\n", first + dense->indices[i],
                    first + dense->indices[i + 1], first + dense->indices[i + 2]);
        first += dense->vertex_count;
    }
}

void limni_dense_write_ply(const limni_dense *meshes, uint32_t mesh_count, FILE *stream) {
    uint64_t vertex_count = 0, face_count = 0;
    for (uint32_t m = 0; m < mesh_count; m++) {
        vertex_count += meshes[m].vertex_count;
        face_count += meshes[m].index_count / 3;
    }
    fprintf(stream,
            "ply\nformat binary_little_endian 1.0\nelement vertex %llu\n"
            "property float x\nproperty float y\nproperty float z\nelement face %llu\n"
            "property list uchar uint vertex_indices\nend_header\n",
            (unsigned long long)vertex_count, (unsigned long long)face_count);
    for (uint32_t m = 0; m < mesh_count; m++)
        fwrite(meshes[m].vertices, sizeof *meshes[m].vertices, meshes[m].vertex_count, stream);
    uint32_t first = 0;
    for (uint32_t m = 0; m < mesh_count; m++) {
        for (uint64_t i = 0; i < meshes[m].index_count; i += 3) {
            const uint32_t *const source = meshes[m].indices + i;
            const uint32_t face[3] = {first + source[0], first + source[1], first + source[2]};
            fputc(3, stream);
            fwrite(face, sizeof face, 1, stream);
        }
        first += meshes[m].vertex_count;
    }
}
