/* SPDX-License-Identifier: MIT */
/* The meshes that the kernels are measured on. */
#ifndef BENCH_MIXES_H
#define BENCH_MIXES_H

#include "blob_file.h"

#include "limn/bake.h"
#include "limn/limn.h"

typedef struct bench_mix {
    char name[32];
    limn_pack pack;
    limn_mesh mesh;          ///< the first of the pack
    uint32_t *patch_classes; ///< [patch_count] indices into mesh.classes
    float *control_normals;  ///< of the bind pose; NULL: the mesh has no normals
    limn_baker *baker;       ///< owns the blob, if it was baked here
    limni_blob_file file;    ///< if it was not
} bench_mix;

/// How a mix is baked, with normals.
typedef struct bench_way {
    limn_scheme scheme; ///< LIMN_SCHEME_LOOP or LIMN_SCHEME_CATMARK
    limn_isolate isolate;
} bench_way;

/// A baker that mends what it can. NULL: no memory.
limn_baker *bench_baker(bench_way way);

/// A torus of `side` by `side` control points, all regular: one class. Its faces are triangles, or
/// quads for LIMN_SCHEME_CATMARK.
bool bench_mix_regular(bench_mix *mix, uint32_t side, bench_way way);

/// The same torus with edges turned at random, valences 4 to 9, or 3 to 7 of quads: neighbours
/// rarely share a class.
bool bench_mix_worst(bench_mix *mix, uint32_t side, bench_way way);

/// The faces of either.
uint32_t bench_mix_torus_faces(uint32_t side, limn_scheme scheme);

/// Hills of `side` by `side` squares, see terrain.h.
bool bench_mix_terrain(bench_mix *mix, uint32_t side, bench_way way);

/// A mesh that is baked first, or the first one of a .limn file, as it was baked.
bool bench_mix_file(bench_mix *mix, const char *path, bench_way way);

void bench_mix_destroy(bench_mix *mix);

#endif
