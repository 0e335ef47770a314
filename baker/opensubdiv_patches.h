/* SPDX-License-Identifier: MIT */
/*
 * Where the patches of limni_opensubdiv_mesh lie on its faces, in what OpenSubdiv counts with: the
 * parameters of faces and of ptex faces, and the vertices of a refined mesh. C++, for the baker's
 * oracle and the benchmarks.
 */
#ifndef LIMNI_OPENSUBDIV_PATCHES_H
#define LIMNI_OPENSUBDIV_PATCHES_H

#include "opensubdiv.h"

#include "limn/limn.h"

#include <opensubdiv/far/topologyRefiner.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace limni_opensubdiv {

/// A whole face, or of a divided one what lies at a corner.
struct patch {
    OpenSubdiv::Far::Index face;
    size_t first_corner; ///< of the face, in mesh.faces
    int face_size;
    int ptex_face;
    int corner; ///< where the patch begins
    bool divided;

    /// How many corners of the patch are corners of the face: the first ones.
    int shared_corner_count() const {
        return divided ? 1 : face_size;
    }
};

std::vector<patch> list_patches(const limni_opensubdiv_mesh &mesh);

/// A place on a patch, in steps of the grid.
struct grid_point {
    int i, j;
};

/// The rows of a patch at the level of the mesh.
std::vector<grid_point> list_rows(const limni_opensubdiv_mesh &mesh);

/// Two parameters.
using coordinates = std::array<double, 2>;

/// Of a place on a patch, in the parameters of Bfr's surface of the face.
coordinates face_coordinates(const patch &where, grid_point place);

/// The same in those of the patch's ptex face. One of Loop's is a face.
coordinates ptex_coordinates(const patch &where, grid_point place);

/// Finds the vertex of a uniformly refined mesh at each grid point of one patch.
///
/// The walk goes down through the child faces and knows a child's corners by their vertices, for
/// which it needs no order of children. Looking midpoints up by their end points
/// (TopologyLevel::FindEdge) is not enough: around a vertex of valence 2, two edges of a refined
/// mesh have the same two ends.
class patch_grid {
  public:
    /// The refiner must be refined as far as the grid of the mesh, or further.
    patch_grid(const OpenSubdiv::Far::TopologyRefiner &refiner, const limni_opensubdiv_mesh &mesh);

    void walk(const patch &where);

    /// What becomes on the last level of a vertex of the grid.
    OpenSubdiv::Far::Index vertex(grid_point at) const {
        return vertices_[at.i][at.j];
    }

  private:
    static constexpr int CORNER_MAX = LIMN_CORNER_MAX;
    static constexpr int KNOWN_MAX = 2 * LIMN_CORNER_MAX + 1;

    /// Vertices of one level and their places.
    struct known_vertices {
        int count = 0;
        OpenSubdiv::Far::Index vertices[KNOWN_MAX];
        grid_point places[KNOWN_MAX];

        void add(OpenSubdiv::Far::Index vertex, grid_point place);
    };
    using corner_places = std::array<grid_point, CORNER_MAX>;

    void walk(int level, OpenSubdiv::Far::Index face, const corner_places &places);
    known_vertices children_of(int level, OpenSubdiv::Far::Index face,
                               const corner_places &places) const;
    corner_places place_child(int level, OpenSubdiv::Far::Index face,
                              const known_vertices &known) const;
    OpenSubdiv::Far::Index last_child(OpenSubdiv::Far::Index vertex) const;

    const OpenSubdiv::Far::TopologyRefiner &refiner_;
    int level_; ///< on which all points of the grid are vertices
    int corner_count_;
    OpenSubdiv::Far::Index vertices_[LIMN_GRID_SIZE + 1][LIMN_GRID_SIZE + 1];
};

} // namespace limni_opensubdiv

#endif
