/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_WRITE_H
#define LIMNI_WRITE_H

#include "character.h"
#include "patches.h"

/// Lays out a whole .limn file in memory. The blob belongs to the context, 64-byte aligned.
///
/// meshes  whose records are told where their channels are
limn_bake_status limni_write_blob(limni_context *context, const limni_rules *rules,
                                  const limni_classes *classes, const limni_classes *pieces,
                                  limni_patches *meshes, uint32_t mesh_count,
                                  const limni_character *character, unsigned char **blob,
                                  size_t *blob_size);

#endif
