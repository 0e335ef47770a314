/* SPDX-License-Identifier: MIT */
#include "asset.h"

#include "report.h"
#include <string.h>
#include <strings.h>

static bool is_mesh_file(const char *path) {
    static const char *const endings[] = {".obj", ".off", ".ply", ".gltf", ".glb", ".fbx", ".dae"};
    const char *const ending = strrchr(path, '.');
    for (size_t e = 0; ending && e < sizeof endings / sizeof *endings; e++) {
        if (strcasecmp(ending, endings[e]) == 0) return true;
    }
    return false;
}

#ifdef VIEW_WITH_BAKER

#include "limn/bake.h"
#include <stdio.h>

static void print_note(void *user, const char *text) {
    (void)user;
    fprintf(stderr, "limn-view: note: %s\n", text);
}

static bool bake(view_asset *asset, const char *path) {
    const limn_bake_desc desc = {.normals = LIMN_NORMALS_EXACT,
                                 .images = true,
                                 .isolate = LIMN_ISOLATE_AUTO,
                                 .repair = LIMN_REPAIR_ALL,
                                 .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                                 .note = print_note};
    asset->baker = limn_baker_create(&desc);
    if (!asset->baker) return view_fail("out of memory");
    limn_bake_status status = limn_baker_add_file(asset->baker, path);
    if (status == LIMN_BAKE_OK)
        status = limn_baker_finish(asset->baker, &asset->bytes, &asset->size);
    return status == LIMN_BAKE_OK || view_fail("%s", limn_baker_error(asset->baker));
}

static void close_baker(view_asset *asset) {
    limn_baker_destroy(asset->baker);
}

#else

static bool bake(view_asset *asset, const char *path) {
    (void)asset;
    return view_fail("%s: must be baked first; this limn-view has no baker", path);
}

static void close_baker(view_asset *asset) {
    (void)asset;
}

#endif

bool view_asset_open(view_asset *asset, const char *path) {
    *asset = (view_asset){0};
    if (is_mesh_file(path)) return bake(asset, path);
    char error[512];
    if (!limni_blob_file_open(&asset->file, path, error, sizeof error))
        return view_fail("%s", error);
    asset->bytes = asset->file.bytes;
    asset->size = asset->file.size;
    return true;
}

void view_asset_close(view_asset *asset) {
    limni_blob_file_close(&asset->file);
    close_baker(asset);
    *asset = (view_asset){0};
}
