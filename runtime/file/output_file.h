/* SPDX-License-Identifier: MIT */
/*
 * A file that is written aside and renamed when it is complete, so that its path holds either what
 * was there before or the whole new file. Devices and pipes are written directly. For the programs
 * of this project.
 */
#ifndef LIMNI_OUTPUT_FILE_H
#define LIMNI_OUTPUT_FILE_H

#include <stdbool.h>
#include <stdio.h>

typedef struct limni_output_file {
    FILE *stream;    ///< write here; its error flag is looked at when the file is completed
    char *target;    ///< where links lead to
    char *aside;     ///< NULL when written directly
    char error[512]; ///< after a failure: what went wrong, without the path
} limni_output_file;

/// Whether both paths lead to one file that exists: an output that would replace its own input.
bool limni_is_same_file(const char *a, const char *b);

/// Opens `file->stream` for writing. After a failure nothing is left to be closed.
bool limni_output_open(limni_output_file *file, const char *path);

/// Completes the file, or removes what was written.
bool limni_output_commit(limni_output_file *file);

/// Removes what was written; what was at the path stays. Does nothing after a commit.
void limni_output_abandon(limni_output_file *file);

#endif
