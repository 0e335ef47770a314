/* SPDX-License-Identifier: MIT */
/* The files that a document names: only those in its folder or below, and regular ones. */
#ifndef LIMNI_BESIDE_H
#define LIMNI_BESIDE_H

#include "context.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Whether a path leads out of the folder that it is relative to.
bool limni_leaves_folder(const char *path);

/// Reads a file. Returns no bytes where it is not to be had; fails when out of memory.
///
/// document  the path of the document
/// path      of the file, relative to its folder
/// bytes     out: they belong to the context; NULL: there is no such file
limn_bake_status limni_read_beside(limni_context *context, const char *document, const char *path,
                                   const unsigned char **bytes, uint64_t *size);

#ifdef __cplusplus
}
#endif

#endif
