/* SPDX-License-Identifier: MIT */
#include "opensubdiv.h"

#include "opensubdiv_refiner.h"

#include "limn/limn.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace Far = OpenSubdiv::Far;
using namespace limni_opensubdiv;

namespace {

// ---------------------------------------------------------------------------------------------------------------------
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

/// Limit positions and tangents of every vertex of the refiner's last level.
struct limit_surface {
    std::vector<point> points, first, second;
};

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
    explicit face_grid(const Far::TopologyRefiner &refiner) : refiner_(refiner) {}

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
        if (level == refiner_.GetMaxLevel()) {
            for (int c = 0; c < 3; c++)
                vertices_[place.corners[c].i][place.corners[c].j] = corners[c];
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
    Far::Index vertices_[LIMN_GRID_SIZE + 1][LIMN_GRID_SIZE + 1];
};

void evaluate_limit(const limni_opensubdiv_mesh &mesh, double (*limit)[3],
                    double (*tangents)[2][3]) {
    const refiner_pointer refiner = create_refiner(mesh);
    Far::TopologyRefiner::UniformOptions options(int(mesh.level));
    options.fullTopologyInLastLevel = true; // without it Limit() prints, and returns garbage
    if (mesh.level > 0) refiner->RefineUniform(options);
    const limit_surface surface = limit_points(*refiner, mesh.positions);
    require(surface.points.size() > 0, "OpenSubdiv made no limit points");

    const limn_domain *domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    face_grid grid(*refiner);
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

// ---------------------------------------------------------------------------------------------------------------------
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
    return guard(error, error_size, [&] { evaluate_limit(*mesh, limit, tangents); });
}

bool limni_opensubdiv_stencil_bytes(const limni_opensubdiv_mesh *mesh, bool shared,
                                    limni_opensubdiv_stencils *stencils, char *error,
                                    size_t error_size) {
    return guard(error, error_size, [&] { *stencils = measure_stencils(*mesh, shared); });
}
