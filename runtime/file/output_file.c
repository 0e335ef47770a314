/* SPDX-License-Identifier: MIT */
#include "output_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool fail(limni_output_file *file, const char *what) {
    snprintf(file->error, sizeof file->error, "cannot %s: %s", what, strerror(errno));
    limni_output_abandon(file);
    return false;
}

/// A file made by mkstemp is private; give it the permissions that a new file would have had.
static void set_usual_mode(int descriptor) {
    const mode_t mask = umask(0);
    umask(mask);
    (void)fchmod(descriptor, 0666 & ~mask);
}

static int open_aside(limni_output_file *file) {
    const size_t size = strlen(file->target) + sizeof ".XXXXXX";
    file->aside = malloc(size);
    if (!file->aside) return -1;
    snprintf(file->aside, size, "%s.XXXXXX", file->target);
    const int descriptor = mkstemp(file->aside);
    if (descriptor >= 0) {
        set_usual_mode(descriptor);
    } else {
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

bool limni_output_open(limni_output_file *file, const char *path) {
    char *const real = realpath(path, NULL); // follows links; NULL where there is no file yet
    *file = (limni_output_file){.target = real ? real : strdup(path)};
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
