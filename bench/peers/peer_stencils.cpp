/* SPDX-License-Identifier: MIT */
/*
 * OpenSubdiv's limit stencils, evaluated by Osd::CpuEvaluator. Control points are there in the
 * layout that is asked for, so no frame converts any.
 *
 * CpuEvaluator has vector code for positions of four floats only. Three such passes, over the
 * weights of the position and of each derivative, a block of stencils at a time, are at least as
 * fast as its own function for all three, so that is what the derivatives in xyzw do. With a
 * `start` other than 0 it writes to the wrong place: parts of a table are passed as tables of their
 * own.
 */
#include "allocate.h"
#include "opensubdiv_scene.h"
#include "peer.h"

#include "../bench.h"

#include "opensubdiv_patches.h"
#include "opensubdiv_refiner.h"

#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/osd/bufferDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;
using namespace limni_opensubdiv;

namespace {

/// Not Far::LimitStencilTableFactory: that wrapper casts the table to a class which it is not.
using stencil_factory = Far::LimitStencilTableFactoryReal<float>;
using stencil_table = Far::LimitStencilTableReal<float>;

/// From level 4 on, stencils equal the limit; see limni_opensubdiv_stencil_bytes().
constexpr int REFINEMENT_LEVEL = 6;

/// The largest count of stencils that give no more weights than int can hold, by the largest seen.
constexpr uint64_t STENCIL_COUNT_MAX = 76000000;

/// Whose indices stay in the first caches from pass to pass. 64 to 512 are alike; with 4096 and
/// more the three passes lose to OpenSubdiv's own function.
constexpr int BLOCK_STENCILS = 512;

/// A table and what its parts need.
struct stencils {
    std::unique_ptr<const stencil_table> table;
    std::vector<int> offsets;
    double position_build_ms, derivative_build_ms;
};

struct state {
    const peer_scene *where;
    std::shared_ptr<const stencils> source;
    peer_points points;
    int size; ///< floats of a point
    bool derivatives;
    std::vector<float> controls;
    std::vector<float> out[3]; ///< positions and derivatives
};

// -------------------------------------------------------------------------------------------------
// A frame

/// Stencils [begin, end) of a table.
struct part {
    int begin, end;
};

void evaluate_weights(state &self, const std::vector<float> &weights, std::vector<float> &out,
                      part p) {
    const stencils &source = *self.source;
    const int offset = source.offsets[size_t(p.begin)];
    const Osd::BufferDescriptor layout(0, self.size, self.size);
    Osd::CpuEvaluator::EvalStencils(
        self.controls.data(), layout, out.data() + size_t(p.begin) * size_t(self.size), layout,
        source.table->GetSizes().data() + p.begin, source.offsets.data() + p.begin,
        source.table->GetControlIndices().data() + offset, weights.data() + offset, 0,
        p.end - p.begin);
}

void evaluate_together(state &self) {
    const stencil_table &table = *self.source->table;
    const Osd::BufferDescriptor layout(0, self.size, self.size);
    Osd::CpuEvaluator::EvalStencils(
        self.controls.data(), layout, self.out[0].data(), layout, self.out[1].data(), layout,
        self.out[2].data(), layout, table.GetSizes().data(), self.source->offsets.data(),
        table.GetControlIndices().data(), table.GetWeights().data(), table.GetDuWeights().data(),
        table.GetDvWeights().data(), 0, table.GetNumStencils());
}

void evaluate_block(state &self, part p) {
    const stencil_table &table = *self.source->table;
    evaluate_weights(self, table.GetWeights(), self.out[0], p);
    if (!self.derivatives) return;
    evaluate_weights(self, table.GetDuWeights(), self.out[1], p);
    evaluate_weights(self, table.GetDvWeights(), self.out[2], p);
}

void evaluate(state &self, part p) {
    const int block = self.derivatives ? BLOCK_STENCILS : p.end - p.begin;
    for (int begin = p.begin; begin < p.end; begin += block)
        evaluate_block(self, {begin, std::min(p.end, begin + block)});
}

void run(void *self_state) {
    state &self = *static_cast<state *>(self_state);
    if (self.derivatives && self.size != 4)
        evaluate_together(self);
    else
        evaluate(self, {0, self.source->table->GetNumStencils()});
}

void run_part(void *self_state, uint32_t index, uint32_t count) {
    state &self = *static_cast<state *>(self_state);
    const uint32_t total = uint32_t(self.source->table->GetNumStencils());
    evaluate(self,
             {int(team_share(total, index, count)), int(team_share(total, index + 1, count))});
}

void run_in_parts(void *self_state) {
    team_run(static_cast<state *>(self_state)->where->threads, run_part, self_state);
}

const float *position(const void *self_state, uint32_t patch, uint32_t row) {
    const state &self = *static_cast<const state *>(self_state);
    size_t point = size_t(patch) * self.where->row_count + row;
    if (self.points == PEER_UNIQUE_POINTS) point = self.where->unique[point];
    return self.out[0].data() + point * size_t(self.size);
}

void destroy(void *self_state) {
    delete static_cast<state *>(self_state);
}

// -------------------------------------------------------------------------------------------------
// Preparation

/// In OpenSubdiv's form: for each patch a run of parameters (s, t) of its ptex face.
struct locations {
    std::vector<float> s, t;
    stencil_factory::LocationArrayVec arrays;
};

locations locate(const peer_scene &where, peer_points points) {
    const limni_opensubdiv_mesh mesh = describe_scene(where);
    const std::vector<grid_point> rows = list_rows(mesh);
    locations found;
    uint32_t row = 0;
    for (const patch &part : list_patches(mesh)) {
        stencil_factory::LocationArray array;
        array.ptexIdx = part.ptex_face;
        for (const grid_point place : rows) {
            const uint32_t mine = row++;
            if (points == PEER_UNIQUE_POINTS && where.unique_rows[where.unique[mine]] != mine)
                continue;
            const coordinates at = ptex_coordinates(part, place);
            found.s.push_back(float(at[0]));
            found.t.push_back(float(at[1]));
            array.numLocations++;
        }
        if (array.numLocations > 0) found.arrays.push_back(array);
    }
    // Only now do the parameters stay where they are.
    size_t first = 0;
    for (auto &array : found.arrays) {
        array.s = found.s.data() + first;
        array.t = found.t.data() + first;
        first += size_t(array.numLocations);
    }
    return found;
}

std::unique_ptr<const stencil_table> build(const peer_scene &where, peer_points points,
                                           bool derivatives, double &build_ms) {
    const double start = bench_seconds();
    require(uint64_t(where.patch_count) * where.row_count <= STENCIL_COUNT_MAX,
            "too many faces for OpenSubdiv's stencils");
    const refiner_pointer refiner = create_refiner(describe_scene(where));
    const locations found = locate(where, points);
    refiner->RefineAdaptive(Far::TopologyRefiner::AdaptiveOptions(REFINEMENT_LEVEL));
    stencil_factory::Options options;
    options.generate1stDerivatives = derivatives;
    std::unique_ptr<const stencil_table> table(
        stencil_factory::Create(*refiner, found.arrays, nullptr, nullptr, options));
    require(table != nullptr, "OpenSubdiv made no limit stencils");
    require(size_t(table->GetNumStencils()) == found.s.size(), "OpenSubdiv left stencils out");
    build_ms = 1e3 * (bench_seconds() - start);
    return table;
}

/// With derivatives.
std::shared_ptr<stencils> build_all(const peer_scene &where, peer_points points) {
    auto built = std::make_shared<stencils>();
    built->table = build(where, points, true, built->derivative_build_ms);
    const std::vector<int> &sizes = built->table->GetSizes();
    built->offsets.assign(sizes.size() + 1, 0);
    for (size_t i = 0; i < sizes.size(); i++)
        built->offsets[i + 1] = built->offsets[i] + sizes[i];
    return built;
}

/// One table serves with and without derivatives, since their weights are arrays of their own.
std::shared_ptr<const stencils> build_both(const peer_scene &where, peer_points points) {
    const std::shared_ptr<stencils> built = build_all(where, points);
    build(where, points, false, built->position_build_ms);
    return built;
}

uint64_t count_bytes(const stencil_table &table, bool derivatives) {
    const uint64_t weights = bytes_of(table.GetWeights());
    return bytes_of(table.GetSizes()) + sizeof(int) * table.GetSizes().size() + // offsets
           bytes_of(table.GetControlIndices()) + weights * (derivatives ? 3 : 1);
}

state *create_state(const peer_scene &where, const std::shared_ptr<const stencils> &source,
                    peer_points points, int size, bool derivatives) {
    auto self = std::make_unique<state>();
    self->where = &where;
    self->source = source;
    self->points = points;
    self->size = size;
    self->derivatives = derivatives;
    self->controls.resize(where.control_count * size_t(size), 1.0f);
    for (size_t v = 0; v < where.control_count; v++) {
        for (size_t axis = 0; axis < 3; axis++)
            self->controls[v * size_t(size) + axis] = where.controls[v][axis];
    }
    for (int o = 0; o < (derivatives ? 3 : 1); o++)
        self->out[o].resize(size_t(source->table->GetNumStencils()) * size_t(size));
    return self.release();
}

void append(peer_list &list, const peer_scene &where, const std::shared_ptr<const stencils> &source,
            peer_points points, int size, bool derivatives, bool threaded) {
    state *self = create_state(where, source, points, size, derivatives);
    peer &added = *peer_append(&list);
    added.name = size == 4 ? "opensubdiv xyzw" : "opensubdiv xyz";
    added.output = derivatives ? PEER_POSITION_DERIVATIVES : PEER_POSITION;
    added.points = points;
    added.isa = PEER_OPENSUBDIV_ISA;
    added.family = "";
    added.threads = threaded ? team_size(where.threads) : 1;
    added.build_ms = derivatives ? source->derivative_build_ms : source->position_build_ms;
    added.load_ms = double(NAN);
    added.byte_count = count_bytes(*source->table, derivatives);
    added.state = self;
    added.run = threaded ? run_in_parts : run;
    added.position = position;
    added.controls = self->controls.data();
    added.control_size = uint32_t(size);
    added.destroy = destroy;
}

void append_all(peer_list &list, const peer_scene &where) {
    for (const peer_points points : {PEER_PATCH_POINTS, PEER_UNIQUE_POINTS}) {
        const std::shared_ptr<const stencils> source = build_both(where, points);
        for (const bool derivatives : {false, true}) {
            append(list, where, source, points, 4, derivatives, false);
            append(list, where, source, points, 3, derivatives, false);
            if (where.threads) append(list, where, source, points, 4, derivatives, true);
        }
    }
}

} // namespace

bool peers_add_stencils(peer_list *list, const peer_scene *scene) {
    char error[256];
    const bool good = guard(error, sizeof error, [&] { append_all(*list, *scene); });
    if (!good) std::fprintf(stderr, "limn-bench: %s: %s\n", scene->name, error);
    return good;
}

bool peers_add_stencil_copies(peer_list *list, const peer_scene *scene, uint32_t count) {
    char error[256];
    const bool good = guard(error, sizeof error, [&] {
        const std::shared_ptr<const stencils> source = build_all(*scene, PEER_UNIQUE_POINTS);
        for (uint32_t copy = 0; copy < count; copy++)
            append(*list, *scene, source, PEER_UNIQUE_POINTS, 4, true, false);
    });
    if (!good) std::fprintf(stderr, "limn-bench: %s: %s\n", scene->name, error);
    return good;
}
