/* SPDX-License-Identifier: MIT */
/*
 * No pop: as a camera comes nearer, no point of the drawn surface moves by more than the step of
 * the levels times what a whole level moves (bench/drawn.h); but where an edge comes to level 0 or
 * from there, by a stated share of the tolerance at most. Without morphing, points move further.
 */
#include "../bench/drawn.h"
#include "../bench/lods.h"
#include "check.h"
#include "limn/bake.h"

#include <math.h>
#include <stdlib.h>

/// Of the tolerance: what points may move by for a step of 1.8 % of the distance.
#define MOVE_SHARE 1.0
/// What a patch may move by when one of its edges gains or loses its only level, however small the
/// camera's step: by length, and by error, where edges are longer.
#define LENGTH_SEAM_SHARE 0.6
#define ERROR_SEAM_SHARE 3.5

enum { FRAMES = 120 };

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

/// From 8 diagonals to 1; where the level is given, it rises from 0 to 4 instead.
static outcome follow(const drawn_mesh *drawn, limn_lod_desc desc) {
    drawn_frame frames[2];
    outcome all = {0};
    if (!drawn_frame_create(&frames[0], drawn) || !drawn_frame_create(&frames[1], drawn)) abort();
    for (int f = 0; f < FRAMES; f++) {
        const float along = (float)f / (FRAMES - 1);
        const limn_view view = view_from(&drawn->mesh, powf(8, 1 - along));
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
static void test_lod(const drawn_mesh *drawn, const bench_lod *lod, float min_level) {
    limn_lod_desc desc = lod->desc;
    desc.min_level = min_level;
    const outcome with = follow(drawn, desc);
    desc.no_morph = true;
    const outcome without = follow(drawn, desc);
    const double jump = fmax(without.pixels, without.seam_pixels);
    printf("    %s from %g: %.3f pixels of at most %.3f, share %.3f, to and from 0 %.3f; without "
           "morphing %.3f\n",
           lod->name, (double)min_level, with.pixels, with.bound, with.share, with.seam_pixels,
           jump);
    const bool is_uniform = desc.lod == LIMN_LOD_UNIFORM;
    CHECK(with.share <= (is_uniform ? 1.02 : 2)); // uniform: the rounding of floats
    if (is_uniform || min_level >= 1) {
        CHECK(with.seam_pixels == 0);
    } else {
        const double share = desc.lod == LIMN_LOD_ERROR ? ERROR_SEAM_SHARE : LENGTH_SEAM_SHARE;
        CHECK(with.seam_pixels <= share * (double)desc.pixels);
    }
    if (!is_uniform) CHECK(with.pixels <= MOVE_SHARE * (double)desc.pixels);
    CHECK(jump > 3 * with.pixels);
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
        for (uint32_t l = 0; l < bench_lod_count; l++) {
            test_lod(&drawn, &bench_lods[l], 0);
            test_lod(&drawn, &bench_lods[l], 1);
        }
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
