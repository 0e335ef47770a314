/* SPDX-License-Identifier: MIT */
/*
 * OpenSubdiv's Bfr: one surface for each base face, created beforehand. A frame gathers the control
 * points of each surface, computes its patch points, and evaluates point after point.
 */
#include "opensubdiv_scene.h"
#include "peer.h"

#include "../bench.h"

#include "opensubdiv_patches.h"
#include "opensubdiv_refiner.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

namespace Bfr = OpenSubdiv::Bfr;
using namespace limni_opensubdiv;

namespace {

using surface = Bfr::Surface<float>;

/// Of the refinement near irregular vertices. The lowest that gives the same points of level 4, and
/// as quick as any: the default, 2, is off by up to a hundredth of the diagonal.
constexpr int APPROXIMATION_LEVEL = 4;

/// Shared by the peers of one scene.
struct surfaces {
    refiner_pointer refiner;
    std::unique_ptr<Bfr::RefinerSurfaceFactory<>> factory; ///< owns what surfaces share
    std::vector<surface> faces;
    std::vector<patch> patches;    ///< in the order of their faces
    std::vector<float> parameters; ///< two for each row of a patch; the same for all that are faces
    size_t point_count_max = 0;
    double build_ms = 0;
};

struct state {
    const peer_scene *where;
    std::shared_ptr<const surfaces> source;
    std::vector<float> controls;
    std::vector<float> patch_points;
    std::vector<float> out; ///< of each point its position, and derivatives one behind the other
    bool derivatives;
};

template <int floats> void evaluate(state &self) {
    const peer_scene &where = *self.where;
    const surface::PointDescriptor layout(3);
    const surfaces &source = *self.source;
    const float *parameters = source.parameters.data();
    float *const points = self.patch_points.data();
    float *out = self.out.data();
    for (const patch &part : source.patches) {
        const surface &face = source.faces[size_t(part.face)];
        if (part.corner == 0) face.PreparePatchPoints(self.controls.data(), layout, points, layout);
        for (uint32_t row = 0; row < where.row_count; row++, out += floats) {
            if constexpr (floats == 3)
                face.Evaluate(parameters + 2 * row, points, layout, out);
            else
                face.Evaluate(parameters + 2 * row, points, layout, out, out + 3, out + 6);
        }
        if (part.divided) parameters += 2 * where.row_count;
    }
}

void run(void *self_state) {
    state &self = *static_cast<state *>(self_state);
    if (self.derivatives)
        evaluate<9>(self);
    else
        evaluate<3>(self);
}

const float *position(const void *self_state, uint32_t patch, uint32_t row) {
    const state &self = *static_cast<const state *>(self_state);
    const size_t point = size_t(patch) * self.where->row_count + row;
    return self.out.data() + point * (self.derivatives ? 9 : 3);
}

void destroy(void *self_state) {
    delete static_cast<state *>(self_state);
}

void create_surfaces(const peer_scene &where, surfaces &built) {
    built.refiner = create_refiner(describe_scene(where));
    Bfr::SurfaceFactory::Options options;
    const int level = APPROXIMATION_LEVEL + where.divided;
    options.SetApproxLevelSmooth(level).SetApproxLevelSharp(level);
    built.factory = std::make_unique<Bfr::RefinerSurfaceFactory<>>(*built.refiner, options);
    built.faces.resize(where.face_count);
    for (uint32_t face = 0; face < where.face_count; face++) {
        surface &made = built.faces[face];
        require(built.factory->InitVertexSurface(int(face), &made), "Bfr made no surface");
        built.point_count_max = std::max(built.point_count_max, size_t(made.GetNumPatchPoints()));
    }
}

std::shared_ptr<const surfaces> build(const peer_scene &where) {
    const double start = bench_seconds();
    auto built = std::make_shared<surfaces>();
    create_surfaces(where, *built);
    built->build_ms = 1e3 * (bench_seconds() - start);
    const limni_opensubdiv_mesh mesh = describe_scene(where);
    built->patches = list_patches(mesh);
    for (const patch &part : built->patches) {
        if (!part.divided && !built->parameters.empty()) continue;
        for (const grid_point row : list_rows(mesh)) {
            const coordinates at = face_coordinates(part, row);
            built->parameters.insert(built->parameters.end(), {float(at[0]), float(at[1])});
        }
    }
    return built;
}

/// At least: the trees of irregular patches, which surfaces share, cannot be seen from here.
uint64_t count_bytes(const surfaces &source) {
    uint64_t bytes = bytes_of(source.faces);
    for (const surface &face : source.faces) {
        constexpr int INLINE_INDICES = 20; // what a surface holds in itself
        if (face.GetNumControlPoints() > INLINE_INDICES)
            bytes += sizeof(int) * uint64_t(face.GetNumControlPoints());
    }
    return bytes;
}

void append(peer_list &list, const peer_scene &where, const std::shared_ptr<const surfaces> &source,
            bool derivatives) {
    auto self = std::make_unique<state>();
    self->where = &where;
    self->source = source;
    self->derivatives = derivatives;
    self->controls.assign(where.controls[0], where.controls[0] + 3 * size_t(where.control_count));
    self->patch_points.resize(3 * source->point_count_max);
    self->out.resize(size_t(where.patch_count) * where.row_count * (derivatives ? 9 : 3));
    peer &added = *peer_append(&list);
    added.name = "opensubdiv bfr";
    added.output = derivatives ? PEER_POSITION_DERIVATIVES : PEER_POSITION;
    added.points = PEER_PATCH_POINTS;
    added.isa = PEER_OPENSUBDIV_ISA;
    added.family = "";
    added.threads = 1;
    added.build_ms = source->build_ms;
    added.load_ms = double(NAN);
    added.byte_count = count_bytes(*source);
    added.controls = self->controls.data();
    added.control_size = 3;
    added.state = self.release();
    added.run = run;
    added.position = position;
    added.destroy = destroy;
}

} // namespace

bool peers_add_bfr(peer_list *list, const peer_scene *scene) {
    char error[256];
    const bool good = guard(error, sizeof error, [&] {
        const std::shared_ptr<const surfaces> source = build(*scene);
        append(*list, *scene, source, false);
        append(*list, *scene, source, true);
    });
    if (!good) std::fprintf(stderr, "limn-bench: %s: %s\n", scene->name, error);
    return good;
}

bool peers_add_bfr_copies(peer_list *list, const peer_scene *scene, uint32_t count) {
    char error[256];
    const bool good = guard(error, sizeof error, [&] {
        const std::shared_ptr<const surfaces> source = build(*scene);
        for (uint32_t copy = 0; copy < count; copy++)
            append(*list, *scene, source, true);
    });
    if (!good) std::fprintf(stderr, "limn-bench: %s: %s\n", scene->name, error);
    return good;
}
