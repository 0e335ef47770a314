/* SPDX-License-Identifier: MIT */
/* The faces of a source become those of a mesh: triangles, or the polygons themselves. */
#include "triangulate.h"

#include <string.h>

static bool has_other_than(const limni_source *source, uint32_t size) {
    for (uint32_t face = 0; face < source->face_count; face++) {
        if (source->face_offsets[face + 1] - source->face_offsets[face] != size) return true;
    }
    return false;
}

/// Loop's faces and the butterfly's are triangles, those of Catmull-Clark any polygons; without a
/// scheme a mesh of triangles stays one, and others are bilinear.
static limn_domain_kind domain_of(limn_scheme scheme, const limni_source *source) {
    switch (scheme) {
    case LIMN_SCHEME_CATMARK:
        return LIMN_DOMAIN_QUAD;
    case LIMN_SCHEME_NONE:
        return has_other_than(source, 3) ? LIMN_DOMAIN_QUAD : LIMN_DOMAIN_TRIANGLE;
    default:
        return LIMN_DOMAIN_TRIANGLE;
    }
}

static void copy_faces(const limni_source *source, limni_mesh *mesh) {
    mesh->face_count = source->face_count;
    memcpy(mesh->corners, source->face_corners,
           source->face_offsets[source->face_count] * sizeof *mesh->corners);
    for (uint32_t c = 0; c < source->face_offsets[source->face_count]; c++)
        mesh->source_corners[c] = c;
    for (uint32_t face = 0; face < source->face_count; face++)
        mesh->polygons[face] = face;
}

/// Numbers the half-edges.
static limn_bake_status make_offsets(limni_context *context, const limni_source *source,
                                     limni_mesh *mesh) {
    const bool cut = mesh->domain == LIMN_DOMAIN_TRIANGLE;
    mesh->offsets = limni_allocate(context, (size_t)mesh->face_count + 1, sizeof *mesh->offsets);
    if (!mesh->offsets) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face <= mesh->face_count; face++)
        mesh->offsets[face] = cut ? 3 * face : source->face_offsets[face];
    return limni_index_half_edges(context, mesh);
}

limn_bake_status limni_index_half_edges(limni_context *context, limni_mesh *mesh) {
    mesh->half_edge_count = mesh->offsets[mesh->face_count];
    mesh->face_of = limni_allocate(context, mesh->half_edge_count, sizeof *mesh->face_of);
    if (!mesh->face_of) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        for (uint32_t h = mesh->offsets[face]; h < mesh->offsets[face + 1]; h++)
            mesh->face_of[h] = face;
    }
    return LIMN_BAKE_OK;
}

limn_bake_status limni_make_faces(limni_context *context, const limni_source *source,
                                  limni_mesh *mesh) {
    const uint64_t corner_count = source->face_offsets[source->face_count];
    const uint64_t triangle_count = corner_count - 2 * (uint64_t)source->face_count;
    const limn_domain_kind domain = domain_of(context->desc.scheme, source);
    const bool cut = domain == LIMN_DOMAIN_TRIANGLE;
    const uint64_t face_count = cut ? triangle_count : source->face_count;
    const size_t half_edge_count = (size_t)(cut ? 3 * triangle_count : corner_count);
    *mesh = (limni_mesh){
        .name = source->name,
        .path = source->path,
        .control_numbers = source->position_numbers,
        .control_lines = source->position_lines,
        .face_lines = source->face_lines,
        .face_materials = source->face_materials,
        .face_numbers = source->face_numbers,
        .index_base = source->index_base,
        .domain = domain,
        .control_count = source->position_count,
        .controls = source->positions,
        .corners = limni_allocate(context, half_edge_count, sizeof *mesh->corners),
        .source_corners = limni_allocate(context, half_edge_count, sizeof *mesh->source_corners),
        .polygons = limni_allocate(context, (size_t)face_count, sizeof *mesh->polygons),
    };
    if (!mesh->corners || !mesh->source_corners || !mesh->polygons) return LIMN_BAKE_MEMORY;
    if (cut)
        LIMNI_TRY(limni_triangulate(context, source, mesh));
    else
        copy_faces(source, mesh);
    return make_offsets(context, source, mesh);
}

void limni_mesh_end(limni_context *context, const limni_mesh *mesh) {
    limni_release(context, mesh->origins);
    limni_release(context, mesh->offsets);
    limni_release(context, mesh->corners);
    limni_release(context, mesh->source_corners);
    limni_release(context, mesh->face_of);
    limni_release(context, mesh->polygons);
    limni_release(context, mesh->pairs);
    limni_release(context, mesh->first);
    limni_release(context, mesh->valences);
    limni_release(context, mesh->edge_sharpness);
    limni_release(context, mesh->vertex_sharpness);
    limni_release(context, mesh->holes);
}
