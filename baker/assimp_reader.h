/* SPDX-License-Identifier: MIT */
/*
 * From what assimp makes of an FBX or Collada document to a model. Its counts, pointers and numbers
 * are checked here; what is an index in the model is checked later.
 */
#ifndef LIMNI_ASSIMP_READER_H
#define LIMNI_ASSIMP_READER_H

#include "model.h"

#include <assimp/scene.h>

typedef struct limni_assimp_reader {
    limni_context *context;
    const struct aiScene *scene;
    limni_model *model;
    bool is_fbx;
    const struct aiNode **nodes; ///< [model->node_count] of the model
} limni_assimp_reader;

/// The tree, with its meshes and skins numbered, but not yet read.
limn_bake_status limni_assimp_read_nodes(limni_assimp_reader *reader);
/// Makes one node of those that assimp makes of one of FBX, where it can.
limn_bake_status limni_assimp_collapse_pivots(const limni_assimp_reader *reader);
/// A mesh, of as many parts as assimp makes of it, and its skin for each node with meshes.
limn_bake_status limni_assimp_read_meshes(const limni_assimp_reader *reader);
limn_bake_status limni_assimp_read_skin(const limni_assimp_reader *reader,
                                        const struct aiNode *node, limni_model_skin *skin);
/// With the images of base colours, from the file itself or beside it.
limn_bake_status limni_assimp_read_materials(const limni_assimp_reader *reader);
/// Meshes must have been read.
limn_bake_status limni_assimp_read_animations(const limni_assimp_reader *reader);

/// The first node with a name, or -1.
int limni_assimp_find_node(const limni_assimp_reader *reader, const struct aiString *name);

/// A copy of a text, without control characters; NULL: out of memory, as the context says.
char *limni_assimp_text(limni_context *context, const struct aiString *text);

/// Copies the first three rows of a matrix; false where they are not finite, or the last is not
/// 0, 0, 0, 1.
bool limni_assimp_rows(const struct aiMatrix4x4 *matrix, float rows[3][4]);

#endif
