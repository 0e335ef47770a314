/* SPDX-License-Identifier: MIT */
/*
 * Assimp makes a chain of nodes of a node of FBX that has pivots or rotations before and after its
 * own: `hips_$AssimpFbx$_Translation`, `hips_$AssimpFbx$_PreRotation`, `hips`. Animations move nodes
 * of the chain where there are pivots. Otherwise they move the last with all of the chain's
 * transform, which then would count twice: such chains, and those that nothing moves, become one
 * node.
 */
#include "assimp_reader.h"
#include "model_reader.h"

#include <string.h>

typedef struct chain {
    const limni_assimp_reader *reader;
    const uint32_t *parents; ///< [node_count] or LIMN_FORMAT_NONE
    uint32_t top, last;      ///< nodes
} chain;

static const char *name_of(const chain *c, uint32_t node) {
    return c->reader->nodes[node]->mName.data;
}

/// Whether a node is one of those that assimp puts above the last.
static bool is_pivot(const chain *c, uint32_t node) {
    static const char tag[] = "_$AssimpFbx$_";
    if (node == LIMN_FORMAT_NONE || c->reader->model->nodes[node].child_count != 1) return false;
    const size_t length = strlen(name_of(c, c->last));
    return strncmp(name_of(c, node), name_of(c, c->last), length) == 0 &&
           strncmp(name_of(c, node) + length, tag, sizeof tag - 1) == 0;
}

static bool is_moved(const chain *c, uint32_t node) {
    const struct aiScene *const scene = c->reader->scene;
    for (unsigned a = 0; a < scene->mNumAnimations; a++) {
        const struct aiAnimation *const animation = scene->mAnimations[a];
        for (unsigned i = 0; animation->mChannels && i < animation->mNumChannels; i++) {
            if (strcmp(animation->mChannels[i]->mNodeName.data, name_of(c, node)) == 0) return true;
        }
    }
    return false;
}

/// Whether something moves nodes above the last.
static bool is_moved_above(const chain *c) {
    bool moved = false;
    for (uint32_t n = c->last; n != c->top;) {
        n = c->parents[n];
        moved |= is_moved(c, n);
    }
    return moved;
}

/// Gives the last node the transform of all, and the place of the first.
static void collapse(const chain *c) {
    limni_model_node *const nodes = c->reader->model->nodes;
    limni_model_node *const last = &nodes[c->last];
    limni_transform whole = limni_model_local(last);
    for (uint32_t n = c->last; n != c->top;) {
        n = c->parents[n];
        const limni_transform local = limni_model_local(&nodes[n]);
        whole = limni_transform_multiply(&local, &whole);
        nodes[n].child_count = 0;
    }
    for (int i = 0; i < 12; i++)
        last->matrix[4 * (i % 4) + i / 4] = whole.rows[i / 4][i % 4];
    const limni_model_node *const above = &nodes[c->parents[c->top]];
    for (uint32_t i = 0; i < above->child_count; i++) {
        if (above->children[i] == (int)c->top) above->children[i] = (int)c->last;
    }
}

static uint32_t *find_parents(const limni_assimp_reader *reader) {
    const limni_model *const model = reader->model;
    uint32_t *const parents = limni_allocate(reader->context, model->node_count, sizeof *parents);
    if (!parents) return NULL;
    memset(parents, 0xff, model->node_count * sizeof *parents);
    for (uint32_t n = 0; n < model->node_count; n++) {
        for (uint32_t c = 0; c < model->nodes[n].child_count; c++)
            parents[model->nodes[n].children[c]] = n;
    }
    return parents;
}

limn_bake_status limni_assimp_collapse_pivots(const limni_assimp_reader *reader) {
    uint32_t *const parents = find_parents(reader);
    if (!parents) return LIMN_BAKE_MEMORY;
    for (uint32_t n = 0; n < reader->model->node_count; n++) {
        chain c = {reader, parents, n, n};
        while (is_pivot(&c, parents[c.top]))
            c.top = parents[c.top];
        if (c.top == n) continue;
        if (!is_moved_above(&c) && parents[c.top] != LIMN_FORMAT_NONE)
            collapse(&c);
        else if (is_moved(&c, n))
            limni_note(reader->context,
                       "%s: node '%s': some animations move its pivots, and others all of it; the "
                       "latter are wrong",
                       reader->model->path, name_of(&c, n));
    }
    limni_release(reader->context, parents);
    return LIMN_BAKE_OK;
}
