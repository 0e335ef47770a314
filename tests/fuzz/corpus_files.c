/* SPDX-License-Identifier: MIT */
#include "corpus_files.h"

#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZE_MAX_OF_FILE = 1 << 16 };

static int is_visible(const struct dirent *entry) {
    return entry->d_name[0] != '.';
}

static bool read_file(const char *path, uint8_t *bytes, size_t *size) {
    FILE *const file = fopen(path, "rb");
    if (!file) return false;
    *size = fread(bytes, 1, SIZE_MAX_OF_FILE, file);
    const bool whole = feof(file) && !ferror(file);
    fclose(file);
    return whole;
}

int corpus_files_visit(const char *folder,
                       void (*visit)(const char *name, const uint8_t *bytes, size_t size)) {
    static uint8_t bytes[SIZE_MAX_OF_FILE];
    struct dirent **entries;
    const int count = scandir(folder, &entries, is_visible, alphasort);
    int result = count;
    for (int e = 0; e < count; e++) {
        char path[4096];
        size_t size;
        snprintf(path, sizeof path, "%s/%s", folder, entries[e]->d_name);
        if (read_file(path, bytes, &size)) {
            visit(entries[e]->d_name, bytes, size);
        } else {
            fprintf(stderr, "%s: cannot be read, or is too large\n", path);
            result = -1;
        }
        free(entries[e]);
    }
    if (count >= 0) free(entries);
    return result;
}
