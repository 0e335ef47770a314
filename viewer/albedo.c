/* SPDX-License-Identifier: MIT */
#include "albedo.h"

#include "limn/character.h"
#include "report.h"
#include <limits.h>
#include <math.h>
#include <stb/stb_image.h>
#include <stdio.h>
#include <stdlib.h>

/// The image of a material, or nothing.
typedef struct picture {
    stbi_uc *pixels; ///< [height][width][4]
    uint32_t width, height;
} picture;

static float decode_srgb(float value) {
    return value <= 0.04045f ? value / 12.92f : powf((value + 0.055f) / 1.055f, 2.4f);
}

static float encode_srgb(float value) {
    return value <= 0.0031308f ? value * 12.92f : 1.055f * powf(value, 1 / 2.4f) - 0.055f;
}

static void note_image(const limn_material *material, const char *what) {
    fprintf(stderr, "limn-view: note: the image '%s' of material '%s' is not shown: %s\n",
            material->image_name, material->name, what);
}

/// Notes what cannot be read, and leaves it out.
static picture read_picture(const limn_material *material) {
    picture read = {0};
    int width = 0, height = 0, channels = 0;
    if (!material->image_name) return read;
    if (!material->image_bytes) {
        note_image(material, "it is not in the file; bake it with --images");
    } else if (material->image_size > INT_MAX) {
        note_image(material, "it is too large");
    } else {
        read.pixels = stbi_load_from_memory(material->image_bytes, (int)material->image_size,
                                            &width, &height, &channels, 4);
        if (!read.pixels) note_image(material, stbi_failure_reason());
    }
    read.width = read.pixels ? (uint32_t)width : 0;
    read.height = read.pixels ? (uint32_t)height : 0;
    return read;
}

/// The layers get the size of the largest image.
static void fit(view_albedo *albedo, const picture *read) {
    uint32_t width = read->width, height = read->height;
    while (width > VIEW_ALBEDO_SIZE_MAX || height > VIEW_ALBEDO_SIZE_MAX) {
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    if (width > albedo->width) albedo->width = width;
    if (height > albedo->height) albedo->height = height;
}

static void fill_layer(const view_albedo *albedo, const limn_material *material,
                       const picture *read, uint8_t *texels) {
    float tables[4][256]; // of the image's bytes, multiplied with the base colour
    for (int c = 0; c < 4; c++) {
        for (int byte = 0; byte < 256; byte++) {
            const float encoded = (float)byte / 255;
            const float base = fminf(fmaxf(material->base_colour[c], 0), 1);
            tables[c][byte] = c < 3 ? encode_srgb(base * decode_srgb(encoded)) : base * encoded;
        }
    }
    for (uint32_t y = 0; y < albedo->height; y++) {
        for (uint32_t x = 0; x < albedo->width; x++) {
            static const stbi_uc white[4] = {255, 255, 255, 255};
            const size_t from_x = (size_t)x * read->width / albedo->width;
            const size_t from_y = (size_t)y * read->height / albedo->height;
            const stbi_uc *const from =
                read->pixels ? read->pixels + 4 * (from_y * read->width + from_x) : white;
            for (int c = 0; c < 4; c++)
                *texels++ = (uint8_t)(255 * tables[c][from[c]] + 0.5f);
        }
    }
}

static void read_pictures(view_albedo *albedo, const limn_pack *pack, picture *pictures) {
    for (uint32_t m = 0; m < albedo->layer_count; m++) {
        const limn_material material = limn_pack_material(pack, m);
        pictures[m] = read_picture(&material);
        fit(albedo, &pictures[m]);
    }
}

static bool fill_layers(view_albedo *albedo, const limn_pack *pack, const picture *pictures) {
    const size_t layer_size = (size_t)albedo->width * albedo->height * 4;
    albedo->texels = malloc(layer_size * albedo->layer_count);
    if (!albedo->texels) return view_fail("out of memory for %u materials", albedo->layer_count);
    for (uint32_t m = 0; m < albedo->layer_count; m++) {
        const limn_material material = limn_pack_material(pack, m);
        fill_layer(albedo, &material, &pictures[m], albedo->texels + m * layer_size);
    }
    return true;
}

bool view_albedo_make(view_albedo *albedo, const limn_pack *pack) {
    const uint32_t count = limn_pack_material_count(pack);
    *albedo = (view_albedo){.width = 1, .height = 1, .layer_count = count};
    if (count == 0) return true;
    if (count > VIEW_ALBEDO_LAYERS) albedo->layer_count = VIEW_ALBEDO_LAYERS;
    picture *const pictures = calloc(albedo->layer_count, sizeof *pictures);
    if (!pictures) return view_fail("out of memory for %u materials", count);
    read_pictures(albedo, pack, pictures);
    const bool made = fill_layers(albedo, pack, pictures);
    for (uint32_t m = 0; m < albedo->layer_count; m++)
        stbi_image_free(pictures[m].pixels);
    free(pictures);
    return made;
}

void view_albedo_free(view_albedo *albedo) {
    free(albedo->texels);
    *albedo = (view_albedo){0};
}
