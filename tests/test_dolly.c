/* SPDX-License-Identifier: MIT */
/*
 * No pop: no point of the drawn surface moves by more than the step of the levels times what a
 * whole level moves (bench/drawn.h). First as a camera comes nearer, where points move further
 * without morphing; then for a small step from any levels to the next, of all edges alike, which
 * moves no point by much if nothing jumps. Edges that come to level 0, or from there, may: what is
 * sewn to their middle is then sewn to their start.
 */
#include "../bench/drawn.h"
#include "../bench/lods.h"
#include "check.h"
#include "limn/bake.h"

#include <math.h>
#include <stdlib.h>

/// Of the bound, which is that of vertices. A point has fixed parameters, over which triangles
/// slide by no more than their vertices move: twice the bound at most.
#define SHARE_MAX 2.0
/// Where all levels are the same, no triangle slides along an edge; DRAWN_ROUNDING is a hundred
/// roundings, of which two count.
#define UNIFORM_SHARE_MAX 1.02

enum { FRAMES = 60 };

typedef struct outcome {
    double pixels, bound, share, seam_pixels, seam_share; ///< the largest of all frames
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
        all.seam_share = fmax(all.seam_share, motion.seam_share);
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
    printf("    %s from %g: %.3f pixels of at most %.3f, share %.3f, to and from 0 %.3f, share "
           "%.3f; without morphing %.3f\n",
           lod->name, (double)min_level, with.pixels, with.bound, with.share, with.seam_pixels,
           with.seam_share, jump);
    CHECK(with.share <= (desc.lod == LIMN_LOD_UNIFORM ? UNIFORM_SHARE_MAX : SHARE_MAX));
    CHECK(with.seam_share <= 1);
    CHECK(jump > with.pixels);
}

// ---- A small step from any levels

/// Always the same for an edge, whichever way it goes.
static uint32_t hash_edge(const uint32_t ends[2]) {
    const uint32_t low = ends[ends[0] > ends[1]], high = ends[ends[0] < ends[1]];
    const uint32_t mixed = (low * 0x9e3779b1u + high) * 0x85ebca6bu;
    return (mixed ^ mixed >> 15) * 0xc2b2ae35u >> 8;
}

static uint8_t split_level(float level, float *morph) {
    const float whole = ceilf(level);
    *morph = level > 0 ? level - whole + 1 : 1;
    return (uint8_t)whole;
}

/// Every other edge at a whole level from `lowest` to 3 and a bit more or less, `offset`; those
/// between anywhere in between.
static void set_levels(drawn_frame *frame, uint32_t lowest, float offset) {
    limn_plan_patch *const items = frame->memory;
    const limn_domain *const domain = frame->of->mesh.domain;
    frame->plan.vertex_count = 0;
    for (uint32_t p = 0; p < frame->plan.patch_count; p++) {
        limn_plan_patch *const item = &items[p];
        uint32_t corners[LIMN_CORNER_MAX];
        float highest = 0;
        limn_mesh_corners(&frame->of->mesh, item->patch, corners);
        for (uint32_t e = 0; e < domain->corner_count; e++) {
            const uint32_t hash =
                hash_edge((const uint32_t[]){corners[e], corners[(e + 1) % domain->corner_count]});
            const float between = hash % 2 ? (float)(hash >> 8 & 63) / 64 : 0;
            const float level = (float)(lowest + (hash >> 1) % (4 - lowest)) + between + offset;
            item->edge_levels[e] = split_level(fmaxf(level, 0), &item->edge_morphs[e]);
            highest = fmaxf(highest, level);
        }
        item->level = split_level(highest, &item->morph);
        item->template_index = (uint16_t)limn_template_find(domain, item->level, item->edge_levels);
        item->first_vertex = (uint32_t)frame->plan.vertex_count;
        frame->plan.vertex_count += domain->row_counts[item->level];
    }
}

static drawn_motion step_levels(const drawn_mesh *drawn, uint32_t lowest) {
    static const float step = 1.0f / 1024;
    const limn_view view = view_from(&drawn->mesh, 1);
    drawn_frame frames[2];
    for (int k = 0; k < 2; k++) {
        if (!drawn_frame_create(&frames[k], drawn)) abort();
        drawn_frame_make(&frames[k], &view, NULL);
        set_levels(&frames[k], lowest, k ? step / 2 : -step / 2);
        drawn_frame_draw(&frames[k]);
    }
    const drawn_motion motion = drawn_move(&frames[0], &frames[1]);
    drawn_frame_destroy(&frames[0]);
    drawn_frame_destroy(&frames[1]);
    return motion;
}

/// Across whole levels, too, nothing jumps; it would be seen, as that at level 0 is.
static void test_levels(const drawn_mesh *drawn) {
    for (uint32_t lowest = 0; lowest < 2; lowest++) {
        const drawn_motion motion = step_levels(drawn, lowest);
        printf("    any levels from %u: %.3f pixels, share %.3f, to and from 0 %.3f, share %.3f\n",
               lowest, motion.pixels, motion.share, motion.seam_pixels, motion.seam_share);
        CHECK(motion.share <= SHARE_MAX);
        CHECK(motion.seam_share <= 1);
        CHECK(lowest > 0 || motion.seam_pixels > motion.pixels);
    }
}

static void test_mesh(const limn_bake_desc *desc, const char *folder, const char *name) {
    char path[4096];
    const void *blob;
    size_t size;
    limn_pack pack;
    if (!folder || !*folder) return;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    limn_baker *const baker = limn_baker_create(desc);
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
        test_levels(&drawn);
        drawn_mesh_destroy(&drawn);
    }
    limn_baker_destroy(baker);
}

int main(void) {
    const char *const own = getenv("LIMN_ASSETS"), *const further = getenv("LIMN_TEST_ASSETS");
    test_mesh(NULL, own, "cube.off");
    test_mesh(NULL, own, "torus32.obj");
    test_mesh(NULL, own, "sail.obj");
    test_mesh(NULL, own, "imp.obj");
    test_mesh(NULL, further, "meshes/dragknob.off");
    test_mesh(NULL, further, "meshes/spot_control_mesh.obj");
    test_mesh(&(limn_bake_desc){.scheme = LIMN_SCHEME_BUTTERFLY}, own, "torus32.obj");
    test_mesh(&(limn_bake_desc){.scheme = LIMN_SCHEME_CATMARK}, own, "cube.off");
    return check_report();
}
