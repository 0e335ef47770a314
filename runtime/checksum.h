/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_CHECKSUM_H
#define LIMNI_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/// XXH64 with seed 0, as its public specification has it. Quick enough to check a file at every
/// load.
uint64_t limni_checksum(const void *data, size_t size);

#endif
