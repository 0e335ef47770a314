/* SPDX-License-Identifier: MIT */
/*
 * What tests of opening a file share: files in memory, and damage to them. Nothing that opens may
 * make evaluation leave its buffers (run under the sanitizers).
 */
#ifndef BLOBS_H
#define BLOBS_H

#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L /* posix_memalign */
#endif

#include "../runtime/checksum.h"
#include "limn/format.h"
#include "limn/limn.h"

#include "check.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

// ---- Blobs

/// A file in memory, with not one byte of room behind it.
typedef struct blob {
    unsigned char *bytes;
    size_t size;
} blob;

static inline blob make_blob(size_t size) {
    void *bytes = NULL;
    if (posix_memalign(&bytes, LIMN_FORMAT_ALIGNMENT, size ? size : 1) != 0) abort();
    return (blob){.bytes = bytes, .size = size};
}

static inline blob copy_blob(const blob *source, size_t size) {
    const blob copy = make_blob(size);
    memcpy(copy.bytes, source->bytes, size);
    return copy;
}

static inline limn_file_header *header_of(const blob *file) {
    return (limn_file_header *)(void *)file->bytes;
}

static inline limn_file_chunk *directory_of(const blob *file) {
    return (limn_file_chunk *)(void *)(file->bytes + sizeof(limn_file_header));
}

static inline limn_file_chunk *find_chunk(const blob *file, uint32_t mesh, uint32_t kind) {
    limn_file_chunk *chunk = directory_of(file);
    while (chunk->mesh != mesh || chunk->kind != kind)
        chunk++;
    return chunk;
}

static inline void *chunk_data(const blob *file, uint32_t mesh, uint32_t kind) {
    return file->bytes + find_chunk(file, mesh, kind)->offset;
}

static inline void fix_checksum(const blob *file) {
    const size_t summed = offsetof(limn_file_header, chunk_count);
    header_of(file)->checksum = limni_checksum(file->bytes + summed, file->size - summed);
}

/// Opens, and checks that a refusal leaves the view as it was.
static inline limn_result open_result(const void *bytes, size_t size) {
    limn_pack pack, untouched;
    memset(&pack, 0x5a, sizeof pack);
    memset(&untouched, 0x5a, sizeof untouched);
    const limn_result result = limn_pack_open(&pack, bytes, size);
    const bool same = memcmp(&pack, &untouched, sizeof pack) == 0;
    CHECK(same == (result != LIMN_OK));
    return result;
}

// ---- Damage anywhere

static inline float *evaluate(const limn_mesh *mesh, uint32_t level) {
    const limn_plan plan = limn_plan_uniform(mesh, level);
    const size_t size = (size_t)plan.vertex_count * 3 * sizeof(float);
    float *const vertices = malloc(size ? size : 1);
    if (!vertices) abort();
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count, &(limn_output){.vertices = vertices});
    return vertices;
}

static inline void check_corners(const limn_mesh *mesh, uint32_t patch_index) {
    uint32_t found[LIMN_CORNER_MAX];
    memset(found, 0xff, sizeof found);
    limn_mesh_corners(mesh, patch_index, found);
    for (uint32_t c = 0; c < mesh->domain->corner_count; c++)
        CHECK(found[c] - mesh->base_first < mesh->base_count);
    CHECK(limn_mesh_face(mesh, patch_index).face < mesh->patch_count);
}

/// In a room of just its points.
static inline void refine(const limn_mesh *mesh) {
    const size_t size = mesh->point_count * sizeof(float[3]);
    float *const points = malloc(size ? size : 1);
    if (!points) abort();
    memcpy(points, mesh->controls, mesh->control_count * sizeof(float[3]));
    limn_mesh_refine(mesh, points);
    free(points);
}

/// Writes normals into rooms of just their size.
static inline void evaluate_normals(const limn_mesh *mesh, uint32_t level) {
    const limn_plan plan = limn_plan_uniform(mesh, level);
    float *const control_normals = malloc(mesh->normal_count * sizeof(float[3]));
    float *const vertices = malloc((size_t)plan.vertex_count * sizeof(float[3]));
    float *const normals = malloc((size_t)plan.vertex_count * sizeof(float[3]));
    limn_mesh_control_normals(mesh, mesh->controls, control_normals);
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count,
                  &(limn_output){.vertices = vertices,
                                 .normals = normals,
                                 .control_normals = control_normals});
    free(control_normals);
    free(vertices);
    free(normals);
}

/// Channels of a mesh, into rooms of just their size.
static inline void evaluate_channels(const limn_pack *pack, const limn_mesh *mesh, uint32_t level) {
    const limn_plan plan = limn_plan_uniform(mesh, level);
    for (uint32_t c = 0; c < mesh->channel_count; c++) {
        const limn_channel channel = limn_mesh_channel(pack, mesh, c);
        float *const values = malloc((size_t)plan.vertex_count * sizeof(float[2]));
        refine(&channel.mesh);
        limn_evaluate_channel(&plan, &channel, channel.mesh.controls, 0, plan.patch_count,
                              &(limn_value_output){.values = values, .format = LIMN_VALUE_FLOAT2});
        free(values);
        for (uint32_t p = 0; p < mesh->patch_count; p++)
            check_corners(&channel.mesh, p);
    }
}

/// With the checksum mended: refused, or evaluated at every level into buffers of just that size.
/// Returns whether it opened.
static inline bool check_safe(const blob *file) {
    fix_checksum(file);
    limn_pack pack;
    if (limn_pack_open(&pack, file->bytes, file->size) != LIMN_OK) return false;
    for (uint32_t m = 0; m < pack.mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(&pack, m);
        refine(&mesh);
        for (uint32_t level = 0; level <= LIMN_LEVEL_MAX; level++)
            free(evaluate(&mesh, level));
        if (mesh.normals) evaluate_normals(&mesh, 1);
        evaluate_channels(&pack, &mesh, 1);
        CHECK(strlen(mesh.name) < file->size);
        for (uint32_t p = 0; p < mesh.patch_count; p++)
            check_corners(&mesh, p);
    }
    return true;
}

/// From one byte to the next that is changed: tables are most of a file, and all alike.
static inline size_t step_at(const blob *file, size_t at) {
    const limn_file_chunk *const tables = find_chunk(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES);
    return at >= tables->offset && at < tables->offset + tables->size ? 13 : 1;
}

/// What lies between chunks and behind the last is not read.
static inline void check_gaps(const blob *file) {
    const blob changed = copy_blob(file, file->size);
    size_t at = sizeof(limn_file_header);
    at += header_of(file)->chunk_count * sizeof(limn_file_chunk);
    for (uint32_t c = 0; c < header_of(file)->chunk_count; c++) {
        const limn_file_chunk *const chunk = &directory_of(file)[c];
        if (chunk->size == 0) continue;
        memset(changed.bytes + at, 0xff, (size_t)chunk->offset - at);
        at = (size_t)(chunk->offset + chunk->size);
    }
    memset(changed.bytes + at, 0xff, file->size - at);
    CHECK(check_safe(&changed));
    free(changed.bytes);
}

/// Every byte, but few of the tables.
static inline void check_mended_bytes(const blob *file) {
    check_gaps(file);
    const unsigned char patterns[] = {0x01, 0x80, 0xff};
    uint32_t opened = 0, refused = 0;
    for (size_t at = offsetof(limn_file_header, chunk_count); at < file->size;
         at += step_at(file, at)) {
        for (size_t p = 0; p < COUNT(patterns); p++) {
            const blob changed = copy_blob(file, file->size);
            changed.bytes[at] ^= patterns[p];
            if (check_safe(&changed)) {
                opened++;
            } else {
                refused++;
            }
            free(changed.bytes);
        }
    }
    CHECK(opened > 100);
    CHECK(refused > 100);
}

/// Counts, offsets and indices at the limits of their types.
static inline void check_mended_words(const blob *file) {
    check_gaps(file);
    const uint32_t values[] = {0,       1,          2,          3,          64,        0xffff,
                               1 << 30, 0x3fffffff, 0x7fffffff, 0x80000000, 0xffffffff};
    const limn_file_chunk *const tables = find_chunk(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES);
    for (size_t at = offsetof(limn_file_header, chunk_count); at + 4 <= file->size; at += 4) {
        if (at >= tables->offset && at < tables->offset + tables->size) continue;
        for (size_t v = 0; v < COUNT(values); v++) {
            const blob changed = copy_blob(file, file->size);
            memcpy(changed.bytes + at, &values[v], sizeof values[v]);
            check_safe(&changed);
            free(changed.bytes);
        }
    }
}

// ---- Damage of every kind

typedef void damage_fn(const blob *file);

typedef struct damage {
    const char *name;
    damage_fn *apply;
    limn_result expected;
} damage;

#define DAMAGE(name, expected)                                                                     \
    { #name, name, expected }

static inline void check_damages(const blob *file, const damage *damages, size_t count) {
    for (size_t d = 0; d < count; d++) {
        const blob damaged = copy_blob(file, file->size);
        damages[d].apply(&damaged);
        fix_checksum(&damaged);
        const limn_result result = open_result(damaged.bytes, damaged.size);
        if (!CHECK_EQUAL(result, damages[d].expected))
            fprintf(stderr, "    %s: %s\n", damages[d].name, limn_result_text(result));
        free(damaged.bytes);
    }
}

static inline limn_file_class *classes_of(const blob *file) {
    return chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLASSES);
}
static inline limn_file_chunk *tables_of(const blob *file) {
    return find_chunk(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES);
}
static inline limn_file_mesh *record_of(const blob *file, uint32_t mesh) {
    return chunk_data(file, mesh, LIMN_CHUNK_MESH);
}
static inline limn_file_run *runs_of(const blob *file, uint32_t mesh) {
    return chunk_data(file, mesh, LIMN_CHUNK_RUNS);
}
static inline uint32_t *faces_of(const blob *file, uint32_t mesh) {
    return chunk_data(file, mesh, LIMN_CHUNK_FACES);
}
static inline uint32_t *indices_of(const blob *file, uint32_t mesh) {
    return chunk_data(file, mesh, LIMN_CHUNK_INDICES);
}
static inline float *controls_of(const blob *file, uint32_t mesh) {
    return chunk_data(file, mesh, LIMN_CHUNK_CONTROLS);
}

static inline void remove_chunk(const blob *file, uint32_t mesh, uint32_t kind) {
    limn_file_chunk *const chunk = find_chunk(file, mesh, kind);
    limn_file_chunk *const end = directory_of(file) + header_of(file)->chunk_count;
    memmove(chunk, chunk + 1, (size_t)(end - chunk - 1) * sizeof *chunk);
    header_of(file)->chunk_count--;
}

#define WITHOUT(name, mesh, kind)                                                                  \
    static void name(const blob *file) {                                                           \
        remove_chunk(file, mesh, kind);                                                            \
    }

// ---- More chunks

/// The file with one more entry in its directory, in its place.
static inline blob insert_chunk(const blob *file, const limn_file_chunk *added) {
    const size_t head = sizeof(limn_file_header), room = LIMN_FORMAT_ALIGNMENT;
    const uint32_t count = header_of(file)->chunk_count;
    const blob longer = make_blob(file->size + room);
    memset(longer.bytes, 0, longer.size);
    memcpy(longer.bytes, file->bytes, head);
    const size_t first = (head + count * sizeof *added + room - 1) / room * room;
    memcpy(longer.bytes + first + room, file->bytes + first, file->size - first);
    header_of(&longer)->size = longer.size;
    header_of(&longer)->chunk_count++;

    limn_file_chunk *dst = directory_of(&longer);
    bool done = false;
    for (uint32_t c = 0; c < count; c++) {
        limn_file_chunk chunk = directory_of(file)[c];
        chunk.offset += room;
        const bool before = added->mesh + 1 < chunk.mesh + 1 ||
                            (added->mesh == chunk.mesh && added->kind <= chunk.kind);
        if (before && !done) *dst++ = *added;
        done |= before;
        *dst++ = chunk;
    }
    if (!done) *dst = *added;
    fix_checksum(&longer);
    return longer;
}

/// The file with `size` zeros more, a multiple of 64, at the end of its tables.
static inline blob grow_tables(const blob *file, size_t size) {
    const limn_file_chunk *const tables = tables_of(file);
    const size_t room = LIMN_FORMAT_ALIGNMENT;
    const size_t end = (size_t)(tables->offset + tables->size + room - 1) / room * room;
    const blob longer = make_blob(file->size + size);
    memcpy(longer.bytes, file->bytes, end);
    memset(longer.bytes + end, 0, size);
    memcpy(longer.bytes + end + size, file->bytes + end, file->size - end);
    header_of(&longer)->size = longer.size;
    for (uint32_t c = 0; c < header_of(file)->chunk_count; c++) {
        limn_file_chunk *const chunk = &directory_of(&longer)[c];
        if (chunk->offset >= end) chunk->offset += size;
    }
    tables_of(&longer)->size = end - tables->offset + size;
    fix_checksum(&longer);
    return longer;
}

#endif
