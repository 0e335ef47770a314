/* SPDX-License-Identifier: MIT */
/* The public face of the baker: each mesh goes through the steps as it is added. */
#include "limn/bake.h"

#include "check_options.h"
#include "choose_isolation.h"
#include "edge_errors.h"
#include "output_file.h"
#include "scene.h"
#include "scheme.h"
#include "write.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct limn_baker {
    limni_context context;
    limni_rules rules;
    limni_classes classes, pieces;
    limni_patches *meshes;
    uint32_t mesh_count, mesh_capacity;
    limni_character character;
    limn_bake_status failed; ///< the first error: after it nothing can be trusted
    unsigned char *blob;     ///< of all meshes so far, or NULL
    size_t blob_size;
};

limn_baker *limn_baker_create(const limn_bake_desc *desc) {
    limn_baker *const baker = calloc(1, sizeof *baker);
    if (!baker) return NULL;
    if (desc) baker->context.desc = *desc;
    baker->failed = limni_check_options(&baker->context);
    if (baker->failed != LIMN_BAKE_OK) return baker;
    baker->rules = (limni_rules){.scheme = baker->context.desc.scheme,
                                 .weights = baker->context.desc.weights,
                                 .tension = limni_fixed_from(baker->context.desc.tension),
                                 .boundary = baker->context.desc.boundary,
                                 .creases = baker->context.desc.creases,
                                 .creasing = baker->context.desc.creasing,
                                 .normals = baker->context.desc.normals,
                                 .isolate = baker->context.desc.isolate,
                                 .face_varying = baker->context.desc.face_varying};
    return baker;
}

void limn_baker_destroy(limn_baker *baker) {
    if (!baker) return;
    limni_release_all(&baker->context);
    free(baker);
}

const char *limn_baker_error(const limn_baker *baker) {
    return baker ? baker->context.error : "out of memory";
}

/// A copy without control characters, which terminals and text files would act on.
static char *copy_name(limni_context *context, const char *name) {
    char *const copy = limni_allocate(context, strlen(name) + 1, 1);
    if (!copy) return NULL;
    strcpy(copy, name);
    for (char *c = copy; *c; c++) {
        if ((unsigned char)*c < ' ' || *c == 0x7f) *c = '_';
    }
    return copy;
}

/// The options, and what they leave to the mesh.
static limni_rules rules_for(const limni_rules *options, const limni_mesh *mesh) {
    limni_rules rules = *options;
    if (rules.boundary == LIMN_BOUNDARY_DEFAULT) rules.boundary = mesh->boundary;
    if (rules.boundary == LIMN_BOUNDARY_DEFAULT) rules.boundary = LIMN_BOUNDARY_EDGE_ONLY;
    const bool lomont = rules.creases == LIMN_CREASES_LOMONT; // whose sharpness falls by 1
    if (rules.creasing == LIMN_CREASING_DEFAULT && !lomont) rules.creasing = mesh->creasing;
    if (rules.creasing == LIMN_CREASING_DEFAULT) rules.creasing = LIMN_CREASING_UNIFORM;
    if (rules.scheme == LIMN_SCHEME_BUTTERFLY && rules.isolate == LIMN_ISOLATE_AUTO)
        rules.isolate = LIMN_ISOLATE_NEVER; // would divide the mesh, which is for the user to say
    if (!limni_scheme_has_creases(rules.scheme)) {
        rules.creasing = LIMN_CREASING_UNIFORM;
        if (rules.boundary == LIMN_BOUNDARY_EDGE_AND_CORNER)
            rules.boundary = LIMN_BOUNDARY_EDGE_ONLY;
    }
    return rules;
}

/// Says where a mesh was made for other rules.
static void note_rules(limni_context *context, const limni_rules *rules, bool is_lomont,
                       const limni_mesh *mesh) {
    const bool lomont = rules->creases == LIMN_CREASES_LOMONT;
    if (is_lomont && !lomont && (limni_has_sharpness(mesh) || limni_has_boundary(mesh)))
        limni_note(context,
                   "%s: a mesh of Lomont's with OpenSubdiv's creases and boundaries; his are "
                   "--creases lomont",
                   limni_mesh_label(mesh));
    if (rules->scheme == LIMN_SCHEME_BUTTERFLY && context->desc.isolate == LIMN_ISOLATE_AUTO)
        limni_note(context,
                   "%s: not isolated: with the butterfly that divides the mesh, which --isolate 1 "
                   "asks for",
                   limni_mesh_label(mesh));
    if (rules->scheme == LIMN_SCHEME_BUTTERFLY && limni_has_sharpness(mesh))
        limni_note(context, "%s: sharp edges and vertices are smooth: the butterfly has no creases",
                   limni_mesh_label(mesh));
    if (lomont && mesh->creasing == LIMN_CREASING_CHAIKIN && limni_has_sharpness(mesh))
        limni_note(context, "%s: Chaikin's creasing is ignored: Lomont has none",
                   limni_mesh_label(mesh));
}

/// What the rules make of the mesh before it is classified.
static limn_bake_status apply_rules(limni_context *context, const limni_rules *rules,
                                    limni_mesh *mesh) {
    if (rules->scheme == LIMN_SCHEME_BUTTERFLY && mesh->origins)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: not a manifold, and sheets of the butterfly would not meet",
                          limni_mesh_label(mesh));
    if (rules->boundary == LIMN_BOUNDARY_NONE) limni_mesh_open_boundary(mesh);
    if (mesh->hole_count == mesh->face_count)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: all faces are holes",
                          limni_mesh_label(mesh));
    return LIMN_BAKE_OK;
}

static void release_channels(limni_context *context, limni_source *source) {
    for (uint32_t c = 0; c < source->channel_count; c++) {
        limni_release(context, source->channels[c].values);
        limni_release(context, source->channels[c].corner_values);
    }
    limni_release(context, source->channels);
    source->channels = NULL;
    source->channel_count = 0;
}

static void release_source(limni_context *context, limni_source *source) {
    limni_release(context, source->position_numbers);
    limni_release(context, source->position_lines);
    limni_release(context, source->face_offsets);
    limni_release(context, source->face_corners);
    limni_release(context, source->face_numbers);
    limni_release(context, source->face_lines);
    limni_release(context, source->face_materials);
    limni_rig_release(context, &source->rig);
    release_channels(context, source);
    limni_release(context, source->tags.creases);
    limni_release(context, source->tags.sharp_vertices);
    limni_release(context, source->tags.holes);
}

static limn_bake_status add_source(limn_baker *baker, limni_source *source) {
    limni_context *const context = &baker->context;
    source->name = copy_name(context, source->name ? source->name : "mesh");
    if (!source->name) return LIMN_BAKE_MEMORY;
    if (baker->mesh_count == baker->mesh_capacity) {
        baker->mesh_capacity = baker->mesh_capacity ? 2 * baker->mesh_capacity : 4;
        baker->meshes =
            limni_resize(context, baker->meshes, baker->mesh_capacity, sizeof *baker->meshes);
        if (!baker->meshes) return LIMN_BAKE_MEMORY;
    }
    limni_release(context, baker->blob);
    baker->blob = NULL;
    if (context->desc.no_channels) release_channels(context, source);
    limni_mesh mesh;
    LIMNI_TRY(limni_mesh_build(context, source, &mesh));
    limni_rules rules = rules_for(&baker->rules, &mesh);
    LIMNI_TRY(apply_rules(context, &rules, &mesh));
    note_rules(context, &rules, source->tags.is_lomont, &mesh);
    limni_footprint footprints[2] = {0};
    limni_base base;
    LIMNI_TRY(limni_base_begin(context, &mesh, &rules, &base));
    LIMNI_TRY(limni_choose_isolation(context, source, &base, &rules, footprints));
    limni_channel *channels;
    LIMNI_TRY(limni_channels_begin(context, source, &base, &rules, &channels));
    limni_patches *const patches = &baker->meshes[baker->mesh_count];
    LIMNI_TRY(limni_patches_build(context, &base, &rules, channels, source->channel_count,
                                  &baker->classes, &baker->pieces, patches));
    LIMNI_TRY(
        limni_edge_errors_build(context, base.mesh, &baker->classes, &baker->pieces, patches));
    LIMNI_TRY(limni_rig_build(context, source, &mesh, &patches->rig));
    memcpy(patches->footprints, footprints, sizeof footprints);
    if (patches->controls != mesh.controls) limni_release(context, mesh.controls);
    baker->mesh_count++;
    for (uint32_t c = 0; c < source->channel_count; c++) {
        if (patches->channels[c].controls != channels[c].mesh.controls)
            limni_release(context, channels[c].mesh.controls);
    }
    limni_channels_end(context, channels, source->channel_count);
    release_source(context, source);
    limni_base_end(context, &base);
    limni_mesh_end(context, &mesh);
    return LIMN_BAKE_OK;
}

static limn_bake_status add_file(limn_baker *baker, const char *path) {
    limni_scene scene = {.first_mesh = baker->mesh_count, .character = &baker->character};
    LIMNI_TRY(limni_read_scene(&baker->context, path, &scene));
    for (uint32_t s = 0; s < scene.source_count; s++)
        LIMNI_TRY(add_source(baker, &scene.sources[s]));
    return LIMN_BAKE_OK;
}

limn_bake_status limn_baker_add_file(limn_baker *baker, const char *path) {
    LIMNI_TRY(baker->failed);
    return baker->failed = add_file(baker, path);
}

// ---- Meshes from memory

static limn_bake_status check_mesh(limni_context *context, const limn_bake_mesh *mesh,
                                   uint64_t *corner_count) {
    const char *const name = mesh->name ? mesh->name : "mesh";
    if (mesh->position_count == 0 || mesh->face_count == 0)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: the mesh is empty", name);
    for (uint32_t p = 0; p < mesh->position_count; p++) {
        const float *const position = mesh->positions + 3 * (size_t)p;
        if (!isfinite(position[0]) || !isfinite(position[1]) || !isfinite(position[2]))
            return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: vertex %u is not finite", name, p);
    }
    *corner_count = 0;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const uint32_t size = mesh->face_sizes ? mesh->face_sizes[face] : 3;
        if (size < 3)
            return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: face %u has %u corners", name,
                              face, size);
        for (uint32_t c = 0; c < size; c++) {
            const uint32_t index = mesh->face_indices[*corner_count + c];
            if (index >= mesh->position_count)
                return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                                  "%s: face %u refers to vertex %u, but there are %u", name, face,
                                  index, mesh->position_count);
        }
        *corner_count += size;
    }
    if (*corner_count > UINT32_MAX)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: too many faces", name);
    return LIMN_BAKE_OK;
}

static limn_bake_status check_sharpness(limni_context *context, const limn_bake_mesh *mesh,
                                        const char *what, const float *values, uint32_t count) {
    for (uint32_t v = 0; v < count; v++) {
        if (!(values[v] >= 0))
            return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                              "%s: the sharpness of %s %u is negative or not a number",
                              mesh->name ? mesh->name : "mesh", what, v);
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status check_channel(limni_context *context, const limn_bake_mesh *mesh,
                                      const limn_bake_channel *channel, uint64_t corner_count) {
    const char *const name = mesh->name ? mesh->name : "mesh";
    const char *const own = channel->name ? channel->name : "channel";
    if (channel->component_count < 1 || channel->component_count > 3)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: %s has %u components; 1 to 3 are right", name, own,
                          channel->component_count);
    for (uint64_t v = 0; v < (uint64_t)channel->value_count * channel->component_count; v++) {
        if (!isfinite(channel->values[v]))
            return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: value %llu of %s is not finite",
                              name, (unsigned long long)v / channel->component_count, own);
    }
    for (uint64_t c = 0; c < corner_count; c++) {
        if (channel->corner_values[c] >= channel->value_count)
            return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                              "%s: corner %llu refers to value %u of %s, but there are %u", name,
                              (unsigned long long)c, channel->corner_values[c], own,
                              channel->value_count);
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status copy_channel(limni_context *context, const limn_bake_channel *channel,
                                     uint64_t corner_count, limni_source_channel *made) {
    const uint32_t size = channel->component_count;
    *made = (limni_source_channel){
        .name = copy_name(context, channel->name ? channel->name : "channel"),
        .kind = channel->kind,
        .component_count = size,
        .values = limni_allocate_zeroed(context, channel->value_count, sizeof *made->values),
        .value_count = channel->value_count,
        .corner_values = limni_allocate(context, (size_t)corner_count, sizeof *made->corner_values),
    };
    if (!made->name || !made->values || !made->corner_values) return LIMN_BAKE_MEMORY;
    for (size_t v = 0; v < channel->value_count; v++)
        memcpy(made->values[v], channel->values + v * size, size * sizeof(float));
    memcpy(made->corner_values, channel->corner_values, (size_t)corner_count * sizeof(uint32_t));
    return LIMN_BAKE_OK;
}

static limn_bake_status copy_channels(limni_context *context, const limn_bake_mesh *mesh,
                                      uint64_t corner_count, limni_source *source) {
    source->channels = limni_allocate(context, mesh->channel_count, sizeof *source->channels);
    if (!source->channels) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < mesh->channel_count; c++) {
        LIMNI_TRY(check_channel(context, mesh, &mesh->channels[c], corner_count));
        LIMNI_TRY(copy_channel(context, &mesh->channels[c], corner_count, &source->channels[c]));
        source->channel_count++;
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status copy_tags(limni_context *context, const limn_bake_mesh *mesh,
                                  limni_tags *tags) {
    LIMNI_TRY(check_sharpness(context, mesh, "crease", mesh->crease_sharpness, mesh->crease_count));
    LIMNI_TRY(check_sharpness(context, mesh, "sharp vertex", mesh->vertex_sharpness,
                              mesh->sharp_vertex_count));
    *tags = (limni_tags){
        .creases = limni_allocate(context, mesh->crease_count, sizeof *tags->creases),
        .sharp_vertices =
            limni_allocate(context, mesh->sharp_vertex_count, sizeof *tags->sharp_vertices),
        .holes = limni_allocate(context, mesh->hole_count, sizeof *tags->holes),
        .crease_count = mesh->crease_count,
        .sharp_vertex_count = mesh->sharp_vertex_count,
        .hole_count = mesh->hole_count,
        .boundary = mesh->boundary,
        .creasing = mesh->creasing,
    };
    if (!tags->creases || !tags->sharp_vertices || !tags->holes) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < mesh->crease_count; c++)
        tags->creases[c] =
            (limni_crease){mesh->crease_edges[2 * (size_t)c], mesh->crease_edges[2 * (size_t)c + 1],
                           mesh->crease_sharpness[c], 0};
    for (uint32_t v = 0; v < mesh->sharp_vertex_count; v++)
        tags->sharp_vertices[v] =
            (limni_sharp_vertex){mesh->sharp_vertices[v], mesh->vertex_sharpness[v], 0};
    for (uint32_t h = 0; h < mesh->hole_count; h++)
        tags->holes[h] = (limni_hole){mesh->holes[h], 0};
    return LIMN_BAKE_OK;
}

static limn_bake_status add_mesh(limn_baker *baker, const limn_bake_mesh *mesh) {
    limni_context *const context = &baker->context;
    uint64_t corner_count = 0;
    LIMNI_TRY(check_mesh(context, mesh, &corner_count));
    limni_source source = {
        .name = mesh->name,
        .positions = limni_allocate(context, mesh->position_count, sizeof *source.positions),
        .position_count = mesh->position_count,
        .face_count = mesh->face_count,
        .face_offsets =
            limni_allocate(context, (size_t)mesh->face_count + 1, sizeof *source.face_offsets),
        .face_corners = limni_allocate(context, (size_t)corner_count, sizeof *source.face_corners),
    };
    if (!source.positions || !source.face_offsets || !source.face_corners) return LIMN_BAKE_MEMORY;
    memcpy(source.positions, mesh->positions, mesh->position_count * sizeof *source.positions);
    memcpy(source.face_corners, mesh->face_indices, (size_t)corner_count * sizeof(uint32_t));
    source.face_offsets[0] = 0;
    for (uint32_t face = 0; face < mesh->face_count; face++)
        source.face_offsets[face + 1] =
            source.face_offsets[face] + (mesh->face_sizes ? mesh->face_sizes[face] : 3);
    LIMNI_TRY(copy_tags(context, mesh, &source.tags));
    LIMNI_TRY(copy_channels(context, mesh, corner_count, &source));
    return add_source(baker, &source);
}

limn_bake_status limn_baker_add_mesh(limn_baker *baker, const limn_bake_mesh *mesh) {
    LIMNI_TRY(baker->failed);
    return baker->failed = add_mesh(baker, mesh);
}

// ---- The file

limn_bake_status limn_baker_finish(limn_baker *baker, const void **blob, size_t *blob_size) {
    LIMNI_TRY(baker->failed);
    if (baker->mesh_count == 0)
        return limni_fail(&baker->context, LIMN_BAKE_BAD_INPUT, "there is no mesh to bake");
    if (!baker->blob)
        LIMNI_TRY(limni_write_blob(&baker->context, &baker->rules, &baker->classes, &baker->pieces,
                                   baker->meshes, baker->mesh_count, &baker->character,
                                   &baker->blob, &baker->blob_size));
    *blob = baker->blob;
    *blob_size = baker->blob_size;
    return LIMN_BAKE_OK;
}

limn_bake_status limn_baker_write(limn_baker *baker, const char *path) {
    const void *blob = NULL;
    size_t size = 0;
    LIMNI_TRY(limn_baker_finish(baker, &blob, &size));
    limni_output_file file;
    bool written = limni_output_open(&file, path);
    if (written) {
        fwrite(blob, 1, size, file.stream); // the commit sees whether that went well
        written = limni_output_commit(&file);
    }
    return written ? LIMN_BAKE_OK
                   : limni_fail(&baker->context, LIMN_BAKE_IO, "%s: %s", path, file.error);
}
