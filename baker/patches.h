/* SPDX-License-Identifier: MIT */
/* The patches of one mesh, ordered by material and class, and ready to be written. */
#ifndef LIMNI_PATCHES_H
#define LIMNI_PATCHES_H

#include "channel.h"
#include "classes.h"
#include "control_normals.h"
#include "cost.h"
#include "rig.h"

/// What a mesh takes, baked alone; bytes without control points and their normals.
typedef struct limni_footprint {
    uint64_t tables; ///< with what classes in pieces have in their place
    uint64_t total;  ///< with patches, and points
    limni_cost cost; ///< of positions
} limni_footprint;

typedef struct limni_patches {
    const char *name;
    limni_rules rules; ///< by which its classes were made
    bool sharp;        ///< whether it has tags of sharpness
    limn_file_mesh record;
    float (*controls)[3];          ///< [point_count]
    limni_stencils stencils;       ///< of all points behind the control points
    limni_footprint footprints[2]; ///< with LIMN_ISOLATE_AUTO; otherwise 0
    limn_file_run *runs;
    uint32_t *faces;   ///< [patch_count] face << 2 | rotation; channels share those of the mesh
    uint32_t *indices; ///< [index_count]
    uint8_t *slots;
    uint64_t slots_size;           ///< in bytes
    uint16_t *errors;              ///< [patch_count][corner_count], see runtime/edge_error.h
    uint8_t *creases;              ///< [patch_count] bit e: edge e stays sharp; NULL: none does
    limni_control_normals normals; ///< empty without normals
    uint32_t
        *corner_normals;   ///< [patch_count][corner_count] by its corners; NULL: its control points
    limni_control_rig rig; ///< empty, unless the source has one
    limn_file_range *ranges; ///< [range_count] of materials; NULL: nothing is said of them
    uint32_t range_count;
    struct limni_patches *channels;   ///< [record.channel_count] in the same order
    limn_file_channel channel_record; ///< of a channel, which has no errors, creases or normals
} limni_patches;

/// All but the errors of edges: classifies every face of a base mesh, and of its channels, and lists
/// its patches; adds the classes and the pieces that are new. Checks that patches which share an
/// edge agree on it, and fails with LIMN_BAKE_INTERNAL if any two do not.
///
/// channels  [channel_count] of the base
limn_bake_status limni_patches_build(limni_context *context, const limni_base *base,
                                     const limni_rules *rules, const limni_channel *channels,
                                     uint32_t channel_count, limni_classes *classes,
                                     limni_classes *pieces, limni_patches *patches);

static inline uint32_t limni_corner_count(const limni_patches *patches) {
    return limn_domain_get((limn_domain_kind)patches->record.domain)->corner_count;
}

/// The half-edge of the base mesh that is edge `edge` of a patch.
static inline uint32_t limni_patch_half_edge(const limni_patches *patches, const limni_mesh *mesh,
                                             uint32_t patch, uint32_t edge) {
    const uint32_t face = patches->faces[patch] >> 2, rotation = patches->faces[patch] & 3;
    return mesh->offsets[face] + (edge + rotation) % limni_corner_count(patches);
}

#endif
