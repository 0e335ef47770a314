/* SPDX-License-Identifier: MIT */
#include "lod.h"
#include "mesh.h"
#include "require.h"
#include "rounding.h"

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

enum {
    TEMPLATE_MAX = 979,
    PLANES = 6 ///< of a view
};

typedef struct planner {
    const limn_mesh *mesh;
    const float *controls;
    const limn_view *views;
    uint32_t view_count;
    limn_lod_desc desc;
    uint32_t *outside;        ///< [point_count] bit 6 v + p: outside of plane p of view v
    limni_lod_levels *levels; ///< of edges, a block for each LIMNI_LOD_BLOCK patches
    limn_plan_patch *patches;
    uint32_t patch_count;
} planner;

// ---- Culling

/// A block of points, structure of arrays.
typedef struct point_block {
    float axes[3][LIMNI_LOD_BLOCK];
} point_block;

static inline float distance_inside(const float plane[4], const float *point) {
    return plane[0] * point[0] + plane[1] * point[1] + plane[2] * point[2] + plane[3];
}

static void add_plane(const point_block *points, const float plane[4], uint32_t bit,
                      uint32_t outside[LIMNI_LOD_BLOCK]) {
    for (int i = 0; i < LIMNI_LOD_BLOCK; i++) {
        const float point[3] = {points->axes[0][i], points->axes[1][i], points->axes[2][i]};
        const float side = distance_inside(plane, point);
        outside[i] |= side < 0 ? bit : 0;
    }
}

static void mark_outside(const planner *p) {
    const uint32_t count = p->mesh->point_count;
    point_block points = {0};
    for (uint32_t first = 0; first < count; first += LIMNI_LOD_BLOCK) {
        uint32_t outside[LIMNI_LOD_BLOCK] = {0};
        const uint32_t left = count - first;
        const uint32_t in_block = left < LIMNI_LOD_BLOCK ? left : LIMNI_LOD_BLOCK;
        const float *point = p->controls + 3 * (size_t)first;
        for (uint32_t i = 0; i < in_block; i++, point += 3) {
            for (int axis = 0; axis < 3; axis++)
                points.axes[axis][i] = point[axis];
        }
        for (uint32_t v = 0; v < p->view_count; v++) {
            for (uint32_t k = 0; k < p->views[v].plane_count; k++)
                add_plane(&points, p->views[v].planes[k], 1u << (PLANES * v + k), outside);
        }
        memcpy(p->outside + first, outside, in_block * sizeof *outside);
    }
}

/// Whether what is outside of all these planes may be seen in some view.
static inline bool is_in_view(uint32_t outside, uint32_t view_count) {
    bool seen = false;
    for (uint32_t v = 0; v < view_count; v++)
        seen |= (outside >> PLANES * v & ((1u << PLANES) - 1)) == 0;
    return seen;
}

/// Whether the surface may reach back over a plane that all points of a patch are outside of. Along
/// its normal a row is at most max + negative (max - min) of the points.
static bool reaches_over(const planner *p, const float plane[4], const uint32_t *indices,
                         const limn_file_class *class) {
    float high = -INFINITY, low = INFINITY;
    for (uint32_t k = 0; k < class->control_count; k++) {
        const float side = distance_inside(plane, p->controls + 3 * (size_t)indices[k]);
        high = side > high ? side : high;
        low = side < low ? side : low;
    }
    return !(high + class->negative * (high - low) < 0);
}

/// Of a patch whose points are outside of all these planes, but whose surface may leave their hull.
static bool may_leave_hull(const planner *p, uint32_t outside, const uint32_t *indices,
                           const limn_file_class *class) {
    for (uint32_t v = 0; v < p->view_count; v++) {
        bool seen = true;
        for (uint32_t k = 0; k < p->views[v].plane_count && seen; k++) {
            if (outside >> (PLANES * v + k) & 1)
                seen = reaches_over(p, p->views[v].planes[k], indices, class);
        }
        if (seen) return true;
    }
    return false;
}

/// The corners come first, and most often decide.
static inline bool may_be_seen(const planner *p, const uint32_t *indices, uint32_t corner_count,
                               const limn_file_class *class) {
    const uint32_t *const of = p->outside, count = class->control_count;
    uint32_t outside = UINT32_MAX;
    for (uint32_t k = 0; k < corner_count; k++)
        outside &= of[indices[k]];
    if (is_in_view(outside, p->view_count)) return true;
    for (uint32_t k = corner_count; k < count; k++)
        outside &= of[indices[k]];
    return is_in_view(outside, p->view_count) ||
           (class->negative > 0 && may_leave_hull(p, outside, indices, class));
}

// ---- Listing

/// bases         from the first base vertex on
/// first_corner  see limni_first_corner()
/// errors        [corner_count]; NULL: levels do not ask for them
static inline void set_edges(const float *bases, const uint32_t *indices, uint32_t first_corner,
                             const uint16_t *errors, uint32_t corner_count, uint32_t at,
                             limni_lod_block *block) {
    for (uint32_t corner = 0; corner < corner_count; corner++) {
        const float *const point = bases + 3 * (size_t)(indices[corner] - first_corner);
        block->corners[corner][0][at] = point[0];
        block->corners[corner][1][at] = point[1];
        block->corners[corner][2][at] = point[2];
        if (errors) block->errors[corner][at] = errors[corner];
    }
}

static void measure_block(const planner *p, const limni_lod_block *block) {
    const uint32_t last = p->patch_count - 1;
    limni_lod_measure(&p->desc, p->views, p->view_count, p->mesh->domain->corner_count, block,
                      &p->levels[last / LIMNI_LOD_BLOCK]);
}

/// Lists what may be seen of one run.
static inline void list_run(planner *p, const limn_file_run *run, uint32_t corner_count,
                            limni_lod_block *block) {
    const limn_mesh *const mesh = p->mesh;
    const float *const bases = p->controls + 3 * (size_t)mesh->base_first;
    const uint16_t *const errors = p->desc.lod == LIMN_LOD_ERROR ? mesh->errors : NULL;
    const limn_file_class *const class = &mesh->classes[run->class_index];
    const uint32_t count = class->control_count, first_corner = limni_first_corner(mesh);
    const uint32_t *indices = mesh->indices + run->first_index;
    for (uint32_t i = 0; i < run->patch_count; i++, indices += count) {
        const uint32_t patch = run->first_patch + i, at = p->patch_count % LIMNI_LOD_BLOCK;
        if (!may_be_seen(p, indices, corner_count, class)) continue;
        if (p->desc.keep_fn && !p->desc.keep_fn(p->desc.keep_user, patch)) continue;
        set_edges(bases, indices, first_corner,
                  errors ? errors + (size_t)patch * corner_count : NULL, corner_count, at, block);
        p->patches[p->patch_count++].patch = patch;
        if (at == LIMNI_LOD_BLOCK - 1) measure_block(p, block);
    }
}

/// Lists what may be seen, and finds the levels of its edges.
static void list_patches(planner *p) {
    const uint32_t corner_count = p->mesh->domain->corner_count;
    limni_lod_block block = {0};
    for (uint32_t r = 0; r < p->mesh->run_count; r++) {
        if (corner_count == 3) { // for the compiler
            list_run(p, &p->mesh->runs[r], 3, &block);
        } else {
            list_run(p, &p->mesh->runs[r], 4, &block);
        }
    }
    if (p->patch_count % LIMNI_LOD_BLOCK) measure_block(p, &block);
}

// ---- Levels and places

static uint32_t count_in_block(const planner *p, uint32_t first) {
    const uint32_t left = p->patch_count - first;
    return left < LIMNI_LOD_BLOCK ? left : LIMNI_LOD_BLOCK;
}

static void choose_block(const planner *p, uint32_t first, float lowered,
                         limni_lod_choice *choice) {
    limni_lod_choose(&p->desc, p->mesh->domain->corner_count, &p->levels[first / LIMNI_LOD_BLOCK],
                     lowered, choice);
}

static uint64_t count_vertices(const planner *p, float lowered) {
    uint64_t count = 0;
    limni_lod_choice choice;
    for (uint32_t first = 0; first < p->patch_count; first += LIMNI_LOD_BLOCK) {
        choose_block(p, first, lowered, &choice);
        for (uint32_t i = 0; i < count_in_block(p, first); i++)
            count += p->mesh->domain->row_counts[choice.levels[i]];
    }
    return count;
}

/// By how much levels must be lowered to keep to the budget: as little as a bisection finds.
static float find_lowering(const planner *p) {
    const uint64_t budget = p->desc.vertex_budget;
    if (budget == 0 || count_vertices(p, 0) <= budget) return 0;
    float low = 0, high = 2 * LIMN_LEVEL_MAX;
    while (count_vertices(p, high) > budget && high < 256)
        high *= 2;
    for (int step = 0; step < 16; step++) {
        const float middle = (low + high) / 2;
        if (count_vertices(p, middle) > budget) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

/// Patch i of a block, but for what it is a patch of and its template.
static void set_patch(const limni_lod_choice *choice, uint32_t i, limn_plan_patch *item) {
    item->level = (uint8_t)choice->levels[i];
    item->morph = choice->morphs[i];
    for (uint32_t e = 0; e < LIMN_CORNER_MAX; e++) {
        item->edge_levels[e] = (uint8_t)choice->edge_levels[e][i];
        item->edge_morphs[e] = choice->edge_morphs[e][i];
    }
}

static void finish_patches(const planner *p, float lowered, limn_plan *plan) {
    const limn_domain *const domain = p->mesh->domain;
    const uint8_t whole[LIMN_CORNER_MAX] = {0};
    uint32_t first_templates[LIMN_LEVEL_COUNT]; // that of a level whose edges are all at level 0
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
        first_templates[level] = limn_template_find(domain, level, whole);
    limni_lod_choice choice = {0}; // edges that the domain does not have stay 0
    for (uint32_t first = 0; first < p->patch_count; first += LIMNI_LOD_BLOCK) {
        choose_block(p, first, lowered, &choice);
        for (uint32_t i = 0; i < count_in_block(p, first); i++) {
            limn_plan_patch *const item = &p->patches[first + i];
            const uint32_t level = (uint32_t)choice.levels[i];
            item->reserved = 0;
            set_patch(&choice, i, item);
            item->template_index = (uint16_t)(first_templates[level] + (uint32_t)choice.places[i]);
            item->first_vertex = (uint32_t)plan->vertex_count;
            plan->vertex_count += domain->row_counts[level];
            plan->level = level > plan->level ? level : plan->level;
        }
    }
}

/// Draws in the order of templates, and of patches within each.
static void make_draws(const planner *p, const limn_template *templates, limn_draw *draws,
                       limn_plan *plan) {
    const uint32_t template_count = limn_template_count(p->mesh->domain);
    uint32_t next[TEMPLATE_MAX + 1];
    memset(next, 0, (template_count + 1) * sizeof *next);
    for (uint32_t i = 0; i < p->patch_count; i++)
        next[p->patches[i].template_index + 1]++;
    for (uint32_t t = 0; t < template_count; t++)
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

/// Where what a planner writes lies in the caller's memory, behind the patches: in bytes.
typedef struct plan_layout {
    size_t draws, levels, outside, size;
} plan_layout;

static plan_layout lay_out(const limn_mesh *mesh) {
    const size_t patch_count = mesh->patch_count;
    const size_t block_count = (patch_count + LIMNI_LOD_BLOCK - 1) / LIMNI_LOD_BLOCK;
    plan_layout l = {.draws = patch_count * sizeof(limn_plan_patch)};
    l.levels = l.draws + patch_count * sizeof(limn_draw);
    l.outside = l.levels + block_count * sizeof(limni_lod_levels);
    l.size = l.outside + (size_t)mesh->point_count * sizeof(uint32_t);
    return l;
}

size_t limn_plan_size(const limn_mesh *mesh) {
    LIMNI_REQUIRE(mesh, 0);
    return lay_out(mesh).size;
}

/// Uniform levels ask for no more than the planes of a view.
static bool is_valid_view(const limn_view *view, bool uniform) {
    const float sum = view->eye[0] + view->eye[1] + view->eye[2];
    if (view->plane_count > PLANES) return false;
    return uniform || (isfinite(sum) && view->pixels > 0 && isfinite(view->pixels) &&
                       (view->orthographic || view->nearest > 0));
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
                 .desc = limni_lod_complete(desc)};
    LIMNI_REQUIRE(limni_lod_is_valid(&p.desc, mesh), (limn_plan){0});
    for (uint32_t v = 0; v < view_count; v++)
        LIMNI_REQUIRE(is_valid_view(&views[v], p.desc.lod == LIMN_LOD_UNIFORM), (limn_plan){0});
    const plan_layout layout = lay_out(mesh);
    unsigned char *const bytes = memory;
    p.patches = memory;
    p.levels = (limni_lod_levels *)(void *)(bytes + layout.levels);
    p.outside = (uint32_t *)(void *)(bytes + layout.outside);
    mark_outside(&p);
    list_patches(&p);
    limn_plan plan = {.mesh = mesh, .patch_count = p.patch_count, .patches = p.patches};
    finish_patches(&p, find_lowering(&p), &plan);
    if (plan.vertex_count > INT32_MAX) return (limn_plan){0};
    if (templates) make_draws(&p, templates, (limn_draw *)(void *)(bytes + layout.draws), &plan);
    return plan;
}
