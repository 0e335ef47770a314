/* SPDX-License-Identifier: MIT */
/*
 * A document with meshes and what moves and colours them, whatever its format: plain arrays, as long
 * as their counts say, of finite numbers. What is an index is unchecked, -1 where there is none;
 * read_model.c and what it calls check these. All of it belongs to the context. Names are "" where
 * there is none.
 */
#ifndef LIMNI_MODEL_H
#define LIMNI_MODEL_H

#include "context.h"

#ifdef __cplusplus
extern "C" {
#endif

/// "mesh 3 'body'", for messages.
typedef char limni_label[96];

/// One set of texture coordinates or colours of a part.
typedef struct limni_model_set {
    float (*values)[3]; ///< [vertex_count] further components are 0; NULL: the part has none
    bool has_alpha;     ///< that was not 1, and is dropped
} limni_model_set;

typedef struct limni_model_influence {
    uint32_t vertex; ///< of the part
    uint32_t joint;  ///< of the skin
    float weight;
} limni_model_influence;

/// Some of the faces of a mesh, with vertices of their own.
typedef struct limni_model_part {
    char label[128];                   ///< "mesh 0 'body', primitive 1"
    uint32_t first;                    ///< in: nothing; its first vertex among those of the mesh
    float (*positions)[3];             ///< [vertex_count]
    uint32_t *face_offsets;            ///< [face_count + 1] into corners
    uint32_t *corners;                 ///< vertices
    limni_model_set *uvs;              ///< [uv_count]
    limni_model_set *colours;          ///< [colour_count]
    limni_model_influence *influences; ///< [influence_count]
    float (**targets)[3];              ///< [target_count][vertex_count] movements; NULL: none
    uint32_t vertex_count, face_count, uv_count, colour_count, influence_count, target_count;
    int material;
} limni_model_part;

/// Sharpness, by vertices that count through the parts: `extras.limn` of glTF (docs/meshes.md).
typedef struct limni_model_tags {
    double (*creases)[3]; ///< two vertices and a sharpness
    double (*corners)[2]; ///< a vertex and a sharpness
    uint32_t crease_count, corner_count;
    const char *boundary, *creasing; ///< NULL or "": nothing is said
    const char *mistake;             ///< what is wrong with them; NULL: nothing
} limni_model_tags;

typedef struct limni_model_mesh {
    const char *name;
    limni_model_part *parts;   ///< [part_count] those that have faces
    double *weights;           ///< [weight_count] of morph targets, at rest
    const char **target_names; ///< [target_name_count]
    uint32_t part_count, weight_count, target_name_count;
    limni_model_tags tags;
} limni_model_mesh;

typedef struct limni_model_node {
    const char *name;
    int mesh, skin;
    bool has_camera, has_light;
    int *children; ///< [child_count]
    uint32_t child_count;
    bool has_matrix;
    double matrix[16]; ///< column by column; or what follows
    double translation[3], rotation[4], scale[3];
    double *weights; ///< [weight_count] of morph targets, at rest, in the place of the mesh's
    uint32_t weight_count;
    const char *mistake; ///< what is wrong with its numbers; NULL: nothing
} limni_model_node;

typedef struct limni_model_skin {
    const char *name;
    int *joints;                  ///< [joint_count] nodes; one may be there several times
    float (*inverse_binds)[3][4]; ///< [joint_count] rows; NULL: all do nothing
    uint32_t joint_count;
} limni_model_skin;

/// Keys of one thing that moves.
typedef struct limni_model_channel {
    char label[192]; ///< "animation 0 'walk', channel 3"
    int node;
    uint8_t path, interpolation; ///< as those of limn_file_track
    uint32_t width;              ///< of a value; of weights, as many as there are targets
    uint32_t key_count;
    float *times;  ///< [key_count] seconds
    float *values; ///< [key_count][1, of cubic ones 3][width]
} limni_model_channel;

typedef struct limni_model_animation {
    const char *name;
    limni_model_channel *channels; ///< [channel_count]
    uint32_t channel_count;
} limni_model_animation;

typedef struct limni_model_material {
    const char *name;
    double base_colour[4];
    int image;               ///< of the base colour
    uint32_t uv_set;         ///< of its texture
    const char *mistake;     ///< why it has no texture; NULL: it has, or needs none
    const char *passed_over; ///< what else it has, as words with commas; "": nothing
} limni_model_material;

typedef struct limni_model_image {
    const char *name, *uri;     ///< "": it lies in the document
    const unsigned char *bytes; ///< NULL: they are not to be had
    uint64_t size;
} limni_model_image;

typedef struct limni_model {
    const char *path; ///< for messages
    limni_model_mesh *meshes;
    limni_model_node *nodes;
    limni_model_skin *skins;
    limni_model_animation *animations;
    limni_model_material *materials;
    limni_model_image *images;
    uint32_t mesh_count, node_count, skin_count, animation_count, material_count, image_count;
    int *roots; ///< [root_count] nodes of the scene
    uint32_t root_count;
    bool has_scene; ///< otherwise all nodes are in it
} limni_model;

/// Returns `text`.
const char *limni_label_make(limni_label text, const char *what, uint32_t index, const char *name);

#ifdef __cplusplus
}
#endif

#endif
