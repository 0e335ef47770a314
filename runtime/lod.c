/* SPDX-License-Identifier: MIT */
/* Loops go over whole blocks, without branches: what lies behind the last patch is computed, too. */
#include "lod.h"

#include "edge_error.h"

#include <math.h>

limn_lod_desc limni_lod_complete(const limn_lod_desc *desc) {
    limn_lod_desc d = desc ? *desc : (limn_lod_desc){0};
    if (d.pixels == 0) d.pixels = d.lod == LIMN_LOD_ERROR ? 1 : 8;
    if (d.max_level == 0) d.max_level = LIMN_LEVEL_MAX;
    return d;
}

bool limni_lod_is_valid(const limn_lod_desc *desc, const limn_mesh *mesh) {
    return (unsigned)desc->lod <= LIMN_LOD_ERROR && desc->min_level >= 0 &&
           desc->max_level <= LIMN_LEVEL_MAX && desc->min_level <= desc->max_level &&
           desc->pixels > 0 && fabsf(desc->bias) <= 16 && isfinite(desc->level) &&
           (desc->lod != LIMN_LOD_ERROR || mesh->errors);
}

static inline float square(float a) {
    return a * a;
}

/// The squares of lengths on the screen, in pixels, of the edges between corners a and b, where
/// they are more than they were.
static void add_view(const limn_view *view, const float a[3][LIMNI_LOD_BLOCK],
                     const float b[3][LIMNI_LOD_BLOCK], float squares[LIMNI_LOD_BLOCK]) {
    const float x = view->eye[0], y = view->eye[1], z = view->eye[2];
    const float pixels2 = square(view->pixels), nearest2 = square(view->nearest);
    for (int i = 0; i < LIMNI_LOD_BLOCK; i++) {
        const float length2 =
            square(a[0][i] - b[0][i]) + square(a[1][i] - b[1][i]) + square(a[2][i] - b[2][i]);
        const float distance2 = square((a[0][i] + b[0][i]) * 0.5f - x) +
                                square((a[1][i] + b[1][i]) * 0.5f - y) +
                                square((a[2][i] + b[2][i]) * 0.5f - z);
        const float divisor = view->orthographic     ? 1.0f
                              : distance2 > nearest2 ? distance2
                                                     : nearest2;
        const float seen = length2 * pixels2 / divisor;
        squares[i] = seen > squares[i] ? seen : squares[i];
    }
}

/// levels  in: squares of projected lengths
static void find_length_levels(const limn_lod_desc *desc, float levels[LIMNI_LOD_BLOCK]) {
    const float scale = 1.0f / square(desc->pixels), bias = desc->bias;
    for (int i = 0; i < LIMNI_LOD_BLOCK; i++)
        levels[i] = 0.5f * limni_log2(levels[i] * scale) + bias;
}

/// Unpacked first, as tables cannot be read by vectors.
static void find_error_levels(const limn_lod_desc *desc, const uint16_t errors[LIMNI_LOD_BLOCK],
                              float levels[LIMNI_LOD_BLOCK]) {
    const float tolerance = desc->pixels, bias = desc->bias;
    float firsts[LIMNI_LOD_BLOCK], inverses[3][LIMNI_LOD_BLOCK], slopes[3][LIMNI_LOD_BLOCK];
    for (int i = 0; i < LIMNI_LOD_BLOCK; i++) {
        const limni_error_curve curve = limni_error_unpack(errors[i]);
        firsts[i] = curve.first;
        for (int s = 0; s < 3; s++) {
            inverses[s][i] = curve.inverses[s];
            slopes[s][i] = curve.slopes[s];
        }
    }
    for (int i = 0; i < LIMNI_LOD_BLOCK; i++) {
        const limni_error_curve curve = {firsts[i],
                                         {inverses[0][i], inverses[1][i], inverses[2][i]},
                                         {slopes[0][i], slopes[1][i], slopes[2][i]}};
        levels[i] = limni_error_level(&curve, sqrtf(levels[i]), tolerance) + bias;
    }
}

void limni_lod_measure(const limn_lod_desc *desc, const limn_view *views, uint32_t view_count,
                       uint32_t corner_count, const limni_lod_block *block,
                       limni_lod_levels *levels) {
    for (uint32_t e = 0; e < corner_count; e++) {
        float *const level = levels->edges[e];
        for (int i = 0; i < LIMNI_LOD_BLOCK; i++)
            level[i] = desc->lod == LIMN_LOD_UNIFORM ? desc->level + desc->bias : 0.0f;
        if (desc->lod == LIMN_LOD_UNIFORM) continue;
        const uint32_t next = e + 1 < corner_count ? e + 1 : 0;
        for (uint32_t v = 0; v < view_count; v++)
            add_view(&views[v], block->corners[e], block->corners[next], level);
        if (desc->lod == LIMN_LOD_ERROR) {
            find_error_levels(desc, block->errors[e], level);
        } else {
            find_length_levels(desc, level);
        }
    }
}

static inline int32_t ceiling(float level) {
    const int32_t whole = (int32_t)level;
    return whole + ((float)whole < level);
}

/// Level l draws n = ceil(l) levels; what is new at n has weight l - (n - 1). At level 0, where
/// nothing is, that is 1.
static inline float weight_of(float level, int32_t n, bool no_morph) {
    return no_morph ? 1.0f : level - (float)(n - 1);
}

/// Limits the levels of one edge of each patch, and keeps the highest.
static void choose_edge(const limn_lod_desc *desc, const float levels[LIMNI_LOD_BLOCK],
                        float lowered, int32_t edge_levels[LIMNI_LOD_BLOCK],
                        float edge_morphs[LIMNI_LOD_BLOCK], float highest[LIMNI_LOD_BLOCK]) {
    const float low = desc->min_level, high = desc->max_level;
    const bool no_morph = desc->no_morph;
    for (int i = 0; i < LIMNI_LOD_BLOCK; i++) {
        const float wanted = levels[i] - lowered;
        const float top = wanted < high ? wanted : high;
        const float level = top > low ? top : low; // also where it is not a number
        const int32_t n = ceiling(level);
        edge_levels[i] = n;
        edge_morphs[i] = weight_of(level, n, no_morph);
        highest[i] = level > highest[i] ? level : highest[i];
    }
}

void limni_lod_choose(const limn_lod_desc *desc, uint32_t corner_count,
                      const limni_lod_levels *levels, float lowered, limni_lod_choice *choice) {
    float highest[LIMNI_LOD_BLOCK] = {0};
    for (uint32_t e = 0; e < corner_count; e++)
        choose_edge(desc, levels->edges[e], lowered, choice->edge_levels[e], choice->edge_morphs[e],
                    highest);
    for (int i = 0; i < LIMNI_LOD_BLOCK; i++) {
        const int32_t n = ceiling(highest[i]);
        choice->levels[i] = n;
        choice->morphs[i] = weight_of(highest[i], n, desc->no_morph);
        choice->places[i] = 0;
    }
    for (uint32_t e = 0; e < corner_count; e++) {
        for (int i = 0; i < LIMNI_LOD_BLOCK; i++)
            choice->places[i] =
                choice->places[i] * (choice->levels[i] + 1) + choice->edge_levels[e][i];
    }
}
