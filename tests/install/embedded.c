/* SPDX-License-Identifier: MIT */
/* Opens the mesh inside this program. */
#include <limn/limn.h>

extern const unsigned char octahedron[];
extern const size_t octahedron_size;

int main(void) {
    limn_pack pack;
    return limn_pack_open(&pack, octahedron, octahedron_size);
}
