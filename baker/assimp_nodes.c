/* SPDX-License-Identifier: MIT */
/* The tree of nodes, and what all parts of it need. */
#include "assimp_reader.h"

#include "character.h"

#include <math.h>
#include <string.h>

char *limni_assimp_text(limni_context *context, const struct aiString *text) {
    const size_t length = strnlen(text->data, sizeof text->data);
    char *const copy = limni_allocate_zeroed(context, length + 1, 1);
    for (size_t c = 0; copy && c < length; c++)
        copy[c] = (char)((unsigned char)text->data[c] < ' ' ? '_' : text->data[c]);
    return copy;
}

bool limni_assimp_rows(const struct aiMatrix4x4 *m, float rows[3][4]) {
    const float from[4][4] = {{m->a1, m->a2, m->a3, m->a4},
                              {m->b1, m->b2, m->b3, m->b4},
                              {m->c1, m->c2, m->c3, m->c4},
                              {m->d1, m->d2, m->d3, m->d4}};
    bool good = from[3][0] == 0 && from[3][1] == 0 && from[3][2] == 0 && from[3][3] == 1;
    for (int i = 0; i < 12; i++) {
        rows[i / 4][i % 4] = from[i / 4][i % 4];
        good &= isfinite(from[i / 4][i % 4]) != 0;
    }
    return good;
}

int limni_assimp_find_node(const limni_assimp_reader *reader, const struct aiString *name) {
    for (uint32_t n = 0; n < reader->model->node_count; n++) {
        if (strncmp(reader->nodes[n]->mName.data, name->data, sizeof name->data) == 0)
            return (int)n;
    }
    return -1;
}

/// Nodes in the order of their distance from the root, so that children stand side by side.
static limn_bake_status list_nodes(limni_assimp_reader *reader) {
    limni_list list = {0};
    LIMNI_TRY(limni_list_add(reader->context, &list, &reader->scene->mRootNode, 1,
                             sizeof reader->scene->mRootNode));
    for (uint32_t n = 0; n < list.count; n++) {
        const struct aiNode *const node = ((struct aiNode **)list.items)[n];
        const uint32_t child_count = node->mChildren ? node->mNumChildren : 0;
        for (uint32_t c = 0; c < child_count; c++) {
            if (!node->mChildren[c] || list.count >= INT32_MAX)
                return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                                  "%s: node '%.60s': a child is missing", reader->model->path,
                                  node->mName.data);
            LIMNI_TRY(limni_list_add(reader->context, &list, &node->mChildren[c], 1,
                                     sizeof *node->mChildren));
        }
    }
    reader->nodes = list.items;
    reader->model->node_count = list.count;
    return LIMN_BAKE_OK;
}

/// Whether assimp found joints for any of the meshes of a node.
static bool has_skin(const limni_assimp_reader *reader, const struct aiNode *node) {
    for (unsigned m = 0; node->mMeshes && m < node->mNumMeshes; m++) {
        if (node->mMeshes[m] < reader->scene->mNumMeshes &&
            reader->scene->mMeshes[node->mMeshes[m]]->mNumBones > 0)
            return true;
    }
    return false;
}

static limn_bake_status read_node(const limni_assimp_reader *reader, uint32_t index,
                                  int *first_child) {
    limni_model *const model = reader->model;
    const struct aiNode *const from = reader->nodes[index];
    limni_model_node *const node = &model->nodes[index];
    float rows[3][4];
    node->name = limni_assimp_text(reader->context, &from->mName);
    node->child_count = from->mChildren ? from->mNumChildren : 0;
    node->children = limni_allocate(reader->context, node->child_count, sizeof *node->children);
    if (!node->name || !node->children) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < node->child_count; c++)
        node->children[c] = (*first_child)++;
    node->has_matrix = true;
    if (!limni_assimp_rows(&from->mTransformation, rows)) node->mistake = "its place is not finite";
    for (int i = 0; i < 12; i++)
        node->matrix[4 * (i % 4) + i / 4] = (double)rows[i / 4][i % 4];
    node->matrix[15] = 1;
    node->mesh = from->mNumMeshes ? (int)model->mesh_count++ : -1;
    node->skin = has_skin(reader, from) ? (int)model->skin_count++ : -1;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_assimp_read_nodes(limni_assimp_reader *reader) {
    const struct aiScene *const scene = reader->scene;
    limni_model *const model = reader->model;
    int first_child = 1;
    LIMNI_TRY(list_nodes(reader));
    model->nodes = limni_allocate_zeroed(reader->context, model->node_count, sizeof *model->nodes);
    if (!model->nodes) return LIMN_BAKE_MEMORY;
    for (uint32_t n = 0; n < model->node_count; n++)
        LIMNI_TRY(read_node(reader, n, &first_child));
    for (unsigned c = 0; c < scene->mNumCameras; c++) {
        const int node = limni_assimp_find_node(reader, &scene->mCameras[c]->mName);
        if (node >= 0) model->nodes[node].has_camera = true;
    }
    for (unsigned l = 0; l < scene->mNumLights; l++) {
        const int node = limni_assimp_find_node(reader, &scene->mLights[l]->mName);
        if (node >= 0) model->nodes[node].has_light = true;
    }
    return LIMN_BAKE_OK;
}
