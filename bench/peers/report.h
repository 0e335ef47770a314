/* SPDX-License-Identifier: MIT */
/* What `limn-bench peers` found: as a table, as JSON and as CSV. */
#ifndef REPORT_H
#define REPORT_H

#include "peer.h"

#include <stdio.h>

typedef struct peer_result {
    peer what; ///< its state is gone
    char mesh[64];
    const char *scheme;
    bool isolated; ///< Limn
    uint32_t level;
    double points_per_face;
    double ns_per_face;    ///< median over the rounds
    double ratio_to_limn;  ///< median over the rounds of the ratio in one round; NAN: no such Limn
    double bytes_per_face; ///< stored
    double difference; ///< the largest to the first peer's points, as a part of the mesh's diagonal
} peer_result;

void report_print_head(void);
void report_print(const peer_result *result);

/// What the columns mean, after the table.
void report_print_notes(void);

/// False when out of memory, or when the stream fails.
bool report_write_json(FILE *file, const peer_result *results, uint32_t count, uint32_t rounds);
void report_write_csv(FILE *file, const peer_result *results, uint32_t count, uint32_t rounds);

#endif
