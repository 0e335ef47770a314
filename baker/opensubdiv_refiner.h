/* SPDX-License-Identifier: MIT */
/*
 * What everything that uses OpenSubdiv shares: its errors as exceptions, and a refiner for a base
 * mesh. C++, for the baker's oracle and the benchmarks. OpenSubdiv reports errors through one
 * callback of the process, so all this is for one thread at a time.
 */
#ifndef LIMNI_OPENSUBDIV_REFINER_H
#define LIMNI_OPENSUBDIV_REFINER_H

#include "opensubdiv.h"

#include <opensubdiv/far/topologyRefiner.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace limni_opensubdiv {

/// OpenSubdiv gives a text to a callback and goes on. As long as this lives, texts are kept for
/// require().
class error_capture {
  public:
    error_capture();
    ~error_capture();
    error_capture(const error_capture &) = delete;
    error_capture &operator=(const error_capture &) = delete;
};

/// Throws `text`, or rather what OpenSubdiv said if it complained at all.
void require(bool condition, const std::string &text);

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

/// What PrimvarRefiner adds up.
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

using refiner_pointer = std::unique_ptr<OpenSubdiv::Far::TopologyRefiner>;

/// A refiner that is not refined yet, with a channel or without. Throws when OpenSubdiv refuses the
/// mesh, or would crash on it.
refiner_pointer create_refiner(const limni_opensubdiv_mesh &mesh,
                               const limni_opensubdiv_channel *channel = nullptr);

/// Refines uniformly until nothing is semi-sharp, and as far as the grid of the mesh.
void refine_for_limit(OpenSubdiv::Far::TopologyRefiner &refiner, const limni_opensubdiv_mesh &mesh);

/// Whether the limit that OpenSubdiv gives a vertex of the mesh depends on the level of refinement:
/// at the end of a crease that stays sharp, which has the limit of a smooth vertex, and with
/// Catmull-Clark at a smooth vertex of two faces, which stays where it is.
bool converges(const limni_opensubdiv_mesh &mesh, const OpenSubdiv::Far::TopologyLevel &base,
               OpenSubdiv::Far::Index vertex);

/// Whether something is sharp, or a hole.
bool is_tagged(const limni_opensubdiv_mesh &mesh);

constexpr float SHARP_FOR_EVER = 10;

/// How many corners a face has, and all of them.
uint32_t face_size(const limni_opensubdiv_mesh &mesh, size_t face);
size_t corner_count(const limni_opensubdiv_mesh &mesh);

template <typename item_type> uint64_t bytes_of(const std::vector<item_type> &items) {
    return uint64_t(items.size()) * sizeof(item_type);
}

} // namespace limni_opensubdiv

#endif
