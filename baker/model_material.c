/* SPDX-License-Identifier: MIT */
/* Materials and the images of their base colour. */
#include "model_reader.h"

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
static limn_bake_status add_bytes(limni_model_reader *reader, const limni_model_image *image,
                                  const char *label, limn_file_image *record) {
    limni_character *const character = reader->scene->character;
    if (!image->bytes && image->uri[0]) {
        limni_note(reader->context,
                   "%s: %s: the texture '%s' is missing: there is no such regular file in the "
                   "folder of the document",
                   reader->model->path, label, image->uri);
        return LIMN_BAKE_OK;
    }
    if (!image->bytes || !is_png_or_jpeg(image->bytes, image->size)) {
        limni_note(reader->context, "%s: %s: it is left out: it is neither PNG nor JPEG",
                   reader->model->path, label);
        return LIMN_BAKE_OK;
    }
    if (!reader->context->desc.images) return LIMN_BAKE_OK;
    record->offset = character->image_bytes.count;
    record->size = image->size;
    return limni_list_add(reader->context, &character->image_bytes, image->bytes,
                          (size_t)image->size, 1);
}

/// As the file has it, added when it is first asked for.
static limn_bake_status find_image(limni_model_reader *reader, int index, uint32_t *added) {
    limni_character *const character = reader->scene->character;
    *added = LIMN_FORMAT_NONE;
    if (index < 0) return LIMN_BAKE_OK;
    if ((uint32_t)index >= reader->model->image_count)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: there is no image %d",
                          reader->model->path, index);
    const limni_model_image *const image = &reader->model->images[index];
    if (reader->images[index] == LIMN_FORMAT_NONE) {
        limn_file_image record = {0};
        limni_label label;
        limni_label_make(label, "image", (uint32_t)index, image->name);
        const char *const name = image->uri[0] ? image->uri : image->name[0] ? image->name : label;
        LIMNI_TRY(limni_character_add_text(reader->context, character, name, &record.name));
        LIMNI_TRY(add_bytes(reader, image, label, &record));
        reader->images[index] = character->images.count;
        LIMNI_TRY(limni_list_add(reader->context, &character->images, &record, 1, sizeof record));
    }
    *added = reader->images[index];
    return LIMN_BAKE_OK;
}

static limn_bake_status add_material(limni_model_reader *reader, uint32_t index) {
    limni_character *const character = reader->scene->character;
    const limni_model_material *const from = &reader->model->materials[index];
    limn_file_material record = {.texture_channel = from->uv_set};
    limni_label label;
    limni_label_make(label, "material", index, from->name);
    for (int i = 0; i < 4; i++) {
        record.base_colour[i] = (float)from->base_colour[i];
        if (!isfinite(record.base_colour[i]))
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: its colour is not finite", reader->model->path, label);
    }
    if (from->mistake)
        limni_note(reader->context, "%s: %s: %s", reader->model->path, label, from->mistake);
    if (from->passed_over[0])
        limni_note(reader->context, "%s: %s: only its base colour is read, not %s",
                   reader->model->path, label, from->passed_over);
    LIMNI_TRY(limni_character_add_text(reader->context, character,
                                       from->name[0] ? from->name : label, &record.name));
    LIMNI_TRY(find_image(reader, from->image, &record.image));
    reader->materials[index] = character->materials.count;
    return limni_list_add(reader->context, &character->materials, &record, 1, sizeof record);
}

limn_bake_status limni_model_find_material(limni_model_reader *reader, int index,
                                           uint32_t *material) {
    *material = LIMN_FORMAT_NONE;
    if (index < 0) return LIMN_BAKE_OK;
    if ((uint32_t)index >= reader->model->material_count)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: a mesh has material %d, but there are %u", reader->model->path,
                          index, reader->model->material_count);
    if (reader->materials[index] == LIMN_FORMAT_NONE)
        LIMNI_TRY(add_material(reader, (uint32_t)index));
    *material = reader->materials[index];
    return LIMN_BAKE_OK;
}
