/* SPDX-License-Identifier: MIT */
/*
 * The chunks of characters: their golden values, and which result each kind of damage gives. Files
 * that open are used.
 */
#include "blobs.h"
#include "chain.h"
#include "characters.h"
#include "limn/bake.h"
#include "tube.h"

static blob bake(const glb *scene) {
    static char json[1 << 16];
    size_t size;
    const void *bytes = NULL;
    glb_json(scene, json, sizeof json);
    unsigned char *const document = glb_make(json, scene->bytes, scene->size, &size);
    FILE *const out = fopen("test_pack_character.glb", "wb");
    CHECK(out && fwrite(document, 1, size, out) == size);
    if (out) fclose(out);
    free(document);
    limn_baker *const baker =
        limn_baker_create(&(limn_bake_desc){.isolate = LIMN_ISOLATE_ALWAYS, .images = true});
    CHECK_EQUAL(limn_baker_add_file(baker, "test_pack_character.glb"), LIMN_BAKE_OK);
    CHECK_EQUAL(limn_baker_finish(baker, &bytes, &size), LIMN_BAKE_OK);
    CHECK_TEXT(limn_baker_error(baker), "");
    remove("test_pack_character.glb");
    const blob original = {.bytes = (unsigned char *)(uintptr_t)bytes, .size = size};
    const blob file = copy_blob(&original, size);
    limn_baker_destroy(baker);
    return file;
}

/// The scene of tube.h with small tables, and an image in it.
static blob bake_tube(void) {
    static glb tube;
    tube_make(&tube);
    char view[22];
    char *const uri = strstr(tube.rest, "\"uri\":\"not_there.png\"");
    snprintf(view, sizeof view, "\"bufferView\":%-8d", glb_view(&tube, "\x89PNG of 14 b.", 14));
    memcpy(uri, view, 21); // as long
    return bake(&tube);
}

// ---- Golden values

typedef struct golden {
    int mesh;
    uint32_t kind;
    uint64_t size, checksum;
} golden;

static const golden goldens[] = {
    {-1, LIMN_CHUNK_STRINGS, 89, 0x0f40630468e6758a},
    {-1, LIMN_CHUNK_SKELETON, 672, 0xa9505ab8c95b24cc},
    {-1, LIMN_CHUNK_CLIPS, 32, 0xdbedfbd76c618718},
    {-1, LIMN_CHUNK_TRACKS, 80, 0xd5b195c508faf20f},
    {-1, LIMN_CHUNK_KEYS, 252, 0xb91afed56aa12db5},
    {-1, LIMN_CHUNK_MATERIALS, 64, 0xe7c40728e4cde79f},
    {-1, LIMN_CHUNK_IMAGES, 24, 0x44b7c9ac57e9e2f2},
    {-1, LIMN_CHUNK_IMAGE_BYTES, 14, 0x72be60bbfc4b4e99},
    {0, LIMN_CHUNK_JOINTS, 100, 0xd5ab7590b470227e},
    {0, LIMN_CHUNK_INFLUENCES, 200, 0xef65207500aa07fa},
    {0, LIMN_CHUNK_TARGETS, 8, 0x335771e27f31af3e},
    {0, LIMN_CHUNK_TARGET_FIRST, 8, 0xbfdca7f0d3aa4b00},
    {0, LIMN_CHUNK_TARGET_POINTS, 24, 0x29c8324aec2acfb2},
    {0, LIMN_CHUNK_RANGES, 24, 0x06887b03f95ccaf9},
};

static void test_golden(const blob *file) {
    for (size_t g = 0; g < COUNT(goldens); g++) {
        const limn_file_chunk *const chunk =
            find_chunk(file, (uint32_t)goldens[g].mesh, goldens[g].kind);
        const uint64_t checksum = limni_checksum(file->bytes + chunk->offset, (size_t)chunk->size);
        CHECK_EQUAL(chunk->flags, 0);
        CHECK_EQUAL(chunk->size, goldens[g].size);
        if (!CHECK(checksum == goldens[g].checksum))
            fprintf(stderr, "    {%d, %.4s, %llu, 0x%016llx},\n", goldens[g].mesh,
                    (const char *)&goldens[g].kind, (unsigned long long)chunk->size,
                    (unsigned long long)checksum);
    }
}

// ---- Damage

static limn_file_joint *joints_of(const blob *file) {
    return chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_SKELETON);
}
static limn_file_clip *clips_of(const blob *file) {
    return chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLIPS);
}
static limn_file_track *tracks_of(const blob *file) {
    return chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TRACKS);
}
static float *keys_of(const blob *file) {
    return chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_KEYS);
}
static limn_file_material *materials_of(const blob *file) {
    return chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_MATERIALS);
}
static limn_file_image *images_of(const blob *file) {
    return chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_IMAGES);
}
static limn_file_range *ranges_of(const blob *file) {
    return chunk_data(file, 0, LIMN_CHUNK_RANGES);
}
static limn_file_chunk *chunk_of(const blob *file, uint32_t kind) {
    return find_chunk(file, LIMN_FORMAT_NO_MESH, kind);
}

WITHOUT(without_strings, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_STRINGS)
WITHOUT(without_skeleton, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_SKELETON)
WITHOUT(without_tracks, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TRACKS)
WITHOUT(without_keys, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_KEYS)
WITHOUT(without_clips, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLIPS)
WITHOUT(without_materials, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_MATERIALS)
WITHOUT(without_images, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_IMAGES)
WITHOUT(without_image_bytes, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_IMAGE_BYTES)
WITHOUT(without_joints, 0, LIMN_CHUNK_JOINTS)
WITHOUT(without_influences, 0, LIMN_CHUNK_INFLUENCES)
WITHOUT(without_targets, 0, LIMN_CHUNK_TARGETS)
WITHOUT(without_target_points, 0, LIMN_CHUNK_TARGET_POINTS)
WITHOUT(without_target_first, 0, LIMN_CHUNK_TARGET_FIRST)
WITHOUT(without_target_deltas, 0, LIMN_CHUNK_TARGET_DELTAS)
WITHOUT(without_ranges, 0, LIMN_CHUNK_RANGES)

/// Not whole records.
#define CUT(name, mesh, kind)                                                                      \
    static void name(const blob *file) {                                                           \
        find_chunk(file, mesh, kind)->size -= 2;                                                   \
    }
CUT(clips_cut, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLIPS)
CUT(tracks_cut, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TRACKS)
CUT(keys_cut, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_KEYS)
CUT(materials_cut, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_MATERIALS)
CUT(images_cut, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_IMAGES)
CUT(targets_cut, 0, LIMN_CHUNK_TARGETS)
CUT(target_first_cut, 0, LIMN_CHUNK_TARGET_FIRST)
CUT(target_points_cut, 0, LIMN_CHUNK_TARGET_POINTS)
CUT(target_deltas_cut, 0, LIMN_CHUNK_TARGET_DELTAS)
CUT(ranges_cut, 0, LIMN_CHUNK_RANGES)

static void targets_empty(const blob *file) {
    find_chunk(file, 0, LIMN_CHUNK_TARGETS)->size = 0;
    find_chunk(file, 0, LIMN_CHUNK_TARGET_FIRST)->size = sizeof(uint32_t);
}
static void clip_negative(const blob *file) {
    clips_of(file)[0].duration = -0x1p-100f;
}
static void strings_open(const blob *file) {
    chunk_of(file, LIMN_CHUNK_STRINGS)->size--;
}
static uint32_t name_end(const blob *file) {
    return (uint32_t)chunk_of(file, LIMN_CHUNK_STRINGS)->size;
}
static void joint_name(const blob *file) {
    joints_of(file)[2].name = name_end(file);
}
static void clip_name(const blob *file) {
    clips_of(file)[1].name = name_end(file);
}
static void material_name(const blob *file) {
    materials_of(file)[1].name = name_end(file);
}
static void image_name(const blob *file) {
    images_of(file)[0].name = name_end(file);
}
/// Where there are no strings, there is no name, not even at 0.
static void names_nowhere(const blob *file) {
    for (uint32_t j = 0; j < 7; j++)
        joints_of(file)[j].name = 0;
    clips_of(file)[0].name = clips_of(file)[1].name = materials_of(file)[0].name =
        materials_of(file)[1].name = images_of(file)[0].name = 0;
    remove_chunk(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_STRINGS);
}
/// Not damage: the last of the strings is as good a name as any.
static void last_names(const blob *file) {
    joints_of(file)[2].name = clips_of(file)[1].name = materials_of(file)[1].name =
        images_of(file)[0].name = name_end(file) - 1;
}
static void joint_before_parent(const blob *file) {
    joints_of(file)[1].parent = 1;
}
/// There, but not on the way from the joint before.
static void joint_out_of_order(const blob *file) {
    joints_of(file)[6].parent = 0;
}
static void joint_cut(const blob *file) {
    chunk_of(file, LIMN_CHUNK_SKELETON)->size -= 4;
}
static void joint_infinite(const blob *file) {
    joints_of(file)[6].inverse_bind[2][3] = INFINITY;
}
static void clip_gap(const blob *file) {
    clips_of(file)[1].first_track++;
}
static void clip_too_long(const blob *file) {
    clips_of(file)[1].track_count = UINT32_MAX;
}
static void clip_duration(const blob *file) {
    clips_of(file)[0].duration = NAN;
}
static void track_of_no_joint(const blob *file) {
    tracks_of(file)[2].target = 7;
}
static void track_of_no_mesh(const blob *file) {
    tracks_of(file)[3].target = 4;
}
static void track_of_no_targets(const blob *file) {
    tracks_of(file)[3].target = 3;
}
static void track_path(const blob *file) {
    tracks_of(file)[3].path = 4;
}
static void track_interpolation(const blob *file) {
    tracks_of(file)[0].interpolation = 3;
}
static void track_width(const blob *file) {
    tracks_of(file)[0].width = 4;
}
static void track_order(const blob *file) {
    tracks_of(file)[1].path = LIMN_FORMAT_TRANSLATION;
}
static void track_without_keys(const blob *file) {
    tracks_of(file)[4].key_count = 0;
}
static void track_beyond_keys(const blob *file) {
    tracks_of(file)[4].key_count = 0x40000000;
}
static void track_first_key(const blob *file) {
    tracks_of(file)[1].first_key++;
}
static void key_times(const blob *file) {
    keys_of(file)[1] = keys_of(file)[0];
}
static void key_infinite(const blob *file) {
    keys_of(file)[7] = -INFINITY;
}
static void material_image(const blob *file) {
    materials_of(file)[0].image = 1;
}
static void material_colour(const blob *file) {
    materials_of(file)[1].base_colour[3] = NAN;
}
static void image_beyond(const blob *file) {
    images_of(file)[0].offset = UINT64_MAX;
}
/// Not damage: an image of no bytes may end where the bytes do.
static void image_at_end(const blob *file) {
    images_of(file)[0].offset = chunk_of(file, LIMN_CHUNK_IMAGE_BYTES)->size;
    images_of(file)[0].size = 0;
}
static void image_behind_end(const blob *file) {
    image_at_end(file);
    images_of(file)[0].offset++;
}
static void image_too_long(const blob *file) {
    images_of(file)[0].size++;
}
static void range_material(const blob *file) {
    ranges_of(file)[1].material = 2;
}
static void range_gap(const blob *file) {
    ranges_of(file)[1].first_patch++;
}
static void range_short(const blob *file) {
    ranges_of(file)[1].patch_count--;
}
static void range_long(const blob *file) {
    ranges_of(file)[1].patch_count = UINT32_MAX;
}
static void influence_joint(const blob *file) {
    ((uint16_t *)chunk_data(file, 0, LIMN_CHUNK_JOINTS))[5] = 7;
}
static void influence_sum(const blob *file) {
    ((float *)chunk_data(file, 0, LIMN_CHUNK_INFLUENCES))[0] = 0.5f;
}
static void influence_negative(const blob *file) {
    ((float *)chunk_data(file, 0, LIMN_CHUNK_INFLUENCES))[1] = -0.5f;
}
static void influences_cut(const blob *file) {
    find_chunk(file, 0, LIMN_CHUNK_INFLUENCES)->size -= sizeof(float);
}
static void joints_cut(const blob *file) {
    find_chunk(file, 0, LIMN_CHUNK_JOINTS)->size -= sizeof(uint16_t);
}
static void target_point(const blob *file) {
    ((uint32_t *)chunk_data(file, 0, LIMN_CHUNK_TARGET_POINTS))[5] = 25;
}
static void target_delta(const blob *file) {
    ((float *)chunk_data(file, 0, LIMN_CHUNK_TARGET_DELTAS))[0] = NAN;
}
static void target_first(const blob *file) {
    ((uint32_t *)chunk_data(file, 0, LIMN_CHUNK_TARGET_FIRST))[1]--;
}
static void target_weight(const blob *file) {
    ((limn_file_target *)chunk_data(file, 0, LIMN_CHUNK_TARGETS))->weight = INFINITY;
}
static void target_name(const blob *file) {
    ((limn_file_target *)chunk_data(file, 0, LIMN_CHUNK_TARGETS))->name = name_end(file);
}

static const damage damages[] = {
    DAMAGE(without_strings, LIMN_ERROR_SKELETON),
    DAMAGE(without_skeleton, LIMN_ERROR_SKIN),
    DAMAGE(without_tracks, LIMN_ERROR_CLIP),
    DAMAGE(without_keys, LIMN_ERROR_CLIP),
    DAMAGE(without_clips, LIMN_ERROR_CLIP),
    DAMAGE(without_materials, LIMN_ERROR_MATERIAL),
    DAMAGE(without_images, LIMN_ERROR_MATERIAL),
    DAMAGE(without_image_bytes, LIMN_ERROR_MATERIAL),
    DAMAGE(without_joints, LIMN_ERROR_CHUNK),
    DAMAGE(without_influences, LIMN_ERROR_CHUNK),
    DAMAGE(without_targets, LIMN_ERROR_CHUNK),
    DAMAGE(without_target_points, LIMN_ERROR_CHUNK),
    DAMAGE(without_target_first, LIMN_ERROR_CHUNK),
    DAMAGE(without_target_deltas, LIMN_ERROR_CHUNK),
    DAMAGE(without_ranges, LIMN_OK),
    DAMAGE(clips_cut, LIMN_ERROR_CLIP),
    DAMAGE(tracks_cut, LIMN_ERROR_CLIP),
    DAMAGE(keys_cut, LIMN_ERROR_CLIP),
    DAMAGE(materials_cut, LIMN_ERROR_MATERIAL),
    DAMAGE(images_cut, LIMN_ERROR_MATERIAL),
    DAMAGE(targets_cut, LIMN_ERROR_MORPH_POINT),
    DAMAGE(targets_empty, LIMN_ERROR_MORPH_POINT),
    DAMAGE(target_first_cut, LIMN_ERROR_MORPH_POINT),
    DAMAGE(target_points_cut, LIMN_ERROR_MORPH_POINT),
    DAMAGE(target_deltas_cut, LIMN_ERROR_MORPH_POINT),
    DAMAGE(ranges_cut, LIMN_ERROR_MATERIAL),
    DAMAGE(strings_open, LIMN_ERROR_TEXT),
    DAMAGE(joint_name, LIMN_ERROR_SKELETON),
    DAMAGE(clip_name, LIMN_ERROR_CLIP),
    DAMAGE(material_name, LIMN_ERROR_MATERIAL),
    DAMAGE(image_name, LIMN_ERROR_MATERIAL),
    DAMAGE(names_nowhere, LIMN_ERROR_SKELETON),
    DAMAGE(last_names, LIMN_OK),
    DAMAGE(joint_before_parent, LIMN_ERROR_SKELETON),
    DAMAGE(joint_out_of_order, LIMN_ERROR_SKELETON),
    DAMAGE(joint_cut, LIMN_ERROR_SKELETON),
    DAMAGE(joint_infinite, LIMN_ERROR_SKELETON),
    DAMAGE(clip_gap, LIMN_ERROR_CLIP),
    DAMAGE(clip_too_long, LIMN_ERROR_CLIP),
    DAMAGE(clip_duration, LIMN_ERROR_CLIP),
    DAMAGE(clip_negative, LIMN_ERROR_CLIP),
    DAMAGE(track_of_no_joint, LIMN_ERROR_CLIP),
    DAMAGE(track_of_no_mesh, LIMN_ERROR_CLIP),
    DAMAGE(track_of_no_targets, LIMN_ERROR_CLIP),
    DAMAGE(track_path, LIMN_ERROR_CLIP),
    DAMAGE(track_interpolation, LIMN_ERROR_CLIP),
    DAMAGE(track_width, LIMN_ERROR_CLIP),
    DAMAGE(track_order, LIMN_ERROR_CLIP),
    DAMAGE(track_without_keys, LIMN_ERROR_CLIP),
    DAMAGE(track_beyond_keys, LIMN_ERROR_CLIP),
    DAMAGE(track_first_key, LIMN_ERROR_CLIP),
    DAMAGE(key_times, LIMN_ERROR_CLIP),
    DAMAGE(key_infinite, LIMN_ERROR_CLIP),
    DAMAGE(material_image, LIMN_ERROR_MATERIAL),
    DAMAGE(material_colour, LIMN_ERROR_MATERIAL),
    DAMAGE(image_beyond, LIMN_ERROR_MATERIAL),
    DAMAGE(image_at_end, LIMN_OK),
    DAMAGE(image_behind_end, LIMN_ERROR_MATERIAL),
    DAMAGE(image_too_long, LIMN_ERROR_MATERIAL),
    DAMAGE(range_material, LIMN_ERROR_MATERIAL),
    DAMAGE(range_gap, LIMN_ERROR_MATERIAL),
    DAMAGE(range_short, LIMN_ERROR_MATERIAL),
    DAMAGE(range_long, LIMN_ERROR_MATERIAL),
    DAMAGE(influence_joint, LIMN_ERROR_JOINT),
    DAMAGE(influence_sum, LIMN_ERROR_WEIGHT_SUM),
    DAMAGE(influence_negative, LIMN_ERROR_WEIGHT),
    DAMAGE(influences_cut, LIMN_ERROR_SKIN),
    DAMAGE(joints_cut, LIMN_ERROR_SKIN),
    DAMAGE(target_point, LIMN_ERROR_MORPH_POINT),
    DAMAGE(target_delta, LIMN_ERROR_MORPH_DELTA),
    DAMAGE(target_first, LIMN_ERROR_MORPH_POINT),
    DAMAGE(target_weight, LIMN_ERROR_MORPH_DELTA),
    DAMAGE(target_name, LIMN_ERROR_TEXT),
};

/// Words of the chunks of characters at the limits of their types.
static void test_words(const blob *file) {
    const uint32_t values[] = {0, 1, 2, 0xffff, 0x3fffffff, 0x7f800000, 0x80000000, 0xffffffff};
    uint32_t opened = 0, refused = 0;
    for (size_t g = 0; g < COUNT(goldens); g++) {
        const limn_file_chunk *const chunk =
            find_chunk(file, (uint32_t)goldens[g].mesh, goldens[g].kind);
        for (uint64_t at = 0; at + 4 <= chunk->size && at < 256; at += 4) {
            for (size_t v = 0; v < COUNT(values); v++) {
                const blob changed = copy_blob(file, file->size);
                memcpy(changed.bytes + chunk->offset + at, &values[v], sizeof *values);
                fix_checksum(&changed);
                limn_pack pack;
                const bool good = limn_pack_open(&pack, changed.bytes, changed.size) == LIMN_OK;
                if (good) use_character(&pack);
                opened += good;
                refused += !good;
                free(changed.bytes);
            }
        }
    }
    CHECK(opened > 100);
    CHECK(refused > 100);
}

/// The joints on the way to one, as many as there may be, and one more.
static void test_depth(void) {
    static glb chain;
    limn_pack pack;
    chain_make(&chain, LIMN_FORMAT_DEPTH_OF_JOINTS - 1);
    const blob file = bake(&chain);
    limn_file_joint *const joints = joints_of(&file);
    joints[255].parent = 254;
    fix_checksum(&file);
    if (CHECK_EQUAL(limn_pack_open(&pack, file.bytes, file.size), LIMN_OK)) use_character(&pack);
    CHECK_EQUAL(limn_pack_skeleton(&pack).joint_count, 257);
    joints[256].parent = 255;
    fix_checksum(&file);
    CHECK_EQUAL(open_result(file.bytes, file.size), LIMN_ERROR_SKELETON);
    free(file.bytes);
}

int main(void) {
    const blob file = bake_tube();
    limn_pack pack;
    CHECK_EQUAL(limn_pack_open(&pack, file.bytes, file.size), LIMN_OK);
    CHECK(use_character(&pack) > 0);
    test_golden(&file);
    check_damages(&file, damages, COUNT(damages));
    check_gaps(&file);
    test_words(&file);
    test_depth();
    free(file.bytes);
    return check_report();
}
