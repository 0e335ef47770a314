/* SPDX-License-Identifier: MIT */
/*
 * From a model to sources and characters. Steps, in this order: nodes, skeleton, meshes (with the
 * materials that they use), clips. What cannot be used is refused, and what is passed over is noted,
 * by name.
 */
#ifndef LIMNI_MODEL_READER_H
#define LIMNI_MODEL_READER_H

#include "../runtime/transform.h"
#include "model.h"
#include "scene.h"

/// What a node is among the others.
typedef struct limni_model_place {
    uint32_t parent; ///< LIMN_FORMAT_NONE: it is a root
    bool in_scene;
    bool moves;             ///< an animation moves it, or what it hangs on
    bool needed;            ///< as a joint
    limni_transform global; ///< at rest
    uint32_t joint;         ///< that stands for the node; LIMN_FORMAT_NONE: none does
    uint32_t mesh;          ///< of the bake; LIMN_FORMAT_NONE: it has none
} limni_model_place;

typedef struct limni_model_reader {
    limni_context *context;
    limni_model *model;
    const char *file_name; ///< for meshes without a name
    limni_scene *scene;
    limni_model_place *places; ///< [node_count]
    uint32_t *order;           ///< [node_count] all nodes, depth first
    uint32_t **skin_joints; ///< [skin_count][joint_count] joints of the skeleton, of skins in use
    uint32_t *whole_joints; ///< [node_count] the joint of a mesh that moves as a whole, or
                            ///< LIMN_FORMAT_NONE
    uint32_t *materials, *images; ///< [material_count], [image_count] as they are in the file;
                                  ///< LIMN_FORMAT_NONE: not yet
} limni_model_reader;

limn_bake_status limni_model_read_nodes(limni_model_reader *reader);
limn_bake_status limni_model_read_skeleton(limni_model_reader *reader);
limn_bake_status limni_model_read_meshes(limni_model_reader *reader);
limn_bake_status limni_model_read_clips(limni_model_reader *reader);

/// The material of a part as the file has it, added when it is first asked for.
limn_bake_status limni_model_find_material(limni_model_reader *reader, int index,
                                           uint32_t *material);

// ---- Transforms

/// Where a node is, relative to its parent.
limni_transform limni_model_local(const limni_model_node *node);
double limni_transform_determinant(const limni_transform *t);
/// False where it has no inverse to speak of.
bool limni_transform_invert(const limni_transform *t, limni_transform *inverse);
/// Scales and turns; false where there is shear, which is lost.
bool limni_transform_decompose(const limni_transform *t, double translation[3], double rotation[4],
                               double scale[3]);
/// Rounds to floats; false where one is not finite.
bool limni_transform_round(const limni_transform *t, float rows[3][4]);

#endif
