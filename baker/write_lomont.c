/* SPDX-License-Identifier: MIT */
#include "read_lomont.h"
#include "write_mesh.h"

static uint32_t count_edges(const limni_mesh *mesh) {
    uint32_t count = 0;
    for (uint32_t h = 0; h < mesh->half_edge_count; h++)
        count += mesh->pairs[h] == LIMNI_NONE || h < mesh->pairs[h];
    return count;
}

/// A boundary is sharp for ever; a sharpness that a tag gives it goes into a tag.
static void write_half_edges(const limni_mesh *mesh, FILE *stream) {
    for (uint32_t h = 0; h < mesh->half_edge_count; h++) {
        if (mesh->pairs[h] == LIMNI_NONE) {
            fprintf(stream, "hd -1 inf\n");
        } else {
            fprintf(stream, "hd %u %.9g\n", mesh->pairs[h] + 1, (double)mesh->edge_sharpness[h]);
        }
    }
}

static void write_vertex_sharpness(const limni_mesh *mesh, FILE *stream) {
    bool any = false;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        any |= mesh->vertex_sharpness[c] > 0;
    for (uint32_t c = 0; c < mesh->control_count && any; c++)
        fprintf(stream, "vs %.9g\n", (double)mesh->vertex_sharpness[c]);
}

static void write_tags(const limni_mesh *mesh, FILE *stream) {
    limni_write_options_tags(mesh->boundary, mesh->creasing, stream);
    for (uint32_t h = 0; h < mesh->half_edge_count; h++) {
        if (mesh->pairs[h] == LIMNI_NONE && mesh->edge_sharpness[h] > 0)
            limni_write_crease_tag(limni_half_edge_start(mesh, h), limni_half_edge_end(mesh, h),
                                   mesh->edge_sharpness[h], stream);
    }
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (mesh->holes[face]) limni_write_hole_tag(face, stream);
    }
}

void limni_write_lomont(const limni_mesh *mesh, FILE *stream) {
    fprintf(stream, LIMNI_LOMONT_MAGIC " " LIMNI_LOMONT_VERSION "\nsi %u %u %u 0\n",
            mesh->control_count, mesh->face_count, count_edges(mesh));
    limni_write_positions((const float(*)[3])mesh->controls, mesh->control_count, stream);
    for (uint32_t face = 0; face < mesh->face_count; face++)
        fprintf(stream, "f %u %u %u\n", mesh->corners[3 * face] + 1,
                mesh->corners[3 * face + 1] + 1, mesh->corners[3 * face + 2] + 1);
    write_half_edges(mesh, stream);
    write_vertex_sharpness(mesh, stream);
    write_tags(mesh, stream);
}
