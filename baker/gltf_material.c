/* SPDX-License-Identifier: MIT */
/* Materials and the images of their base colour. */
#include "gltf_reader.h"

#include "mesh.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Whether bytes begin as those of a PNG or JPEG file.
static bool is_png_or_jpeg(const unsigned char *bytes, uint64_t size) {
    return (size >= 4 && memcmp(bytes, "\x89PNG", 4) == 0) ||
           (size >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0);
}

/// The bytes of an image; none, with a note, where they are not to be had.
static limn_bake_status add_bytes(limni_gltf_reader *reader, const limni_gltf_image *image,
                                  const char *label, limn_file_image *record) {
    const limni_gltf *const document = reader->document;
    limni_character *const character = reader->scene->character;
    const unsigned char *bytes = image->bytes;
    uint64_t size = image->size;
    if (image->view >= 0 && (uint32_t)image->view < document->view_count) {
        const limni_gltf_view *const view = &document->views[image->view];
        const limni_gltf_buffer *const buffer =
            view->buffer >= 0 && (uint32_t)view->buffer < document->buffer_count
                ? &document->buffers[view->buffer]
                : NULL;
        if (!buffer || view->offset > buffer->size || view->size > buffer->size - view->offset)
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: buffer view %d reaches beyond its buffer", document->path,
                              label, image->view);
        bytes = buffer->bytes + view->offset;
        size = view->size;
    }
    if (!bytes && image->uri[0]) {
        limni_note(reader->context,
                   "%s: %s: the texture '%s' is missing: there is no such regular file in the "
                   "folder of the document",
                   document->path, label, image->uri);
        return LIMN_BAKE_OK;
    }
    if (!bytes || !is_png_or_jpeg(bytes, size)) {
        limni_note(reader->context, "%s: %s: it is left out: it is neither PNG nor JPEG",
                   document->path, label);
        return LIMN_BAKE_OK;
    }
    if (!reader->context->desc.images) return LIMN_BAKE_OK;
    record->offset = character->image_bytes.count;
    record->size = size;
    return limni_list_add(reader->context, &character->image_bytes, bytes, (size_t)size, 1);
}

static limn_bake_status add_image(limni_gltf_reader *reader, uint32_t index, uint32_t *added) {
    limni_character *const character = reader->scene->character;
    const limni_gltf_image *const image = &reader->document->images[index];
    limn_file_image record = {0};
    limni_gltf_label label;
    limni_gltf_name(label, "image", index, image->name);
    const char *const name = image->uri[0] ? image->uri : image->name[0] ? image->name : label;
    LIMNI_TRY(limni_character_add_text(reader->context, character, name, &record.name));
    LIMNI_TRY(add_bytes(reader, image, label, &record));
    *added = character->images.count;
    return limni_list_add(reader->context, &character->images, &record, 1, sizeof record);
}

static limn_bake_status add_texture(limni_gltf_reader *reader, const char *label, int texture,
                                    uint32_t *added) {
    const limni_gltf *const document = reader->document;
    const bool known = texture >= 0 && (uint32_t)texture < document->texture_count;
    const int image = known ? document->textures[texture] : -1;
    *added = LIMN_FORMAT_NONE;
    if (texture < 0) return LIMN_BAKE_OK;
    if (image < 0 || (uint32_t)image >= document->image_count) {
        limni_note(reader->context, "%s: %s: its texture %d has no image that is understood",
                   document->path, label, texture);
        return LIMN_BAKE_OK;
    }
    if (reader->images[image] == LIMN_FORMAT_NONE)
        LIMNI_TRY(add_image(reader, (uint32_t)image, &reader->images[image]));
    *added = reader->images[image];
    return LIMN_BAKE_OK;
}

static limn_bake_status add_material(limni_gltf_reader *reader, uint32_t index) {
    limni_character *const character = reader->scene->character;
    const limni_gltf_material *const from = &reader->document->materials[index];
    limn_file_material record = {.texture_channel = from->base_channel};
    limni_gltf_label label;
    limni_gltf_name(label, "material", index, from->name);
    for (int i = 0; i < 4; i++) {
        record.base_colour[i] = (float)from->base_colour[i];
        if (!isfinite(record.base_colour[i]))
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: its colour is not finite", reader->document->path, label);
    }
    if (from->ignored[0])
        limni_note(reader->context, "%s: %s: only its base colour is read, not %s",
                   reader->document->path, label, from->ignored);
    LIMNI_TRY(limni_character_add_text(reader->context, character,
                                       from->name[0] ? from->name : label, &record.name));
    LIMNI_TRY(add_texture(reader, label, from->base_texture, &record.image));
    reader->materials[index] = character->materials.count;
    return limni_list_add(reader->context, &character->materials, &record, 1, sizeof record);
}

limn_bake_status limni_gltf_find_material(limni_gltf_reader *reader, int index,
                                          uint32_t *material) {
    *material = LIMN_FORMAT_NONE;
    if (index < 0) return LIMN_BAKE_OK;
    if ((uint32_t)index >= reader->document->material_count)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: a primitive has material %d, but there are %u",
                          reader->document->path, index, reader->document->material_count);
    if (reader->materials[index] == LIMN_FORMAT_NONE)
        LIMNI_TRY(add_material(reader, (uint32_t)index));
    *material = reader->materials[index];
    return LIMN_BAKE_OK;
}
