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
    uint64_t hash = limni_hash_mix(limni_hash_mix(limni_hash_mix(0, at.a), at.b), at.step);
    for (;; hash++) {
        uint32_t *const found = &table->vertices[hash & (table->size - 1)];
        if (*found == LIMNI_NONE) return found;
        if (memcmp(&table->places[*found], &at, sizeof at) == 0 &&
            memcmp(dense->vertices[*found], position, sizeof *dense->vertices) == 0)
            return found;
    }
}

/// Marks with LIMNI_NONE the vertices that no triangle uses: rows that a coarser edge skips.
static void mark_unused(const limni_dense *dense, uint32_t *moved) {
    memset(moved, 0xff, dense->vertex_count * sizeof *moved);
    for (uint64_t i = 0; i < dense->index_count; i++)
        moved[dense->indices[i]] = 0;
}

/// Moves the vertices that are kept to the front. Fills `moved`, where they are not LIMNI_NONE,
/// with the new index of each. table: NULL: none are merged.
static void compact_vertices(const limn_plan *plan, place_table *table, limni_dense *dense,
                             uint32_t *moved) {
    const limn_domain *const domain = plan->mesh->domain;
    uint32_t kept = 0;
    for (uint32_t p = 0; p < plan->patch_count; p++) {
        const limn_plan_patch *const patch = &plan->patches[p];
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(plan->mesh, patch->patch, corners);
        for (uint32_t row = 0; row < domain->row_counts[patch->level]; row++) {
            const uint32_t vertex = patch->first_vertex + row;
            if (moved[vertex] == LIMNI_NONE) continue;
            float position[3];
            memcpy(position, dense->vertices[vertex], sizeof position);
            moved[vertex] = kept;
            if (table && domain->rows[row].edges) {
                const place at = place_of(domain, corners, row);
                uint32_t *const found = find_place(table, dense, at, position);
                if (*found == LIMNI_NONE) table->places[ *found = kept] = at;
                moved[vertex] = *found;
            }
            if (moved[vertex] == kept) memcpy(dense->vertices[kept++], position, sizeof position);
        }
    }
    dense->vertex_count = kept;
}

/// Drops vertices that are not used, and if asked to merges those that patches share, where all
/// bits of their positions are equal.
static limn_bake_status compact(limni_context *context, const limn_plan *plan, bool weld,
                                limni_dense *dense) {
    uint32_t *const moved = limni_allocate(context, dense->vertex_count, sizeof *moved);
    if (!moved) return LIMN_BAKE_MEMORY;
    mark_unused(dense, moved);
    if (weld) {
        place_table table = {.size = limni_hash_size(dense->vertex_count)};
        table.vertices = limni_allocate(context, table.size, sizeof *table.vertices);
        table.places = limni_allocate(context, dense->vertex_count, sizeof *table.places);
        if (!table.vertices || !table.places) return LIMN_BAKE_MEMORY;
        memset(table.vertices, 0xff, table.size * sizeof *table.vertices);
        compact_vertices(plan, &table, dense, moved);
        limni_release(context, table.vertices);
        limni_release(context, table.places);
    } else {
        compact_vertices(plan, NULL, dense, moved);
    }
    for (uint64_t i = 0; i < dense->index_count; i++)
        dense->indices[i] = moved[dense->indices[i]];
    limni_release(context, moved);
    return LIMN_BAKE_OK;
}

/// The indices of all templates, and the plan that uses them.
typedef struct planned {
    uint16_t *indices;
    limn_template *templates;
    void *memory;
    limn_plan plan;
} planned;

static limn_bake_status plan_frame(limni_context *context, const limn_mesh *mesh,
                                   const limni_frame *frame, planned *result) {
    const limn_domain *const domain = mesh->domain;
    const uint32_t index_count =
        limn_templates_write(domain, LIMN_TOPOLOGY_TRIANGLES, sizeof(uint16_t), NULL, NULL);
    result->indices = limni_allocate(context, index_count, sizeof *result->indices);
    result->templates =
        limni_allocate(context, limn_template_count(domain), sizeof *result->templates);
    result->memory = limni_allocate(context, limn_plan_size(mesh), 1);
    if (!result->indices || !result->templates || !result->memory) return LIMN_BAKE_MEMORY;
    limn_templates_write(domain, LIMN_TOPOLOGY_TRIANGLES, sizeof(uint16_t), result->indices,
                         result->templates);
    result->plan = limn_plan_build(mesh, mesh->controls, &frame->view, 1, &frame->desc,
                                   result->templates, result->memory);
    return LIMN_BAKE_OK;
}

static void list_triangles(const planned *frame, uint32_t *dst) {
    for (uint32_t p = 0; p < frame->plan.patch_count; p++) {
        const limn_plan_patch *const patch = &frame->plan.patches[p];
        const limn_template template = frame->templates[patch->template_index];
        for (uint32_t i = 0; i < template.index_count; i++)
            *dst++ = patch->first_vertex + frame->indices[template.first_index + i];
    }
}

limn_bake_status limni_dense_build(limni_context *context, const limn_mesh *mesh,
                                   const limni_frame *frame, bool weld, limni_dense *dense) {
    if (limni_frame_vertex_bound(frame, mesh) > UINT32_MAX / 4)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: may have too many vertices for one mesh; lower --level or "
                          "--max-level",
                          mesh->name);
    planned drawn;
    LIMNI_TRY(plan_frame(context, mesh, frame, &drawn));
    const limn_plan *const plan = &drawn.plan;
    *dense = (limni_dense){
        .name = mesh->name,
        .vertices = limni_allocate(context, (size_t)plan->vertex_count, sizeof *dense->vertices),
        .indices = limni_allocate(context, (size_t)plan->index_count, sizeof *dense->indices),
        .vertex_count = (uint32_t)plan->vertex_count,
        .index_count = plan->index_count,
        .evaluated_count = plan->vertex_count,
    };
    if (!dense->vertices || !dense->indices) return LIMN_BAKE_MEMORY;
    limn_evaluate(plan, mesh->controls, 0, plan->patch_count,
                  &(limn_output){.vertices = dense->vertices});
    list_triangles(&drawn, dense->indices);
    LIMNI_TRY(compact(context, plan, weld, dense));
    limni_release(context, drawn.indices);
    limni_release(context, drawn.templates);
    limni_release(context, drawn.memory);
    return LIMN_BAKE_OK;
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
