/* SPDX-License-Identifier: MIT */
/* The skin of the meshes of a node: the bones of one mesh behind those of another. */
#include "assimp_reader.h"

static limn_bake_status read_bone(const limni_assimp_reader *reader, const struct aiMesh *mesh,
                                  const struct aiBone *bone, limni_model_skin *skin) {
    const uint32_t joint = skin->joint_count++;
    skin->joints[joint] = limni_assimp_find_node(reader, &bone->mName);
    if (skin->joints[joint] < 0)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: mesh '%.60s': its bone '%.60s' is no node", reader->model->path,
                          mesh->mName.data, bone->mName.data);
    if (!limni_assimp_rows(&bone->mOffsetMatrix, skin->inverse_binds[joint]))
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: mesh '%.60s': the inverse bind matrix of bone '%.60s' is not "
                          "finite, or its last row is not 0, 0, 0, 1",
                          reader->model->path, mesh->mName.data, bone->mName.data);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_assimp_read_skin(const limni_assimp_reader *reader,
                                        const struct aiNode *node, limni_model_skin *skin) {
    const struct aiScene *const scene = reader->scene;
    uint64_t count = 0;
    for (unsigned m = 0; m < node->mNumMeshes; m++)
        count += scene->mMeshes[node->mMeshes[m]]->mNumBones;
    if (count > UINT16_MAX)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: node '%.60s': too many bones",
                          reader->model->path, node->mName.data);
    skin->name = "";
    skin->joints = limni_allocate(reader->context, (size_t)count, sizeof *skin->joints);
    skin->inverse_binds =
        limni_allocate(reader->context, (size_t)count, sizeof *skin->inverse_binds);
    if (!skin->joints || !skin->inverse_binds) return LIMN_BAKE_MEMORY;
    for (unsigned m = 0; m < node->mNumMeshes; m++) {
        const struct aiMesh *const mesh = scene->mMeshes[node->mMeshes[m]];
        for (unsigned b = 0; b < mesh->mNumBones; b++)
            LIMNI_TRY(read_bone(reader, mesh, mesh->mBones[b], skin));
    }
    return LIMN_BAKE_OK;
}
