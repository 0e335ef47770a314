/* SPDX-License-Identifier: MIT */
/*
 * Base meshes. A vertex is what corners of patches have in common: the base vertex, its normal and
 * the values of all channels. Its stencil is the row of such a corner in a table, without zeros.
 */
#include "edge_error.h"
#include "lod.h"
#include "mesh.h"
#include "require.h"

#include <math.h>
#include <string.h>

// ---- Rows of corners

/// The row of one corner in the table of a class.
typedef struct corner_row {
    const float *coefficients; ///< of column 0
    uint32_t stride;           ///< floats from column to column
    const uint16_t *columns;   ///< of the slots; NULL: slot k has column k
} corner_row;

static uint32_t find_place(const uint16_t *rows, uint32_t row) {
    uint32_t place = 0;
    while (rows[place] != row)
        place++;
    return place;
}

/// The piece at a corner has it as its corner 0.
static corner_row find_row(const limni_run *run, uint32_t corner) {
    if (run->pieces) {
        const limni_piece piece = limni_piece_of(run, corner);
        const limni_piece_layout *const layout = piece.positions;
        return (corner_row){piece.table + find_place(layout->rows, 0), layout->row_stride,
                            piece.columns};
    }
    const limni_layout *const layout = run->layout;
    return (corner_row){run->table + find_place(layout->rows, corner), layout->row_stride, NULL};
}

static float coefficient_of(const corner_row *row, uint32_t slot) {
    const uint32_t column = row->columns ? row->columns[slot] : slot;
    return column == LIMN_FORMAT_NO_COLUMN ? 0 : row->coefficients[(size_t)column * row->stride];
}

static uint32_t count_terms(const limni_run *run, uint32_t corner) {
    const corner_row row = find_row(run, corner);
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < run->control_count; slot++)
        count += coefficient_of(&row, slot) != 0;
    return count;
}

/// The terms of a corner of the first patch of a run, in ascending order. Returns how many.
static uint32_t write_terms(const limni_run *run, uint32_t corner, limn_file_term *terms) {
    const corner_row row = find_row(run, corner);
    const uint8_t *const narrow = run->slots;
    const uint16_t *const wide = run->slots;
    uint32_t count = 0;
    for (uint32_t k = 0; k < run->control_count; k++) {
        const uint32_t slot = run->slot_size == 1 ? narrow[k] : wide[k];
        const float weight = coefficient_of(&row, slot);
        if (weight != 0) terms[count++] = (limn_file_term){run->indices[slot], weight};
    }
    return count;
}

// ---- Size

enum { WINDOW = 1 << 17 }; ///< base vertices that are looked at together

/// The terms of base vertices [first, first + WINDOW), each at the first of its corners.
static uint64_t count_window(const limn_mesh *mesh, uint32_t first) {
    const uint32_t corner_count = mesh->domain->corner_count;
    uint8_t seen[WINDOW / 8] = {0};
    uint64_t count = 0;
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        const limn_file_run *const run = &mesh->runs[r];
        const limni_run part = limni_run_part(mesh, run, 0, run->patch_count);
        const uint32_t *indices = part.indices;
        for (uint32_t p = 0; p < run->patch_count; p++, indices += part.control_count) {
            for (uint32_t corner = 0; corner < corner_count; corner++) {
                const uint32_t at = indices[corner] - part.first_corner - first;
                if (at >= WINDOW || seen[at / 8] >> at % 8 & 1) continue;
                seen[at / 8] |= (uint8_t)(1u << at % 8);
                count += count_terms(&part, corner);
            }
        }
    }
    return count;
}

static uint64_t count_all_terms(const limn_mesh *mesh) {
    uint64_t count = 0;
    for (uint64_t first = 0; first < mesh->base_count; first += WINDOW)
        count += count_window(mesh, (uint32_t)first);
    return count;
}

/// Where things lie in the caller's memory, in bytes: what stays, and then what only building needs.
/// A size of 0: there is nothing to build, or more than can be counted.
typedef struct base_layout {
    uint64_t terms, indices, vertices, ids, heads, links, values, size;
} base_layout;

static base_layout lay_out(const limn_mesh *mesh) {
    const uint64_t term_count = count_all_terms(mesh);
    const uint64_t index_count = (uint64_t)mesh->patch_count * mesh->domain->index_counts[0];
    const uint64_t corners = (uint64_t)mesh->patch_count * mesh->domain->corner_count;
    const uint64_t heads = corners > mesh->base_count ? corners : mesh->base_count;
    base_layout l = {.terms = 0};
    l.indices = term_count * sizeof(limn_file_term);
    l.vertices = l.indices + index_count * sizeof(uint32_t);
    l.ids = l.vertices + corners * sizeof(limn_base_vertex);
    l.heads = l.ids + corners * sizeof(uint32_t);
    l.links = l.heads + heads * sizeof(uint32_t);
    l.values = l.links + corners * sizeof(uint32_t);
    l.size = l.values + corners * sizeof(uint32_t);
    const bool countable = term_count <= UINT32_MAX && index_count <= UINT32_MAX;
    if (mesh->patch_count == 0 || !countable || l.size != (size_t)l.size) l.size = 0;
    return l;
}

size_t limn_base_size(const limn_mesh *mesh) {
    LIMNI_REQUIRE(mesh && mesh->domain, 0);
    return (size_t)lay_out(mesh).size;
}

// ---- Vertices

/// Numbers for corners: equal where all that has been looked at is equal.
typedef struct numbering {
    uint32_t *ids; ///< [corner_count] of corners of patches, below id_count
    uint32_t corner_count, id_count;
    uint32_t *heads;          ///< [id_count] by old number: the last of the new ones, plus 1
    uint32_t *links, *values; ///< by new number: the one before it with the same old number, plus 1
} numbering;

/// The new number of a corner with that value.
static uint32_t number_of(numbering *n, uint32_t old, uint32_t value, uint32_t *count) {
    for (uint32_t next = n->heads[old]; next; next = n->links[next - 1]) {
        if (n->values[next - 1] == value) return next - 1;
    }
    n->links[*count] = n->heads[old];
    n->values[*count] = value;
    n->heads[old] = *count + 1;
    return (*count)++;
}

/// Divides numbers by the corners that patches of `mesh` have, or by `values`.
///
/// values  [n->corner_count]; NULL: the base vertices of the mesh
static void divide(numbering *n, const limn_mesh *mesh, const uint32_t *values) {
    const uint32_t corner_count = mesh->domain->corner_count;
    uint32_t count = 0, corners[LIMN_CORNER_MAX];
    memset(n->heads, 0, n->id_count * sizeof *n->heads);
    for (uint32_t at = 0; at < n->corner_count; at++) {
        const uint32_t corner = at % corner_count;
        if (corner == 0) limn_mesh_corners(mesh, at / corner_count, corners);
        n->ids[at] = number_of(n, n->ids[at], values ? values[at] : corners[corner], &count);
    }
    n->id_count = count;
}

/// By base vertices first, so that few numbers ever come from one.
static void number_corners(const limn_pack *pack, const limn_mesh *mesh, numbering *n) {
    const uint32_t corner_count = mesh->domain->corner_count;
    uint32_t corners[LIMN_CORNER_MAX];
    for (uint32_t at = 0; at < n->corner_count; at++) {
        if (at % corner_count == 0) limn_mesh_corners(mesh, at / corner_count, corners);
        n->ids[at] = corners[at % corner_count] - mesh->base_first;
    }
    n->id_count = mesh->base_count;
    divide(n, mesh, mesh->corner_normals);
    for (uint32_t c = 0; c < mesh->channel_count; c++) {
        const limn_channel channel = limn_mesh_channel(pack, mesh, c);
        divide(n, &channel.mesh, NULL);
    }
}

/// Each number is a vertex, at the first of its corners.
static void list_vertices(const limn_mesh *mesh, const numbering *n, limn_base_vertex *vertices) {
    const uint32_t corner_count = mesh->domain->corner_count;
    uint32_t count = 0, corners[LIMN_CORNER_MAX];
    for (uint32_t at = 0; at < n->corner_count; at++) {
        const uint32_t corner = at % corner_count;
        if (corner == 0) limn_mesh_corners(mesh, at / corner_count, corners);
        if (n->ids[at] < count) continue;
        const uint32_t point = corners[corner] - mesh->base_first;
        vertices[count++] = (limn_base_vertex){
            .corner = at, .normal = mesh->corner_normals ? mesh->corner_normals[at] : point};
    }
}

/// Vertices at the same base vertex share their terms.
///
/// firsts  [mesh->base_count]
static void list_terms(const limn_mesh *mesh, limn_base_vertex *vertices, uint32_t vertex_count,
                       uint32_t *firsts, limn_file_term *terms) {
    const uint32_t corner_count = mesh->domain->corner_count;
    uint32_t term_count = 0, corners[LIMN_CORNER_MAX];
    memset(firsts, 0, mesh->base_count * sizeof *firsts);
    for (uint32_t v = 0; v < vertex_count; v++) {
        limn_base_vertex *const vertex = &vertices[v];
        const uint32_t patch = vertex->corner / corner_count,
                       corner = vertex->corner % corner_count;
        limn_mesh_corners(mesh, patch, corners);
        uint32_t *const first = &firsts[corners[corner] - mesh->base_first];
        if (*first == 0) {
            const limn_file_run *const run = &mesh->runs[limni_find_run(mesh, patch)];
            const uint32_t in_run = patch - run->first_patch;
            const limni_run part = limni_run_part(mesh, run, in_run, in_run + 1);
            *first = v + 1;
            vertex->first_term = term_count;
            vertex->term_count = write_terms(&part, corner, terms + term_count);
            term_count += vertex->term_count;
        } else {
            vertex->first_term = vertices[*first - 1].first_term;
            vertex->term_count = vertices[*first - 1].term_count;
        }
    }
}

static void list_triangles(const limn_domain *domain, const numbering *n, uint32_t *indices) {
    for (uint32_t first = 0; first < n->corner_count; first += domain->corner_count) {
        for (uint32_t i = 0; i < domain->index_counts[0]; i++)
            *indices++ = n->ids[first + domain->indices[0][i]];
    }
}

// ---- Errors

static float length_of(const float *a, const float *b) {
    const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrtf(x * x + y * y + z * z);
}

/// The longest edge of the bind pose, and the largest error of one at level 0.
static void measure(limn_base *base) {
    const limn_mesh *const mesh = base->mesh;
    const uint32_t corner_count = mesh->domain->corner_count;
    uint32_t corners[LIMN_CORNER_MAX];
    for (uint32_t p = 0; p < mesh->patch_count; p++) {
        limn_mesh_corners(mesh, p, corners);
        for (uint32_t e = 0; e < corner_count; e++) {
            const float length =
                length_of(mesh->controls + 3 * (size_t)corners[e],
                          mesh->controls + 3 * (size_t)corners[(e + 1) % corner_count]);
            base->length = fmaxf(base->length, length);
            if (!mesh->errors) continue;
            const uint32_t packed = mesh->errors[(size_t)p * corner_count + e];
            base->error = fmaxf(base->error, length * limni_error_at(packed, 0));
        }
    }
}

limn_base limn_base_build(const limn_pack *pack, const limn_mesh *mesh, void *memory) {
    LIMNI_REQUIRE(pack && mesh && mesh->domain, (limn_base){0});
    const base_layout layout = lay_out(mesh);
    if (layout.size == 0) return (limn_base){.mesh = mesh};
    LIMNI_REQUIRE(memory, (limn_base){0});
    unsigned char *const bytes = memory;
    limn_file_term *const terms = memory;
    uint32_t *const indices = (uint32_t *)(void *)(bytes + layout.indices);
    limn_base_vertex *const vertices = (limn_base_vertex *)(void *)(bytes + layout.vertices);
    numbering n = {.ids = (uint32_t *)(void *)(bytes + layout.ids),
                   .corner_count = mesh->patch_count * mesh->domain->corner_count,
                   .heads = (uint32_t *)(void *)(bytes + layout.heads),
                   .links = (uint32_t *)(void *)(bytes + layout.links),
                   .values = (uint32_t *)(void *)(bytes + layout.values)};
    number_corners(pack, mesh, &n);
    list_vertices(mesh, &n, vertices);
    list_triangles(mesh->domain, &n, indices);
    list_terms(mesh, vertices, n.id_count, n.heads, terms);
    limn_base base = {.mesh = mesh,
                      .vertex_count = n.id_count,
                      .index_count = mesh->patch_count * mesh->domain->index_counts[0],
                      .indices = indices,
                      .vertices = vertices,
                      .terms = terms,
                      .size = (size_t)layout.vertices + n.id_count * sizeof *vertices};
    measure(&base);
    return base;
}

// ---- Levels

static float square(float a) {
    return a * a;
}

/// The square of the largest length on the screen of what is `size` long in the box: longer than any
/// edge there seems to limni_lod_measure().
static float find_seen(const limn_view *view, const float *box, float size) {
    float distance2 = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float eye = view->eye[axis];
        distance2 += square(fmaxf(fmaxf(box[axis] - eye, eye - box[3 + axis]), 0));
    }
    const float divisor = view->orthographic ? 1 : fmaxf(distance2, square(view->nearest));
    return square(size * 1.000001f) * square(view->pixels) / divisor; // for what roundings take
}

/// As limni_lod_measure() has it.
static float find_level(const limn_lod_desc *desc, float seen) {
    if (desc->lod == LIMN_LOD_ERROR) return seen <= square(desc->pixels) ? 0 : 1;
    return 0.5f * limni_log2(seen / square(desc->pixels)) + desc->bias;
}

bool limn_base_suffices(const limn_base *base, const float *box, const limn_view *views,
                        uint32_t view_count, const limn_lod_desc *desc) {
    LIMNI_REQUIRE(base && base->mesh && box && views, false);
    LIMNI_REQUIRE(view_count >= 1 && view_count <= LIMN_VIEW_MAX, false);
    const limn_lod_desc d = limni_lod_complete(desc);
    LIMNI_REQUIRE(limni_lod_is_valid(&d, base->mesh), false);
    const bool by_error = d.lod == LIMN_LOD_ERROR;
    if (d.min_level > 0 || (by_error && d.bias > 0)) return false;
    if (d.lod == LIMN_LOD_UNIFORM) return d.level + d.bias <= 0;
    for (uint32_t v = 0; v < view_count; v++) {
        const float seen = find_seen(&views[v], box, by_error ? base->error : base->length);
        if (!(find_level(&d, seen) <= 0)) return false;
    }
    return true;
}
