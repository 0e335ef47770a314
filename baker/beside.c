/* SPDX-License-Identifier: MIT */
#define _FILE_OFFSET_BITS 64

#include "beside.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

bool limni_leaves_folder(const char *path) {
    if (path[0] == '/') return true;
    for (const char *part = path; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0')) return true;
    }
    return false;
}

limn_bake_status limni_read_beside(limni_context *context, const char *document, const char *path,
                                   const unsigned char **bytes, uint64_t *size) {
    const char *const slash = strrchr(document, '/');
    const size_t folder_size = slash ? (size_t)(slash + 1 - document) : 0;
    struct stat information;
    *bytes = NULL;
    *size = 0;
    if (limni_leaves_folder(path)) return LIMN_BAKE_OK;
    char *const whole = limni_allocate(context, folder_size + strlen(path) + 1, 1);
    if (!whole) return LIMN_BAKE_MEMORY;
    memcpy(whole, document, folder_size);
    strcpy(whole + folder_size, path);
    FILE *const file = stat(whole, &information) == 0 && S_ISREG(information.st_mode) &&
                               information.st_size < (off_t)UINT32_MAX
                           ? fopen(whole, "rb")
                           : NULL;
    if (!file) return LIMN_BAKE_OK;
    const size_t length = (size_t)information.st_size;
    unsigned char *const copy = limni_allocate(context, length, 1);
    const bool good = copy && fread(copy, 1, length, file) == length;
    fclose(file);
    if (!copy) return LIMN_BAKE_MEMORY;
    if (!good) return LIMN_BAKE_OK;
    *bytes = copy;
    *size = length;
    return LIMN_BAKE_OK;
}
