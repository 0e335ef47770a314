/* SPDX-License-Identifier: MIT */
/*
 * The meshes that tests run over: those of the project, in the folder LIMN_ASSETS, and those in the
 * folder LIMN_TEST_ASSETS if that is set.
 */
#ifndef MESH_FILES_H
#define MESH_FILES_H

#include "limn/bake.h"

#include <stdbool.h>

/// Calls `visit` with the path of every .obj and .off file, in a fixed order. Returns how many.
int mesh_files_visit(void (*visit)(const char *path));

/// What a mesh was made for, by its name and folder: Loop's scheme unless they say otherwise.
limn_scheme mesh_files_scheme(const char *path);

/// Whether the name of a mesh says that it has creases or corners, or a boundary.
bool mesh_files_have_tags(const char *path);

#endif
