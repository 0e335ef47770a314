/* SPDX-License-Identifier: MIT */
/*
 * Files of format version 6, the first that later releases keep reading: they open, and give the
 * bits that they gave when they were made. They stay as they are; a new version adds its own.
 *
 *     limn bake tetrahedron.obj -o v6_tetrahedron.limn --normals exact
 *     limn bake box.obj -o v6_box.limn --scheme catmark --normals exact --isolate 1
 *     limn bake ../fuzz/corpus/gltf/character.glb -o v6_character.limn --isolate 1 --images
 *
 * usage: test_files FOLDER
 */
#include "../blobs.h"
#include "limn/character.h"

// ---- Reading

static blob read_blob(const char *folder, const char *name) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s.limn", folder, name);
    FILE *const file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END) != 0) {
        fprintf(stderr, "%s cannot be read\n", path);
        exit(EXIT_FAILURE);
    }
    const blob bytes = make_blob((size_t)ftell(file));
    rewind(file);
    CHECK_EQUAL(fread(bytes.bytes, 1, bytes.size, file), bytes.size);
    fclose(file);
    return bytes;
}

// ---- What a mesh gives

/// A checksum goes on with more bytes.
static uint64_t add_bytes(uint64_t sum, const void *bytes, size_t size) {
    const uint64_t both[] = {sum, limni_checksum(bytes, size)};
    return limni_checksum(both, sizeof both);
}

static uint64_t sum_of_positions(const limn_mesh *mesh) {
    uint64_t sum = 0;
    for (uint32_t level = 0; level <= LIMN_LEVEL_MAX; level++) {
        float *const vertices = evaluate(mesh, level);
        const size_t count = (size_t)limn_plan_uniform(mesh, level).vertex_count;
        sum = add_bytes(sum, vertices, count * sizeof(float[3]));
        free(vertices);
    }
    return sum;
}

static uint64_t sum_of_normals(const limn_mesh *mesh) {
    if (!mesh->normals) return 0;
    const limn_plan plan = limn_plan_uniform(mesh, 2);
    const size_t size = (size_t)plan.vertex_count * sizeof(float[3]);
    float *const control_normals = malloc(mesh->normal_count * sizeof(float[3]));
    float *const vertices = malloc(size), *const normals = malloc(size);
    limn_mesh_control_normals(mesh, mesh->controls, control_normals);
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count,
                  &(limn_output){.vertices = vertices,
                                 .normals = normals,
                                 .control_normals = control_normals});
    const uint64_t sum = add_bytes(0, normals, size);
    free(control_normals);
    free(vertices);
    free(normals);
    return sum;
}

static uint64_t sum_of_channels(const limn_pack *pack, const limn_mesh *mesh) {
    const limn_plan plan = limn_plan_uniform(mesh, 2);
    const size_t size = (size_t)plan.vertex_count * sizeof(float[3]);
    uint64_t sum = 0;
    for (uint32_t c = 0; c < mesh->channel_count; c++) {
        const limn_channel channel = limn_mesh_channel(pack, mesh, c);
        float *const values = malloc(size);
        limn_evaluate_channel(&plan, &channel, channel.mesh.controls, 0, plan.patch_count,
                              &(limn_value_output){.values = values});
        sum = add_bytes(sum, values, size);
        free(values);
    }
    return sum;
}

/// A frame by errors, seen so that levels differ.
static uint64_t sum_of_frame(const limn_mesh *mesh) {
    const limn_view view = {.eye = {2, 0.5f, 1}, .pixels = 150, .nearest = 0.125f};
    void *const memory = malloc(limn_plan_size(mesh));
    const limn_plan plan =
        limn_plan_build(mesh, mesh->controls, &view, 1,
                        &(limn_lod_desc){.lod = LIMN_LOD_ERROR, .pixels = 1}, NULL, memory);
    const size_t size = (size_t)plan.vertex_count * sizeof(float[3]);
    float *const vertices = malloc(size);
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count, &(limn_output){.vertices = vertices});
    const uint64_t sum = add_bytes(
        add_bytes(0, plan.patches, plan.patch_count * sizeof *plan.patches), vertices, size);
    free(vertices);
    free(memory);
    return sum;
}

/// Control points, moved by half of each target and by joints that each move in their own way.
static uint64_t sum_of_pose(const limn_pack *pack, uint32_t m, const limn_mesh *mesh) {
    enum { JOINT_MAX = 8 };
    const limn_skin skin = limn_mesh_skin(pack, m);
    const limn_morph_targets targets = limn_mesh_morph_targets(pack, m);
    if (skin.point_count == 0 || targets.target_count == 0) return 0;
    float weights[JOINT_MAX], matrices[JOINT_MAX][3][4] = {{{0}}};
    CHECK(skin.joint_count <= JOINT_MAX && targets.target_count <= JOINT_MAX);
    for (uint32_t k = 0; k < JOINT_MAX; k++) {
        weights[k] = 0.5f;
        for (uint32_t row = 0; row < 3; row++) {
            matrices[k][row][row] = 1 + (float)k;
            matrices[k][row][3] = (float)row;
        }
    }
    float *const points = malloc(mesh->point_count * sizeof(float[3]));
    limn_morph_points(&targets, weights, mesh->controls, 0, targets.point_count, points);
    const limn_pose pose = {.skin = &skin, .matrices = matrices[0][0]};
    limn_pose_points(&pose, points, 0, skin.point_count, points);
    limn_mesh_refine(mesh, points);
    const uint64_t sum = add_bytes(0, points, mesh->point_count * sizeof(float[3]));
    free(points);
    return sum;
}

// ---- Tests

typedef struct golden {
    const char *file;
    uint32_t mesh;
    uint64_t positions, normals, channels, frame, pose; ///< 0: there is nothing of the kind
} golden;

static const golden goldens[] = {
    {"v6_tetrahedron", 0, 0x662c0f9baba49873, 0xb0035eb06ba5ca2c, 0x0b1ff6611a14691e,
     0x8a1662597425056a, 0},
    {"v6_box", 0, 0x4141d3f8a42a272b, 0xd6310025b25968e6, 0, 0x289a46cb73aa18cd, 0},
    {"v6_character", 0, 0x3613ab5a959447b6, 0, 0xce62d6cdd5245255, 0x753eac49310bcbca,
     0x0258d4bd9396165c},
    {"v6_character", 1, 0x0241ea2e4e1ffaa5, 0, 0, 0xacb3ce5ecd4fddf6, 0},
};

static void check_sum(const golden *expected, const char *what, uint64_t sum, uint64_t should_be) {
    if (!CHECK(sum == should_be))
        fprintf(stderr, "    %s, mesh %u: %s: 0x%016llx\n", expected->file, expected->mesh, what,
                (unsigned long long)sum);
}

static void check_golden(const golden *expected, const char *folder) {
    const blob file = read_blob(folder, expected->file);
    limn_pack pack;
    CHECK_EQUAL(header_of(&file)->version, 6);
    if (CHECK_EQUAL(limn_pack_open(&pack, file.bytes, file.size), LIMN_OK) &&
        CHECK(expected->mesh < pack.mesh_count)) {
        const limn_mesh mesh = limn_pack_mesh(&pack, expected->mesh);
        check_sum(expected, "positions", sum_of_positions(&mesh), expected->positions);
        check_sum(expected, "normals", sum_of_normals(&mesh), expected->normals);
        check_sum(expected, "channels", sum_of_channels(&pack, &mesh), expected->channels);
        check_sum(expected, "frame", sum_of_frame(&mesh), expected->frame);
        check_sum(expected, "pose", sum_of_pose(&pack, expected->mesh, &mesh), expected->pose);
    }
    free(file.bytes);
}

static void test_character(const char *folder) {
    const blob file = read_blob(folder, "v6_character");
    limn_pack pack;
    CHECK_EQUAL(limn_pack_open(&pack, file.bytes, file.size), LIMN_OK);
    const limn_skeleton skeleton = limn_pack_skeleton(&pack);
    CHECK_EQUAL(skeleton.joint_count, 3);
    CHECK_EQUAL(limn_skeleton_joint(&skeleton, 1).parent, 0);
    CHECK_EQUAL(limn_pack_clip_count(&pack), 1);
    const limn_clip clip = limn_pack_clip(&pack, 0);
    CHECK_TEXT(clip.name, "animation 0");
    CHECK(clip.duration == 1 && clip.track_count == 4);
    CHECK_EQUAL(limn_pack_material_count(&pack), 1);
    const limn_material material = limn_pack_material(&pack, 0);
    CHECK_TEXT(material.image_name, "image 0");
    CHECK_EQUAL(material.image_size, 4);
    CHECK_EQUAL(limn_mesh_material_range_count(&pack, 0), 1);
    free(file.bytes);
}

/// Files of the version before the first and behind the last are refused for just that, whatever
/// else is in them.
static void test_other_versions(const char *folder) {
    const uint32_t versions[] = {LIMN_FORMAT_VERSION_OLDEST - 1, LIMN_FORMAT_VERSION + 1};
    for (size_t v = 0; v < COUNT(versions); v++) {
        const blob file = read_blob(folder, "v6_tetrahedron");
        header_of(&file)->version = versions[v];
        memset(file.bytes + 8, 0xff, file.size - 8);
        const limn_result result = open_result(file.bytes, file.size);
        CHECK_EQUAL(result, LIMN_ERROR_VERSION);
        CHECK_CONTAINS(limn_result_text(result), "format version");
        free(file.bytes);
    }
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: test_files FOLDER\n");
        return EXIT_FAILURE;
    }
    for (size_t g = 0; g < COUNT(goldens); g++)
        check_golden(&goldens[g], argv[1]);
    test_character(argv[1]);
    test_other_versions(argv[1]);
    return check_report();
}
