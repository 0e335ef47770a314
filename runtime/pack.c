/* SPDX-License-Identifier: MIT */
/*
 * Opening a file: every offset, count and index is checked here, once, so that nothing else in the
 * runtime needs to. The checks go from the outside in; each may rely on those before it.
 */
#include "character.h"
#include "checksum.h"
#include "chunks.h"
#include "mesh.h"
#include "require.h"

#include <string.h>

// ---- Chunks

static const uint32_t kinds_of_file[] = {LIMN_CHUNK_INFO, LIMN_CHUNK_CLASSES, LIMN_CHUNK_TABLES,
                                         LIMN_CHUNK_PIECES, LIMN_CHUNK_COLUMNS};
/// Of meshes, and of channels, which lack the last two.
static const uint32_t kinds_of_mesh[] = {LIMN_CHUNK_MESH,  LIMN_CHUNK_NAME,    LIMN_CHUNK_CONTROLS,
                                         LIMN_CHUNK_RUNS,  LIMN_CHUNK_INDICES, LIMN_CHUNK_SLOTS,
                                         LIMN_CHUNK_FACES, LIMN_CHUNK_ERRORS};
enum { KINDS_OF_MESH = sizeof kinds_of_mesh / sizeof *kinds_of_mesh };

static const uint32_t optional_kinds[] = {
    LIMN_CHUNK_NORMALS,  LIMN_CHUNK_RINGS, LIMN_CHUNK_WEIGHTS,
    LIMN_CHUNK_CREASES,  LIMN_CHUNK_SIDES, LIMN_CHUNK_CORNERS,
    LIMN_CHUNK_STENCILS, LIMN_CHUNK_TERMS, LIMN_CHUNK_CHANNEL};

static bool is_among(uint32_t kind, const uint32_t *kinds, size_t count) {
    for (size_t k = 0; k < count; k++) {
        if (kind == kinds[k]) return true;
    }
    return false;
}

static bool is_known(const limn_file_chunk *chunk) {
    if (limni_is_character_chunk(chunk)) return true;
    if (chunk->mesh == LIMN_FORMAT_NO_MESH)
        return is_among(chunk->kind, kinds_of_file, sizeof kinds_of_file / sizeof(uint32_t));
    return is_among(chunk->kind, kinds_of_mesh, KINDS_OF_MESH) ||
           is_among(chunk->kind, optional_kinds, sizeof optional_kinds / sizeof(uint32_t));
}

// ---- Validation of the file

static bool host_is_little_endian(void) {
    const uint32_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 1;
}

static limn_result validate_header(const limn_pack *pack) {
    const limn_file_header *const header = header_of(pack);
    if (!host_is_little_endian()) return LIMN_ERROR_HOST;
    if ((uintptr_t)pack->blob % LIMN_FORMAT_ALIGNMENT != 0) return LIMN_ERROR_ALIGNMENT;
    if (pack->blob_size < sizeof *header) return LIMN_ERROR_TRUNCATED;
    if (memcmp(header->magic, LIMN_FORMAT_MAGIC, sizeof header->magic) != 0)
        return LIMN_ERROR_MAGIC;
    if (header->version < LIMN_FORMAT_VERSION_OLDEST || header->version > LIMN_FORMAT_VERSION)
        return LIMN_ERROR_VERSION;
    if (header->size > pack->blob_size) return LIMN_ERROR_TRUNCATED;
    if (header->size < pack->blob_size) return LIMN_ERROR_SIZE;

    const size_t summed = offsetof(limn_file_header, chunk_count);
    if (header->checksum != limni_checksum(bytes_at(pack, summed), pack->blob_size - summed))
        return LIMN_ERROR_CHECKSUM;
    return LIMN_OK;
}

static limn_result validate_directory(const limn_pack *pack) {
    const limn_file_header *const header = header_of(pack);
    const uint64_t room = pack->blob_size - sizeof *header;
    const uint64_t record_count = (uint64_t)header->mesh_count + header->channel_count;
    if (room / sizeof(limn_file_chunk) < header->chunk_count) return LIMN_ERROR_CHUNK;

    uint64_t last_key = 0, end = sizeof *header + header->chunk_count * sizeof(limn_file_chunk);
    for (uint32_t c = 0; c < header->chunk_count; c++) {
        const limn_file_chunk *const chunk = &directory_of(pack)[c];
        const uint64_t key = limn_file_chunk_key(chunk->mesh, chunk->kind);
        if (c > 0 && key <= last_key) return LIMN_ERROR_CHUNK;
        last_key = key;
        if (chunk->mesh != LIMN_FORMAT_NO_MESH && chunk->mesh >= record_count)
            return LIMN_ERROR_CHUNK;
        if (chunk->offset % LIMN_FORMAT_ALIGNMENT != 0 || chunk->offset > pack->blob_size ||
            chunk->size > pack->blob_size - chunk->offset)
            return LIMN_ERROR_CHUNK;
        if (chunk->flags & LIMN_CHUNK_REQUIRED && !is_known(chunk)) return LIMN_ERROR_UNKNOWN_CHUNK;
        if (chunk->size == 0) continue;
        if (chunk->offset < end) return LIMN_ERROR_CHUNK;
        end = chunk->offset + chunk->size; // no two overlap: validation stays linear
    }
    return LIMN_OK;
}

static limn_result validate_text(const limn_pack *pack, uint32_t mesh, uint32_t kind) {
    const limn_file_chunk *const chunk = find_chunk(pack, mesh, kind);
    if (!chunk) return LIMN_ERROR_CHUNK;
    const unsigned char *const text = bytes_at(pack, chunk->offset);
    if (chunk->size == 0 || text[chunk->size - 1] != '\0') return LIMN_ERROR_TEXT;
    return LIMN_OK;
}

// ---- Validation of the tables

/// Whether tables of that shape lie inside the tables chunk.
static bool are_tables_inside(const limn_file_chunk *tables, uint64_t offset, uint32_t table_count,
                              uint32_t control_count, uint32_t row_stride) {
    const uint64_t column_size = row_stride * sizeof(float);
    return offset % LIMN_FORMAT_ALIGNMENT == 0 && offset <= tables->size &&
           (table_count == 1 || table_count == 3) &&
           (uint64_t)table_count * control_count <= (tables->size - offset) / column_size;
}

static limn_result validate_pieces(const limn_pack *pack, const limn_file_chunk *tables) {
    const limn_file_chunk *const chunk = find_chunk(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_PIECES);
    if (chunk && (chunk->size != pack->piece_count * sizeof(limn_file_piece) ||
                  pack->piece_count > LIMN_FORMAT_PIECES_MAX))
        return LIMN_ERROR_PIECE;
    for (uint32_t p = 0; p < pack->piece_count; p++) {
        const limn_file_piece *const piece = &pack->pieces[p];
        if (piece->domain >= LIMN_DOMAIN_COUNT || piece->kind > LIMNI_PIECE_MIDDLE ||
            piece->control_count > LIMN_FORMAT_CONTROLS_MAX ||
            !are_tables_inside(tables, piece->table_offset, piece->table_count,
                               piece->control_count, limn_file_piece_stride(piece)))
            return LIMN_ERROR_PIECE;
    }
    return LIMN_OK;
}

static limn_result validate_columns(const uint16_t *columns, uint32_t count,
                                    uint32_t column_count) {
    for (uint32_t slot = 0; slot < count; slot++) {
        if (columns[slot] >= column_count && columns[slot] != LIMN_FORMAT_NO_COLUMN)
            return LIMN_ERROR_PIECE;
    }
    return LIMN_OK;
}

/// A class that is made of pieces.
static limn_result validate_parts(const limn_pack *pack, const limn_file_class *class) {
    const limn_file_chunk *const chunk = find_chunk(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_COLUMNS);
    const uint64_t size = limn_file_columns_size(class) * sizeof(uint16_t);
    const limn_domain *const domain = limn_domain_get((limn_domain_kind) class->domain);
    if (!chunk || class->pair_count || class->table_offset % sizeof(uint16_t) != 0 ||
        class->table_offset > chunk->size || size > chunk->size - class->table_offset)
        return LIMN_ERROR_PIECE;
    const uint16_t *const words =
        (const uint16_t *)(const void *)bytes_at(pack, chunk->offset + class->table_offset);
    const uint16_t *columns = words + LIMN_FORMAT_PIECE_COUNT;
    for (uint32_t p = 0; p < LIMN_FORMAT_PIECE_COUNT; p++, columns += class->control_count) {
        if (words[p] >= pack->piece_count) return LIMN_ERROR_PIECE;
        const limn_file_piece *const piece = &pack->pieces[words[p]];
        if (piece->domain != class->domain || piece->kind != limni_piece_kind_of(domain, p) ||
            piece->table_count < class->table_count)
            return LIMN_ERROR_PIECE;
        TRY(validate_columns(columns, class->control_count, piece->control_count));
    }
    return LIMN_OK;
}

static limn_result validate_class(const limn_pack *pack, const limn_file_chunk *tables,
                                  const limn_file_class *class) {
    if (class->domain >= LIMN_DOMAIN_COUNT || class->control_count > LIMN_FORMAT_CONTROLS_MAX ||
        !all_finite(&class->negative, 1) || class->negative < 0)
        return LIMN_ERROR_CLASS;
    const limn_domain *const domain = limn_domain_get((limn_domain_kind) class->domain);
    if (class->control_count < domain->corner_count) return LIMN_ERROR_CLASS;
    if (class->depth == LIMN_FORMAT_PIECE_DEPTH) return validate_parts(pack, class);
    if (class->depth != LIMN_FORMAT_DEPTH) return LIMN_ERROR_CLASS;
    if (class->pair_count &&
        (class->domain == LIMN_DOMAIN_QUAD || class->control_count > LIMN_FORMAT_PAIRED_MAX ||
         2u * class->pair_count >= class->control_count))
        return LIMN_ERROR_CLASS;
    return are_tables_inside(tables, class->table_offset, class->table_count, class->control_count,
                             limn_file_row_stride(class))
               ? LIMN_OK
               : LIMN_ERROR_CLASS;
}

static limn_result validate_classes(const limn_pack *pack) {
    if (!chunk_has_size(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLASSES, pack->class_count,
                        sizeof(limn_file_class)))
        return LIMN_ERROR_CHUNK;
    const limn_file_chunk *const tables = find_chunk(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES);
    if (!tables || tables->size % sizeof(float) != 0) return LIMN_ERROR_CHUNK;

    const limn_file_class *const classes =
        chunk_data(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLASSES);
    TRY(validate_pieces(pack, tables));
    for (uint32_t c = 0; c < pack->class_count; c++)
        TRY(validate_class(pack, tables, &classes[c]));
    if (!all_finite((const float *)(const void *)bytes_at(pack, tables->offset),
                    (size_t)tables->size / sizeof(float)))
        return LIMN_ERROR_TABLE;
    return LIMN_OK;
}

// ---- Validation of a mesh

static uint32_t base_count(const limn_file_mesh *record) {
    return record->divided_count ? record->divided_count : record->control_count;
}

/// The base vertices end at the last point; or points of a further level follow, at least one for
/// each.
static bool are_points_right(const limn_file_mesh *record) {
    const uint64_t base_end = (uint64_t)record->control_count + record->divided_count;
    return record->point_count == base_end || record->point_count >= base_end + base_count(record);
}

static limn_result validate_sizes(const limn_pack *pack, uint32_t m) {
    if (!chunk_has_size(pack, m, LIMN_CHUNK_MESH, 1, sizeof(limn_file_mesh)))
        return LIMN_ERROR_MESH;
    const limn_file_mesh *const record = chunk_data(pack, m, LIMN_CHUNK_MESH);
    if (record->domain >= LIMN_DOMAIN_COUNT || !are_points_right(record) ||
        record->hole_count > UINT32_MAX - record->patch_count ||
        !chunk_has_size(pack, m, LIMN_CHUNK_CONTROLS, record->point_count, 3 * sizeof(float)) ||
        !chunk_has_size(pack, m, LIMN_CHUNK_RUNS, record->run_count, sizeof(limn_file_run)) ||
        !chunk_has_size(pack, m, LIMN_CHUNK_INDICES, record->index_count, sizeof(uint32_t)))
        return LIMN_ERROR_MESH;
    return LIMN_OK;
}

static limn_result validate_mesh_sizes(const limn_pack *pack, uint32_t m) {
    TRY(validate_sizes(pack, m));
    const limn_file_mesh *const record = chunk_data(pack, m, LIMN_CHUNK_MESH);
    const limn_domain *const domain = limn_domain_get((limn_domain_kind)record->domain);
    return chunk_has_size(pack, m, LIMN_CHUNK_FACES, record->patch_count, sizeof(uint32_t)) &&
                   chunk_has_size(pack, m, LIMN_CHUNK_ERRORS, record->patch_count,
                                  domain->corner_count * sizeof(uint16_t))
               ? LIMN_OK
               : LIMN_ERROR_MESH;
}

/// Runs follow one another without gaps, in patches, in indices and in slots, and use up all of
/// them.
static limn_result validate_runs(const limn_pack *pack, const limn_mesh *mesh, uint64_t index_count,
                                 uint64_t slots_size) {
    uint64_t patch = 0, index = 0, slot = 0;
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        const limn_file_run *const run = &mesh->runs[r];
        if (run->class_index >= pack->class_count) return LIMN_ERROR_RUN;
        const limn_file_class *const class = &mesh->classes[run->class_index];
        const uint32_t slot_size = limn_file_slot_size(class);
        slot += slot % slot_size;
        const bool in_pieces = class->depth == LIMN_FORMAT_PIECE_DEPTH;
        if (class->domain != mesh->domain->kind || run->patch_count == 0 ||
            in_pieces != limni_is_isolated(mesh) || run->first_patch != patch ||
            run->first_index != index || run->first_slot != slot)
            return LIMN_ERROR_RUN;
        const uint64_t count = (uint64_t)run->patch_count * class->control_count;
        if (slot > slots_size || count > index_count - index ||
            count * slot_size > slots_size - slot)
            return LIMN_ERROR_RUN;
        patch += run->patch_count;
        index += count;
        slot += count * slot_size;
    }
    if (patch != mesh->patch_count || index != index_count || slot != slots_size)
        return LIMN_ERROR_RUN;
    return LIMN_OK;
}

static uint32_t slot_at(const uint8_t *slots, uint32_t slot_size, uint32_t k) {
    return slot_size == 1 ? slots[k] : slots[2 * k] | (uint32_t)slots[2 * k + 1] << 8;
}

/// What indices of a class may be.
typedef struct index_range {
    uint32_t corner_count;
    uint32_t begin, corner_end, end; ///< of corners and of all
} index_range;

/// The slots name the control points of a patch in strictly ascending order. So each is named once,
/// and there is none but those.
static limn_result validate_patch(const uint32_t *indices, const uint8_t *slots, uint32_t slot_size,
                                  uint32_t count, const index_range *range) {
    bool inside = true, ascending = true;
    uint32_t last = 0;
    for (uint32_t k = 0; k < count; k++)
        inside &= slot_at(slots, slot_size, k) < count;
    if (!inside) return LIMN_ERROR_SLOT;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t index = indices[slot_at(slots, slot_size, k)];
        ascending &= k == 0 ? index >= range->begin : index > last;
        last = index;
    }
    for (uint32_t corner = 0; corner < range->corner_count; corner++)
        ascending &= indices[corner] < range->corner_end;
    return ascending && last < range->end ? LIMN_OK : LIMN_ERROR_INDEX;
}

static limn_result validate_patches(const limn_mesh *mesh, const limn_file_run *run) {
    const limn_file_class *const class = &mesh->classes[run->class_index];
    const uint32_t count = class->control_count, slot_size = limn_file_slot_size(class);
    const uint32_t *indices = mesh->indices + run->first_index;
    const uint8_t *slots = mesh->slots + run->first_slot;
    const uint32_t first_corner = limni_first_corner(mesh);
    const index_range range = {.corner_count = mesh->domain->corner_count,
                               .begin = first_corner,
                               .corner_end = first_corner + mesh->base_count,
                               .end = mesh->point_count};
    for (uint32_t p = 0; p < run->patch_count; p++) {
        TRY(validate_patch(indices, slots, slot_size, count, &range));
        indices += count;
        slots += (size_t)count * slot_size;
    }
    return LIMN_OK;
}

static limn_result validate_faces(const limn_mesh *mesh) {
    for (uint32_t p = 0; p < mesh->patch_count; p++) {
        const limn_patch_face face = limn_mesh_face(mesh, p);
        if (face.face >= mesh->face_count || face.rotation >= mesh->domain->corner_count)
            return LIMN_ERROR_FACE;
    }
    return LIMN_OK;
}

/// Points behind the control points have stencils, of points before them.
static limn_result validate_stencils(const limn_pack *pack, const limn_mesh *mesh, uint32_t m) {
    const limn_file_chunk *const chunk = find_chunk(pack, m, LIMN_CHUNK_TERMS);
    const uint32_t count = mesh->point_count - mesh->control_count;
    if (!mesh->stencils != !chunk || !chunk != !count) return LIMN_ERROR_CHUNK;
    if (!chunk) return LIMN_OK;
    const uint64_t term_count = chunk->size / sizeof(limn_file_term);
    if (!chunk_has_size(pack, m, LIMN_CHUNK_STENCILS, (uint64_t)count + 1, sizeof(uint32_t)) ||
        chunk->size % sizeof(limn_file_term) != 0 || mesh->stencils[0] != 0 ||
        mesh->stencils[count] != term_count)
        return LIMN_ERROR_STENCIL;
    for (uint32_t point = 0; point < count; point++) {
        if (mesh->stencils[point] > mesh->stencils[point + 1]) return LIMN_ERROR_STENCIL;
    }
    const limn_file_term *term = mesh->terms;
    for (uint32_t point = 0; point < count; point++) {
        for (; term < mesh->terms + mesh->stencils[point + 1]; term++) {
            if (term->point >= mesh->control_count + point || !all_finite(&term->weight, 1))
                return LIMN_ERROR_STENCIL;
        }
    }
    return LIMN_OK;
}

static bool are_weights_inside(const limn_file_normal *normal, uint64_t weight_count) {
    return normal->first_weight + 2 * (uint64_t)normal->ring_count <= weight_count;
}

static limn_result validate_creases(const limn_pack *pack, const limn_mesh *mesh, uint32_t m) {
    const uint32_t edge_bits = (1u << mesh->domain->corner_count) - 1;
    if (!mesh->creases) return LIMN_OK;
    if (!chunk_has_size(pack, m, LIMN_CHUNK_CREASES, mesh->patch_count, 1)) return LIMN_ERROR_MESH;
    for (uint32_t p = 0; p < mesh->patch_count; p++) {
        if (mesh->creases[p] & ~edge_bits) return LIMN_ERROR_MESH;
    }
    return LIMN_OK;
}

/// The rings of base vertices follow one another and use up the chunk: normals take linear time.
static limn_result validate_rings(const limn_mesh *mesh, uint64_t ring_size,
                                  uint64_t weight_count) {
    uint64_t ring = 0;
    for (uint32_t c = 0; c < mesh->base_count; c++) {
        if (mesh->normals[c].first_ring != ring ||
            !are_weights_inside(&mesh->normals[c], weight_count))
            return LIMN_ERROR_NORMALS;
        ring += mesh->normals[c].ring_count;
    }
    if (ring != ring_size) return LIMN_ERROR_NORMALS;
    for (uint64_t r = 0; r < ring_size; r++) {
        if (mesh->ring[r] >= mesh->base_first + mesh->base_count) return LIMN_ERROR_NORMALS;
    }
    return LIMN_OK;
}

/// A side has the ring of its base vertex, which is no longer than patches have points.
static bool is_side_right(const limn_mesh *mesh, const limn_file_side *side,
                          uint64_t weight_count) {
    const uint32_t base = side->point - mesh->base_first;
    return base < mesh->base_count && side->normal.first_ring == mesh->normals[base].first_ring &&
           side->normal.ring_count == mesh->normals[base].ring_count &&
           side->normal.ring_count <= 2 * LIMN_FORMAT_CONTROLS_MAX &&
           are_weights_inside(&side->normal, weight_count);
}

/// A mesh has sides and which corners take them, or neither.
static limn_result validate_sides(const limn_pack *pack, const limn_mesh *mesh, uint32_t m,
                                  uint64_t weight_count) {
    const uint32_t corner_count = mesh->domain->corner_count;
    if (!mesh->sides != !mesh->corner_normals) return LIMN_ERROR_CHUNK;
    if (!mesh->sides) return LIMN_OK;
    if (!chunk_has_size(pack, m, LIMN_CHUNK_SIDES, mesh->normal_count - mesh->base_count,
                        sizeof *mesh->sides) ||
        !chunk_has_size(pack, m, LIMN_CHUNK_CORNERS, mesh->patch_count,
                        corner_count * sizeof(uint32_t)))
        return LIMN_ERROR_MESH;
    for (uint32_t s = 0; s < mesh->normal_count - mesh->base_count; s++) {
        if (!is_side_right(mesh, &mesh->sides[s], weight_count)) return LIMN_ERROR_NORMALS;
    }
    for (uint64_t c = 0; c < (uint64_t)mesh->patch_count * corner_count; c++) {
        if (mesh->corner_normals[c] >= mesh->normal_count) return LIMN_ERROR_NORMALS;
    }
    return LIMN_OK;
}

/// A mesh has all of it or nothing, and with it tangents in all the classes that it uses.
static limn_result validate_normals(const limn_pack *pack, const limn_mesh *mesh, uint32_t m) {
    if (!mesh->normals) return mesh->sides || mesh->corner_normals ? LIMN_ERROR_CHUNK : LIMN_OK;
    const limn_file_chunk *const rings = find_chunk(pack, m, LIMN_CHUNK_RINGS);
    const limn_file_chunk *const weights = find_chunk(pack, m, LIMN_CHUNK_WEIGHTS);
    if (!rings || !weights) return LIMN_ERROR_CHUNK;
    if (!chunk_has_size(pack, m, LIMN_CHUNK_NORMALS, mesh->base_count, sizeof *mesh->normals))
        return LIMN_ERROR_MESH;
    const uint64_t ring_size = rings->size / sizeof(uint32_t);
    const uint64_t weight_count = weights->size / sizeof(float);
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        if (mesh->classes[mesh->runs[r].class_index].table_count != 3) return LIMN_ERROR_NORMALS;
    }
    TRY(validate_rings(mesh, ring_size, weight_count));
    TRY(validate_sides(pack, mesh, m, weight_count));
    return all_finite(mesh->weights, (size_t)weight_count) ? LIMN_OK : LIMN_ERROR_NORMALS;
}

static limn_mesh view(const limn_pack *pack, uint32_t m);

static limn_result validate_kinds(const limn_pack *pack, uint32_t m, uint32_t kind_count) {
    for (uint32_t k = 0; k < kind_count; k++) {
        if (!find_chunk(pack, m, kinds_of_mesh[k])) return LIMN_ERROR_CHUNK;
    }
    return validate_text(pack, m, LIMN_CHUNK_NAME);
}

/// What meshes and channels have, once their sizes are right.
static limn_result validate_points_and_patches(const limn_pack *pack, const limn_mesh *mesh,
                                               uint32_t m) {
    const limn_file_mesh *const record = chunk_data(pack, m, LIMN_CHUNK_MESH);
    if (!all_finite(mesh->controls, (size_t)mesh->point_count * 3) ||
        !all_finite(mesh->bounds_min, 3) || !all_finite(mesh->bounds_max, 3) ||
        !all_finite(mesh->origin, 3))
        return LIMN_ERROR_CONTROLS;
    TRY(validate_runs(pack, mesh, record->index_count,
                      find_chunk(pack, m, LIMN_CHUNK_SLOTS)->size));
    for (uint32_t r = 0; r < mesh->run_count; r++)
        TRY(validate_patches(mesh, &mesh->runs[r]));
    return validate_stencils(pack, mesh, m);
}

static limn_result validate_mesh(const limn_pack *pack, uint32_t m) {
    TRY(validate_kinds(pack, m, KINDS_OF_MESH));
    TRY(validate_mesh_sizes(pack, m));
    if (find_chunk(pack, m, LIMN_CHUNK_CHANNEL)) return LIMN_ERROR_CHUNK;
    const limn_mesh mesh = view(pack, m);
    TRY(validate_points_and_patches(pack, &mesh, m));
    TRY(validate_faces(&mesh));
    TRY(validate_creases(pack, &mesh, m));
    return validate_normals(pack, &mesh, m);
}

// ---- Validation of channels

/// Whether its patches can be those of the mesh.
static bool fits_mesh(const limn_file_mesh *channel, const limn_mesh *mesh) {
    return channel->domain == (uint32_t)mesh->domain->kind &&
           channel->patch_count == mesh->patch_count &&
           channel->hole_count == mesh->face_count - mesh->patch_count &&
           channel->first_channel == 0 && channel->channel_count == 0;
}

/// Chunk `m` of the file's meshes and channels, which belongs to `mesh`.
static limn_result validate_channel(const limn_pack *pack, const limn_mesh *mesh, uint32_t m) {
    TRY(validate_kinds(pack, m, KINDS_OF_MESH - 2));
    TRY(validate_sizes(pack, m));
    if (!chunk_has_size(pack, m, LIMN_CHUNK_CHANNEL, 1, sizeof(limn_file_channel)) ||
        find_chunk(pack, m, LIMN_CHUNK_FACES) || find_chunk(pack, m, LIMN_CHUNK_ERRORS))
        return LIMN_ERROR_CHUNK;
    const limn_file_channel *const record = chunk_data(pack, m, LIMN_CHUNK_CHANNEL);
    if (record->kind > LIMN_CHANNEL_COLOUR || record->component_count < 1 ||
        record->component_count > 3 || !fits_mesh(chunk_data(pack, m, LIMN_CHUNK_MESH), mesh))
        return LIMN_ERROR_CHANNEL;
    const limn_mesh channel = view(pack, m);
    if (channel.normals || channel.creases || channel.sides || channel.corner_normals)
        return LIMN_ERROR_CHUNK;
    return validate_points_and_patches(pack, &channel, m);
}

/// The channels of meshes follow one another, and there are no others.
static limn_result validate_channels(const limn_pack *pack) {
    const uint32_t count = header_of(pack)->channel_count;
    uint32_t first = 0;
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const limn_mesh mesh = view(pack, m);
        if (mesh.first_channel != first || mesh.channel_count > count - first)
            return LIMN_ERROR_CHANNEL;
        for (uint32_t c = 0; c < mesh.channel_count; c++)
            TRY(validate_channel(pack, &mesh, pack->mesh_count + first++));
    }
    return first == count ? LIMN_OK : LIMN_ERROR_CHANNEL;
}

// ---- The public functions

limn_result limn_pack_open(limn_pack *pack, const void *blob, size_t blob_size) {
    LIMNI_REQUIRE(pack && (blob || blob_size == 0), LIMN_ERROR_TRUNCATED);
    limn_pack opened = {.blob = blob, .blob_size = blob_size};
    TRY(validate_header(&opened));
    opened.mesh_count = header_of(&opened)->mesh_count;
    opened.class_count = header_of(&opened)->class_count;
    TRY(validate_directory(&opened));
    TRY(validate_text(&opened, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_INFO));
    const limn_file_chunk *const pieces =
        find_chunk(&opened, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_PIECES);
    opened.pieces = optional_data(&opened, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_PIECES);
    opened.piece_count = pieces ? (uint32_t)(pieces->size / sizeof(limn_file_piece)) : 0;
    TRY(validate_classes(&opened));
    opened.classes = chunk_data(&opened, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLASSES);
    for (uint32_t m = 0; m < opened.mesh_count; m++)
        TRY(validate_mesh(&opened, m));
    TRY(validate_channels(&opened));
    TRY(limni_validate_character(&opened));
    opened.info = chunk_data(&opened, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_INFO);
    opened.kernels = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_REPRODUCIBLE);
    *pack = opened;
    return LIMN_OK;
}

static uint32_t side_count(const limn_pack *pack, uint32_t mesh_index) {
    const limn_file_chunk *const chunk = find_chunk(pack, mesh_index, LIMN_CHUNK_SIDES);
    return chunk ? (uint32_t)(chunk->size / sizeof(limn_file_side)) : 0;
}

/// A mesh, or what a channel is without that to which it belongs.
static limn_mesh view(const limn_pack *pack, uint32_t mesh_index) {
    const limn_file_mesh *const record = chunk_data(pack, mesh_index, LIMN_CHUNK_MESH);
    limn_mesh mesh = {
        .name = chunk_data(pack, mesh_index, LIMN_CHUNK_NAME),
        .domain = limn_domain_get((limn_domain_kind)record->domain),
        .controls = chunk_data(pack, mesh_index, LIMN_CHUNK_CONTROLS),
        .control_count = record->control_count,
        .base_first = record->divided_count ? record->control_count : 0,
        .base_count = base_count(record),
        .point_count = record->point_count,
        .patch_count = record->patch_count,
        .face_count = record->patch_count + record->hole_count,
        .run_count = record->run_count,
        .first_channel = record->first_channel,
        .channel_count = record->channel_count,
        .faces = optional_data(pack, mesh_index, LIMN_CHUNK_FACES),
        .indices = chunk_data(pack, mesh_index, LIMN_CHUNK_INDICES),
        .slots = chunk_data(pack, mesh_index, LIMN_CHUNK_SLOTS),
        .errors = optional_data(pack, mesh_index, LIMN_CHUNK_ERRORS),
        .tables = chunk_data(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES),
        .runs = chunk_data(pack, mesh_index, LIMN_CHUNK_RUNS),
        .classes = pack->classes,
        .pieces = pack->pieces,
        .columns = optional_data(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_COLUMNS),
        .stencils = optional_data(pack, mesh_index, LIMN_CHUNK_STENCILS),
        .terms = optional_data(pack, mesh_index, LIMN_CHUNK_TERMS),
        .normals = optional_data(pack, mesh_index, LIMN_CHUNK_NORMALS),
        .ring = optional_data(pack, mesh_index, LIMN_CHUNK_RINGS),
        .weights = optional_data(pack, mesh_index, LIMN_CHUNK_WEIGHTS),
        .creases = optional_data(pack, mesh_index, LIMN_CHUNK_CREASES),
        .sides = optional_data(pack, mesh_index, LIMN_CHUNK_SIDES),
        .corner_normals = optional_data(pack, mesh_index, LIMN_CHUNK_CORNERS),
        .kernels = pack->kernels,
    };
    if (mesh.normals) mesh.normal_count = mesh.base_count + side_count(pack, mesh_index);
    memcpy(mesh.bounds_min, record->bounds_min, sizeof mesh.bounds_min);
    memcpy(mesh.bounds_max, record->bounds_max, sizeof mesh.bounds_max);
    memcpy(mesh.origin, record->origin, sizeof mesh.origin);
    return mesh;
}

limn_mesh limn_pack_mesh(const limn_pack *pack, uint32_t mesh_index) {
    LIMNI_REQUIRE(pack && mesh_index < pack->mesh_count, (limn_mesh){0});
    return view(pack, mesh_index);
}

limn_channel limn_mesh_channel(const limn_pack *pack, const limn_mesh *mesh,
                               uint32_t channel_index) {
    LIMNI_REQUIRE(pack && mesh && channel_index < mesh->channel_count, (limn_channel){0});
    const uint32_t m = pack->mesh_count + mesh->first_channel + channel_index;
    const limn_file_channel *const record = chunk_data(pack, m, LIMN_CHUNK_CHANNEL);
    limn_channel channel = {
        .kind = (limn_channel_kind)record->kind,
        .component_count = record->component_count,
        .face_varying = record->face_varying,
        .mesh = view(pack, m),
    };
    channel.mesh.faces = mesh->faces;
    channel.mesh.errors = mesh->errors;
    return channel;
}
