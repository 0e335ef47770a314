/* SPDX-License-Identifier: MIT */
#include "image.h"

#include "output_file.h"
#include "report.h"
#include <math.h>
#include <png.h>
#include <stdlib.h>

enum { CHANNELS = 3 };

bool view_image_create(view_image *image, uint32_t width, uint32_t height) {
    *image = (view_image){.width = width, .height = height};
    image->pixels = calloc((size_t)width * height, CHANNELS);
    return image->pixels || view_fail("out of memory for a picture of %ux%u", width, height);
}

void view_image_flip(view_image *image) {
    const size_t row_size = (size_t)image->width * CHANNELS;
    for (uint32_t y = 0; y < image->height / 2; y++) {
        uint8_t *const upper = image->pixels + y * row_size;
        uint8_t *const lower = image->pixels + (image->height - 1 - y) * row_size;
        for (size_t i = 0; i < row_size; i++) {
            const uint8_t value = upper[i];
            upper[i] = lower[i];
            lower[i] = value;
        }
    }
}

static float decode_srgb(float value) {
    return value <= 0.04045f ? value / 12.92f : powf((value + 0.055f) / 1.055f, 2.4f);
}

static float encode_srgb(float light) {
    return light <= 0.0031308f ? light * 12.92f : 1.055f * powf(light, 1 / 2.4f) - 0.055f;
}

void view_image_halve(view_image *image) {
    float light[256];
    for (int value = 0; value < 256; value++)
        light[value] = decode_srgb((float)value / 255);

    const size_t row_size = (size_t)image->width * CHANNELS;
    uint8_t *out = image->pixels; // never ahead of what is still to be read
    for (size_t y = 0; y < image->height; y += 2) {
        for (size_t x = 0; x < image->width; x += 2) {
            const uint8_t *const in = image->pixels + y * row_size + x * CHANNELS;
            for (size_t channel = 0; channel < CHANNELS; channel++) {
                const uint8_t *const a = in + channel, *const b = a + row_size;
                const float sum =
                    light[a[0]] + light[a[CHANNELS]] + light[b[0]] + light[b[CHANNELS]];
                *out++ = (uint8_t)(encode_srgb(sum / 4) * 255 + 0.5f);
            }
        }
    }
    image->width /= 2;
    image->height /= 2;
}

bool view_image_write_png(const view_image *image, const char *path) {
    png_image description = {.version = PNG_IMAGE_VERSION,
                             .width = image->width,
                             .height = image->height,
                             .format = PNG_FORMAT_RGB};
    limni_output_file file;
    if (!limni_output_open(&file, path)) return view_fail("%s: %s", path, file.error);
    if (!png_image_write_to_stdio(&description, file.stream, 0, image->pixels, 0, NULL)) {
        limni_output_abandon(&file);
        return view_fail("%s: cannot write: %s", path, description.message);
    }
    return limni_output_commit(&file) || view_fail("%s: %s", path, file.error);
}

void view_image_free(view_image *image) {
    free(image->pixels);
    *image = (view_image){0};
}
