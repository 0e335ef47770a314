/* SPDX-License-Identifier: MIT */
#include "star.h"

#include "crease_rules.h"

static const limni_crease_rules *creases_of(const limni_rules *rules) {
    return rules->creases == LIMN_CREASES_LOMONT ? &limni_lomont_creases
                                                 : &limni_opensubdiv_creases;
}

bool limni_star_decays(const limni_star *star) {
    bool decays = limni_is_semi_sharp(star->sharpness);
    for (uint32_t r = 0; star->edges && r < star->count; r++)
        decays |= limni_is_semi_sharp(star->edges[r]);
    return decays;
}

limni_sharp_edges limni_star_sharp_edges(const limni_star *star) {
    limni_sharp_edges edges = {0};
    for (uint32_t r = 0; star->edges && r < star->count; r++)
        limni_sharp_edges_add(&edges, star->edges[r]);
    return edges;
}

uint32_t limni_star_opposite(const limni_star *star, uint32_t r) {
    return star->closed ? 2 * ((r + star->count / 2) % star->count) : 0;
}

limni_vertex_rule limni_vertex_rule_of(bool sharp, uint32_t sharp_count) {
    static const limni_vertex_rule by_count[] = {LIMNI_VERTEX_SMOOTH, LIMNI_VERTEX_DART,
                                                 LIMNI_VERTEX_CREASE};
    return sharp || sharp_count > 2 ? LIMNI_VERTEX_CORNER : by_count[sharp_count];
}

limni_feature limni_star_find_feature(const limni_star *star, limni_sharpness edges,
                                      limni_sharpness vertex) {
    limni_feature feature = {0};
    uint32_t sharp_count = 0;
    for (uint32_t r = 0; r < star->count; r++) {
        if (limni_star_edge(star, r) < edges) continue;
        feature.ends[sharp_count > 0] = r;
        sharp_count++;
    }
    feature.rule = limni_vertex_rule_of(star->sharpness >= vertex, sharp_count);
    feature.regular = star->closed ? star->count == 6 && feature.ends[1] == feature.ends[0] + 3
                                   : star->count == 4;
    return feature;
}

limni_feature limni_star_feature(const limni_rules *rules, const limni_star *star) {
    const limni_sharpness least = creases_of(rules)->sharp_from;
    return limni_star_find_feature(star, least, least);
}

limni_feature limni_star_last_feature(const limni_star *star) {
    return limni_star_find_feature(star, LIMNI_SHARPNESS_INFINITE, LIMNI_SHARPNESS_INFINITE);
}

bool limni_star_is_settled(const limni_rules *rules, const limni_star *star) {
    return creases_of(rules)->is_settled(star);
}

limni_transition limni_star_transition(const limni_rules *rules, const limni_star *star) {
    return creases_of(rules)->transition(rules, star);
}

limni_edge_feature limni_star_edge_feature(const limni_rules *rules, const limni_star *star,
                                           uint32_t r) {
    return creases_of(rules)->edge_feature(rules, star, r);
}

limni_sharpness limni_star_next_edge(const limni_rules *rules, const limni_star *star, uint32_t r) {
    return limni_edge_sharpness_next(rules->creasing, limni_star_edge(star, r),
                                     limni_star_sharp_edges(star));
}

void limni_star_see(const limni_rules *rules, const limni_star *star, uint32_t first,
                    uint32_t count, uint32_t *seen) {
    creases_of(rules)->see(rules, star, first, count, seen);
}

uint32_t limni_star_next_beyond(const limni_rules *rules, const limni_star *star, uint32_t r) {
    return creases_of(rules)->next_beyond(rules, star, r);
}
