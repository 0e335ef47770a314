/* SPDX-License-Identifier: MIT */
/* Frames to plan and to evaluate: what one camera sees of one mesh, or of a crowd of it. */
#ifndef BENCH_FRAMES_H
#define BENCH_FRAMES_H

#include "lods.h"
#include "mixes.h"

typedef struct bench_frame {
    char name[32];
    const bench_mix *mix;
    limn_lod_desc desc;
    bool is_planned; ///< else its plan is limn_plan_uniform()
    uint32_t instance_count;
    limn_view *views; ///< [instance_count], each in the space of its instance
    void **memory;    ///< [instance_count]
    limn_plan *plans; ///< [instance_count]
} bench_frame;

/// All faces at one level, without planning.
bench_frame bench_frame_uniform(const bench_mix *mix, uint32_t level);

/// A camera so near that some faces are outside; they are left out only if it culls. `pixels` is
/// the tolerance.
bench_frame bench_frame_near(const bench_mix *mix, const bench_lod *lod, float pixels, bool culls);

/// 64 of the same in eight rows, seen from before them and above, faces outside left out.
bench_frame bench_frame_crowd(const bench_mix *mix, float pixels, bool no_morph);

void bench_frame_destroy(bench_frame *frame);

/// Plans all instances.
void bench_frame_plan(const bench_frame *frame);

uint64_t bench_frame_faces(const bench_frame *frame);    ///< of all instances
uint64_t bench_frame_patches(const bench_frame *frame);  ///< that are drawn
uint64_t bench_frame_vertices(const bench_frame *frame); ///< that are drawn
double bench_frame_level(const bench_frame *frame);      ///< the mean of what is drawn

#endif
