/* SPDX-License-Identifier: MIT */
#include "opensubdiv.h"

#include "opensubdiv_refiner.h"

#include "limn/limn.h"

#include <opensubdiv/far/stencilTableFactory.h>

#include <memory>
#include <vector>

namespace Far = OpenSubdiv::Far;
using namespace limni_opensubdiv;

namespace {

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
    require(mesh.scheme == LIMNI_OPENSUBDIV_LOOP,
            "limit stencils are counted for Loop's scheme only");
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

bool limni_opensubdiv_stencil_bytes(const limni_opensubdiv_mesh *mesh, bool shared,
                                    limni_opensubdiv_stencils *stencils, char *error,
                                    size_t error_size) {
    return guard(error, error_size, [&] { *stencils = measure_stencils(*mesh, shared); });
}
