/* SPDX-License-Identifier: MIT */
/* A node with a mesh becomes a source: one control mesh of all its triangles. */
#include "gltf_vertices.h"

#include "mesh.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TRIANGLES = 4, STRIP = 5, FAN = 6 };

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
                       reader->document->path, label, name);
    }
}

/// Lists the primitives that have triangles, and counts their vertices.
static limn_bake_status list_parts(limni_gltf_vertices *v) {
    limni_gltf_reader *const reader = v->reader;
    const char *const path = reader->document->path;
    v->parts = limni_allocate_zeroed(reader->context, v->mesh->primitive_count, sizeof *v->parts);
    if (!v->parts) return LIMN_BAKE_MEMORY;
    for (uint32_t p = 0; p < v->mesh->primitive_count; p++) {
        const limni_gltf_primitive *const primitive = &v->mesh->primitives[p];
        limni_gltf_part *const part = &v->parts[v->part_count];
        const int positions = limni_gltf_attribute_of(&primitive->attributes, "POSITION");
        const limni_gltf_accessor *accessor;
        char what[192];
        snprintf(part->label, sizeof part->label, "%s, primitive %u", v->label, p);
        snprintf(what, sizeof what, "POSITION of %s", part->label);
        if (primitive->mode < TRIANGLES || primitive->mode > FAN || positions < 0) {
            limni_note(reader->context, "%s: %s: it has no %s; it is passed over", path,
                       part->label, positions < 0 ? "positions" : "triangles");
            continue;
        }
        LIMNI_TRY(limni_gltf_find_accessor(reader, positions, what, &accessor));
        if (accessor->count == 0) {
            limni_note(reader->context, "%s: %s: it has no vertices; it is passed over", path,
                       part->label);
            continue;
        }
        if (accessor->count > LIMNI_CORNERS_MAX - v->count)
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: too many vertices",
                              path, part->label);
        part->primitive = primitive;
        part->first = v->count;
        part->count = (uint32_t)accessor->count;
        note_attributes(reader, primitive, part->label);
        v->count += part->count;
        v->part_count++;
    }
    return LIMN_BAKE_OK;
}

// ---- Triangles

/// The corners of all triangles, by vertex, and their materials.
typedef struct triangles {
    limni_list corners;   ///< uint32_t
    limni_list materials; ///< uint32_t
} triangles;

/// The vertices of a part in the order in which they make triangles.
static limn_bake_status read_indices(const limni_gltf_vertices *v, const limni_gltf_part *part,
                                     uint32_t **indices, uint32_t *count) {
    const limni_gltf_reader *const reader = v->reader;
    const int index = part->primitive->indices;
    const limni_gltf_accessor *accessor = NULL;
    char what[192];
    snprintf(what, sizeof what, "indices of %s", part->label);
    if (index >= 0) LIMNI_TRY(limni_gltf_find_accessor(reader, index, what, &accessor));
    if (accessor && accessor->count > LIMNI_CORNERS_MAX)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: too many",
                          reader->document->path, what);
    *count = accessor ? (uint32_t)accessor->count : part->count;
    *indices = limni_allocate(reader->context, *count, sizeof **indices);
    if (!*indices) return LIMN_BAKE_MEMORY;
    for (uint32_t i = 0; i < *count && !accessor; i++)
        (*indices)[i] = i;
    if (accessor) LIMNI_TRY(limni_gltf_read_integers(reader, index, what, *count, 1, *indices));
    for (uint32_t i = 0; i < *count; i++) {
        if ((*indices)[i] >= part->count)
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: accessor %d (%s): element %u is %u, but there are %u vertices",
                              reader->document->path, index, what, i, (*indices)[i], part->count);
    }
    return LIMN_BAKE_OK;
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

static limn_bake_status read_triangles(const limni_gltf_vertices *v, const limni_gltf_part *part,
                                       triangles *all) {
    limni_gltf_reader *const reader = v->reader;
    const int mode = part->primitive->mode;
    uint32_t *indices = NULL, count = 0, material = LIMN_FORMAT_NONE;
    LIMNI_TRY(read_indices(v, part, &indices, &count));
    LIMNI_TRY(limni_gltf_find_material(reader, part->primitive->material, &material));
    if (mode == TRIANGLES ? count % 3 != 0 : count < 3)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: %s: %u indices do not make triangles", reader->document->path,
                          part->label, count);
    for (uint32_t t = 0; t < (mode == TRIANGLES ? count / 3 : count - 2); t++) {
        uint32_t c[3];
        triangle_at(indices, mode, t, c);
        // What joins two parts of a strip.
        if (mode == STRIP && (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])) continue;
        for (int i = 0; i < 3; i++)
            c[i] += part->first;
        LIMNI_TRY(limni_list_add(reader->context, &all->corners, c, 3, sizeof *c));
        LIMNI_TRY(limni_list_add(reader->context, &all->materials, &material, 1, sizeof material));
    }
    limni_release(reader->context, indices);
    return LIMN_BAKE_OK;
}

static limn_bake_status make_faces(const limni_gltf_vertices *v, const triangles *all,
                                   limni_source *source) {
    limni_context *const context = v->reader->context;
    const uint32_t *const corners = all->corners.items;
    source->face_count = all->materials.count;
    source->face_materials = all->materials.items;
    source->face_offsets =
        limni_allocate(context, (size_t)source->face_count + 1, sizeof *source->face_offsets);
    source->face_corners =
        limni_allocate(context, all->corners.count, sizeof *source->face_corners);
    if (!source->face_offsets || !source->face_corners) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face <= source->face_count; face++)
        source->face_offsets[face] = 3 * face;
    for (uint32_t c = 0; c < all->corners.count; c++)
        source->face_corners[c] = v->moved[corners[c]];
    return limni_gltf_read_channels(v, corners, all->corners.count, source);
}

// ---- Tags

static limn_bake_status refuse_tag(const limni_gltf_vertices *v, const char *text) {
    return limni_fail(v->reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: extras.limn: %s",
                      v->reader->document->path, v->label, text);
}

/// The position of a vertex that a tag names, if there is one.
static bool find_position(const limni_gltf_vertices *v, double vertex, uint32_t *position) {
    if (!(vertex >= 0 && vertex < v->count && vertex == floor(vertex))) return false;
    *position = v->moved[(uint32_t)vertex];
    return true;
}

static limn_bake_status read_creases(const limni_gltf_vertices *v, limni_tags *tags) {
    const limni_gltf_tags *const from = &v->mesh->tags;
    limni_context *const context = v->reader->context;
    tags->creases = limni_allocate_zeroed(context, from->crease_count, sizeof *tags->creases);
    tags->sharp_vertices =
        limni_allocate_zeroed(context, from->corner_count, sizeof *tags->sharp_vertices);
    if (!tags->creases || !tags->sharp_vertices) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < from->crease_count; c++) {
        limni_crease *const crease = &tags->creases[tags->crease_count++];
        crease->sharpness = (float)from->creases[c][2];
        if (!find_position(v, from->creases[c][0], &crease->a) ||
            !find_position(v, from->creases[c][1], &crease->b))
            return refuse_tag(v, "a crease has a vertex that does not exist");
        if (!(crease->sharpness >= 0)) return refuse_tag(v, "a crease has a negative sharpness");
    }
    for (uint32_t c = 0; c < from->corner_count; c++) {
        limni_sharp_vertex *const corner = &tags->sharp_vertices[tags->sharp_vertex_count++];
        corner->sharpness = (float)from->corners[c][1];
        if (!find_position(v, from->corners[c][0], &corner->position))
            return refuse_tag(v, "a corner is a vertex that does not exist");
        if (!(corner->sharpness >= 0)) return refuse_tag(v, "a corner has a negative sharpness");
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_tags(const limni_gltf_vertices *v, limni_tags *tags) {
    static const char *const boundaries[] = {"", "edge-only", "edge-and-corner", "none"};
    static const char *const creasings[] = {"", "uniform", "chaikin"};
    const limni_gltf_tags *const from = &v->mesh->tags;
    int boundary = 0, creasing = 0;
    if (from->mistake) return refuse_tag(v, from->mistake);
    while (boundary < 4 && strcmp(boundaries[boundary], from->boundary) != 0)
        boundary++;
    while (creasing < 3 && strcmp(creasings[creasing], from->creasing) != 0)
        creasing++;
    if (boundary == 4) return refuse_tag(v, "there is no such boundary rule");
    if (creasing == 3) return refuse_tag(v, "there is no such creasing method");
    tags->boundary = (limn_boundary)boundary;
    tags->creasing = (limn_creasing)creasing;
    return read_creases(v, tags);
}

// ---- Place

/// Reverses the corners of all triangles: they were mirrored.
static void reverse(limni_source *source) {
    for (uint32_t face = 0; face < source->face_count; face++) {
        const uint32_t a = 3 * face + 1, b = a + 1, corner = source->face_corners[a];
        source->face_corners[a] = source->face_corners[b];
        source->face_corners[b] = corner;
        for (uint32_t c = 0; c < source->channel_count; c++) {
            uint32_t *const values = source->channels[c].corner_values;
            const uint32_t value = values[a];
            values[a] = values[b];
            values[b] = value;
        }
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
static limn_bake_status place(const limni_gltf_vertices *v, limni_source *source) {
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
static limn_bake_status name_source(const limni_gltf_vertices *v, limni_source *source) {
    const limni_gltf_reader *const reader = v->reader;
    const size_t size = strlen(reader->document->path) + sizeof(limni_gltf_label) + 8;
    char *const path = limni_allocate(reader->context, size, 1);
    if (!path) return LIMN_BAKE_MEMORY;
    snprintf(path, size, "%s: %s", reader->document->path, v->label);
    source->path = path;
    source->name = v->node->name[0]   ? v->node->name
                   : v->mesh->name[0] ? v->mesh->name
                                      : reader->file_name;
    return LIMN_BAKE_OK;
}

static limn_bake_status read_mesh(limni_gltf_vertices *v) {
    limni_gltf_reader *const reader = v->reader;
    limni_scene *const scene = reader->scene;
    limni_source *const source = &scene->sources[scene->source_count];
    triangles all = {0};
    LIMNI_TRY(list_parts(v));
    *source = (limni_source){0};
    if (v->part_count == 0) {
        limni_note(reader->context, "%s: %s: it has no triangles; it is passed over",
                   reader->document->path, v->label);
        return LIMN_BAKE_OK;
    }
    LIMNI_TRY(name_source(v, source));
    LIMNI_TRY(limni_gltf_read_vertices(v, source));
    for (uint32_t p = 0; p < v->part_count; p++)
        LIMNI_TRY(read_triangles(v, &v->parts[p], &all));
    if (all.materials.count == 0)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: it has no triangles",
                          source->path);
    LIMNI_TRY(make_faces(v, &all, source));
    LIMNI_TRY(read_tags(v, &source->tags));
    LIMNI_TRY(place(v, source));
    reader->places[v->node_index].mesh = scene->first_mesh + scene->source_count;
    scene->source_count++;
    limni_release(reader->context, all.corners.items);
    limni_release(reader->context, v->parts);
    limni_release(reader->context, v->moved);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_meshes(limni_gltf_reader *reader) {
    const limni_gltf *const document = reader->document;
    limni_scene *const scene = reader->scene;
    scene->sources = limni_allocate(reader->context, document->node_count, sizeof *scene->sources);
    if (!scene->sources) return LIMN_BAKE_MEMORY;
    for (uint32_t o = 0; o < document->node_count; o++) {
        const uint32_t n = reader->order[o];
        const limni_gltf_node *const node = &document->nodes[n];
        limni_gltf_label label;
        limni_gltf_name(label, "node", n, node->name);
        if (node->camera >= 0)
            limni_note(reader->context, "%s: %s: its camera is passed over", document->path, label);
        if (node->mesh < 0 || !reader->places[n].in_scene) continue;
        if ((uint32_t)node->mesh >= document->mesh_count)
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: it has mesh %d, but there are %u", document->path, label,
                              node->mesh, document->mesh_count);
        limni_gltf_vertices v = {
            .reader = reader, .node = node, .node_index = n, .mesh = &document->meshes[node->mesh]};
        limni_gltf_name(v.label, "mesh", (uint32_t)node->mesh, v.mesh->name);
        LIMNI_TRY(read_mesh(&v));
    }
    return LIMN_BAKE_OK;
}
