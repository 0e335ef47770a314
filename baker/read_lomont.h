/* SPDX-License-Identifier: MIT */
/*
 * Lomont's extended OBJ, version 0.1: table 3 of "High Performance Subdivision Surfaces" (2007).
 * Triangles with their half-edges, and sharpness for each half-edge and vertex. What it has no
 * entry for may follow as OpenSubdiv's tags (read_tag.h): holes, the boundary rule, the creasing
 * method, and sharpness of boundary edges, which are for ever sharp otherwise.
 */
#ifndef LIMNI_READ_LOMONT_H
#define LIMNI_READ_LOMONT_H

#include "source.h"

/// The first word of a file in this format, with the comment sign.
#define LIMNI_LOMONT_MAGIC "#SubdivisionSurfL"
#define LIMNI_LOMONT_VERSION "0.1"

/// Whether a text that ends in .obj starts as this format does.
bool limni_is_lomont(const char *text);

/// As the other readers (source.h).
limn_bake_status limni_read_lomont(limni_context *context, const char *text, size_t size,
                                   limni_source *source);

#endif
