/* SPDX-License-Identifier: MIT */
/* From the tags of a source, which name edges by their ends, to sharpness by half-edge. */
#include "hash.h"
#include "mesh.h"

#include <stdio.h>
#include <string.h>

static const char *file_of(const limni_source *source) {
    return source->path ? source->path : source->name;
}

// ---- Creases by edge

/// The last crease of each edge.
typedef struct crease_table {
    const limni_crease *creases;
    uint32_t *indices; ///< LIMNI_NONE: free
    uint32_t size;     ///< a power of two
} crease_table;

static uint32_t *find_crease(const crease_table *table, uint32_t a, uint32_t b) {
    const uint64_t key = limni_edge_key(a, b);
    uint32_t at = (uint32_t)limni_hash_mix(key, 0) & (table->size - 1);
    for (; table->indices[at] != LIMNI_NONE; at = (at + 1) & (table->size - 1)) {
        const limni_crease *const crease = &table->creases[table->indices[at]];
        if (limni_edge_key(crease->a, crease->b) == key) break;
    }
    return &table->indices[at];
}

static limn_bake_status make_crease_table(limni_context *context, const limni_tags *tags,
                                          crease_table *table) {
    table->creases = tags->creases;
    table->size = limni_hash_size(tags->crease_count);
    table->indices = limni_allocate(context, table->size, sizeof *table->indices);
    if (!table->indices) return LIMN_BAKE_MEMORY;
    memset(table->indices, 0xff, table->size * sizeof *table->indices);
    for (uint32_t c = 0; c < tags->crease_count; c++)
        *find_crease(table, tags->creases[c].a, tags->creases[c].b) = c;
    return LIMN_BAKE_OK;
}

// ---- Tags of what is not there

/// Tags that are dropped, for a note.
typedef struct dropped_tags {
    uint32_t count, first_index, first_line;
} dropped_tags;

static void drop(dropped_tags *dropped, uint32_t index, uint32_t line) {
    if (dropped->count++ > 0) return;
    dropped->first_index = index;
    dropped->first_line = line;
}

/// what: "creases name no edge of a face"
static void note_dropped(limni_context *context, const limni_source *source,
                         const dropped_tags *dropped, const char *what) {
    if (dropped->count == 0) return;
    const char *const by = dropped->first_line ? "in line" : "number";
    limni_note(context, "%s: ignored: %u %s (the first is %s %u)", file_of(source), dropped->count,
               what, by, dropped->first_line ? dropped->first_line : dropped->first_index);
}

static void mark_named(const limni_source *source, const crease_table *table, bool *named) {
    for (uint32_t face = 0; face < source->face_count; face++) {
        const uint32_t begin = source->face_offsets[face], end = source->face_offsets[face + 1];
        for (uint32_t c = begin; c < end; c++) {
            const uint32_t next = c + 1 < end ? c + 1 : begin;
            const uint32_t found =
                *find_crease(table, source->face_corners[c], source->face_corners[next]);
            if (found != LIMNI_NONE) named[found] = true;
        }
    }
}

static limn_bake_status check_creases(limni_context *context, limni_source *source) {
    limni_tags *const tags = &source->tags;
    if (tags->crease_count == 0) return LIMN_BAKE_OK;
    crease_table table;
    bool *const named = limni_allocate_zeroed(context, tags->crease_count, sizeof *named);
    if (!named) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(make_crease_table(context, tags, &table));
    mark_named(source, &table, named);

    dropped_tags dropped = {0};
    uint32_t kept = 0;
    // The table must stay as it is until all are looked up: mark first, move then.
    for (uint32_t c = 0; c < tags->crease_count; c++)
        named[c] = named[*find_crease(&table, tags->creases[c].a, tags->creases[c].b)];
    for (uint32_t c = 0; c < tags->crease_count; c++) {
        if (named[c]) {
            tags->creases[kept++] = tags->creases[c];
        } else {
            drop(&dropped, c, tags->creases[c].line);
        }
    }
    tags->crease_count = kept;
    note_dropped(context, source, &dropped, "creases that name no edge of a face");
    limni_release(context, table.indices);
    limni_release(context, named);
    return LIMN_BAKE_OK;
}

static void check_sharp_vertices(limni_context *context, limni_source *source) {
    limni_tags *const tags = &source->tags;
    dropped_tags dropped = {0};
    uint32_t kept = 0;
    for (uint32_t v = 0; v < tags->sharp_vertex_count; v++) {
        const limni_sharp_vertex vertex = tags->sharp_vertices[v];
        if (vertex.position < source->position_count) {
            tags->sharp_vertices[kept++] = vertex;
        } else {
            drop(&dropped, v, vertex.line);
        }
    }
    tags->sharp_vertex_count = kept;
    note_dropped(context, source, &dropped, "corners that name no vertex");
}

static void check_holes(limni_context *context, limni_source *source) {
    limni_tags *const tags = &source->tags;
    dropped_tags dropped = {0};
    uint32_t kept = 0;
    for (uint32_t h = 0; h < tags->hole_count; h++) {
        const limni_hole hole = tags->holes[h];
        if (hole.face < source->face_count) {
            tags->holes[kept++] = hole;
        } else {
            drop(&dropped, h, hole.line);
        }
    }
    tags->hole_count = kept;
    note_dropped(context, source, &dropped, "holes that name no face");
}

limn_bake_status limni_check_tags(limni_context *context, limni_source *source) {
    check_sharp_vertices(context, source);
    check_holes(context, source);
    return check_creases(context, source);
}

// ---- Tags of the mesh

static limn_bake_status tag_edges(limni_context *context, const limni_tags *tags,
                                  limni_mesh *mesh) {
    if (tags->crease_count == 0) return LIMN_BAKE_OK;
    crease_table table;
    LIMNI_TRY(make_crease_table(context, tags, &table));
    for (uint32_t h = 0; h < mesh->half_edge_count; h++) {
        const uint32_t found =
            *find_crease(&table, limni_half_edge_start(mesh, h), limni_half_edge_end(mesh, h));
        if (found != LIMNI_NONE) mesh->edge_sharpness[h] = tags->creases[found].sharpness;
    }
    limni_release(context, table.indices);
    return LIMN_BAKE_OK;
}

/// Holes are numbered as read; some faces may have been dropped since.
static limn_bake_status tag_holes(limni_context *context, const limni_source *source,
                                  limni_mesh *mesh) {
    const limni_tags *const tags = &source->tags;
    uint32_t end = 0;
    for (uint32_t h = 0; h < tags->hole_count; h++) {
        if (tags->holes[h].face >= end) end = tags->holes[h].face + 1;
    }
    bool *const is_hole = limni_allocate_zeroed(context, end, sizeof *is_hole);
    if (!is_hole) return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < tags->hole_count; h++)
        is_hole[tags->holes[h].face] = true;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const uint32_t number = source->face_numbers[mesh->polygons[face]];
        mesh->holes[face] = number < end && is_hole[number];
        mesh->hole_count += mesh->holes[face];
    }
    limni_release(context, is_hole);
    if (mesh->hole_count < mesh->face_count) return LIMN_BAKE_OK;
    return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: every face is a hole", file_of(source));
}

/// The control points are still those of the source: splitting them comes later, and copies their
/// sharpness.
limn_bake_status limni_tag_mesh(limni_context *context, const limni_source *source,
                                limni_mesh *mesh) {
    const limni_tags *const tags = &source->tags;
    mesh->boundary = tags->boundary;
    mesh->creasing = tags->creasing;
    mesh->edge_sharpness =
        limni_allocate_zeroed(context, mesh->half_edge_count, sizeof *mesh->edge_sharpness);
    mesh->vertex_sharpness =
        limni_allocate_zeroed(context, mesh->control_count, sizeof *mesh->vertex_sharpness);
    mesh->holes = limni_allocate_zeroed(context, mesh->face_count, sizeof *mesh->holes);
    if (!mesh->edge_sharpness || !mesh->vertex_sharpness || !mesh->holes) return LIMN_BAKE_MEMORY;
    for (uint32_t v = 0; v < tags->sharp_vertex_count; v++)
        mesh->vertex_sharpness[tags->sharp_vertices[v].position] =
            tags->sharp_vertices[v].sharpness;
    LIMNI_TRY(tag_edges(context, tags, mesh));
    return tag_holes(context, source, mesh);
}
