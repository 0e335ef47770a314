/* SPDX-License-Identifier: MIT */
/*
 * The nodes that become joints: those of skins, those that carry meshes and move, and all that they
 * hang on. A joint has one inverse bind matrix; where skins bind a node differently, it gets further
 * joints, which hang on the first and do not move by themselves.
 */
#include "model_reader.h"

#include <stdio.h>
#include <string.h>

/// A node with an inverse bind matrix, in use.
typedef struct bind {
    uint32_t node;
    uint32_t next; ///< of the same node, or LIMN_FORMAT_NONE
    uint32_t joint;
    float matrix[3][4];
} bind;

typedef struct binder {
    limni_model_reader *reader;
    limni_list binds;
    uint32_t *first;     ///< [node_count] of the binds, or LIMN_FORMAT_NONE
    uint32_t **of_skins; ///< [skin_count][joint_count] binds; NULL: the skin is not in use
    uint32_t *of_nodes;  ///< [node_count] binds of meshes that move as a whole
} binder;

static const float identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

/// The bind of a node with a matrix, which is added unless it is there.
static limn_bake_status find_bind(binder *b, uint32_t node, const float matrix[3][4],
                                  uint32_t *index) {
    bind *const binds = b->binds.items;
    uint32_t last = LIMN_FORMAT_NONE;
    for (uint32_t i = b->first[node]; i != LIMN_FORMAT_NONE; i = binds[i].next) {
        *index = last = i;
        if (memcmp(binds[i].matrix, matrix, sizeof binds->matrix) == 0) return LIMN_BAKE_OK;
    }
    bind added = {.node = node, .next = LIMN_FORMAT_NONE};
    memcpy(added.matrix, matrix, sizeof added.matrix);
    *index = b->binds.count;
    if (last == LIMN_FORMAT_NONE)
        b->first[node] = *index;
    else
        binds[last].next = *index;
    return limni_list_add(b->reader->context, &b->binds, &added, 1, sizeof added);
}

/// The node and all above it.
static void need(const limni_model_reader *reader, uint32_t node) {
    for (; node != LIMN_FORMAT_NONE && !reader->places[node].needed;
         node = reader->places[node].parent)
        reader->places[node].needed = true;
}

// ---- Skins

static limn_bake_status bind_skin(binder *b, uint32_t index) {
    limni_model_reader *const reader = b->reader;
    const limni_model_skin *const skin = &reader->model->skins[index];
    const char *const path = reader->model->path;
    limni_label label;
    limni_label_make(label, "skin", index, skin->name);
    if (skin->joint_count == 0)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s has no joints", path,
                          label);
    b->of_skins[index] = limni_allocate(reader->context, skin->joint_count, sizeof(uint32_t));
    if (!b->of_skins[index]) return LIMN_BAKE_MEMORY;
    for (uint32_t j = 0; j < skin->joint_count; j++) {
        if (skin->joints[j] < 0 || (uint32_t)skin->joints[j] >= reader->model->node_count)
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: its joint %u is node %d, but there are %u", path, label, j,
                              skin->joints[j], reader->model->node_count);
        need(reader, (uint32_t)skin->joints[j]);
        LIMNI_TRY(
            find_bind(b, (uint32_t)skin->joints[j],
                      skin->inverse_binds ? (const float(*)[4])skin->inverse_binds[j] : identity,
                      &b->of_skins[index][j]));
    }
    return LIMN_BAKE_OK;
}

/// A mesh without a skin that moves: a skin of one joint. Its points are placed at rest, so that they
/// are where they belong without a pose, unless that cannot be undone.
static limn_bake_status bind_whole(binder *b, uint32_t node) {
    limni_model_place *const place = &b->reader->places[node];
    limni_transform inverse;
    float rows[3][4];
    if (!limni_transform_invert(&place->global, &inverse) ||
        !limni_transform_round(&inverse, rows)) {
        memcpy(rows, identity, sizeof rows);
        memset(&place->global, 0, sizeof place->global);
        for (int i = 0; i < 3; i++)
            place->global.rows[i][i] = 1;
    }
    need(b->reader, node);
    return find_bind(b, node, (const float(*)[4])rows, &b->of_nodes[node]);
}

static limn_bake_status bind_meshes(binder *b) {
    limni_model_reader *const reader = b->reader;
    const limni_model *const model = reader->model;
    for (uint32_t o = 0; o < model->node_count; o++) {
        const uint32_t n = reader->order[o];
        const limni_model_node *const node = &model->nodes[n];
        limni_label label;
        if (node->mesh < 0 || !reader->places[n].in_scene) continue;
        if (node->skin < 0) {
            if (reader->places[n].moves) LIMNI_TRY(bind_whole(b, n));
            continue;
        }
        if ((uint32_t)node->skin >= model->skin_count)
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: it has skin %d, but there are %u", model->path,
                              limni_label_make(label, "node", n, node->name), node->skin,
                              model->skin_count);
        if (!b->of_skins[node->skin]) LIMNI_TRY(bind_skin(b, (uint32_t)node->skin));
    }
    return LIMN_BAKE_OK;
}

// ---- Joints

static limn_bake_status add_joint(limni_model_reader *reader, uint32_t node, uint32_t parent,
                                  const float matrix[3][4], bool still) {
    limni_character *const character = reader->scene->character;
    const limni_model_node *const from = &reader->model->nodes[node];
    const limni_transform local = limni_model_local(from);
    limn_file_joint joint = {.parent = parent, .rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    limni_label label;
    double translation[3], rotation[4], scale[3];
    limni_label_make(label, "node", node, from->name);
    if (character->joints.count > UINT16_MAX)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: more than %u joints",
                          reader->model->path, UINT16_MAX + 1u);
    if (!limni_transform_decompose(&local, translation, rotation, scale) && !still)
        limni_note(reader->context, "%s: %s: the shear of its matrix is lost", reader->model->path,
                   label);
    for (int i = 0; i < 4 && !still; i++) {
        joint.rotation[i] = (float)(from->has_matrix ? rotation[i] : from->rotation[i]);
        if (i == 3) break;
        joint.translation[i] = (float)translation[i];
        joint.scale[i] = (float)(from->has_matrix ? scale[i] : from->scale[i]);
    }
    memcpy(joint.inverse_bind, matrix, sizeof joint.inverse_bind);
    LIMNI_TRY(limni_character_add_text(reader->context, character,
                                       from->name[0] ? from->name : label, &joint.name));
    return limni_list_add(reader->context, &character->joints, &joint, 1, sizeof joint);
}

static limn_bake_status check_depth(const limni_model_reader *reader, uint32_t node) {
    uint32_t depth = 1; // a further joint may hang on it
    limni_label label;
    for (uint32_t n = node; n != LIMN_FORMAT_NONE; n = reader->places[n].parent) {
        if (++depth > LIMN_FORMAT_DEPTH_OF_JOINTS)
            return limni_fail(
                reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: more than %u joints above it",
                reader->model->path,
                limni_label_make(label, "node", node, reader->model->nodes[node].name),
                LIMN_FORMAT_DEPTH_OF_JOINTS - 2);
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status add_joints(binder *b) {
    limni_model_reader *const reader = b->reader;
    const uint32_t *const count = &reader->scene->character->joints.count;
    for (uint32_t o = 0; o < reader->model->node_count; o++) {
        const uint32_t n = reader->order[o];
        limni_model_place *const place = &reader->places[n];
        if (!place->needed) continue;
        LIMNI_TRY(check_depth(reader, n));
        const uint32_t parent = place->parent == LIMN_FORMAT_NONE
                                    ? LIMN_FORMAT_NONE
                                    : reader->places[place->parent].joint;
        bind *const binds = b->binds.items;
        uint32_t i = b->first[n];
        place->joint = *count;
        LIMNI_TRY(add_joint(reader, n, parent,
                            i == LIMN_FORMAT_NONE ? identity : (const float(*)[4])binds[i].matrix,
                            false));
        for (bool further = false; i != LIMN_FORMAT_NONE; i = binds[i].next, further = true) {
            binds[i].joint = further ? *count : place->joint;
            if (further)
                LIMNI_TRY(
                    add_joint(reader, n, place->joint, (const float(*)[4])binds[i].matrix, true));
        }
    }
    return LIMN_BAKE_OK;
}

/// Joints in the place of binds.
static void list_joints(binder *b) {
    limni_model_reader *const reader = b->reader;
    const bind *const binds = b->binds.items;
    for (uint32_t s = 0; s < reader->model->skin_count; s++) {
        for (uint32_t j = 0; b->of_skins[s] && j < reader->model->skins[s].joint_count; j++)
            b->of_skins[s][j] = binds[b->of_skins[s][j]].joint;
    }
    for (uint32_t n = 0; n < reader->model->node_count; n++) {
        if (b->of_nodes[n] != LIMN_FORMAT_NONE) b->of_nodes[n] = binds[b->of_nodes[n]].joint;
    }
    reader->skin_joints = b->of_skins;
    reader->whole_joints = b->of_nodes;
}

limn_bake_status limni_model_read_skeleton(limni_model_reader *reader) {
    const limni_model *const model = reader->model;
    const uint32_t count = model->node_count;
    binder b = {
        .reader = reader,
        .first = limni_allocate(reader->context, count, sizeof *b.first),
        .of_nodes = limni_allocate(reader->context, count, sizeof *b.of_nodes),
        .of_skins = limni_allocate_zeroed(reader->context, model->skin_count, sizeof *b.of_skins),
    };
    if (!b.first || !b.of_nodes || !b.of_skins) return LIMN_BAKE_MEMORY;
    memset(b.first, 0xff, count * sizeof *b.first);
    memset(b.of_nodes, 0xff, count * sizeof *b.of_nodes);
    LIMNI_TRY(bind_meshes(&b));
    LIMNI_TRY(add_joints(&b));
    list_joints(&b);
    limni_release(reader->context, b.binds.items);
    limni_release(reader->context, b.first);
    return LIMN_BAKE_OK;
}
