/* SPDX-License-Identifier: MIT */
#include "dense.h"

#include "hash.h"
#include "mesh.h"

#include <string.h>

/// Where a vertex lies on the control mesh, the same for all patches that have it: a <= b are the
/// ends of its base edge and `step` counts from a; at a corner both are that control point.
typedef struct place {
    uint32_t a, b, step;
} place;

/// Vertices by place.
typedef struct place_table {
    uint32_t *vertices; ///< LIMNI_NONE: free
    uint32_t size;      ///< a power of two
    place *places;      ///< [vertex_count] of the vertices that are kept
} place_table;

static place place_of(const limn_domain *domain, const uint32_t *corners, uint32_t row) {
    if (row < domain->corner_count) return (place){corners[row], corners[row], 0};
    uint32_t edge = 0, step = 0;
    while (!(domain->rows[row].edges >> edge & 1))
        edge++;
    while (domain->edge_rows[edge][step] != row)
        step++;
    const uint32_t a = corners[edge], b = corners[(edge + 1) % domain->corner_count];
    return a < b ? (place){a, b, step} : (place){b, a, LIMN_GRID_SIZE - step};
}

/// The vertex at the same place with the same bits, or where a new one goes.
static uint32_t *find_place(const place_table *table, const limni_dense *dense, place at,
                            const float position[3]) {
    uint64_t hash = limni_hash_mix(limni_hash_mix(at.a, at.b), at.step);
    for (;; hash++) {
        uint32_t *const found = &table->vertices[hash & (table->size - 1)];
        if (*found == LIMNI_NONE) return found;
        if (memcmp(&table->places[*found], &at, sizeof at) == 0 &&
            memcmp(dense->vertices[*found], position, sizeof *dense->vertices) == 0)
            return found;
    }
}

/// Moves the vertices that are kept to the front. Fills `moved` with the new index of each.
static void weld_vertices(const limn_mesh *mesh, uint32_t level, place_table *table,
                          limni_dense *dense, uint32_t *moved) {
    const uint32_t row_count = mesh->domain->row_counts[level];
    uint32_t kept = 0;
    for (uint32_t patch = 0; patch < mesh->patch_count; patch++) {
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(mesh, patch, corners);
        for (uint32_t row = 0; row < row_count; row++) {
            const size_t vertex = (size_t)patch * row_count + row;
            float position[3];
            memcpy(position, dense->vertices[vertex], sizeof position);
            moved[vertex] = kept;
            if (mesh->domain->rows[row].edges) {
                const place at = place_of(mesh->domain, corners, row);
                uint32_t *const found = find_place(table, dense, at, position);
                if (*found == LIMNI_NONE) table->places[ *found = kept] = at;
                moved[vertex] = *found;
            }
            if (moved[vertex] == kept) memcpy(dense->vertices[kept++], position, sizeof position);
        }
    }
    dense->vertex_count = kept;
}

/// Merges the vertices that patches share, where all bits of their positions are equal.
static limn_bake_status weld(limni_context *context, const limn_mesh *mesh, uint32_t level,
                             limni_dense *dense) {
    place_table table = {.size = limni_hash_size(dense->vertex_count)};
    table.vertices = limni_allocate(context, table.size, sizeof *table.vertices);
    table.places = limni_allocate(context, dense->vertex_count, sizeof *table.places);
    uint32_t *const moved = limni_allocate(context, dense->vertex_count, sizeof *moved);
    if (!table.vertices || !table.places || !moved) return LIMN_BAKE_MEMORY;
    memset(table.vertices, 0xff, table.size * sizeof *table.vertices);
    weld_vertices(mesh, level, &table, dense, moved);
    for (uint64_t i = 0; i < dense->index_count; i++)
        dense->indices[i] = moved[dense->indices[i]];
    limni_release(context, table.vertices);
    limni_release(context, table.places);
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
    return weld_equal ? weld(context, mesh, level, dense) : LIMN_BAKE_OK;
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
