/* SPDX-License-Identifier: MIT */
/* Which joints move the vertices of a mesh. Of more than a skin can have, the strongest stay. */
#include "gltf_vertices.h"

#include "limn/limn.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SET_SIZE = 4 };

/// Influences of vertices, LIMN_INFLUENCE_MAX each, and what had to be mended.
typedef struct influences {
    const limni_gltf_vertices *vertices;
    const limni_gltf_skin *skin;
    const uint32_t *skin_joints; ///< [skin->joint_count]
    uint16_t *joints;
    float *weights;
    uint32_t dropped_count, unmoved_count, first_unmoved, off_count;
} influences;

static limn_bake_status refuse(const influences *in, const limni_gltf_part *part, uint32_t vertex,
                               const char *text) {
    const limni_gltf_reader *const reader = in->vertices->reader;
    return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: vertex %u %s",
                      reader->document->path, part->label, vertex, text);
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

static limn_bake_status add_set(influences *in, const limni_gltf_part *part, const uint32_t *joints,
                                const float *weights) {
    for (uint32_t i = 0; i < SET_SIZE * part->count; i++) {
        const uint32_t vertex = i / SET_SIZE;
        if (weights[i] == 0) continue;
        if (weights[i] < 0) return refuse(in, part, vertex, "has a negative weight");
        if (joints[i] >= in->skin->joint_count) {
            char text[96];
            snprintf(text, sizeof text, "names joint %u, but its skin has %u", joints[i],
                     in->skin->joint_count);
            return refuse(in, part, vertex, text);
        }
        add(in, part->first + vertex, (uint16_t)in->skin_joints[joints[i]], weights[i]);
    }
    return LIMN_BAKE_OK;
}

/// JOINTS_n and WEIGHTS_n of a part. Returns in *found whether there are any.
static limn_bake_status read_set(influences *in, const limni_gltf_part *part, uint32_t set,
                                 bool *found) {
    limni_gltf_reader *const reader = in->vertices->reader;
    char names[2][32], what[2][256];
    int accessors[2];
    for (int k = 0; k < 2; k++) {
        snprintf(names[k], sizeof names[k], "%s_%u", k ? "WEIGHTS" : "JOINTS", set);
        snprintf(what[k], sizeof what[k], "%s of %s", names[k], part->label);
        accessors[k] = limni_gltf_attribute_of(&part->primitive->attributes, names[k]);
    }
    *found = accessors[0] >= 0 && accessors[1] >= 0;
    if (!*found) return LIMN_BAKE_OK;
    uint32_t *const joints =
        limni_allocate(reader->context, (size_t)SET_SIZE * part->count, sizeof *joints);
    float *const weights =
        limni_allocate(reader->context, (size_t)SET_SIZE * part->count, sizeof *weights);
    if (!joints || !weights) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(
        limni_gltf_read_integers(reader, accessors[0], what[0], part->count, SET_SIZE, joints));
    LIMNI_TRY(
        limni_gltf_read_floats(reader, accessors[1], what[1], part->count, SET_SIZE, weights));
    LIMNI_TRY(add_set(in, part, joints, weights));
    limni_release(reader->context, joints);
    limni_release(reader->context, weights);
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
    const limni_gltf_reader *const reader = in->vertices->reader;
    const char *const path = reader->document->path, *const label = in->vertices->label;
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

limn_bake_status limni_gltf_read_influences(const limni_gltf_vertices *vertices, uint16_t *joints,
                                            float *weights) {
    const limni_gltf_reader *const reader = vertices->reader;
    const int skin = vertices->node->skin;
    influences in = {.vertices = vertices,
                     .skin = &reader->document->skins[skin],
                     .skin_joints = reader->skin_joints[skin],
                     .joints = joints,
                     .weights = weights};
    for (uint32_t p = 0; p < vertices->part_count; p++) {
        bool found = true;
        for (uint32_t set = 0; found; set++)
            LIMNI_TRY(read_set(&in, &vertices->parts[p], set, &found));
    }
    for (uint32_t v = 0; v < vertices->count; v++)
        complete(&in, v);
    note_mended(&in);
    limn_skin_place place;
    if (limn_skin_normalise(vertices->count, LIMN_INFLUENCE_MAX, joints, weights, &place) !=
        LIMN_OK)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: %s: the weights of vertex %u cannot be scaled to sum to 1",
                          reader->document->path, vertices->label, place.point);
    return LIMN_BAKE_OK;
}
