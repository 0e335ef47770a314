/* SPDX-License-Identifier: MIT */
#include "opensubdiv.h"

#include "limn/limn.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <climits>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

using refiner_pointer = std::unique_ptr<Far::TopologyRefiner>;

// ---------------------------------------------------------------------------------------------------------------------
// Errors: OpenSubdiv gives a text to a callback and goes on; inside this file they are exceptions.

std::string reported; // what OpenSubdiv complained about since the last capture began

void report(const char *text) {
    if (!reported.empty()) reported += "; ";
    reported += text;
    while (!reported.empty() && reported.back() == '\n')
        reported.pop_back();
}

void report_error(Far::ErrorType, const char *text) {
    report(text);
}

class error_capture {
  public:
    error_capture() {
        reported.clear();
        Far::SetErrorCallback(report_error);
        Far::SetWarningCallback(report);
    }
    ~error_capture() {
        Far::SetErrorCallback(nullptr);
        Far::SetWarningCallback(nullptr);
    }
    error_capture(const error_capture &) = delete;
    error_capture &operator=(const error_capture &) = delete;
};

/// Fails with `text`, or rather with what OpenSubdiv said if it complained at all.
void require(bool condition, const std::string &text) {
    if (condition && reported.empty()) return;
    throw std::runtime_error(reported.empty() ? text : "OpenSubdiv: " + reported);
}

/// Runs `body` and turns what it throws into the text and the result of a C function.
template <typename body_type> bool guard(char *error, size_t error_size, const body_type &body) {
    error[0] = '\0';
    try {
        const error_capture capture;
        body();
        return true;
    } catch (const std::bad_alloc &) {
        std::snprintf(error, error_size, "out of memory in OpenSubdiv");
    } catch (const std::exception &exception) {
        std::snprintf(error, error_size, "%s", exception.what());
    }
    return false;
}

// ---------------------------------------------------------------------------------------------------------------------
// The base mesh

std::string vertex_name(int vertex) {
    return "vertex " + std::to_string(vertex);
}

/// OpenSubdiv counts in int, unchecked: 768 corners of level-4 faces and some 1800 stencil weights
/// for each base face.
constexpr uint32_t FACE_COUNT_MAX = 1000000;

/// OpenSubdiv trusts its indices, and crashes or takes for non-manifold what this refuses by name.
void require_faces(const limni_opensubdiv_mesh &mesh) {
    require(mesh.position_count > 0 && mesh.position_count <= INT_MAX, "too few or many positions");
    require(mesh.face_count > 0 && mesh.face_count <= FACE_COUNT_MAX, "too few or many faces");
    require(mesh.level <= LIMN_LEVEL_MAX, "level " + std::to_string(mesh.level) + " is too fine");
    for (size_t face = 0; face < mesh.face_count; face++) {
        const uint32_t *v = mesh.faces + 3 * face;
        const bool in_range =
            v[0] < mesh.position_count && v[1] < mesh.position_count && v[2] < mesh.position_count;
        const bool distinct = v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
        if (!in_range || !distinct)
            require(false, "face " + std::to_string(face) +
                               (in_range ? " uses a vertex twice" : " has an index out of range"));
    }
}

/// OpenSubdiv accepts non-manifold meshes and gives them rules of its own (sharp creases), which
/// are nobody's reference.
void require_manifold(const Far::TopologyLevel &base) {
    for (int edge = 0; edge < base.GetNumEdges(); edge++) {
        if (!base.IsEdgeNonManifold(edge)) continue;
        const Far::ConstIndexArray ends = base.GetEdgeVertices(edge);
        require(false, "the edge between " + vertex_name(ends[0]) + " and " + vertex_name(ends[1]) +
                           " is not manifold");
    }
    for (int vertex = 0; vertex < base.GetNumVertices(); vertex++) {
        const bool used = base.GetVertexFaces(vertex).size() > 0;
        if (used && base.IsVertexNonManifold(vertex))
            require(false, vertex_name(vertex) + " is not manifold");
    }
}

Sdc::Options scheme_options(limn_boundary boundary) {
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(boundary == LIMN_BOUNDARY_EDGE_AND_CORNER
                                            ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER
                                            : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    return options;
}

refiner_pointer create_refiner(const limni_opensubdiv_mesh &mesh) {
    require_faces(mesh);
    const std::vector<int> face_sizes(mesh.face_count, 3);
    const std::vector<Far::Index> corners(mesh.faces, mesh.faces + size_t(3) * mesh.face_count);
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(mesh.position_count);
    descriptor.numFaces = int(mesh.face_count);
    descriptor.numVertsPerFace = face_sizes.data();
    descriptor.vertIndicesPerFace = corners.data();

    using factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    factory::Options options(Sdc::SCHEME_LOOP, scheme_options(mesh.boundary));
    options.validateFullTopology = true;
    refiner_pointer refiner(factory::Create(descriptor, options));
    require(refiner != nullptr, "OpenSubdiv refused the mesh");
    require_manifold(refiner->GetLevel(0));
    return refiner;
}

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

/// The limit position of every vertex of the refiner's last level.
std::vector<point> limit_points(const Far::TopologyRefiner &refiner, const float *positions) {
    std::vector<point> points(size_t(refiner.GetLevel(0).GetNumVertices()));
    for (size_t i = 0; i < points.size(); i++)
        points[i] = {{positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}};

    const Far::PrimvarRefinerReal<double> primvar(refiner);
    for (int level = 1; level <= refiner.GetMaxLevel(); level++) {
        std::vector<point> finer(size_t(refiner.GetLevel(level).GetNumVertices()));
        primvar.Interpolate(level, points, finer);
        points.swap(finer);
    }
    std::vector<point> limit(points.size());
    primvar.Limit(points, limit);
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

void evaluate_limit(const limni_opensubdiv_mesh &mesh, double (*limit)[3]) {
    const refiner_pointer refiner = create_refiner(mesh);
    Far::TopologyRefiner::UniformOptions options(int(mesh.level));
    options.fullTopologyInLastLevel = true; // without it Limit() prints, and returns garbage
    if (mesh.level > 0) refiner->RefineUniform(options);
    const std::vector<point> points = limit_points(*refiner, mesh.positions);
    require(points.size() > 0, "OpenSubdiv made no limit points");

    const limn_domain *domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    face_grid grid(*refiner);
    for (uint32_t face = 0; face < mesh.face_count; face++) {
        grid.walk(Far::Index(face));
        for (uint32_t row = 0; row < domain->row_counts[mesh.level]; row++, limit++) {
            const Far::Index vertex = grid.vertex(domain->rows[row].i, domain->rows[row].j);
            for (int axis = 0; axis < 3; axis++)
                (*limit)[axis] = points[size_t(vertex)].v[axis];
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

template <typename item_type> uint64_t bytes_of(const std::vector<item_type> &items) {
    return uint64_t(items.size()) * sizeof(item_type);
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

bool limni_opensubdiv_limit(const limni_opensubdiv_mesh *mesh, double (*limit)[3], char *error,
                            size_t error_size) {
    return guard(error, error_size, [&] { evaluate_limit(*mesh, limit); });
}

bool limni_opensubdiv_stencil_bytes(const limni_opensubdiv_mesh *mesh, bool shared,
                                    limni_opensubdiv_stencils *stencils, char *error,
                                    size_t error_size) {
    return guard(error, error_size, [&] { *stencils = measure_stencils(*mesh, shared); });
}
