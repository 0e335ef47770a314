/* SPDX-License-Identifier: MIT */
/* Faces on their own, before they are connected: what is degenerate or repeated, and welding. */
#include "hash.h"
#include "mesh.h"
#include "rig.h"

#include <stdlib.h>
#include <string.h>

static const char *file_of(const limni_source *source) {
    return source->path ? source->path : source->name;
}

static uint32_t size_of(const limni_source *source, uint32_t face) {
    return source->face_offsets[face + 1] - source->face_offsets[face];
}

static uint32_t *corners_of(const limni_source *source, uint32_t face) {
    return source->face_corners + source->face_offsets[face];
}

static void fail_at(limni_context *context, const limni_source *source, uint32_t face,
                    const char *text) {
    if (source->face_lines) {
        limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s:%u: %s", file_of(source),
                   source->face_lines[face], text);
    } else {
        limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: face %u: %s", file_of(source),
                   source->face_numbers[face], text);
    }
}

// ---- Weld

static uint64_t value_hash(const float value[3]) {
    uint32_t bits[3];
    memcpy(bits, value, sizeof bits);
    return limni_hash_mix(limni_hash_mix(bits[0], bits[1]), bits[2]);
}

/// Faces and tags follow the control points that they name.
static void follow(limni_source *source, const uint32_t *moved) {
    limni_tags *const tags = &source->tags;
    for (uint32_t c = 0; c < source->face_offsets[source->face_count]; c++)
        source->face_corners[c] = moved[source->face_corners[c]];
    for (uint32_t c = 0; c < tags->crease_count; c++) {
        tags->creases[c].a = moved[tags->creases[c].a];
        tags->creases[c].b = moved[tags->creases[c].b];
    }
    for (uint32_t v = 0; v < tags->sharp_vertex_count; v++)
        tags->sharp_vertices[v].position = moved[tags->sharp_vertices[v].position];
}

limn_bake_status limni_merge_equal(limni_context *context, float (*values)[3], uint32_t *count,
                                   uint32_t *moved, uint32_t *numbers) {
    const uint32_t size = limni_hash_size(*count);
    uint32_t *const table = limni_allocate(context, size, sizeof *table);
    if (!table) return LIMN_BAKE_MEMORY;
    memset(table, 0xff, size * sizeof *table);
    uint32_t kept = 0;
    for (uint32_t v = 0; v < *count; v++) {
        for (int axis = 0; axis < 3; axis++)
            values[v][axis] += 0.0f; // -0 and 0 are one value
        uint32_t at = (uint32_t)value_hash(values[v]) & (size - 1);
        while (table[at] != LIMNI_NONE && memcmp(values[table[at]], values[v], sizeof *values) != 0)
            at = (at + 1) & (size - 1);
        if (table[at] == LIMNI_NONE) {
            table[at] = kept;
            memmove(values[kept], values[v], sizeof *values);
            if (numbers) numbers[kept] = v;
            kept++;
        }
        moved[v] = table[at];
    }
    *count = kept;
    limni_release(context, table);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_weld_channel(limni_context *context, limni_source_channel *channel,
                                    uint32_t corner_count) {
    uint32_t *const moved = limni_allocate(context, channel->value_count, sizeof *moved);
    if (!moved) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_merge_equal(context, channel->values, &channel->value_count, moved, NULL));
    for (uint32_t c = 0; c < corner_count; c++)
        channel->corner_values[c] = moved[channel->corner_values[c]];
    limni_release(context, moved);
    return LIMN_BAKE_OK;
}

/// Merges control points with equal positions into the first of them. Numbers, and with them the
/// lines, move up.
static limn_bake_status weld_positions(limni_context *context, limni_source *source) {
    const uint32_t count = source->position_count;
    uint32_t *const moved = limni_allocate(context, count, sizeof *moved);
    source->position_numbers = limni_allocate(context, count, sizeof *source->position_numbers);
    if (!moved || !source->position_numbers) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_merge_equal(context, source->positions, &source->position_count, moved,
                                source->position_numbers));
    for (uint32_t p = 0; p < source->position_count && source->position_lines; p++)
        source->position_lines[p] = source->position_lines[source->position_numbers[p]];
    limni_rig_keep(&source->rig, source->position_numbers, source->position_count);
    follow(source, moved);
    if (source->position_count < count)
        limni_note(context, "%s: repaired: %u control points welded into others", file_of(source),
                   count - source->position_count);
    limni_release(context, moved);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_weld(limni_context *context, limni_source *source) {
    LIMNI_TRY(weld_positions(context, source));
    const uint32_t corner_count = source->face_offsets[source->face_count];
    for (uint32_t c = 0; c < source->channel_count; c++) {
        limni_source_channel *const channel = &source->channels[c];
        const uint32_t count = channel->value_count;
        LIMNI_TRY(limni_weld_channel(context, channel, corner_count));
        if (channel->value_count < count)
            limni_note(context, "%s: repaired: %u values of %s welded into others", file_of(source),
                       count - channel->value_count, channel->name);
    }
    return LIMN_BAKE_OK;
}

// ---- Degenerate faces

static bool uses_twice(const uint32_t *corners, uint32_t size) {
    for (uint32_t a = 0; a < size; a++) {
        for (uint32_t b = a + 1; b < size; b++) {
            if (corners[a] == corners[b]) return true;
        }
    }
    return false;
}

/// Moves corners of faces towards the front, with their values.
static void move_corners(limni_source *source, uint32_t to, uint32_t from, uint32_t count) {
    const size_t size = count * sizeof(uint32_t);
    memmove(source->face_corners + to, source->face_corners + from, size);
    for (uint32_t c = 0; c < source->channel_count; c++) {
        uint32_t *const values = source->channels[c].corner_values;
        memmove(values + to, values + from, size);
    }
}

/// Removes corners that repeat the one before them, around the face. Returns the new size.
static uint32_t remove_repeats(limni_source *source, uint32_t first, uint32_t size) {
    const uint32_t *const corners = source->face_corners + first;
    uint32_t kept = 0;
    for (uint32_t c = 0; c < size; c++) {
        if (kept == 0 || corners[c] != corners[kept - 1])
            move_corners(source, first + kept++, first + c, 1);
    }
    while (kept > 1 && corners[kept - 1] == corners[0])
        kept--;
    return kept;
}

// ---- Repeated faces

/// Same control points in the same cyclic order, for faces that use none twice.
static bool same_face(const uint32_t *a, const uint32_t *b, uint32_t size) {
    uint32_t shift = 0;
    while (shift < size && b[shift] != a[0])
        shift++;
    if (shift == size) return false;
    for (uint32_t c = 0; c < size; c++) {
        if (a[c] != b[(c + shift) % size]) return false;
    }
    return true;
}

static uint64_t face_hash(const uint32_t *corners, uint32_t size) {
    uint64_t sum = 0;
    for (uint32_t c = 0; c < size; c++)
        sum += limni_hash_mix(corners[c], 0);
    return limni_hash_mix(sum, size);
}

/// A set of faces by their corners.
typedef struct face_set {
    uint32_t *table;
    uint32_t size;
} face_set;

/// The equal face that was added before, or LIMNI_NONE after adding this one.
static uint32_t add_face(face_set *set, const limni_source *source, uint32_t face) {
    const uint32_t size = size_of(source, face);
    const uint32_t *const corners = corners_of(source, face);
    uint32_t at = (uint32_t)face_hash(corners, size) & (set->size - 1);
    for (; set->table[at] != LIMNI_NONE; at = (at + 1) & (set->size - 1)) {
        const uint32_t other = set->table[at];
        if (size_of(source, other) == size && same_face(corners, corners_of(source, other), size))
            return other;
    }
    set->table[at] = face;
    return LIMNI_NONE;
}

// ---- All faces

typedef struct dropped {
    uint32_t degenerate, repeated;
    uint32_t mended; ///< kept without corners that repeat the one before
} dropped;

/// Appends a face to those that are kept: in place, since it can only move towards the front.
static void keep_face(limni_source *source, uint32_t first, uint32_t size, uint32_t face,
                      uint32_t kept) {
    const uint32_t offset = source->face_offsets[kept];
    move_corners(source, offset, first, size);
    source->face_offsets[kept + 1] = offset + size;
    if (source->face_lines) source->face_lines[kept] = source->face_lines[face];
    if (source->face_materials) source->face_materials[kept] = source->face_materials[face];
    source->face_numbers[kept] = face;
}

/// The face at *kept stays, and *kept moves on, unless there is something wrong with it.
static limn_bake_status check_face(limni_context *context, limni_source *source, face_set *set,
                                   dropped *counts, uint32_t *kept) {
    const bool drop = context->desc.repair & LIMN_REPAIR_DROP;
    const uint32_t size = size_of(source, *kept);
    if (uses_twice(corners_of(source, *kept), size)) {
        if (!drop) {
            fail_at(context, source, *kept, "degenerate face: it uses a vertex twice");
            return LIMN_BAKE_BAD_INPUT;
        }
        counts->degenerate++;
        return LIMN_BAKE_OK;
    }
    const uint32_t other = add_face(set, source, *kept);
    if (other != LIMNI_NONE) {
        if (!drop) {
            fail_at(context, source, *kept, "repeated face: an earlier face has the same vertices");
            return LIMN_BAKE_BAD_INPUT;
        }
        counts->repeated++;
        return LIMN_BAKE_OK;
    }
    ++*kept;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_check_faces(limni_context *context, limni_source *source) {
    const bool drop = context->desc.repair & LIMN_REPAIR_DROP;
    const uint32_t face_count = source->face_count;
    face_set set = {.size = limni_hash_size(face_count)};
    set.table = limni_allocate(context, set.size, sizeof *set.table);
    source->face_numbers = limni_allocate(context, face_count, sizeof *source->face_numbers);
    if (!set.table || !source->face_numbers) return LIMN_BAKE_MEMORY;
    memset(set.table, 0xff, set.size * sizeof *set.table);

    dropped counts = {0};
    uint32_t kept = 0, offset = 0;
    for (uint32_t face = 0; face < face_count; face++) {
        const uint32_t end = source->face_offsets[face + 1];
        const uint32_t first = offset, full_size = end - offset;
        const uint32_t size = drop ? remove_repeats(source, first, full_size) : full_size;
        offset = end;
        if (size < 3) {
            counts.degenerate++;
            continue;
        }
        counts.mended += size < full_size;
        keep_face(source, first, size, face, kept);
        LIMNI_TRY(check_face(context, source, &set, &counts, &kept));
    }
    source->face_count = kept;
    limni_release(context, set.table);
    if (counts.degenerate || counts.repeated)
        limni_note(context, "%s: repaired: %u degenerate and %u repeated faces dropped",
                   file_of(source), counts.degenerate, counts.repeated);
    if (counts.mended)
        limni_note(context, "%s: repaired: %u faces lost corners that repeat the one before",
                   file_of(source), counts.mended);
    if (kept == 0)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: the mesh has no faces",
                          file_of(source));
    return LIMN_BAKE_OK;
}
