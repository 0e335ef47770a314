/* SPDX-License-Identifier: MIT */
/*
 * The surface that a plan draws, between its vertices too, and how far its points move from one
 * frame to the next: what levels of detail move, not the camera.
 */
#ifndef DRAWN_H
#define DRAWN_H

#include "limn/limn.h"

enum { DRAWN_ROW_MAX = (LIMN_GRID_SIZE + 1) * (LIMN_GRID_SIZE + 1) };

/// A mesh, all its templates, and its vertices at the finest level. Control points do not move.
typedef struct drawn_mesh {
    limn_mesh mesh;
    uint16_t *indices;
    limn_template *templates; ///< [limn_template_count()]
    float (*finest)[3];       ///< [patch_count][row_counts[LIMN_LEVEL_MAX]]
    uint16_t row_at[LIMN_GRID_SIZE + 1][LIMN_GRID_SIZE + 1]; ///< the row at grid point i, j
} drawn_mesh;

/// False: no memory. Destroy it all the same.
bool drawn_mesh_create(drawn_mesh *drawn, const limn_mesh *mesh);
void drawn_mesh_destroy(drawn_mesh *drawn);

/// A frame of all patches, and the points that are drawn at the parameters of the finest rows. A
/// vertex has the parameters of its row, moved as the vertex is: with the row that it is sewn to,
/// and while it is new, between its parents.
typedef struct drawn_frame {
    const drawn_mesh *of;
    limn_view view; ///< without planes: nothing is left out
    limn_plan plan;
    void *memory;
    float (*vertices)[3];
    double (*points)[3]; ///< [patch_count][row_counts[LIMN_LEVEL_MAX]]
} drawn_frame;

/// False: no memory. Destroy it all the same.
bool drawn_frame_create(drawn_frame *frame, const drawn_mesh *of);
void drawn_frame_destroy(drawn_frame *frame);

void drawn_frame_make(drawn_frame *frame, const limn_view *view, const limn_lod_desc *desc);

/// Draws the plan of a frame once more, after its patches, which are in `memory`, were changed.
void drawn_frame_draw(drawn_frame *frame);

/// Pixels: movements that are smaller may come from rounding, and have no share.
#define DRAWN_ROUNDING 1e-2

/// How far the points of the surface move, in pixels of the second frame, whichever way they go;
/// those of a patch as if all were at its nearest point.
typedef struct drawn_motion {
    double pixels;      ///< but for those
    double bound;       ///< the largest that they may then move, see drawn_move()
    double share;       ///< the largest share of its bound that a patch makes use of
    double seam_pixels; ///< of patches of which an edge comes to level 0, or from there
    double seam_share;  ///< the same, as a share of half that edge and the bound
} drawn_motion;

/// From one frame to another of the same mesh. The bound of a patch is the largest step of its
/// edges' levels, times the longest way of one of its vertices within a level: from the middle of
/// its parents, as these are drawn, to its place; and half the ways of both parents. Where an edge
/// is two levels below its patch or more, rows inside slide along the surface as well, which may
/// double it.
drawn_motion drawn_move(const drawn_frame *before, const drawn_frame *after);

#endif
