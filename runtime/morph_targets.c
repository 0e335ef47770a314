/* SPDX-License-Identifier: MIT */
/* Plain loops: IEEE arithmetic without fusing is the same bits everywhere. */
#include "require.h"

#include "limn/limn.h"

#include <math.h>
#include <string.h>

static limn_result refuse(limn_result result, uint32_t target, uint32_t entry,
                          limn_morph_place *place) {
    if (place) *place = (limn_morph_place){.target = target, .entry = entry};
    return result;
}

limn_result limn_morph_check(const limn_morph_targets *targets, uint32_t entry_count,
                             limn_morph_place *place) {
    LIMNI_REQUIRE(targets && targets->first, LIMN_ERROR_MORPH_POINT);
    uint32_t entry = 0;
    for (uint32_t target = 0; target < targets->target_count; target++) {
        const uint32_t end = targets->first[target + 1];
        if (targets->first[target] != entry || end < entry || end > entry_count)
            return refuse(LIMN_ERROR_MORPH_POINT, target, entry, place);
        for (const uint32_t begin = entry; entry < end; entry++) {
            const uint32_t point = targets->points[entry];
            const float *const delta = targets->deltas + 3 * (size_t)entry;
            if (point >= targets->point_count ||
                (entry > begin && point <= targets->points[entry - 1]))
                return refuse(LIMN_ERROR_MORPH_POINT, target, entry, place);
            if (!isfinite(delta[0]) || !isfinite(delta[1]) || !isfinite(delta[2]))
                return refuse(LIMN_ERROR_MORPH_DELTA, target, entry, place);
        }
    }
    return LIMN_OK;
}

/// The first of entries [low, high) whose point is not below `point`.
static uint32_t find_entry(const uint32_t *points, uint32_t low, uint32_t high, uint32_t point) {
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (points[middle] < point) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static void add_target(const limn_morph_targets *targets, uint32_t target, float weight,
                       uint32_t begin, uint32_t end, float *out) {
    const uint32_t last = targets->first[target + 1];
    const uint32_t from = find_entry(targets->points, targets->first[target], last, begin);
    const uint32_t to = find_entry(targets->points, from, last, end);
    for (uint32_t entry = from; entry < to; entry++) {
        const float *const delta = targets->deltas + 3 * (size_t)entry;
        float *const sum = out + 3 * (size_t)targets->points[entry];
        for (int axis = 0; axis < 3; axis++)
            sum[axis] += weight * delta[axis];
    }
}

/// The movements are summed before the point is added: rounded to their own size, not to its.
void limn_morph_points(const limn_morph_targets *targets, const float *weights, const float *points,
                       uint32_t begin, uint32_t end, float *out) {
    LIMNI_REQUIRE(targets && weights && points && out, );
    LIMNI_REQUIRE(begin <= end && end <= targets->point_count, );
    const size_t first = 3 * (size_t)begin, last = 3 * (size_t)end;
    memset(out + first, 0, (last - first) * sizeof *out);
    for (uint32_t target = 0; target < targets->target_count; target++) {
        if (weights[target] != 0) add_target(targets, target, weights[target], begin, end, out);
    }
    for (size_t i = first; i < last; i++)
        out[i] += points[i];
}
