/* SPDX-License-Identifier: MIT */
/* A .limn file; or a mesh file, baked as it is opened. */
#ifndef VIEW_ASSET_H
#define VIEW_ASSET_H

#include "blob_file.h"
#include <stdbool.h>
#include <stddef.h>

struct limn_baker;

typedef struct view_asset {
    const void *bytes; ///< for limn_pack_open()
    size_t size;
    limni_blob_file file;     ///< what `bytes` are, or
    struct limn_baker *baker; ///< whose they are
} view_asset;

/// Files ending in .obj, .off, .ply, .gltf, .glb, .fbx or .dae are baked as by `limn bake --normals
/// exact --isolate auto --repair --non-manifold split`, and what is noted is printed. Reports why and
/// returns false on failure; close the asset in either case.
bool view_asset_open(view_asset *asset, const char *path);

void view_asset_close(view_asset *asset);

#endif
