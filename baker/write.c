/* SPDX-License-Identifier: MIT */
/*
 * The .limn file: a header, a directory sorted by mesh and kind, and chunks. Laid out twice: once
 * to find the offsets, once to copy. Records are written as the host has them; what was made is
 * opened before it is handed out, which also refuses a big-endian host.
 */
#include "write.h"

#include "../runtime/character.h"
#include "../runtime/checksum.h"
#include "limn/limn.h"
#include "records.h"
#include "scheme.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    CHUNKS_OF_FILE = 5,
    CHUNKS_OF_MESH = 8,
    CHUNKS_OF_NORMALS = 3,
    CHUNKS_OF_CREASES = 3,
    CHUNKS_OF_POINTS = 2,
    CHUNKS_OF_CHANNEL = 7,
    CHUNKS_OF_CHARACTER = 8,
    CHUNKS_OF_RIG = 7
};

/// A chunk that is to be written.
typedef struct part {
    uint32_t kind, mesh;
    const void *data; ///< NULL: filled in by the caller
    uint64_t size;
} part;

static int compare_parts(const void *a, const void *b) {
    const part *const left = a, *const right = b;
    const uint64_t left_key = limn_file_chunk_key(left->mesh, left->kind);
    const uint64_t right_key = limn_file_chunk_key(right->mesh, right->kind);
    return (left_key > right_key) - (left_key < right_key);
}

/// Appends a chunk of a mesh, unless it has none.
static void add_part(part *parts, uint32_t *count, uint32_t kind, uint32_t mesh, const void *data,
                     uint64_t size) {
    if (data) parts[(*count)++] = (part){kind, mesh, data, size};
}

/// What meshes and channels have.
static void list_patches(const limni_patches *mesh, uint32_t m, part *parts, uint32_t *count) {
    const limn_file_mesh *const record = &mesh->record;
    add_part(parts, count, LIMN_CHUNK_MESH, m, record, sizeof *record);
    add_part(parts, count, LIMN_CHUNK_NAME, m, mesh->name, strlen(mesh->name) + 1);
    add_part(parts, count, LIMN_CHUNK_CONTROLS, m, mesh->controls,
             record->point_count * sizeof *mesh->controls);
    add_part(parts, count, LIMN_CHUNK_RUNS, m, mesh->runs, record->run_count * sizeof *mesh->runs);
    add_part(parts, count, LIMN_CHUNK_INDICES, m, mesh->indices,
             record->index_count * sizeof *mesh->indices);
    add_part(parts, count, LIMN_CHUNK_SLOTS, m, mesh->slots, mesh->slots_size);
    if (!mesh->stencils.offsets) return;
    const uint32_t point_count = record->point_count - record->control_count;
    add_part(parts, count, LIMN_CHUNK_STENCILS, m, mesh->stencils.offsets,
             (1 + (uint64_t)point_count) * sizeof(uint32_t));
    add_part(parts, count, LIMN_CHUNK_TERMS, m, mesh->stencils.terms,
             mesh->stencils.offsets[point_count] * sizeof(limn_file_term));
}

static void list_mesh(const limni_patches *mesh, uint32_t m, part *parts, uint32_t *count) {
    const uint64_t patch_count = mesh->record.patch_count;
    list_patches(mesh, m, parts, count);
    add_part(parts, count, LIMN_CHUNK_FACES, m, mesh->faces, patch_count * sizeof *mesh->faces);
    add_part(parts, count, LIMN_CHUNK_ERRORS, m, mesh->errors,
             limni_corner_count(mesh) * patch_count * sizeof *mesh->errors);
    add_part(parts, count, LIMN_CHUNK_CREASES, m, mesh->creases, patch_count);
}

static void list_channel(const limni_patches *channel, uint32_t m, part *parts, uint32_t *count) {
    list_patches(channel, m, parts, count);
    add_part(parts, count, LIMN_CHUNK_CHANNEL, m, &channel->channel_record,
             sizeof channel->channel_record);
}

/// The vertices that have normals.
static uint32_t base_count_of(const limn_file_mesh *record) {
    return record->divided_count ? record->divided_count : record->control_count;
}

static void list_normals(const limni_patches *mesh, uint32_t m, part *parts, uint32_t *count) {
    const limni_control_normals *const normals = &mesh->normals;
    const part of_normals[CHUNKS_OF_NORMALS] = {
        {LIMN_CHUNK_NORMALS, m, normals->records,
         base_count_of(&mesh->record) * sizeof *normals->records},
        {LIMN_CHUNK_RINGS, m, normals->ring, normals->ring_size * sizeof *normals->ring},
        {LIMN_CHUNK_WEIGHTS, m, normals->weights, normals->weight_count * sizeof *normals->weights},
    };
    memcpy(parts + *count, of_normals, sizeof of_normals);
    *count += CHUNKS_OF_NORMALS;
    add_part(parts, count, LIMN_CHUNK_SIDES, m, normals->sides,
             normals->side_count * sizeof *normals->sides);
    add_part(parts, count, LIMN_CHUNK_CORNERS, m, mesh->corner_normals,
             (uint64_t)limni_corner_count(mesh) * mesh->record.patch_count *
                 sizeof *mesh->corner_normals);
}

// ---- Characters

static void list_rig(const limni_patches *mesh, uint32_t m, part *parts, uint32_t *count) {
    const limni_control_rig *const rig = &mesh->rig;
    const uint64_t influences = (uint64_t)mesh->record.control_count * rig->influence_count;
    if (rig->influence_count) {
        add_part(parts, count, LIMN_CHUNK_JOINTS, m, rig->joints, influences * sizeof *rig->joints);
        add_part(parts, count, LIMN_CHUNK_INFLUENCES, m, rig->weights,
                 influences * sizeof *rig->weights);
    }
    if (rig->target_count) {
        const uint64_t entries = rig->first[rig->target_count];
        add_part(parts, count, LIMN_CHUNK_TARGETS, m, rig->targets,
                 rig->target_count * sizeof *rig->targets);
        add_part(parts, count, LIMN_CHUNK_TARGET_FIRST, m, rig->first,
                 (1 + (uint64_t)rig->target_count) * sizeof *rig->first);
        add_part(parts, count, LIMN_CHUNK_TARGET_POINTS, m, rig->points,
                 entries * sizeof *rig->points);
        add_part(parts, count, LIMN_CHUNK_TARGET_DELTAS, m, rig->deltas,
                 entries * sizeof *rig->deltas);
    }
    if (mesh->range_count)
        add_part(parts, count, LIMN_CHUNK_RANGES, m, mesh->ranges,
                 mesh->range_count * sizeof *mesh->ranges);
}

static void list_character(const limni_character *character, part *parts, uint32_t *count) {
    const struct {
        uint32_t kind;
        const limni_list *list;
        size_t size;
    } chunks[CHUNKS_OF_CHARACTER] = {
        {LIMN_CHUNK_STRINGS, &character->strings, 1},
        {LIMN_CHUNK_SKELETON, &character->joints, sizeof(limn_file_joint)},
        {LIMN_CHUNK_CLIPS, &character->clips, sizeof(limn_file_clip)},
        {LIMN_CHUNK_TRACKS, &character->tracks, sizeof(limn_file_track)},
        {LIMN_CHUNK_KEYS, &character->keys, sizeof(float)},
        {LIMN_CHUNK_MATERIALS, &character->materials, sizeof(limn_file_material)},
        {LIMN_CHUNK_IMAGES, &character->images, sizeof(limn_file_image)},
        {LIMN_CHUNK_IMAGE_BYTES, &character->image_bytes, 1},
    };
    for (uint32_t c = 0; c < CHUNKS_OF_CHARACTER; c++) {
        if (chunks[c].list->count)
            add_part(parts, count, chunks[c].kind, LIMN_FORMAT_NO_MESH, chunks[c].list->items,
                     chunks[c].list->count * (uint64_t)chunks[c].size);
    }
}

/// The chunks that meshes share.
typedef struct shared {
    const limni_classes *classes, *pieces;
    limni_records records;
} shared;

static void list_shared(const shared *s, const char *info, part *parts, uint32_t *count) {
    const uint32_t none = LIMN_FORMAT_NO_MESH;
    parts[(*count)++] = (part){LIMN_CHUNK_INFO, none, info, strlen(info) + 1};
    parts[(*count)++] = (part){LIMN_CHUNK_CLASSES, none, s->records.classes,
                               s->classes->count * sizeof *s->records.classes};
    parts[(*count)++] = (part){LIMN_CHUNK_TABLES, none, NULL, s->records.tables_size};
    if (s->pieces->count == 0) return;
    parts[(*count)++] = (part){LIMN_CHUNK_PIECES, none, s->records.pieces,
                               s->pieces->count * sizeof *s->records.pieces};
    parts[(*count)++] =
        (part){LIMN_CHUNK_COLUMNS, none, s->records.columns, s->records.columns_size};
}

static void copy_tables(const shared *s, unsigned char *dst) {
    for (uint32_t c = 0; c < s->classes->count; c++) {
        const limni_class *const class = &s->classes->items[c];
        if (class->table)
            memcpy(dst + s->records.classes[c].table_offset, class->table,
                   limni_class_table_size(class));
    }
    for (uint32_t p = 0; p < s->pieces->count; p++)
        memcpy(dst + s->records.pieces[p].table_offset, s->pieces->items[p].table,
               limni_class_table_size(&s->pieces->items[p]));
}

/// A reader may pass over characters.
static uint32_t flags_of(const part *p) {
    const limn_file_chunk chunk = {.kind = p->kind, .mesh = p->mesh};
    return limni_is_character_chunk(&chunk) ? 0 : LIMN_CHUNK_REQUIRED;
}

/// Places the parts behind the directory. Returns the size of the file.
static uint64_t place_parts(const part *parts, uint32_t count, limn_file_chunk *directory) {
    uint64_t offset = sizeof(limn_file_header) + (uint64_t)count * sizeof *directory;
    for (uint32_t p = 0; p < count; p++) {
        offset = limni_align(offset);
        directory[p] = (limn_file_chunk){
            .kind = parts[p].kind,
            .mesh = parts[p].mesh,
            .flags = flags_of(&parts[p]),
            .offset = offset,
            .size = parts[p].size,
        };
        offset += parts[p].size;
    }
    return offset;
}

static void fill_blob(const shared *s, const part *parts, uint32_t count,
                      const limn_file_chunk *directory, limn_file_header *header,
                      unsigned char *blob) {
    for (uint32_t p = 0; p < count; p++) {
        unsigned char *const dst = blob + directory[p].offset;
        if (parts[p].kind == LIMN_CHUNK_TABLES) {
            copy_tables(s, dst);
        } else if (parts[p].size) {
            memcpy(dst, parts[p].data, (size_t)parts[p].size);
        }
    }
    memcpy(blob, header, sizeof *header);
    memcpy(blob + sizeof *header, directory, count * sizeof *directory);
    const size_t summed = offsetof(limn_file_header, chunk_count);
    header->checksum = limni_checksum(blob + summed, (size_t)header->size - summed);
    memcpy(blob, header, sizeof *header);
}

/// Lists meshes, and behind them their channels, and says there where those are.
static void list_meshes(limni_patches *meshes, uint32_t mesh_count, part *parts, uint32_t *count) {
    uint32_t channel = 0;
    for (uint32_t m = 0; m < mesh_count; m++) {
        limni_patches *const mesh = &meshes[m];
        list_mesh(mesh, m, parts, count);
        if (mesh->normals.records) list_normals(mesh, m, parts, count);
        list_rig(mesh, m, parts, count);
        mesh->record.first_channel = channel;
        for (uint32_t c = 0; c < mesh->record.channel_count; c++)
            list_channel(&mesh->channels[c], mesh_count + channel++, parts, count);
    }
}

static uint32_t count_channels(const limni_patches *meshes, uint32_t mesh_count) {
    uint32_t count = 0;
    for (uint32_t m = 0; m < mesh_count; m++)
        count += meshes[m].record.channel_count;
    return count;
}

/// The boundary rule of all meshes, or that they differ.
static const char *boundary_name(const limni_patches *meshes, uint32_t mesh_count) {
    static const char *const names[] = {[LIMN_BOUNDARY_EDGE_ONLY] = "edge-only",
                                        [LIMN_BOUNDARY_EDGE_AND_CORNER] = "edge-and-corner",
                                        [LIMN_BOUNDARY_NONE] = "none"};
    for (uint32_t m = 1; m < mesh_count; m++) {
        if (meshes[m].rules.boundary != meshes[0].rules.boundary) return "mixed";
    }
    return names[meshes[0].rules.boundary];
}

/// The creasing method of all meshes with sharp features, or that they differ; NULL: there are
/// none.
static const char *creasing_name(const limni_patches *meshes, uint32_t mesh_count) {
    const char *name = NULL;
    for (uint32_t m = 0; m < mesh_count; m++) {
        const bool chaikin = meshes[m].rules.creasing == LIMN_CREASING_CHAIKIN;
        const char *const own = chaikin ? "chaikin" : "uniform";
        if (!meshes[m].sharp) continue;
        if (name && strcmp(name, own) != 0) return "mixed";
        name = own;
    }
    return name;
}

/// Whether meshes are isolated, unless none is; and where that was chosen, the bytes and the time of
/// both ways.
static void describe_isolation(const limni_rules *rules, const limni_patches *meshes,
                               uint32_t mesh_count, char *text, size_t size) {
    unsigned long long bytes[2] = {0}, picoseconds[2] = {0};
    uint32_t count = 0;
    for (uint32_t m = 0; m < mesh_count; m++) {
        count += meshes[m].rules.isolate == LIMN_ISOLATE_ALWAYS;
        for (int way = 0; way < 2; way++) {
            const limni_footprint *const footprint = &meshes[m].footprints[way];
            bytes[way] += footprint->total;
            picoseconds[way] += limni_cost_frame(&footprint->cost, LIMNI_COST_LEVEL);
        }
    }
    const char *const isolated = count == 0 ? "0" : count == mesh_count ? "1" : "mixed";
    if (rules->isolate == LIMN_ISOLATE_AUTO && bytes[0]) {
        snprintf(text, size, " isolate=%s bytes=%llu isolated-bytes=%llu ns=%llu isolated-ns=%llu",
                 isolated, bytes[0], bytes[1], picoseconds[0] / 1000, picoseconds[1] / 1000);
    } else if (rules->isolate == LIMN_ISOLATE_AUTO) { // the butterfly, for which nothing is chosen
        snprintf(text, size, " isolate=0");
    } else {
        snprintf(text, size, "%s", count ? " isolate=1" : "");
    }
}

/// How the file was baked. Nothing here depends on the host or on the time.
static void describe(const limni_rules *rules, const limni_patches *meshes, uint32_t mesh_count,
                     char *text, size_t size) {
    static const char *const scheme_names[] = {[LIMN_SCHEME_LOOP] = "loop",
                                               [LIMN_SCHEME_CATMARK] = "catmark",
                                               [LIMN_SCHEME_BUTTERFLY] = "butterfly",
                                               [LIMN_SCHEME_NONE] = "none"};
    const char *const creasing =
        limni_scheme_has_creases(rules->scheme) ? creasing_name(meshes, mesh_count) : NULL;
    const char *const normals = rules->normals == LIMN_NORMALS_EXACT ? "exact" : "none";
    char creases[64] = "";
    if (rules->creases == LIMN_CREASES_LOMONT)
        strcpy(creases, " creases=lomont");
    else if (creasing)
        snprintf(creases, sizeof creases, " creases=opensubdiv creasing=%s", creasing);
    char isolate[160];
    describe_isolation(rules, meshes, mesh_count, isolate, sizeof isolate);
    char own[32] = ""; // what only this scheme has
    if (rules->scheme == LIMN_SCHEME_BUTTERFLY)
        snprintf(own, sizeof own, " tension=%.9g",
                 (double)rules->tension / (double)LIMNI_FIXED_ONE);
    else if (rules->scheme == LIMN_SCHEME_LOOP)
        snprintf(own, sizeof own, " weights=%s",
                 rules->weights == LIMN_WEIGHTS_WARREN ? "warren" : "loop");
    snprintf(text, size, "scheme=%s%s boundary=%s%s normals=%s%s", scheme_names[rules->scheme], own,
             boundary_name(meshes, mesh_count), creases, normals, isolate);
}

/// Chunks that there may be, at most.
static size_t count_room(const limni_patches *meshes, uint32_t mesh_count) {
    const size_t per_mesh =
        CHUNKS_OF_MESH + CHUNKS_OF_NORMALS + CHUNKS_OF_CREASES + CHUNKS_OF_POINTS + CHUNKS_OF_RIG;
    const size_t per_channel = CHUNKS_OF_CHANNEL + CHUNKS_OF_POINTS;
    return CHUNKS_OF_FILE + CHUNKS_OF_CHARACTER + per_mesh * mesh_count +
           per_channel * count_channels(meshes, mesh_count);
}

static limn_bake_status check_blob(limni_context *context, const unsigned char *blob, size_t size) {
    limn_pack pack;
    const limn_result result = limn_pack_open(&pack, blob, size);
    if (result == LIMN_OK) return LIMN_BAKE_OK;
    return limni_fail(context, LIMN_BAKE_INTERNAL, "defect in the baker: it made a bad file: %s",
                      limn_result_text(result));
}

limn_bake_status limni_write_blob(limni_context *context, const limni_rules *rules,
                                  const limni_classes *classes, const limni_classes *pieces,
                                  limni_patches *meshes, uint32_t mesh_count,
                                  const limni_character *character, unsigned char **blob,
                                  size_t *blob_size) {
    const size_t room = count_room(meshes, mesh_count);
    part *const parts = limni_allocate(context, room, sizeof *parts);
    limn_file_chunk *const directory = limni_allocate(context, room, sizeof *directory);
    shared all = {.classes = classes, .pieces = pieces};
    LIMNI_TRY(limni_records_make(context, classes, pieces, &all.records));
    if (!parts || !directory) return LIMN_BAKE_MEMORY;

    char info[384];
    uint32_t part_count = 0;
    describe(rules, meshes, mesh_count, info, sizeof info);
    list_shared(&all, info, parts, &part_count);
    list_character(character, parts, &part_count);
    list_meshes(meshes, mesh_count, parts, &part_count);
    qsort(parts, part_count, sizeof *parts, compare_parts);

    limn_file_header header = {
        .version = LIMN_FORMAT_VERSION,
        .size = place_parts(parts, part_count, directory),
        .chunk_count = part_count,
        .mesh_count = mesh_count,
        .class_count = classes->count,
        .channel_count = count_channels(meshes, mesh_count),
    };
    memcpy(header.magic, LIMN_FORMAT_MAGIC, sizeof header.magic);
    *blob = limni_allocate_zeroed(context, (size_t)header.size, 1);
    if (!*blob) return LIMN_BAKE_MEMORY;
    *blob_size = (size_t)header.size;
    fill_blob(&all, parts, part_count, directory, &header, *blob);
    LIMNI_TRY(check_blob(context, *blob, *blob_size));
    limni_release(context, parts);
    limni_release(context, directory);
    limni_records_release(context, &all.records);
    return LIMN_BAKE_OK;
}
