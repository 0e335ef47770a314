/* SPDX-License-Identifier: MIT */
#include "opensubdiv.h"

#include "opensubdiv_patches.h"
#include "opensubdiv_refiner.h"

#include "limn/limn.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
using namespace limni_opensubdiv;

namespace {

// -------------------------------------------------------------------------------------------------
// Limit positions

/// Limit positions, and if wanted tangents, of every vertex of the refiner's last level.
struct limit_surface {
    std::vector<point> points, first, second;
};

/// Of a sparse refinement, of those that are isolated; the others stay where they are.
limit_surface limit_points(const Far::TopologyRefiner &refiner, const float *positions,
                           bool with_tangents) {
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
    if (!with_tangents) {
        primvar.Limit(points, limit.points);
        return limit;
    }
    limit.first.resize(points.size());
    limit.second.resize(points.size());
    primvar.Limit(points, limit.points, limit.first, limit.second);
    return limit;
}

void evaluate_vertices(Far::TopologyRefiner &refiner, const limni_opensubdiv_mesh &mesh,
                       double (*limit)[3], double (*tangents)[2][3]) {
    refine_for_limit(refiner, mesh);
    const limit_surface surface = limit_points(refiner, mesh.positions, tangents);
    require(surface.points.size() > 0, "OpenSubdiv made no limit points");

    const std::vector<grid_point> rows = list_rows(mesh);
    patch_grid grid(refiner, mesh);
    for (const patch &where : list_patches(mesh)) {
        grid.walk(where);
        for (const grid_point row : rows) {
            const size_t vertex = size_t(grid.vertex(row));
            std::copy_n(surface.points[vertex].v, 3, *limit++);
            if (!tangents) continue;
            std::copy_n(surface.first[vertex].v, 3, (*tangents)[0]);
            std::copy_n(surface.second[vertex].v, 3, (*tangents)[1]);
            tangents++;
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Tagged meshes

bool is_manifold(const Far::TopologyLevel &base) {
    for (Far::Index vertex = 0; vertex < base.GetNumVertices(); vertex++)
        if (base.IsVertexNonManifold(vertex)) return false;
    return true;
}

/// Vertices of the bilinear scheme have no tangents, only the faces there have. With Chaikin's method
/// surfaces are wrong in places.
bool needs_surfaces(const limni_opensubdiv_mesh &mesh) {
    if (mesh.scheme == LIMNI_OPENSUBDIV_BILINEAR) return true;
    return is_tagged(mesh) && mesh.creasing != LIMN_CREASING_CHAIKIN;
}

/// Whether vertices have no tangents: Limit() for Catmull-Clark writes past its buffers at a crease
/// that is not manifold, where more edges meet than faces.
bool lacks_tangents(const limni_opensubdiv_mesh &mesh, const Far::TopologyLevel &base) {
    return mesh.scheme == LIMNI_OPENSUBDIV_CATMARK && !is_manifold(base);
}

/// From there on nothing is semi-sharp. Bfr takes no more.
constexpr int SURFACE_LEVEL = 10;

using surface_factory = Bfr::RefinerSurfaceFactory<>;

/// The rows of one patch of a face, or not a number if the face has no surface.
void evaluate_patch(const surface_factory &factory, const patch &where,
                    const std::vector<double> &positions, const std::vector<grid_point> &rows,
                    double (*limit)[3], double (*tangents)[2][3]) {
    Bfr::Surface<double> surface;
    const bool exists = factory.InitVertexSurface(where.face, &surface);
    const Bfr::Surface<double>::PointDescriptor packed(3);
    std::vector<double> points(exists ? size_t(3) * size_t(surface.GetNumPatchPoints()) : 0);
    if (exists) surface.PreparePatchPoints(positions.data(), packed, points.data(), packed);
    for (size_t row = 0; row < rows.size(); row++) {
        const coordinates place = face_coordinates(where, rows[row]);
        double result[3][3];
        std::fill_n(result[0], 9, std::numeric_limits<double>::quiet_NaN());
        if (exists)
            surface.Evaluate(place.data(), points.data(), packed, result[0], result[1], result[2]);
        std::copy_n(result[0], 3, limit[row]);
        if (tangents) std::copy_n(result[1], 6, tangents[row][0]);
    }
}

void evaluate_surfaces(const Far::TopologyRefiner &refiner, const limni_opensubdiv_mesh &mesh,
                       double (*limit)[3], double (*tangents)[2][3]) {
    const surface_factory factory(refiner, surface_factory::Options()
                                               .SetApproxLevelSmooth(SURFACE_LEVEL)
                                               .SetApproxLevelSharp(SURFACE_LEVEL));
    const std::vector<double> positions(mesh.positions,
                                        mesh.positions + size_t(3) * mesh.position_count);
    const std::vector<grid_point> rows = list_rows(mesh);
    for (const patch &where : list_patches(mesh)) {
        evaluate_patch(factory, where, positions, rows, limit, tangents);
        limit += rows.size();
        if (tangents) tangents += rows.size();
    }
}

void evaluate(const limni_opensubdiv_mesh &mesh, double (*limit)[3], double (*tangents)[2][3]) {
    const refiner_pointer refiner = create_refiner(mesh);
    if (needs_surfaces(mesh)) {
        evaluate_surfaces(*refiner, mesh, limit, tangents);
        return;
    }
    if (tangents && lacks_tangents(mesh, refiner->GetLevel(0))) {
        evaluate_surfaces(*refiner, mesh, limit, tangents); // of which the limits are replaced
        tangents = nullptr;
    }
    evaluate_vertices(*refiner, mesh, limit, tangents);
}

// -------------------------------------------------------------------------------------------------
// Vertices at which OpenSubdiv's limit depends on the level of refinement

/// At this level it has converged.
constexpr int CONVERGED_LEVEL = 15;

/// The last vertex that a base vertex becomes, or INDEX_INVALID if it is not isolated to the end.
Far::Index last_child(const Far::TopologyRefiner &refiner, Far::Index vertex) {
    for (int level = 0; level < refiner.GetMaxLevel() && Far::IndexIsValid(vertex); level++)
        vertex = refiner.GetLevel(level).GetVertexChildVertex(vertex);
    return vertex;
}

void copy_limits(const limni_opensubdiv_mesh &mesh, const Far::TopologyRefiner &refiner,
                 const std::vector<Far::Index> &vertices, double (*limit)[3]) {
    const limit_surface surface = limit_points(refiner, mesh.positions, false);
    const size_t row_count = list_rows(mesh).size();
    for (const patch &where : list_patches(mesh)) {
        for (int c = 0; c < where.shared_corner_count(); c++) {
            const uint32_t *const corners = mesh.faces + where.first_corner;
            const Far::Index corner = Far::Index(corners[where.corner + c]);
            if (!std::binary_search(vertices.begin(), vertices.end(), corner)) continue;
            const Far::Index last = last_child(refiner, corner);
            require(Far::IndexIsValid(last), "OpenSubdiv left out a vertex");
            std::copy_n(surface.points[size_t(last)].v, 3, limit[c]);
        }
        limit += row_count;
    }
}

void converge_vertices(const limni_opensubdiv_mesh &mesh, double (*limit)[3]) {
    if (mesh.scheme == LIMNI_OPENSUBDIV_BILINEAR) return;
    const refiner_pointer refiner = create_refiner(mesh);
    const Far::TopologyLevel &base = refiner->GetLevel(0);
    std::vector<Far::Index> vertices, faces;
    for (Far::Index vertex = 0; vertex < base.GetNumVertices(); vertex++) {
        if (!converges(mesh, base, vertex)) continue;
        vertices.push_back(vertex);
        const Far::ConstIndexArray around = base.GetVertexFaces(vertex);
        faces.insert(faces.end(), around.begin(), around.end());
    }
    if (vertices.empty()) return;
    Far::TopologyRefiner::AdaptiveOptions options(CONVERGED_LEVEL);
    options.useInfSharpPatch = true;
    refiner->RefineAdaptive(options, Far::ConstIndexArray(faces.data(), int(faces.size())));
    copy_limits(mesh, *refiner, vertices, limit);
}

} // namespace

bool limni_opensubdiv_limit(const limni_opensubdiv_mesh *mesh, double (*limit)[3],
                            double (*tangents)[2][3], char *error, size_t error_size) {
    return guard(error, error_size, [&] {
        evaluate(*mesh, limit, tangents);
        converge_vertices(*mesh, limit);
    });
}
