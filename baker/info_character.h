/* SPDX-License-Identifier: MIT */
/* What `limn info` says of characters. */
#ifndef LIMNI_INFO_CHARACTER_H
#define LIMNI_INFO_CHARACTER_H

#include "limn/character.h"

#include <jansson.h>

/// A string; of one that is not UTF-8, as file names may be, only the ASCII remains.
json_t *limni_json_text(const char *text);

/// Adds joints, clips and materials of a file, and what moves and colours a mesh.
void limni_json_character(json_t *root, const limn_pack *pack);
void limni_json_rig(json_t *mesh, const limn_pack *pack, uint32_t mesh_index);

/// The same as tables, where there is something.
void limni_print_character(const limn_pack *pack);

#endif
