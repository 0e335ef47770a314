/* SPDX-License-Identifier: MIT */
/*
 * The modified butterfly (Zorin, Schroeder and Sweldens 1996; Sharp 2000). docs/mathematics.md has
 * the masks and tangents, and tests/butterfly/butterfly.h where the texts are wrong or silent.
 * Vertices stay where they are.
 */
#include "masks.h"

/// Weights of the regular stencil: of its wings, -1/16 - w, and of the two points behind the ends,
/// w.
typedef struct regular_weights {
    limni_fixed wing, far;
} regular_weights;

static regular_weights weights_of(const limni_rules *rules) {
    return (regular_weights){.wing = -LIMNI_FIXED_ONE / 16 - rules->tension, .far = rules->tension};
}

static void keep_vertex(const limni_rules *rules, const limni_star *star, limni_fixed *weights) {
    (void)rules;
    weights[0] = LIMNI_FIXED_ONE;
    for (uint32_t r = 0; r < star->count; r++)
        weights[1 + r] = 0;
}

// ---- Edges

/// One end of an edge, which leads to place `to` of its ring.
typedef struct edge_end {
    const limni_star *star;
    uint32_t vertex, to;
} edge_end;

static bool is_regular(const limni_star *star) {
    return star->count == (star->closed ? 6u : 4u);
}

/// The ring vertex `steps` counter-clockwise from the other end.
static uint32_t beside(const edge_end *end, int steps) {
    const int count = (int)end->star->count;
    return end->star->ring[((int)end->to + steps + 2 * count) % count];
}

/// What one of two regular ends inside adds.
static void add_regular_half(limni_masks *masks, const edge_end *end) {
    const regular_weights w = weights_of(masks->rules);
    limni_masks_add(masks, end->vertex, LIMNI_FIXED_ONE / 2 - w.far);
    for (int side = -1; side <= 1; side += 2) {
        limni_masks_add(masks, beside(end, side), -w.wing); // and once more from the other end
        limni_masks_add(masks, beside(end, 2 * side), w.wing);
    }
    limni_masks_add(masks, beside(end, 3), w.far);
}

/// Both regular, one on a boundary.
static void add_regular_to_boundary(limni_masks *masks, const edge_end *boundary,
                                    const edge_end *inner) {
    const limni_fixed sixteenth = LIMNI_FIXED_ONE / 16;
    const uint32_t *const ring = boundary->star->ring;
    const bool first = boundary->to == 1;
    const int side = first ? 1 : -1; // where the inner end sees the boundary
    limni_masks_add(masks, boundary->vertex, 6 * sixteenth);
    limni_masks_add(masks, inner->vertex, 10 * sixteenth);
    limni_masks_add(masks, ring[first ? 0 : 3], sixteenth);
    limni_masks_add(masks, ring[3 - boundary->to], 3 * sixteenth);
    limni_masks_add(masks, ring[first ? 3 : 0], -sixteenth);
    limni_masks_add(masks, beside(inner, 2 * side), -sixteenth);
    limni_masks_add(masks, beside(inner, -2 * side), -2 * sixteenth);
}

/// What one of two regular ends on a boundary adds, where a common neighbour has one face or not.
static void add_regular_across(limni_masks *masks, const edge_end *end, bool has_corner) {
    const limni_fixed eighth = LIMNI_FIXED_ONE / 8;
    limni_masks_add(masks, end->vertex, LIMNI_FIXED_ONE / 2);
    if (!has_corner) return;
    limni_masks_add(masks, end->star->ring[3 - end->to], eighth); // and once from the other end
    limni_masks_add(masks, end->star->ring[end->to == 1 ? 3 : 0], -eighth);
}

static void add_regular(limni_masks *masks, const edge_end *a, const edge_end *b) {
    if (a->star->closed && b->star->closed) {
        add_regular_half(masks, a);
        add_regular_half(masks, b);
    } else if (a->star->closed || b->star->closed) {
        add_regular_to_boundary(masks, a->star->closed ? b : a, a->star->closed ? a : b);
    } else {
        add_regular_across(masks, a, a->to != b->to);
        add_regular_across(masks, b, a->to != b->to);
    }
}

/// Of neighbour j, counted from the other end, of n.
static limni_fixed inner_weight(uint32_t n, uint32_t j) {
    static const int of_3[3] = {5, -1, -1}, of_4[4] = {3, 0, -1, 0};
    if (n == 3) return limni_fixed_ratio(of_3[j], 12);
    if (n == 4) return of_4[j] * (LIMNI_FIXED_ONE / 8);
    const limni_wide sum = LIMNI_FIXED_ONE / 4 + (limni_wide)limni_fixed_turn(j, n).cosine +
                           limni_fixed_turn(2 * j, n).cosine / 2;
    return (limni_fixed)limni_wide_divide(sum, n);
}

/// On a boundary with k faces, of neighbour j, the other end being neighbour i.
static limni_fixed boundary_weight(uint32_t k, uint32_t i, uint32_t j) {
    const limni_fixed_unit once = limni_fixed_turn(i, 2 * k), twice = limni_fixed_turn(i, k);
    if (j > 0 && j < k) {
        const limni_wide sum =
            (limni_wide)limni_fixed_multiply(once.sine, limni_fixed_turn(j, 2 * k).sine) +
            limni_fixed_multiply(twice.sine, limni_fixed_turn(j, k).sine) / 2;
        return (limni_fixed)limni_wide_divide(sum, k);
    }
    const limni_fixed_unit z = limni_fixed_turn(1, 2 * k), two_z = limni_fixed_turn(1, k);
    const limni_fixed bent = limni_fixed_divide(limni_fixed_multiply(two_z.sine, twice.sine),
                                                (limni_fixed)k * (z.cosine - two_z.cosine));
    const limni_fixed end = (once.cosine - bent) / 4;
    return j == 0 ? end : -end;
}

/// The mask of an extraordinary end, or half of it.
static void add_extraordinary(limni_masks *masks, const edge_end *end, bool half) {
    const limni_star *const star = end->star;
    const uint32_t n = star->count;
    limni_fixed centre = half ? LIMNI_FIXED_ONE / 2 : LIMNI_FIXED_ONE;
    for (uint32_t r = 0; r < n; r++) {
        const limni_fixed whole = star->closed ? inner_weight(n, (r + n - end->to) % n)
                                               : boundary_weight(n - 1, end->to, r);
        const limni_fixed weight = half ? whole / 2 : whole;
        limni_masks_add(masks, star->ring[r], weight);
        centre -= weight;
    }
    limni_masks_add(masks, end->vertex, centre);
}

/// Four points along it. The ends see each other first and last in their rings.
static void add_boundary_edge(limni_masks *masks, const edge_end *a, const edge_end *b) {
    const limni_fixed sixteenth = LIMNI_FIXED_ONE / 16;
    const edge_end *const ends[2] = {a, b};
    for (int e = 0; e < 2; e++) {
        const limni_star *const star = ends[e]->star;
        limni_masks_add(masks, ends[e]->vertex, 9 * sixteenth);
        limni_masks_add(masks, star->ring[ends[e]->to == 0 ? star->count - 1 : 0], -sixteenth);
    }
}

static void edge_terms(limni_masks *masks, uint32_t r) {
    const edge_end a = {&masks->star, masks->vertex, r};
    const edge_end b = {&masks->other, masks->star.ring[r], limni_masks_look_beside(masks, r)};
    const bool a_regular = is_regular(a.star), b_regular = is_regular(b.star);
    if (masks->mesh->pairs[masks->ring_edges[r]] == LIMNI_NONE) {
        add_boundary_edge(masks, &a, &b);
    } else if (a_regular && b_regular) {
        add_regular(masks, &a, &b);
    } else {
        const bool both = !a_regular && !b_regular;
        if (!a_regular) add_extraordinary(masks, &a, both);
        if (!b_regular) add_extraordinary(masks, &b, both);
    }
}

// ---- Tangents

/// The cosine or sine of `parts` of 2 n parts of a turn.
static limni_fixed part_of(uint32_t parts, uint32_t n, int tangent) {
    const limni_fixed_unit unit = limni_fixed_turn(parts, 2 * n);
    return tangent == 0 ? unit.cosine : unit.sine;
}

static void add_difference(limni_masks *masks, uint32_t control, limni_fixed weight) {
    limni_masks_add(masks, control, weight);
    limni_masks_add(masks, masks->vertex, -weight);
}

static void add_ring(limni_masks *masks, uint32_t half_steps, int tangent) {
    const limni_star *const star = &masks->star;
    for (uint32_t r = 0; r < star->count; r++)
        add_difference(masks, star->ring[r],
                       part_of(2 * (r + star->count) - half_steps, star->count, tangent));
}

/// Of a regular vertex inside, the six vertices between two spokes and the six behind the ring.
static void add_second_ring(limni_masks *masks, uint32_t half_steps, int tangent) {
    const regular_weights w = weights_of(masks->rules);
    const limni_fixed root = limni_fixed_root((limni_wide)3 << 2 * LIMNI_FIXED_BITS);
    const limni_fixed between = limni_fixed_divide(limni_fixed_multiply(root, w.wing),
                                                   LIMNI_FIXED_ONE / 2 - w.far + 2 * w.wing);
    const limni_fixed behind =
        2 * w.far + 2 * limni_fixed_multiply(root, limni_fixed_multiply(w.wing, between));
    for (uint32_t r = 0; r < 6; r++) {
        const uint32_t turned = 2 * (r + 6) - half_steps;
        const uint32_t to = limni_masks_look_beside(masks, r);
        const edge_end end = {&masks->other, masks->star.ring[r], to};
        add_difference(masks, beside(&end, -2),
                       limni_fixed_multiply(between, part_of(turned + 1, 6, tangent)));
        add_difference(masks, beside(&end, 3),
                       limni_fixed_multiply(behind, part_of(turned, 6, tangent)));
    }
}

/// Along a boundary: 8 and -1 of the two neighbours each way, a sixteenth of it.
static void add_along(limni_masks *masks) {
    const uint32_t last = masks->star.count - 1;
    for (int side = -1; side <= 1; side += 2) {
        const uint32_t r = side < 0 ? last : 0;
        limni_masks_look_beside(masks, r);
        const uint32_t next = masks->other.ring[side < 0 ? masks->other.count - 1 : 0];
        add_difference(masks, masks->star.ring[r], side * (LIMNI_FIXED_ONE / 2));
        add_difference(masks, next, -side * (LIMNI_FIXED_ONE / 16));
    }
}

static void add_extraordinary_across(limni_masks *masks) {
    const uint32_t k = masks->star.count - 1;
    for (uint32_t r = 1; r < k; r++)
        add_difference(masks, masks->star.ring[r], limni_fixed_turn(r, 2 * k).sine);
}

/// A sixteenth of the mask in docs/mathematics.md: two neighbours on the boundary each way, four
/// vertices of the next row, and three of the one behind it.
static void add_regular_across_boundary(limni_masks *masks) {
    const regular_weights w = weights_of(masks->rules);
    const limni_fixed one = LIMNI_FIXED_ONE, f = w.far, q = w.wing;
    const uint32_t *const ring = masks->star.ring;
    for (int side = 0; side < 2; side++) {
        const uint32_t end = side == 0 ? 0 : 3, inner = side == 0 ? 1 : 2;
        limni_masks_look_beside(masks, end);
        const limni_star *const other = &masks->other;
        add_difference(masks, ring[end], -8 * f - 14 * q - one);
        add_difference(masks, other->ring[side == 0 ? 0 : other->count - 1],
                       3 * (f / 2) + 2 * q + 3 * (one / 16));
        add_difference(masks, other->ring[side == 0 ? 1 : other->count - 2],
                       -4 * f - 2 * q - one / 2);
        const edge_end from = {other, ring[inner], limni_masks_look_beside(masks, inner)};
        add_difference(masks, ring[inner], 5 * (one / 2) + 10 * q);
        add_difference(masks, beside(&from, 3), f - 2 * q + one / 8);
        if (side == 0) add_difference(masks, beside(&from, -2), -5 * (one / 4));
    }
}

/// Of a vertex with one face, which has no tangent plane, the edges of that.
static void tangent_terms(limni_masks *masks, uint32_t half_steps, int tangent) {
    const limni_star *const star = &masks->star;
    if (star->closed) {
        add_ring(masks, half_steps, tangent);
        if (is_regular(star)) add_second_ring(masks, half_steps, tangent);
    } else if (star->count == 2) {
        add_difference(masks, star->ring[tangent], LIMNI_FIXED_ONE);
    } else if (tangent == 0) {
        add_along(masks);
    } else if (is_regular(star)) {
        add_regular_across_boundary(masks);
    } else {
        add_extraordinary_across(masks);
    }
}

const limni_scheme limni_scheme_butterfly = {
    .domain = LIMN_DOMAIN_TRIANGLE,
    .reach = 2,
    .vertex_mask = keep_vertex,
    .limit_mask = keep_vertex,
    .edge_terms = edge_terms,
    .tangent_terms = tangent_terms,
};
