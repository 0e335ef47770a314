/* SPDX-License-Identifier: MIT */
#include "require.h"

#include "limn/limn.h"

#include <math.h>

/// How far the weights of a point may be off 1: they move it by as much of its distance from the
/// origin.
#define SUM_TOLERANCE 1e-6

/// One influence, for sorting.
typedef struct weighted_joint {
    float weight;
    uint16_t joint;
} weighted_joint;

static limn_result refuse(limn_result result, uint32_t point, uint32_t influence,
                          limn_skin_place *place) {
    if (place) *place = (limn_skin_place){.point = point, .influence = influence};
    return result;
}

static bool is_weight(float weight) {
    return weight >= 0 && isfinite(weight);
}

static double sum_weights(const float *weights, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++)
        sum += (double)weights[i];
    return sum;
}

/// Whether `a` belongs before `b`.
static bool precedes(const weighted_joint *a, const weighted_joint *b) {
    return a->weight > b->weight || (a->weight == b->weight && a->joint < b->joint);
}

static void sort_influences(uint32_t count, uint16_t *joints, float *weights) {
    weighted_joint sorted[LIMN_INFLUENCE_MAX];
    for (uint32_t i = 0; i < count; i++) {
        const weighted_joint next = {weights[i], joints[i]};
        uint32_t at = i;
        for (; at > 0 && precedes(&next, &sorted[at - 1]); at--)
            sorted[at] = sorted[at - 1];
        sorted[at] = next;
    }
    for (uint32_t i = 0; i < count; i++) {
        weights[i] = sorted[i].weight;
        joints[i] = sorted[sorted[i].weight > 0 ? i : 0].joint;
    }
}

limn_result limn_skin_normalise(uint32_t point_count, uint32_t influence_count, uint16_t *joints,
                                float *weights, limn_skin_place *place) {
    LIMNI_REQUIRE(joints && weights, LIMN_ERROR_SKIN);
    if (influence_count < 1 || influence_count > LIMN_INFLUENCE_MAX)
        return refuse(LIMN_ERROR_SKIN, 0, 0, place);
    for (uint32_t point = 0; point < point_count; point++) {
        for (uint32_t i = 0; i < influence_count; i++) {
            if (!is_weight(weights[i])) return refuse(LIMN_ERROR_WEIGHT, point, i, place);
        }
        const double sum = sum_weights(weights, influence_count);
        if (sum == 0) return refuse(LIMN_ERROR_WEIGHT_SUM, point, 0, place);
        for (uint32_t i = 0; i < influence_count; i++)
            weights[i] = (float)((double)weights[i] / sum);
        sort_influences(influence_count, joints, weights);
        joints += influence_count;
        weights += influence_count;
    }
    return LIMN_OK;
}

limn_result limn_skin_check(const limn_skin *skin, limn_skin_place *place) {
    LIMNI_REQUIRE(skin && skin->joints && skin->weights, LIMN_ERROR_SKIN);
    const uint32_t count = skin->influence_count;
    if (count < 1 || count > LIMN_INFLUENCE_MAX || skin->joint_count == 0)
        return refuse(LIMN_ERROR_SKIN, 0, 0, place);
    const uint16_t *joints = skin->joints;
    const float *weights = skin->weights;
    for (uint32_t point = 0; point < skin->point_count; point++) {
        for (uint32_t i = 0; i < count; i++) {
            if (joints[i] >= skin->joint_count) return refuse(LIMN_ERROR_JOINT, point, i, place);
            if (!is_weight(weights[i])) return refuse(LIMN_ERROR_WEIGHT, point, i, place);
        }
        if (!(fabs(sum_weights(weights, count) - 1) <= SUM_TOLERANCE))
            return refuse(LIMN_ERROR_WEIGHT_SUM, point, 0, place);
        joints += count;
        weights += count;
    }
    return LIMN_OK;
}
