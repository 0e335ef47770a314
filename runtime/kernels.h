/* SPDX-License-Identifier: MIT */
/*
 * One table of kernels per instruction set. To add an instruction set: a lanes_<isa>.h, a
 * kernels_<isa>.c and a line in kernels.c and in simd/CMakeLists.txt. To add a kernel: a body and a
 * field.
 */
#ifndef LIMNI_KERNELS_H
#define LIMNI_KERNELS_H

#include "domain.h"
#include "limn/format.h"
#include "limn/limn.h"
#include "rounding.h"

/// LIMNI_INLINE: where a constant argument decides what a function is.
#if defined(__GNUC__)
#define LIMNI_NOINLINE __attribute__((noinline))
#define LIMNI_INLINE inline __attribute__((always_inline))
#else
#define LIMNI_NOINLINE
#define LIMNI_INLINE inline
#endif

/// Before a loop over the vectors of a tile: unrolled early, so that its arrays become registers.
#if defined(__GNUC__) && !defined(__clang__)
#define LIMNI_UNROLL _Pragma("GCC unroll 8")
#define LIMNI_UNROLL_TWICE _Pragma("GCC unroll 2")
#else
#define LIMNI_UNROLL
#define LIMNI_UNROLL_TWICE
#endif

/// The largest padded row count of any domain.
#define LIMNI_PADDED_ROWS_MAX 296

/// A row with more terms than this is summed with compensation. Both patches that share a row see
/// the same terms, so they agree on how to sum it.
#define LIMNI_PLAIN_TERMS 24
LIMN_STATIC_ASSERT(LIMNI_PLAIN_TERMS == LIMN_FORMAT_PAIRED_MAX, "pairs are summed plainly");

/// Consecutive patches of one class.
typedef struct limni_run {
    const float *table;      ///< of positions: [control_count][row_stride], columns aligned to 32
                             ///< bytes; behind it, perhaps, the two of tangents
    const uint32_t *indices; ///< [patch_count][control_count], by slot
    const void *slots; ///< the same shape, slot_size bytes each: in ascending order of the indices
    const limni_pieces *pieces;     ///< the class is in pieces, whose tables count from `table`;
                                    ///< NULL: it has a table
    const uint16_t *parts;          ///< which pieces, and their columns: see LIMN_CHUNK_COLUMNS
    const limn_file_piece *records; ///< that `parts` refers to
    const limni_layout *layout;     ///< of positions
    const limni_layout *tangent_layout; ///< with the same stride
    uint32_t control_count;
    uint32_t pair_count;   ///< mirrored control points: slots 1 and 2, 3 and 4, …; 0: no symmetry
    size_t table_stride;   ///< floats from table to table
    uint32_t slot_size;    ///< 1 or 2
    uint32_t first_corner; ///< see limni_first_corner()
    const uint32_t *corner_normals; ///< [patch_count][corner_count]; NULL: the base vertices
    uint32_t patch_count;
    const limn_plan_patch
        *items;           ///< [patch_count] what is wanted of which patches, from one class;
                          ///< NULL: consecutive patches at the level of the target
    uint32_t first_patch; ///< of the class, where there are items
} limni_run;

/// One piece of the patches of a run.
typedef struct limni_piece {
    const float *table;      ///< as for a run
    const uint16_t *columns; ///< [control_count of the run] or LIMN_FORMAT_NO_COLUMN
    const limni_piece_layout *positions, *tangents; ///< with the same stride
    size_t table_stride;                            ///< floats from table to table
    uint16_t first_place;                           ///< among those of all pieces
} limni_piece;

static inline limni_piece limni_piece_of(const limni_run *run, uint32_t p) {
    const limn_file_piece *const record = &run->records[run->parts[p]];
    const limni_pieces *const pieces = run->pieces;
    return (limni_piece){
        .table = run->table + record->table_offset / sizeof(float),
        .columns = run->parts + LIMN_FORMAT_PIECE_COUNT + (size_t)p * run->control_count,
        .positions = &pieces->positions[record->kind],
        .tangents = &pieces->tangents[record->kind],
        .table_stride = (size_t)record->control_count * limn_file_piece_stride(record),
        .first_place = (uint16_t)(p * pieces->positions[LIMNI_PIECE_CORNER].row_stride),
    };
}

/// Where control points come from.
typedef struct limni_points {
    const float *controls; ///< [][3]
    const float *origin;   ///< [3] subtracted from every control point, and added to every row
    const float *normals;  ///< [][3] see limn_mesh_control_normals(); NULL: neither normals nor
                           ///< light
} limni_points;

/// How the rows of a run are written: positions, or the values of a channel.
typedef enum limni_format {
    LIMNI_FLOAT3,
    LIMNI_UNORM16X4,
    LIMNI_FLOAT2,
    LIMNI_HALF2,
    LIMNI_UNORM16X2,
    LIMNI_RGBA8
} limni_format;

/// Words of 4 bytes.
static inline uint32_t limni_format_words(limni_format format) {
    switch (format) {
    case LIMNI_FLOAT3:
        return 3;
    case LIMNI_UNORM16X4:
    case LIMNI_FLOAT2:
        return 2;
    default:
        return 1;
    }
}

/// Where the vertices of a run go, one patch behind the other.
typedef struct limni_target {
    unsigned char *vertices; ///< aligned to 4 bytes
    size_t stride;           ///< bytes from vertex to vertex
    unsigned char *normals;  ///< the same for normals; NULL: none are written
    size_t normal_stride;
    limni_format format;
    unsigned char *colours; ///< the same for colours; NULL: none are written
    size_t colour_stride;
    const limn_lighting *lighting; ///< NULL: there are no colours
    const limni_grid *grid;        ///< of the domain
    bool tangents;                 ///< all rows need a normal, to write it or to light them
    limn_normal_format normal_format;
    float box_min[3], box_scale[3]; ///< packed positions and values are (position - min) * scale
    bool streaming;
    uint32_t level; ///< of patches without items
    const limn_domain *domain;
} limni_target;

/// A base vertex and the points around it, with the masks of its two limit tangents.
typedef struct limni_ring {
    uint32_t point, count;
    const uint32_t *points; ///< [count]
    const float *weights;   ///< [2][count], which apply relative to the base vertex
} limni_ring;

/// The point that a normal stands at.
static inline uint32_t limni_point_of(const limn_mesh *mesh, uint32_t normal) {
    return normal < mesh->base_count ? mesh->base_first + normal
                                     : mesh->sides[normal - mesh->base_count].point;
}

static inline limni_ring limni_ring_of(const limn_mesh *mesh, uint32_t normal) {
    const limn_file_side *const side =
        normal < mesh->base_count ? NULL : &mesh->sides[normal - mesh->base_count];
    const limn_file_normal *const record = side ? &side->normal : &mesh->normals[normal];
    return (limni_ring){.point = limni_point_of(mesh, normal),
                        .count = record->ring_count,
                        .points = mesh->ring + record->first_ring,
                        .weights = mesh->weights + record->first_weight};
}

struct limn_kernels {
    const char *name;
    uint32_t isa;
    limn_family family;
    void (*evaluate)(const limni_run *run, const limni_points *points, const limni_target *target);
    /// Vertices [begin, end) of a base mesh; those of the target begin with vertex 0.
    void (*evaluate_base)(const limn_base *base, const limni_points *points, uint32_t begin,
                          uint32_t end, const limni_target *target);
    /// See limn_mesh_refine().
    void (*refine)(const limn_mesh *mesh, float *controls);
    /// See limn_mesh_control_normals().
    void (*control_normals)(const limn_mesh *mesh, const float *controls, float *normals);
    /// See limn_pose_points(), and where there is a mesh, limn_pose_normals().
    void (*skin)(const limn_pose *pose, const limn_mesh *mesh, const float *src, uint32_t begin,
                 uint32_t end, float *dst);
};

/// Those that are built are listed in kernels.c.
extern const limn_kernels limni_kernels_scalar;
extern const limn_kernels limni_kernels_sse2;
extern const limn_kernels limni_kernels_avx2, limni_kernels_avx2_fast;
extern const limn_kernels limni_kernels_neon, limni_kernels_neon_fast;

#endif
