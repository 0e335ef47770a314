/* SPDX-License-Identifier: MIT */
/*
 * One mesh reader, FUZZ_READ, on a file named FUZZ_PATH; and what it has read through all repairs
 * to the control mesh.
 */
#include "../../baker/mesh.h"
#include "../../baker/read_lomont.h"
#include "fuzz.h"

#include <math.h>
#include <string.h>

static void ignore_note(void *user, const char *text) {
    *(size_t *)user += strlen(text);
}

static void check_source(const limni_source *source) {
    FUZZ_REQUIRE(source->position_count > 0 && source->face_count > 0);
    FUZZ_REQUIRE(source->face_offsets[0] == 0);
    for (uint32_t p = 0; p < source->position_count; p++) {
        for (int axis = 0; axis < 3; axis++)
            FUZZ_REQUIRE(isfinite(source->positions[p][axis]));
    }
    for (uint32_t face = 0; face < source->face_count; face++)
        FUZZ_REQUIRE(source->face_offsets[face] + 3 <= source->face_offsets[face + 1]);
    for (uint32_t c = 0; c < source->face_offsets[source->face_count]; c++)
        FUZZ_REQUIRE(source->face_corners[c] < source->position_count);
    for (uint32_t c = 0; c < source->tags.crease_count; c++)
        FUZZ_REQUIRE(source->tags.creases[c].sharpness >= 0);
    for (uint32_t v = 0; v < source->tags.sharp_vertex_count; v++)
        FUZZ_REQUIRE(source->tags.sharp_vertices[v].sharpness >= 0);
}

static void check_mesh(const limni_mesh *mesh) {
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        const uint32_t pair = mesh->pairs[h];
        FUZZ_REQUIRE(limni_half_edge_start(mesh, h) < mesh->control_count);
        FUZZ_REQUIRE(mesh->edge_sharpness[h] >= 0);
        if (pair == LIMNI_NONE) continue;
        FUZZ_REQUIRE(pair < 3 * mesh->face_count && mesh->pairs[pair] == h);
        FUZZ_REQUIRE(mesh->edge_sharpness[pair] == mesh->edge_sharpness[h]);
    }
    for (uint32_t c = 0; c < mesh->control_count; c++)
        FUZZ_REQUIRE(mesh->vertex_sharpness[c] >= 0);
}

static void build(limni_context *context, limni_source *source) {
    limni_mesh mesh;
    const limn_bake_status status = limni_mesh_build(context, source, &mesh);
    FUZZ_REQUIRE(status == LIMN_BAKE_OK || status == LIMN_BAKE_BAD_INPUT);
    FUZZ_REQUIRE((status == LIMN_BAKE_OK) == (context->error[0] == '\0'));
    if (status == LIMN_BAKE_OK) check_mesh(&mesh);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    size_t note_size = 0;
    limni_context context = {.desc = {.repair = LIMN_REPAIR_ALL,
                                      .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                                      .note = ignore_note,
                                      .user = &note_size}};
    limni_source source = {.name = "fuzz", .path = FUZZ_PATH};
    char *const text = malloc(size + 1); // exactly as large, for the address sanitizer
    FUZZ_REQUIRE(text);
    if (size > 0) memcpy(text, bytes, size);
    text[size] = '\0';
    const limn_bake_status status = FUZZ_READ(&context, text, size, &source);
    FUZZ_REQUIRE(status == LIMN_BAKE_OK || status == LIMN_BAKE_BAD_INPUT);
    FUZZ_REQUIRE((status == LIMN_BAKE_OK) == (context.error[0] == '\0'));
    free(text);
    if (status == LIMN_BAKE_OK) {
        check_source(&source);
        build(&context, &source);
    }
    limni_release_all(&context);
    return 0;
}
