/* SPDX-License-Identifier: MIT */
/* Runs a fuzz target once over each file of a folder, which must have some. usage: TEST FOLDER */
#include "fuzz.h"

#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>

enum { SIZE_MAX_OF_FILE = 1 << 16 };

static int is_visible(const struct dirent *entry) {
    return entry->d_name[0] != '.';
}

static bool run(const char *path) {
    static uint8_t bytes[SIZE_MAX_OF_FILE];
    FILE *const file = fopen(path, "rb");
    if (!file) return false;
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    const bool whole = feof(file) && !ferror(file);
    fclose(file);
    if (whole) LLVMFuzzerTestOneInput(bytes, size);
    return whole;
}

int main(int argc, char **argv) {
    struct dirent **entries;
    const int count = argc == 2 ? scandir(argv[1], &entries, is_visible, alphasort) : -1;
    int failed = count <= 0;
    for (int e = 0; e < count; e++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", argv[1], entries[e]->d_name);
        if (!run(path)) {
            fprintf(stderr, "%s: cannot be read, or is too large\n", path);
            failed++;
        }
        free(entries[e]);
    }
    if (count >= 0) free(entries);
    printf("%d files\n", count);
    return failed != 0;
}
