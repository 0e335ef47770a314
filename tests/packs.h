/* SPDX-License-Identifier: MIT */
/*
 * What tests of opening a baked file share: meshes, and the files that they become.
 */
#ifndef PACKS_H
#define PACKS_H

#include "limn/bake.h"

#include "blobs.h"

// ---- Meshes

typedef struct mesh_case {
    const char *name;
    const float *positions;
    const uint32_t *faces;
    uint32_t position_count, face_count;
    const uint32_t *face_sizes; ///< all the same; NULL: triangles
    const uint32_t *crease_edges;
    const float *crease_sharpness;
    uint32_t crease_count;
} mesh_case;

static const float tetrahedron_positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const uint32_t tetrahedron_faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
static const mesh_case tetrahedron = {.name = "tetrahedron",
                                      .positions = tetrahedron_positions,
                                      .faces = tetrahedron_faces,
                                      .position_count = 4,
                                      .face_count = 4};

/// The same surface with other numbers, another place and one control point that no face uses.
static const float twin_positions[] = {7, 7, 7, 3, 0, 0, 4, 0, 0, 3, 1, 0, 3, 0, 1};
static const uint32_t twin_faces[] = {4, 2, 3, 3, 2, 1, 1, 2, 4, 1, 4, 3};
static const mesh_case twin = {.name = "twin",
                               .positions = twin_positions,
                               .faces = twin_faces,
                               .position_count = 5,
                               .face_count = 4};

/// Three triangles around a corner of an open strip: several classes, all of them narrow.
static const float strip_positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 1};
static const uint32_t strip_faces[] = {0, 1, 2, 0, 2, 3, 0, 3, 4};
static const mesh_case strip = {.name = "strip",
                                .positions = strip_positions,
                                .faces = strip_faces,
                                .position_count = 5,
                                .face_count = 3};

/// A box without its lid: two classes of quads.
static const float box_positions[] = {0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0,
                                      0, 0, 1, 2, 0, 1, 2, 1, 1, 0, 1, 1};
static const uint32_t box_faces[] = {0, 3, 2, 1, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
static const uint32_t box_face_sizes[] = {4, 4, 4, 4, 4};
static const mesh_case box = {.name = "box",
                              .positions = box_positions,
                              .faces = box_faces,
                              .position_count = 8,
                              .face_count = 5,
                              .face_sizes = box_face_sizes};

/// A fan of WHEEL_SIZE triangles around vertex 0 with an open rim: its one class is wide.
enum { WHEEL_SIZE = 260 };
static float wheel_positions[3 * (WHEEL_SIZE + 1)];
static uint32_t wheel_faces[3 * WHEEL_SIZE];
static const mesh_case wheel = {.name = "wheel",
                                .positions = wheel_positions,
                                .faces = wheel_faces,
                                .position_count = WHEEL_SIZE + 1,
                                .face_count = WHEEL_SIZE};

static inline void make_wheel(void) {
    for (uint32_t k = 0; k < WHEEL_SIZE; k++) {
        const double angle = 6.283185307179586 * k / WHEEL_SIZE;
        wheel_positions[3 * (k + 1)] = (float)cos(angle);
        wheel_positions[3 * (k + 1) + 1] = (float)sin(angle);
        wheel_positions[3 * (k + 1) + 2] = 0.25f;
        wheel_faces[3 * k + 1] = 1 + k;
        wheel_faces[3 * k + 2] = 1 + (k + 1) % WHEEL_SIZE;
    }
}

/// The meshes of a file with the tetrahedron, of one class; the strip, of several, with one patch
/// each; and the wheel, of a wide one.
enum { TETRAHEDRON, STRIP, WHEEL };

// ---- Files

static inline blob bake_with(const limn_bake_desc *desc, const mesh_case *const *meshes,
                             size_t mesh_count) {
    limn_baker *const baker = limn_baker_create(desc);
    if (!baker) abort();
    for (size_t m = 0; m < mesh_count; m++)
        CHECK_EQUAL(limn_baker_add_mesh(
                        baker, &(limn_bake_mesh){.name = meshes[m]->name,
                                                 .positions = meshes[m]->positions,
                                                 .position_count = meshes[m]->position_count,
                                                 .face_sizes = meshes[m]->face_sizes,
                                                 .face_count = meshes[m]->face_count,
                                                 .face_indices = meshes[m]->faces,
                                                 .crease_edges = meshes[m]->crease_edges,
                                                 .crease_sharpness = meshes[m]->crease_sharpness,
                                                 .crease_count = meshes[m]->crease_count}),
                    LIMN_BAKE_OK);
    const void *bytes = NULL;
    size_t size = 0;
    CHECK_EQUAL(limn_baker_finish(baker, &bytes, &size), LIMN_BAKE_OK);
    CHECK((uintptr_t)bytes % LIMN_FORMAT_ALIGNMENT == 0);
    const blob file =
        copy_blob(&(blob){.bytes = (unsigned char *)(uintptr_t)bytes, .size = size}, size);
    limn_baker_destroy(baker);
    return file;
}

static inline blob bake(const mesh_case *const *meshes, size_t mesh_count) {
    return bake_with(NULL, meshes, mesh_count);
}

static inline blob bake_tetrahedron(void) {
    return bake((const mesh_case *[]){&tetrahedron}, 1);
}

static inline void bake_and_mend(const limn_bake_desc *desc, const mesh_case *const *meshes,
                                 size_t mesh_count) {
    const blob file = bake_with(desc, meshes, mesh_count);
    check_mended_words(&file);
    free(file.bytes);
}

#endif
