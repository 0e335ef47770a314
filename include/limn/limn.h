/* SPDX-License-Identifier: MIT */
/*
 * Limn draws smooth subdivision surfaces: it multiplies the stencil tables of a baked .limn file
 * with the current control points and writes triangle vertices. The runtime never allocates,
 * prints, or keeps state between calls; every buffer is the caller's. A complete use, with `blob`
 * the mapped file:
 *
 *     limn_pack pack;
 *     limn_result result = limn_pack_open(&pack, blob, blob_size);
 *     if (result != LIMN_OK) return fail(limn_result_text(result));
 *     limn_mesh mesh = limn_pack_mesh(&pack, 0);
 *     limn_plan plan = limn_plan_uniform(&mesh, 3);
 *     float *vertices = malloc(plan.vertex_count * 3 * sizeof(float));
 *     limn_output output = {.vertices = vertices};
 *     limn_evaluate(&plan, mesh.controls, 0, plan.patch_count, &output);
 *
 * and drawn, patch by patch, with the static indices mesh.domain->indices[3] and base vertex
 * limn_plan_first_vertex().
 *
 * Words: a *control point* is a vertex of the mesh that was baked; a *base vertex* is one whose
 * faces the patches draw: a control point, but where the mesh had to be divided first; a *patch* is
 * what is drawn for one base face; a *row* is one vertex of a patch's grid. "Never fails" means:
 * given valid arguments there is no error to report. A caller's mistake aborts in debug builds of
 * the library, and in others returns without doing anything; whoever compiles it with
 * LIMN_ASSERT(condition) defined decides what happens before.
 */
#ifndef LIMN_H
#define LIMN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Version of these headers.
#define LIMN_VERSION_MAJOR 0
#define LIMN_VERSION_MINOR 1 ///< see LIMN_VERSION_MAJOR
#define LIMN_VERSION_PATCH 0 ///< see LIMN_VERSION_MAJOR

/// Version of the library that is linked: major << 16 | minor << 8 | patch.
uint32_t limn_version(void);

// -------------------------------------------------------------------------------------------------
// Results

/// Why a blob, or what animates a mesh, was refused: name, then what happened and what to do.
#define LIMN_RESULTS(X)                                                                            \
    X(LIMN_OK, "no error")                                                                         \
    X(LIMN_ERROR_HOST, "this machine is not little-endian; .limn files are")                       \
    X(LIMN_ERROR_ALIGNMENT,                                                                        \
      "the blob does not start on a multiple of 64 bytes; map the file or use aligned_alloc")      \
    X(LIMN_ERROR_TRUNCATED, "the blob is shorter than the file was; load all of it")               \
    X(LIMN_ERROR_MAGIC, "the blob is not a .limn file")                                            \
    X(LIMN_ERROR_VERSION,                                                                          \
      "the file has a format version that is not read; bake it again with this version's baker")   \
    X(LIMN_ERROR_SIZE, "the blob is longer than the file says; pass the exact size")               \
    X(LIMN_ERROR_CHECKSUM, "the file is damaged: its checksum does not match")                     \
    X(LIMN_ERROR_CHUNK, "a chunk is missing, repeated, misaligned or reaches outside the file")    \
    X(LIMN_ERROR_UNKNOWN_CHUNK, "the file needs a feature that this version does not have")        \
    X(LIMN_ERROR_TEXT, "a name or the bake description is not zero-terminated")                    \
    X(LIMN_ERROR_CLASS,                                                                            \
      "a class has an unknown domain, depth, symmetry or bound, or its table lies outside")        \
    X(LIMN_ERROR_TABLE, "a stencil table holds a coefficient that is not finite")                  \
    X(LIMN_ERROR_MESH, "a mesh's counts disagree with the sizes of its chunks")                    \
    X(LIMN_ERROR_CONTROLS, "a control point of the bind pose is not finite")                       \
    X(LIMN_ERROR_RUN, "the runs of a mesh do not cover its patches one after the other")           \
    X(LIMN_ERROR_FACE, "a patch names a face or a rotation that does not exist")                   \
    X(LIMN_ERROR_INDEX,                                                                            \
      "a patch's control indices are out of range, or its slots do not order them")                \
    X(LIMN_ERROR_SLOT, "a patch's slot lies outside its class")                                    \
    X(LIMN_ERROR_PIECE,                                                                            \
      "a piece of a class is of an unknown kind, or lies outside the tables or its class")         \
    X(LIMN_ERROR_STENCIL, "the stencils of points are out of range, not finite or incomplete")     \
    X(LIMN_ERROR_NORMALS, "the data for normals are out of range, not finite or incomplete")       \
    X(LIMN_ERROR_CHANNEL, "a channel does not fit its mesh, or is of an unknown kind")             \
    X(LIMN_ERROR_SKIN, "a skin has no joints, or not 1 to 8 influences for each point")            \
    X(LIMN_ERROR_JOINT, "an influence on a point names a joint that does not exist")               \
    X(LIMN_ERROR_WEIGHT, "the weight of an influence is negative or not finite")                   \
    X(LIMN_ERROR_WEIGHT_SUM,                                                                       \
      "the weights of a point do not sum to 1; limn_skin_normalise() mends that unless all are 0") \
    X(LIMN_ERROR_MORPH_POINT, "the points of a morph target are out of range or do not ascend")    \
    X(LIMN_ERROR_MORPH_DELTA, "a movement of a morph target is not finite")                        \
    X(LIMN_ERROR_SKELETON, "the joints are not in order, too deep, or not finite")                 \
    X(LIMN_ERROR_CLIP,                                                                             \
      "the tracks of a clip are not in order, not finite, or move what does not exist")            \
    X(LIMN_ERROR_MATERIAL,                                                                         \
      "a material or an image is out of range, or ranges do not cover the patches of a mesh")      \
    X(LIMN_ERROR_LIGHT,                                                                            \
      "a light is of an unknown kind or not finite, its direction is no unit vector, or its "      \
      "attenuation, range or cone is negative or turned around")

/// Why something was refused: one of LIMN_RESULTS.
typedef enum limn_result {
#define LIMN_RESULT_NAME(name, text) name,
    LIMN_RESULTS(LIMN_RESULT_NAME)
#undef LIMN_RESULT_NAME
} limn_result;

/// One sentence: what happened and what to do. Static storage; never NULL, whatever `result` is.
const char *limn_result_text(limn_result result);

// -------------------------------------------------------------------------------------------------
// Domains

#define LIMN_LEVEL_COUNT 5 ///< levels 0 to 4
#define LIMN_LEVEL_MAX 4   ///< the finest
#define LIMN_CORNER_MAX 4  ///< corners of any domain
#define LIMN_GRID_SIZE 16  ///< grid steps along a patch edge at LIMN_LEVEL_MAX

/// What a patch is, and where in it a row (i, j) is.
typedef enum limn_domain_kind {
    LIMN_DOMAIN_TRIANGLE, ///< v0 + i/16 (v1 - v0) + j/16 (v2 - v0), i + j <= 16
    LIMN_DOMAIN_QUAD,     ///< with u = i/16, v = j/16: (1 - u) (1 - v) v0 + u (1 - v) v1 + u v v2 +
                          ///< (1 - u) v v3; cells are cut from (i, j) to (i + 1, j + 1)
    LIMN_DOMAIN_COUNT
} limn_domain_kind;

/// One vertex of a patch's grid.
typedef struct limn_row {
    uint8_t i, j;        ///< grid coordinates, 0 to LIMN_GRID_SIZE
    uint8_t level;       ///< the first level that has this row
    uint8_t edges;       ///< bit e: the row lies on edge e, from corner e to corner e + 1
    uint16_t parents[2]; ///< the rows of the level before between which it appears; itself, twice,
                         ///< at level 0
    uint16_t sources[2]; ///< in whose middle it is drawn as its level begins: its parents; on an
                         ///< edge, from level 2 on, twice its elder: the parent of the lower level
    uint16_t mirror;     ///< the row at (j, i)
} limn_row;

/// The rows of one edge along its direction.
typedef uint16_t limn_edge_rows[LIMN_GRID_SIZE + 1];

/// The parametric shape of a patch. Rows are nested: the rows of level n are the first
/// row_counts[n] of the finest, and the very first are the corners. Everything here is static and
/// depends on nothing but the shape.
typedef struct limn_domain {
    limn_domain_kind kind;
    uint32_t corner_count; ///< corners, and edges; edge e runs from corner e to e + 1
    uint16_t row_counts[LIMN_LEVEL_COUNT];     ///< vertices of a patch
    uint16_t index_counts[LIMN_LEVEL_COUNT];   ///< three per triangle
    const uint16_t *indices[LIMN_LEVEL_COUNT]; ///< counter-clockwise triangles of a patch
    const limn_row *rows;                      ///< [row_counts[LIMN_LEVEL_MAX]]
    const limn_edge_rows *edge_rows;           ///< [corner_count]
} limn_domain;

/// The domain of a kind. Never fails; any thread.
const limn_domain *limn_domain_get(limn_domain_kind kind);

// -------------------------------------------------------------------------------------------------
// Templates
//
// A patch whose edges are coarser than itself is sewn to its neighbours by its indices alone: there
// is a template for every level of a patch and of each of its edges, whatever the difference.
// Templates depend on the domain only; upload them once.

/// How triangles are listed.
typedef enum limn_topology {
    LIMN_TOPOLOGY_TRIANGLES,
    LIMN_TOPOLOGY_STRIPS ///< triangle strips, with LIMN_RESTART between them
} limn_topology;

#define LIMN_RESTART 0xffffu         ///< primitive restart; 0xff where indices are bytes
#define LIMN_TEMPLATE_INDEX_MAX 2048 ///< indices of any template
#define LIMN_EXPANDED_STRIP_MAX 574  ///< rows of limn_expanded_strip()

/// Where the indices of a template are among those of all.
typedef struct limn_template {
    uint32_t first_index, index_count;
} limn_template;

/// How many templates there are: 225 for triangles, 979 for quads. Never fails; any thread.
uint32_t limn_template_count(const limn_domain *domain);

/// The template of a patch of level `level` <= LIMN_LEVEL_MAX. Never fails; any thread.
///
/// edge_levels  [domain->corner_count], each at most `level`; edge e runs from corner e to e + 1
uint32_t limn_template_find(const limn_domain *domain, uint32_t level,
                            const uint8_t edge_levels[LIMN_CORNER_MAX]);

/// Writes the indices of one template: rows of the patch, counter-clockwise triangles of which none
/// is degenerate, and on each edge no rows but those of the edge's level. Does not allocate, never
/// fails; any thread. Returns the number of indices.
uint32_t limn_template_write(const limn_domain *domain, uint32_t index, limn_topology topology,
                             uint16_t indices[LIMN_TEMPLATE_INDEX_MAX]);

/// Writes all templates, one behind the other, in milliseconds. Does not allocate, never fails; any
/// thread. Returns the number of indices: with NULL, how many there must be room for; 0, and nothing
/// is written, where they do not fit their size.
///
/// index_size  bytes of an index, 2; or 1, where rows are fewer than 255: of triangles
/// indices     out, or NULL
/// templates   out: [limn_template_count()], or NULL
uint32_t limn_templates_write(const limn_domain *domain, limn_topology topology,
                              uint32_t index_size, void *indices, limn_template *templates);

/// The rows of a whole patch in the order of one strip without indices, for hardware that has none:
/// row of cells by row of cells, from right to left (Brickhill), joined by degenerate triangles.
/// Does not allocate, never fails; any thread. Returns the number of rows.
///
/// rows  out: [LIMN_EXPANDED_STRIP_MAX]
uint32_t limn_expanded_strip(const limn_domain *domain, uint32_t level, uint16_t *rows);

// -------------------------------------------------------------------------------------------------
// Kernels

/// Instruction sets, as bits of a mask.
typedef enum limn_isa {
    LIMN_ISA_SCALAR = 1 << 0, ///< always there
    LIMN_ISA_SSE2 = 1 << 1,
    LIMN_ISA_AVX2 = 1 << 2,
    LIMN_ISA_NEON = 1 << 3, ///< AArch64
    LIMN_ISA_ALL = 0x7fffffff
} limn_isa;

/// How kernels round. With both, vertices that neighbouring patches share get the same bits.
typedef enum limn_family {
    LIMN_FAMILY_REPRODUCIBLE, ///< every product and every sum is rounded: the same bits on every
                              ///< instruction set, compiler and optimisation level
    LIMN_FAMILY_FAST          ///< fused multiply-add where the CPU has it: other bits than without
} limn_family;

/// The kernels of one instruction set and family: opaque and static.
typedef struct limn_kernels limn_kernels;

/// The instruction sets that this library was built with and this CPU has. Never fails; any thread.
uint32_t limn_isa_supported(void);

/// The best supported kernels among the instruction sets in `isa_mask`; scalar ones if there is no
/// other. Where an instruction set has no fused multiply-add, its fast kernels are its reproducible
/// ones. Asks the CPU each time: keep the pointer. Never fails; any thread.
const limn_kernels *limn_kernels_select(uint32_t isa_mask, limn_family family);

/// "scalar", "sse2", "avx2" or "neon".
const char *limn_kernels_name(const limn_kernels *kernels);
/// The family of kernels: the reproducible one also where a fast one was asked for and there is none.
limn_family limn_kernels_family(const limn_kernels *kernels);

// -------------------------------------------------------------------------------------------------
// Packs and meshes

/// A view of one .limn file: stencil tables and the meshes that share them. Plain data; copy it
/// freely. It is valid for as long as the blob is, and never writes to it.
typedef struct limn_pack {
    const void *blob;
    size_t blob_size;
    const char *info; ///< how the file was baked, as words `key=value`
    uint32_t mesh_count;
    uint32_t class_count;
    const struct limn_file_class *classes; ///< [class_count], see format.h
    const struct limn_file_piece *pieces;  ///< [piece_count] that classes are made of
    uint32_t piece_count;
    const limn_kernels *kernels; ///< the best reproducible ones; replace them to use others
} limn_pack;

/// What the values of a channel are.
typedef enum limn_channel_kind {
    LIMN_CHANNEL_UV,    ///< texture coordinates
    LIMN_CHANNEL_COLOUR ///< red, green and blue, from 0 to 1
} limn_channel_kind;

/// A view of one mesh of a pack. Plain data; copy it freely.
typedef struct limn_mesh {
    const char *name;
    const limn_domain *domain;
    const float *controls; ///< [point_count][3]: the bind pose, model units
    uint32_t control_count;
    uint32_t point_count; ///< control_count or more: what else patches are made of follows, see
                          ///< limn_mesh_refine()
    uint32_t base_first;  ///< the base vertices are points [base_first, base_first + base_count):
    uint32_t base_count;  ///< 0 and control_count, but where a mesh has been divided
    uint32_t patch_count; ///< one per base face that is drawn
    uint32_t face_count;  ///< base faces, with the holes, which are not drawn
    uint32_t run_count;   ///< patches are ordered by material and class: runs of one class each
    float bounds_min[3];  ///< of the control points that faces use, in the bind pose
    float bounds_max[3];
    float origin[3]; ///< sums are taken relative to this point and it is added last, so that
                     ///< precision does not suffer far from 0; baked as 0, or the middle of bounds
                     ///< that do not contain 0; may be replaced, by the same value for all patches
    const uint32_t *faces; ///< [patch_count]: read with limn_mesh_face()
    const uint32_t *indices;
    const uint8_t *slots;
    const uint16_t *errors; ///< [patch_count][corner_count] of edges, see docs/format.md
    const uint8_t *creases; ///< [patch_count], bit e: edge e is a sharp crease, where the patches
                            ///< have the same positions, but normals of their own; NULL: none is
    const float *tables;
    const struct limn_file_run *runs;
    const struct limn_file_class *classes;
    const struct limn_file_piece *pieces;
    const uint16_t *columns;                ///< of the slots of classes in their pieces
    const uint32_t *stencils;               ///< [point_count - control_count + 1] into the terms
    const struct limn_file_term *terms;     ///< of the points that are no control points
    const struct limn_file_normal *normals; ///< NULL: the mesh was baked without normals
    const struct limn_file_side *sides;     ///< [normal_count - base_count]
    const uint32_t *corner_normals; ///< [patch_count][corner_count] the normals of the corners;
                                    ///< NULL: those of the base vertices
    uint32_t first_channel, channel_count; ///< see limn_mesh_channel()
    uint32_t normal_count; ///< of limn_mesh_control_normals(): one per base vertex, and more on
                           ///< creases; 0 without normals
    const uint32_t *ring;
    const float *weights;
    const limn_kernels *kernels;
} limn_mesh;

/// Opens a .limn file in memory and validates all of it, so that nothing needs to be checked later.
/// Safe on untrusted bytes, as long as they do not change while the view is used. Does not
/// allocate; takes time linear in blob_size; any thread.
///
/// pack       out: the view; untouched unless the result is LIMN_OK
/// blob       [blob_size] bytes, starting on a multiple of 64; must outlive the view
/// blob_size  the exact size of the file
limn_result limn_pack_open(limn_pack *pack, const void *blob, size_t blob_size);

/// The view of mesh `mesh_index` < pack->mesh_count. Does not allocate; never fails; any thread.
limn_mesh limn_pack_mesh(const limn_pack *pack, uint32_t mesh_index);

/// A channel of a mesh: texture coordinates or colours. `mesh` has values in the place of control
/// points, those of a vertex on a seam as many as it has, and the patches of the mesh in the same
/// order and frame: patch p draws the same face, and row r is the same vertex. Plain data.
typedef struct limn_channel {
    limn_channel_kind kind;
    uint32_t component_count; ///< 1 to 3; further components are 0
    uint32_t face_varying;    ///< how it was interpolated, for information: see bake.h
    limn_mesh mesh;           ///< its name is that of the channel
} limn_channel;

/// The view of channel `channel_index` < mesh->channel_count of a mesh of the pack. Does not
/// allocate; never fails; any thread.
limn_channel limn_mesh_channel(const limn_pack *pack, const limn_mesh *mesh,
                               uint32_t channel_index);

/// The base face that a patch draws.
typedef struct limn_patch_face {
    uint32_t face; ///< index of the face in the triangulated source mesh, < mesh->face_count
    uint32_t
        rotation; ///< corner c of the patch is corner (c + rotation) mod corner_count of the face
} limn_patch_face;

/// The base face of patch `patch_index` < mesh->patch_count. Never fails; any thread.
limn_patch_face limn_mesh_face(const limn_mesh *mesh, uint32_t patch_index);

/// The base vertices at the corners of patch `patch_index` < mesh->patch_count, in the order of the
/// patch's corners, rows 0, 1, …: where each of them has its limit. As indices of points: from
/// mesh->base_first on. Never fails; any thread.
///
/// corners  out: [domain->corner_count], the rest is left alone
void limn_mesh_corners(const limn_mesh *mesh, uint32_t patch_index,
                       uint32_t corners[LIMN_CORNER_MAX]);

// -------------------------------------------------------------------------------------------------
// Animation
//
// What moves control points before a frame is planned: morph targets, then a skin. Each may be
// shared by threads that take ranges. limn_mesh_refine() and limn_mesh_control_normals() come
// after them. The same input gives the same bits with every kernel of either family, so control
// points with the same data, such as those of sheets, stay together in every bit.

#define LIMN_INFLUENCE_MAX 8 ///< joints that move one point

/// Which joints move the points of a mesh, and how much. The caller's, wherever it comes from:
/// limn_skin_check() tells whether it is right, and nothing later does. An influence that is not
/// needed has weight 0, and any joint.
typedef struct limn_skin {
    uint32_t point_count;     ///< the control_count of the mesh
    uint32_t joint_count;     ///< from 1
    uint32_t influence_count; ///< on each point, 1 to LIMN_INFLUENCE_MAX
    const uint16_t *joints;   ///< [point_count][influence_count] below joint_count
    const float *weights;     ///< [point_count][influence_count] not negative; those of a point sum
                              ///< to 1
    const limn_kernels *kernels; ///< those of the mesh, or from limn_kernels_select()
} limn_skin;

/// A place in a skin.
typedef struct limn_skin_place {
    uint32_t point;
    uint32_t influence; ///< on the point; 0 where it is about all of them
} limn_skin_place;

/// Makes the weights of each point sum to 1, and orders its influences: the strongest first, of
/// equal ones that of the lower joint, and last those without weight, whose joint becomes that of
/// the first. Does not allocate; any thread. A point that is refused is left as it is, and so are
/// those behind it:
/// LIMN_ERROR_WEIGHT, or LIMN_ERROR_WEIGHT_SUM where all weights are 0.
///
/// influence_count  on each point, 1 to LIMN_INFLUENCE_MAX
/// joints, weights  [point_count][influence_count]
/// place            out: the first that is refused, if any is; or NULL
limn_result limn_skin_normalise(uint32_t point_count, uint32_t influence_count, uint16_t *joints,
                                float *weights, limn_skin_place *place);

/// Whether a skin can be used: LIMN_ERROR_SKIN, LIMN_ERROR_JOINT, LIMN_ERROR_WEIGHT, or
/// LIMN_ERROR_WEIGHT_SUM where the weights of a point are more than 1e-6 off 1. Its kernels are not
/// looked at. Safe on untrusted arrays of the right size. Does not allocate; any thread.
///
/// place  out: the first that is refused, if any is; or NULL
limn_result limn_skin_check(const limn_skin *skin, limn_skin_place *place);

/// The matrix of a joint as what it does to a point: first it stretches it, then it turns and moves
/// it, by the unit dual quaternion real + e dual.
typedef struct limn_dual_quaternion {
    float real[4], dual[4]; ///< x, y, z, w
    float stretch[3][4];    ///< rows, of which the last column is 0
} limn_dual_quaternion;

/// Takes matrices apart, in some 0.2 microseconds each: the rotation is the nearest one, and the
/// stretch has what is left, so nothing is lost. That of a matrix that mirrors does so, too; one
/// that flattens may have no rotation. Does not allocate, never fails; any thread.
///
/// matrices     [joint_count][3][4] as in a pose
/// quaternions  out: [joint_count]
void limn_dual_quaternions_make(const float *matrices, uint32_t joint_count,
                                limn_dual_quaternion *quaternions);

/// A skin in one frame. Matrices take points from the bind pose to where they are now: for each
/// joint, where it is times the inverse of where it is in the bind pose. They are the caller's: one
/// that is not finite makes all points that name its joint not finite, and no others.
typedef struct limn_pose {
    const limn_skin *skin;
    /// [joint_count][3][4] rows: x' = m[0][0] x + m[0][1] y + m[0][2] z + m[0][3]. Linear blending:
    /// each point is moved by the weighted sum of the matrices. Not read where there are dual
    /// quaternions.
    const float *matrices;
    /// [joint_count], or NULL: linear blending. Each point is stretched by the weighted sum of the
    /// stretches, then turned and moved by that of the dual quaternions, made a unit one; each with
    /// the sign that brings it closest to that of the first influence. So bodies keep their volume
    /// where they twist.
    const limn_dual_quaternion *dual_quaternions;
} limn_pose;

/// Moves points [begin, end). Does not allocate, never fails; any number of threads may take
/// disjoint ranges.
///
/// points      [skin->point_count][3] floats, model units: the bind pose, or with morph targets
/// begin, end  0 <= begin <= end <= skin->point_count
/// out         the same shape, of which the range is written; may be `points`, and must not overlap
///             them otherwise. The matrices are in its space
void limn_pose_points(const limn_pose *pose, const float *points, uint32_t begin, uint32_t end,
                      float *out);

/// Turns normals [begin, end) of the bind pose as the points at them are turned (Brickhill), for
/// LIMN_LIGHT_INTERPOLATED as he has it. Wrong, by any angle, where joints change the shape of the
/// surface, as a normal knows only the joints of its own control point (his Figure 6).
/// limn_mesh_control_normals() after limn_pose_points() is exact and costs as much. As
/// limn_output.control_normals of written normals or of LIMN_LIGHT_EXACT they would show: all other
/// rows have exact normals. Does not allocate, never fails; any number of threads may take disjoint
/// ranges.
///
/// mesh        has normals, and skin->point_count control points, which are its base vertices (a mesh
///             that has been divided has others)
/// normals     [mesh->normal_count][3] unit vectors: limn_mesh_control_normals() of the bind pose
/// begin, end  0 <= begin <= end <= mesh->normal_count
/// out         the same shape, of which the range is written with unit vectors, (0, 0, 1) for what
///             the joints make too short; may be `normals`, and must not overlap them otherwise
void limn_pose_normals(const limn_pose *pose, const limn_mesh *mesh, const float *normals,
                       uint32_t begin, uint32_t end, float *out);

/// Shapes to blend, such as those of a face: each lists the points that it moves. The caller's, see
/// limn_morph_check().
typedef struct limn_morph_targets {
    uint32_t point_count; ///< the control_count of the mesh
    uint32_t target_count;
    const uint32_t *first;  ///< [target_count + 1] where the entries of each target begin; the last
                            ///< is the number of entries
    const uint32_t *points; ///< [entries] below point_count, ascending in each target
    const float *deltas;    ///< [entries][3] model units: how far a weight of 1 moves them
} limn_morph_targets;

/// A place in morph targets.
typedef struct limn_morph_place {
    uint32_t target;
    uint32_t entry; ///< of all
} limn_morph_place;

/// Whether morph targets can be used: LIMN_ERROR_MORPH_POINT, where `first` may be at fault, or
/// LIMN_ERROR_MORPH_DELTA. Does not allocate; any thread.
///
/// entry_count  how many `points` and `deltas` have room for: what lies behind is not read
/// place        out: the first that is refused, if any is; or NULL
limn_result limn_morph_check(const limn_morph_targets *targets, uint32_t entry_count,
                             limn_morph_place *place);

/// Adds targets to points [begin, end): each gets the sum of its movements times their weights, in
/// the order of the targets. Those of weight 0 cost nothing. Does not allocate, never fails; any
/// number of threads may take disjoint ranges.
///
/// weights     [target_count] finite
/// points      [targets->point_count][3] floats, model units
/// begin, end  0 <= begin <= end <= targets->point_count
/// out         the same shape, of which the range is written; must not overlap the points
void limn_morph_points(const limn_morph_targets *targets, const float *weights, const float *points,
                       uint32_t begin, uint32_t end, float *out);

// -------------------------------------------------------------------------------------------------
// Light
//
// Diffuse light on the vertices of a frame, as Brickhill has it on a mesh that is dense because it
// is subdivided: a colour for each vertex, to multiply with that of the material. Positions and
// directions are in the space of the control points, colours linear.

/// What a light is.
typedef enum limn_light_kind {
    LIMN_LIGHT_DIRECTIONAL, ///< from so far away that it is the same everywhere
    LIMN_LIGHT_POINT,       ///< from a point, in all directions
    LIMN_LIGHT_SPOT         ///< from a point, into a cone
} limn_light_kind;

/// One light. What it gives is max(0, n . w) for a unit normal n and the way w to it, times its
/// colour, and if it has a position, times what of it arrives: with d the distance,
/// 1 / (a + b d + c d^2), max(0, 1 - (d / range)^4), and in the cone of a spot, from the outer
/// cosine to the inner, the square of the part of the way between them. With a = b = 0, c = 1 that
/// is KHR_lights_punctual of glTF.
typedef struct limn_light {
    limn_light_kind kind;
    float colour[3];      ///< red, green, blue, times its strength
    float position[3];    ///< point, spot
    float direction[3];   ///< directional, spot: a unit vector, the way that the light goes
    float attenuation[3]; ///< point, spot: a, b and c, not negative; all 0 stand for a = 1
    float range;          ///< point, spot: nothing arrives beyond; 0: no limit
    float inner_cosine;   ///< spot: of the angle to its direction within which all of it arrives
    float outer_cosine;   ///< spot: outside of which nothing does, at most inner_cosine; equal:
                          ///< a hard edge
} limn_light;

/// Where max(0, n . w) is found. What arrives of a light, and whether a spot reaches a vertex, is
/// found at every vertex in both modes.
typedef enum limn_light_mode {
    /// At the limits of base vertices, and linear over each patch, of quads in u and in v
    /// (Brickhill): no normals between them are needed.
    LIMN_LIGHT_INTERPOLATED,
    LIMN_LIGHT_EXACT ///< at every vertex; costs its normal, whether written or not
} limn_light_mode;

/// All light of a frame: each light adds to `ambient` in the order of the array.
typedef struct limn_lighting {
    limn_light_mode mode;
    float ambient[3];
    const limn_light *lights; ///< [light_count], see limn_lights_check()
    uint32_t light_count;
} limn_lighting;

/// Whether lights can be used: LIMN_ERROR_LIGHT. A direction may be 1e-3 off unit length. Does not
/// allocate; any thread.
///
/// index  out: the first that is refused, if any is; or NULL
limn_result limn_lights_check(const limn_light *lights, uint32_t light_count, uint32_t *index);

// -------------------------------------------------------------------------------------------------
// Plans and evaluation

/// One patch of a plan with levels of detail. The level of an edge is a real number l between 0 and
/// 4, which follows from the edge alone; n = ceil(l) levels are drawn of it, and what is new at
/// level n is on its way from the middle of its sources (weight 0, see limn_row) to its place (1):
/// at l - (n - 1). A patch has the highest level of its edges, and its weight.
typedef struct limn_plan_patch {
    uint32_t patch;          ///< of the mesh
    uint32_t first_vertex;   ///< in the output: the base vertex to draw its template with
    uint16_t template_index; ///< see limn_template_find()
    uint8_t level;
    uint8_t edge_levels[LIMN_CORNER_MAX]; ///< n, by edges of the patch
    uint8_t reserved;                     ///< 0
    float edge_morphs[LIMN_CORNER_MAX];   ///< weights
    float morph;                          ///< weight of the patch
} limn_plan_patch;

/// A draw, as glMultiDrawElementsIndirect() reads it.
typedef struct limn_draw {
    uint32_t index_count, instance_count, first_index;
    int32_t base_vertex;
    uint32_t base_instance; ///< index of the patch in the plan
} limn_draw;

/// One frame's decisions: which patches are drawn, at which level, and where their vertices go.
/// Patch p writes domain->row_counts[level] vertices from limn_plan_first_vertex() on.
typedef struct limn_plan {
    const limn_mesh *mesh; ///< must outlive the plan
    uint32_t level;        ///< of uniform plans; of others the highest
    uint32_t patch_count;
    uint64_t vertex_count; ///< of all patches: what the output must hold
    uint64_t index_count;  ///< of all draws; of a uniform plan three for each triangle
    const limn_plan_patch
        *patches;           ///< [patch_count] in the order of the mesh; NULL: a uniform plan
    const limn_draw *draws; ///< [patch_count] ordered by template; NULL: a uniform plan, or
                            ///< one that was made without templates
} limn_plan;

/// Every patch of the mesh at one level, 0 to LIMN_LEVEL_MAX. Does not allocate; never fails; any
/// thread.
limn_plan limn_plan_uniform(const limn_mesh *mesh, uint32_t level);

/// Where a frame is seen from. limn_view_perspective() and limn_view_orthographic() make views.
typedef struct limn_view {
    float eye[3];  ///< perspective: where the camera is
    float pixels;  ///< the size of a unit of length: at distance 1 (perspective), or everywhere
    float nearest; ///< perspective, above 0: what is nearer counts as this far away
    bool orthographic;
    uint32_t plane_count; ///< 0 to 6; 0: nothing is outside
    float planes[6][4];   ///< a point p is inside where p x + q y + r z + s >= 0 for all
} limn_view;

#define LIMN_VIEW_MAX 4 ///< views of one plan

/// A view from `eye` towards `target`.
///
/// target                 not the eye
/// up                     any direction that is not the line of sight
/// fov                    vertical angle of view in radians, between 0 and pi
/// width, height          of the viewport in pixels
/// near_plane, far_plane  distances of the planes that bound it, 0 < near_plane < far_plane
limn_view limn_view_perspective(const float eye[3], const float target[3], const float up[3],
                                float fov, float width, float height, float near_plane,
                                float far_plane);

/// The same without perspective: `extent` is the height of what is seen, in model units, and
/// `near_plane` may be negative.
limn_view limn_view_orthographic(const float eye[3], const float target[3], const float up[3],
                                 float extent, float width, float height, float near_plane,
                                 float far_plane);

/// How levels are chosen. Zero means default.
typedef enum limn_lod {
    LIMN_LOD_LENGTH,  ///< so that steps along an edge are `pixels` long on the screen
    LIMN_LOD_UNIFORM, ///< `level` everywhere
    LIMN_LOD_ERROR    ///< so that what is drawn is `pixels` off the limit surface at most; 99 % of
                      ///< patches keep to that, others nearly (docs/mathematics.md). The baker
                      ///< measured the bind pose; since then errors scale with the edges. What
                      ///< would need more than LIMN_LEVEL_MAX gets that
} limn_lod;

/// How the levels of a frame are chosen. Zero means default, everywhere.
typedef struct limn_lod_desc {
    limn_lod lod;
    float level;  ///< LIMN_LOD_UNIFORM: a real number
    float pixels; ///< on the screen, above 0: by default 8, with LIMN_LOD_ERROR 1
    float bias;   ///< added to all levels, -16 to 16; with LIMN_LOD_ERROR, -1 is some 4 times the
                  ///< tolerance
    float min_level; ///< 0 to LIMN_LEVEL_MAX; from 1 on nothing jumps as levels change
    float max_level; ///< the same; default LIMN_LEVEL_MAX
    uint64_t
        vertex_budget; ///< levels are lowered, all by the same amount, until the vertices are no
                       ///< more, or until all are at `min_level`; 0: any number. With
                       ///< LIMN_LOD_ERROR this raises the tolerance
    bool no_morph;     ///< all weights are 1
    /// The caller's own test: false leaves a patch out. Called from the thread that plans.
    bool (*keep_fn)(void *user, uint32_t patch);
    void *keep_user;
} limn_lod_desc;

/// Bytes of memory that limn_plan_build() needs for a mesh.
size_t limn_plan_size(const limn_mesh *mesh);

/// Plans a frame: levels for all edges, and of the patches that may be seen in any view, their
/// templates, weights and places. A patch is left out where all its points are outside of one plane
/// of every view: the surface lies within their convex hull, so this is exact under animation too.
/// Where coefficients are negative, they must be as far outside as the surface may leave the hull.
/// The result is the same for whichever thread, and depends on nothing else. Does not allocate; any
/// thread, with memory of its own. A frame of more than INT32_MAX vertices has no plan: 0 patches.
///
/// controls   [mesh->point_count][3] floats, model units: those that will be evaluated
/// views      [view_count] 1 to LIMN_VIEW_MAX, in the space of the control points
/// desc       NULL: all defaults. LIMN_LOD_ERROR needs mesh->errors, which every baked mesh has
/// templates  [limn_template_count()] as uploaded, for the draws; NULL: no draws are made
/// memory     [limn_plan_size()] bytes, aligned to 8; the plan points into it
limn_plan limn_plan_build(const limn_mesh *mesh, const float *controls, const limn_view *views,
                          uint32_t view_count, const limn_lod_desc *desc,
                          const limn_template *templates, void *memory);

/// Index of the first vertex of a patch in the output: the base vertex to draw its indices with.
/// `patch_index` < plan->patch_count counts the patches of the plan.
uint64_t limn_plan_first_vertex(const limn_plan *plan, uint32_t patch_index);

/// How a position is written. Packed, each coordinate is q = 65535 (x - min) / (max - min), rounded
/// to the nearest and clamped to the box, so x = min + q / 65535 (max - min) within half a step;
/// neighbours still agree in every bit.
typedef enum limn_position_format {
    LIMN_POSITION_FLOAT3,   ///< 12 bytes
    LIMN_POSITION_UNORM16X4 ///< 8 bytes: x, y, z, and 65535
} limn_position_format;

/// How a unit normal is written. Signed integers are rounded to the nearest, 1 being 127 or 32767.
/// Octahedral, x first: n / (|x| + |y| + |z|), and where z < 0, x becomes (1 - |y|) sign(x), and y
/// likewise. To unpack x and y: z = 1 - |x| - |y|; where z < 0, the same exchange; then normalise.
typedef enum limn_normal_format {
    LIMN_NORMAL_FLOAT3,   ///< 12 bytes
    LIMN_NORMAL_OCT16X2,  ///< 4 bytes: octahedral
    LIMN_NORMAL_OCT8X2,   ///< 2 bytes: octahedral
    LIMN_NORMAL_SNORM8X4, ///< 4 bytes: x, y, z, 0
} limn_normal_format;

/// Where vertices go, and in which form. Each byte is written once and none is read. Memory is
/// written forward: vertex after vertex, or where normals or colours have a stream of their own, a
/// patch of each in turn.
typedef struct limn_output {
    void *vertices;  ///< position of vertex 0 of the *plan*, aligned to 4 bytes
    uint32_t stride; ///< bytes from position to position, a multiple of 4; 0 means tightly packed
    limn_position_format position_format;
    const float *box; ///< [2][3], min and max, for packed positions; NULL: the mesh's bounds in the
                      ///< bind pose. The surface never leaves the box of its control points
                      ///< (creases that share their sharpness may). On an axis without extent all
                      ///< is 0
    void *normals; ///< normal of vertex 0 of the plan, aligned to 4 bytes, or to 2 if it has 2: in
                   ///< a stream of its own, or inside the vertices, with the same stride; NULL: no
                   ///< normals
    uint32_t normal_stride; ///< bytes from normal to normal, a multiple of the alignment; 0 means
                            ///< tightly packed, so inside the vertices it is never 0
    limn_normal_format normal_format;
    /// Colour of vertex 0 of the plan, aligned to 4 bytes: red, green and blue, each 255 times a
    /// light of 0 to 1, clamped and rounded to the nearest, and 255; linear, as glTF's vertex colours
    /// are. In a stream of its own, or inside the vertices, with the same stride; NULL: no colours.
    void *colours;
    uint32_t colour_stride;        ///< bytes from colour to colour, as for normals
    const limn_lighting *lighting; ///< needed with `colours`
    /// [mesh->normal_count][3] from limn_mesh_control_normals(), for the corners of the patches;
    /// needed with `normals` and `colours`. For LIMN_LIGHT_INTERPOLATED a mesh needs no normals: if
    /// it has none, these are [base_count][3] of the caller's.
    const float *control_normals;
    /// Write past the caches, where the CPU can (x86), where there are no gaps between vertices and
    /// no 2-byte normals: for memory that this CPU does not read soon.
    bool streaming;
} limn_output;

/// Fills in the points behind the control points, of an isolated or a divided mesh: once a frame,
/// before its normals, its plan and its vertices. Nothing is to be done for other meshes, nor for
/// the bind pose in mesh->controls, which has them. Does not allocate, never fails; any thread. The
/// same input gives the same bits with every kernel.
///
/// controls  [mesh->point_count][3] floats, model units: the first control_count are read, and the
///           rest are written
void limn_mesh_refine(const limn_mesh *mesh, float *controls);

/// Limit normals of all base vertices, normal 0 being that of mesh->base_first, and then of further
/// sides of creases and faces at corners, which patches take by mesh->corner_normals: unit vectors,
/// towards the side from which faces are counter-clockwise. Where the surface has no tangent plane,
/// and at base vertices that no face uses, the normal is (0, 0, 1). Does not allocate, never fails;
/// any thread. The mesh must have normals.
///
/// controls  [mesh->base_first + mesh->base_count][3] floats, model units; of a divided mesh refined
/// normals   out: [mesh->normal_count][3] floats; must not overlap the controls
void limn_mesh_control_normals(const limn_mesh *mesh, const float *controls, float *normals);

/// Evaluates patches [begin, end) of a plan and writes their positions, and if asked to, unit
/// normals of the limit surface and the light on it. Does not allocate, never fails; any number of
/// threads may evaluate disjoint ranges of one plan into one output. Takes some 64 KB of stack; 200
/// KB where a patch depends on more than 256 points. The caller's own bytes between vertices are
/// left alone. The same input gives the same bits with every reproducible kernel, and shared
/// vertices of neighbouring patches get the same bits with any. Both hold if all threads round to
/// nearest and treat denormals alike, and where control points are finite; docs/design.md says more.
///
/// controls    [mesh->point_count][3] floats, model units, tightly packed; must not overlap the
///             output
/// begin, end  0 <= begin <= end <= plan->patch_count; an empty range is a no-op
/// output      room for plan->vertex_count vertices, of which only those of the range are written
void limn_evaluate(const limn_plan *plan, const float *controls, uint32_t begin, uint32_t end,
                   const limn_output *output);

// -------------------------------------------------------------------------------------------------
// Base meshes
//
// What is far away needs no patches: where level 0 is enough everywhere, a mesh can be drawn as its
// base faces, with their corners on the limit surface. Vertices are shared, so there is about a
// sixth of what the patches of triangles have, nothing to plan, and one draw.

/// A vertex of a base mesh: what some corners of patches have in common.
typedef struct limn_base_vertex {
    uint32_t
        corner; ///< the first of them: patch * domain->corner_count + its corner, which is also
                ///< its vertex in limn_plan_uniform(mesh, 0)
    uint32_t normal;                 ///< among those of limn_mesh_control_normals()
    uint32_t first_term, term_count; ///< its stencil
} limn_base_vertex;

/// A base mesh, in the caller's memory. Plain data.
typedef struct limn_base {
    const limn_mesh *mesh;
    uint32_t vertex_count;
    uint32_t index_count;    ///< patch_count * domain->index_counts[0]
    const uint32_t *indices; ///< [index_count] counter-clockwise triangles, patch by patch, so that
                             ///< the patches of a material are consecutive
    const limn_base_vertex *vertices; ///< [vertex_count]
    /// Of the stencils, in ascending order of their points: a vertex is mesh->origin + the sum of
    /// weight (point - mesh->origin).
    const struct limn_file_term *terms;
    float length; ///< of the longest edge of the bind pose, model units
    float error;  ///< of level 0 in the bind pose, the largest of any edge
    size_t size;  ///< bytes of memory, from its start, that are still needed
} limn_base;

/// Bytes of memory that limn_base_build() needs, of which about the first third stays in use. 0: the
/// mesh has no patches, or more than UINT32_MAX indices or terms. Takes a tenth of building.
size_t limn_base_size(const limn_mesh *mesh);

/// Makes the base mesh of a mesh: once, in less than a microsecond a patch. Corners are one vertex
/// where they have the same base vertex, the same normal and the same values in all channels. As
/// those do not move, a channel is evaluated once, for limn_plan_uniform(mesh, 0), of which
/// limn_base_vertex.corner are the vertices to take. Does not allocate, never fails; any thread.
///
/// pack    that of the mesh, for its channels
/// mesh    must outlive the base mesh. Where limn_base_size() is 0, that has no vertices
/// memory  [limn_base_size()] bytes, aligned to 8
limn_base limn_base_build(const limn_pack *pack, const limn_mesh *mesh, void *memory);

/// Whether level 0 is enough in all views for a mesh within a box: all levels that
/// limn_plan_build() chooses by `desc` are 0 then, unless edges are longer than in the bind pose.
/// Never where `min_level` is more; the vertex budget is not asked, nor with LIMN_LOD_ERROR a
/// negative bias. Does not allocate, never fails; any thread.
///
/// box    [2][3], min and max of the control points, in the space of the views
/// views  [view_count], see limn_plan_build()
/// desc   NULL: all defaults
bool limn_base_suffices(const limn_base *base, const float *box, const limn_view *views,
                        uint32_t view_count, const limn_lod_desc *desc);

/// Evaluates vertices [begin, end) of a base mesh: the bits that limn_evaluate() gives the same
/// corners with reproducible kernels, with kernels of any family. Otherwise as limn_evaluate().
///
/// controls    [mesh->point_count][3] floats, model units
/// begin, end  0 <= begin <= end <= base->vertex_count
/// output      room for base->vertex_count vertices, of which only those of the range are written
void limn_base_evaluate(const limn_base *base, const float *controls, uint32_t begin, uint32_t end,
                        const limn_output *output);

// -------------------------------------------------------------------------------------------------
// Evaluating channels

/// How a value of a channel is written. Integers are rounded to the nearest, and halves, too.
typedef enum limn_value_format {
    LIMN_VALUE_FLOAT3,    ///< 12 bytes
    LIMN_VALUE_FLOAT2,    ///< 8 bytes: the first two components
    LIMN_VALUE_HALF2,     ///< 4 bytes: two IEEE 754 binary16, at most 65504 from 0
    LIMN_VALUE_UNORM16X2, ///< 4 bytes: each is 65535 (value - min) / (max - min), clamped to the box
    LIMN_VALUE_RGBA8      ///< 4 bytes: three components times 255, clamped, and 255
} limn_value_format;

/// Where the values of a channel go: a stream of their own. Each byte is written once, going
/// forward, and none is read.
typedef struct limn_value_output {
    void *values;    ///< of vertex 0 of the plan, aligned to 4 bytes
    uint32_t stride; ///< bytes from value to value, a multiple of 4; 0 means tightly packed
    limn_value_format format;
    const float
        *box;       ///< [2][3], min and max; NULL: the bounds of the values in the file. On an axis
                    ///< without extent all is 0
    bool streaming; ///< see limn_output
} limn_value_output;

/// Evaluates a channel for patches [begin, end) of a plan of its mesh: as limn_evaluate() does
/// positions, with the levels and weights of the plan, so that values stay with their vertices; and
/// with the same promises, for vertices whose values the faces share.
///
/// plan     of the mesh that the channel belongs to, whatever made it
/// values   [channel->mesh.point_count][3]: channel->mesh.controls, or others, for which
///          limn_mesh_refine(&channel->mesh, …) fills in what follows from the first
/// output   room for plan->vertex_count values, of which only those of the range are written
void limn_evaluate_channel(const limn_plan *plan, const limn_channel *channel, const float *values,
                           uint32_t begin, uint32_t end, const limn_value_output *output);

#ifdef __cplusplus
}
#endif

#endif
