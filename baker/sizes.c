/* SPDX-License-Identifier: MIT */
#include "sizes.h"

#include "limn/format.h"

uint64_t limni_tables_size(const limn_pack *pack) {
    uint64_t floats = 0;
    for (uint32_t c = 0; c < pack->class_count; c++)
        floats += limn_file_table_size(&pack->classes[c]);
    for (uint32_t p = 0; p < pack->piece_count; p++)
        floats += limn_file_piece_table_size(&pack->pieces[p]);
    return floats * sizeof(float);
}

uint64_t limni_columns_size(const limn_pack *pack) {
    uint64_t words = 0;
    for (uint32_t c = 0; c < pack->class_count; c++)
        words += limn_file_columns_size(&pack->classes[c]);
    return words * sizeof(uint16_t);
}

uint64_t limni_lists_size(const limn_mesh *mesh) {
    uint64_t size = mesh->run_count * sizeof(limn_file_run);
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        const limn_file_class *const class = &mesh->classes[mesh->runs[r].class_index];
        size += (uint64_t)mesh->runs[r].patch_count * class->control_count *
                (sizeof(uint32_t) + limn_file_slot_size(class));
    }
    return size;
}

uint64_t limni_patches_size(const limn_mesh *mesh) {
    const uint64_t per_patch =
        sizeof *mesh->faces + mesh->domain->corner_count * sizeof *mesh->errors;
    return limni_lists_size(mesh) + mesh->patch_count * per_patch;
}

uint64_t limni_points_size(const limn_mesh *mesh) {
    const uint64_t count = mesh->point_count - mesh->control_count;
    if (count == 0) return 0;
    return count * 3 * sizeof *mesh->controls + (1 + count) * sizeof *mesh->stencils +
           mesh->stencils[count] * sizeof *mesh->terms;
}

uint64_t limni_normals_size(const limn_mesh *mesh) {
    uint64_t size = 0;
    for (uint32_t c = 0; c < mesh->control_count && mesh->normals; c++)
        size += sizeof *mesh->normals + mesh->normals[c].ring_count * sizeof *mesh->ring;
    return size;
}
