/* SPDX-License-Identifier: MIT */
/* Creases and corners: `extras.limn` of a mesh of glTF. docs/meshes.md says what is there. */
#include "model_vertices.h"

#include <math.h>
#include <string.h>

static limn_bake_status refuse_tag(const limni_model_vertices *v, const char *text) {
    return limni_fail(v->reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: extras.limn: %s",
                      v->reader->model->path, v->label, text);
}

/// The position of a vertex that a tag names, if there is one.
static bool find_position(const limni_model_vertices *v, double vertex, uint32_t *position) {
    if (!(vertex >= 0 && vertex < v->count && vertex == floor(vertex))) return false;
    *position = v->moved[(uint32_t)vertex];
    return true;
}

static limn_bake_status read_creases(const limni_model_vertices *v, limni_tags *tags) {
    const limni_model_tags *const from = &v->mesh->tags;
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

limn_bake_status limni_model_read_tags(const limni_model_vertices *v, limni_tags *tags) {
    static const char *const boundaries[] = {"", "edge-only", "edge-and-corner", "none"};
    static const char *const creasings[] = {"", "uniform", "chaikin"};
    const limni_model_tags *const from = &v->mesh->tags;
    int boundary = 0, creasing = 0;
    if (from->mistake) return refuse_tag(v, from->mistake);
    while (from->boundary && boundary < 4 && strcmp(boundaries[boundary], from->boundary) != 0)
        boundary++;
    while (from->creasing && creasing < 3 && strcmp(creasings[creasing], from->creasing) != 0)
        creasing++;
    if (boundary == 4) return refuse_tag(v, "there is no such boundary rule");
    if (creasing == 3) return refuse_tag(v, "there is no such creasing method");
    tags->boundary = (limn_boundary)boundary;
    tags->creasing = (limn_creasing)creasing;
    return read_creases(v, tags);
}
