/* SPDX-License-Identifier: MIT */
/* Faces on their own, before they are connected: what is degenerate or repeated, and welding. */
#include "hash.h"
#include "mesh.h"

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

static uint64_t position_hash(const float position[3]) {
    uint32_t bits[3];
    memcpy(bits, position, sizeof bits);
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

/// Merges control points with equal positions into the first of them. Numbers, and with them the
/// lines, move up.
limn_bake_status limni_weld(limni_context *context, limni_source *source) {
    const uint32_t count = source->position_count;
    const uint32_t size = limni_hash_size(count);
    uint32_t *const table = limni_allocate(context, size, sizeof *table);
    uint32_t *const moved = limni_allocate(context, count, sizeof *moved);
    source->position_numbers = limni_allocate(context, count, sizeof *source->position_numbers);
    if (!table || !moved || !source->position_numbers) return LIMN_BAKE_MEMORY;
    memset(table, 0xff, size * sizeof *table);

    uint32_t kept = 0;
    for (uint32_t p = 0; p < count; p++) {
        float *const position = source->positions[p];
        for (int axis = 0; axis < 3; axis++)
            position[axis] += 0.0f; // -0 and 0 are one place
        uint32_t at = (uint32_t)position_hash(position) & (size - 1);
        while (table[at] != LIMNI_NONE &&
               memcmp(source->positions[table[at]], position, sizeof *source->positions) != 0)
            at = (at + 1) & (size - 1);
        if (table[at] == LIMNI_NONE) {
            table[at] = kept;
            memmove(source->positions[kept], position, sizeof *source->positions);
            source->position_numbers[kept] = p;
            if (source->position_lines) source->position_lines[kept] = source->position_lines[p];
            kept++;
        }
        moved[p] = table[at];
    }
    follow(source, moved);
    if (kept < count)
        limni_note(context, "%s: repaired: %u control points welded into others", file_of(source),
                   count - kept);
    source->position_count = kept;
    limni_release(context, table);
    limni_release(context, moved);
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

/// Removes corners that repeat the one before them, around the face. Returns the new size.
static uint32_t remove_repeats(uint32_t *corners, uint32_t size) {
    uint32_t kept = 0;
    for (uint32_t c = 0; c < size; c++) {
        if (kept == 0 || corners[c] != corners[kept - 1]) corners[kept++] = corners[c];
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
static void keep_face(limni_source *source, const uint32_t *corners, uint32_t size, uint32_t face,
                      uint32_t kept) {
    const uint32_t offset = source->face_offsets[kept];
    memmove(source->face_corners + offset, corners, size * sizeof *corners);
    source->face_offsets[kept + 1] = offset + size;
    if (source->face_lines) source->face_lines[kept] = source->face_lines[face];
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
        uint32_t *const corners = source->face_corners + offset;
        const uint32_t full_size = end - offset;
        const uint32_t size = drop ? remove_repeats(corners, full_size) : full_size;
        offset = end;
        if (size < 3) {
            counts.degenerate++;
            continue;
        }
        counts.mended += size < full_size;
        keep_face(source, corners, size, face, kept);
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
