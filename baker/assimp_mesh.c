/* SPDX-License-Identifier: MIT */
/* Meshes: a part for each of those that assimp makes of one, which differ in their materials. */
#include "assimp_reader.h"

#include "mesh.h"

#include <math.h>
#include <stdio.h>

/// A part at work.
typedef struct reading {
    const limni_assimp_reader *reader;
    const struct aiMesh *from;
    limni_model_part *part;
} reading;

static limn_bake_status refuse(const reading *r, const char *text) {
    return limni_fail(r->reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: %s", r->reader->model->path,
                      r->part->label, text);
}

static limn_bake_status copy_vectors(const reading *r, const struct aiVector3D *from,
                                     const char *what, float (**copy)[3]) {
    const uint32_t count = r->part->vertex_count;
    *copy = limni_allocate(r->reader->context, count, sizeof **copy);
    if (!*copy) return LIMN_BAKE_MEMORY;
    for (uint32_t v = 0; v < count; v++) {
        const float vector[3] = {from[v].x, from[v].y, from[v].z};
        for (int axis = 0; axis < 3; axis++) {
            char text[96];
            (*copy)[v][axis] = vector[axis];
            if (isfinite(vector[axis])) continue;
            snprintf(text, sizeof text, "%s of vertex %u is not finite", what, v);
            return refuse(r, text);
        }
    }
    return LIMN_BAKE_OK;
}

// ---- Faces

/// Points and lines are passed over.
static bool is_face(const struct aiFace *face) {
    return face->mNumIndices >= 3 && face->mIndices;
}

static limn_bake_status count_faces(const reading *r, uint32_t *corner_count) {
    limni_model_part *const part = r->part;
    uint64_t corners = 0;
    const unsigned count = r->from->mFaces ? r->from->mNumFaces : 0;
    for (unsigned f = 0; f < count; f++) {
        if (!is_face(&r->from->mFaces[f])) continue;
        part->face_count++;
        corners += r->from->mFaces[f].mNumIndices;
    }
    if (part->face_count < count)
        limni_note(r->reader->context, "%s: %s: %u points and lines are passed over",
                   r->reader->model->path, part->label, count - part->face_count);
    if (corners > LIMNI_CORNERS_MAX) return refuse(r, "too many faces");
    *corner_count = (uint32_t)corners;
    return LIMN_BAKE_OK;
}

static limn_bake_status read_faces(const reading *r) {
    limni_model_part *const part = r->part;
    uint32_t corner_count = 0, face = 0, corner = 0;
    LIMNI_TRY(count_faces(r, &corner_count));
    part->corners = limni_allocate(r->reader->context, corner_count, sizeof *part->corners);
    part->face_offsets = limni_allocate(r->reader->context, (size_t)part->face_count + 1,
                                        sizeof *part->face_offsets);
    if (!part->corners || !part->face_offsets) return LIMN_BAKE_MEMORY;
    for (unsigned f = 0; face < part->face_count; f++) {
        const struct aiFace *const from = &r->from->mFaces[f];
        if (!is_face(from)) continue;
        part->face_offsets[face++] = corner;
        for (unsigned c = 0; c < from->mNumIndices; c++)
            part->corners[corner++] = from->mIndices[c];
    }
    part->face_offsets[face] = corner;
    return LIMN_BAKE_OK;
}

// ---- Texture coordinates and colours

/// Assimp's v runs up, as that of the files does; ours runs down, as glTF's does.
static limn_bake_status read_uvs(const reading *r) {
    limni_model_part *const part = r->part;
    for (uint32_t set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; set++) {
        if (r->from->mTextureCoords[set]) part->uv_count = set + 1;
    }
    part->uvs = limni_allocate_zeroed(r->reader->context, part->uv_count, sizeof *part->uvs);
    if (!part->uvs) return LIMN_BAKE_MEMORY;
    for (uint32_t set = 0; set < part->uv_count; set++) {
        if (!r->from->mTextureCoords[set]) continue;
        LIMNI_TRY(copy_vectors(r, r->from->mTextureCoords[set], "a texture coordinate",
                               &part->uvs[set].values));
        for (uint32_t v = 0; v < part->vertex_count; v++) {
            part->uvs[set].values[v][1] = 1 - part->uvs[set].values[v][1];
            part->uvs[set].values[v][2] = 0;
        }
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_colour_set(const reading *r, const struct aiColor4D *from,
                                        limni_model_set *set) {
    set->values = limni_allocate(r->reader->context, r->part->vertex_count, sizeof *set->values);
    if (!set->values) return LIMN_BAKE_MEMORY;
    for (uint32_t v = 0; v < r->part->vertex_count; v++) {
        const float colour[3] = {from[v].r, from[v].g, from[v].b};
        for (int k = 0; k < 3; k++) {
            if (!isfinite(colour[k])) return refuse(r, "a colour is not finite");
            set->values[v][k] = colour[k];
        }
        set->has_alpha |= from[v].a != 1;
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_colours(const reading *r) {
    limni_model_part *const part = r->part;
    for (uint32_t set = 0; set < AI_MAX_NUMBER_OF_COLOR_SETS; set++) {
        if (r->from->mColors[set]) part->colour_count = set + 1;
    }
    part->colours =
        limni_allocate_zeroed(r->reader->context, part->colour_count, sizeof *part->colours);
    if (!part->colours) return LIMN_BAKE_MEMORY;
    for (uint32_t set = 0; set < part->colour_count; set++) {
        if (r->from->mColors[set])
            LIMNI_TRY(read_colour_set(r, r->from->mColors[set], &part->colours[set]));
    }
    return LIMN_BAKE_OK;
}

// ---- What moves vertices

/// `first_joint` is that of this part in the skin, which has those of all parts.
static limn_bake_status read_influences(const reading *r, uint32_t first_joint) {
    const struct aiMesh *const from = r->from;
    limni_model_part *const part = r->part;
    uint64_t count = 0;
    for (unsigned b = 0; b < from->mNumBones; b++)
        count += from->mBones[b]->mWeights ? from->mBones[b]->mNumWeights : 0;
    if (count > UINT32_MAX) return refuse(r, "too many weights");
    part->influences = limni_allocate(r->reader->context, (size_t)count, sizeof *part->influences);
    if (!part->influences) return LIMN_BAKE_MEMORY;
    for (unsigned b = 0; b < from->mNumBones; b++) {
        const struct aiBone *const bone = from->mBones[b];
        for (unsigned w = 0; bone->mWeights && w < bone->mNumWeights; w++) {
            const struct aiVertexWeight *const weight = &bone->mWeights[w];
            if (!isfinite(weight->mWeight)) return refuse(r, "a weight is not finite");
            part->influences[part->influence_count++] =
                (limni_model_influence){weight->mVertexId, first_joint + b, weight->mWeight};
        }
    }
    return LIMN_BAKE_OK;
}

/// Assimp has the places that morph targets move vertices to.
static limn_bake_status read_targets(const reading *r) {
    limni_model_part *const part = r->part;
    part->target_count = r->from->mAnimMeshes ? r->from->mNumAnimMeshes : 0;
    part->targets =
        limni_allocate_zeroed(r->reader->context, part->target_count, sizeof *part->targets);
    if (!part->targets) return LIMN_BAKE_MEMORY;
    for (uint32_t t = 0; t < part->target_count; t++) {
        const struct aiAnimMesh *const target = r->from->mAnimMeshes[t];
        if (!target->mVertices) continue;
        if (target->mNumVertices != part->vertex_count)
            return refuse(r, "a morph target has another number of vertices");
        LIMNI_TRY(copy_vectors(r, target->mVertices, "a morph target's place", &part->targets[t]));
        for (uint32_t v = 0; v < part->vertex_count; v++) {
            for (int axis = 0; axis < 3; axis++)
                part->targets[t][v][axis] -= part->positions[v][axis];
        }
    }
    return LIMN_BAKE_OK;
}

/// Of FBX assimp has no weights at rest: it says 1 for what has no shapes in between.
static limn_bake_status describe_targets(const limni_assimp_reader *reader,
                                         const struct aiMesh *from, const limni_model_part *part,
                                         limni_model_mesh *mesh) {
    limni_context *const context = reader->context;
    const uint32_t count = part->target_count;
    mesh->target_names = limni_allocate(context, count, sizeof *mesh->target_names);
    mesh->weights = limni_allocate_zeroed(context, count, sizeof *mesh->weights);
    if (!mesh->target_names || !mesh->weights) return LIMN_BAKE_MEMORY;
    mesh->target_name_count = mesh->weight_count = count;
    for (uint32_t t = 0; t < count; t++) {
        const struct aiAnimMesh *const target = from->mAnimMeshes[t];
        mesh->target_names[t] = limni_assimp_text(context, &target->mName);
        if (!mesh->target_names[t]) return LIMN_BAKE_MEMORY;
        if (!reader->is_fbx) mesh->weights[t] = (double)target->mWeight;
        if (reader->is_fbx && target->mWeight != 1)
            limni_note(context,
                       "%s: %s: morph target '%s' is one of several shapes on the way to one: each "
                       "becomes a target of its own",
                       reader->model->path, part->label, mesh->target_names[t]);
    }
    if (count && reader->is_fbx)
        limni_note(context, "%s: %s: the weights of its morph targets at rest are lost, and are 0",
                   reader->model->path, part->label);
    return LIMN_BAKE_OK;
}

// ---- Parts

static limn_bake_status read_part(const reading *r, uint32_t first_joint) {
    limni_model_part *const part = r->part;
    if (r->from->mNumVertices > LIMNI_CORNERS_MAX) return refuse(r, "too many vertices");
    part->vertex_count = r->from->mNumVertices;
    part->material = (int)(r->from->mMaterialIndex & INT32_MAX);
    LIMNI_TRY(copy_vectors(r, r->from->mVertices, "the place", &part->positions));
    LIMNI_TRY(read_faces(r));
    LIMNI_TRY(read_uvs(r));
    LIMNI_TRY(read_colours(r));
    LIMNI_TRY(read_influences(r, first_joint));
    return read_targets(r);
}

static limn_bake_status read_mesh(const limni_assimp_reader *reader, const struct aiNode *node,
                                  limni_model_mesh *mesh) {
    uint32_t first_joint = 0;
    mesh->name = "";
    mesh->parts = limni_allocate_zeroed(reader->context, node->mNumMeshes, sizeof *mesh->parts);
    if (!mesh->parts) return LIMN_BAKE_MEMORY;
    for (unsigned m = 0; m < node->mNumMeshes; m++) {
        limni_model_part *const part = &mesh->parts[mesh->part_count];
        const unsigned index = node->mMeshes[m];
        if (index >= reader->scene->mNumMeshes)
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: node '%.60s' has mesh %u, but there are %u", reader->model->path,
                              node->mName.data, index, reader->scene->mNumMeshes);
        const struct aiMesh *const from = reader->scene->mMeshes[index];
        const reading r = {reader, from, part};
        snprintf(part->label, sizeof part->label, "mesh %u '%.60s'", index, from->mName.data);
        if (!from->mVertices || from->mNumVertices == 0) {
            limni_note(reader->context, "%s: %s: it has no vertices; it is passed over",
                       reader->model->path, part->label);
        } else {
            LIMNI_TRY(read_part(&r, first_joint));
            if (part->face_count == 0) {
                limni_note(reader->context, "%s: %s: it has no faces; it is passed over",
                           reader->model->path, part->label);
                *part = (limni_model_part){0};
            } else if (mesh->part_count++ == 0) {
                mesh->name = limni_assimp_text(reader->context, &from->mName);
                if (!mesh->name) return LIMN_BAKE_MEMORY;
                LIMNI_TRY(describe_targets(reader, from, part, mesh));
            }
        }
        first_joint += from->mNumBones;
    }
    return LIMN_BAKE_OK;
}

limn_bake_status limni_assimp_read_meshes(const limni_assimp_reader *reader) {
    limni_model *const model = reader->model;
    model->meshes =
        limni_allocate_zeroed(reader->context, model->mesh_count, sizeof *model->meshes);
    model->skins = limni_allocate_zeroed(reader->context, model->skin_count, sizeof *model->skins);
    if (!model->meshes || !model->skins) return LIMN_BAKE_MEMORY;
    for (uint32_t n = 0; n < model->node_count; n++) {
        const limni_model_node *const node = &model->nodes[n];
        if (node->mesh >= 0)
            LIMNI_TRY(read_mesh(reader, reader->nodes[n], &model->meshes[node->mesh]));
        if (node->skin >= 0)
            LIMNI_TRY(limni_assimp_read_skin(reader, reader->nodes[n], &model->skins[node->skin]));
    }
    return LIMN_BAKE_OK;
}
