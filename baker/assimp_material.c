/* SPDX-License-Identifier: MIT */
/* Materials and the images of their base colour, from the file itself or beside it. */
#include "assimp_reader.h"

#include "beside.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- Images

/// The texture inside the file that a path names: "*2", or the name that it had; NULL: none.
static const struct aiTexture *find_inside(const struct aiScene *scene, const char *path) {
    if (path[0] == '*') {
        const unsigned long index = strtoul(path + 1, NULL, 10);
        return index < scene->mNumTextures ? scene->mTextures[index] : NULL;
    }
    for (unsigned t = 0; t < scene->mNumTextures; t++) {
        if (strncmp(scene->mTextures[t]->mFilename.data, path, sizeof(struct aiString)) == 0)
            return scene->mTextures[t];
    }
    return NULL;
}

/// Files of the kinds that are read; others are told apart later, by their first bytes.
static limn_bake_status copy_inside(const limni_assimp_reader *reader,
                                    const struct aiTexture *texture, limni_model_image *image) {
    if (texture->mHeight != 0 || !texture->pcData) return LIMN_BAKE_OK; // texels, not a file
    unsigned char *const bytes = limni_allocate(reader->context, texture->mWidth, 1);
    if (!bytes) return LIMN_BAKE_MEMORY;
    memcpy(bytes, texture->pcData, texture->mWidth);
    image->bytes = bytes;
    image->size = texture->mWidth;
    return LIMN_BAKE_OK;
}

/// With the slashes of this system, and no "./" before it.
static void tidy(char *path) {
    for (char *c = path; *c; c++) {
        if (*c == '\\') *c = '/';
    }
    while (path[0] == '.' && path[1] == '/')
        memmove(path, path + 2, strlen(path + 2) + 1);
}

static limn_bake_status read_image(const limni_assimp_reader *reader, const struct aiString *path,
                                   int *index) {
    limni_context *const context = reader->context;
    limni_model *const model = reader->model;
    char *const name = limni_assimp_text(context, path);
    if (!name) return LIMN_BAKE_MEMORY;
    const struct aiTexture *const inside = find_inside(reader->scene, name);
    tidy(name);
    for (uint32_t i = 0; i < model->image_count; i++) {
        if (strcmp(model->images[i].name, name) != 0) continue;
        *index = (int)i;
        return LIMN_BAKE_OK;
    }
    limni_model_image *const image = &model->images[model->image_count];
    *image = (limni_model_image){.name = name, .uri = inside ? "" : name};
    *index = (int)model->image_count++;
    if (inside) return copy_inside(reader, inside, image);
    return limni_read_beside(context, model->path, name, &image->bytes, &image->size);
}

// ---- Materials

/// The words for textures of other kinds; "": there are none.
static limn_bake_status list_others(const limni_assimp_reader *reader,
                                    const struct aiMaterial *from, const char **words) {
    static const char *const names[] = {
        NULL,     NULL,        "specular",  "ambient",      "emissive",  "height",
        "normal", "shininess", "opacity",   "displacement", "lightmap",  "reflection",
        NULL,     "normal",    "emissive",  "metalness",    "roughness", "occlusion",
        NULL,     "sheen",     "clearcoat", "transmission"};
    enum { LIST_SIZE = 256 }; // more words than that are cut off
    char *const list = limni_allocate_zeroed(reader->context, LIST_SIZE, 1);
    if (!list) return LIMN_BAKE_MEMORY;
    for (size_t type = 0, length = 0; type < sizeof names / sizeof *names; type++) {
        if (!names[type] || aiGetMaterialTextureCount(from, (enum aiTextureType)type) == 0)
            continue;
        if (length < LIST_SIZE)
            length += (size_t)snprintf(list + length, LIST_SIZE - length, "%s%s texture",
                                       length ? ", " : "", names[type]);
    }
    *words = list;
    return LIMN_BAKE_OK;
}

static limn_bake_status read_texture(const limni_assimp_reader *reader,
                                     const struct aiMaterial *from,
                                     limni_model_material *material) {
    static const enum aiTextureType types[] = {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE};
    struct aiString path = {0};
    unsigned uv_set = 0;
    material->image = -1;
    for (size_t t = 0; t < sizeof types / sizeof *types && material->image < 0; t++) {
        if (aiGetMaterialTexture(from, types[t], 0, &path, NULL, &uv_set, NULL, NULL, NULL, NULL) !=
            AI_SUCCESS)
            continue;
        material->uv_set = uv_set;
        if (path.data[0] == '\0')
            material->mistake = "its texture names no file";
        else
            LIMNI_TRY(read_image(reader, &path, &material->image));
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_material(const limni_assimp_reader *reader,
                                      const struct aiMaterial *from,
                                      limni_model_material *material) {
    struct aiString name = {0};
    struct aiColor4D colour = {1, 1, 1, 1};
    aiGetMaterialString(from, AI_MATKEY_NAME, &name);
    if (aiGetMaterialColor(from, AI_MATKEY_BASE_COLOR, &colour) != AI_SUCCESS)
        aiGetMaterialColor(from, AI_MATKEY_COLOR_DIFFUSE, &colour);
    const float components[4] = {colour.r, colour.g, colour.b, colour.a};
    for (int i = 0; i < 4; i++)
        material->base_colour[i] = (double)components[i];
    material->name = limni_assimp_text(reader->context, &name);
    if (!material->name) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(list_others(reader, from, &material->passed_over));
    return read_texture(reader, from, material);
}

limn_bake_status limni_assimp_read_materials(const limni_assimp_reader *reader) {
    const struct aiScene *const scene = reader->scene;
    limni_model *const model = reader->model;
    model->material_count = scene->mMaterials ? scene->mNumMaterials : 0;
    model->materials =
        limni_allocate_zeroed(reader->context, model->material_count, sizeof *model->materials);
    // At most one for each.
    model->images = limni_allocate(reader->context, model->material_count, sizeof *model->images);
    if (!model->materials || !model->images) return LIMN_BAKE_MEMORY;
    for (uint32_t m = 0; m < model->material_count; m++)
        LIMNI_TRY(read_material(reader, scene->mMaterials[m], &model->materials[m]));
    return LIMN_BAKE_OK;
}
