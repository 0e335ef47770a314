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

/// A torus of `side` by `side` control points, all of valence 6: one class.
bool bench_mix_regular(bench_mix *mix, uint32_t side, limn_isolate isolate);

/// The same torus with edges flipped at random, valences 4 to 9: neighbours rarely share a class.
bool bench_mix_worst(bench_mix *mix, uint32_t side, limn_isolate isolate);

/// A mesh that is baked first, with normals, or the first one of a .limn file, as it was baked.
bool bench_mix_file(bench_mix *mix, const char *path, limn_isolate isolate);

void bench_mix_destroy(bench_mix *mix);

/// The next of a fixed sequence of random numbers below `bound`.
uint32_t bench_random(uint64_t *state, uint32_t bound);

#endif
