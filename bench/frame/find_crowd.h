/* SPDX-License-Identifier: MIT */
#ifndef FRAME_FIND_CROWD_H
#define FRAME_FIND_CROWD_H

#include "report.h"

/// Looks for the largest crowd of each way that keeps a budget, in seconds, at p99 of the
/// frames, each being the median of the rounds. All ways take a step of their search in turn.
///
/// crowds  out: [ways->count]
void frame_find_crowds(const frame_host *host, const frame_ways *ways, frame_length length,
                       double budget, frame_crowd_size *crowds);

#endif
