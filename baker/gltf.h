/* SPDX-License-Identifier: MIT */
/*
 * A glTF 2.0 document as plain structs: what tinygltf reads, and nothing that it means. Indices are
 * as in the file and unchecked, -1 where there is none; offsets and sizes too. All of it belongs to
 * the context. Names are "" where there is none.
 */
#ifndef LIMNI_GLTF_H
#define LIMNI_GLTF_H

#include "model.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct limni_gltf_buffer {
    const unsigned char *bytes;
    uint64_t size;
} limni_gltf_buffer;

typedef struct limni_gltf_view {
    int buffer;
    uint64_t offset, size;
    uint32_t stride; ///< 0: elements are packed
} limni_gltf_view;

/// Component types and shapes have the numbers of OpenGL and tinygltf.
enum {
    LIMNI_GLTF_BYTE = 5120,
    LIMNI_GLTF_UBYTE,
    LIMNI_GLTF_SHORT,
    LIMNI_GLTF_USHORT,
    LIMNI_GLTF_UINT = 5125,
    LIMNI_GLTF_FLOAT
};

typedef struct limni_gltf_accessor {
    const char *name;
    int view; ///< -1: zeros
    uint64_t offset, count;
    int component_type;
    uint32_t component_count; ///< of one element: 1 to 4, or 16 of a matrix of 4 by 4
    bool normalised;
    uint64_t sparse_count; ///< 0: none
    int sparse_index_view, sparse_index_type, sparse_value_view;
    uint64_t sparse_index_offset, sparse_value_offset;
} limni_gltf_accessor;

typedef struct limni_gltf_attribute {
    const char *name; ///< such as POSITION
    int accessor;
} limni_gltf_attribute;

typedef struct limni_gltf_attributes {
    limni_gltf_attribute *items;
    uint32_t count;
} limni_gltf_attributes;

typedef struct limni_gltf_primitive {
    limni_gltf_attributes attributes;
    limni_gltf_attributes *targets;
    uint32_t target_count;
    int indices, material, mode;
} limni_gltf_primitive;

typedef struct limni_gltf_mesh {
    const char *name;
    limni_gltf_primitive *primitives;
    uint32_t primitive_count;
    double *weights; ///< [weight_count] of morph targets
    uint32_t weight_count;
    const char **target_names; ///< [target_name_count] from extras.targetNames
    uint32_t target_name_count;
    limni_model_tags tags;
} limni_gltf_mesh;

typedef struct limni_gltf_skin {
    const char *name;
    int *joints; ///< [joint_count] nodes
    uint32_t joint_count;
    int inverse_binds;
} limni_gltf_skin;

typedef struct limni_gltf_channel {
    int node, input, output; ///< accessors of the sampler
    const char *path, *interpolation;
} limni_gltf_channel;

typedef struct limni_gltf_animation {
    const char *name;
    limni_gltf_channel *channels;
    uint32_t channel_count;
} limni_gltf_animation;

typedef struct limni_gltf_material {
    const char *name;
    double base_colour[4];
    int base_texture;      ///< a texture
    uint32_t base_channel; ///< n of TEXCOORD_n
    const char *ignored;   ///< what else it has, as words with commas; "": nothing
} limni_gltf_material;

/// Either in a buffer view, or with a path that `bytes` come from; or inside the document.
typedef struct limni_gltf_image {
    const char *name, *uri;
    int view;
    const unsigned char *bytes; ///< NULL: in a view, or it could not be read
    uint64_t size;
} limni_gltf_image;

typedef struct limni_gltf {
    const char *path; ///< for messages
    limni_gltf_buffer *buffers;
    limni_gltf_view *views;
    limni_gltf_accessor *accessors;
    limni_gltf_mesh *meshes;
    limni_model_node *nodes;
    limni_gltf_skin *skins;
    limni_gltf_animation *animations;
    limni_gltf_material *materials;
    int *textures; ///< their images
    limni_gltf_image *images;
    const char **extensions; ///< used
    const char **required_extensions;
    uint32_t buffer_count, view_count, accessor_count, mesh_count, node_count, skin_count,
        animation_count, material_count, texture_count, image_count, extension_count,
        required_extension_count;
    int *roots; ///< nodes of the scene
    uint32_t root_count;
    bool has_scene; ///< otherwise all nodes that are no children are roots
} limni_gltf;

/// Reads a document, .gltf or .glb by its first bytes, and the files beside `path` that it names.
/// Fails with LIMN_BAKE_BAD_INPUT and the words of the library.
limn_bake_status limni_gltf_parse(limni_context *context, const char *path, const char *bytes,
                                  size_t size, limni_gltf *document);

#ifdef __cplusplus
}
#endif

#endif
