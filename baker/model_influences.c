/* SPDX-License-Identifier: MIT */
/* Which joints move the vertices of a mesh. Of more than a skin can have, the strongest stay. */
#include "model_vertices.h"

#include "limn/limn.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Influences of vertices, LIMN_INFLUENCE_MAX each, and what had to be mended.
typedef struct influences {
    const limni_model_vertices *vertices;
    const limni_model_skin *skin;
    const uint32_t *skin_joints; ///< [skin->joint_count]
    uint16_t *joints;
    float *weights;
    uint32_t dropped_count, unmoved_count, first_unmoved, off_count;
} influences;

static limn_bake_status refuse(const influences *in, const limni_model_part *part, uint32_t vertex,
                               const char *text) {
    const limni_model_reader *const reader = in->vertices->reader;
    return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: vertex %u %s",
                      reader->model->path, part->label, vertex, text);
}

/// Adds to the joint's weight; a further joint takes a free place, or that of the weakest.
static void add(influences *in, uint32_t vertex, uint16_t joint, float weight) {
    uint16_t *const joints = in->joints + (size_t)LIMN_INFLUENCE_MAX * vertex;
    float *const weights = in->weights + (size_t)LIMN_INFLUENCE_MAX * vertex;
    uint32_t weakest = 0;
    for (uint32_t i = 0; i < LIMN_INFLUENCE_MAX; i++) {
        if (weights[i] > 0 && joints[i] == joint) {
            weights[i] += weight;
            return;
        }
        if (weights[i] < weights[weakest]) weakest = i;
    }
    in->dropped_count += weights[weakest] > 0;
    if (weight <= weights[weakest]) return;
    joints[weakest] = joint;
    weights[weakest] = weight;
}

static limn_bake_status add_part(influences *in, const limni_model_part *part) {
    for (uint32_t i = 0; i < part->influence_count; i++) {
        const limni_model_influence *const from = &part->influences[i];
        char text[96];
        if (from->weight == 0) continue;
        if (from->vertex >= part->vertex_count)
            return refuse(in, part, from->vertex, "has a weight, but does not exist");
        if (from->weight < 0) return refuse(in, part, from->vertex, "has a negative weight");
        if (from->joint >= in->skin->joint_count) {
            snprintf(text, sizeof text, "names joint %u, but its skin has %u", from->joint,
                     in->skin->joint_count);
            return refuse(in, part, from->vertex, text);
        }
        add(in, part->first + from->vertex, (uint16_t)in->skin_joints[from->joint], from->weight);
    }
    return LIMN_BAKE_OK;
}

/// A vertex that no joint moves goes with the first joint of the skin.
static void complete(influences *in, uint32_t vertex) {
    float *const weights = in->weights + (size_t)LIMN_INFLUENCE_MAX * vertex;
    float sum = 0;
    for (uint32_t i = 0; i < LIMN_INFLUENCE_MAX; i++)
        sum += weights[i];
    in->off_count += sum > 0 && fabsf(sum - 1) > 0.01f;
    if (sum > 0) return;
    if (in->unmoved_count++ == 0) in->first_unmoved = vertex;
    in->joints[(size_t)LIMN_INFLUENCE_MAX * vertex] = (uint16_t)in->skin_joints[0];
    weights[0] = 1;
}

static void note_mended(const influences *in) {
    const limni_model_reader *const reader = in->vertices->reader;
    const char *const path = reader->model->path, *const label = in->vertices->label;
    if (in->unmoved_count)
        limni_note(reader->context,
                   "%s: %s: mended: the weights of %u vertices (the first is %u) are all 0; they "
                   "go with the first joint of the skin",
                   path, label, in->unmoved_count, in->first_unmoved);
    if (in->off_count)
        limni_note(reader->context, "%s: %s: mended: the weights of %u vertices did not sum to 1",
                   path, label, in->off_count);
    if (in->dropped_count)
        limni_note(reader->context,
                   "%s: %s: %u influences dropped: a vertex has more than %u, and the strongest "
                   "stay",
                   path, label, in->dropped_count, LIMN_INFLUENCE_MAX);
}

limn_bake_status limni_model_read_influences(const limni_model_vertices *vertices, uint16_t *joints,
                                             float *weights) {
    const limni_model_reader *const reader = vertices->reader;
    const int skin = vertices->node->skin;
    influences in = {.vertices = vertices,
                     .skin = &reader->model->skins[skin],
                     .skin_joints = reader->skin_joints[skin],
                     .joints = joints,
                     .weights = weights};
    for (uint32_t p = 0; p < vertices->mesh->part_count; p++)
        LIMNI_TRY(add_part(&in, &vertices->mesh->parts[p]));
    for (uint32_t v = 0; v < vertices->count; v++)
        complete(&in, v);
    note_mended(&in);
    limn_skin_place place;
    if (limn_skin_normalise(vertices->count, LIMN_INFLUENCE_MAX, joints, weights, &place) !=
        LIMN_OK)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: %s: the weights of vertex %u cannot be scaled to sum to 1",
                          reader->model->path, vertices->label, place.point);
    return LIMN_BAKE_OK;
}
