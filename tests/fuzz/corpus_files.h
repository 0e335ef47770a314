/* SPDX-License-Identifier: MIT */
/* The files of a corpus. */
#ifndef CORPUS_FILES_H
#define CORPUS_FILES_H

#include <stddef.h>
#include <stdint.h>

/// Calls `visit` with each visible file of a folder, in the order of their names. Returns how many
/// there were, or -1 where one cannot be read or is larger than 64 KB.
int corpus_files_visit(const char *folder,
                       void (*visit)(const char *name, const uint8_t *bytes, size_t size));

#endif
