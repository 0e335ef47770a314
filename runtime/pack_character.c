/* SPDX-License-Identifier: MIT */
/*
 * The optional chunks of characters, checked as the rest is (pack.c): everything that they name
 * exists, everything that they store is finite, and nothing is stored twice, so that the time stays
 * linear.
 */
#include "character.h"

#include "chunks.h"
#include "limn/character.h"

static const uint32_t kinds_of_file[] = {
    LIMN_CHUNK_STRINGS, LIMN_CHUNK_SKELETON,  LIMN_CHUNK_CLIPS,  LIMN_CHUNK_TRACKS,
    LIMN_CHUNK_KEYS,    LIMN_CHUNK_MATERIALS, LIMN_CHUNK_IMAGES, LIMN_CHUNK_IMAGE_BYTES};
static const uint32_t kinds_of_mesh[] = {
    LIMN_CHUNK_JOINTS,        LIMN_CHUNK_INFLUENCES,    LIMN_CHUNK_TARGETS, LIMN_CHUNK_TARGET_FIRST,
    LIMN_CHUNK_TARGET_POINTS, LIMN_CHUNK_TARGET_DELTAS, LIMN_CHUNK_RANGES};

bool limni_is_character_chunk(const limn_file_chunk *chunk) {
    const bool of_file = chunk->mesh == LIMN_FORMAT_NO_MESH;
    const uint32_t *const kinds = of_file ? kinds_of_file : kinds_of_mesh;
    const size_t size = of_file ? sizeof kinds_of_file : sizeof kinds_of_mesh;
    for (size_t k = 0; k < size / sizeof *kinds; k++) {
        if (kinds[k] == chunk->kind) return true;
    }
    return false;
}

/// How many records a chunk of the file has; 0 where there is none.
static limn_result count_records(const limn_pack *pack, uint32_t kind, size_t record_size,
                                 limn_result error, uint32_t *count) {
    const limn_file_chunk *const chunk = find_chunk(pack, LIMN_FORMAT_NO_MESH, kind);
    *count = 0;
    if (!chunk) return LIMN_OK;
    if (chunk->size % record_size != 0 || chunk->size / record_size >= LIMN_FORMAT_NONE)
        return error;
    *count = (uint32_t)(chunk->size / record_size);
    return LIMN_OK;
}

/// The strings are a chunk whose last byte is 0, so each place in it starts a text.
static uint32_t strings_size(const limn_pack *pack) {
    const limn_file_chunk *const chunk = find_chunk(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_STRINGS);
    return chunk && chunk->size < LIMN_FORMAT_NONE ? (uint32_t)chunk->size : 0;
}

static limn_result validate_strings(const limn_pack *pack) {
    const limn_file_chunk *const chunk = find_chunk(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_STRINGS);
    if (!chunk) return LIMN_OK;
    const uint32_t size = strings_size(pack);
    return size && *bytes_at(pack, chunk->offset + size - 1) == '\0' ? LIMN_OK : LIMN_ERROR_TEXT;
}

// ---- Skeleton

/// From the joint before, its parent is reached by going up. What is passed is not passed again, so
/// this is linear in all.
static limn_result validate_joints(const limn_file_joint *joints, uint32_t count,
                                   uint32_t name_end) {
    uint32_t depth = 0; // of the joint before, from 1
    for (uint32_t j = 0; j < count; j++) {
        uint32_t above = j ? j - 1 : LIMN_FORMAT_NONE;
        for (; above != LIMN_FORMAT_NONE && above != joints[j].parent; depth--)
            above = joints[above].parent;
        if (above != joints[j].parent || ++depth > LIMN_FORMAT_DEPTH_OF_JOINTS ||
            joints[j].name >= name_end || !all_finite(joints[j].translation, 3 + 4 + 3 + 12))
            return LIMN_ERROR_SKELETON;
    }
    return LIMN_OK;
}

static limn_result validate_skeleton(const limn_pack *pack) {
    uint32_t count;
    TRY(count_records(pack, LIMN_CHUNK_SKELETON, sizeof(limn_file_joint), LIMN_ERROR_SKELETON,
                      &count));
    if (count > UINT16_MAX + 1u) return LIMN_ERROR_SKELETON;
    const limn_skeleton skeleton = limn_pack_skeleton(pack);
    return validate_joints(skeleton.joints, count, strings_size(pack));
}

// ---- Clips

static uint32_t width_of(const limn_pack *pack, const limn_file_track *track) {
    if (track->path != LIMN_FORMAT_TARGET_WEIGHTS)
        return track->path == LIMN_FORMAT_ROTATION ? 4 : 3;
    return limn_mesh_morph_targets(pack, track->target).target_count;
}

static bool do_ascend(const float *times, uint32_t count) {
    bool ascend = true;
    for (uint32_t k = 1; k < count; k++)
        ascend &= times[k] > times[k - 1];
    return ascend;
}

/// key  where its keys must begin, then where they end
static limn_result validate_track(const limn_pack *pack, const limn_file_track *track,
                                  uint32_t joint_count, const float *keys, uint64_t key_end,
                                  uint64_t *key) {
    const bool of_mesh = track->path == LIMN_FORMAT_TARGET_WEIGHTS;
    if (track->path > LIMN_FORMAT_TARGET_WEIGHTS || track->interpolation > LIMN_FORMAT_CUBIC ||
        track->target >= (of_mesh ? pack->mesh_count : joint_count) ||
        track->width != width_of(pack, track) || track->width == 0 || track->key_count == 0 ||
        track->first_key != *key)
        return LIMN_ERROR_CLIP;
    const uint64_t parts = track->interpolation == LIMN_FORMAT_CUBIC ? 3 : 1;
    const uint64_t room = key_end - *key;
    if ((uint64_t)track->key_count * (1 + parts * track->width) > room) return LIMN_ERROR_CLIP;
    if (!do_ascend(keys + *key, track->key_count)) return LIMN_ERROR_CLIP;
    *key += track->key_count * (1 + parts * track->width);
    return LIMN_OK;
}

static limn_result validate_clips(const limn_pack *pack) {
    uint32_t clip_count, track_count, key_count, track = 0;
    uint64_t key = 0;
    TRY(count_records(pack, LIMN_CHUNK_CLIPS, sizeof(limn_file_clip), LIMN_ERROR_CLIP,
                      &clip_count));
    TRY(count_records(pack, LIMN_CHUNK_TRACKS, sizeof(limn_file_track), LIMN_ERROR_CLIP,
                      &track_count));
    TRY(count_records(pack, LIMN_CHUNK_KEYS, sizeof(float), LIMN_ERROR_CLIP, &key_count));
    const limn_file_clip *const clips = optional_data(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLIPS);
    const limn_file_track *const tracks =
        optional_data(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TRACKS);
    const float *const keys = optional_data(pack, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_KEYS);
    const uint32_t joint_count = limn_pack_skeleton(pack).joint_count;
    if (!all_finite(keys, key_count)) return LIMN_ERROR_CLIP;
    for (uint32_t c = 0; c < clip_count; c++) {
        const limn_file_clip *const clip = &clips[c];
        if (clip->name >= strings_size(pack) || clip->first_track != track ||
            clip->track_count > track_count - track || !all_finite(&clip->duration, 1) ||
            clip->duration < 0)
            return LIMN_ERROR_CLIP;
        for (const uint32_t begin = track; track < begin + clip->track_count; track++) {
            if (track > begin &&
                limn_file_track_key(&tracks[track]) <= limn_file_track_key(&tracks[track - 1]))
                return LIMN_ERROR_CLIP;
            TRY(validate_track(pack, &tracks[track], joint_count, keys, key_count, &key));
        }
    }
    return track == track_count && key == key_count ? LIMN_OK : LIMN_ERROR_CLIP;
}

// ---- Materials

static limn_result validate_materials(const limn_pack *pack, uint32_t *material_count) {
    uint32_t image_count, byte_count;
    const limn_result error = LIMN_ERROR_MATERIAL;
    TRY(count_records(pack, LIMN_CHUNK_MATERIALS, sizeof(limn_file_material), error,
                      material_count));
    TRY(count_records(pack, LIMN_CHUNK_IMAGES, sizeof(limn_file_image), error, &image_count));
    TRY(count_records(pack, LIMN_CHUNK_IMAGE_BYTES, 1, error, &byte_count));
    const uint32_t name_end = strings_size(pack), none = LIMN_FORMAT_NO_MESH;
    const limn_file_material *const materials = optional_data(pack, none, LIMN_CHUNK_MATERIALS);
    const limn_file_image *const images = optional_data(pack, none, LIMN_CHUNK_IMAGES);
    for (uint32_t m = 0; m < *material_count; m++) {
        const uint32_t image = materials[m].image;
        if (materials[m].name >= name_end || !all_finite(materials[m].base_colour, 4) ||
            (image >= image_count && image != LIMN_FORMAT_NONE))
            return error;
    }
    for (uint32_t i = 0; i < image_count; i++) {
        if (images[i].name >= name_end || images[i].offset > byte_count ||
            images[i].size > byte_count - images[i].offset)
            return error;
    }
    return LIMN_OK;
}

// ---- Meshes

/// Both are there with as many entries for each control point, or neither is.
static limn_result validate_skin(const limn_pack *pack, uint32_t m) {
    const limn_file_chunk *const joints = find_chunk(pack, m, LIMN_CHUNK_JOINTS);
    const limn_file_chunk *const weights = find_chunk(pack, m, LIMN_CHUNK_INFLUENCES);
    if (!joints && !weights) return LIMN_OK;
    if (!joints || !weights) return LIMN_ERROR_CHUNK;
    const limn_file_mesh *const record = chunk_data(pack, m, LIMN_CHUNK_MESH);
    const uint64_t count = weights->size / sizeof(float);
    if (record->control_count == 0 || count % record->control_count != 0 ||
        count / record->control_count > LIMN_INFLUENCE_MAX ||
        !chunk_has_size(pack, m, LIMN_CHUNK_INFLUENCES, count, sizeof(float)) ||
        !chunk_has_size(pack, m, LIMN_CHUNK_JOINTS, count, sizeof(uint16_t)))
        return LIMN_ERROR_SKIN;
    const limn_skin skin = limn_mesh_skin(pack, m);
    return limn_skin_check(&skin, NULL);
}

static limn_result validate_targets(const limn_pack *pack, uint32_t m) {
    const limn_file_chunk *const records = find_chunk(pack, m, LIMN_CHUNK_TARGETS);
    const limn_file_chunk *const points = find_chunk(pack, m, LIMN_CHUNK_TARGET_POINTS);
    const bool has_first = find_chunk(pack, m, LIMN_CHUNK_TARGET_FIRST);
    const bool has_deltas = find_chunk(pack, m, LIMN_CHUNK_TARGET_DELTAS);
    const bool any = records || points || has_first || has_deltas;
    if (any != (records && points && has_first && has_deltas)) return LIMN_ERROR_CHUNK;
    if (!any) return LIMN_OK;
    const uint64_t count = records->size / sizeof(limn_file_target);
    const uint64_t entry_count = points->size / sizeof(uint32_t);
    if (count == 0 || count > UINT16_MAX || entry_count > UINT32_MAX ||
        !chunk_has_size(pack, m, LIMN_CHUNK_TARGETS, count, sizeof(limn_file_target)) ||
        !chunk_has_size(pack, m, LIMN_CHUNK_TARGET_FIRST, count + 1, sizeof(uint32_t)) ||
        !chunk_has_size(pack, m, LIMN_CHUNK_TARGET_POINTS, entry_count, sizeof(uint32_t)) ||
        !chunk_has_size(pack, m, LIMN_CHUNK_TARGET_DELTAS, entry_count, 3 * sizeof(float)))
        return LIMN_ERROR_MORPH_POINT;
    const limn_file_target *const targets = chunk_data(pack, m, LIMN_CHUNK_TARGETS);
    for (uint32_t t = 0; t < count; t++) {
        if (targets[t].name >= strings_size(pack)) return LIMN_ERROR_TEXT;
        if (!all_finite(&targets[t].weight, 1)) return LIMN_ERROR_MORPH_DELTA;
    }
    const limn_morph_targets view = limn_mesh_morph_targets(pack, m);
    if (view.first[count] != entry_count) return LIMN_ERROR_MORPH_POINT;
    return limn_morph_check(&view, (uint32_t)entry_count, NULL);
}

static limn_result validate_ranges(const limn_pack *pack, uint32_t m, uint32_t material_count) {
    const limn_file_chunk *const chunk = find_chunk(pack, m, LIMN_CHUNK_RANGES);
    if (!chunk) return LIMN_OK;
    const limn_file_mesh *const record = chunk_data(pack, m, LIMN_CHUNK_MESH);
    const limn_file_range *const ranges = chunk_data(pack, m, LIMN_CHUNK_RANGES);
    const uint64_t count = chunk->size / sizeof *ranges;
    uint32_t patch = 0;
    if (chunk->size % sizeof *ranges != 0 || count > record->patch_count)
        return LIMN_ERROR_MATERIAL;
    for (uint32_t r = 0; r < count; r++) {
        if ((ranges[r].material >= material_count && ranges[r].material != LIMN_FORMAT_NONE) ||
            ranges[r].first_patch != patch || ranges[r].patch_count == 0 ||
            ranges[r].patch_count > record->patch_count - patch)
            return LIMN_ERROR_MATERIAL;
        patch += ranges[r].patch_count;
    }
    return patch == record->patch_count ? LIMN_OK : LIMN_ERROR_MATERIAL;
}

limn_result limni_validate_character(const limn_pack *pack) {
    uint32_t material_count;
    TRY(validate_strings(pack));
    TRY(validate_skeleton(pack));
    TRY(validate_materials(pack, &material_count));
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        TRY(validate_skin(pack, m));
        TRY(validate_targets(pack, m));
        TRY(validate_ranges(pack, m, material_count));
    }
    return validate_clips(pack);
}
