/* SPDX-License-Identifier: MIT */
#include "opensubdiv_patches.h"
#include "opensubdiv_refiner.h"

#include "limn/limn.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace Far = OpenSubdiv::Far;
using namespace limni_opensubdiv;

namespace {

/// Limits of all values of the refiner's last level.
std::vector<point> limit_values(const Far::TopologyRefiner &refiner, const float *values) {
    std::vector<point> points(size_t(refiner.GetLevel(0).GetNumFVarValues()));
    for (size_t i = 0; i < points.size(); i++)
        points[i] = {{values[3 * i], values[3 * i + 1], values[3 * i + 2]}};
    const Far::PrimvarRefinerReal<double> primvar(refiner);
    for (int level = 1; level <= refiner.GetMaxLevel(); level++) {
        std::vector<point> finer(size_t(refiner.GetLevel(level).GetNumFVarValues()));
        primvar.InterpolateFaceVarying(level, points, finer);
        points.swap(finer);
    }
    std::vector<point> limit(points.size());
    primvar.LimitFaceVarying(points, limit);
    return limit;
}

/// Vertices of the last level with the values that they have in one face of the base mesh.
using vertex_values = std::vector<std::pair<Far::Index, Far::Index>>;

/// By faces of the base mesh.
std::vector<vertex_values> list_values(const Far::TopologyRefiner &refiner) {
    const int last = refiner.GetMaxLevel();
    const Far::TopologyLevel &finest = refiner.GetLevel(last);
    std::vector<vertex_values> lists(size_t(refiner.GetLevel(0).GetNumFaces()));
    for (Far::Index face = 0; face < finest.GetNumFaces(); face++) {
        Far::Index base = face;
        for (int level = last; level > 0; level--)
            base = refiner.GetLevel(level).GetFaceParentFace(base);
        const Far::ConstIndexArray vertices = finest.GetFaceVertices(face);
        const Far::ConstIndexArray values = finest.GetFaceFVarValues(face);
        for (int c = 0; c < vertices.size(); c++)
            lists[size_t(base)].emplace_back(vertices[c], values[c]);
    }
    for (vertex_values &list : lists)
        std::sort(list.begin(), list.end());
    return lists;
}

Far::Index value_at(const vertex_values &list, Far::Index vertex) {
    const auto found =
        std::lower_bound(list.begin(), list.end(), std::make_pair(vertex, Far::Index(0)));
    require(found != list.end() && found->first == vertex, "a vertex is not in its face");
    return found->second;
}

/// Corners whose limits depend on the level.
void strike_out(const limni_opensubdiv_mesh &mesh, const Far::TopologyLevel &base,
                const patch &where, double (*limit)[3]) {
    for (int c = 0; c < where.shared_corner_count(); c++) {
        const uint32_t corner = mesh.faces[where.first_corner + size_t(where.corner + c)];
        if (converges(mesh, base, Far::Index(corner)))
            std::fill_n(limit[c], 3, std::numeric_limits<double>::quiet_NaN());
    }
}

void evaluate(const limni_opensubdiv_mesh &mesh, const limni_opensubdiv_channel &channel,
              double (*limit)[3]) {
    const refiner_pointer refiner = create_refiner(mesh, &channel);
    refine_for_limit(*refiner, mesh);
    const std::vector<point> values = limit_values(*refiner, channel.values);
    const std::vector<vertex_values> lists = list_values(*refiner);
    const std::vector<grid_point> rows = list_rows(mesh);
    patch_grid grid(*refiner, mesh);
    for (const patch &where : list_patches(mesh)) {
        grid.walk(where);
        for (size_t row = 0; row < rows.size(); row++) {
            const Far::Index value = value_at(lists[size_t(where.face)], grid.vertex(rows[row]));
            std::copy_n(values[size_t(value)].v, 3, limit[row]);
        }
        if (mesh.scheme != LIMNI_OPENSUBDIV_BILINEAR &&
            channel.face_varying != LIMN_FACE_VARYING_ALL)
            strike_out(mesh, refiner->GetLevel(0), where, limit);
        limit += rows.size();
    }
}

} // namespace

bool limni_opensubdiv_values(const limni_opensubdiv_mesh *mesh,
                             const limni_opensubdiv_channel *channel, double (*limit)[3],
                             char *error, size_t error_size) {
    return guard(error, error_size, [&] { evaluate(*mesh, *channel, limit); });
}
