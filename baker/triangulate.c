/* SPDX-License-Identifier: MIT */
/*
 * Polygons become triangles, the same on every host: an ear at a time, always the one with the
 * shortest diagonal, ties to the smaller control point indices. For a quad this is its shorter
 * diagonal. A diagonal that is an edge of the mesh already would make it non-manifold, and is
 * avoided.
 */
#include "triangulate.h"

#include "hash.h"

#include <math.h>
#include <string.h>

/// The edges of the mesh so far, as a set.
typedef struct edge_set {
    uint64_t *keys; ///< 0: free, which is no key, since the ends of an edge differ
    uint32_t size;
} edge_set;

static uint64_t *find_edge(const edge_set *set, uint64_t key) {
    uint32_t at = (uint32_t)limni_hash_mix(key, 0) & (set->size - 1);
    while (set->keys[at] != 0 && set->keys[at] != key)
        at = (at + 1) & (set->size - 1);
    return &set->keys[at];
}

static bool has_edge(const edge_set *set, uint32_t a, uint32_t b) {
    return *find_edge(set, limni_edge_key(a, b)) != 0;
}

static void add_edge(edge_set *set, uint32_t a, uint32_t b) {
    *find_edge(set, limni_edge_key(a, b)) = limni_edge_key(a, b);
}

/// A polygon that is being cut.
typedef struct polygon {
    const limni_source *source;
    uint32_t *corners; ///< [size] of the source
    uint32_t size;
    double normal[3]; ///< of the whole polygon, by Newell's method; any length
} polygon;

static uint32_t control_at(const polygon *p, uint32_t corner) {
    return p->source->face_corners[p->corners[corner]];
}

static const float *at(const polygon *p, uint32_t corner) {
    return p->source->positions[control_at(p, corner)];
}

static void find_normal(polygon *p) {
    memset(p->normal, 0, sizeof p->normal);
    for (uint32_t c = 0; c < p->size; c++) {
        const float *const a = at(p, c), *const b = at(p, (c + 1) % p->size);
        for (int axis = 0; axis < 3; axis++) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            p->normal[axis] += ((double)a[u] - b[u]) * ((double)a[v] + b[v]);
        }
    }
}

/// Twice the signed area of a triangle, seen along the normal.
static double facing(const polygon *p, const float *a, const float *b, const float *c) {
    double sum = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double ab[2] = {(double)b[u] - a[u], (double)b[v] - a[v]};
        const double ac[2] = {(double)c[u] - a[u], (double)c[v] - a[v]};
        sum += p->normal[axis] * (ab[0] * ac[1] - ab[1] * ac[0]);
    }
    return sum;
}

/// A corner can be cut off if it is convex and no other corner lies in its triangle.
static bool is_ear(const polygon *p, uint32_t corner) {
    const uint32_t before = (corner + p->size - 1) % p->size, after = (corner + 1) % p->size;
    const float *const a = at(p, before), *const b = at(p, corner), *const c = at(p, after);
    if (!(facing(p, a, b, c) > 0)) return false;
    for (uint32_t other = 0; other < p->size; other++) {
        if (other == before || other == corner || other == after) continue;
        const float *const q = at(p, other);
        if (facing(p, a, b, q) >= 0 && facing(p, b, c, q) >= 0 && facing(p, c, a, q) >= 0)
            return false;
    }
    return true;
}

static double squared_distance(const float *a, const float *b) {
    double sum = 0;
    for (int axis = 0; axis < 3; axis++)
        sum += ((double)a[axis] - b[axis]) * ((double)a[axis] - b[axis]);
    return sum;
}

/// A corner that could be cut off.
typedef struct cut {
    uint32_t corner;
    bool existing; ///< the diagonal is an edge already
    double length;
    uint64_t key;
} cut;

/// Shorter first; ties to the smaller control point indices.
static bool is_shorter(const cut *a, const cut *b) {
    if (a->length != b->length) return a->length < b->length;
    const uint32_t low = a->key & 0xffffffffu, other_low = b->key & 0xffffffffu;
    return low != other_low ? low < other_low : a->key < b->key;
}

static cut cut_at(const polygon *p, const edge_set *edges, uint32_t corner) {
    const uint32_t before = (corner + p->size - 1) % p->size, after = (corner + 1) % p->size;
    const uint32_t a = control_at(p, before), b = control_at(p, after);
    return (cut){
        .corner = corner,
        .existing = has_edge(edges, a, b),
        .length = squared_distance(at(p, before), at(p, after)),
        .key = limni_edge_key(a, b),
    };
}

/// The shortest cut along an edge that exists, or does not, behind `last` if that is given. Returns
/// whether there is one.
static bool find_cut(const polygon *p, const edge_set *edges, bool existing, const cut *last,
                     cut *best) {
    bool found = false;
    for (uint32_t corner = 0; corner < p->size; corner++) {
        const cut candidate = cut_at(p, edges, corner);
        if (candidate.existing != existing) continue;
        if (last && !is_shorter(last, &candidate)) continue;
        if (!found || is_shorter(&candidate, best)) *best = candidate;
        found = true;
    }
    return found;
}

/// New diagonals come first, then ears, then short ones. Whether a corner is an ear takes longest
/// to find out, and is asked last: of most polygons the first cut that is tried is one.
static uint32_t best_corner(const polygon *p, const edge_set *edges) {
    cut shortest, tried;
    const bool existing = !find_cut(p, edges, false, NULL, &shortest);
    if (existing) find_cut(p, edges, true, NULL, &shortest);
    tried = shortest;
    if (p->size == 4) return shortest.corner; // of a quad, only the lengths count
    do {
        if (is_ear(p, tried.corner)) return tried.corner;
        const cut last = tried;
        if (!find_cut(p, edges, existing, &last, &tried)) return shortest.corner;
    } while (true);
}

static void emit(const polygon *p, const uint32_t corners[3], limni_mesh *mesh,
                 uint32_t source_face) {
    const size_t first = 3 * (size_t)mesh->face_count;
    for (uint32_t c = 0; c < 3; c++) {
        mesh->source_corners[first + c] = p->corners[corners[c]];
        mesh->corners[first + c] = control_at(p, corners[c]);
    }
    mesh->polygons[mesh->face_count++] = source_face;
}

static void cut_polygon(polygon *p, edge_set *edges, limni_mesh *mesh, uint32_t source_face) {
    find_normal(p);
    while (p->size > 3) {
        const uint32_t corner = best_corner(p, edges);
        const uint32_t before = (corner + p->size - 1) % p->size, after = (corner + 1) % p->size;
        emit(p, (const uint32_t[]){before, corner, after}, mesh, source_face);
        add_edge(edges, control_at(p, before), control_at(p, after));
        memmove(p->corners + corner, p->corners + corner + 1,
                (p->size - corner - 1) * sizeof *p->corners);
        p->size--;
    }
    emit(p, (const uint32_t[]){0, 1, 2}, mesh, source_face);
}

static limn_bake_status make_edge_set(limni_context *context, const limni_source *source,
                                      edge_set *edges) {
    // Polygon edges and diagonals: at most one per corner and one less than that.
    edges->size = limni_hash_size(2 * source->face_offsets[source->face_count]);
    edges->keys = limni_allocate_zeroed(context, edges->size, sizeof *edges->keys);
    if (!edges->keys) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face < source->face_count; face++) {
        const uint32_t begin = source->face_offsets[face], end = source->face_offsets[face + 1];
        for (uint32_t c = begin; c < end; c++)
            add_edge(edges, source->face_corners[c],
                     source->face_corners[c + 1 < end ? c + 1 : begin]);
    }
    return LIMN_BAKE_OK;
}

static uint32_t largest_face(const limni_source *source) {
    uint32_t largest = 0;
    for (uint32_t face = 0; face < source->face_count; face++) {
        const uint32_t size = source->face_offsets[face + 1] - source->face_offsets[face];
        if (size > largest) largest = size;
    }
    return largest;
}

limn_bake_status limni_triangulate(limni_context *context, const limni_source *source,
                                   limni_mesh *mesh) {
    edge_set edges = {0};
    const uint32_t largest = largest_face(source);
    if (largest > 3) LIMNI_TRY(make_edge_set(context, source, &edges));
    uint32_t *const corners = limni_allocate(context, largest, sizeof *corners);
    if (!corners) return LIMN_BAKE_MEMORY;
    uint32_t quads = 0, larger = 0;
    for (uint32_t face = 0; face < source->face_count; face++) {
        const uint32_t begin = source->face_offsets[face];
        polygon p = {
            .source = source, .corners = corners, .size = source->face_offsets[face + 1] - begin};
        for (uint32_t c = 0; c < p.size; c++)
            corners[c] = begin + c;
        quads += p.size == 4;
        larger += p.size > 4;
        cut_polygon(&p, &edges, mesh, face);
    }
    limni_release(context, corners);
    limni_release(context, edges.keys);
    if (quads || larger)
        limni_note(context, "%s: triangulated %u quads and %u larger polygons: %u faces became %u",
                   source->path ? source->path : source->name, quads, larger, source->face_count,
                   mesh->face_count);
    return LIMN_BAKE_OK;
}
