/* SPDX-License-Identifier: MIT */
#include "mesh.h"

#include "require.h"

uint32_t limni_find_run(const limn_mesh *mesh, uint32_t patch_index) {
    uint32_t low = 0, high = mesh->run_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (mesh->runs[middle].first_patch <= patch_index) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static void set_pieces(const limn_mesh *mesh, const limn_file_class *class, limni_run *run) {
    run->table = mesh->tables;
    run->pieces = limni_pieces_get(mesh->domain->kind);
    run->parts = mesh->columns + class->table_offset / sizeof(uint16_t);
    run->records = mesh->pieces;
}

static void set_table(const limn_mesh *mesh, const limn_file_class *class, limni_run *run) {
    const limn_domain_kind kind = mesh->domain->kind;
    run->table = mesh->tables + class->table_offset / sizeof(float);
    run->layout = limni_layout_get(kind, false, class->pair_count);
    run->tangent_layout = limni_layout_get(kind, true, class->pair_count);
    run->table_stride = (size_t) class->control_count * run->layout->row_stride;
    run->pair_count = class->pair_count;
}

limni_run limni_run_part(const limn_mesh *mesh, const limn_file_run *run, uint32_t begin,
                         uint32_t end) {
    const limn_file_class *const class = &mesh->classes[run->class_index];
    const uint32_t slot_size = limn_file_slot_size(class);
    const size_t skipped = (size_t)begin * class->control_count;
    limni_run part = {
        .indices = mesh->indices + run->first_index + skipped,
        .slots = mesh->slots + run->first_slot + skipped * slot_size,
        .control_count = class->control_count,
        .slot_size = slot_size,
        .first_corner = limni_first_corner(mesh),
        .corner_normals = mesh->corner_normals
                              ? mesh->corner_normals +
                                    mesh->domain->corner_count * ((size_t)run->first_patch + begin)
                              : NULL,
        .patch_count = end - begin,
    };
    if (class->depth == LIMN_FORMAT_PIECE_DEPTH) {
        set_pieces(mesh, class, &part);
    } else {
        set_table(mesh, class, &part);
    }
    return part;
}

void limn_mesh_refine(const limn_mesh *mesh, float *controls) {
    LIMNI_REQUIRE(mesh && controls, );
    if (mesh->point_count > mesh->control_count) mesh->kernels->refine(mesh, controls);
}

limn_patch_face limn_mesh_face(const limn_mesh *mesh, uint32_t patch_index) {
    LIMNI_REQUIRE(mesh && patch_index < mesh->patch_count, (limn_patch_face){0});
    const uint32_t packed = mesh->faces[patch_index];
    return (limn_patch_face){.face = packed >> 2, .rotation = packed & 3};
}

void limn_mesh_corners(const limn_mesh *mesh, uint32_t patch_index,
                       uint32_t corners[LIMN_CORNER_MAX]) {
    LIMNI_REQUIRE(mesh && corners && patch_index < mesh->patch_count, );
    const limn_file_run *const run = &mesh->runs[limni_find_run(mesh, patch_index)];
    const uint32_t in_run = patch_index - run->first_patch;
    const limni_run patch = limni_run_part(mesh, run, in_run, in_run + 1);
    for (uint32_t corner = 0; corner < mesh->domain->corner_count; corner++)
        corners[corner] = mesh->base_first + (patch.indices[corner] - patch.first_corner);
}
