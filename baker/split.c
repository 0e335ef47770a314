/* SPDX-License-Identifier: MIT */
/*
 * Non-manifold meshes, as OpenSubdiv treats them (Far::TopologyRefinerFactory). The sheets that
 * meet in an edge or a vertex get control points of their own. All that they share is sharp, so the
 * limit there depends on what they share alone, and they still meet.
 */
#include "topology.h"

#include "hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// What is known of a vertex.
typedef struct junction {
    uint32_t fan_count;
    uint32_t ends[2]; ///< where the first fan begins and ends
    bool passed;      ///< by a crease
    float sharpness;  ///< of the vertex, or of edges that are manifold, if it is passed
    uint32_t first;   ///< of its control points
} junction;

/// Mesh, cuts and vertices while a mesh is split.
typedef struct splitter {
    limni_mesh *mesh;
    unsigned char *cut;  ///< [half_edge_count]
    unsigned char *seen; ///< [half_edge_count]
    junction *junctions; ///< [control_count] by the control points as they were
    bool may_pass;       ///< whether sheets of any number of faces have one crease through a vertex
} splitter;

/// A crease of edges that are not manifold passes through a vertex if it runs along all sheets
/// there.
static bool is_passed(const splitter *s, const limni_fan *fan, const uint32_t ends[2],
                      const junction *j) {
    const bool same = (ends[0] == j->ends[0] && ends[1] == j->ends[1]) ||
                      (ends[0] == j->ends[1] && ends[1] == j->ends[0]);
    return !fan->closed && same && ends[0] != ends[1] && s->cut[fan->first] &&
           s->cut[limni_half_edge_previous(s->mesh, fan->last)];
}

/// What is sharp on one sheet makes a corner of all. They can take that for a sharpness of the
/// vertex if there is only one, and must take it for ever otherwise.
static void meet_spokes(const splitter *s, const limni_fan *fan, junction *j) {
    for (uint32_t h = fan->first; h != fan->last;) {
        h = limni_half_edge_turn(s->mesh, h);
        const float sharpness = s->mesh->edge_sharpness[h];
        if (sharpness == 0) continue;
        j->passed &= j->sharpness == 0 || j->sharpness == sharpness;
        j->sharpness = sharpness;
    }
}

static void meet_fan(const splitter *s, const limni_fan *fan) {
    const uint32_t control = limni_half_edge_start(s->mesh, fan->first);
    const uint32_t last = limni_half_edge_previous(s->mesh, fan->last);
    const uint32_t ends[2] = {limni_half_edge_end(s->mesh, fan->first),
                              limni_half_edge_start(s->mesh, last)};
    junction *const j = &s->junctions[control];
    if (j->fan_count++ == 0) {
        memcpy(j->ends, ends, sizeof ends);
        j->passed = s->may_pass;
        j->sharpness = s->mesh->vertex_sharpness[control];
    }
    j->passed = j->passed && is_passed(s, fan, ends, j);
    if (j->passed) meet_spokes(s, fan, j);
}

static void meet_fans(const splitter *s) {
    for (uint32_t h = 0; h < s->mesh->half_edge_count; h++) {
        if (s->seen[h]) continue;
        const limni_fan fan = limni_walk_fan(s->mesh, h, s->seen);
        meet_fan(s, &fan);
    }
}

/// With two sheets, wound inconsistently, OpenSubdiv has corners all along the edge.
static bool is_corner(const junction *j) {
    return j->fan_count > 1 && !(j->passed && j->fan_count > 2);
}

static void sharpen(const splitter *s) {
    for (uint32_t h = 0; h < s->mesh->half_edge_count; h++) {
        if (s->cut[h]) s->mesh->edge_sharpness[h] = INFINITY;
    }
    for (uint32_t c = 0; c < s->mesh->control_count; c++) {
        const junction *const j = &s->junctions[c];
        if (j->fan_count > 1) s->mesh->vertex_sharpness[c] = is_corner(j) ? INFINITY : j->sharpness;
    }
}

/// Control points that were one stay side by side, so that each sheet has them in the same order:
/// what makes the sheets agree in every bit where they meet. Returns how many there are.
static uint32_t number_controls(const splitter *s) {
    uint32_t count = 0;
    for (uint32_t c = 0; c < s->mesh->control_count; c++) {
        s->junctions[c].first = count;
        count += s->junctions[c].fan_count > 1 ? s->junctions[c].fan_count : 1;
    }
    return count;
}

static limn_bake_status copy_controls(limni_context *context, const splitter *s, uint32_t count) {
    limni_mesh *const mesh = s->mesh;
    float(*const controls)[3] = limni_allocate(context, count, sizeof *controls);
    float *const sharpness = limni_allocate(context, count, sizeof *sharpness);
    mesh->origins = limni_allocate(context, count, sizeof *mesh->origins);
    if (!controls || !sharpness || !mesh->origins) return LIMN_BAKE_MEMORY;
    uint32_t origin = 0;
    for (uint32_t c = 0; c < count; c++) {
        if (origin + 1 < mesh->control_count && s->junctions[origin + 1].first == c) origin++;
        memcpy(controls[c], mesh->controls[origin], sizeof *controls);
        sharpness[c] = mesh->vertex_sharpness[origin];
        mesh->origins[c] = origin;
    }
    limni_release(context, mesh->controls);
    limni_release(context, mesh->vertex_sharpness);
    mesh->controls = controls;
    mesh->vertex_sharpness = sharpness;
    mesh->control_count = count;
    return LIMN_BAKE_OK;
}

/// Gives each fan the next of its vertex's control points.
static void renumber_faces(const splitter *s) {
    limni_mesh *const mesh = s->mesh;
    memset(s->seen, 0, mesh->half_edge_count);
    for (uint32_t h = 0; h < mesh->half_edge_count; h++) {
        if (s->seen[h]) continue;
        const limni_fan fan = limni_walk_fan(mesh, h, s->seen);
        const uint32_t control = s->junctions[limni_half_edge_start(mesh, h)].first++;
        uint32_t turning = fan.first;
        mesh->corners[turning] = control;
        while (turning != fan.last) {
            turning = limni_half_edge_turn(mesh, turning);
            mesh->corners[turning] = control;
        }
    }
}

// ---- What is said

static int compare_keys(const void *a, const void *b) {
    const uint64_t left = *(const uint64_t *)a, right = *(const uint64_t *)b;
    return (left > right) - (left < right);
}

static limn_bake_status count_cut_edges(limni_context *context, const splitter *s,
                                        uint32_t *count) {
    const uint32_t half_edge_count = s->mesh->half_edge_count;
    uint64_t *const keys = limni_allocate(context, half_edge_count, sizeof *keys);
    size_t key_count = 0;
    if (!keys) return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < half_edge_count; h++) {
        if (s->cut[h])
            keys[key_count++] =
                limni_edge_key(limni_half_edge_start(s->mesh, h), limni_half_edge_end(s->mesh, h));
    }
    if (key_count) qsort(keys, key_count, sizeof *keys, compare_keys);
    *count = 0;
    for (size_t k = 0; k < key_count; k++)
        *count += k == 0 || keys[k] != keys[k - 1];
    limni_release(context, keys);
    return LIMN_BAKE_OK;
}

static void note_split(limni_context *context, const splitter *s, uint32_t edge_count,
                       uint32_t added) {
    uint32_t vertex_count = 0, corner_count = 0;
    for (uint32_t c = 0; c < s->mesh->control_count; c++) {
        const junction *const j = &s->junctions[c];
        vertex_count += j->fan_count > 1;
        corner_count += is_corner(j);
    }
    limni_note(context,
               "%s: split: %u edges, sharp now, and %u vertices, of which %u are corners now; "
               "%u control points added",
               limni_mesh_label(s->mesh), edge_count, vertex_count, corner_count, added);
}

static limn_bake_status split(limni_context *context, const splitter *s) {
    uint32_t edge_count;
    meet_fans(s);
    const uint32_t count = number_controls(s);
    if (count == s->mesh->control_count) return LIMN_BAKE_OK;
    LIMNI_TRY(count_cut_edges(context, s, &edge_count));
    note_split(context, s, edge_count, count - s->mesh->control_count);
    sharpen(s);
    LIMNI_TRY(copy_controls(context, s, count));
    renumber_faces(s);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_split(limni_context *context, limni_mesh *mesh) {
    const size_t half_edge_count = mesh->half_edge_count;
    const splitter s = {
        .mesh = mesh,
        // Lomont's masks of a crease depend on how many faces there are on its side.
        .may_pass = context->desc.creases != LIMN_CREASES_LOMONT,
        .cut = limni_allocate_zeroed(context, half_edge_count, 1),
        .seen = limni_allocate_zeroed(context, half_edge_count, 1),
        .junctions = limni_allocate_zeroed(context, mesh->control_count, sizeof *s.junctions),
    };
    if (!s.cut || !s.seen || !s.junctions) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_pair_half_edges(context, mesh, s.cut));
    LIMNI_TRY(split(context, &s));
    limni_release(context, s.cut);
    limni_release(context, s.seen);
    limni_release(context, s.junctions);
    return LIMN_BAKE_OK;
}
