/* SPDX-License-Identifier: MIT */
/* A node with a mesh becomes a source: one control mesh of the faces of all parts. */
#include "model_vertices.h"

#include "mesh.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- Faces

static limn_bake_status check_part(const limni_model_vertices *v, const limni_model_part *part) {
    limni_context *const context = v->reader->context;
    const char *const path = v->reader->model->path;
    for (uint32_t face = 0; face < part->face_count; face++) {
        const uint32_t first = part->face_offsets[face], end = part->face_offsets[face + 1];
        if (end < first + 3)
            return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: %s: face %u has %u corners", path,
                              part->label, face, end - first);
        for (uint32_t c = first; c < end; c++) {
            if (part->corners[c] >= part->vertex_count)
                return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                                  "%s: %s: face %u has vertex %u, but there are %u", path,
                                  part->label, face, part->corners[c], part->vertex_count);
        }
    }
    return LIMN_BAKE_OK;
}

/// Counts vertices and faces, and checks the parts.
static limn_bake_status count_parts(limni_model_vertices *v, limni_source *source,
                                    uint32_t *corner_count) {
    *corner_count = 0;
    for (uint32_t p = 0; p < v->mesh->part_count; p++) {
        limni_model_part *const part = &v->mesh->parts[p];
        const uint32_t corners = part->face_offsets[part->face_count];
        if (part->vertex_count > LIMNI_CORNERS_MAX - v->count ||
            corners > LIMNI_CORNERS_MAX - *corner_count)
            return limni_fail(v->reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: too many vertices or faces", v->reader->model->path,
                              part->label);
        LIMNI_TRY(check_part(v, part));
        part->first = v->count;
        v->count += part->vertex_count;
        source->face_count += part->face_count;
        *corner_count += corners;
    }
    return LIMN_BAKE_OK;
}

/// Appends the faces of a part; corners are vertices of the mesh.
static limn_bake_status add_faces(const limni_model_vertices *v, const limni_model_part *part,
                                  limni_source *source, uint32_t first_face, uint32_t *corners) {
    uint32_t material;
    LIMNI_TRY(limni_model_find_material(v->reader, part->material, &material));
    const uint32_t first_corner = source->face_offsets[first_face];
    for (uint32_t face = 0; face < part->face_count; face++) {
        source->face_materials[first_face + face] = material;
        source->face_offsets[first_face + face + 1] = first_corner + part->face_offsets[face + 1];
    }
    for (uint32_t c = 0; c < part->face_offsets[part->face_count]; c++)
        corners[first_corner + c] = part->first + part->corners[c];
    return LIMN_BAKE_OK;
}

static limn_bake_status make_faces(const limni_model_vertices *v, uint32_t corner_count,
                                   limni_source *source) {
    limni_context *const context = v->reader->context;
    const size_t face_count = source->face_count;
    uint32_t *const corners = limni_allocate(context, corner_count, sizeof *corners);
    source->face_materials = limni_allocate(context, face_count, sizeof *source->face_materials);
    source->face_offsets = limni_allocate(context, face_count + 1, sizeof *source->face_offsets);
    source->face_corners = limni_allocate(context, corner_count, sizeof *source->face_corners);
    if (!corners || !source->face_materials || !source->face_offsets || !source->face_corners)
        return LIMN_BAKE_MEMORY;
    source->face_offsets[0] = 0;
    for (uint32_t p = 0, first_face = 0; p < v->mesh->part_count; p++) {
        LIMNI_TRY(add_faces(v, &v->mesh->parts[p], source, first_face, corners));
        first_face += v->mesh->parts[p].face_count;
    }
    for (uint32_t c = 0; c < corner_count; c++)
        source->face_corners[c] = v->moved[corners[c]];
    LIMNI_TRY(limni_model_read_channels(v, corners, corner_count, source));
    limni_release(context, corners);
    return LIMN_BAKE_OK;
}

/// Notes materials whose textures want texture coordinates that the mesh does not have.
static void note_textures(const limni_model_vertices *v, const limni_source *source) {
    const limni_model *const model = v->reader->model;
    uint32_t uv_count = 0;
    for (uint32_t c = 0; c < source->channel_count; c++)
        uv_count += source->channels[c].kind == LIMN_CHANNEL_UV;
    for (uint32_t p = 0; p < v->mesh->part_count; p++) {
        const limni_model_part *const part = &v->mesh->parts[p];
        if (part->material < 0) continue;
        const limni_model_material *const material = &model->materials[part->material];
        if (material->image < 0 || material->uv_set < uv_count) continue;
        limni_note(v->reader->context,
                   "%s: %s: the texture of its material '%s' needs set %u of texture coordinates, "
                   "but the mesh has %u",
                   model->path, part->label, material->name, material->uv_set, uv_count);
    }
}

// ---- Place

static void reverse_corners(uint32_t *corners, uint32_t count) {
    for (uint32_t i = 1; i < count - i; i++) { // the first stays
        const uint32_t corner = corners[i];
        corners[i] = corners[count - i];
        corners[count - i] = corner;
    }
}

/// Reverses the corners of all faces: they were mirrored.
static void reverse(limni_source *source) {
    for (uint32_t face = 0; face < source->face_count; face++) {
        const uint32_t first = source->face_offsets[face];
        const uint32_t count = source->face_offsets[face + 1] - first;
        reverse_corners(source->face_corners + first, count);
        for (uint32_t c = 0; c < source->channel_count; c++)
            reverse_corners(source->channels[c].corner_values + first, count);
    }
}

/// fourth  1: a point; 0: a movement
static bool transform(const limni_transform *t, double fourth, float p[3]) {
    const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
    bool finite = true;
    for (int row = 0; row < 3; row++) {
        p[row] = (float)(t->rows[row][0] * x + t->rows[row][1] * y + t->rows[row][2] * z +
                         t->rows[row][3] * fourth);
        p[row] += 0.0f;
        finite &= isfinite(p[row]) != 0;
    }
    return finite;
}

/// A mesh without a skin goes where its node is; one with a skin is placed by its joints.
static limn_bake_status place(const limni_model_vertices *v, limni_source *source) {
    const limni_transform *const global = &v->reader->places[v->node_index].global;
    const size_t delta_count = (size_t)source->position_count * source->rig.target_count;
    bool finite = true;
    if (v->node->skin >= 0) return LIMN_BAKE_OK;
    for (uint32_t p = 0; p < source->position_count; p++)
        finite &= transform(global, 1, source->positions[p]);
    for (size_t d = 0; d < delta_count; d++)
        finite &= transform(global, 0, source->rig.deltas[d]);
    if (!finite)
        return limni_fail(v->reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: its node puts a vertex where floats do not reach", source->path);
    if (limni_transform_determinant(global) < 0) reverse(source);
    return LIMN_BAKE_OK;
}

// ---- Meshes

/// Named after the node, the mesh or the file, whichever has a name first.
static limn_bake_status name_source(const limni_model_vertices *v, limni_source *source) {
    const limni_model_reader *const reader = v->reader;
    const size_t size = strlen(reader->model->path) + sizeof(limni_label) + 8;
    char *const path = limni_allocate(reader->context, size, 1);
    if (!path) return LIMN_BAKE_MEMORY;
    snprintf(path, size, "%s: %s", reader->model->path, v->label);
    source->path = path;
    source->name = v->node->name[0]   ? v->node->name
                   : v->mesh->name[0] ? v->mesh->name
                                      : reader->file_name;
    return LIMN_BAKE_OK;
}

static limn_bake_status read_mesh(limni_model_vertices *v) {
    limni_model_reader *const reader = v->reader;
    limni_scene *const scene = reader->scene;
    limni_source *const source = &scene->sources[scene->source_count];
    uint32_t corner_count = 0;
    *source = (limni_source){0};
    if (v->mesh->part_count == 0) {
        limni_note(reader->context, "%s: %s: it has no faces; it is passed over",
                   reader->model->path, v->label);
        return LIMN_BAKE_OK;
    }
    LIMNI_TRY(name_source(v, source));
    LIMNI_TRY(count_parts(v, source, &corner_count));
    if (source->face_count == 0)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: it has no faces",
                          source->path);
    LIMNI_TRY(limni_model_read_vertices(v, source));
    LIMNI_TRY(make_faces(v, corner_count, source));
    note_textures(v, source);
    LIMNI_TRY(limni_model_read_tags(v, &source->tags));
    LIMNI_TRY(place(v, source));
    reader->places[v->node_index].mesh = scene->first_mesh + scene->source_count;
    scene->source_count++;
    limni_release(reader->context, v->moved);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_model_read_meshes(limni_model_reader *reader) {
    const limni_model *const model = reader->model;
    limni_scene *const scene = reader->scene;
    scene->sources = limni_allocate(reader->context, model->node_count, sizeof *scene->sources);
    if (!scene->sources) return LIMN_BAKE_MEMORY;
    for (uint32_t o = 0; o < model->node_count; o++) {
        const uint32_t n = reader->order[o];
        const limni_model_node *const node = &model->nodes[n];
        limni_label label;
        limni_label_make(label, "node", n, node->name);
        if (node->has_camera)
            limni_note(reader->context, "%s: %s: its camera is passed over", model->path, label);
        if (node->has_light)
            limni_note(reader->context, "%s: %s: its light is passed over", model->path, label);
        if (node->mesh < 0 || !reader->places[n].in_scene) continue;
        if ((uint32_t)node->mesh >= model->mesh_count)
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: it has mesh %d, but there are %u", model->path, label,
                              node->mesh, model->mesh_count);
        limni_model_vertices v = {
            .reader = reader, .node = node, .node_index = n, .mesh = &model->meshes[node->mesh]};
        limni_label_make(v.label, "mesh", (uint32_t)node->mesh, v.mesh->name);
        LIMNI_TRY(read_mesh(&v));
    }
    return LIMN_BAKE_OK;
}
