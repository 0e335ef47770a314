/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_WRITE_C_ARRAY_H
#define LIMNI_WRITE_C_ARRAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/// Whether the name can be that of an array in C.
bool limni_is_c_name(const char *name);

/// Writes bytes as C11 source that defines an array `name` of unsigned char, aligned to 64 bytes,
/// and its size_t `name`_size. Errors are left in the stream.
void limni_write_c_array(FILE *stream, const char *name, const unsigned char *bytes, size_t size);

#endif
