/* SPDX-License-Identifier: MIT */
/* Views of characters, in files that have been checked (pack_character.c). */
#include "limn/character.h"

#include "chunks.h"
#include "require.h"

LIMN_STATIC_ASSERT(LIMN_NONE == LIMN_FORMAT_NONE, "views pass on what the file says");

/// Records of a chunk of the file, or of a mesh; 0 where there is none.
static uint32_t record_count(const limn_pack *pack, uint32_t mesh, uint32_t kind, size_t size) {
    const limn_file_chunk *const chunk = find_chunk(pack, mesh, kind);
    return chunk ? (uint32_t)(chunk->size / size) : 0;
}

static const char *string_at(const limn_pack *pack, uint32_t offset) {
    return (const char *)chunk_data(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_STRINGS) + offset;
}

limn_skeleton limn_pack_skeleton(const limn_pack *pack) {
    LIMNI_REQUIRE(pack, (limn_skeleton){0});
    const uint32_t none = LIMN_FORMAT_NO_MESH;
    return (limn_skeleton){
        .joint_count = record_count(pack, none, LIMN_CHUNK_SKELETON, sizeof(limn_file_joint)),
        .joints = optional_data(pack, none, LIMN_CHUNK_SKELETON),
        .strings = optional_data(pack, none, LIMN_CHUNK_STRINGS),
    };
}

limn_joint limn_skeleton_joint(const limn_skeleton *skeleton, uint32_t joint) {
    LIMNI_REQUIRE(skeleton && joint < skeleton->joint_count, (limn_joint){0});
    const limn_file_joint *const record = &skeleton->joints[joint];
    return (limn_joint){
        .name = skeleton->strings + record->name,
        .parent = record->parent,
        .translation = record->translation,
        .rotation = record->rotation,
        .scale = record->scale,
        .inverse_bind = record->inverse_bind[0],
    };
}

uint32_t limn_pack_clip_count(const limn_pack *pack) {
    LIMNI_REQUIRE(pack, 0);
    return record_count(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLIPS, sizeof(limn_file_clip));
}

limn_clip limn_pack_clip(const limn_pack *pack, uint32_t clip) {
    LIMNI_REQUIRE(pack && clip < limn_pack_clip_count(pack), (limn_clip){0});
    const uint32_t none = LIMN_FORMAT_NO_MESH;
    const limn_file_clip *const record =
        (const limn_file_clip *)chunk_data(pack, none, LIMN_CHUNK_CLIPS) + clip;
    const limn_file_track *const tracks = optional_data(pack, none, LIMN_CHUNK_TRACKS);
    return (limn_clip){
        .name = string_at(pack, record->name),
        .duration = record->duration,
        .track_count = record->track_count,
        .tracks = tracks ? tracks + record->first_track : NULL,
        .keys = optional_data(pack, none, LIMN_CHUNK_KEYS),
    };
}

limn_skin limn_mesh_skin(const limn_pack *pack, uint32_t mesh_index) {
    LIMNI_REQUIRE(pack && mesh_index < pack->mesh_count, (limn_skin){0});
    const uint32_t count = record_count(pack, mesh_index, LIMN_CHUNK_INFLUENCES, sizeof(float));
    if (count == 0) return (limn_skin){0};
    const limn_file_mesh *const record = chunk_data(pack, mesh_index, LIMN_CHUNK_MESH);
    return (limn_skin){
        .point_count = record->control_count,
        .joint_count = limn_pack_skeleton(pack).joint_count,
        .influence_count = count / record->control_count,
        .joints = chunk_data(pack, mesh_index, LIMN_CHUNK_JOINTS),
        .weights = chunk_data(pack, mesh_index, LIMN_CHUNK_INFLUENCES),
        .kernels = pack->kernels,
    };
}

limn_morph_targets limn_mesh_morph_targets(const limn_pack *pack, uint32_t mesh_index) {
    LIMNI_REQUIRE(pack && mesh_index < pack->mesh_count, (limn_morph_targets){0});
    const limn_file_mesh *const record = chunk_data(pack, mesh_index, LIMN_CHUNK_MESH);
    const uint32_t count =
        record_count(pack, mesh_index, LIMN_CHUNK_TARGETS, sizeof(limn_file_target));
    if (count == 0) return (limn_morph_targets){0};
    return (limn_morph_targets){
        .point_count = record->control_count,
        .target_count = count,
        .first = chunk_data(pack, mesh_index, LIMN_CHUNK_TARGET_FIRST),
        .points = chunk_data(pack, mesh_index, LIMN_CHUNK_TARGET_POINTS),
        .deltas = chunk_data(pack, mesh_index, LIMN_CHUNK_TARGET_DELTAS),
    };
}

static const limn_file_target *targets_of(const limn_pack *pack, uint32_t mesh_index) {
    return optional_data(pack, mesh_index, LIMN_CHUNK_TARGETS);
}

const char *limn_mesh_morph_name(const limn_pack *pack, uint32_t mesh_index, uint32_t target) {
    LIMNI_REQUIRE(pack && mesh_index < pack->mesh_count, "");
    LIMNI_REQUIRE(target < limn_mesh_morph_targets(pack, mesh_index).target_count, "");
    return string_at(pack, targets_of(pack, mesh_index)[target].name);
}

uint32_t limn_pack_material_count(const limn_pack *pack) {
    LIMNI_REQUIRE(pack, 0);
    return record_count(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_MATERIALS,
                        sizeof(limn_file_material));
}

limn_material limn_pack_material(const limn_pack *pack, uint32_t material) {
    LIMNI_REQUIRE(pack && material < limn_pack_material_count(pack), (limn_material){0});
    const uint32_t none = LIMN_FORMAT_NO_MESH;
    const limn_file_material *const record =
        (const limn_file_material *)chunk_data(pack, none, LIMN_CHUNK_MATERIALS) + material;
    limn_material result = {.name = string_at(pack, record->name),
                            .texture_channel = record->texture_channel};
    memcpy(result.base_colour, record->base_colour, sizeof result.base_colour);
    if (record->image == LIMN_FORMAT_NONE) return result;
    const limn_file_image *const image =
        (const limn_file_image *)chunk_data(pack, none, LIMN_CHUNK_IMAGES) + record->image;
    result.image_name = string_at(pack, image->name);
    result.image_size = (size_t)image->size;
    if (image->size)
        result.image_bytes =
            (const char *)chunk_data(pack, none, LIMN_CHUNK_IMAGE_BYTES) + image->offset;
    return result;
}

uint32_t limn_mesh_material_range_count(const limn_pack *pack, uint32_t mesh_index) {
    LIMNI_REQUIRE(pack && mesh_index < pack->mesh_count, 0);
    return record_count(pack, mesh_index, LIMN_CHUNK_RANGES, sizeof(limn_file_range));
}

limn_material_range limn_mesh_material_range(const limn_pack *pack, uint32_t mesh_index,
                                             uint32_t range) {
    LIMNI_REQUIRE(pack && mesh_index < pack->mesh_count, (limn_material_range){0});
    LIMNI_REQUIRE(range < limn_mesh_material_range_count(pack, mesh_index),
                  (limn_material_range){0});
    const limn_file_range *const record =
        (const limn_file_range *)chunk_data(pack, mesh_index, LIMN_CHUNK_RANGES) + range;
    return (limn_material_range){record->material, record->first_patch, record->patch_count};
}
