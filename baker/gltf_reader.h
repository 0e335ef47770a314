/* SPDX-License-Identifier: MIT */
/*
 * From a glTF document to sources and characters. Steps, in this order: nodes, skeleton, meshes
 * (with the materials that they use), clips. What cannot be used is refused, and what is passed
 * over is noted, by name.
 */
#ifndef LIMNI_GLTF_READER_H
#define LIMNI_GLTF_READER_H

#include "../runtime/transform.h"
#include "gltf.h"
#include "scene.h"

/// What a node is among the others.
typedef struct limni_gltf_place {
    uint32_t parent; ///< LIMN_FORMAT_NONE: it is a root
    bool in_scene;
    bool moves;             ///< an animation moves it, or what it hangs on
    bool needed;            ///< as a joint
    limni_transform global; ///< at rest
    uint32_t joint;         ///< that stands for the node; LIMN_FORMAT_NONE: none does
    uint32_t mesh;          ///< of the bake; LIMN_FORMAT_NONE: it has none
} limni_gltf_place;

typedef struct limni_gltf_reader {
    limni_context *context;
    const limni_gltf *document;
    const char *file_name; ///< for meshes without a name
    limni_scene *scene;
    limni_gltf_place *places; ///< [node_count]
    uint32_t *order;          ///< [node_count] all nodes, depth first
    uint32_t **skin_joints;   ///< [skin_count][joint_count] joints of the skeleton, of skins in use
    uint32_t *whole_joints;   ///< [node_count] the joint of a mesh that moves as a whole, or
                              ///< LIMN_FORMAT_NONE
    uint32_t *materials, *images; ///< [material_count], [image_count] as they are in the file;
                                  ///< LIMN_FORMAT_NONE: not yet
} limni_gltf_reader;

/// "mesh 3 'body'". Returns `text`.
typedef char limni_gltf_label[96];
const char *limni_gltf_name(limni_gltf_label text, const char *what, uint32_t index,
                            const char *name);

limn_bake_status limni_gltf_read_nodes(limni_gltf_reader *reader);
limn_bake_status limni_gltf_read_skeleton(limni_gltf_reader *reader);
limn_bake_status limni_gltf_read_meshes(limni_gltf_reader *reader);
limn_bake_status limni_gltf_read_clips(limni_gltf_reader *reader);

/// The material of a primitive as the file has it, added when it is first asked for.
limn_bake_status limni_gltf_find_material(limni_gltf_reader *reader, int index, uint32_t *material);

// ---- Transforms

/// Where a node is, relative to its parent.
limni_transform limni_gltf_local(const limni_gltf_node *node);
double limni_transform_determinant(const limni_transform *t);
/// False where it has no inverse to speak of.
bool limni_transform_invert(const limni_transform *t, limni_transform *inverse);
/// Scales and turns; false where there is shear, which is lost.
bool limni_transform_decompose(const limni_transform *t, double translation[3], double rotation[4],
                               double scale[3]);
/// Rounds to floats; false where one is not finite.
bool limni_transform_round(const limni_transform *t, float rows[3][4]);

// ---- Accessors

/// An accessor that is about to be read, checked against its buffer.
///
/// what   for messages: "POSITION of mesh 0 'body', primitive 1"
limn_bake_status limni_gltf_find_accessor(const limni_gltf_reader *reader, int index,
                                          const char *what, const limni_gltf_accessor **accessor);

/// Elements as floats; integers as numbers, or normalised. Fails where the accessor has another
/// shape, lies outside its buffer or holds what is not finite.
///
/// count  how many elements it must have
/// out    [count][component_count]
limn_bake_status limni_gltf_read_floats(const limni_gltf_reader *reader, int index,
                                        const char *what, uint64_t count, uint32_t component_count,
                                        float *out);

/// The same of unsigned integers.
limn_bake_status limni_gltf_read_integers(const limni_gltf_reader *reader, int index,
                                          const char *what, uint64_t count,
                                          uint32_t component_count, uint32_t *out);

#endif
