/* SPDX-License-Identifier: MIT */
/*
 * The .limn file as plain C structs. A file is mapped, not parsed: the runtime reads these records
 * in place. Games include limn.h; this header is for tools that look into a file.
 *
 * Layout: one header, the chunk directory right behind it, then the chunks. Every chunk starts on a
 * multiple of 64 bytes from the start of the file, and gaps are zero. All numbers are
 * little-endian. A reader skips chunks whose kind it does not know, unless they are marked as
 * required. docs/format.md describes every byte.
 */
#ifndef LIMN_FORMAT_H
#define LIMN_FORMAT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// `condition` holds wherever this is compiled.
#ifdef __cplusplus
#define LIMN_STATIC_ASSERT(condition, text) static_assert(condition, text)
extern "C" {
#else
#define LIMN_STATIC_ASSERT(condition, text) _Static_assert(condition, text)
#endif

// -------------------------------------------------------------------------------------------------
// The file

#define LIMN_FORMAT_MAGIC "LIMN" ///< the first four bytes
#define LIMN_FORMAT_VERSION 6u   ///< what the baker writes

/// The oldest version that is read. Version 6 is the first that later releases keep reading.
#define LIMN_FORMAT_VERSION_OLDEST 6u

/// Alignment of the blob in memory and of every chunk in the file, in bytes.
#define LIMN_FORMAT_ALIGNMENT 64u

/// Parts of a table column are padded with zeros to a multiple of this many rows.
#define LIMN_FORMAT_ROW_BLOCK 8u

/// A control index list longer than this stores two bytes per slot instead of one.
#define LIMN_FORMAT_NARROW_SLOTS 256u

/// The largest local base of a class, in control points: two corners of valence 1000, for instance.
#define LIMN_FORMAT_CONTROLS_MAX 2048u

/// Tables of pieces in a file.
#define LIMN_FORMAT_PIECES_MAX 65536u

/// A class that is its own mirror image has at most this many control points: longer sums are
/// compensated, which pairs of rows cannot be.
#define LIMN_FORMAT_PAIRED_MAX 24u

/// In LIMN_CHUNK_COLUMNS, for a slot that a piece does not have.
#define LIMN_FORMAT_NO_COLUMN 0xffffu

/// The `mesh` of a chunk that belongs to the file and not to one of its meshes.
#define LIMN_FORMAT_NO_MESH 0xffffffffu

// -------------------------------------------------------------------------------------------------
// Chunks of a file

/// Chunk kinds: four characters, read as a little-endian number.
#define LIMN_FORMAT_KIND(a, b, c, d)                                                               \
    ((uint32_t)(a) | (uint32_t)(b) << 8 | (uint32_t)(c) << 16 | (uint32_t)(d) << 24)

#define LIMN_CHUNK_INFO                                                                            \
    LIMN_FORMAT_KIND('I', 'N', 'F', 'O') ///< text, zero-terminated: how the file was baked
#define LIMN_CHUNK_CLASSES LIMN_FORMAT_KIND('C', 'L', 'A', 'S') ///< limn_file_class[class_count]
#define LIMN_CHUNK_TABLES                                                                          \
    LIMN_FORMAT_KIND('T', 'A', 'B', 'L') ///< float[]: the stencil tables of all classes

/// Where meshes are isolated: limn_file_piece[].
#define LIMN_CHUNK_PIECES LIMN_FORMAT_KIND('P', 'I', 'E', 'C')

/// Where meshes are isolated: uint16_t[], of each class that is made of pieces first the four
/// pieces, the corners' and of a triangle the middle one, and then for each of them the column
/// of each of the K slots, or LIMN_FORMAT_NO_COLUMN.
#define LIMN_CHUNK_COLUMNS LIMN_FORMAT_KIND('C', 'O', 'L', 'S')

#define LIMN_CHUNK_MESH LIMN_FORMAT_KIND('M', 'E', 'S', 'H') ///< limn_file_mesh, one per mesh
#define LIMN_CHUNK_NAME                                                                            \
    LIMN_FORMAT_KIND('N', 'A', 'M', 'E') ///< text, zero-terminated, one per mesh
#define LIMN_CHUNK_CONTROLS                                                                        \
    LIMN_FORMAT_KIND('C', 'T', 'R', 'L') ///< float[point_count][3]: the bind pose
#define LIMN_CHUNK_RUNS LIMN_FORMAT_KIND('R', 'U', 'N', 'S') ///< limn_file_run[run_count]
#define LIMN_CHUNK_FACES                                                                           \
    LIMN_FORMAT_KIND('F', 'A', 'C', 'E') ///< uint32_t[patch_count]: see limn_patch_face
#define LIMN_CHUNK_INDICES                                                                         \
    LIMN_FORMAT_KIND('I', 'N', 'D', 'X') ///< uint32_t[]: control indices of the patches
#define LIMN_CHUNK_SLOTS                                                                           \
    LIMN_FORMAT_KIND('S', 'L', 'O', 'T') ///< uint8_t[] or uint16_t[]: slots, ascending by INDX
#define LIMN_CHUNK_ERRORS                                                                          \
    LIMN_FORMAT_KIND('E', 'R', 'R', 'S') ///< uint16_t[patch_count][corners]: errors of edges

/// Where a mesh has more points than control points: uint32_t[point_count - control_count + 1],
/// where the terms of each of them begin, and end.
#define LIMN_CHUNK_STENCILS LIMN_FORMAT_KIND('S', 'T', 'N', 'C')

/// Where a mesh has more points than control points: limn_file_term[].
#define LIMN_CHUNK_TERMS LIMN_FORMAT_KIND('T', 'E', 'R', 'M')

/// In files with normals: limn_file_normal[] of the base vertices.
#define LIMN_CHUNK_NORMALS LIMN_FORMAT_KIND('N', 'R', 'M', 'L')

/// In files with normals: uint32_t[], the points of rings.
#define LIMN_CHUNK_RINGS LIMN_FORMAT_KIND('R', 'I', 'N', 'G')

/// In files with normals: float[], the weights of these points.
#define LIMN_CHUNK_WEIGHTS LIMN_FORMAT_KIND('W', 'G', 'H', 'T')

/// In meshes with sharp creases: uint8_t[patch_count], as limn_mesh.creases.
#define LIMN_CHUNK_CREASES LIMN_FORMAT_KIND('C', 'R', 'E', 'A')

/// In files with normals, where there are sides: limn_file_side[].
#define LIMN_CHUNK_SIDES LIMN_FORMAT_KIND('S', 'I', 'D', 'E')

/// In files with normals, where there are sides: uint32_t[patch_count][corners], as
/// limn_mesh.corner_normals.
#define LIMN_CHUNK_CORNERS LIMN_FORMAT_KIND('C', 'O', 'R', 'N')

/// Of a channel: limn_file_channel.
#define LIMN_CHUNK_CHANNEL LIMN_FORMAT_KIND('C', 'H', 'N', 'L')

// Characters: what moves and colours meshes. None of these chunks is required. First those of the
// file.

/// Names, zero-terminated, one behind the other.
#define LIMN_CHUNK_STRINGS LIMN_FORMAT_KIND('S', 'T', 'R', 'S')

#define LIMN_CHUNK_SKELETON LIMN_FORMAT_KIND('S', 'K', 'E', 'L')    ///< limn_file_joint[]
#define LIMN_CHUNK_CLIPS LIMN_FORMAT_KIND('C', 'L', 'I', 'P')       ///< limn_file_clip[]
#define LIMN_CHUNK_TRACKS LIMN_FORMAT_KIND('T', 'R', 'A', 'K')      ///< limn_file_track[]
#define LIMN_CHUNK_KEYS LIMN_FORMAT_KIND('K', 'E', 'Y', 'S')        ///< float[]
#define LIMN_CHUNK_MATERIALS LIMN_FORMAT_KIND('M', 'A', 'T', 'L')   ///< limn_file_material[]
#define LIMN_CHUNK_IMAGES LIMN_FORMAT_KIND('I', 'M', 'A', 'G')      ///< limn_file_image[]
#define LIMN_CHUNK_IMAGE_BYTES LIMN_FORMAT_KIND('I', 'D', 'A', 'T') ///< the bytes of images

// Those of a mesh.

#define LIMN_CHUNK_JOINTS                                                                          \
    LIMN_FORMAT_KIND('J', 'O', 'I', 'N') ///< uint16_t[control_count][influence_count]
#define LIMN_CHUNK_INFLUENCES                                                                      \
    LIMN_FORMAT_KIND('I', 'N', 'F', 'L') ///< float[control_count][influence_count]: weights
#define LIMN_CHUNK_TARGETS LIMN_FORMAT_KIND('M', 'T', 'G', 'T')      ///< limn_file_target[]
#define LIMN_CHUNK_TARGET_FIRST LIMN_FORMAT_KIND('M', 'F', 'S', 'T') ///< uint32_t[target_count + 1]
#define LIMN_CHUNK_TARGET_POINTS LIMN_FORMAT_KIND('M', 'P', 'N', 'T') ///< uint32_t[]
#define LIMN_CHUNK_TARGET_DELTAS LIMN_FORMAT_KIND('M', 'D', 'E', 'L') ///< float[][3]
#define LIMN_CHUNK_RANGES LIMN_FORMAT_KIND('M', 'A', 'T', 'R')        ///< limn_file_range[]

/// Bit of limn_file_chunk.flags: a reader that does not know this chunk must refuse the file.
#define LIMN_CHUNK_REQUIRED 1u

/// What a file begins with.
typedef struct limn_file_header {
    char magic[4];     ///< "LIMN"; this and the version stay where they are in every version
    uint32_t version;  ///< LIMN_FORMAT_VERSION
    uint64_t size;     ///< of the whole file, in bytes
    uint64_t checksum; ///< XXH64 with seed 0 of the bytes from `chunk_count` to the end of the file
    uint32_t chunk_count; ///< entries of the directory that follows the header
    uint32_t mesh_count;
    uint32_t class_count;
    uint32_t channel_count; ///< of all meshes; their chunks are those of meshes from mesh_count on
    uint32_t reserved[6];   ///< zero
} limn_file_header;

/// An entry of the directory.
typedef struct limn_file_chunk {
    uint32_t kind;  ///< LIMN_CHUNK_…
    uint32_t mesh;  ///< index of the mesh, or LIMN_FORMAT_NO_MESH
    uint32_t flags; ///< LIMN_CHUNK_REQUIRED or 0
    uint32_t reserved;
    uint64_t offset; ///< from the start of the file, a multiple of LIMN_FORMAT_ALIGNMENT
    uint64_t size;   ///< in bytes, without padding
} limn_file_chunk;

/// By this, the directory ascends: the chunks of the file first, then mesh by mesh.
static inline uint64_t limn_file_chunk_key(uint32_t mesh, uint32_t kind) {
    return (uint64_t)(uint32_t)(mesh + 1) << 32 | kind;
}

// -------------------------------------------------------------------------------------------------
// Classes and normals in a file

/// The limn_domain_kind of quads.
#define LIMN_FORMAT_QUAD 1u

/// What a class's `depth` is that has a table for all levels.
#define LIMN_FORMAT_DEPTH 4u

/// What it is of a class that is made of pieces, the faces that a level of subdivision makes of a
/// base face, where the mesh is isolated.
#define LIMN_FORMAT_PIECE_DEPTH 3u
#define LIMN_FORMAT_PIECE_COUNT 4u ///< of these faces

/// One topology class: a table of `control_count` columns, each with one coefficient per row of the
/// domain; or where the class is its own mirror image, per pair of rows (docs/format.md).
typedef struct limn_file_class {
    uint64_t table_offset;  ///< of float[control_count][row_stride], in bytes from the start of the
                            ///< tables chunk; with pieces, into the columns chunk
    uint32_t control_count; ///< K, the size of the local base
    uint16_t domain;        ///< limn_domain_kind
    uint16_t depth;         ///< LIMN_FORMAT_DEPTH or LIMN_FORMAT_PIECE_DEPTH
    uint16_t valences[4];   ///< of the patch's corners, in row order; 0 beyond the domain's corners
    uint32_t boundary_corners; ///< bit c: corner c lies on a boundary
    uint16_t table_count;      ///< 1: positions; 3: then the tangents along and across
    uint16_t pair_count; ///< 0; or the class is its own mirror image, with this many pairs of slots
    /// The largest sum, over the rows of positions, of the absolute values of the coefficients below
    /// 0. Along any direction a row is at most max + negative * (max - min) of the patch's points.
    float negative;
    uint32_t reserved; ///< zero
} limn_file_class;

/// The table of a piece. Its rows are those of the domain down to level 3, in the order of
/// runtime/domain.h, without those that belong to another piece of the same patch.
typedef struct limn_file_piece {
    uint64_t table_offset;  ///< as for a class: of float[control_count][row_stride]
    uint32_t control_count; ///< columns
    uint8_t kind;           ///< 0: at a corner; 1: in the middle of a triangle
    uint8_t domain;         ///< limn_domain_kind
    uint16_t table_count;   ///< as for a class
} limn_file_piece;

/// One term of a point that is no control point: it is c + sum of weight (p - c), p being the points
/// of its terms and c that of the first; without terms, the origin of the mesh.
typedef struct limn_file_term {
    uint32_t point; ///< any before the point itself
    float weight;
} limn_file_term;

/// How the limit normal of a base vertex follows from the points around it: two tangents, each a
/// weighted sum of its ring, relative to it. Files with normals have one per base vertex.
typedef struct limn_file_normal {
    uint32_t first_ring;   ///< into the ring chunk: `ring_count` points
    uint32_t ring_count;   ///< 0: the base vertex is used by no face
    uint32_t first_weight; ///< into the weights chunk: [2][ring_count]
} limn_file_normal;

/// A further normal of a base vertex that has several: on a crease one for each side, at a corner
/// one for each face.
typedef struct limn_file_side {
    uint32_t point; ///< the base vertex
    limn_file_normal normal;
} limn_file_side;

/// Rows of a column, with padding.
static inline uint32_t limn_file_row_stride(const limn_file_class *file_class) {
    if (file_class->domain == LIMN_FORMAT_QUAD) return 296;
    return file_class->pair_count ? 112 : 160;
}

/// Floats of all the tables of a class; 0 of one in pieces.
static inline uint64_t limn_file_table_size(const limn_file_class *file_class) {
    if (file_class->depth != LIMN_FORMAT_DEPTH) return 0;
    return (uint64_t)file_class->table_count * file_class->control_count *
           limn_file_row_stride(file_class);
}

/// Words of the columns of a class in pieces; 0 of one with a table.
static inline uint64_t limn_file_columns_size(const limn_file_class *file_class) {
    if (file_class->depth != LIMN_FORMAT_PIECE_DEPTH) return 0;
    return LIMN_FORMAT_PIECE_COUNT * (1 + (uint64_t)file_class->control_count);
}

/// Rows of a column of a piece, with padding.
static inline uint32_t limn_file_piece_stride(const limn_file_piece *piece) {
    if (piece->domain == LIMN_FORMAT_QUAD) return 80;
    return piece->kind ? 48 : 40;
}

/// Floats of all the tables of a piece.
static inline uint64_t limn_file_piece_table_size(const limn_file_piece *piece) {
    return (uint64_t)piece->table_count * piece->control_count * limn_file_piece_stride(piece);
}

/// Bytes per slot of the patches of a class.
static inline uint32_t limn_file_slot_size(const limn_file_class *file_class) {
    return file_class->control_count <= LIMN_FORMAT_NARROW_SLOTS ? 1 : 2;
}

// -------------------------------------------------------------------------------------------------
// Meshes in a file

/// A mesh: what its chunks hold how much of.
typedef struct limn_file_mesh {
    uint32_t control_count;
    uint32_t patch_count;
    uint32_t run_count;
    uint32_t domain;      ///< limn_domain_kind
    uint64_t index_count; ///< entries of the indices chunk
    float bounds_min[3];  ///< of the control points that faces use, in the bind pose
    float bounds_max[3];
    float origin[3];      ///< see limn_mesh.origin
    uint32_t hole_count;  ///< base faces without a patch
    uint32_t point_count; ///< control_count + divided_count; in isolated meshes with the points of
                          ///< a further level behind
    /// 0: the base vertices, whose faces the patches draw, are the control points. Otherwise the mesh
    /// has been divided once before, and they are so many points behind these.
    uint32_t divided_count;
    uint32_t first_channel; ///< of the file's: the channels of meshes follow one another
    uint32_t channel_count;
} limn_file_mesh;

/// A channel is a mesh whose points are values, without faces, errors and normals of its own. Its
/// patches are those of the mesh that it belongs to, in the same order and in the same frame: row r of
/// both is the same vertex.
typedef struct limn_file_channel {
    uint32_t kind;            ///< limn_channel_kind
    uint32_t component_count; ///< 1 to 3; others are 0
    uint32_t face_varying;    ///< how it was interpolated, for information: see bake.h
    uint32_t reserved;        ///< zero
} limn_file_channel;

/// Consecutive patches of one class. Patch p of the run has its control indices, by slot, at
/// indices[first_index + p * K], and at first_slot + p * K * (slot width) its slots, one or two
/// bytes each, in ascending order of these indices.
typedef struct limn_file_run {
    uint32_t class_index;
    uint32_t first_patch;
    uint32_t patch_count;
    uint32_t reserved;
    uint64_t first_index; ///< into the indices chunk, in entries
    uint64_t first_slot;  ///< into the slots chunk, in bytes; even where slots are two bytes wide
} limn_file_run;

// -------------------------------------------------------------------------------------------------
// Animation and materials in a file

/// For a joint without a parent, a material without an image, and patches without a material.
#define LIMN_FORMAT_NONE 0xffffffffu

/// Joints on the way from a root to any joint, at most.
#define LIMN_FORMAT_DEPTH_OF_JOINTS 256u

/// Joints in depth-first order: the parent of a joint is the one before it, or one that is on the
/// way from there to a root.
typedef struct limn_file_joint {
    uint32_t parent;                             ///< or LIMN_FORMAT_NONE
    uint32_t name;                               ///< into the strings, as the next ones
    float translation[3], rotation[4], scale[3]; ///< at rest, relative to the parent
    float inverse_bind[3][4]; ///< from the space of the points in the bind pose into its own
} limn_file_joint;

/// Tracks of a clip follow those of the clip before.
typedef struct limn_file_clip {
    uint32_t name;
    uint32_t first_track, track_count;
    float duration; ///< seconds
} limn_file_clip;

#define LIMN_FORMAT_TRANSLATION 0u    ///< what a track moves: where a joint is
#define LIMN_FORMAT_ROTATION 1u       ///< how it is turned
#define LIMN_FORMAT_SCALE 2u          ///< how large it is
#define LIMN_FORMAT_TARGET_WEIGHTS 3u ///< the weights of the morph targets of a mesh

#define LIMN_FORMAT_STEP 0u   ///< between keys: the value of the one before
#define LIMN_FORMAT_LINEAR 1u ///< from one to the other, rotations on the sphere
#define LIMN_FORMAT_CUBIC 2u  ///< by a Hermite spline

/// In the keys, behind those of the track before: key_count times, which ascend; and for each a
/// value of `width` floats, or of cubic ones three: a tangent, the value, and a tangent.
typedef struct limn_file_track {
    uint32_t target;       ///< a joint, or of LIMN_FORMAT_TARGET_WEIGHTS a mesh
    uint8_t path;          ///< LIMN_FORMAT_TRANSLATION and so on
    uint8_t interpolation; ///< LIMN_FORMAT_STEP and so on
    uint16_t width;        ///< 3, of rotations 4, of weights those of the mesh
    uint32_t key_count;
    uint32_t first_key; ///< into the keys
} limn_file_track;

/// By this, the tracks of a clip ascend: first those of joints.
static inline uint64_t limn_file_track_key(const limn_file_track *track) {
    const bool of_mesh = track->path == LIMN_FORMAT_TARGET_WEIGHTS;
    return (uint64_t)of_mesh << 34 | (uint64_t)track->target << 2 | track->path;
}

/// See limn_material.
typedef struct limn_file_material {
    uint32_t name;
    uint32_t image;           ///< or LIMN_FORMAT_NONE
    uint32_t texture_channel; ///< of its texture coordinates: n of TEXCOORD_n
    uint32_t reserved;
    float base_colour[4]; ///< linear, with alpha
} limn_file_material;

/// The image of a material.
typedef struct limn_file_image {
    uint32_t name;
    uint32_t reserved;
    uint64_t offset, size; ///< in the bytes of images; size 0: it is not in the file
} limn_file_image;

/// A morph target.
typedef struct limn_file_target {
    uint32_t name;
    float weight; ///< at rest
} limn_file_target;

/// Patches of one material. Ranges follow one another and cover all patches of a mesh.
typedef struct limn_file_range {
    uint32_t material; ///< or LIMN_FORMAT_NONE
    uint32_t first_patch, patch_count;
} limn_file_range;

LIMN_STATIC_ASSERT(sizeof(limn_file_header) == 64, "header");
LIMN_STATIC_ASSERT(offsetof(limn_file_header, checksum) == 16, "header.checksum");
LIMN_STATIC_ASSERT(offsetof(limn_file_header, chunk_count) == 24, "header.chunk_count");
LIMN_STATIC_ASSERT(sizeof(limn_file_chunk) == 32, "chunk");
LIMN_STATIC_ASSERT(offsetof(limn_file_chunk, offset) == 16, "chunk.offset");
LIMN_STATIC_ASSERT(sizeof(limn_file_class) == 40, "class");
LIMN_STATIC_ASSERT(offsetof(limn_file_class, valences) == 16, "class.valences");
LIMN_STATIC_ASSERT(offsetof(limn_file_class, negative) == 32, "class.negative");
LIMN_STATIC_ASSERT(sizeof(limn_file_normal) == 12, "normal");
LIMN_STATIC_ASSERT(sizeof(limn_file_side) == 16, "side");
LIMN_STATIC_ASSERT(sizeof(limn_file_piece) == 16, "piece");
LIMN_STATIC_ASSERT(sizeof(limn_file_term) == 8, "term");
LIMN_STATIC_ASSERT(sizeof(limn_file_mesh) == 80, "mesh");
LIMN_STATIC_ASSERT(sizeof(limn_file_channel) == 16, "channel");
LIMN_STATIC_ASSERT(offsetof(limn_file_mesh, bounds_min) == 24, "mesh.bounds_min");
LIMN_STATIC_ASSERT(offsetof(limn_file_mesh, divided_count) == 68, "mesh.divided_count");
LIMN_STATIC_ASSERT(offsetof(limn_file_mesh, channel_count) == 76, "mesh.channel_count");
LIMN_STATIC_ASSERT(sizeof(limn_file_run) == 32, "run");
LIMN_STATIC_ASSERT(offsetof(limn_file_run, first_index) == 16, "run.first_index");
LIMN_STATIC_ASSERT(sizeof(limn_file_joint) == 96, "joint");
LIMN_STATIC_ASSERT(offsetof(limn_file_joint, inverse_bind) == 48, "joint.inverse_bind");
LIMN_STATIC_ASSERT(sizeof(limn_file_clip) == 16, "clip");
LIMN_STATIC_ASSERT(sizeof(limn_file_track) == 16, "track");
LIMN_STATIC_ASSERT(sizeof(limn_file_material) == 32, "material");
LIMN_STATIC_ASSERT(sizeof(limn_file_image) == 24, "image");
LIMN_STATIC_ASSERT(sizeof(limn_file_target) == 8, "target");
LIMN_STATIC_ASSERT(sizeof(limn_file_range) == 12, "range");

#ifdef __cplusplus
}
#endif

#endif
