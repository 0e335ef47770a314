/* SPDX-License-Identifier: MIT */
/*
 * From a glTF document to a model: the numbers of all accessors that it needs, checked against their
 * buffers. What cannot be used is refused, and what is passed over is noted, by name.
 */
#ifndef LIMNI_GLTF_READER_H
#define LIMNI_GLTF_READER_H

#include "gltf.h"

typedef struct limni_gltf_reader {
    limni_context *context;
    const limni_gltf *document;
    limni_model *model;
} limni_gltf_reader;

/// The meshes that nodes have; others are left empty.
limn_bake_status limni_gltf_read_meshes(const limni_gltf_reader *reader);
/// What the vertices of a primitive have beside places and faces.
limn_bake_status limni_gltf_read_attributes(const limni_gltf_reader *reader,
                                            const limni_gltf_primitive *primitive,
                                            limni_model_part *part);
/// The skins that nodes have.
limn_bake_status limni_gltf_read_skins(const limni_gltf_reader *reader);
/// Meshes must have been read.
limn_bake_status limni_gltf_read_animations(const limni_gltf_reader *reader);
/// With the images of base colours.
limn_bake_status limni_gltf_read_materials(const limni_gltf_reader *reader);

/// The accessor of an attribute, or -1.
int limni_gltf_attribute_of(const limni_gltf_attributes *attributes, const char *name);

// ---- Accessors

/// An accessor that is about to be read, checked against its buffer.
///
/// what   for messages: "POSITION of mesh 0 'body', primitive 1"
limn_bake_status limni_gltf_find_accessor(const limni_gltf_reader *reader, int index,
                                          const char *what, const limni_gltf_accessor **accessor);

/// Elements as floats; integers as numbers, or normalised. Fails where the accessor has another
/// shape, lies outside its buffer or holds what is not finite.
///
/// count  how many elements it must have
/// out    [count][component_count]
limn_bake_status limni_gltf_read_floats(const limni_gltf_reader *reader, int index,
                                        const char *what, uint64_t count, uint32_t component_count,
                                        float *out);

/// The same of unsigned integers.
limn_bake_status limni_gltf_read_integers(const limni_gltf_reader *reader, int index,
                                          const char *what, uint64_t count,
                                          uint32_t component_count, uint32_t *out);

#endif
