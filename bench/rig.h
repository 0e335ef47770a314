/* SPDX-License-Identifier: MIT */
/* A skin and a movement for meshes that have none: joints along the longest axis, which wobble. */
#ifndef BENCH_RIG_H
#define BENCH_RIG_H

#include "limn/limn.h"

/// Each control point hangs on the joints next to it, the nearest most. False: no memory. Free it
/// all the same.
///
/// joint_count  at least influence_count
bool bench_rig_attach(limn_skin *skin, const limn_mesh *mesh, uint32_t joint_count,
                      uint32_t influence_count);
void bench_rig_free(limn_skin *skin);

/// Where the joints are after some seconds: each turns to and fro around its place on the axis.
///
/// matrices  out: [joint_count][3][4]
void bench_rig_wobble(const limn_mesh *mesh, uint32_t joint_count, float seconds, float *matrices);

#endif
