/* SPDX-License-Identifier: MIT */
/*
 * The modified butterfly scheme, level by level on explicit meshes: what the baker's butterfly is
 * to be compared with. It shares no code with the baker. From Brian Sharp, "Implementing
 * Subdivision Surface Theory" (2000), after Zorin, Schroeder and Sweldens, "Interpolating
 * Subdivision for Meshes with Arbitrary Topology" (1996); for boundaries from Zorin's rules for
 * creases in the SIGGRAPH course "Subdivision for Modeling and Animation" (2000), as programs quote
 * them.
 *
 * Where these are wrong or say too little, and what is done here, which test_butterfly.c checks.
 *
 *  1. Sharp's weights 1/2, 1/8 + 2 w, -1/16 - w are those of eight points. Zorin's stencil has ten:
 *     1/2 - w, 1/8 + 2 w, -1/16 - w and w. Both are here; for w = 0 they are the same. For w =
 *     -1/16 eight points give the middle of the edge, ten do not. Neither text gives a default: it
 *     is 0. Ten points reproduce cubic polynomials on a regular lattice for any w, eight for w = 0
 *     only; otherwise they do not even reproduce quadratic ones.
 *  2. w changes nothing but edges whose ends both are interior and regular, as no other stencil has
 *     a w in the texts.
 *  3. The first tangent mask of regular vertices, l0, is missing in the copy at hand, and l1 is
 *     none: 8 (0, 1, -1, 0, 1, -1) and so on goes around twice, and is 0 on every flat lattice. The
 *     signs and the factor must be sqrt(3) (0, 8, 8, 0, -8, -8), (-4, -8, -4, 4, 8, 4) / sqrt(3)
 *     and sqrt(3) / 2 (0, 1, 1, 0, -1, -1), for w = 0. For any w see fill_interior_tangents().
 *  4. The tangent masks are said to hold everywhere. They are left eigenvectors only where all
 *     neighbours are regular and, around a regular interior vertex, interior: for every vertex from
 *     the level after its own on. Here every vertex is subdivided once more before they are
 *     applied.
 *  5. The formula for 5 neighbours and more does not serve for fewer: for 3 the eigenvalue of the
 *     tangents would be 3/4, and for 4 that of a saddle would be 1/2 as well. Printed apart,
 *     rightly.
 *  6. Sharp says nothing of boundaries. A boundary edge has the four-point rule whatever the
 *     valences of its ends. A boundary vertex is regular with four neighbours. The rule of an inner
 *     edge goes by its ends: where both are regular, one of items 7 to 9; otherwise the mean of the
 *     extraordinary masks of those that are not, interior or on a boundary.
 *  7. Inner edge, one end on a boundary, both regular: 3/8 at the end on the boundary, 5/8 at the
 *     other; opposite, 1/16 on the boundary and 3/16 inside; behind these, seen from the end on the
 *     boundary, -1/16 and -1/8; and -1/16 at its other neighbour on the boundary. It is the stencil
 *     of eight points with the one that is missing extrapolated from a quadratic polynomial. A
 *     reflected point (the ends of an edge less the vertex opposite) would do for linear ones only.
 *  8. Inner edge, both ends regular on a boundary, with a neighbour in common that has only one
 *     face: 1/2, 1/2, 1/4 at the other vertex opposite, -1/8 twice; 0 at the common neighbour.
 *     Exact for quadratic polynomials too.
 *  9. Inner edge, both ends regular on a boundary, otherwise (a strip one face wide): 1/2, 1/2. Two
 *     rows of points do not tell a quadratic polynomial across them.
 * 10. The mask of an extraordinary boundary vertex is said to be misprinted in the notes. With k
 *     faces, z = pi / k, and the edge to neighbour i of 0 to k, the weights here are 1 - cot(z / 2)
 *     sin(i z) / k at the vertex, +-(cos(i z) - sin(2 z) sin(2 i z) / (k (cos(z) - cos(2 z)))) / 4
 *     at neighbours 0 and k, and (sin(i z) sin(j z) + sin(2 i z) sin(2 j z) / 2) / k between. They
 *     sum to 1 and halve the half disc. For k = 3 they are not the rule of item 7, which is
 *     quadratic.
 * 11. No text has tangents for boundaries. Along: (8 (a - b) - (aa - bb)) with the two neighbours
 *     on the boundary each way. Across: the sum of sin(j z) (neighbour j - vertex) where the vertex
 *     is extraordinary; for a regular one twelve points, see fill_regular_across(). Left
 *     eigenvectors for 1/2, as all the others.
 * 12. A boundary vertex with one face has no tangent plane: only boundary curves meet there, and
 *     across them the eigenvalue 1/4 has a Jordan block, so that the normal of the face settles as
 *     slowly as 1 over the level. Here it is that of the face at the level asked for.
 */
#ifndef BUTTERFLY_H
#define BUTTERFLY_H

#include <stdbool.h>
#include <stdint.h>

enum { BUTTERFLY_VALENCE_MAX = 128, BUTTERFLY_MASK_MAX = 2 * BUTTERFLY_VALENCE_MAX + 2 };

typedef enum butterfly_stencil { BUTTERFLY_EIGHT, BUTTERFLY_TEN } butterfly_stencil;

/// The half-edge 3 f + k runs from corner k of face f to the next.
typedef struct butterfly_mesh {
    butterfly_stencil stencil;
    double tension; ///< w
    int vertex_count, face_count, edge_count;
    double (*positions)[3];
    int (*faces)[3]; ///< counter-clockwise
    int *pairs;      ///< of half-edges; -1 on a boundary
    int *
        first_edges; ///< of vertices: a half-edge that leaves; on a boundary the one without a pair
} butterfly_mesh;

/// A sum of vertices with weights. A vertex may have several terms.
typedef struct butterfly_mask {
    int count;
    int vertices[BUTTERFLY_MASK_MAX];
    double weights[BUTTERFLY_MASK_MAX];
} butterfly_mask;

/// A manifold mesh in which every vertex has a face and inner vertices have three or more; eight
/// points, w = 0. Aborts when out of memory, as everything here. Free it with butterfly_destroy().
butterfly_mesh butterfly_create(const float (*positions)[3], uint32_t position_count,
                                const uint32_t (*faces)[3], uint32_t face_count);
void butterfly_destroy(butterfly_mesh *mesh);

/// One level of subdivision, of the same stencil. Vertices keep their indices and positions. Corner
/// k of face f becomes corner k of face 4 f + k; face 4 f + 3 is the one in the middle, and its
/// corner k is new on the edge that begins at corner k.
butterfly_mesh butterfly_subdivide(const butterfly_mesh *mesh);

/// The vertex in the middle of the edge of a half-edge.
butterfly_mask butterfly_edge_mask(const butterfly_mesh *mesh, int half_edge);

/// Two tangents of the limit surface, whose product points to the side from which faces are
/// counter-clockwise; half as long after each level. Aborts where neighbours are not as in item 4.
/// Returns false for boundary vertices with one face.
bool butterfly_tangents(const butterfly_mesh *mesh, int vertex, butterfly_mask tangents[2]);

void butterfly_apply(const butterfly_mesh *mesh, const butterfly_mask *mask, double sum[3]);

/// Unit normals of the limit surface.
///
/// normals  out: [vertex_count]
void butterfly_normals(const butterfly_mesh *mesh, double (*normals)[3]);

/// Whether a vertex is on a boundary, and how many neighbours it has.
bool butterfly_is_on_boundary(const butterfly_mesh *mesh, int vertex);
int butterfly_valence(const butterfly_mesh *mesh, int vertex);

#endif
