/* SPDX-License-Identifier: MIT */
#include "info_character.h"

#include <stdio.h>

// ---- JSON

static json_t *list_joints(const limn_pack *pack) {
    const limn_skeleton skeleton = limn_pack_skeleton(pack);
    json_t *const joints = json_array();
    for (uint32_t j = 0; j < skeleton.joint_count; j++) {
        const limn_joint joint = limn_skeleton_joint(&skeleton, j);
        json_t *const object = json_object();
        json_object_set_new(object, "name", limni_json_text(joint.name));
        json_object_set_new(object, "parent",
                            joint.parent == LIMN_NONE ? json_null() : json_integer(joint.parent));
        json_array_append_new(joints, object);
    }
    return joints;
}

static json_t *list_clips(const limn_pack *pack) {
    json_t *const clips = json_array();
    for (uint32_t c = 0; c < limn_pack_clip_count(pack); c++) {
        const limn_clip clip = limn_pack_clip(pack, c);
        json_t *const object = json_object();
        json_object_set_new(object, "name", limni_json_text(clip.name));
        json_object_set_new(object, "duration", json_real((double)clip.duration));
        json_object_set_new(object, "tracks", json_integer(clip.track_count));
        json_array_append_new(clips, object);
    }
    return clips;
}

static json_t *list_materials(const limn_pack *pack) {
    json_t *const materials = json_array();
    for (uint32_t m = 0; m < limn_pack_material_count(pack); m++) {
        const limn_material material = limn_pack_material(pack, m);
        json_t *const object = json_object(), *const colour = json_array();
        for (int i = 0; i < 4; i++)
            json_array_append_new(colour, json_real((double)material.base_colour[i]));
        json_object_set_new(object, "name", limni_json_text(material.name));
        json_object_set_new(object, "base_colour", colour);
        json_object_set_new(object, "image",
                            material.image_name ? limni_json_text(material.image_name)
                                                : json_null());
        json_object_set_new(object, "image_size", json_integer((json_int_t)material.image_size));
        json_array_append_new(materials, object);
    }
    return materials;
}

void limni_json_character(json_t *root, const limn_pack *pack) {
    json_object_set_new(root, "joints", list_joints(pack));
    json_object_set_new(root, "clips", list_clips(pack));
    json_object_set_new(root, "materials", list_materials(pack));
}

void limni_json_rig(json_t *mesh, const limn_pack *pack, uint32_t mesh_index) {
    json_t *const targets = json_array(), *const ranges = json_array();
    for (uint32_t t = 0; t < limn_mesh_morph_targets(pack, mesh_index).target_count; t++)
        json_array_append_new(targets, limni_json_text(limn_mesh_morph_name(pack, mesh_index, t)));
    for (uint32_t r = 0; r < limn_mesh_material_range_count(pack, mesh_index); r++) {
        const limn_material_range range = limn_mesh_material_range(pack, mesh_index, r);
        json_t *const object = json_object();
        json_object_set_new(object, "material",
                            range.material == LIMN_NONE ? json_null()
                                                        : json_integer(range.material));
        json_object_set_new(object, "patches", json_integer(range.patch_count));
        json_array_append_new(ranges, object);
    }
    json_object_set_new(mesh, "influences",
                        json_integer(limn_mesh_skin(pack, mesh_index).influence_count));
    json_object_set_new(mesh, "morph_targets", targets);
    json_object_set_new(mesh, "materials", ranges);
}

// ---- Text

static void print_rigs(const limn_pack *pack) {
    bool any = false;
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const uint32_t influences = limn_mesh_skin(pack, m).influence_count;
        const uint32_t targets = limn_mesh_morph_targets(pack, m).target_count;
        const uint32_t ranges = limn_mesh_material_range_count(pack, m);
        if (!influences && !targets && !ranges) continue;
        if (!any) printf("\n%-24s %10s %10s %10s\n", "mesh", "influences", "targets", "materials");
        any = true;
        printf("%-24s %10u %10u %10u\n", limn_pack_mesh(pack, m).name, influences, targets, ranges);
    }
}

static void print_clips(const limn_pack *pack) {
    const uint32_t joint_count = limn_pack_skeleton(pack).joint_count;
    const uint32_t clip_count = limn_pack_clip_count(pack);
    if (joint_count) printf("\na skeleton of %u joints\n", joint_count);
    if (clip_count) printf("\n%-24s %10s %10s\n", "clip", "seconds", "tracks");
    for (uint32_t c = 0; c < clip_count; c++) {
        const limn_clip clip = limn_pack_clip(pack, c);
        printf("%-24s %10.3f %10u\n", clip.name, (double)clip.duration, clip.track_count);
    }
}

static void print_materials(const limn_pack *pack) {
    const uint32_t count = limn_pack_material_count(pack);
    if (count)
        printf("\n%-24s %-24s %12s  %s\n", "material", "base colour", "image bytes", "image");
    for (uint32_t m = 0; m < count; m++) {
        const limn_material material = limn_pack_material(pack, m);
        const float *const colour = material.base_colour;
        char text[64];
        snprintf(text, sizeof text, "%.3g %.3g %.3g %.3g", (double)colour[0], (double)colour[1],
                 (double)colour[2], (double)colour[3]);
        printf("%-24s %-24s %12zu  %s\n", material.name, text, material.image_size,
               material.image_name ? material.image_name : "-");
    }
}

void limni_print_character(const limn_pack *pack) {
    print_rigs(pack);
    print_clips(pack);
    print_materials(pack);
}
