/* SPDX-License-Identifier: MIT */
#include "gpu.h"

#include <math.h>
#include <png.h>
#include <stdlib.h>

enum { SAMPLES = 2 }; ///< along each side of a pixel

bool gpu_picture_create(gpu_picture *picture, uint32_t width, uint32_t height) {
    static const uint16_t background[3] = {2200, 2300, 2600};
    *picture = (gpu_picture){.width = SAMPLES * width, .height = SAMPLES * height};
    const size_t count = (size_t)picture->width * picture->height;
    picture->colours = malloc(count * sizeof *picture->colours);
    picture->nearness = calloc(count, sizeof *picture->nearness);
    if (!picture->colours || !picture->nearness) return false;
    for (size_t i = 0; i < 3 * count; i++)
        picture->colours[i / 3][i % 3] = background[i % 3];
    return true;
}

void gpu_picture_free(gpu_picture *picture) {
    free(picture->colours);
    free(picture->nearness);
}

// -------------------------------------------------------------------------------------------------
// The camera

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const float a[3], const float b[3], float out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void normalise(float v[3]) {
    const float length = sqrtf(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

void gpu_picture_look(gpu_picture *picture, const float eye[3], const float target[3],
                      const float up[3], float fov) {
    float(*const axes)[3] = picture->axes;
    for (int i = 0; i < 3; i++) {
        picture->eye[i] = eye[i];
        axes[2][i] = target[i] - eye[i];
    }
    cross(axes[2], up, axes[0]);
    cross(axes[0], axes[2], axes[1]);
    for (int i = 0; i < 3; i++)
        normalise(axes[i]);
    picture->scale = (float)picture->height / (2 * tanf(fov / 2));
}

// -------------------------------------------------------------------------------------------------
// Triangles

/// A vertex on the screen.
typedef struct corner {
    float x, y, nearness;
    const uint8_t *colour;
} corner;

static corner project(const gpu_picture *picture, const gpu_vertex *vertex) {
    float way[3];
    for (int i = 0; i < 3; i++)
        way[i] = vertex->position[i] - picture->eye[i];
    const float nearness = 1 / dot(way, picture->axes[2]);
    const float scale = picture->scale * nearness;
    return (corner){.x = (float)picture->width / 2 + scale * dot(way, picture->axes[0]),
                    .y = (float)picture->height / 2 - scale * dot(way, picture->axes[1]),
                    .nearness = nearness,
                    .colour = vertex->colour};
}

/// Twice the area of the triangle of a side and a point.
static float area(const corner *a, const corner *b, float x, float y) {
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

static void shade(gpu_picture *picture, size_t at, const corner corners[3], const float parts[3]) {
    float nearness = 0;
    for (int c = 0; c < 3; c++)
        nearness += parts[c] * corners[c].nearness;
    if (nearness <= picture->nearness[at]) return;
    picture->nearness[at] = nearness;
    for (int i = 0; i < 3; i++) {
        float colour = 0;
        for (int c = 0; c < 3; c++)
            colour += parts[c] * (float)corners[c].colour[i];
        picture->colours[at][i] = (uint16_t)(257 * colour);
    }
}

static uint32_t clamp_sample(float value, uint32_t count) {
    return value < 0 ? 0 : value > (float)count ? count : (uint32_t)value;
}

static void fill(gpu_picture *picture, const corner corners[3]) {
    const float whole = area(&corners[0], &corners[1], corners[2].x, corners[2].y);
    if (whole == 0) return;
    const float *const xs[3] = {&corners[0].x, &corners[1].x, &corners[2].x};
    const float *const ys[3] = {&corners[0].y, &corners[1].y, &corners[2].y};
    float low[2] = {*xs[0], *ys[0]}, high[2] = {*xs[0], *ys[0]};
    for (int c = 1; c < 3; c++) {
        low[0] = fminf(low[0], *xs[c]), high[0] = fmaxf(high[0], *xs[c]);
        low[1] = fminf(low[1], *ys[c]), high[1] = fmaxf(high[1], *ys[c]);
    }
    for (uint32_t y = clamp_sample(low[1], picture->height),
                  y_end = clamp_sample(high[1] + 1, picture->height);
         y < y_end; y++) {
        for (uint32_t x = clamp_sample(low[0], picture->width),
                      x_end = clamp_sample(high[0] + 1, picture->width);
             x < x_end; x++) {
            float parts[3];
            for (int c = 0; c < 3; c++)
                parts[c] = area(&corners[(c + 1) % 3], &corners[(c + 2) % 3], (float)x + 0.5f,
                                (float)y + 0.5f) /
                           whole;
            if (parts[0] >= 0 && parts[1] >= 0 && parts[2] >= 0)
                shade(picture, (size_t)y * picture->width + x, corners, parts);
        }
    }
}

void gpu_multi_draw_elements_indirect(gpu_picture *picture, const gpu_vertex *vertices,
                                      const uint16_t *indices, const limn_draw *draws,
                                      uint32_t draw_count) {
    for (const limn_draw *draw = draws; draw < draws + draw_count; draw++) {
        const gpu_vertex *const first = vertices + draw->base_vertex;
        const uint16_t *const rows = indices + draw->first_index;
        for (uint32_t i = 0; i < draw->index_count; i += 3) {
            corner corners[3];
            bool visible = true;
            for (int c = 0; c < 3; c++) {
                corners[c] = project(picture, &first[rows[i + (uint32_t)c]]);
                visible = visible && corners[c].nearness > 0;
            }
            if (visible) fill(picture, corners);
        }
    }
}

// -------------------------------------------------------------------------------------------------
// The file

bool gpu_picture_write_png(const gpu_picture *picture, const char *path) {
    const uint32_t width = picture->width / SAMPLES, height = picture->height / SAMPLES;
    uint16_t(*const pixels)[3] = malloc((size_t)width * height * sizeof *pixels);
    if (!pixels) return false;
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t i = 0; i < 3 * width; i++) {
            uint32_t sum = 0;
            for (uint32_t s = 0; s < SAMPLES * SAMPLES; s++)
                sum += picture->colours[(SAMPLES * y + s / SAMPLES) * picture->width +
                                        SAMPLES * (i / 3) + s % SAMPLES][i % 3];
            pixels[y * width + i / 3][i % 3] = (uint16_t)(sum / (SAMPLES * SAMPLES));
        }
    }
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = width,
                       .height = height,
                       .format = PNG_FORMAT_LINEAR_RGB}; // written as sRGB, of 8 bits
    const bool written = png_image_write_to_file(&image, path, 1, pixels, 0, NULL) != 0;
    free(pixels);
    return written;
}
