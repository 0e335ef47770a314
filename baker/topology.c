/* SPDX-License-Identifier: MIT */
/* Pairs half-edges, and finds or mends what is not a manifold. */
#include "mesh.h"

#include <stdio.h>
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
    return place(text, "face", mesh->face_numbers[polygon] + mesh->index_base, mesh->face_lines,
                 polygon);
}

const char *limni_control_place(const limni_mesh *mesh, uint32_t control, limni_place text) {
    const uint32_t number = mesh->control_numbers ? mesh->control_numbers[control] : control;
    return place(text, "vertex", number + mesh->index_base, mesh->control_lines, control);
}

static const char *file_of(const limni_mesh *mesh) {
    return mesh->path ? mesh->path : mesh->name;
}

// ---- Pairs

/// The half-edges that start at each control point: starts[c] to starts[c + 1] of `outgoing`.
typedef struct incidence {
    uint32_t *starts;   ///< [control_count + 1]
    uint32_t *outgoing; ///< [3 * face_count], ascending for each control point
    uint32_t *first_to; ///< [control_count] scratch, all LIMNI_NONE between uses
} incidence;

static limn_bake_status build_incidence(limni_context *context, const limni_mesh *mesh,
                                        incidence *in) {
    const size_t half_edge_count = 3 * (size_t)mesh->face_count;
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
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
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
    limni_face_place(mesh, h / 3, face);
    limni_face_place(mesh, other / 3, other_face);
    if (count > 2)
        return limni_fail(
            context, LIMN_BAKE_BAD_INPUT,
            "%s: non-manifold edge from %s to %s: %u faces share it, among them %s and %s",
            file_of(mesh), a, b, count, other_face, face);
    return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                      "%s: inconsistent winding: %s and %s both run from %s to %s", file_of(mesh),
                      other_face, face, a, b);
}

/// Looks at all half-edges out of control point c: each must go somewhere else. With `split`, every
/// half-edge of an edge that breaks this is marked in `cut`.
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

/// Pairs every half-edge into c, from x, with the one from c to x. Edges that are cut stay open on
/// all sides; so does an edge that has a cut half-edge on either side.
static void pair_incoming(limni_mesh *mesh, const incidence *in, uint32_t c,
                          const unsigned char *cut) {
    for (uint32_t o = in->starts[c]; o < in->starts[c + 1]; o++) {
        const uint32_t incoming = limni_half_edge_previous(in->outgoing[o]);
        const uint32_t opposite = in->first_to[limni_half_edge_start(mesh, incoming)];
        if (opposite == LIMNI_NONE) continue;
        if (cut && (cut[opposite] || cut[incoming])) continue;
        mesh->pairs[incoming] = opposite;
    }
}

static limn_bake_status pair_half_edges(limni_context *context, limni_mesh *mesh,
                                        const incidence *in, unsigned char *cut) {
    memset(mesh->pairs, 0xff, 3 * (size_t)mesh->face_count * sizeof *mesh->pairs);
    // All cuts must be known before the first pair is made.
    for (uint32_t c = 0; c < mesh->control_count && cut; c++) {
        check_directions(context, mesh, in, c, cut);
        forget_directions(mesh, in, c);
    }
    for (uint32_t c = 0; c < mesh->control_count; c++) {
        const limn_bake_status status = check_directions(context, mesh, in, c, cut);
        pair_incoming(mesh, in, c, cut);
        forget_directions(mesh, in, c);
        LIMNI_TRY(status);
    }
    return LIMN_BAKE_OK;
}

// ---- Fans

/// Walks the fan of faces around the start of `h` and marks its outgoing half-edges. Returns its
/// clockwise-most half-edge, or `h` itself if the fan is closed, and the number of edges.
static uint32_t walk_fan(const limni_mesh *mesh, uint32_t h, unsigned char *seen,
                         uint32_t *valence) {
    uint32_t start = h;
    while (mesh->pairs[start] != LIMNI_NONE) {
        start = limni_half_edge_next(mesh->pairs[start]);
        if (start == h) break;
    }
    *valence = 0;
    uint32_t turning = start;
    do {
        seen[turning] = 1;
        ++*valence;
        turning = limni_half_edge_turn(mesh, turning);
    } while (turning != LIMNI_NONE && turning != start);
    *valence += turning == LIMNI_NONE; // an open fan has one edge more than faces
    return start;
}

static limn_bake_status fail_vertex(limni_context *context, const limni_mesh *mesh, uint32_t c,
                                    uint32_t h, uint32_t other) {
    limni_place vertex, face, other_face;
    return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                      "%s: non-manifold %s: %s and %s meet there without sharing a chain of edges",
                      file_of(mesh), limni_control_place(mesh, c, vertex),
                      limni_face_place(mesh, h / 3, face),
                      limni_face_place(mesh, other / 3, other_face));
}

/// Gives `half_edge`'s start a control point of its own, a copy, in that face alone.
static limn_bake_status split_corner(limni_context *context, limni_mesh *mesh, uint32_t half_edge,
                                     uint32_t *capacity, uint32_t *made) {
    if (mesh->control_count == *capacity) {
        *capacity += *capacity / 2 + 16;
        mesh->controls = limni_resize(context, mesh->controls, *capacity, sizeof *mesh->controls);
        mesh->first = limni_resize(context, mesh->first, *capacity, sizeof *mesh->first);
        mesh->valences = limni_resize(context, mesh->valences, *capacity, sizeof *mesh->valences);
        mesh->vertex_sharpness = limni_resize(context, mesh->vertex_sharpness, *capacity,
                                              sizeof *mesh->vertex_sharpness);
        if (!mesh->controls || !mesh->first || !mesh->valences || !mesh->vertex_sharpness)
            return LIMN_BAKE_MEMORY;
    }
    *made = mesh->control_count++;
    uint32_t *const corner = &mesh->faces[half_edge / 3][half_edge % 3];
    memcpy(mesh->controls[*made], mesh->controls[*corner], sizeof *mesh->controls);
    mesh->vertex_sharpness[*made] = mesh->vertex_sharpness[*corner];
    *corner = *made;
    return LIMN_BAKE_OK;
}

/// Gives the fan that starts at `h` a control point of its own.
static limn_bake_status split_fan(limni_context *context, limni_mesh *mesh, uint32_t h,
                                  uint32_t valence, uint32_t *capacity) {
    uint32_t made;
    LIMNI_TRY(split_corner(context, mesh, h, capacity, &made));
    mesh->first[made] = h;
    mesh->valences[made] = valence;
    for (uint32_t turning = limni_half_edge_turn(mesh, h); turning != LIMNI_NONE && turning != h;
         turning = limni_half_edge_turn(mesh, turning))
        mesh->faces[turning / 3][turning % 3] = made;
    return LIMN_BAKE_OK;
}

static limn_bake_status find_fans_at(limni_context *context, limni_mesh *mesh, const incidence *in,
                                     uint32_t c, unsigned char *seen, uint32_t *capacity) {
    const bool split = context->desc.repair & LIMN_REPAIR_SPLIT;
    mesh->first[c] = LIMNI_NONE;
    mesh->valences[c] = 0;
    for (uint32_t o = in->starts[c]; o < in->starts[c + 1]; o++) {
        const uint32_t h = in->outgoing[o];
        if (seen[h]) continue;
        uint32_t valence;
        const uint32_t start = walk_fan(mesh, h, seen, &valence);
        if (mesh->first[c] == LIMNI_NONE) {
            mesh->first[c] = start;
            mesh->valences[c] = valence;
        } else if (split) {
            LIMNI_TRY(split_fan(context, mesh, start, valence, capacity));
        } else {
            return fail_vertex(context, mesh, c, mesh->first[c], h);
        }
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status find_fans(limni_context *context, limni_mesh *mesh, const incidence *in,
                                  uint32_t *capacity) {
    const uint32_t control_count = mesh->control_count;
    unsigned char *const seen = limni_allocate_zeroed(context, 3 * (size_t)mesh->face_count, 1);
    if (!seen) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < control_count; c++)
        LIMNI_TRY(find_fans_at(context, mesh, in, c, seen, capacity));
    limni_release(context, seen);
    return LIMN_BAKE_OK;
}

// ---- Splitting

/// One attempt: pairs half-edges, leaving the bad edges open, and splits vertices with several
/// fans. Returns in `cut_count` how many half-edges were left open.
static limn_bake_status connect_once(limni_context *context, limni_mesh *mesh, unsigned char *cut,
                                     uint32_t *capacity, uint32_t *cut_count) {
    incidence in;
    LIMNI_TRY(build_incidence(context, mesh, &in));
    if (cut) memset(cut, 0, 3 * (size_t)mesh->face_count);
    LIMNI_TRY(pair_half_edges(context, mesh, &in, cut));
    LIMNI_TRY(find_fans(context, mesh, &in, capacity));
    release_incidence(context, &in);
    *cut_count = 0;
    for (uint32_t h = 0; h < 3 * mesh->face_count && cut; h++)
        *cut_count += cut[h];
    return LIMN_BAKE_OK;
}

/// Takes the faces of all cut half-edges off their neighbours there.
static limn_bake_status detach_cuts(limni_context *context, limni_mesh *mesh,
                                    const unsigned char *cut, uint32_t *capacity) {
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        if (!cut[h]) continue;
        uint32_t made;
        LIMNI_TRY(split_corner(context, mesh, h, capacity, &made));
        LIMNI_TRY(split_corner(context, mesh, limni_half_edge_next(h), capacity, &made));
    }
    return LIMN_BAKE_OK;
}

/// Cuts bad edges and splits vertices until the indices alone describe a manifold. Every round but
/// the last adds control points, of which there can be no more than corners.
static limn_bake_status connect_splitting(limni_context *context, limni_mesh *mesh) {
    const uint32_t control_count = mesh->control_count;
    uint32_t capacity = control_count, cut_count = 0, first_cut_count = 0;
    unsigned char *const cut = limni_allocate(context, 3 * (size_t)mesh->face_count, 1);
    if (!cut) return LIMN_BAKE_MEMORY;
    for (int round = 0;; round++) {
        const uint32_t before = mesh->control_count;
        LIMNI_TRY(connect_once(context, mesh, cut, &capacity, &cut_count));
        if (round == 0) first_cut_count = cut_count;
        if (cut_count == 0 && mesh->control_count == before) break;
        if (mesh->control_count == before) LIMNI_TRY(detach_cuts(context, mesh, cut, &capacity));
    }
    limni_release(context, cut);
    if (mesh->control_count > control_count) {
        mesh->control_lines = mesh->control_numbers = NULL; // the new ones have none
        limni_note(context,
                   "%s: repaired: %u control points added by splitting; %u half-edges were "
                   "non-manifold or wound inconsistently",
                   file_of(mesh), mesh->control_count - control_count, first_cut_count);
    }
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
                   file_of(mesh), count, limni_control_place(mesh, example, text));
}

limn_bake_status limni_connect(limni_context *context, limni_mesh *mesh) {
    const size_t half_edge_count = 3 * (size_t)mesh->face_count;
    mesh->pairs = limni_allocate(context, half_edge_count, sizeof *mesh->pairs);
    mesh->first = limni_allocate(context, mesh->control_count, sizeof *mesh->first);
    mesh->valences = limni_allocate(context, mesh->control_count, sizeof *mesh->valences);
    if (!mesh->pairs || !mesh->first || !mesh->valences) return LIMN_BAKE_MEMORY;
    if (context->desc.repair & LIMN_REPAIR_SPLIT) {
        LIMNI_TRY(connect_splitting(context, mesh));
    } else {
        uint32_t capacity = mesh->control_count, cut_count;
        LIMNI_TRY(connect_once(context, mesh, NULL, &capacity, &cut_count));
    }
    note_unused(context, mesh);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_mesh_build(limni_context *context, limni_source *source, limni_mesh *mesh) {
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
    LIMNI_TRY(limni_triangulate(context, source, mesh));
    LIMNI_TRY(limni_tag_mesh(context, source, mesh));
    return limni_connect(context, mesh);
}
