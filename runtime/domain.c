/* SPDX-License-Identifier: MIT */
#include "domain.h"
#include "require.h"

const limn_domain *limn_domain_get(limn_domain_kind kind) {
    static const limn_domain *const domains[LIMN_DOMAIN_COUNT] = {
        [LIMN_DOMAIN_TRIANGLE] = &limni_domain_triangle,
    };
    LIMNI_REQUIRE((unsigned)kind < LIMN_DOMAIN_COUNT, domains[0]);
    return domains[kind];
}

const limni_pieces *limni_pieces_get(limn_domain_kind kind) {
    (void)kind; // there is but one
    return &limni_pieces_triangle;
}

const limni_layout *limni_layout_get(limn_domain_kind kind, bool tangents, uint32_t pair_count) {
    (void)kind; // there is but one
    return &(tangents ? limni_tangents_triangle : limni_positions_triangle)[pair_count > 0];
}
