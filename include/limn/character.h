/* SPDX-License-Identifier: MIT */
/*
 * Characters: the skeleton of a .limn file, its animation clips and materials, and of each mesh its
 * skin, morph targets and ranges of materials. limn_pack_open() has checked all of it. A frame of a
 * mesh, from bind pose to control points:
 *
 *     limn_skeleton skeleton = limn_pack_skeleton(&pack);
 *     limn_clip clip = limn_pack_clip(&pack, 0);
 *     limn_skin skin = limn_mesh_skin(&pack, 0);
 *     limn_clip_pose(&skeleton, &clip, seconds, LIMN_WRAP_REPEAT, matrices);
 *     limn_pose pose = {.skin = &skin, .matrices = matrices};
 *     limn_pose_points(&pose, mesh.controls, 0, skin.point_count, controls);
 *
 * A mesh without a skin, whose point_count is 0, stays where it is: its controls are to be copied.
 *
 * Everything here is a view of the file and is valid for as long as the blob is. Nothing allocates
 * or keeps state; any thread.
 */
#ifndef LIMN_CHARACTER_H
#define LIMN_CHARACTER_H

#include "limn.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LIMN_NONE 0xffffffffu ///< no parent, no image, no material

// -------------------------------------------------------------------------------------------------
// Characters

/// The joints that move the meshes of a pack, of all its characters.
typedef struct limn_skeleton {
    uint32_t joint_count;                 ///< 0: the file has no skeleton
    const struct limn_file_joint *joints; ///< [joint_count], see format.h
    const char *strings;
} limn_skeleton;

/// A joint: at rest it is scaled, turned and moved, in this order, relative to its parent.
typedef struct limn_joint {
    const char *name;
    uint32_t parent;           ///< a joint before this one, or LIMN_NONE
    const float *translation;  ///< [3] model units
    const float *rotation;     ///< [4] x, y, z, w: a unit quaternion
    const float *scale;        ///< [3]
    const float *inverse_bind; ///< [3][4] rows: from the space of the points into that of the joint
} limn_joint;

/// The skeleton of a pack, empty where it has none. Never fails.
limn_skeleton limn_pack_skeleton(const limn_pack *pack);

/// Joint `joint` < skeleton->joint_count. Never fails.
limn_joint limn_skeleton_joint(const limn_skeleton *skeleton, uint32_t joint);

/// An animation of the joints and the morph targets of a pack.
typedef struct limn_clip {
    const char *name;
    float duration; ///< seconds: when the last key is
    uint32_t track_count;
    const struct limn_file_track *tracks; ///< [track_count], see format.h
    const float *keys;
} limn_clip;

/// How many clips there are. Never fails.
uint32_t limn_pack_clip_count(const limn_pack *pack);

/// Clip `clip` < limn_pack_clip_count(). Never fails.
limn_clip limn_pack_clip(const limn_pack *pack, uint32_t clip);

/// What a clip shows before its start and after its end. Before its first key and after its last, a
/// track has their values.
typedef enum limn_wrap {
    LIMN_WRAP_CLAMP, ///< its first and its last moment
    LIMN_WRAP_REPEAT ///< itself again
} limn_wrap;

/// The matrices of a skeleton in one moment of a clip, as limn_pose_points() takes them: for each
/// joint where it is, in the space of the file, times its inverse bind matrix. Joints that the clip
/// does not move are as at rest. Between keys, rotations take the shorter way on the sphere, or of
/// cubic ones are normalised. In double precision until the end; rotations depend on the acos and
/// sin of the C library. Takes some 32 KB of stack. Never fails.
///
/// clip      of the same pack; NULL: the skeleton at rest
/// time      seconds, finite
/// matrices  out: [skeleton->joint_count][3][4]
void limn_clip_pose(const limn_skeleton *skeleton, const limn_clip *clip, float time,
                    limn_wrap wrap, float *matrices);

/// Which joints move the control points of mesh `mesh_index` < pack->mesh_count: those of
/// limn_pack_skeleton(). Without a skin, point_count is 0: the mesh stays where it is. Never fails.
limn_skin limn_mesh_skin(const limn_pack *pack, uint32_t mesh_index);

/// The morph targets of a mesh; target_count 0: it has none. Never fails.
limn_morph_targets limn_mesh_morph_targets(const limn_pack *pack, uint32_t mesh_index);

/// The name of morph target `target` < target_count of a mesh. Never fails.
const char *limn_mesh_morph_name(const limn_pack *pack, uint32_t mesh_index, uint32_t target);

/// The weights of the morph targets of a mesh in one moment of a clip, as limn_morph_points() takes
/// them. Never fails.
///
/// clip     of the pack; NULL: the weights at rest
/// time     seconds, finite
/// weights  out: [target_count]
void limn_clip_morph_weights(const limn_pack *pack, uint32_t mesh_index, const limn_clip *clip,
                             float time, limn_wrap wrap, float *weights);

// -------------------------------------------------------------------------------------------------
// Materials

/// A material: a colour, which a texture is multiplied with.
typedef struct limn_material {
    const char *name;
    float base_colour[4];    ///< linear, with alpha
    const char *image_name;  ///< of the texture: a path or a name; NULL: there is none
    const void *image_bytes; ///< [image_size] PNG or JPEG as it was, in sRGB, its first row where
                             ///< v is 0; NULL: it is not in the file
    size_t image_size;
    uint32_t texture_channel; ///< of its texture coordinates, n of TEXCOORD_n in glTF
} limn_material;

/// How many materials there are. Never fails.
uint32_t limn_pack_material_count(const limn_pack *pack);

/// Material `material` < limn_pack_material_count(). Never fails.
limn_material limn_pack_material(const limn_pack *pack, uint32_t material);

/// Consecutive patches of one material.
typedef struct limn_material_range {
    uint32_t material; ///< or LIMN_NONE
    uint32_t first_patch, patch_count;
} limn_material_range;

/// How many ranges the patches of a mesh have. They follow one another and cover all patches; or
/// there are none, where materials are not said. Never fails.
uint32_t limn_mesh_material_range_count(const limn_pack *pack, uint32_t mesh_index);

/// Range `range` < limn_mesh_material_range_count() of a mesh. Never fails.
limn_material_range limn_mesh_material_range(const limn_pack *pack, uint32_t mesh_index,
                                             uint32_t range);

#ifdef __cplusplus
}
#endif

#endif
