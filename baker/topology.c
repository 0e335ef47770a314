/* SPDX-License-Identifier: MIT */
/* Pairs half-edges, and finds what is not a manifold. */
#include "topology.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *place(limni_place text, const char *what, uint32_t number, const uint32_t *lines,
                         uint32_t index) {
    if (lines) {
        snprintf(text, sizeof(limni_place), "%s %u (line %u)", what, number, lines[index]);
    } else {
        snprintf(text, sizeof(limni_place), "%s %u", what, number);
    }
    return text;
}

const char *limni_face_place(const limni_mesh *mesh, uint32_t face, limni_place text) {
    const uint32_t polygon = mesh->polygons[face];
    return place(text, mesh->divided ? "a part of face" : "face",
                 mesh->face_numbers[polygon] + mesh->index_base, mesh->face_lines, polygon);
}

const char *limni_control_place(const limni_mesh *mesh, uint32_t control, limni_place text) {
    for (; mesh->divided; mesh = mesh->divided) {
        if (control >= mesh->divided->control_count) return "a vertex of the divided mesh";
    }
    const uint32_t origin = limni_origin(mesh, control);
    const uint32_t number = mesh->control_numbers ? mesh->control_numbers[origin] : origin;
    return place(text, "vertex", number + mesh->index_base, mesh->control_lines, origin);
}

// ---- Pairs

/// The half-edges that start at each control point: starts[c] to starts[c + 1] of `outgoing`.
typedef struct incidence {
    uint32_t *starts;   ///< [control_count + 1]
    uint32_t *outgoing; ///< [half_edge_count], ascending for each control point
    uint32_t *first_to; ///< [control_count] scratch, all LIMNI_NONE between uses
} incidence;

static limn_bake_status build_incidence(limni_context *context, const limni_mesh *mesh,
                                        incidence *in) {
    const size_t half_edge_count = mesh->half_edge_count;
    in->starts = limni_allocate_zeroed(context, (size_t)mesh->control_count + 2, sizeof(uint32_t));
    in->outgoing = limni_allocate(context, half_edge_count, sizeof(uint32_t));
    in->first_to = limni_allocate(context, mesh->control_count, sizeof(uint32_t));
    if (!in->starts || !in->outgoing || !in->first_to) return LIMN_BAKE_MEMORY;
    memset(in->first_to, 0xff, mesh->control_count * sizeof(uint32_t));

    uint32_t *const ends = in->starts + 1;
    for (uint32_t h = 0; h < half_edge_count; h++)
        in->starts[limni_half_edge_start(mesh, h) + 2]++;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        in->starts[c + 2] += in->starts[c + 1];
    for (uint32_t h = 0; h < half_edge_count; h++)
        in->outgoing[ends[limni_half_edge_start(mesh, h)]++] = h;
    return LIMN_BAKE_OK;
}

static void release_incidence(limni_context *context, incidence *in) {
    limni_release(context, in->starts);
    limni_release(context, in->outgoing);
    limni_release(context, in->first_to);
}

/// How many faces use the edge a-b, in either direction.
static uint32_t faces_of_edge(const limni_mesh *mesh, uint32_t a, uint32_t b) {
    uint32_t count = 0;
    for (uint32_t h = 0; h < mesh->half_edge_count; h++) {
        const uint32_t start = limni_half_edge_start(mesh, h), end = limni_half_edge_end(mesh, h);
        count += (start == a && end == b) || (start == b && end == a);
    }
    return count;
}

static limn_bake_status fail_edge(limni_context *context, const limni_mesh *mesh, uint32_t h,
                                  uint32_t other) {
    limni_place a, b, face, other_face;
    const uint32_t start = limni_half_edge_start(mesh, h), end = limni_half_edge_end(mesh, h);
    const uint32_t count = faces_of_edge(mesh, start, end);
    limni_control_place(mesh, start, a);
    limni_control_place(mesh, end, b);
    limni_face_place(mesh, mesh->face_of[h], face);
    limni_face_place(mesh, mesh->face_of[other], other_face);
    if (count > 2)
        return limni_fail(
            context, LIMN_BAKE_BAD_INPUT,
            "%s: non-manifold edge from %s to %s: %u faces share it, among them %s and %s",
            limni_mesh_label(mesh), a, b, count, other_face, face);
    return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                      "%s: inconsistent winding: %s and %s both run from %s to %s",
                      limni_mesh_label(mesh), other_face, face, a, b);
}

/// Looks at all half-edges out of control point c: each must go somewhere else. With `cut`, all
/// half-edges of an edge that breaks this are marked there.
static limn_bake_status check_directions(limni_context *context, const limni_mesh *mesh,
                                         const incidence *in, uint32_t c, unsigned char *cut) {
    limn_bake_status status = LIMN_BAKE_OK;
    for (uint32_t o = in->starts[c]; o < in->starts[c + 1]; o++) {
        const uint32_t h = in->outgoing[o], to = limni_half_edge_end(mesh, h);
        const uint32_t other = in->first_to[to];
        if (other == LIMNI_NONE) {
            in->first_to[to] = h;
        } else if (cut) {
            cut[h] = cut[other] = 1;
        } else if (status == LIMN_BAKE_OK) {
            status = fail_edge(context, mesh, h, other);
        }
    }
    return status;
}

static void forget_directions(const limni_mesh *mesh, const incidence *in, uint32_t c) {
    for (uint32_t o = in->starts[c]; o < in->starts[c + 1]; o++)
        in->first_to[limni_half_edge_end(mesh, in->outgoing[o])] = LIMNI_NONE;
}

/// Pairs every half-edge into c, from x, with the one from c to x. Where one is cut, both are, and
/// stay open.
static void pair_incoming(limni_mesh *mesh, const incidence *in, uint32_t c, unsigned char *cut) {
    for (uint32_t o = in->starts[c]; o < in->starts[c + 1]; o++) {
        const uint32_t incoming = limni_half_edge_previous(mesh, in->outgoing[o]);
        const uint32_t opposite = in->first_to[limni_half_edge_start(mesh, incoming)];
        if (opposite == LIMNI_NONE) continue;
        if (cut && (cut[opposite] || cut[incoming])) {
            cut[opposite] = cut[incoming] = 1;
        } else {
            mesh->pairs[incoming] = opposite;
        }
    }
}

limn_bake_status limni_pair_half_edges(limni_context *context, limni_mesh *mesh,
                                       unsigned char *cut) {
    incidence in;
    LIMNI_TRY(build_incidence(context, mesh, &in));
    memset(mesh->pairs, 0xff, mesh->half_edge_count * sizeof *mesh->pairs);
    // All cuts must be known before the first pair is made.
    for (uint32_t c = 0; c < mesh->control_count && cut; c++) {
        check_directions(context, mesh, &in, c, cut);
        forget_directions(mesh, &in, c);
    }
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        LIMNI_TRY(check_directions(context, mesh, &in, c, cut));
        pair_incoming(mesh, &in, c, cut);
        forget_directions(mesh, &in, c);
    }
    release_incidence(context, &in);
    return LIMN_BAKE_OK;
}

// ---- Fans

static int compare_edges(const void *a, const void *b) {
    const limni_keyed_edge *const left = a, *const right = b;
    if (left->key != right->key) return left->key < right->key ? -1 : 1;
    return (left->half_edge > right->half_edge) - (left->half_edge < right->half_edge);
}

void limni_sort_edges(limni_keyed_edge *edges, size_t count) {
    if (count) qsort(edges, count, sizeof *edges, compare_edges);
}

limni_fan limni_walk_fan(const limni_mesh *mesh, uint32_t h, unsigned char *seen) {
    limni_fan fan = {.first = h};
    while (mesh->pairs[fan.first] != LIMNI_NONE) {
        fan.first = limni_half_edge_next(mesh, mesh->pairs[fan.first]);
        if (fan.first == h) break;
    }
    uint32_t turning = fan.first;
    do {
        seen[turning] = 1;
        fan.last = turning;
        fan.valence++;
        turning = limni_half_edge_turn(mesh, turning);
    } while (turning != LIMNI_NONE && turning != fan.first);
    fan.closed = turning != LIMNI_NONE;
    fan.valence += !fan.closed; // an open fan has one edge more than faces
    return fan;
}

static limn_bake_status fail_vertex(limni_context *context, const limni_mesh *mesh, uint32_t c,
                                    uint32_t h, uint32_t other) {
    limni_place vertex, face, other_face;
    return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                      "%s: non-manifold %s: %s and %s meet there without sharing a chain of edges",
                      limni_mesh_label(mesh), limni_control_place(mesh, c, vertex),
                      limni_face_place(mesh, mesh->face_of[h], face),
                      limni_face_place(mesh, mesh->face_of[other], other_face));
}

/// Of each control point, which must have no more than one.
static limn_bake_status find_fans(limni_context *context, limni_mesh *mesh) {
    unsigned char *const seen = limni_allocate_zeroed(context, mesh->half_edge_count, 1);
    if (!seen) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        mesh->first[c] = LIMNI_NONE;
        mesh->valences[c] = 0;
    }
    for (uint32_t h = 0; h < mesh->half_edge_count; h++) {
        const uint32_t c = limni_half_edge_start(mesh, h);
        if (seen[h]) continue;
        if (mesh->first[c] != LIMNI_NONE) return fail_vertex(context, mesh, c, mesh->first[c], h);
        const limni_fan fan = limni_walk_fan(mesh, h, seen);
        mesh->first[c] = fan.first;
        mesh->valences[c] = fan.valence;
    }
    limni_release(context, seen);
    return LIMN_BAKE_OK;
}

static void note_unused(limni_context *context, const limni_mesh *mesh) {
    uint32_t count = 0, example = 0;
    for (uint32_t c = mesh->control_count; c-- > 0;) {
        if (mesh->first[c] != LIMNI_NONE) continue;
        count++;
        example = c;
    }
    limni_place text;
    if (count)
        limni_note(context, "%s: %u control points are used by no face (the first is %s); kept",
                   limni_mesh_label(mesh), count, limni_control_place(mesh, example, text));
}

limn_bake_status limni_connect(limni_context *context, limni_mesh *mesh) {
    const size_t half_edge_count = mesh->half_edge_count;
    mesh->pairs = limni_allocate(context, half_edge_count, sizeof *mesh->pairs);
    if (!mesh->pairs) return LIMN_BAKE_MEMORY;
    if (context->desc.non_manifold == LIMN_NON_MANIFOLD_SPLIT)
        LIMNI_TRY(limni_split(context, mesh));
    mesh->first = limni_allocate(context, mesh->control_count, sizeof *mesh->first);
    mesh->valences = limni_allocate(context, mesh->control_count, sizeof *mesh->valences);
    if (!mesh->first || !mesh->valences) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_pair_half_edges(context, mesh, NULL));
    LIMNI_TRY(find_fans(context, mesh));
    note_unused(context, mesh);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_mesh_begin(limni_context *context, limni_source *source, limni_mesh *mesh) {
    if (source->face_offsets[source->face_count] > LIMNI_CORNERS_MAX ||
        source->position_count > LIMNI_CORNERS_MAX)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: more than %u vertices, or corners of faces",
                          source->path ? source->path : source->name, LIMNI_CORNERS_MAX);
    if (source->tags.crease_count > LIMNI_CORNERS_MAX)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: more than %u creases",
                          source->path ? source->path : source->name, LIMNI_CORNERS_MAX);
    LIMNI_TRY(limni_check_tags(context, source));
    if (context->desc.repair & LIMN_REPAIR_WELD) LIMNI_TRY(limni_weld(context, source));
    LIMNI_TRY(limni_check_faces(context, source));
    LIMNI_TRY(limni_make_faces(context, source, mesh));
    return limni_tag_mesh(context, source, mesh);
}

limn_bake_status limni_mesh_build(limni_context *context, limni_source *source, limni_mesh *mesh) {
    LIMNI_TRY(limni_mesh_begin(context, source, mesh));
    LIMNI_TRY(limni_check_extent(context, source, mesh));
    return limni_connect(context, mesh);
}
