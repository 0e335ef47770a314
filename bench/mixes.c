/* SPDX-License-Identifier: MIT */
#include "mixes.h"

#include "bench.h"
#include "terrain.h"
#include "torus.h"

#include "limn/format.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool add_normals(bench_mix *mix) {
    const limn_mesh *const mesh = &mix->mesh;
    mix->control_normals = malloc(3 * (size_t)mesh->normal_count * sizeof(float));
    if (!mix->control_normals) return false;
    limn_mesh_control_normals(mesh, mesh->controls, mix->control_normals);
    return true;
}

static bool open_mix(bench_mix *mix, const char *name, const void *blob, size_t size) {
    const limn_result result = limn_pack_open(&mix->pack, blob, size);
    if (result != LIMN_OK) {
        fprintf(stderr, "limn-bench: %s: %s\n", name, limn_result_text(result));
        return false;
    }
    if (mix->pack.mesh_count == 0) return false;
    snprintf(mix->name, sizeof mix->name, "%s", name);
    mix->mesh = limn_pack_mesh(&mix->pack, 0);
    if (mix->mesh.normals && !add_normals(mix)) return false;
    mix->patch_classes = malloc((mix->mesh.patch_count + 1) * sizeof *mix->patch_classes);
    for (uint32_t r = 0; r < mix->mesh.run_count && mix->patch_classes; r++) {
        const limn_file_run *const run = &mix->mesh.runs[r];
        for (uint32_t p = 0; p < run->patch_count; p++)
            mix->patch_classes[run->first_patch + p] = run->class_index;
    }
    return mix->patch_classes && mix->mesh.patch_count > 0;
}

/// Bakes what was added.
static bool bake_mix(bench_mix *mix, const char *name, limn_bake_status added) {
    const void *blob;
    size_t size;
    if (added == LIMN_BAKE_OK && limn_baker_finish(mix->baker, &blob, &size) == LIMN_BAKE_OK)
        return open_mix(mix, name, blob, size);
    fprintf(stderr, "limn-bench: %s\n", mix->baker ? limn_baker_error(mix->baker) : "no memory");
    return false;
}

limn_baker *bench_baker(bench_way way) {
    return limn_baker_create(&(limn_bake_desc){.scheme = way.scheme,
                                               .normals = LIMN_NORMALS_EXACT,
                                               .no_channels = true,
                                               .isolate = way.isolate,
                                               .repair = LIMN_REPAIR_ALL,
                                               .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                                               .note = bench_note});
}

static bool bake_mesh(bench_mix *mix, const limn_bake_mesh *mesh, bench_way way) {
    mix->baker = bench_baker(way);
    return bake_mix(mix, mesh->name,
                    mix->baker ? limn_baker_add_mesh(mix->baker, mesh) : LIMN_BAKE_MEMORY);
}

static bool bake_torus(bench_mix *mix, const char *name, const bench_torus *t, bench_way way) {
    const limn_bake_mesh mesh = {.name = name,
                                 .positions = t->positions,
                                 .position_count = t->point_count,
                                 .face_count = t->face_count,
                                 .face_sizes = t->face_sizes,
                                 .face_indices = t->corners};
    return bake_mesh(mix, &mesh, way);
}

static uint32_t face_size_of(limn_scheme scheme) {
    return scheme == LIMN_SCHEME_CATMARK ? 4 : 3;
}

uint32_t bench_mix_torus_faces(uint32_t side, limn_scheme scheme) {
    return bench_torus_faces(side, face_size_of(scheme));
}

bool bench_mix_regular(bench_mix *mix, uint32_t side, bench_way way) {
    bench_torus t;
    *mix = (bench_mix){0};
    const bool good = bench_torus_create(&t, side, face_size_of(way.scheme)) &&
                      bake_torus(mix, "regular", &t, way);
    bench_torus_destroy(&t);
    return good;
}

bool bench_mix_worst(bench_mix *mix, uint32_t side, bench_way way) {
    bench_torus t;
    *mix = (bench_mix){0};
    bool good = bench_torus_create(&t, side, face_size_of(way.scheme));
    if (good) {
        bench_torus_shake(&t);
        good = bake_torus(mix, "worst", &t, way);
    }
    bench_torus_destroy(&t);
    return good;
}

bool bench_mix_terrain(bench_mix *mix, uint32_t side, bench_way way) {
    bench_terrain t;
    *mix = (bench_mix){0};
    bool good = bench_terrain_create(&t, side, face_size_of(way.scheme));
    if (good) {
        const limn_bake_mesh mesh = {.name = "terrain",
                                     .positions = t.positions,
                                     .position_count = t.point_count,
                                     .face_count = t.face_count,
                                     .face_sizes = t.face_sizes,
                                     .face_indices = t.corners};
        good = bake_mesh(mix, &mesh, way);
    }
    bench_terrain_destroy(&t);
    return good;
}

bool bench_mix_file(bench_mix *mix, const char *path, bench_way way) {
    char error[512];
    *mix = (bench_mix){0};
    const char *const slash = strrchr(path, '/');
    const char *const name = slash ? slash + 1 : path;
    const char *const dot = strrchr(name, '.');
    if (dot && strcmp(dot, ".limn") == 0) {
        if (limni_blob_file_open(&mix->file, path, error, sizeof error))
            return open_mix(mix, name, mix->file.bytes, mix->file.size);
        fprintf(stderr, "limn-bench: %s\n", error);
        return false;
    }
    mix->baker = bench_baker(way);
    return bake_mix(mix, name,
                    mix->baker ? limn_baker_add_file(mix->baker, path) : LIMN_BAKE_MEMORY);
}

void bench_mix_destroy(bench_mix *mix) {
    free(mix->patch_classes);
    free(mix->control_normals);
    if (mix->baker) limn_baker_destroy(mix->baker);
    if (mix->file.bytes) limni_blob_file_close(&mix->file);
}
