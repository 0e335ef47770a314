/* SPDX-License-Identifier: MIT */
#include "opensubdiv_patches.h"

#include "opensubdiv_refiner.h"

#include <opensubdiv/bfr/parameterization.h>

#include <stdexcept>

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;

namespace limni_opensubdiv {

namespace {

constexpr int N = LIMN_GRID_SIZE;

constexpr std::array<grid_point, LIMN_CORNER_MAX> triangle_corners{{{0, 0}, {N, 0}, {0, N}}};
constexpr std::array<grid_point, LIMN_CORNER_MAX> quad_corners{{{0, 0}, {N, 0}, {N, N}, {0, N}}};

/// The middle of two places.
grid_point middle(grid_point a, grid_point b) {
    return {(a.i + b.i) / 2, (a.j + b.j) / 2};
}

bool is_loop(const limni_opensubdiv_mesh &mesh) {
    return mesh.scheme == LIMNI_OPENSUBDIV_LOOP;
}

} // namespace

// -------------------------------------------------------------------------------------------------
// Patches

std::vector<patch> list_patches(const limni_opensubdiv_mesh &mesh) {
    std::vector<patch> patches;
    size_t first_corner = 0;
    int ptex_face = 0;
    for (uint32_t face = 0; face < mesh.face_count; face++) {
        const int size = int(face_size(mesh, face));
        const bool one_ptex_face = is_loop(mesh) || size == 4;
        for (int corner = 0; corner < (mesh.divided ? size : 1); corner++)
            patches.push_back({Far::Index(face), first_corner, size,
                               ptex_face + (one_ptex_face ? 0 : corner), corner, mesh.divided});
        first_corner += size_t(size);
        ptex_face += one_ptex_face ? 1 : size;
    }
    return patches;
}

std::vector<grid_point> list_rows(const limni_opensubdiv_mesh &mesh) {
    const limn_domain *const domain =
        limn_domain_get(is_loop(mesh) ? LIMN_DOMAIN_TRIANGLE : LIMN_DOMAIN_QUAD);
    std::vector<grid_point> rows;
    for (uint32_t row = 0; row < domain->row_counts[mesh.level]; row++)
        rows.push_back({domain->rows[row].i, domain->rows[row].j});
    return rows;
}

// -------------------------------------------------------------------------------------------------
// Parameters

/// On the unit square with the quad's corners 0 to 3 around it.
static coordinates quad_coordinates(int corner, coordinates local) {
    const auto at = [](int c) { return quad_corners[size_t(c % 4)]; };
    const grid_point origin = at(corner), next = at(corner + 1), before = at(corner + 3);
    const double u = local[0] / N, v = local[1] / N;
    return {origin.i / double(N) + u * (next.i - origin.i) + v * (before.i - origin.i),
            origin.j / double(N) + u * (next.j - origin.j) + v * (before.j - origin.j)};
}

coordinates face_coordinates(const patch &where, grid_point place) {
    const coordinates local = {double(place.i) / N, double(place.j) / N};
    if (!where.divided) return local;
    if (where.face_size == 4) return quad_coordinates(where.corner, {local[0] / 2, local[1] / 2});
    coordinates whole;
    const Bfr::Parameterization face(OpenSubdiv::Sdc::SCHEME_CATMARK, where.face_size);
    face.ConvertNormalizedSubFaceToCoord(where.corner, local.data(), whole.data());
    return whole;
}

coordinates ptex_coordinates(const patch &where, grid_point place) {
    if (where.divided && where.face_size == 4) return face_coordinates(where, place);
    return {double(place.i) / N, double(place.j) / N};
}

// -------------------------------------------------------------------------------------------------
// Vertices

patch_grid::patch_grid(const Far::TopologyRefiner &refiner, const limni_opensubdiv_mesh &mesh)
    : refiner_(refiner), level_(int(mesh.level) + mesh.divided),
      corner_count_(is_loop(mesh) ? 3 : 4) {}

void patch_grid::known_vertices::add(Far::Index vertex, grid_point place) {
    vertices[count] = vertex;
    places[count++] = place;
}

void patch_grid::walk(const patch &where) {
    if (!where.divided) {
        walk(0, where.face, corner_count_ == 3 ? triangle_corners : quad_corners);
        return;
    }
    const Far::TopologyLevel &base = refiner_.GetLevel(0);
    const Far::ConstIndexArray edges = base.GetFaceEdges(where.face);
    const int size = where.face_size, corner = where.corner;
    known_vertices known;
    known.add(base.GetVertexChildVertex(base.GetFaceVertices(where.face)[corner]), quad_corners[0]);
    known.add(base.GetEdgeChildVertex(edges[corner]), quad_corners[1]);
    known.add(base.GetFaceChildVertex(where.face), quad_corners[2]);
    known.add(base.GetEdgeChildVertex(edges[(corner + size - 1) % size]), quad_corners[3]);
    const Far::Index child = base.GetFaceChildFaces(where.face)[corner];
    walk(1, child, place_child(1, child, known));
}

void patch_grid::walk(int level, Far::Index face, const corner_places &places) {
    const Far::TopologyLevel &topology = refiner_.GetLevel(level);
    if (level == level_) {
        const Far::ConstIndexArray corners = topology.GetFaceVertices(face);
        for (int c = 0; c < corner_count_; c++) {
            const grid_point at = places[size_t(c)];
            vertices_[at.i][at.j] = last_child(corners[c]);
        }
        return;
    }
    const known_vertices known = children_of(level, face, places);
    const Far::ConstIndexArray children = topology.GetFaceChildFaces(face);
    for (int child = 0; child < children.size(); child++)
        walk(level + 1, children[child], place_child(level + 1, children[child], known));
}

/// The vertices of the four children: the corners, the midpoints of the edges, and of a quad its
/// middle.
patch_grid::known_vertices patch_grid::children_of(int level, Far::Index face,
                                                   const corner_places &places) const {
    const Far::TopologyLevel &topology = refiner_.GetLevel(level);
    const Far::ConstIndexArray corners = topology.GetFaceVertices(face);
    const Far::ConstIndexArray edges = topology.GetFaceEdges(face);
    known_vertices known;
    for (int c = 0; c < corner_count_; c++) {
        const grid_point a = places[size_t(c)], b = places[size_t((c + 1) % corner_count_)];
        known.add(topology.GetVertexChildVertex(corners[c]), a);
        known.add(topology.GetEdgeChildVertex(edges[c]), middle(a, b));
    }
    if (corner_count_ == 4)
        known.add(topology.GetFaceChildVertex(face), middle(places[0], places[2]));
    return known;
}

patch_grid::corner_places patch_grid::place_child(int level, Far::Index face,
                                                  const known_vertices &known) const {
    const Far::ConstIndexArray corners = refiner_.GetLevel(level).GetFaceVertices(face);
    corner_places placed{};
    for (int c = 0; c < corner_count_; c++) {
        int k = 0;
        while (k < known.count && known.vertices[k] != corners[c])
            k++;
        if (k == known.count)
            throw std::logic_error("OpenSubdiv: a refined face has strange corners");
        placed[size_t(c)] = known.places[k];
    }
    return placed;
}

Far::Index patch_grid::last_child(Far::Index vertex) const {
    for (int level = level_; level < refiner_.GetMaxLevel(); level++)
        vertex = refiner_.GetLevel(level).GetVertexChildVertex(vertex);
    return vertex;
}

} // namespace limni_opensubdiv

uint32_t limni_opensubdiv_patch_count(const limni_opensubdiv_mesh *mesh) {
    const size_t count =
        mesh->divided ? limni_opensubdiv::corner_count(*mesh) : size_t(mesh->face_count);
    return count < UINT32_MAX ? uint32_t(count) : UINT32_MAX;
}
