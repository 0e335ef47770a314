/* SPDX-License-Identifier: MIT */
/* glTF 2.0. docs/meshes.md says what is read. */
#include "gltf_reader.h"
#include "read_model.h"

#include <string.h>

/// Whether meshes can be read without an extension that a file requires: it is about materials and
/// light alone, or is how accessors are read anyway.
static bool can_do_without(const char *extension) {
    static const char *const prefixes[] = {"KHR_materials_", "KHR_texture_", "KHR_lights_",
                                           "KHR_mesh_quantization"};
    for (size_t p = 0; p < sizeof prefixes / sizeof *prefixes; p++) {
        if (strncmp(extension, prefixes[p], strlen(prefixes[p])) == 0) return true;
    }
    return false;
}

static limn_bake_status check_extensions(const limni_gltf_reader *reader) {
    const limni_gltf *const document = reader->document;
    for (uint32_t e = 0; e < document->required_extension_count; e++) {
        if (!can_do_without(document->required_extensions[e]))
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: it requires the extension %s, which is not read", document->path,
                              document->required_extensions[e]);
    }
    for (uint32_t e = 0; e < document->extension_count; e++) {
        if (strcmp(document->extensions[e], "KHR_mesh_quantization") != 0)
            limni_note(reader->context, "%s: the extension %s is passed over", document->path,
                       document->extensions[e]);
    }
    return LIMN_BAKE_OK;
}

/// Nodes are read as they are; the rest is out of accessors.
static limn_bake_status read(const limni_gltf_reader *reader) {
    const limni_gltf *const document = reader->document;
    limni_model *const model = reader->model;
    *model = (limni_model){.path = document->path,
                           .nodes = document->nodes,
                           .node_count = document->node_count,
                           .roots = document->roots,
                           .root_count = document->root_count,
                           .has_scene = document->has_scene};
    LIMNI_TRY(check_extensions(reader));
    LIMNI_TRY(limni_gltf_read_meshes(reader));
    LIMNI_TRY(limni_gltf_read_skins(reader));
    LIMNI_TRY(limni_gltf_read_materials(reader));
    return limni_gltf_read_animations(reader);
}

/// The largest part of a document: what is needed of it has been copied.
static void release_bytes(limni_context *context, const limni_gltf *document) {
    for (uint32_t b = 0; b < document->buffer_count; b++)
        limni_release(context, (void *)(uintptr_t)document->buffers[b].bytes);
    for (uint32_t i = 0; i < document->image_count; i++)
        limni_release(context, (void *)(uintptr_t)document->images[i].bytes);
}

limn_bake_status limni_read_gltf(limni_context *context, const char *path, const char *name,
                                 const char *bytes, size_t size, limni_scene *scene) {
    limni_gltf document;
    LIMNI_TRY(limni_gltf_parse(context, path, bytes, size, &document));
    limni_model model;
    const limni_gltf_reader reader = {context, &document, &model};
    LIMNI_TRY(read(&reader));
    LIMNI_TRY(limni_read_model(context, &model, name, scene));
    release_bytes(context, &document);
    return LIMN_BAKE_OK;
}
