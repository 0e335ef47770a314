/* SPDX-License-Identifier: MIT */
/*
 * Stands in for a GPU, so that the example needs no window and no driver: draws triangles into a
 * picture. A game has its renderer here, and nothing of this.
 */
#ifndef GPU_H
#define GPU_H

#include <limn/limn.h>

/// What the vertex buffer holds.
typedef struct gpu_vertex {
    float position[3];
    uint8_t colour[4]; ///< linear red, green, blue, and 255
} gpu_vertex;

typedef struct gpu_picture {
    uint32_t width, height; ///< of the samples: there are 2 x 2 for each pixel
    uint16_t (*colours)[3]; ///< [height][width] linear
    float *nearness;        ///< [height][width] 1 / distance: the depth buffer
    float eye[3];
    float axes[3][3]; ///< of the camera: right, up, and away from the viewer
    float scale;      ///< samples of a unit of length at distance 1
} gpu_picture;

/// Returns false if memory ran out; free the picture in either case.
bool gpu_picture_create(gpu_picture *picture, uint32_t width, uint32_t height);
void gpu_picture_free(gpu_picture *picture);

/// The camera: what limn_view_perspective() takes.
void gpu_picture_look(gpu_picture *picture, const float eye[3], const float target[3],
                      const float up[3], float fov);

/// What glMultiDrawElementsIndirect() does with these draws, 16-bit indices and triangles. Triangles
/// that reach behind the eye are left out.
void gpu_multi_draw_elements_indirect(gpu_picture *picture, const gpu_vertex *vertices,
                                      const uint16_t *indices, const limn_draw *draws,
                                      uint32_t draw_count);

/// Returns false if the file cannot be written.
bool gpu_picture_write_png(const gpu_picture *picture, const char *path);

#endif
