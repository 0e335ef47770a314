/* SPDX-License-Identifier: MIT */
/* All that a file has to bake: of most formats one mesh, of glTF, FBX and
 * Collada several and their characters. */
#ifndef LIMNI_SCENE_H
#define LIMNI_SCENE_H

#include "character.h"
#include "source.h"

typedef struct limni_scene {
    limni_source *sources; ///< [source_count], at least one
    uint32_t source_count;
    uint32_t first_mesh;        ///< in: the index of the first source among all meshes of the bake
    limni_character *character; ///< in: what joints, clips and materials are appended to
} limni_scene;

/// Reads a file by its extension, .obj, .off, .ply, .gltf, .glb, .fbx or .dae (in any case). The
/// arrays belong to the context.
limn_bake_status limni_read_scene(limni_context *context, const char *path, limni_scene *scene);

/// A glTF document, and what lies beside `path`.
///
/// name  of the file, for meshes without one
limn_bake_status limni_read_gltf(limni_context *context, const char *path, const char *name,
                                 const char *bytes, size_t size, limni_scene *scene);

/// An FBX document, if `path` ends with .fbx, else a Collada document; and what lies beside it.
limn_bake_status limni_read_assimp(limni_context *context, const char *path, const char *name,
                                   const char *bytes, size_t size, limni_scene *scene);

#endif
