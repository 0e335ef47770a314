/* SPDX-License-Identifier: MIT */
/*
 * OpenSubdiv's tags, as its regression suite writes them in OBJ:
 *
 *     t NAME INTS/FLOATS/STRINGS VALUES...
 *
 * with the counts of whole numbers, numbers and words that follow. Vertices and faces are numbered
 * from 0, unlike those of OBJ.
 */
#ifndef LIMNI_READ_TAG_H
#define LIMNI_READ_TAG_H

#include "source_builder.h"
#include "text_scanner.h"

/// Reads the rest of a line behind the keyword t. Tags that are not used are noted once each, with
/// the line, unless they cannot change a Loop surface.
limn_bake_status limni_read_tag(limni_scanner *scanner, limni_source_builder *builder,
                                limni_word_list *noted);

#endif
