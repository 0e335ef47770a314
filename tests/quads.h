/* SPDX-License-Identifier: MIT */
/*
 * Files of quads without a baker: a torus of SIZE by SIZE control points, of bicubic B-spline
 * patches, whose coefficients are known. Faces have their corners in any rotation.
 */
#ifndef QUADS_H
#define QUADS_H

#include "../runtime/domain.h"

#include "blobs.h"

enum {
    SIZE = 5,          ///< control points around the torus, in both directions
    REGULAR = 16,      ///< points of a patch
    ISOLATED = 25,     ///< the same, where the mesh is isolated
    STRIDE = 296,      ///< of a table of a patch,
    PIECE_STRIDE = 80, ///< and of a piece
    POINTS_MAX = 21 * SIZE * SIZE,
    PATCHES_MAX = 4 * SIZE * SIZE
};

/// What a file is of.
typedef struct quad_kind {
    bool divided, isolated;
} quad_kind;

typedef struct quad_torus {
    quad_kind kind;
    uint32_t size;       ///< base vertices around, in both directions
    uint32_t base_first; ///< the first of them among the points
    uint32_t fine_first; ///< the first point behind them
    float points[POINTS_MAX][3];
    uint32_t point_count, term_count, stencils[POINTS_MAX + 1];
    limn_file_term terms[9 * POINTS_MAX];
    float tables[3 * REGULAR * STRIDE];
    uint32_t faces[PATCHES_MAX], indices[PATCHES_MAX * ISOLATED];
    uint8_t slots[PATCHES_MAX * ISOLATED];
    limn_file_normal normals[PATCHES_MAX];
    uint32_t ring[8 * PATCHES_MAX];
} quad_torus;

/// Of a grid; or of a patch, from its corner 0 on: u along edge 0, v along the last.
typedef struct grid_point {
    int u, v;
} grid_point;

static inline uint32_t wrap(int at, uint32_t size) {
    return (uint32_t)(at + (int)size) % size;
}

/// A base vertex, as the index of a point.
static inline uint32_t base_at(const quad_torus *t, grid_point p) {
    return t->base_first + wrap(p.u, t->size) + t->size * wrap(p.v, t->size);
}

/// A point of the level behind the base vertices: first those that belong to these.
static inline uint32_t fine_at(const quad_torus *t, grid_point p) {
    const uint32_t size = 2 * t->size, u = wrap(p.u, size), v = wrap(p.v, size);
    if (u % 2 == 0 && v % 2 == 0) return t->fine_first + u / 2 + t->size * (v / 2);
    const uint32_t of_base = (v + 1) / 2 * t->size + (v % 2 ? 0 : (u + 1) / 2); // before it
    return t->fine_first + t->size * t->size + u + size * v - of_base;
}

/// From the frame of the patch of a face, `scale` units long, to the grid.
static inline grid_point in_grid(uint32_t u, uint32_t v, uint32_t rotation, int scale,
                                 grid_point p) {
    const int a[4] = {p.u, scale - p.v, scale - p.u, p.v};
    const int b[4] = {p.v, p.u, scale - p.v, scale - p.u};
    return (grid_point){scale * (int)u + a[rotation], scale * (int)v + b[rotation]};
}

// ---- Points

/// Weights of the next level, in eighths, of the points floor((u + 1) / 2) - 1 + k. Odd points have
/// two.
static inline int divide_weight(uint32_t odd, int k) {
    static const int weights[2][3] = {{1, 6, 1}, {4, 4, 0}};
    return weights[odd][k];
}

/// Ascending, as in a file.
static inline void add_term(quad_torus *t, uint32_t first, uint32_t point, float weight) {
    uint32_t at = t->term_count++;
    for (; at > first && t->terms[at - 1].point > point; at--)
        t->terms[at] = t->terms[at - 1];
    t->terms[at] = (limn_file_term){point, weight};
}

/// A point of the level after a grid of `size`, whose points `at` finds.
static inline void add_stencil(quad_torus *t, uint32_t own, grid_point p,
                               uint32_t (*at)(const quad_torus *t, grid_point p)) {
    const uint32_t first = t->term_count, odd_u = (uint32_t)p.u % 2, odd_v = (uint32_t)p.v % 2;
    CHECK(own == t->point_count);
    t->point_count++;
    for (int b = 0; b < 3; b++) {
        for (int a = 0; a < 3; a++) {
            const int weight = divide_weight(odd_u, a) * divide_weight(odd_v, b);
            const grid_point q = {p.u / 2 + a - !odd_u, p.v / 2 + b - !odd_v};
            if (weight) add_term(t, first, at(t, q), (float)weight / 64);
        }
    }
    t->stencils[t->point_count - SIZE * SIZE] = t->term_count;
}

static inline uint32_t control_at(const quad_torus *t, grid_point p) {
    (void)t;
    return wrap(p.u, SIZE) + SIZE * wrap(p.v, SIZE);
}

static inline void make_controls(quad_torus *t) {
    for (uint32_t v = 0; v < SIZE; v++) {
        for (uint32_t u = 0; u < SIZE; u++) {
            const double a = 6.283185307179586 * u / SIZE, b = 6.283185307179586 * v / SIZE;
            const double r = 2 + cos(b) + 0.1 * cos(3 * a + b);
            float *const point = t->points[t->point_count++];
            point[0] = (float)(r * cos(a));
            point[1] = (float)(r * sin(a));
            point[2] = (float)(sin(b) + 0.2 * sin(2 * a));
        }
    }
}

/// The points of the next level that belong to a point of this one, or the others.
static inline void make_fine(quad_torus *t, bool of_base) {
    for (uint32_t v = 0; v < 2 * t->size; v++) {
        for (uint32_t u = 0; u < 2 * t->size; u++) {
            const grid_point p = {(int)u, (int)v};
            if ((u % 2 == 0 && v % 2 == 0) == of_base) add_stencil(t, fine_at(t, p), p, base_at);
        }
    }
}

static inline void make_points(quad_torus *t) {
    make_controls(t);
    t->size = SIZE;
    if (t->kind.divided) {
        t->base_first = SIZE * SIZE;
        t->size = 2 * SIZE;
        for (int v = 0; v < 2 * SIZE; v++) {
            for (int u = 0; u < 2 * SIZE; u++)
                add_stencil(t, base_at(t, (grid_point){u, v}), (grid_point){u, v}, control_at);
        }
    }
    t->fine_first = t->point_count;
    if (t->kind.isolated) {
        make_fine(t, true);
        make_fine(t, false);
    }
    const limn_mesh mesh = {.control_count = SIZE * SIZE,
                            .point_count = t->point_count,
                            .stencils = t->stencils,
                            .terms = t->terms,
                            .kernels = limn_kernels_select(0, LIMN_FAMILY_REPRODUCIBLE)};
    limn_mesh_refine(&mesh, t->points[0]);
}

// ---- Tables

/// Basis function k - 1 at s/16, times 6 * 16^3; or its derivative, times 2 * 16^2.
static inline long basis(int k, long s, bool derivative) {
    const long n = 16, r = n - s;
    if (derivative) {
        const long d[4] = {-r * r, 3 * s * s - 4 * s * n, -3 * s * s + 2 * s * n + n * n, s * s};
        return d[k];
    }
    const long b[4] = {r * r * r, 3 * s * s * s - 6 * s * s * n + 4 * n * n * n,
                       -3 * s * s * s + 3 * s * s * n + 3 * s * n * n + n * n * n, s * s * s};
    return b[k];
}

static inline double basis_product(grid_point p, limn_row row, bool du, bool dv) {
    const double scale_u = du ? 2.0 * 256 : 6.0 * 4096, scale_v = dv ? 2.0 * 256 : 6.0 * 4096;
    const double product = (double)(basis(p.u + 1, row.i, du) * basis(p.v + 1, row.j, dv));
    return product / (scale_u * scale_v);
}

/// In table 0 of positions; 1 and 2 of the tangents along and across, of a row on an edge in the
/// direction of the edge. Divided but once, from whole numbers: both sides get the same bits.
///
/// edges  those that count, of the patch
static inline float coefficient(uint32_t table, limn_row row, uint32_t edges, grid_point p) {
    if (table == 0) return (float)basis_product(p, row, false, false);
    const double du = basis_product(p, row, true, false), dv = basis_product(p, row, false, true);
    const double along[4] = {du, dv, -du, -dv}, across[4] = {dv, -du, -dv, du};
    uint32_t edge = 0;
    while (edges && !(edges >> edge & 1))
        edge++;
    return (float)(table == 1 ? along[edge] : across[edge]) + 0.0f;
}

/// Slots: the corners first.
static inline grid_point slot_place(uint32_t slot, int far_end, int end) {
    static const grid_point corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (slot < 4) return (grid_point){far_end * corners[slot].u, far_end * corners[slot].v};
    uint32_t left = slot - 4;
    for (int v = -1;; v++) {
        for (int u = -1; u <= end; u++) {
            const bool corner = (u == 0 || u == far_end) && (v == 0 || v == far_end);
            if (!corner && left-- == 0) return (grid_point){u, v};
        }
    }
}

/// Of a patch, or of a piece: of that, only edges 0 and 3 are on those of the patch.
static inline void make_tables(quad_torus *t) {
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_QUAD);
    const limni_pieces *const pieces = limni_pieces_get(LIMN_DOMAIN_QUAD);
    const uint32_t stride = t->kind.isolated ? PIECE_STRIDE : STRIDE;
    for (uint32_t table = 0; table < 3; table++) {
        const uint16_t *const rows = t->kind.isolated
                                         ? (table ? pieces->tangents : pieces->positions)[0].rows
                                         : limni_layout_get(LIMN_DOMAIN_QUAD, table > 0, 0)->rows;
        for (uint32_t slot = 0; slot < REGULAR; slot++) {
            for (uint32_t place = 0; place < stride; place++) {
                if (rows[place] == LIMNI_NO_ROW) continue;
                const limn_row row = domain->rows[rows[place]];
                const uint32_t edges = row.edges & (t->kind.isolated ? 9u : 15u);
                t->tables[(table * REGULAR + slot) * stride + place] =
                    coefficient(table, row, edges, slot_place(slot, 1, 2));
            }
        }
    }
}

/// The column of each slot in each piece, as seen from its corner.
static inline void make_columns(uint16_t columns[LIMN_FORMAT_PIECE_COUNT * (1 + ISOLATED)]) {
    for (uint32_t p = 0; p < 4; p++) {
        columns[p] = 0; // all four are the same
        uint16_t *const of_piece = columns + 4 + p * ISOLATED;
        for (uint32_t slot = 0; slot < ISOLATED; slot++)
            of_piece[slot] = LIMN_FORMAT_NO_COLUMN;
        for (uint16_t column = 0; column < REGULAR; column++) {
            const grid_point at = in_grid(0, 0, p, 2, slot_place(column, 1, 2));
            for (uint32_t slot = 0; slot < ISOLATED; slot++) {
                const grid_point own = slot_place(slot, 2, 3);
                if (own.u == at.u && own.v == at.v) of_piece[slot] = column;
            }
        }
    }
}

// ---- Patches

static inline void make_patch(quad_torus *t, uint32_t face) {
    const uint32_t u = face % t->size, v = face / t->size, rotation = (face * 7 + v) % 4;
    const uint32_t count = t->kind.isolated ? ISOLATED : REGULAR;
    uint32_t *const indices = t->indices + face * count;
    uint8_t *const slots = t->slots + face * count;
    t->faces[face] = face << 2 | rotation;
    for (uint32_t slot = 0; slot < count; slot++) {
        const grid_point p = t->kind.isolated ? slot_place(slot, 2, 3) : slot_place(slot, 1, 2);
        indices[slot] = t->kind.isolated ? fine_at(t, in_grid(u, v, rotation, 2, p))
                                         : base_at(t, in_grid(u, v, rotation, 1, p));
        uint32_t at = slot;
        for (; at > 0 && indices[slots[at - 1]] > indices[slot]; at--)
            slots[at] = slots[at - 1];
        slots[at] = (uint8_t)slot;
    }
}

/// Rings of eight, from (u + 1, v) on; all have the same masks.
static inline void make_normal(quad_torus *t, uint32_t base) {
    static const grid_point around[8] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                         {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    const int u = (int)(base % t->size), v = (int)(base / t->size);
    t->normals[base] = (limn_file_normal){.first_ring = 8 * base, .ring_count = 8};
    for (uint32_t k = 0; k < 8; k++)
        t->ring[8 * base + k] = base_at(t, (grid_point){u + around[k].u, v + around[k].v});
}

static const float ring_weights[2][8] = {{4, 1, 0, -1, -4, -1, 0, 1}, {0, 1, 4, 1, 0, -1, -4, -1}};

// ---- The file

typedef struct quad_chunk {
    uint32_t kind, mesh;
    const void *data;
    size_t size;
} quad_chunk;

static inline int compare_chunks(const void *a, const void *b) {
    const quad_chunk *const left = a, *const right = b;
    if (left->mesh != right->mesh) return left->mesh + 1 < right->mesh + 1 ? -1 : 1;
    return (left->kind > right->kind) - (left->kind < right->kind);
}

static inline blob write_chunks(quad_chunk *chunks, uint32_t count) {
    enum { ALIGN = LIMN_FORMAT_ALIGNMENT };
    qsort(chunks, count, sizeof *chunks, compare_chunks);
    size_t size = sizeof(limn_file_header) + count * sizeof(limn_file_chunk);
    for (uint32_t c = 0; c < count; c++)
        size = (size + ALIGN - 1) / ALIGN * ALIGN + chunks[c].size;
    const blob file = make_blob(size);
    memset(file.bytes, 0, size);
    *header_of(&file) = (limn_file_header){.magic = {'L', 'I', 'M', 'N'},
                                           .version = LIMN_FORMAT_VERSION,
                                           .size = size,
                                           .chunk_count = count,
                                           .mesh_count = 1,
                                           .class_count = 1};
    size = sizeof(limn_file_header) + count * sizeof(limn_file_chunk);
    for (uint32_t c = 0; c < count; c++) {
        size = (size + ALIGN - 1) / ALIGN * ALIGN;
        directory_of(&file)[c] = (limn_file_chunk){.kind = chunks[c].kind,
                                                   .mesh = chunks[c].mesh,
                                                   .flags = LIMN_CHUNK_REQUIRED,
                                                   .offset = size,
                                                   .size = chunks[c].size};
        memcpy(file.bytes + size, chunks[c].data, chunks[c].size);
        size += chunks[c].size;
    }
    fix_checksum(&file);
    return file;
}

/// patch_count  of the faces, the first; the others are holes
static inline blob make_quads(quad_torus *t, quad_kind kind, uint32_t patch_count) {
    memset(t, 0, sizeof *t);
    t->kind = kind;
    make_points(t);
    make_tables(t);
    const uint32_t face_count = t->size * t->size, count = kind.isolated ? ISOLATED : REGULAR;
    if (patch_count > face_count) patch_count = face_count;
    for (uint32_t face = 0; face < face_count; face++) {
        make_patch(t, face);
        make_normal(t, face);
    }
    const uint32_t stride = kind.isolated ? PIECE_STRIDE : STRIDE;
    const limn_file_class class = {.control_count = count,
                                   .domain = LIMN_DOMAIN_QUAD,
                                   .depth =
                                       kind.isolated ? LIMN_FORMAT_PIECE_DEPTH : LIMN_FORMAT_DEPTH,
                                   .valences = {4, 4, 4, 4},
                                   .table_count = 3};
    const limn_file_piece piece = {
        .control_count = REGULAR, .domain = LIMN_DOMAIN_QUAD, .table_count = 3};
    uint16_t columns[LIMN_FORMAT_PIECE_COUNT * (1 + ISOLATED)];
    make_columns(columns);
    const limn_file_run run = {.patch_count = patch_count};
    static uint16_t errors[PATCHES_MAX][4];
    for (uint32_t e = 0; e < 4 * PATCHES_MAX; e++)
        errors[e / 4][e % 4] = 0x24c0; // 1/16 of the length, falling 4 times a level
    const limn_file_mesh mesh = {.control_count = SIZE * SIZE,
                                 .patch_count = patch_count,
                                 .run_count = 1,
                                 .domain = LIMN_DOMAIN_QUAD,
                                 .index_count = patch_count * count,
                                 .bounds_min = {-4, -4, -2},
                                 .bounds_max = {4, 4, 2},
                                 .hole_count = face_count - patch_count,
                                 .point_count = t->point_count,
                                 .divided_count = kind.divided ? face_count : 0};
    const uint32_t file = LIMN_FORMAT_NO_MESH, extra = t->point_count - SIZE * SIZE;
    quad_chunk chunks[] = {
        {LIMN_CHUNK_INFO, file, "by=test", 8},
        {LIMN_CHUNK_CLASSES, file, &class, sizeof class},
        {LIMN_CHUNK_TABLES, file, t->tables, 3 * REGULAR * stride * sizeof(float)},
        {LIMN_CHUNK_MESH, 0, &mesh, sizeof mesh},
        {LIMN_CHUNK_NAME, 0, "torus", 6},
        {LIMN_CHUNK_CONTROLS, 0, t->points, t->point_count * sizeof t->points[0]},
        {LIMN_CHUNK_RUNS, 0, &run, sizeof run},
        {LIMN_CHUNK_FACES, 0, t->faces, patch_count * sizeof t->faces[0]},
        {LIMN_CHUNK_INDICES, 0, t->indices, patch_count * count * sizeof t->indices[0]},
        {LIMN_CHUNK_SLOTS, 0, t->slots, patch_count * count},
        {LIMN_CHUNK_ERRORS, 0, errors, patch_count * sizeof errors[0]},
        {LIMN_CHUNK_NORMALS, 0, t->normals, face_count * sizeof t->normals[0]},
        {LIMN_CHUNK_RINGS, 0, t->ring, 8 * face_count * sizeof t->ring[0]},
        {LIMN_CHUNK_WEIGHTS, 0, ring_weights, sizeof ring_weights},
        {LIMN_CHUNK_STENCILS, 0, t->stencils, (extra + 1) * sizeof t->stencils[0]},
        {LIMN_CHUNK_TERMS, 0, t->terms, t->term_count * sizeof t->terms[0]},
        {LIMN_CHUNK_PIECES, file, &piece, sizeof piece},
        {LIMN_CHUNK_COLUMNS, file, columns, sizeof columns},
    };
    return write_chunks(chunks, COUNT(chunks) - (kind.isolated ? 0 : extra ? 2 : 4));
}

#endif
