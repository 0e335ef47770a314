/* SPDX-License-Identifier: MIT */
/*
 * No pop: as a camera comes nearer, no point of the drawn surface moves by more than the step of
 * the levels times what a whole level moves (bench/drawn.h); and where a seam is sewn anew, by no
 * more than a stated share of the tolerance. Without morphing, points move further.
 */
#include "../bench/drawn.h"
#include "../bench/lods.h"
#include "check.h"
#include "limn/bake.h"

#include <math.h>
#include <stdlib.h>

/// Of the tolerance: what a seam may move by when one of its edges gains or loses a level, however
/// small the camera's step.
#define SEAM_SHARE 0.6

enum { FRAMES = 60 };

typedef struct outcome {
    double pixels, bound, share, seam_pixels; ///< the largest of all frames
} outcome;

static limn_view view_from(const limn_mesh *mesh, float diagonals) {
    float middle[3], eye[3], diagonal = 0;
    for (int axis = 0; axis < 3; axis++) {
        middle[axis] = (mesh->bounds_min[axis] + mesh->bounds_max[axis]) / 2;
        diagonal = hypotf(diagonal, mesh->bounds_max[axis] - mesh->bounds_min[axis]);
    }
    for (int axis = 0; axis < 3; axis++)
        eye[axis] = middle[axis] + (const float[]){0.5f, 0.3f, 0.8f}[axis] * diagonal * diagonals;
    return limn_view_perspective(eye, middle, (const float[]){0, 1, 0}, 0.7f, 1280, 720,
                                 diagonal / 1000, diagonal * 1000);
}

/// From 16 diagonals to 1; where the level is given, it rises from 0 to 4 instead.
static outcome follow(const drawn_mesh *drawn, limn_lod_desc desc) {
    drawn_frame frames[2];
    outcome all = {0};
    if (!drawn_frame_create(&frames[0], drawn) || !drawn_frame_create(&frames[1], drawn)) abort();
    for (int f = 0; f < FRAMES; f++) {
        const float along = (float)f / (FRAMES - 1);
        const limn_view view = view_from(&drawn->mesh, powf(16, 1 - along));
        desc.level = LIMN_LEVEL_MAX * along;
        drawn_frame_make(&frames[f % 2], &view, &desc);
        if (f == 0) continue;
        const drawn_motion motion = drawn_move(&frames[1 - f % 2], &frames[f % 2]);
        all.pixels = fmax(all.pixels, motion.pixels);
        all.bound = fmax(all.bound, motion.bound);
        all.share = fmax(all.share, motion.share);
        all.seam_pixels = fmax(all.seam_pixels, motion.seam_pixels);
    }
    drawn_frame_destroy(&frames[0]);
    drawn_frame_destroy(&frames[1]);
    return all;
}

/// Morphing keeps to its bound, and what it is there for is larger than that.
static void test_lod(const drawn_mesh *drawn, const bench_lod *lod) {
    limn_lod_desc desc = lod->desc;
    const outcome with = follow(drawn, desc);
    desc.no_morph = true;
    const outcome without = follow(drawn, desc);
    printf("    %s: %.3f pixels of at most %.3f, share %.3f, seams %.3f; without morphing %.3f\n",
           lod->name, with.pixels, with.bound, with.share, with.seam_pixels,
           fmax(without.pixels, without.seam_pixels));
    if (lod->desc.lod == LIMN_LOD_UNIFORM) {
        CHECK(with.share <= 1.02); // the surface is that of floats
        CHECK(with.seam_pixels == 0);
    } else {
        CHECK(with.share <= 2);
        CHECK(with.seam_pixels <= SEAM_SHARE * (double)lod->desc.pixels);
    }
    CHECK(fmax(without.pixels, without.seam_pixels) > 1.5 * with.bound);
}

static void test_mesh(const char *folder, const char *name) {
    char path[4096];
    const void *blob;
    size_t size;
    limn_pack pack;
    if (!folder || !*folder) return;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    limn_baker *const baker = limn_baker_create(NULL);
    if (CHECK_EQUAL(limn_baker_add_file(baker, path), LIMN_BAKE_OK) &&
        CHECK_EQUAL(limn_baker_finish(baker, &blob, &size), LIMN_BAKE_OK) &&
        CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK)) {
        const limn_mesh mesh = limn_pack_mesh(&pack, 0);
        drawn_mesh drawn = {0};
        printf("%s\n", name);
        if (!drawn_mesh_create(&drawn, &mesh)) abort();
        for (uint32_t l = 0; l < bench_lod_count; l++)
            test_lod(&drawn, &bench_lods[l]);
        drawn_mesh_destroy(&drawn);
    }
    limn_baker_destroy(baker);
}

int main(void) {
    const char *const own = getenv("LIMN_ASSETS"), *const further = getenv("LIMN_TEST_ASSETS");
    test_mesh(own, "cube.off");
    test_mesh(own, "torus32.obj");
    test_mesh(own, "sail.obj");
    test_mesh(own, "imp.obj");
    test_mesh(further, "meshes/dragknob.off");
    test_mesh(further, "meshes/spot_control_mesh.obj");
    return check_report();
}
