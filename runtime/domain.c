/* SPDX-License-Identifier: MIT */
#include "domain.h"
#include "require.h"

const limn_domain *limn_domain_get(limn_domain_kind kind) {
    static const limn_domain *const domains[LIMN_DOMAIN_COUNT] = {
        [LIMN_DOMAIN_TRIANGLE] = &limni_domain_triangle,
        [LIMN_DOMAIN_QUAD] = &limni_domain_quad,
    };
    LIMNI_REQUIRE((unsigned)kind < LIMN_DOMAIN_COUNT, domains[0]);
    return domains[kind];
}

const limni_grid *limni_grid_get(limn_domain_kind kind) {
    static const limni_grid *const grids[LIMN_DOMAIN_COUNT] = {
        [LIMN_DOMAIN_TRIANGLE] = &limni_grid_triangle,
        [LIMN_DOMAIN_QUAD] = &limni_grid_quad,
    };
    return grids[kind];
}

const limni_pieces *limni_pieces_get(limn_domain_kind kind) {
    static const limni_pieces *const pieces[LIMN_DOMAIN_COUNT] = {
        [LIMN_DOMAIN_TRIANGLE] = &limni_pieces_triangle,
        [LIMN_DOMAIN_QUAD] = &limni_pieces_quad,
    };
    return pieces[kind];
}

const limni_layout *limni_layout_get(limn_domain_kind kind, bool tangents, uint32_t pair_count) {
    static const limni_layout *const layouts[LIMN_DOMAIN_COUNT][2] = {
        [LIMN_DOMAIN_TRIANGLE] = {limni_positions_triangle, limni_tangents_triangle},
        [LIMN_DOMAIN_QUAD] = {limni_positions_quad, limni_tangents_quad},
    };
    return &layouts[kind][tangents][pair_count > 0];
}
