/* SPDX-License-Identifier: MIT */
#include "base.h"

#include "classify.h"

#include <string.h>

void limni_place_points(const limni_stencils *stencils, float (*points)[3], uint32_t control_count,
                        uint32_t count) {
    const limn_mesh view = {.control_count = control_count,
                            .point_count = control_count + count,
                            .stencils = stencils->offsets,
                            .terms = stencils->terms,
                            .kernels = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_REPRODUCIBLE)};
    limn_mesh_refine(&view, points[0]);
}

/// How many faces are no patches of the domain.
static uint32_t count_others(const limni_mesh *mesh) {
    const uint32_t size = limn_domain_get(mesh->domain)->corner_count;
    uint32_t count = 0;
    for (uint32_t face = 0; face < mesh->face_count; face++)
        count += limni_face_size(mesh, face) != size;
    return count;
}

static void note_division(limni_context *context, const limni_mesh *source,
                          const limni_mesh *made) {
    const char *const name = limni_mesh_label(source);
    const uint32_t others = count_others(source);
    if (others > 0)
        limni_note(context,
                   "%s: divided: %u of %u faces are not quads, so patches are the %u quads of the "
                   "first level of subdivision",
                   name, others, source->face_count, made->face_count);
    else
        limni_note(context,
                   "%s: divided: isolation takes two levels of this scheme, so patches are the %u "
                   "faces of the first",
                   name, made->face_count);
}

static limn_bake_status divide_mesh(limni_context *context, const limni_rules *rules,
                                    limni_base *base) {
    const limni_mesh *const source = base->source;
    limni_mesh *const made = &base->refined.mesh;
    LIMNI_TRY(limni_refine(context, source, &base->source_sharpness, rules, &base->refined));
    LIMNI_TRY(limni_check_valences(context, made, &base->refined.sharpness, rules));
    LIMNI_TRY(limni_make_stencils(context, source, &base->source_sharpness, rules, &base->refined,
                                  &base->stencils));
    const uint32_t count = source->control_count;
    float(*const points)[3] =
        limni_allocate(context, (size_t)count + made->control_count, sizeof *points);
    made->controls = limni_allocate(context, made->control_count, sizeof *made->controls);
    if (!points || !made->controls) return LIMN_BAKE_MEMORY;
    memcpy(points, source->controls, count * sizeof *points);
    limni_place_points(&base->stencils, points, count, made->control_count);
    memcpy(made->controls, points + count, made->control_count * sizeof *points);
    limni_release(context, points);
    if (!limni_is_flat(rules)) return LIMN_BAKE_OK;
    // Edges that are new inside a face are edges of faces now.
    limni_mesh_sharpness_end(context, &base->refined.sharpness);
    return limni_mesh_sharpness_begin(context, made, rules, &base->refined.sharpness);
}

/// Finds the mesh of a base whose source and sharpness are known.
static limn_bake_status find_mesh(limni_context *context, const limni_rules *rules,
                                  limni_base *base) {
    base->mesh = base->source;
    base->sharpness = &base->source_sharpness;
    if (!base->divided) return limni_check_valences(context, base->mesh, base->sharpness, rules);
    LIMNI_TRY(divide_mesh(context, rules, base));
    base->first = base->source->control_count;
    base->mesh = &base->refined.mesh;
    base->sharpness = &base->refined.sharpness;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_base_begin(limni_context *context, const limni_mesh *source,
                                  const limni_rules *rules, limni_base *base) {
    // Two levels apart, extraordinary vertices are out of each other's reach, if that is 2.
    const bool far = limni_scheme_of(rules, source->domain)->reach == 2;
    const bool isolated = rules->isolate == LIMN_ISOLATE_ALWAYS;
    *base =
        (limni_base){.source = source, .divided = count_others(source) > 0 || (far && isolated)};
    LIMNI_TRY(limni_mesh_sharpness_begin(context, source, rules, &base->source_sharpness));
    LIMNI_TRY(find_mesh(context, rules, base));
    if (base->divided) note_division(context, source, base->mesh);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_base_follow(limni_context *context, const limni_base *drawn,
                                   const limni_mesh *source, const limni_mesh_sharpness *sharpness,
                                   const limni_rules *rules, limni_base *base) {
    *base =
        (limni_base){.source = source, .divided = drawn->divided, .source_sharpness = *sharpness};
    return find_mesh(context, rules, base);
}

void limni_base_end(limni_context *context, limni_base *base) {
    limni_mesh_sharpness_end(context, &base->source_sharpness);
    if (!base->divided) return;
    limni_release(context, base->refined.mesh.controls);
    limni_refined_end(context, &base->refined);
    limni_release(context, base->stencils.offsets);
    limni_release(context, base->stencils.terms);
}
