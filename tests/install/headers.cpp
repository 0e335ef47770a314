/* SPDX-License-Identifier: MIT */
/* All public headers as C++, and the baker and the runtime linked into a C++ program. */
#include <limn/bake.h>
#include <limn/character.h>
#include <limn/format.h>
#include <limn/limn.h>

#include <cstdio>

int main() {
    const float positions[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const uint32_t corners[] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
    limn_bake_mesh mesh = {};
    mesh.positions = positions[0];
    mesh.position_count = 4;
    mesh.face_count = 4;
    mesh.face_indices = corners;

    limn_baker *const baker = limn_baker_create(nullptr);
    const void *blob = nullptr;
    size_t size = 0;
    if (!baker || limn_baker_add_mesh(baker, &mesh) != LIMN_BAKE_OK ||
        limn_baker_finish(baker, &blob, &size) != LIMN_BAKE_OK) {
        std::fprintf(stderr, "%s\n", baker ? limn_baker_error(baker) : "out of memory");
        return 1;
    }
    limn_pack pack;
    const limn_result result = limn_pack_open(&pack, blob, size);
    const auto *const header = static_cast<const limn_file_header *>(blob);
    const bool good = result == LIMN_OK && pack.mesh_count == 1 && header->size == size;
    if (good) std::printf("headers: %u class\n", pack.class_count);
    limn_baker_destroy(baker);
    return good ? 0 : 1;
}
