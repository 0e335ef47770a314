/* SPDX-License-Identifier: MIT */
#include "command.h"

#include "limn/format.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int limni_usage_error(const char *command, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "limn %s: ", command);
    vfprintf(stderr, format, arguments);
    fprintf(stderr, "\nsee limn %s --help\n", command);
    va_end(arguments);
    return LIMNI_EXIT_USAGE;
}

int limni_failure(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "limn: ");
    vfprintf(stderr, format, arguments);
    fprintf(stderr, "\n");
    va_end(arguments);
    return LIMNI_EXIT_FAILED;
}

int limni_command_end(limni_context *context, limn_bake_status status) {
    if (status != LIMN_BAKE_OK) limni_failure("%s", context->error);
    limni_release_all(context);
    return status == LIMN_BAKE_OK ? LIMNI_EXIT_OK : LIMNI_EXIT_FAILED;
}

bool limni_pack_file_open(limni_pack_file *file, const char *path) {
    char error[512];
    if (!limni_blob_file_open(&file->blob, path, error, sizeof error)) {
        limni_failure("%s", error);
        return false;
    }
    const limn_result result = limn_pack_open(&file->pack, file->blob.bytes, file->blob.size);
    if (result == LIMN_OK) return true;
    if (result == LIMN_ERROR_VERSION) {
        limni_failure("%s: it has format version %u, and this limn reads %u to %u; bake it again",
                      path, ((const limn_file_header *)file->blob.bytes)->version,
                      LIMN_FORMAT_VERSION_OLDEST, LIMN_FORMAT_VERSION);
    } else {
        limni_failure("%s: %s", path, limn_result_text(result));
    }
    limni_blob_file_close(&file->blob);
    return false;
}

void limni_pack_file_close(limni_pack_file *file) {
    limni_blob_file_close(&file->blob);
}

static uint32_t repair_step(const char *name, size_t length) {
    static const struct {
        const char *name;
        uint32_t bit;
    } steps[] = {{"weld", LIMN_REPAIR_WELD}, {"drop", LIMN_REPAIR_DROP}, {"all", LIMN_REPAIR_ALL}};
    for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
        if (strlen(steps[s].name) == length && memcmp(steps[s].name, name, length) == 0)
            return steps[s].bit;
    }
    return 0;
}

bool limni_parse_non_manifold(const char *text, limn_non_manifold *policy) {
    *policy = strcmp(text, "split") == 0 ? LIMN_NON_MANIFOLD_SPLIT : LIMN_NON_MANIFOLD_REFUSE;
    return *policy == LIMN_NON_MANIFOLD_SPLIT || strcmp(text, "refuse") == 0;
}

bool limni_parse_repair(const char *text, uint32_t *repair) {
    *repair = text ? 0 : LIMN_REPAIR_ALL;
    while (text) {
        const size_t length = strcspn(text, ",");
        const uint32_t step = repair_step(text, length);
        if (step == 0) return false;
        *repair |= step;
        text = text[length] ? text + length + 1 : NULL;
    }
    return true;
}
