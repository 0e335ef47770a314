/* SPDX-License-Identifier: MIT */
/*
 * Loop subdivision with creases as in Chris Lomont, "High Performance Subdivision Surfaces" (2007),
 * level by level on explicit meshes: what the baker's `--creases lomont` is compared with. It shares
 * no code with the baker.
 *
 * Where the paper is wrong or says too little, in its order, and what is done here. "Eigenvector"
 * means that the mask is a left eigenvector of the subdivision matrix around the vertex, so that one
 * more level of subdivision changes nothing but its length; test_lomont.c checks all of them so.
 *
 *  1. Edges, type 3 weights: "the 3/8 weight goes with the corner edge". Between a regular crease
 *     vertex and any other, 5/8 goes with the regular one, 3/8 with the other, corner or not: only
 *     then are the printed 1/5, 3/5, 1/5 an eigenvector.
 *  2. Table 2 has no row for smooth vertices, yet an edge of weight 0 < w < 1 is to be interpolated
 *     "keeping the end vertex types fixed", and "it suffices to call it smooth for vertex
 *     classification", which leaves it with ends that the table does not have. Here, for the mask of
 *     a fractional edge, its ends have the types that they have when all fractional edges are sharp,
 *     in both cases of the blend; for everything else fractional edges are smooth. So edge points
 *     are continuous in w at 0 and, where the fractional edges go there together, at 1.
 *  3. So vertices, unlike edge points, jump as the weight of a crease goes to 1. That is in the text.
 *  4. Weights of vertices: 0 < w < 1 has no type. Here it has the type that its edges give it; its
 *     vertex mask is blended with the corner's, and only w >= 1 makes a corner in Table 2.
 *  5. Both fractional: "evaluate each with weights 0 and weights 1, and interpolate on w_v". With
 *     weights 1 the vertex is a corner whatever its edges are, and with weights 0 fractional edges
 *     are smooth, so this is the rule for fractional vertices, and not a third one.
 *  6. Vertex types: an interior sharp edge that ends on a boundary makes three sharp edges, a corner,
 *     which stays where it is. Followed.
 *  7. Warren's weights (footnote) are b = 3/8 and 9/16 where b is divided by n again, as it is here.
 *  8. Limit of a smooth vertex: 3 / (8 b (n + 1)) and 1 / (n + 1) do not sum to 1. The eigenvector is
 *     3 n / (8 b) against 1 for each neighbour, divided by their sum. It holds for darts, which are
 *     not mentioned, since every edge of a dart has type 1 weights.
 *  9. Limits of creases hold only where both neighbours along the crease are regular. That is so for
 *     every vertex from the level after its own on; but next to a control point that is not regular
 *     each level puts a new vertex, for which 1/48 moves from that neighbour to the vertex (7/48,
 *     33/48, 8/48), or beside a dart 1/48 from both of them to both vertices opposite. Tangents are
 *     alike, and so are those of a corner where a sharp edge leads to a dart. Here every vertex is
 *     subdivided once more before it is projected. And no limit holds until there is no finite weight
 *     left.
 * 10. Normals are said to be computed "after computing limit positions". The masks are eigenvectors
 *     for the points of the level, not for their limits, from which normals are off by 1.7e-1 radians
 *     in the mean at level 1 and 5e-3 at level 4 of a random mesh. Applied to the points here.
 * 11. Tangents of smooth vertices: cos(2 pi j / n) and cos(2 pi (j + 1) / n) span the plane, but for
 *     neighbours in the order of the walk in "Update Original Vertices" the product t1 x t2 points
 *     to the back of counter-clockwise faces. Here cosine and sine are used, and all normals point to
 *     the side from which faces are counter-clockwise.
 * 12. The four masks across a crease are for n neighbours on one side, both on the crease included;
 *     the paper does not say so. The fourth is sin((i - 1) z) for 1 < i < n, and points out of the
 *     surface while the other three point into it: it is negated here.
 * 13. The mask for n = 4 belongs to regular creases. On a side with n = 4 of a non-regular interior
 *     crease vertex (valence 7, say) it is not an eigenvector; the fourth mask is, with n = 4.
 * 14. The mask for n = 3 is an eigenvector, but so is -1/2 (w0 + 1) on both ends for any w0: the
 *     eigenvalue, 3/8, is that of the crease's bend also. Where the crease bends out of the plane such
 *     a vertex has no tangent plane: normals near one stayed 0.043 radians apart from level 5 to 7,
 *     while they came together for n from 4 to 8. Followed.
 * 15. Corners: "done for each face". As a corner is subdivided, the faces between two sharp edges
 *     approach the plane through these edges, which is their normal here; slowly where there are many
 *     (0.95 of the angle is left after a level for n = 7), and where that side spans more than half a
 *     turn, its faces have to turn over on the way. Faces of a corner with fewer than two sharp edges
 *     approach no plane; they get their own.
 * 16. The walk around a vertex, eC = previous(pair(eA)), goes counter-clockwise; a boundary vertex is
 *     tagged with the unpaired half-edge that ends there, from which no such step is possible. From
 *     it one can only go clockwise: pair(next(h)).
 * 17. Half-edge pairs are HA in the list of arrays and E, EA and EV later; nIndex(j, type) reads ei
 *     instead of j. "NV[3f+V]" in the split of faces is EM[3f]. Its offsets and the twelve pairs are
 *     right. "Five steps" are six.
 * 18. Tagging vertices, "giving preference to an incoming boundary", comes before the new pairs exist
 *     and must follow them.
 */
#ifndef LOMONT_H
#define LOMONT_H

#include <stdbool.h>
#include <stdint.h>

enum { LOMONT_VALENCE_MAX = 512 };

typedef struct lomont_vertex {
    double position[3];
    double weight; ///< sharpness in [0, INFINITY]
    int half_edge; ///< one that ends here; on a boundary the one that has no pair
} lomont_vertex;

typedef struct lomont_half_edge {
    int pair;      ///< -1 on a boundary
    double weight; ///< sharpness in [0, INFINITY], as that of the pair; INFINITY on a boundary
} lomont_half_edge;

/// The half-edge 3 f + k runs from corner k of face f to the next.
typedef struct lomont_mesh {
    int vertex_count, face_count, edge_count;
    lomont_vertex *vertices;
    int (*faces)[3]; ///< counter-clockwise
    lomont_half_edge *half_edges;
} lomont_mesh;

typedef enum lomont_type {
    LOMONT_SMOOTH,
    LOMONT_DART,
    LOMONT_REGULAR,     ///< regular crease
    LOMONT_NON_REGULAR, ///< non-regular crease
    LOMONT_CORNER
} lomont_type;

/// A manifold mesh in which every vertex has a face; all weights are 0 but those of boundaries.
/// Aborts when out of memory, as everything here. Free it with lomont_destroy().
lomont_mesh lomont_create(const float (*positions)[3], uint32_t position_count,
                          const uint32_t (*faces)[3], uint32_t face_count);
void lomont_destroy(lomont_mesh *mesh);

/// Gives an edge a weight. Returns false, and does nothing, where a and b are not the ends of an
/// interior edge.
bool lomont_set_edge_weight(lomont_mesh *mesh, int a, int b, double weight);

/// One level of subdivision. Vertices keep their indices, corner k of face f becomes corner 1 of
/// face 4 f + k, and the fourth face of each is the one in the middle.
lomont_mesh lomont_subdivide(const lomont_mesh *mesh);

/// The type of a vertex, fractional edges being smooth.
lomont_type lomont_vertex_type(const lomont_mesh *mesh, int vertex);

/// Whether all weights are 0 or infinite.
bool lomont_is_settled(const lomont_mesh *mesh);

/// Limit positions of all vertices, exact for settled meshes.
void lomont_limits(const lomont_mesh *mesh, double (*positions)[3]);

/// Unit normals of the limit surface, one for each corner of each face; exact when limits are, but
/// for corners with fewer than two sharp edges, where they are those of the flat faces.
///
/// normals  out: [3 * face_count], that of corner k of face f at 3 f + k
void lomont_normals(const lomont_mesh *mesh, double (*normals)[3]);

#endif
