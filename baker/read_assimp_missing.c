/* SPDX-License-Identifier: MIT */
/* In the place of read_assimp.c where assimp is missing. */
#include "scene.h"

limn_bake_status limni_read_assimp(limni_context *context, const char *path, const char *name,
                                   const char *bytes, size_t size, limni_scene *scene) {
    (void)name, (void)bytes, (void)size, (void)scene;
    return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                      "%s: this limn was built without assimp, which FBX and Collada need", path);
}
