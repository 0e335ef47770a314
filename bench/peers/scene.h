/* SPDX-License-Identifier: MIT */
/* One mesh as all peers get it, and what they have in common. */
#ifndef SCENE_H
#define SCENE_H

#include "team.h"
#include "topology.h"

#include "limn/bake.h"
#include "limn/limn.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SCENE_BONE_COUNT 32
#define SCENE_NO_VERTEX 0xffffffffu

/// A rigid transformation as four columns, each padded to four floats.
typedef float scene_bone[16];

/// A .limn file in memory.
typedef struct scene_baked {
    const void *blob;
    size_t blob_size;
    double ms;                ///< that baking took
    struct limn_baker *baker; ///< owns the blob
} scene_baked;

/// How meshes are read and subdivided, and by how many threads.
typedef struct scene_desc {
    limn_scheme scheme; ///< Loop's or Catmull-Clark's
    uint32_t level;
    uint32_t thread_count;
    bool isolated; ///< Limn with limn_mesh_refine() and small tables
} scene_desc;

/// A patch is a face, with corner c of the face as corner c; or where a mesh of Catmull-Clark has
/// faces that are not quads, for all faces what one step of subdivision makes at each of their
/// corners, as topology_refine_quads() does.
typedef struct peer_scene {
    char name[64];
    limn_scheme scheme;
    uint32_t level;
    uint32_t row_count;                                      ///< of a patch at that level
    uint16_t row_at[LIMN_GRID_SIZE + 1][LIMN_GRID_SIZE + 1]; ///< the row at grid point i, j
    const limn_domain *domain;
    float (*controls)[3]; ///< [control_count]
    uint32_t control_count;
    uint32_t *face_sizes;   ///< [face_count] in the order of the file
    uint32_t *face_corners; ///< of all faces, one after the other
    uint32_t face_count;
    bool divided; ///< whether a patch is a part of a face
    uint32_t patch_count;

    scene_baked baked, baked_with_normals;

    /// [patch_count][row_count] vertices of the refined mesh, numbered as by topology_refine_…().
    uint32_t *refined;
    /// [patch_count][row_count] the same, numbered as the rows of one patch after the other first
    /// meet them.
    uint32_t *unique;
    uint32_t unique_count;
    uint32_t *unique_rows; ///< [unique_count] patch * row_count + row where it is first met

    scene_bone *bones; ///< [SCENE_BONE_COUNT]
    team *threads;     ///< NULL: one thread only
} peer_scene;

/// Reads, repairs and bakes a mesh. False after a message; destroy it all the same.
bool scene_create(peer_scene *scene, const char *path, const scene_desc *desc);
void scene_destroy(peer_scene *scene);

/// One level of a mesh that is baked, for peers that need no other baked form; of one thread. False
/// after a message; destroy it all the same.
bool scene_create_baked(peer_scene *scene, const limn_mesh *mesh, uint32_t level);

/// The unique vertex at a row of a patch of that mesh.
uint32_t scene_vertex(const peer_scene *scene, const limn_mesh *mesh, uint32_t patch, uint32_t row);

topology scene_topology(const peer_scene *scene);

/// How often the mesh is refined: once more than the patches where they are parts of faces.
uint32_t scene_refinement_count(const peer_scene *scene);

/// The row of a patch that is row `row` of Limn's patch there, of which corner c is corner
/// c + rotation of the former.
uint32_t scene_row(const peer_scene *scene, uint32_t row, uint32_t rotation);

/// Makes all bones equal, a rotation and a shift, so that skinning any points with any weights
/// moves them rigidly; or all different.
void scene_set_bones(peer_scene *scene, bool equal);

/// Numbers in [0, 1), the same in every run.
float scene_random(uint32_t *seed);

#ifdef __cplusplus
}
#endif

#endif
