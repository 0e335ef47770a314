/* SPDX-License-Identifier: MIT */
/* Materials, and the bytes of images where they lie in buffers. */
#include "gltf_reader.h"

#include <stdio.h>

/// A texture is an image; the other things that it is are for the graphics library.
static limn_bake_status find_image(const limni_gltf_reader *reader, int texture,
                                   limni_model_material *material) {
    const limni_gltf *const document = reader->document;
    const bool known = texture >= 0 && (uint32_t)texture < document->texture_count;
    material->image = known ? document->textures[texture] : -1;
    if (texture < 0 || (material->image >= 0 && (uint32_t)material->image < document->image_count))
        return LIMN_BAKE_OK;
    char *const mistake = limni_allocate(reader->context, 80, 1);
    if (!mistake) return LIMN_BAKE_MEMORY;
    snprintf(mistake, 80, "its texture %d has no image that is understood", texture);
    material->image = -1;
    material->mistake = mistake;
    return LIMN_BAKE_OK;
}

static limn_bake_status read_image(const limni_gltf_reader *reader, uint32_t index) {
    const limni_gltf *const document = reader->document;
    const limni_gltf_image *const from = &document->images[index];
    limni_model_image *const image = &reader->model->images[index];
    limni_label label;
    *image = (limni_model_image){from->name, from->uri, from->bytes, from->size};
    if (from->view < 0 || (uint32_t)from->view >= document->view_count) return LIMN_BAKE_OK;
    const limni_gltf_view *const view = &document->views[from->view];
    const limni_gltf_buffer *const buffer =
        view->buffer >= 0 && (uint32_t)view->buffer < document->buffer_count
            ? &document->buffers[view->buffer]
            : NULL;
    if (!buffer || view->offset > buffer->size || view->size > buffer->size - view->offset)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: %s: buffer view %d reaches beyond its buffer", document->path,
                          limni_label_make(label, "image", index, from->name), from->view);
    image->bytes = buffer->bytes + view->offset;
    image->size = view->size;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_materials(const limni_gltf_reader *reader) {
    const limni_gltf *const document = reader->document;
    limni_model *const model = reader->model;
    model->material_count = document->material_count;
    model->image_count = document->image_count;
    model->materials =
        limni_allocate_zeroed(reader->context, model->material_count, sizeof *model->materials);
    model->images = limni_allocate(reader->context, model->image_count, sizeof *model->images);
    if (!model->materials || !model->images) return LIMN_BAKE_MEMORY;
    for (uint32_t i = 0; i < model->image_count; i++)
        LIMNI_TRY(read_image(reader, i));
    for (uint32_t m = 0; m < model->material_count; m++) {
        const limni_gltf_material *const from = &document->materials[m];
        limni_model_material *const material = &model->materials[m];
        material->name = from->name;
        material->uv_set = from->base_channel;
        material->passed_over = from->ignored;
        for (int i = 0; i < 4; i++)
            material->base_colour[i] = from->base_colour[i];
        LIMNI_TRY(find_image(reader, from->base_texture, material));
    }
    return LIMN_BAKE_OK;
}
