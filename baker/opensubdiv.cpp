/* SPDX-License-Identifier: MIT */
#include "opensubdiv.h"

#include "opensubdiv_refiner.h"

#include "limn/limn.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
using namespace limni_opensubdiv;

namespace {

// -------------------------------------------------------------------------------------------------
// Limit positions

struct point {
    double v[3];

    void Clear() {
        v[0] = v[1] = v[2] = 0.0;
    }
    void AddWithWeight(const point &source, double weight) {
        for (int axis = 0; axis < 3; axis++)
            v[axis] += weight * source.v[axis];
    }
};

/// OpenSubdiv counts in int; this many take some gigabytes.
constexpr double FINE_FACES_MAX = 256e6;

/// Limit positions and tangents of every vertex of the refiner's last level.
struct limit_surface {
    std::vector<point> points, first, second;
};

/// Of a sparse refinement, of those that are isolated; the others stay where they are.
limit_surface limit_points(const Far::TopologyRefiner &refiner, const float *positions) {
    std::vector<point> points(size_t(refiner.GetLevel(0).GetNumVertices()));
    for (size_t i = 0; i < points.size(); i++)
        points[i] = {{positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}};

    const Far::PrimvarRefinerReal<double> primvar(refiner);
    for (int level = 1; level <= refiner.GetMaxLevel(); level++) {
        std::vector<point> finer(size_t(refiner.GetLevel(level).GetNumVertices()));
        primvar.Interpolate(level, points, finer);
        points.swap(finer);
    }
    limit_surface limit;
    limit.points.resize(points.size());
    limit.first.resize(points.size());
    limit.second.resize(points.size());
    primvar.Limit(points, limit.points, limit.first, limit.second);
    return limit;
}

/// Finds the vertex of the refiner's last level at each grid coordinate of one base face.
///
/// The walk goes down through the child faces and knows a child's corners by their vertices, for
/// which it needs no order of children. Looking midpoints up by their end points
/// (TopologyLevel::FindEdge) is not enough: around a vertex of valence 2, two edges of a refined
/// mesh have the same two ends.
class face_grid {
  public:
    /// level  of the grid, at most the refiner's
    face_grid(const Far::TopologyRefiner &refiner, int level) : refiner_(refiner), level_(level) {}

    void walk(Far::Index base_face) {
        const int n = LIMN_GRID_SIZE;
        walk(0, base_face, {{{0, 0}, {n, 0}, {0, n}}});
    }

    Far::Index vertex(int i, int j) const {
        return vertices_[i][j];
    }

  private:
    struct grid_point {
        int i, j;
    };
    struct triangle {
        grid_point corners[3];
    };

    void walk(int level, Far::Index face, const triangle &place) {
        const Far::TopologyLevel &topology = refiner_.GetLevel(level);
        const Far::ConstIndexArray corners = topology.GetFaceVertices(face);
        if (level == level_) {
            for (int c = 0; c < 3; c++)
                vertices_[place.corners[c].i][place.corners[c].j] = last_child(corners[c]);
            return;
        }
        // The six vertices of the four children: the corners, and the midpoints of the edges.
        const Far::ConstIndexArray edges = topology.GetFaceEdges(face);
        Far::Index known[6];
        grid_point known_places[6];
        for (int c = 0; c < 3; c++) {
            const grid_point a = place.corners[c], b = place.corners[(c + 1) % 3];
            known[c] = topology.GetVertexChildVertex(corners[c]);
            known_places[c] = a;
            known[3 + c] = topology.GetEdgeChildVertex(edges[c]);
            known_places[3 + c] = {(a.i + b.i) / 2, (a.j + b.j) / 2};
        }
        const Far::ConstIndexArray children = topology.GetFaceChildFaces(face);
        for (int child = 0; child < children.size(); child++)
            walk(level + 1, children[child],
                 place_child(level + 1, children[child], known, known_places));
    }

    /// What becomes of a vertex of the grid on the last level.
    Far::Index last_child(Far::Index vertex) const {
        for (int level = level_; level < refiner_.GetMaxLevel(); level++)
            vertex = refiner_.GetLevel(level).GetVertexChildVertex(vertex);
        return vertex;
    }

    triangle place_child(int level, Far::Index face, const Far::Index known[6],
                         const grid_point known_places[6]) const {
        const Far::ConstIndexArray corners = refiner_.GetLevel(level).GetFaceVertices(face);
        triangle place;
        for (int c = 0; c < 3; c++) {
            int k = 0;
            while (k < 6 && known[k] != corners[c])
                k++;
            if (k == 6) throw std::logic_error("OpenSubdiv: a refined face has strange corners");
            place.corners[c] = known_places[k];
        }
        return place;
    }

    const Far::TopologyRefiner &refiner_;
    int level_;
    Far::Index vertices_[LIMN_GRID_SIZE + 1][LIMN_GRID_SIZE + 1];
};

constexpr float SHARP_FOR_EVER = 10;

std::vector<Far::Index> vector_of(const Far::ConstIndexArray &array) {
    return {array.begin(), array.end()};
}

/// After how many levels nothing is semi-sharp, or those of the grid.
int needed_levels(const limni_opensubdiv_mesh &mesh) {
    float sharpest = float(mesh.level);
    const auto raise = [&](const float *values, size_t count) {
        for (size_t v = 0; values && v < count; v++)
            if (values[v] < SHARP_FOR_EVER) sharpest = std::max(sharpest, values[v]);
    };
    raise(mesh.edge_sharpness, size_t(3) * mesh.face_count);
    raise(mesh.vertex_sharpness, mesh.position_count);
    return int(std::ceil(sharpest));
}

void evaluate_limit(const limni_opensubdiv_mesh &mesh, double (*limit)[3],
                    double (*tangents)[2][3]) {
    const refiner_pointer refiner = create_refiner(mesh);
    const int levels = needed_levels(mesh);
    require(double(mesh.face_count) * std::pow(4, levels) <= FINE_FACES_MAX,
            "the mesh has too many faces to refine it until nothing is semi-sharp");
    Far::TopologyRefiner::UniformOptions options(levels);
    options.fullTopologyInLastLevel = true; // without it Limit() prints, and returns garbage
    if (levels > 0) refiner->RefineUniform(options);
    const limit_surface surface = limit_points(*refiner, mesh.positions);
    require(surface.points.size() > 0, "OpenSubdiv made no limit points");

    const limn_domain *domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    face_grid grid(*refiner, int(mesh.level));
    for (uint32_t face = 0; face < mesh.face_count; face++) {
        grid.walk(Far::Index(face));
        for (uint32_t row = 0; row < domain->row_counts[mesh.level]; row++, limit++) {
            const Far::Index vertex = grid.vertex(domain->rows[row].i, domain->rows[row].j);
            for (int axis = 0; axis < 3; axis++) {
                (*limit)[axis] = surface.points[size_t(vertex)].v[axis];
                if (!tangents) continue;
                (*tangents)[0][axis] = surface.first[size_t(vertex)].v[axis];
                (*tangents)[1][axis] = surface.second[size_t(vertex)].v[axis];
            }
            if (tangents) tangents++;
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Tagged meshes

bool is_tagged(const limni_opensubdiv_mesh &mesh) {
    const auto above = [](const float *values, size_t count) {
        return values && std::any_of(values, values + count, [](float s) { return s > 0; });
    };
    return above(mesh.edge_sharpness, size_t(3) * mesh.face_count) ||
           above(mesh.vertex_sharpness, mesh.position_count) ||
           (mesh.holes && std::count(mesh.holes, mesh.holes + mesh.face_count, true)) ||
           mesh.boundary == LIMN_BOUNDARY_NONE;
}

/// From there on nothing is semi-sharp. Bfr takes no more.
constexpr int SURFACE_LEVEL = 10;

using surface_factory = Bfr::RefinerSurfaceFactory<>;

/// One face, or not a number if it has no surface.
void evaluate_face(const surface_factory &factory, Far::Index face,
                   const std::vector<double> &positions, uint32_t row_count, double (*limit)[3],
                   double (*tangents)[2][3]) {
    const limn_domain *domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    Bfr::Surface<double> surface;
    const bool exists = factory.InitVertexSurface(face, &surface);
    const Bfr::Surface<double>::PointDescriptor packed(3);
    std::vector<double> points(exists ? size_t(3) * size_t(surface.GetNumPatchPoints()) : 0);
    if (exists) surface.PreparePatchPoints(positions.data(), packed, points.data(), packed);
    for (uint32_t row = 0; row < row_count; row++) {
        const double place[2] = {double(domain->rows[row].i) / LIMN_GRID_SIZE,
                                 double(domain->rows[row].j) / LIMN_GRID_SIZE};
        double result[3][3];
        std::fill_n(result[0], 9, std::numeric_limits<double>::quiet_NaN());
        if (exists) surface.Evaluate(place, points.data(), packed, result[0], result[1], result[2]);
        std::copy_n(result[0], 3, limit[row]);
        if (tangents) std::copy_n(result[1], 6, tangents[row][0]);
    }
}

void evaluate_surfaces(const limni_opensubdiv_mesh &mesh, double (*limit)[3],
                       double (*tangents)[2][3]) {
    const refiner_pointer refiner = create_refiner(mesh);
    const surface_factory factory(*refiner, surface_factory::Options()
                                                .SetApproxLevelSmooth(SURFACE_LEVEL)
                                                .SetApproxLevelSharp(SURFACE_LEVEL));
    const std::vector<double> positions(mesh.positions,
                                        mesh.positions + size_t(3) * mesh.position_count);
    const uint32_t row_count = limn_domain_get(LIMN_DOMAIN_TRIANGLE)->row_counts[mesh.level];
    for (uint32_t face = 0; face < mesh.face_count; face++) {
        const size_t first = size_t(face) * row_count;
        evaluate_face(factory, Far::Index(face), positions, row_count, limit + first,
                      tangents ? tangents + first : nullptr);
    }
}

/// A level at which the ends of creases have converged: on them OpenSubdiv's limit is that of a
/// smooth vertex, and depends on the level of refinement.
constexpr int DART_LEVEL = 15;

/// Whether a crease ends there that stays sharp.
bool is_dart(const Far::TopologyLevel &base, Far::Index vertex) {
    int sharp_count = 0;
    for (const Far::Index edge : vector_of(base.GetVertexEdges(vertex)))
        sharp_count += base.GetEdgeSharpness(edge) >= SHARP_FOR_EVER;
    return sharp_count == 1 && base.GetVertexSharpness(vertex) < SHARP_FOR_EVER;
}

/// The last vertex that a base vertex becomes, or INDEX_INVALID if it is not isolated to the end.
Far::Index last_child(const Far::TopologyRefiner &refiner, Far::Index vertex) {
    for (int level = 0; level < refiner.GetMaxLevel() && Far::IndexIsValid(vertex); level++)
        vertex = refiner.GetLevel(level).GetVertexChildVertex(vertex);
    return vertex;
}

void converge_darts(const limni_opensubdiv_mesh &mesh, double (*limit)[3]) {
    if (!is_tagged(mesh)) return;
    const refiner_pointer refiner = create_refiner(mesh);
    const Far::TopologyLevel &base = refiner->GetLevel(0);
    std::vector<Far::Index> darts, faces;
    for (Far::Index vertex = 0; vertex < base.GetNumVertices(); vertex++) {
        if (!is_dart(base, vertex)) continue;
        darts.push_back(vertex);
        for (const Far::Index face : vector_of(base.GetVertexFaces(vertex)))
            faces.push_back(face);
    }
    if (darts.empty()) return;
    Far::TopologyRefiner::AdaptiveOptions options(DART_LEVEL);
    options.useInfSharpPatch = true;
    refiner->RefineAdaptive(options, Far::ConstIndexArray(faces.data(), int(faces.size())));
    const limit_surface surface = limit_points(*refiner, mesh.positions);
    const uint32_t row_count = limn_domain_get(LIMN_DOMAIN_TRIANGLE)->row_counts[mesh.level];
    for (size_t c = 0; c < size_t(3) * mesh.face_count; c++) {
        const Far::Index corner = Far::Index(mesh.faces[c]);
        if (std::find(darts.begin(), darts.end(), corner) == darts.end()) continue;
        const Far::Index last = last_child(*refiner, corner);
        require(Far::IndexIsValid(last), "OpenSubdiv left out the end of a crease");
        std::copy_n(surface.points[size_t(last)].v, 3, limit[c / 3 * row_count + c % 3]);
    }
}

// -------------------------------------------------------------------------------------------------
// Limit stencils

constexpr int STENCIL_REFINEMENT_LEVEL = 6;

/// Not Far::LimitStencilTableFactory: that wrapper casts the table to a class which it is not.
using stencil_factory = Far::LimitStencilTableFactoryReal<float>;

/// Whether `face` is the first of the faces that have the row.
bool owns_row(const Far::TopologyLevel &base, Far::Index face, const limn_row &row) {
    if (row.level == 0) {
        const int corner = row.i > 0 ? 1 : row.j > 0 ? 2 : 0;
        return base.GetVertexFaces(base.GetFaceVertices(face)[corner])[0] == face;
    }
    for (int e = 0; e < 3; e++) {
        if (row.edges & (1 << e)) return base.GetEdgeFaces(base.GetFaceEdges(face)[e])[0] == face;
    }
    return true;
}

/// Locations in OpenSubdiv's form: for each face a run of parameters (s, t), which are our (i, j)
/// over the grid size. A triangle's ptex index is its face index.
struct stencil_locations {
    std::vector<float> s, t;
    stencil_factory::LocationArrayVec arrays;
};

void add_face(stencil_locations &locations, const Far::TopologyLevel &base, Far::Index face,
              uint32_t row_count, bool shared) {
    const limn_domain *domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    stencil_factory::LocationArray array;
    array.ptexIdx = face;
    for (uint32_t r = 0; r < row_count; r++) {
        const limn_row &row = domain->rows[r];
        if (shared && !owns_row(base, face, row)) continue;
        locations.s.push_back(float(row.i) / LIMN_GRID_SIZE);
        locations.t.push_back(float(row.j) / LIMN_GRID_SIZE);
        array.numLocations++;
    }
    if (array.numLocations > 0) locations.arrays.push_back(array);
}

stencil_locations locate_stencils(const limni_opensubdiv_mesh &mesh, const Far::TopologyLevel &base,
                                  bool shared) {
    const uint32_t row_count = limn_domain_get(LIMN_DOMAIN_TRIANGLE)->row_counts[mesh.level];
    stencil_locations locations;
    for (uint32_t face = 0; face < mesh.face_count; face++)
        add_face(locations, base, Far::Index(face), row_count, shared);
    // Only now do the parameters stay where they are.
    size_t first = 0;
    for (auto &array : locations.arrays) {
        array.s = locations.s.data() + first;
        array.t = locations.t.data() + first;
        first += size_t(array.numLocations);
    }
    return locations;
}

limni_opensubdiv_stencils measure_stencils(const limni_opensubdiv_mesh &mesh, bool shared) {
    const refiner_pointer refiner = create_refiner(mesh);
    const stencil_locations locations = locate_stencils(mesh, refiner->GetLevel(0), shared);
    refiner->RefineAdaptive(Far::TopologyRefiner::AdaptiveOptions(STENCIL_REFINEMENT_LEVEL));

    stencil_factory::Options options;
    options.generate1stDerivatives = false;
    const std::unique_ptr<const Far::LimitStencilTableReal<float>> table(
        stencil_factory::Create(*refiner, locations.arrays, nullptr, nullptr, options));
    require(table != nullptr, "OpenSubdiv made no limit stencils");
    require(size_t(table->GetNumStencils()) == locations.s.size(), "OpenSubdiv left stencils out");
    return {locations.s.size(), table->GetWeights().size(),
            bytes_of(table->GetSizes()) + bytes_of(table->GetOffsets()) +
                bytes_of(table->GetControlIndices()) + bytes_of(table->GetWeights())};
}

} // namespace

bool limni_opensubdiv_limit(const limni_opensubdiv_mesh *mesh, double (*limit)[3],
                            double (*tangents)[2][3], char *error, size_t error_size) {
    return guard(error, error_size, [&] {
        if (is_tagged(*mesh) && mesh->creasing != LIMN_CREASING_CHAIKIN) {
            evaluate_surfaces(*mesh, limit, tangents);
        } else {
            evaluate_limit(*mesh, limit, tangents);
        }
        converge_darts(*mesh, limit);
    });
}

bool limni_opensubdiv_stencil_bytes(const limni_opensubdiv_mesh *mesh, bool shared,
                                    limni_opensubdiv_stencils *stencils, char *error,
                                    size_t error_size) {
    return guard(error, error_size, [&] { *stencils = measure_stencils(*mesh, shared); });
}
