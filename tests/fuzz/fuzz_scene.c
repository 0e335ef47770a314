/* SPDX-License-Identifier: MIT */
/*
 * Reading a scene, by FUZZ_READ as a file with the name FUZZ_PATH, with what moves and colours its
 * meshes; and each mesh through all repairs to the control mesh and what moves its points.
 */
#include "../../baker/rig.h"
#include "../../baker/scene.h"
#include "fuzz.h"

#include "limn/limn.h"

#include <math.h>
#include <string.h>

static void ignore_note(void *user, const char *text) {
    *(size_t *)user += strlen(text);
}

static void check_channels(const limni_source *source) {
    for (uint32_t c = 0; c < source->channel_count; c++) {
        const limni_source_channel *const channel = &source->channels[c];
        for (uint32_t v = 0; v < channel->value_count; v++) {
            for (int i = 0; i < 3; i++)
                FUZZ_REQUIRE(isfinite(channel->values[v][i]));
        }
        for (uint32_t k = 0; k < source->face_offsets[source->face_count]; k++)
            FUZZ_REQUIRE(channel->corner_values[k] < channel->value_count);
    }
}

static void check_source(const limni_source *source, const limni_character *character) {
    FUZZ_REQUIRE(source->position_count > 0 && source->face_count > 0);
    for (uint32_t p = 0; p < source->position_count; p++) {
        for (int axis = 0; axis < 3; axis++)
            FUZZ_REQUIRE(isfinite(source->positions[p][axis]));
    }
    for (uint32_t c = 0; c < source->face_offsets[source->face_count]; c++)
        FUZZ_REQUIRE(source->face_corners[c] < source->position_count);
    for (uint32_t face = 0; face < source->face_count; face++)
        FUZZ_REQUIRE(source->face_materials[face] < character->materials.count ||
                     source->face_materials[face] == LIMN_FORMAT_NONE);
    check_channels(source);
}

/// As the runtime will check it.
static void check_rig(const limni_control_rig *rig, uint32_t control_count,
                      const limni_character *character) {
    const limn_skin skin = {.point_count = control_count,
                            .joint_count = character->joints.count,
                            .influence_count = rig->influence_count,
                            .joints = rig->joints,
                            .weights = rig->weights};
    const limn_morph_targets targets = {.point_count = control_count,
                                        .target_count = rig->target_count,
                                        .first = rig->first,
                                        .points = rig->points,
                                        .deltas = rig->target_count ? rig->deltas[0] : NULL};
    if (rig->influence_count) FUZZ_REQUIRE(limn_skin_check(&skin, NULL) == LIMN_OK);
    if (rig->target_count)
        FUZZ_REQUIRE(limn_morph_check(&targets, rig->first[rig->target_count], NULL) == LIMN_OK);
}

static void build(limni_context *context, limni_source *source, const limni_character *character) {
    limni_mesh mesh;
    limni_control_rig rig;
    const limn_bake_status status = limni_mesh_build(context, source, &mesh);
    FUZZ_REQUIRE(status == LIMN_BAKE_OK || status == LIMN_BAKE_BAD_INPUT);
    if (status != LIMN_BAKE_OK) return;
    FUZZ_REQUIRE(limni_rig_build(context, source, &mesh, &rig) == LIMN_BAKE_OK);
    check_rig(&rig, mesh.control_count, character);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    size_t note_size = 0;
    limni_character character = {0};
    limni_scene scene = {.character = &character};
    limni_context context = {.desc = {.repair = LIMN_REPAIR_ALL,
                                      .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                                      .images = true,
                                      .note = ignore_note,
                                      .user = &note_size}};
    char *const text = malloc(size + 1); // exactly as large, for the address sanitizer
    FUZZ_REQUIRE(text);
    if (size > 0) memcpy(text, bytes, size);
    text[size] = '\0';
    const limn_bake_status status = FUZZ_READ(&context, FUZZ_PATH, "fuzz", text, size, &scene);
    FUZZ_REQUIRE(status == LIMN_BAKE_OK || status == LIMN_BAKE_BAD_INPUT);
    FUZZ_REQUIRE((status == LIMN_BAKE_OK) == (context.error[0] == '\0'));
    free(text);
    for (uint32_t s = 0; status == LIMN_BAKE_OK && s < scene.source_count; s++) {
        check_source(&scene.sources[s], &character);
        build(&context, &scene.sources[s], &character);
    }
    limni_release_all(&context);
    return 0;
}
