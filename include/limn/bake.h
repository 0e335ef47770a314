/* SPDX-License-Identifier: MIT */
/*
 * The baker: turns meshes into a .limn file. Offline code: it allocates, takes its time, and says
 * what it did. It never prints and never exits. A complete use:
 *
 *     limn_baker *baker = limn_baker_create(&(limn_bake_desc){.weights = LIMN_WEIGHTS_WARREN});
 *     if (limn_baker_add_file(baker, "hero.obj") != LIMN_BAKE_OK ||
 *         limn_baker_write(baker, "hero.limn") != LIMN_BAKE_OK)
 *         fprintf(stderr, "%s\n", limn_baker_error(baker));
 *     limn_baker_destroy(baker);
 */
#ifndef LIMN_BAKE_H
#define LIMN_BAKE_H

#include "limn/limn.h"

#ifdef __cplusplus
extern "C" {
#endif

// -------------------------------------------------------------------------------------------------
// Options of the baker

/// Whether a call succeeded, and if not, the kind of error: limn_baker_error() says which one.
typedef enum limn_bake_status {
    LIMN_BAKE_OK,
    LIMN_BAKE_BAD_INPUT, ///< the mesh cannot be baked; the text names the file, line, face or edge
    LIMN_BAKE_IO,        ///< a file could not be read or written
    LIMN_BAKE_MEMORY,    ///< out of memory
    LIMN_BAKE_INTERNAL,  ///< the baker's own check failed: a defect; nothing was written
} limn_bake_status;

/// What the surface is that a mesh stands for.
typedef enum limn_scheme {
    LIMN_SCHEME_LOOP,      ///< Loop subdivision, of triangles: other polygons are cut
    LIMN_SCHEME_CATMARK,   ///< Catmull-Clark subdivision, of any polygons
    LIMN_SCHEME_BUTTERFLY, ///< the modified butterfly, of triangles: the surface goes through the
                           ///< control points; without creases
    LIMN_SCHEME_NONE ///< the faces themselves, for props that go through the same pipeline: flat
                     ///< triangles, or where there are other polygons, bilinear
} limn_scheme;

/// Vertex weights of Loop subdivision.
typedef enum limn_weights {
    LIMN_WEIGHTS_LOOP,  ///< Loop's own, from the cosine of the valence
    LIMN_WEIGHTS_WARREN ///< Warren's: 3/8 in all on the neighbours, 9/16 at valence 3
} limn_weights;

/// What happens at the boundary. Boundary edges give cubic B-spline curves, with Lomont's rules
/// between vertices of three faces only.
typedef enum limn_boundary {
    LIMN_BOUNDARY_DEFAULT,         ///< what the mesh or its file asks for; otherwise edge-only
    LIMN_BOUNDARY_EDGE_ONLY,       ///< corners of the boundary are rounded
    LIMN_BOUNDARY_EDGE_AND_CORNER, ///< a boundary vertex with a single face stays where it is
    LIMN_BOUNDARY_NONE ///< faces at a boundary are holes, unless all boundary edges are sharp there
} limn_boundary;

/// What sharp edges and vertices mean, and boundaries, whose edges are sharp for ever.
typedef enum limn_creases {
    LIMN_CREASES_OPENSUBDIV, ///< also for files in Lomont's format, with a note
    LIMN_CREASES_LOMONT      ///< those of "High Performance Subdivision Surfaces"
} limn_creases;

/// How the sharpness of an edge passes on to its halves, level by level, with OpenSubdiv's rules;
/// with Lomont's it falls by 1: Chaikin's method is refused here, and ignored with a note where a
/// mesh asks for it.
typedef enum limn_creasing {
    LIMN_CREASING_DEFAULT, ///< what the mesh or its file asks for; otherwise uniform
    LIMN_CREASING_UNIFORM, ///< it falls by 1
    LIMN_CREASING_CHAIKIN  ///< it is first averaged with that of the creases it meets
} limn_creasing;

/// What is stored for normals.
typedef enum limn_normals {
    LIMN_NORMALS_NONE, ///< positions only
    LIMN_NORMALS_EXACT ///< two tangents of the limit surface per row: tables three times as large
} limn_normals;

/// Whether patches are evaluated in pieces, the four faces that one level of subdivision makes of a
/// base face. Its points are then evaluated first, once a frame (limn_mesh_refine()), and tables
/// are few and small, however many kinds of surroundings the faces of a mesh have.
typedef enum limn_isolate {
    LIMN_ISOLATE_NEVER,  ///< a table for every kind of surroundings: the fewest steps for a patch
    LIMN_ISOLATE_ALWAYS, ///< small tables
    LIMN_ISOLATE_AUTO    ///< for each mesh whose tables would take more than 256 KB, if its bytes
                         ///< times its time become less; never with the butterfly. Says why. The
                         ///< time is counted, so the same mesh gives the same file everywhere
} limn_isolate;

/// Where a channel is interpolated linearly, as OpenSubdiv has it for face-varying data. A corner is a
/// value that stays where it is; a seam is where faces do not share their values.
typedef enum limn_face_varying {
    LIMN_FACE_VARYING_DEFAULT,       ///< corners-only; texture coordinates with the butterfly: all
    LIMN_FACE_VARYING_NONE,          ///< nowhere: seams and boundaries are smooth curves
    LIMN_FACE_VARYING_CORNERS_ONLY,  ///< corners are what a single face has, and where seams end
                                     ///< in one another
    LIMN_FACE_VARYING_CORNERS_PLUS1, ///< and where three values or more meet
    LIMN_FACE_VARYING_CORNERS_PLUS2, ///< and the ends of seams, and both values where one is a corner
    LIMN_FACE_VARYING_BOUNDARIES,    ///< seams and boundaries are linear
    LIMN_FACE_VARYING_ALL            ///< everywhere
} limn_face_varying;

/// What may be mended, as bits. Done in this order.
typedef enum limn_repair {
    LIMN_REPAIR_WELD = 1 << 0, ///< merge control points whose positions are equal, and values of
                               ///< channels that are
    LIMN_REPAIR_DROP = 1 << 1, ///< drop faces that use a control point twice or repeat another face
    LIMN_REPAIR_ALL = 3
} limn_repair;

/// What happens where faces do not form a surface: at edges that more than two faces share or two
/// run along in the same direction, and at vertices around which faces are not one chain.
typedef enum limn_non_manifold {
    LIMN_NON_MANIFOLD_REFUSE, ///< an error that names the edge or vertex
    LIMN_NON_MANIFOLD_SPLIT   ///< as OpenSubdiv does, these edges are sharp and these vertices are
                              ///< corners. Each sheet there gets control points of its own, which
                              ///< come side by side and must be moved together; later ones move up
} limn_non_manifold;

/// A notice: triangulated polygons, unused control points, repairs. `text` is valid during the
/// call.
typedef void limn_bake_note_fn(void *user, const char *text);

/// Progress of a step, `done` of `total` faces. Called at most a few hundred times per mesh.
typedef void limn_bake_progress_fn(void *user, const char *step, uint32_t done, uint32_t total);

/// Zero means default, everywhere.
typedef struct limn_bake_desc {
    limn_scheme scheme;
    limn_weights weights;
    float tension; ///< of the butterfly's ten points, w: -1/4 to 1/4
    limn_boundary boundary;
    limn_creases creases;
    limn_creasing creasing;
    limn_normals normals;
    limn_isolate isolate;
    limn_face_varying face_varying; ///< of all channels; without a scheme they are linear
    bool no_channels;               ///< leaves out what meshes have
    bool images;                    ///< store the images of materials, not only their names
    uint32_t repair;                ///< LIMN_REPAIR_… bits; 0: refuse bad faces
    limn_non_manifold non_manifold;
    limn_bake_note_fn *note;
    limn_bake_progress_fn *progress;
    void *user; ///< passed to the callbacks
} limn_bake_desc;

// -------------------------------------------------------------------------------------------------
// Meshes to bake

/// Values that belong to the corners of faces.
typedef struct limn_bake_channel {
    const char *name; ///< such as "uv"; NULL: "channel"
    limn_channel_kind kind;
    uint32_t component_count; ///< 1 to 3
    const float *values;      ///< [value_count][component_count]
    uint32_t value_count;
    const uint32_t *corner_values; ///< one for each of the face_indices
} limn_bake_channel;

/// A polygon mesh in memory, with what OpenSubdiv calls tags. Zero stands for no tags.
///
/// Sharpness is 0 (smooth) or more, by level; from 10 on, infinity included, it is for ever. Of
/// several tags of one edge or vertex the last one counts.
typedef struct limn_bake_mesh {
    const char *name;
    const float *positions; ///< [position_count][3], model units, at most 1e37
    uint32_t position_count;
    const uint32_t *face_sizes; ///< [face_count] corners of each face, at least 3; NULL: triangles
    uint32_t face_count;
    const uint32_t
        *face_indices; ///< the corners of all faces, one after the other, counter-clockwise
    const uint32_t *crease_edges;   ///< [crease_count][2] the ends of edges of faces
    const float *crease_sharpness;  ///< [crease_count]
    const uint32_t *sharp_vertices; ///< [sharp_vertex_count]
    const float *vertex_sharpness;  ///< [sharp_vertex_count]
    const uint32_t *holes; ///< [hole_count] faces that shape their neighbours but are not drawn
    uint32_t crease_count, sharp_vertex_count, hole_count;
    const limn_bake_channel *channels; ///< [channel_count]
    uint32_t channel_count;
    limn_boundary boundary; ///< asked for, unless limn_bake_desc says otherwise
    limn_creasing creasing; ///< likewise
} limn_bake_mesh;

// -------------------------------------------------------------------------------------------------
// Baking

/// What bakes one file: opaque.
typedef struct limn_baker limn_baker;

/// A baker for one file. NULL desc: defaults. Options that do nothing with the scheme, or contradict
/// one another, are an error: limn_baker_error() says which, and the baker can only be destroyed.
/// Returns NULL only when out of memory; limn_baker_error() and limn_baker_destroy() take NULL. Any
/// thread; one thread at a time.
limn_baker *limn_baker_create(const limn_bake_desc *desc);

/// Frees a baker, and the blob that belongs to it.
void limn_baker_destroy(limn_baker *baker);

/// Adds the mesh in an .obj, .off or .ply file, named after the file; or of a .gltf, .glb, .fbx or
/// .dae file all meshes of its scene, named after their nodes, with skeleton, clips and materials.
/// FBX and Collada are first tried in a process that is forked for it, as assimp may abort over a
/// file. After an error the baker can only be destroyed.
limn_bake_status limn_baker_add_file(limn_baker *baker, const char *path);

/// Adds a mesh from memory, copying it. Errors name faces and vertices by index from 0. Tags of
/// edges, vertices and faces that are not there are ignored, with a note.
limn_bake_status limn_baker_add_mesh(limn_baker *baker, const limn_bake_mesh *mesh);

/// Bakes all meshes into one blob that belongs to the baker, 64-byte aligned. It is valid until a
/// mesh is added or the baker destroyed.
limn_bake_status limn_baker_finish(limn_baker *baker, const void **blob, size_t *blob_size);

/// The same, into a file: written aside and renamed, so that `path` holds either the old file or
/// the whole new one.
limn_bake_status limn_baker_write(limn_baker *baker, const char *path);

/// The text of the last error; "" if there was none. Valid until the next call with this baker.
const char *limn_baker_error(const limn_baker *baker);

#ifdef __cplusplus
}
#endif

#endif
