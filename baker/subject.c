/* SPDX-License-Identifier: MIT */
#include "subject.h"

#include "info.h"

#include <string.h>

/// What a file says about how it was baked, or where its meshes differ, what the mesh asked for.
static limn_boundary boundary_of(const char *name, const limni_mesh *source) {
    if (strcmp(name, "mixed") == 0) return source->boundary;
    if (strcmp(name, "none") == 0) return LIMN_BOUNDARY_NONE;
    return strcmp(name, "edge-and-corner") == 0 ? LIMN_BOUNDARY_EDGE_AND_CORNER
                                                : LIMN_BOUNDARY_EDGE_ONLY;
}

static limn_creasing creasing_of(const char *name, const limni_mesh *source) {
    if (strcmp(name, "mixed") == 0) return source->creasing;
    return strcmp(name, "chaikin") == 0 ? LIMN_CREASING_CHAIKIN : LIMN_CREASING_UNIFORM;
}

static limn_bake_status read_scheme(limni_context *context, const limn_pack *pack,
                                    const limn_mesh *mesh, limni_subject *s) {
    char scheme[32], weights[32];
    limni_info_value(pack->info, "scheme", scheme, sizeof scheme);
    limni_info_value(pack->info, "weights", weights, sizeof weights);
    const bool quads = mesh->domain->kind == LIMN_DOMAIN_QUAD;
    if (strcmp(scheme, "loop") == 0) {
        *s = (limni_subject){.scheme = LIMNI_OPENSUBDIV_LOOP, .rules.scheme = LIMN_SCHEME_LOOP};
        if (strcmp(weights, "loop") == 0) return LIMN_BAKE_OK;
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "the file was baked with %s weights, which OpenSubdiv does not have",
                          weights);
    }
    if (strcmp(scheme, "catmark") == 0) {
        *s = (limni_subject){.scheme = LIMNI_OPENSUBDIV_CATMARK,
                             .rules.scheme = LIMN_SCHEME_CATMARK};
    } else if (strcmp(scheme, "none") == 0 && quads) {
        *s = (limni_subject){.scheme = LIMNI_OPENSUBDIV_BILINEAR, .rules.scheme = LIMN_SCHEME_NONE};
    } else {
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "the file was baked with --scheme %s, which OpenSubdiv does not have%s",
                          scheme, quads ? "" : " for triangles");
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_meshes(limni_context *context, const limn_pack *pack, const char *name,
                                    const char *path, limni_subject *s) {
    char boundary[32], creases[32], creasing[32];
    limni_source source = {0};
    context->desc.scheme = s->rules.scheme;
    LIMNI_TRY(limni_read_mesh(context, path, name, &source));
    LIMNI_TRY(limni_mesh_build(context, &source, &s->built));
    LIMNI_TRY(limni_read_mesh(context, path, name, &s->source));
    LIMNI_TRY(limni_mesh_begin(context, &s->source, &s->whole));
    limni_info_value(pack->info, "boundary", boundary, sizeof boundary);
    limni_info_value(pack->info, "creases", creases, sizeof creases);
    limni_info_value(pack->info, "creasing", creasing, sizeof creasing);
    if (strcmp(creases, "lomont") == 0 &&
        (limni_has_sharpness(&s->built) || limni_has_boundary(&s->built)))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: the mesh was baked with Lomont's rules for creases and boundaries, "
                          "which OpenSubdiv does not have",
                          path);
    s->rules.boundary = boundary_of(boundary, &s->built);
    s->rules.creasing = creasing_of(creasing, &s->built);
    return limni_base_begin(context, &s->built, &s->rules, &s->base);
}

static limn_bake_status check_same(limni_context *context, const limn_mesh *mesh,
                                   const limni_subject *s) {
    const limni_mesh *const source = &s->built;
    if (mesh->control_count != source->control_count ||
        mesh->face_count != s->base.mesh->face_count ||
        memcmp(mesh->controls, source->controls,
               source->control_count * sizeof *source->controls) != 0)
        return limni_fail(
            context, LIMN_BAKE_BAD_INPUT,
            "%s: mesh '%s' was baked from something else, or repaired or split differently",
            source->path, mesh->name);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_subject_read(limni_context *context, const limn_pack *pack,
                                    const limn_mesh *mesh, const char *path,
                                    limni_subject *subject) {
    LIMNI_TRY(read_scheme(context, pack, mesh, subject));
    LIMNI_TRY(read_meshes(context, pack, mesh->name, path, subject));
    return check_same(context, mesh, subject);
}

// ---- For OpenSubdiv

/// The corners of each face.
static limn_bake_status list_sizes(limni_context *context, const limni_mesh *mesh,
                                   uint32_t **sizes) {
    *sizes = limni_allocate(context, mesh->face_count, sizeof **sizes);
    if (!*sizes) return LIMN_BAKE_MEMORY;
    for (uint32_t face = 0; face < mesh->face_count; face++)
        (*sizes)[face] = limni_face_size(mesh, face);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_subject_describe(limni_context *context, const limni_subject *subject,
                                        limni_opensubdiv_mesh *mesh) {
    const limni_mesh *const whole = &subject->whole;
    uint32_t *sizes;
    LIMNI_TRY(list_sizes(context, whole, &sizes));
    *mesh = (limni_opensubdiv_mesh){
        .positions = whole->controls[0],
        .faces = whole->corners,
        .face_sizes = sizes,
        .position_count = whole->control_count,
        .face_count = whole->face_count,
        .scheme = subject->scheme,
        .divided = subject->base.divided,
        .boundary = subject->rules.boundary,
        .level = LIMN_LEVEL_MAX,
        .edge_sharpness = whole->edge_sharpness,
        .vertex_sharpness = whole->vertex_sharpness,
        .holes = whole->holes,
        .creasing = subject->rules.creasing,
    };
    return LIMN_BAKE_OK;
}

// ---- Rows

static uint32_t row_at(const limn_domain *domain, uint32_t i, uint32_t j) {
    uint32_t row = 0;
    while (domain->rows[row].i != i || domain->rows[row].j != j)
        row++;
    return row;
}

/// The row of the unrotated domain at the same place as `row` of a patch that starts at corner
/// `rotation`.
static uint32_t unrotate(const limn_domain *domain, uint32_t row, uint32_t rotation) {
    uint32_t i = domain->rows[row].i, j = domain->rows[row].j;
    for (; rotation > 0; rotation--) {
        const uint32_t before = i;
        if (domain->kind == LIMN_DOMAIN_QUAD) {
            i = LIMN_GRID_SIZE - j;
            j = before;
        } else {
            i = LIMN_GRID_SIZE - i - j;
            j = before;
        }
    }
    return row_at(domain, i, j);
}

void limni_unrotate(const limn_domain *domain, limni_unrotated rows) {
    for (uint32_t rotation = 0; rotation < domain->corner_count; rotation++) {
        for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++)
            rows[rotation][row] = unrotate(domain, row, rotation);
    }
}
