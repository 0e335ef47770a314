/* SPDX-License-Identifier: MIT */
/* A file mapped into memory, read only: for the programs of this project. A game has its own
 * loader. */
#ifndef LIMNI_BLOB_FILE_H
#define LIMNI_BLOB_FILE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct limni_blob_file {
    const void *bytes; ///< starts on a page boundary, which is aligned enough for limn_pack_open()
    size_t size;
} limni_blob_file;

/// Maps a regular file that is not empty. On failure leaves `blob` empty and `error` a sentence
/// that names the file.
bool limni_blob_file_open(limni_blob_file *blob, const char *path, char *error, size_t error_size);

void limni_blob_file_close(limni_blob_file *blob);

#endif
