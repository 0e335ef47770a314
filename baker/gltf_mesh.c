/* SPDX-License-Identifier: MIT */
/* Meshes: a part for each primitive that has triangles. */
#include "gltf_reader.h"

#include "mesh.h"

#include <stdio.h>
#include <string.h>

enum { TRIANGLES = 4, STRIP = 5, FAN = 6 };

int limni_gltf_attribute_of(const limni_gltf_attributes *attributes, const char *name) {
    for (uint32_t a = 0; a < attributes->count; a++) {
        if (strcmp(attributes->items[a].name, name) == 0) return attributes->items[a].accessor;
    }
    return -1;
}

// ---- Triangles

/// The vertices of a part in the order in which they make triangles.
static limn_bake_status read_indices(const limni_gltf_reader *reader, int index,
                                     const limni_model_part *part, uint32_t **indices,
                                     uint32_t *count) {
    const limni_gltf_accessor *accessor = NULL;
    char what[192];
    snprintf(what, sizeof what, "indices of %s", part->label);
    if (index >= 0) LIMNI_TRY(limni_gltf_find_accessor(reader, index, what, &accessor));
    if (accessor && accessor->count > LIMNI_CORNERS_MAX)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: too many",
                          reader->model->path, what);
    *count = accessor ? (uint32_t)accessor->count : part->vertex_count;
    *indices = limni_allocate(reader->context, *count, sizeof **indices);
    if (!*indices) return LIMN_BAKE_MEMORY;
    for (uint32_t i = 0; i < *count && !accessor; i++)
        (*indices)[i] = i;
    return accessor ? limni_gltf_read_integers(reader, index, what, *count, 1, *indices)
                    : LIMN_BAKE_OK;
}

/// Triangle `t` of a list, a strip or a fan.
static void triangle_at(const uint32_t *indices, int mode, uint32_t t, uint32_t corners[3]) {
    const uint32_t odd = t % 2;
    switch (mode) {
    case STRIP:
        corners[0] = indices[t];
        corners[1] = indices[t + 1 + odd];
        corners[2] = indices[t + 2 - odd];
        break;
    case FAN:
        corners[0] = indices[t + 1];
        corners[1] = indices[t + 2];
        corners[2] = indices[0];
        break;
    default:
        memcpy(corners, indices + (size_t)3 * t, 3 * sizeof *corners);
    }
}

static limn_bake_status read_triangles(const limni_gltf_reader *reader,
                                       const limni_gltf_primitive *primitive,
                                       limni_model_part *part) {
    const int mode = primitive->mode;
    uint32_t *indices = NULL, count = 0;
    LIMNI_TRY(read_indices(reader, primitive->indices, part, &indices, &count));
    if (mode == TRIANGLES ? count % 3 != 0 : count < 3)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: %s: %u indices do not make triangles", reader->model->path,
                          part->label, count);
    const uint32_t triangle_count = mode == TRIANGLES ? count / 3 : count - 2;
    part->corners =
        limni_allocate(reader->context, (size_t)3 * triangle_count, sizeof *part->corners);
    part->face_offsets =
        limni_allocate(reader->context, (size_t)triangle_count + 1, sizeof *part->face_offsets);
    if (!part->corners || !part->face_offsets) return LIMN_BAKE_MEMORY;
    for (uint32_t t = 0; t < triangle_count; t++) {
        uint32_t *const c = part->corners + (size_t)3 * part->face_count;
        triangle_at(indices, mode, t, c);
        // What joins two parts of a strip.
        if (mode == STRIP && (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])) continue;
        part->face_count++;
    }
    for (uint32_t face = 0; face <= part->face_count; face++)
        part->face_offsets[face] = 3 * face;
    limni_release(reader->context, indices);
    return LIMN_BAKE_OK;
}

// ---- Parts

/// Notes attributes that nothing reads. Normals follow from the surface, and are expected.
static void note_attributes(const limni_gltf_reader *reader, const limni_gltf_primitive *primitive,
                            const char *label) {
    static const char *const known[] = {"POSITION", "NORMAL",  "TANGENT", "TEXCOORD_",
                                        "COLOR_",   "JOINTS_", "WEIGHTS_"};
    for (uint32_t a = 0; a < primitive->attributes.count; a++) {
        const char *const name = primitive->attributes.items[a].name;
        bool is_known = false;
        for (size_t k = 0; k < sizeof known / sizeof *known; k++)
            is_known |= strncmp(name, known[k], strlen(known[k])) == 0;
        if (!is_known)
            limni_note(reader->context, "%s: %s: the attribute %s is passed over",
                       reader->model->path, label, name);
    }
}

/// How many vertices a primitive has; 0, with a note, where it makes no triangles.
static limn_bake_status count_vertices(const limni_gltf_reader *reader,
                                       const limni_gltf_primitive *primitive,
                                       limni_model_part *part) {
    const int positions = limni_gltf_attribute_of(&primitive->attributes, "POSITION");
    const bool makes_triangles = primitive->mode >= TRIANGLES && primitive->mode <= FAN;
    const limni_gltf_accessor *accessor = NULL;
    char what[192];
    snprintf(what, sizeof what, "POSITION of %s", part->label);
    if (makes_triangles && positions >= 0)
        LIMNI_TRY(limni_gltf_find_accessor(reader, positions, what, &accessor));
    if (!accessor || accessor->count == 0)
        limni_note(reader->context, "%s: %s: it has no %s; it is passed over", reader->model->path,
                   part->label,
                   positions < 0     ? "positions"
                   : makes_triangles ? "vertices"
                                     : "triangles");
    else if (accessor->count > LIMNI_CORNERS_MAX)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: too many vertices",
                          reader->model->path, part->label);
    else
        part->vertex_count = (uint32_t)accessor->count;
    return LIMN_BAKE_OK;
}

/// Names, once, what morph targets have beside positions.
static void note_other_targets(const limni_gltf_reader *reader, const limni_gltf_mesh *mesh,
                               const char *label) {
    static const char *const names[] = {"NORMAL",     "TANGENT", "TEXCOORD_0",
                                        "TEXCOORD_1", "COLOR_0", "COLOR_1"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        bool any = false;
        for (uint32_t p = 0; p < mesh->primitive_count; p++) {
            for (uint32_t t = 0; t < mesh->primitives[p].target_count; t++)
                any |= limni_gltf_attribute_of(&mesh->primitives[p].targets[t], names[n]) >= 0;
        }
        if (any)
            limni_note(reader->context,
                       "%s: %s: morph targets move positions alone; their %s is passed over",
                       reader->model->path, label, names[n]);
    }
}

static limn_bake_status read_mesh(const limni_gltf_reader *reader, uint32_t index) {
    const limni_gltf_mesh *const from = &reader->document->meshes[index];
    limni_model_mesh *const mesh = &reader->model->meshes[index];
    limni_label label;
    limni_label_make(label, "mesh", index, from->name);
    *mesh = (limni_model_mesh){.name = from->name,
                               .weights = from->weights,
                               .target_names = from->target_names,
                               .weight_count = from->weight_count,
                               .target_name_count = from->target_name_count,
                               .tags = from->tags};
    mesh->parts =
        limni_allocate_zeroed(reader->context, from->primitive_count, sizeof *mesh->parts);
    if (!mesh->parts) return LIMN_BAKE_MEMORY;
    for (uint32_t p = 0; p < from->primitive_count; p++) {
        const limni_gltf_primitive *const primitive = &from->primitives[p];
        limni_model_part *const part = &mesh->parts[mesh->part_count];
        snprintf(part->label, sizeof part->label, "%s, primitive %u", label, p);
        LIMNI_TRY(count_vertices(reader, primitive, part));
        if (part->vertex_count == 0) continue;
        part->material = primitive->material;
        note_attributes(reader, primitive, part->label);
        LIMNI_TRY(limni_gltf_read_attributes(reader, primitive, part));
        LIMNI_TRY(read_triangles(reader, primitive, part));
        mesh->part_count++;
    }
    note_other_targets(reader, from, label);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_meshes(const limni_gltf_reader *reader) {
    limni_model *const model = reader->model;
    model->mesh_count = reader->document->mesh_count;
    model->meshes =
        limni_allocate_zeroed(reader->context, model->mesh_count, sizeof *model->meshes);
    if (!model->meshes) return LIMN_BAKE_MEMORY;
    for (uint32_t n = 0; n < model->node_count; n++) {
        const int mesh = model->nodes[n].mesh;
        if (mesh >= 0 && (uint32_t)mesh < model->mesh_count && !model->meshes[mesh].name)
            LIMNI_TRY(read_mesh(reader, (uint32_t)mesh));
    }
    return LIMN_BAKE_OK;
}
