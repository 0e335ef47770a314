/* SPDX-License-Identifier: MIT */
/*
 * Control meshes as files, to the last bit: what is read back has the same floats. Errors of the
 * stream are left to its owner.
 */
#ifndef LIMNI_WRITE_MESH_H
#define LIMNI_WRITE_MESH_H

#include "mesh.h"

#include <stdio.h>

/// Polygons with texture coordinates, and their tags as OpenSubdiv's (read_tag.h). Tags must have been checked
/// (limni_check_tags), and faces not yet triangulated.
void limni_write_obj(const limni_source *source, FILE *stream);

/// Polygons alone. PLY is binary, in the byte order of the host, which is little-endian.
void limni_write_off(const limni_source *source, FILE *stream);
void limni_write_ply(const limni_source *source, FILE *stream);

/// Lomont's extended OBJ (read_lomont.h). What it has no entry for follows as OpenSubdiv's tags.
void limni_write_lomont(const limni_mesh *mesh, FILE *stream);

/// Lines `v x y z`.
void limni_write_positions(const float (*positions)[3], uint32_t count, FILE *stream);

/// The lines of OpenSubdiv's tags.
void limni_write_options_tags(limn_boundary boundary, limn_creasing creasing, FILE *stream);
void limni_write_crease_tag(uint32_t a, uint32_t b, float sharpness, FILE *stream);
void limni_write_hole_tag(uint32_t face, FILE *stream);

#endif
