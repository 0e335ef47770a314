/* SPDX-License-Identifier: MIT */
#include "mesh.h"
#include "require.h"

#include <math.h>
#include <string.h>

limn_plan limn_plan_uniform(const limn_mesh *mesh, uint32_t level) {
    LIMNI_REQUIRE(mesh && mesh->domain && level <= LIMN_LEVEL_MAX, (limn_plan){0});
    return (limn_plan){
        .mesh = mesh,
        .level = level,
        .patch_count = mesh->patch_count,
        .vertex_count = (uint64_t)mesh->patch_count * mesh->domain->row_counts[level],
        .index_count = (uint64_t)mesh->patch_count * mesh->domain->index_counts[level],
    };
}

uint64_t limn_plan_first_vertex(const limn_plan *plan, uint32_t patch_index) {
    LIMNI_REQUIRE(plan && patch_index < plan->patch_count, 0);
    if (plan->patches) return plan->patches[patch_index].first_vertex;
    return (uint64_t)patch_index * plan->mesh->domain->row_counts[plan->level];
}

// ---- Levels of detail

enum { PLANES = 6, TEMPLATE_MAX = 256 };

typedef struct planner {
    const limn_mesh *mesh;
    const float *controls;
    const limn_view *views;
    uint32_t view_count;
    limn_lod_desc desc;
    uint32_t *outside; ///< [control_count] bit 6 v + p: outside of plane p of view v
    limn_plan_patch *patches;
    uint32_t patch_count;
} planner;

/// log2 within 0.008: continuous and rising, which is all that levels need, and quicker than
/// libm's. x: not negative.
static float find_log2(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const float exponent = (float)(int32_t)(bits >> 23) - 127.0f;
    bits = (bits & 0x7fffffu) | 0x3f800000u;
    float mantissa;
    memcpy(&mantissa, &bits, sizeof mantissa);
    const float t = mantissa - 1.0f;
    return exponent + t + 0.3466f * t * (1.0f - t);
}

static void mark_outside(const planner *p) {
    for (uint32_t c = 0; c < p->mesh->control_count; c++) {
        const float *const point = p->controls + 3 * (size_t)c;
        uint32_t outside = 0;
        for (uint32_t v = 0; v < p->view_count; v++) {
            for (uint32_t k = 0; k < p->views[v].plane_count; k++) {
                const float *const plane = p->views[v].planes[k];
                const float side =
                    plane[0] * point[0] + plane[1] * point[1] + plane[2] * point[2] + plane[3];
                outside |= (uint32_t)(side < 0) << (PLANES * v + k);
            }
        }
        p->outside[c] = outside;
    }
}

static bool may_be_seen(const planner *p, const uint32_t *indices, uint32_t count) {
    uint32_t outside = UINT32_MAX;
    for (uint32_t k = 0; k < count; k++)
        outside &= p->outside[indices[k]];
    for (uint32_t v = 0; v < p->view_count; v++) {
        if ((outside >> PLANES * v & ((1u << PLANES) - 1)) == 0) return true;
    }
    return false;
}

/// The square of the length of an edge on the screen, in pixels: the largest of all views.
/// Exchanging a and b changes no bit.
static float square_of_pixels(const planner *p, const float *a, const float *b) {
    float largest = 0;
    for (uint32_t v = 0; v < p->view_count; v++) {
        const limn_view *const view = &p->views[v];
        float length2 = 0, distance2 = 0;
        for (int axis = 0; axis < 3; axis++) {
            const float difference = a[axis] - b[axis];
            const float middle = (a[axis] + b[axis]) * 0.5f - view->eye[axis];
            length2 += difference * difference;
            distance2 += middle * middle;
        }
        const float nearest2 = view->nearest * view->nearest;
        const float divisor = view->orthographic     ? 1.0f
                              : distance2 > nearest2 ? distance2
                                                     : nearest2;
        const float square = length2 * (view->pixels * view->pixels) / divisor;
        largest = square > largest ? square : largest;
    }
    return largest;
}

/// Before the limits and the budget.
static float edge_level(const planner *p, uint32_t a, uint32_t b) {
    if (p->desc.lod == LIMN_LOD_UNIFORM) return p->desc.level + p->desc.bias;
    const float square =
        square_of_pixels(p, p->controls + 3 * (size_t)a, p->controls + 3 * (size_t)b);
    const float target2 = p->desc.pixels * p->desc.pixels;
    return 0.5f * find_log2(square / target2) + p->desc.bias;
}

/// Lists what may be seen, with the levels of edges in the place of their weights.
static void list_patches(planner *p) {
    const uint32_t corners = p->mesh->domain->corner_count;
    for (uint32_t r = 0; r < p->mesh->run_count; r++) {
        const limn_file_run *const run = &p->mesh->runs[r];
        const uint32_t count = p->mesh->classes[run->class_index].control_count;
        const uint32_t *indices = p->mesh->indices + run->first_index;
        for (uint32_t i = 0; i < run->patch_count; i++, indices += count) {
            const uint32_t patch = run->first_patch + i;
            if (!may_be_seen(p, indices, count)) continue;
            if (p->desc.keep_fn && !p->desc.keep_fn(p->desc.keep_user, patch)) continue;
            limn_plan_patch *const item = &p->patches[p->patch_count++];
            *item = (limn_plan_patch){.patch = patch};
            for (uint32_t e = 0; e < corners; e++)
                item->edge_morphs[e] =
                    edge_level(p, indices[e], indices[e + 1 < corners ? e + 1 : 0]);
        }
    }
}

static float limit_level(const planner *p, float level) {
    const float top = level < p->desc.max_level ? level : p->desc.max_level;
    return top > p->desc.min_level ? top : p->desc.min_level; // also where it is not a number
}

static uint32_t whole_level(float level) {
    return (uint32_t)ceilf(level);
}

static float highest_level(const planner *p, const limn_plan_patch *item, float lowered) {
    float highest = 0;
    for (uint32_t e = 0; e < p->mesh->domain->corner_count; e++) {
        const float level = limit_level(p, item->edge_morphs[e] - lowered);
        highest = level > highest ? level : highest;
    }
    return highest;
}

static uint64_t count_vertices(const planner *p, float lowered) {
    uint64_t count = 0;
    for (uint32_t i = 0; i < p->patch_count; i++)
        count +=
            p->mesh->domain->row_counts[whole_level(highest_level(p, &p->patches[i], lowered))];
    return count;
}

/// By how much levels must be lowered to keep to the budget: as little as a bisection finds.
static float find_lowering(const planner *p) {
    const uint64_t budget = p->desc.vertex_budget;
    if (budget == 0 || count_vertices(p, 0) <= budget) return 0;
    float low = 0, high = 2 * LIMN_LEVEL_MAX;
    while (count_vertices(p, high) > budget && high < 64)
        high *= 2;
    for (int step = 0; step < 12; step++) {
        const float middle = (low + high) / 2;
        if (count_vertices(p, middle) > budget) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

/// Level l draws n = ceil(l) levels; what is new at n has weight l - (n - 1).
static float weight_of(const planner *p, float level) {
    const uint32_t n = whole_level(level);
    return n == 0 || p->desc.no_morph ? 1.0f : level - (float)(n - 1);
}

static void finish_patches(const planner *p, float lowered, limn_plan *plan) {
    const limn_domain *const domain = p->mesh->domain;
    for (uint32_t i = 0; i < p->patch_count; i++) {
        limn_plan_patch *const item = &p->patches[i];
        const float highest = highest_level(p, item, lowered);
        item->level = (uint8_t)whole_level(highest);
        item->morph = weight_of(p, highest);
        for (uint32_t e = 0; e < domain->corner_count; e++) {
            const float level = limit_level(p, item->edge_morphs[e] - lowered);
            item->edge_levels[e] = (uint8_t)whole_level(level);
            item->edge_morphs[e] = weight_of(p, level);
        }
        item->template_index = (uint16_t)limn_template_find(domain, item->level, item->edge_levels);
        item->first_vertex = (uint32_t)plan->vertex_count;
        plan->vertex_count += domain->row_counts[item->level];
        plan->level = item->level > plan->level ? item->level : plan->level;
    }
}

/// Draws in the order of templates, and of patches within each.
static void make_draws(const planner *p, const limn_template *templates, limn_draw *draws,
                       limn_plan *plan) {
    uint32_t next[TEMPLATE_MAX + 1] = {0};
    for (uint32_t i = 0; i < p->patch_count; i++)
        next[p->patches[i].template_index + 1]++;
    for (uint32_t t = 0; t < TEMPLATE_MAX; t++)
        next[t + 1] += next[t];
    for (uint32_t i = 0; i < p->patch_count; i++) {
        const limn_plan_patch *const item = &p->patches[i];
        const limn_template *const template = &templates[item->template_index];
        draws[next[item->template_index]++] =
            (limn_draw){.index_count = template->index_count,
                        .instance_count = 1,
                        .first_index = template->first_index,
                        .base_vertex = (int32_t)item->first_vertex,
                        .base_instance = i};
        plan->index_count += template->index_count;
    }
    plan->draws = draws;
}

size_t limn_plan_size(const limn_mesh *mesh) {
    LIMNI_REQUIRE(mesh, 0);
    return (size_t)mesh->patch_count * (sizeof(limn_plan_patch) + sizeof(limn_draw)) +
           (size_t)mesh->control_count * sizeof(uint32_t);
}

limn_plan limn_plan_build(const limn_mesh *mesh, const float *controls, const limn_view *views,
                          uint32_t view_count, const limn_lod_desc *desc,
                          const limn_template *templates, void *memory) {
    LIMNI_REQUIRE(mesh && mesh->domain && controls && views && memory, (limn_plan){0});
    LIMNI_REQUIRE(view_count >= 1 && view_count <= LIMN_VIEW_MAX, (limn_plan){0});
    planner p = {.mesh = mesh,
                 .controls = controls,
                 .views = views,
                 .view_count = view_count,
                 .desc = desc ? *desc : (limn_lod_desc){0},
                 .patches = memory};
    if (p.desc.pixels == 0) p.desc.pixels = 8;
    if (p.desc.max_level == 0) p.desc.max_level = LIMN_LEVEL_MAX;
    LIMNI_REQUIRE(p.desc.min_level >= 0 && p.desc.max_level <= LIMN_LEVEL_MAX &&
                      p.desc.min_level <= p.desc.max_level && p.desc.pixels > 0,
                  (limn_plan){0});
    limn_draw *const draws = (limn_draw *)(void *)(p.patches + mesh->patch_count);
    p.outside = (uint32_t *)(void *)(draws + mesh->patch_count);
    mark_outside(&p);
    list_patches(&p);
    limn_plan plan = {.mesh = mesh, .patch_count = p.patch_count, .patches = p.patches};
    finish_patches(&p, find_lowering(&p), &plan);
    LIMNI_REQUIRE(plan.vertex_count <= INT32_MAX, (limn_plan){0});
    if (templates) make_draws(&p, templates, draws, &plan);
    return plan;
}
