/* SPDX-License-Identifier: MIT */
/*
 * Topology classes: faces whose surroundings are the same up to naming share one stencil table.
 *
 * The key of a face is its whole surroundings in canonical form: valences and boundary status of the
 * corners, then the rings as slots, with a reach of 2 those of the vertices next to them as well, and
 * where something is sharp inside, all sharpness and what the rules have to know of the far ends.
 * Slots are given in the order of a walk around the corners, so a control point that occurs in
 * two rings, as on small meshes, shows in the key. Canonical rotation: where two valences of a
 * triangle are equal, the third comes first, so that a mirror line, if there is one, goes through the
 * first corner; otherwise, and of quads, Brickhill's, lowest valence first. Ties are decided by the
 * rest of the key.
 */
#ifndef LIMNI_CLASSIFY_H
#define LIMNI_CLASSIFY_H

#include "limn/format.h"
#include "mesh_sharpness.h"
#include "neighbourhood.h"

/// The surroundings of one face in one mesh.
typedef struct limni_local_base {
    const limni_mesh *mesh;
    const limni_mesh_sharpness *sharpness;
    uint32_t face;
    uint32_t rotation; ///< corner c of the patch is corner (c + rotation) mod corners of the face
    uint32_t corner_count;
    limni_star corners[LIMN_CORNER_MAX]; ///< with slots as their rings
    uint32_t control_count; ///< K: slots 0, 1, ... are the corners, the others follow around them
    uint32_t inner_count; ///< of slots whose stars matter: the corners, and with a reach of 2 those
                          ///< next to them
    uint32_t *controls;   ///< [control_count] control points by slot
    uint32_t *twins; ///< [control_count] the first slot that was the same control point before the
                     ///< mesh was split
    uint32_t twin_count; ///< slots that are not the first
    uint32_t *room;      ///< [4][edges_max] what the stars point into
    size_t edges_max;
    uint32_t *spokes; ///< [inner_count] a half-edge from each slot to one before it
    uint32_t *rings;  ///< [rings_size] what the key says of the stars of inner slots behind the
                      ///< corners
    uint32_t rings_size;
    uint32_t *key; ///< [key_size]
    uint32_t key_size;
} limni_local_base;

/// Finds local bases in one mesh.
typedef struct limni_classifier {
    const limni_mesh *mesh;
    const limni_rules *rules;
    const limni_mesh_sharpness *sharpness;
    uint32_t *slots;  ///< [control_count] the slot of a control point, valid where marks match
    uint32_t *marks;  ///< [control_count]
    uint32_t mark;    ///< of the current local base
    size_t slots_max; ///< of a local base
    limni_local_base bases[2]; ///< the best rotation so far and the one being tried
} limni_classifier;

limn_bake_status limni_classifier_begin(limni_context *context, limni_classifier *classifier,
                                        const limni_mesh *mesh,
                                        const limni_mesh_sharpness *sharpness,
                                        const limni_rules *rules);
void limni_classifier_end(limni_context *context, limni_classifier *classifier);

/// Refuses faces that depend on more than LIMN_FORMAT_CONTROLS_MAX points, or may do so.
limn_bake_status limni_check_valences(limni_context *context, const limni_mesh *mesh,
                                      const limni_mesh_sharpness *sharpness,
                                      const limni_rules *rules);

/// The local base of a face in its canonical rotation. Valid until the next call.
const limni_local_base *limni_classify(limni_classifier *classifier, uint32_t face);

/// The same in a rotation that is known to be the canonical one.
const limni_local_base *limni_local_base_at(limni_classifier *classifier, uint32_t face,
                                            uint32_t rotation);

/// The part of the mesh that the coefficients of a local base follow from.
limn_bake_status limni_local_neighbourhood(limni_context *context, const limni_local_base *base,
                                           limni_neighbourhood *neighbourhood);

#endif
