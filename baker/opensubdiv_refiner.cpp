/* SPDX-License-Identifier: MIT */
#include "opensubdiv_refiner.h"

#include "limn/limn.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>
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

/// OpenSubdiv counts in int, unchecked: 1024 corners of level-4 faces and some 1800 stencil weights
/// for each patch.
constexpr uint32_t PATCH_COUNT_MAX = 1000000;

[[noreturn]] void refuse_face(size_t face, const char *text) {
    require(false, "face " + std::to_string(face) + text);
    std::abort();
}

/// OpenSubdiv trusts its indices: it crashes on what this refuses by name, or makes little of it.
void require_face(const limni_opensubdiv_mesh &mesh, size_t face, const uint32_t *corners) {
    const uint32_t size = face_size(mesh, face);
    const uint32_t *const end = corners + size;
    const uint32_t needed = mesh.scheme == LIMNI_OPENSUBDIV_LOOP ? 3 : mesh.divided ? 0 : 4;
    if (size < 3 || (needed && size != needed)) {
        refuse_face(face, needed == 4   ? " is not a quad, and faces are not divided"
                          : needed == 3 ? " is not a triangle"
                                        : " has too few corners");
    }
    if (std::any_of(corners, end, [&](uint32_t v) { return v >= mesh.position_count; }))
        refuse_face(face, " has an index out of range");
    for (const uint32_t *corner = corners; corner < end; corner++) {
        if (std::find(corner + 1, end, *corner) != end) refuse_face(face, " uses a vertex twice");
    }
}

void require_faces(const limni_opensubdiv_mesh &mesh) {
    require(mesh.position_count > 0 && mesh.position_count <= INT_MAX, "too few or many positions");
    require(mesh.face_count > 0 && mesh.face_count <= PATCH_COUNT_MAX &&
                limni_opensubdiv_patch_count(&mesh) <= PATCH_COUNT_MAX,
            "too few or many faces");
    require(mesh.level <= LIMN_LEVEL_MAX, "level " + std::to_string(mesh.level) + " is too fine");
    require(!mesh.divided || mesh.scheme != LIMNI_OPENSUBDIV_LOOP, "Loop's faces are not divided");
    const uint32_t *corners = mesh.faces;
    for (size_t face = 0; face < mesh.face_count; face++) {
        require_face(mesh, face, corners);
        corners += face_size(mesh, face);
    }
}

Sdc::SchemeType scheme_type(const limni_opensubdiv_mesh &mesh) {
    switch (mesh.scheme) {
    case LIMNI_OPENSUBDIV_CATMARK:
        return Sdc::SCHEME_CATMARK;
    case LIMNI_OPENSUBDIV_BILINEAR:
        return Sdc::SCHEME_BILINEAR;
    default:
        return Sdc::SCHEME_LOOP;
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

Sdc::Options::FVarLinearInterpolation linear_interpolation(limn_face_varying face_varying) {
    switch (face_varying) {
    case LIMN_FACE_VARYING_NONE:
        return Sdc::Options::FVAR_LINEAR_NONE;
    case LIMN_FACE_VARYING_CORNERS_PLUS1:
        return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1;
    case LIMN_FACE_VARYING_CORNERS_PLUS2:
        return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2;
    case LIMN_FACE_VARYING_BOUNDARIES:
        return Sdc::Options::FVAR_LINEAR_BOUNDARIES;
    case LIMN_FACE_VARYING_ALL:
        return Sdc::Options::FVAR_LINEAR_ALL;
    default:
        return Sdc::Options::FVAR_LINEAR_CORNERS_ONLY;
    }
}

Sdc::Options scheme_options(const limni_opensubdiv_mesh &mesh,
                            const limni_opensubdiv_channel *channel) {
    Sdc::Options options;
    if (channel) options.SetFVarLinearInterpolation(linear_interpolation(channel->face_varying));
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
        size_t first = 0;
        for (uint32_t face = 0; mesh.edge_sharpness && face < mesh.face_count; face++) {
            const uint32_t size = face_size(mesh, face);
            for (uint32_t c = 0; c < size; c++)
                add_crease(mesh.faces[first + c], mesh.faces[first + (c + 1) % size],
                           mesh.edge_sharpness[first + c]);
            first += size;
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

    void add_crease(uint32_t a, uint32_t b, float sharpness) {
        if (!(sharpness > 0)) return;
        crease_ends.push_back(Far::Index(a));
        crease_ends.push_back(Far::Index(b));
        crease_weights.push_back(sharpness);
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

uint32_t face_size(const limni_opensubdiv_mesh &mesh, size_t face) {
    return mesh.face_sizes ? mesh.face_sizes[face] : 3;
}

size_t corner_count(const limni_opensubdiv_mesh &mesh) {
    size_t count = 0;
    for (size_t face = 0; face < mesh.face_count; face++)
        count += face_size(mesh, face);
    return count;
}

refiner_pointer create_refiner(const limni_opensubdiv_mesh &mesh,
                               const limni_opensubdiv_channel *channel) {
    require_faces(mesh);
    std::vector<int> face_sizes;
    for (size_t face = 0; face < mesh.face_count; face++)
        face_sizes.push_back(int(face_size(mesh, face)));
    const std::vector<Far::Index> corners(mesh.faces, mesh.faces + corner_count(mesh));
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(mesh.position_count);
    descriptor.numFaces = int(mesh.face_count);
    descriptor.numVertsPerFace = face_sizes.data();
    descriptor.vertIndicesPerFace = corners.data();
    const tags of_mesh(mesh);
    of_mesh.describe(descriptor);
    Far::TopologyDescriptor::FVarChannel values;
    std::vector<Far::Index> corner_values;
    if (channel) {
        corner_values.assign(channel->corner_values, channel->corner_values + corners.size());
        values.numValues = int(channel->value_count);
        values.valueIndices = corner_values.data();
        descriptor.numFVarChannels = 1;
        descriptor.fvarChannels = &values;
    }

    using factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    factory::Options options(scheme_type(mesh), scheme_options(mesh, channel));
    options.validateFullTopology = true;
    refiner_pointer refiner(factory::Create(descriptor, options));
    require(refiner != nullptr, "OpenSubdiv refused the mesh");
    return refiner;
}

namespace {

/// OpenSubdiv counts in int; this many take some gigabytes.
constexpr double FINE_FACES_MAX = 256e6;

/// After how many levels nothing is semi-sharp, or those of the grid.
int needed_levels(const limni_opensubdiv_mesh &mesh) {
    float sharpest = float(mesh.level + mesh.divided);
    const auto raise = [&](const float *values, size_t count) {
        for (size_t v = 0; values && v < count; v++)
            if (values[v] < SHARP_FOR_EVER) sharpest = std::max(sharpest, values[v]);
    };
    raise(mesh.edge_sharpness, corner_count(mesh));
    raise(mesh.vertex_sharpness, mesh.position_count);
    return int(std::ceil(sharpest));
}

int count_sharp_edges(const Far::TopologyLevel &base, Far::Index vertex) {
    int count = 0;
    const Far::ConstIndexArray edges = base.GetVertexEdges(vertex);
    for (int e = 0; e < edges.size(); e++)
        count += base.GetEdgeSharpness(edges[e]) >= SHARP_FOR_EVER;
    return count;
}

} // namespace

void refine_for_limit(Far::TopologyRefiner &refiner, const limni_opensubdiv_mesh &mesh) {
    const int levels = needed_levels(mesh);
    const double patch_levels = levels - mesh.divided;
    require(limni_opensubdiv_patch_count(&mesh) * std::pow(4, patch_levels) <= FINE_FACES_MAX,
            "the mesh has too many faces to refine it until nothing is semi-sharp");
    Far::TopologyRefiner::UniformOptions options(levels);
    options.fullTopologyInLastLevel = true; // without it Limit() prints, and returns garbage
    if (levels > 0) refiner.RefineUniform(options);
}

bool is_tagged(const limni_opensubdiv_mesh &mesh) {
    const auto above = [](const float *values, size_t count) {
        return values && std::any_of(values, values + count, [](float s) { return s > 0; });
    };
    return above(mesh.edge_sharpness, corner_count(mesh)) ||
           above(mesh.vertex_sharpness, mesh.position_count) ||
           (mesh.holes && std::count(mesh.holes, mesh.holes + mesh.face_count, true)) ||
           mesh.boundary == LIMN_BOUNDARY_NONE;
}

bool converges(const limni_opensubdiv_mesh &mesh, const Far::TopologyLevel &base,
               Far::Index vertex) {
    if (base.GetVertexSharpness(vertex) >= SHARP_FOR_EVER) return false;
    const int sharp_count = count_sharp_edges(base, vertex);
    if (sharp_count == 0)
        return mesh.scheme == LIMNI_OPENSUBDIV_CATMARK && base.GetVertexFaces(vertex).size() == 2;
    return sharp_count == 1 && is_tagged(mesh);
}

} // namespace limni_opensubdiv
