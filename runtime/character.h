/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_CHARACTER_H
#define LIMNI_CHARACTER_H

#include "limn/format.h"
#include "limn/limn.h"

/// Whether a chunk is one of those below; whether it belongs to the file or to a mesh as it should.
bool limni_is_character_chunk(const limn_file_chunk *chunk);

/// Checks skeleton, clips and materials of a file, and of each mesh its skin, morph targets and
/// ranges of materials. The meshes themselves have been checked.
limn_result limni_validate_character(const limn_pack *pack);

#endif
