/* SPDX-License-Identifier: MIT */
#include "blob_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

/// Returns NULL, or what is wrong.
static const char *map_descriptor(limni_blob_file *blob, int descriptor) {
    struct stat status;
    if (fstat(descriptor, &status) != 0) return strerror(errno);
    if (!S_ISREG(status.st_mode)) return "not a regular file";
    if (status.st_size == 0) return "the file is empty";
    if ((uintmax_t)status.st_size > SIZE_MAX) return "too large to map";

    const size_t size = (size_t)status.st_size;
    void *const bytes = mmap(NULL, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (bytes == MAP_FAILED) return strerror(errno);
    *blob = (limni_blob_file){.bytes = bytes, .size = size};
    return NULL;
}

bool limni_blob_file_open(limni_blob_file *blob, const char *path, char *error, size_t error_size) {
    *blob = (limni_blob_file){0};
    // Not blocking: opening a pipe that nobody writes to must end in a message.
    const int descriptor = open(path, O_RDONLY | O_NONBLOCK);
    const char *const wrong = descriptor < 0 ? strerror(errno) : map_descriptor(blob, descriptor);
    if (descriptor >= 0) close(descriptor);
    if (wrong) snprintf(error, error_size, "%s: %s", path, wrong);
    return !wrong;
}

void limni_blob_file_close(limni_blob_file *blob) {
    // munmap takes a pointer to non-const bytes, which it does not write to.
    if (blob->bytes) munmap((void *)(uintptr_t)blob->bytes, blob->size);
    *blob = (limni_blob_file){0};
}
