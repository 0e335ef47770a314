/* SPDX-License-Identifier: MIT */
#include "mesh_files.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int is_mesh(const struct dirent *entry) {
    const char *const dot = strrchr(entry->d_name, '.');
    return dot && (strcmp(dot, ".obj") == 0 || strcmp(dot, ".off") == 0);
}

static int visit_folder(const char *folder, void (*visit)(const char *path)) {
    struct dirent **entries;
    const int count = scandir(folder, &entries, is_mesh, alphasort);
    for (int e = 0; e < count; e++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", folder, entries[e]->d_name);
        visit(path);
        free(entries[e]);
    }
    if (count >= 0) free(entries);
    return count > 0 ? count : 0;
}

int mesh_files_visit(void (*visit)(const char *path)) {
    static const char *const parts[] = {"meshes", "quads", "opensubdiv_shapes"};
    const char *const own = getenv("LIMN_ASSETS"), *const further = getenv("LIMN_TEST_ASSETS");
    int count = own ? visit_folder(own, visit) : 0;
    for (int p = 0; p < 3 && further && *further; p++) {
        char folder[4096];
        snprintf(folder, sizeof folder, "%s/%s", further, parts[p]);
        count += visit_folder(folder, visit);
    }
    return count;
}

limn_scheme mesh_files_scheme(const char *path) {
    static const char *const words[] = {"catmark_", "/quads/", "control_mesh", "suzanne"};
    for (int w = 0; w < 4; w++) {
        if (strstr(path, words[w])) return LIMN_SCHEME_CATMARK;
    }
    return strstr(path, "bilinear_") ? LIMN_SCHEME_NONE : LIMN_SCHEME_LOOP;
}

bool mesh_files_have_tags(const char *path) {
    static const char *const words[] = {"crease", "sharp", "edgecorner", "dart", "sail"};
    const char *const slash = strrchr(path, '/');
    bool any = false;
    for (int w = 0; w < 5; w++)
        any |= strstr(slash ? slash : path, words[w]) != NULL;
    return any;
}
