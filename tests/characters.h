/* SPDX-License-Identifier: MIT */
/* Uses all that a file has for its characters, in rooms of just the right size. */
#ifndef CHARACTERS_H
#define CHARACTERS_H

#include "limn/character.h"

#include <stdlib.h>
#include <string.h>

static inline void *character_room(size_t size) {
    void *const memory = malloc(size ? size : 1);
    if (!memory) abort();
    return memory;
}

/// Returns a number that depends on all the texts and images of a file.
static inline size_t read_texts(const limn_pack *pack) {
    const limn_skeleton skeleton = limn_pack_skeleton(pack);
    size_t sum = 0;
    for (uint32_t j = 0; j < skeleton.joint_count; j++)
        sum += strlen(limn_skeleton_joint(&skeleton, j).name);
    for (uint32_t m = 0; m < limn_pack_material_count(pack); m++) {
        const limn_material material = limn_pack_material(pack, m);
        sum += strlen(material.name);
        if (material.image_name) sum += strlen(material.image_name);
        for (size_t b = 0; material.image_bytes && b < material.image_size; b++)
            sum += ((const unsigned char *)material.image_bytes)[b];
    }
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        for (uint32_t t = 0; t < limn_mesh_morph_targets(pack, m).target_count; t++)
            sum += strlen(limn_mesh_morph_name(pack, m, t));
        for (uint32_t r = 0; r < limn_mesh_material_range_count(pack, m); r++)
            sum += limn_mesh_material_range(pack, m, r).patch_count;
    }
    return sum;
}

static inline void pose_mesh(const limn_pack *pack, uint32_t m, const limn_clip *clip, float time,
                             const float *matrices) {
    const limn_mesh mesh = limn_pack_mesh(pack, m);
    const limn_skin skin = limn_mesh_skin(pack, m);
    const limn_morph_targets targets = limn_mesh_morph_targets(pack, m);
    const size_t size = mesh.control_count * sizeof(float[3]);
    float *const points = character_room(size);
    float *const weights = character_room(targets.target_count * sizeof *weights);
    limn_clip_morph_weights(pack, m, clip, time, LIMN_WRAP_REPEAT, weights);
    if (targets.target_count)
        limn_morph_points(&targets, weights, mesh.controls, 0, targets.point_count, points);
    const limn_pose pose = {.skin = &skin, .matrices = matrices};
    if (skin.point_count) limn_pose_points(&pose, mesh.controls, 0, skin.point_count, points);
    free(points);
    free(weights);
}

static inline size_t use_character(const limn_pack *pack) {
    static const float times[] = {-1, 0, 0.4f, 1e9f};
    const limn_skeleton skeleton = limn_pack_skeleton(pack);
    float *const matrices = character_room(skeleton.joint_count * sizeof(float[12]));
    size_t sum = read_texts(pack);
    for (uint32_t c = 0; c < limn_pack_clip_count(pack); c++) {
        const limn_clip clip = limn_pack_clip(pack, c);
        sum += strlen(clip.name);
        for (size_t t = 0; t < sizeof times / sizeof *times; t++) {
            limn_clip_pose(&skeleton, &clip, times[t], (limn_wrap)(t % 2), matrices);
            for (uint32_t m = 0; m < pack->mesh_count; m++)
                pose_mesh(pack, m, &clip, times[t], matrices);
        }
    }
    limn_clip_pose(&skeleton, NULL, 0, LIMN_WRAP_CLAMP, matrices);
    for (uint32_t m = 0; m < pack->mesh_count; m++)
        pose_mesh(pack, m, NULL, 0, matrices);
    free(matrices);
    return sum;
}

#endif
