/* SPDX-License-Identifier: MIT */
#include "opensubdiv_refiner.h"

#include "limn/limn.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <climits>
#include <stdexcept>

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

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

} // namespace

namespace limni_opensubdiv {

error_capture::error_capture() {
    reported.clear();
    Far::SetErrorCallback(report_error);
    Far::SetWarningCallback(report);
}

error_capture::~error_capture() {
    Far::SetErrorCallback(nullptr);
    Far::SetWarningCallback(nullptr);
}

void require(bool condition, const std::string &text) {
    if (condition && reported.empty()) return;
    throw std::runtime_error(reported.empty() ? text : "OpenSubdiv: " + reported);
}

namespace {

/// OpenSubdiv counts in int, unchecked: 768 corners of level-4 faces and some 1800 stencil weights
/// for each base face.
constexpr uint32_t FACE_COUNT_MAX = 1000000;

/// OpenSubdiv trusts its indices: it crashes on what this refuses by name, or makes little of it.
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

Sdc::Options::VtxBoundaryInterpolation boundary_interpolation(limn_boundary boundary) {
    switch (boundary) {
    case LIMN_BOUNDARY_EDGE_AND_CORNER:
        return Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER;
    case LIMN_BOUNDARY_NONE:
        return Sdc::Options::VTX_BOUNDARY_NONE;
    default:
        return Sdc::Options::VTX_BOUNDARY_EDGE_ONLY;
    }
}

Sdc::Options scheme_options(const limni_opensubdiv_mesh &mesh) {
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(boundary_interpolation(mesh.boundary));
    options.SetCreasingMethod(mesh.creasing == LIMN_CREASING_CHAIKIN
                                  ? Sdc::Options::CREASE_CHAIKIN
                                  : Sdc::Options::CREASE_UNIFORM);
    return options;
}

/// What a descriptor points to.
struct tags {
    std::vector<Far::Index> crease_ends, corners, holes;
    std::vector<float> crease_weights, corner_weights;

    explicit tags(const limni_opensubdiv_mesh &mesh) {
        for (size_t h = 0; mesh.edge_sharpness && h < size_t(3) * mesh.face_count; h++) {
            if (!(mesh.edge_sharpness[h] > 0)) continue;
            crease_ends.push_back(Far::Index(mesh.faces[h]));
            crease_ends.push_back(Far::Index(mesh.faces[h % 3 == 2 ? h - 2 : h + 1]));
            crease_weights.push_back(mesh.edge_sharpness[h]);
        }
        for (uint32_t v = 0; mesh.vertex_sharpness && v < mesh.position_count; v++) {
            if (!(mesh.vertex_sharpness[v] > 0)) continue;
            corners.push_back(Far::Index(v));
            corner_weights.push_back(mesh.vertex_sharpness[v]);
        }
        for (uint32_t face = 0; mesh.holes && face < mesh.face_count; face++) {
            if (mesh.holes[face]) holes.push_back(Far::Index(face));
        }
    }

    void describe(Far::TopologyDescriptor &descriptor) const {
        descriptor.numCreases = int(crease_weights.size());
        descriptor.creaseVertexIndexPairs = crease_ends.data();
        descriptor.creaseWeights = crease_weights.data();
        descriptor.numCorners = int(corners.size());
        descriptor.cornerVertexIndices = corners.data();
        descriptor.cornerWeights = corner_weights.data();
        descriptor.numHoles = int(holes.size());
        descriptor.holeIndices = holes.data();
    }
};

} // namespace

refiner_pointer create_refiner(const limni_opensubdiv_mesh &mesh) {
    require_faces(mesh);
    const std::vector<int> face_sizes(mesh.face_count, 3);
    const std::vector<Far::Index> corners(mesh.faces, mesh.faces + size_t(3) * mesh.face_count);
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(mesh.position_count);
    descriptor.numFaces = int(mesh.face_count);
    descriptor.numVertsPerFace = face_sizes.data();
    descriptor.vertIndicesPerFace = corners.data();
    const tags of_mesh(mesh);
    of_mesh.describe(descriptor);

    using factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    factory::Options options(Sdc::SCHEME_LOOP, scheme_options(mesh));
    options.validateFullTopology = true;
    refiner_pointer refiner(factory::Create(descriptor, options));
    require(refiner != nullptr, "OpenSubdiv refused the mesh");
    return refiner;
}

} // namespace limni_opensubdiv
