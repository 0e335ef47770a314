/* SPDX-License-Identifier: MIT */
#include "output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool fail(limni_output_file *file, const char *what) {
    snprintf(file->error, sizeof file->error, "cannot %s: %s", what, strerror(errno));
    limni_output_abandon(file);
    return false;
}

/// Creates a file beside the target, with the usual permissions, under a name that is not taken.
static int open_aside(limni_output_file *file) {
    const size_t size = strlen(file->target) + 48;
    file->aside = malloc(size);
    if (!file->aside) return -1;
    int descriptor = -1;
    for (int attempt = 0; attempt < 1000 && descriptor < 0; attempt++) {
        snprintf(file->aside, size, "%s.%ld.%d.partial", file->target, (long)getpid(), attempt);
        descriptor = open(file->aside, O_CREAT | O_EXCL | O_WRONLY, 0666);
        if (descriptor < 0 && errno != EEXIST) break;
    }
    if (descriptor < 0) {
        free(file->aside);
        file->aside = NULL; // there is nothing to remove
    }
    return descriptor;
}

static FILE *open_stream(limni_output_file *file) {
    struct stat status;
    if (stat(file->target, &status) == 0 && !S_ISREG(status.st_mode))
        return fopen(file->target, "wb"); // a device, or a folder, which fails
    const int descriptor = open_aside(file);
    FILE *const stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (descriptor >= 0 && !stream) close(descriptor);
    return stream;
}

/// Whether a path that leads nowhere yet is a link; then `target` is one step further, relative to
/// the folder of the link, or NULL where there is no memory for it.
static bool follow_link(const char *path, char **target) {
    char link[4096];
    const ssize_t length = readlink(path, link, sizeof link);
    if (length <= 0 || (size_t)length == sizeof link) return false;
    const char *const slash = strrchr(path, '/');
    const size_t folder = slash && link[0] != '/' ? (size_t)(slash + 1 - path) : 0;
    *target = malloc(folder + (size_t)length + 1);
    if (!*target) return true;
    memcpy(*target, path, folder);
    memcpy(*target + folder, link, (size_t)length);
    (*target)[folder + (size_t)length] = '\0';
    return true;
}

/// What is to be written: the file that links lead to, which need not be there yet.
static char *resolve(const char *path) {
    char *target = realpath(path, NULL), *next;
    if (target) return target;
    target = strdup(path);
    for (int links = 0; target && links < 40 && follow_link(target, &next); links++) {
        free(target);
        target = next;
    }
    return target;
}

bool limni_output_open(limni_output_file *file, const char *path) {
    *file = (limni_output_file){.target = resolve(path)};
    if (file->target) file->stream = open_stream(file);
    return file->stream || fail(file, "write");
}

bool limni_output_commit(limni_output_file *file) {
    if (ferror(file->stream) || fflush(file->stream) != 0) return fail(file, "write");
    FILE *const stream = file->stream;
    file->stream = NULL;
    if (fclose(stream) != 0) return fail(file, "write");
    if (file->aside && rename(file->aside, file->target) != 0) return fail(file, "rename");
    free(file->aside);
    file->aside = NULL;
    limni_output_abandon(file);
    return true;
}

void limni_output_abandon(limni_output_file *file) {
    if (file->stream) fclose(file->stream);
    if (file->aside) remove(file->aside);
    free(file->aside);
    free(file->target);
    file->stream = NULL;
    file->aside = file->target = NULL;
}

bool limni_is_same_file(const char *a, const char *b) {
    struct stat first, second;
    return stat(a, &first) == 0 && stat(b, &second) == 0 && first.st_dev == second.st_dev &&
           first.st_ino == second.st_ino;
}
