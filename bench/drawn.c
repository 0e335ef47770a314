/* SPDX-License-Identifier: MIT */
#include "drawn.h"

#include <math.h>
#include <stdlib.h>

static uint32_t finest_count(const limn_mesh *mesh) {
    return mesh->domain->row_counts[LIMN_LEVEL_MAX];
}

static void index_rows(drawn_mesh *drawn) {
    for (uint16_t r = 0; r < finest_count(&drawn->mesh); r++) {
        const limn_row *const row = &drawn->mesh.domain->rows[r];
        drawn->row_at[row->i][row->j] = r;
    }
}

bool drawn_mesh_create(drawn_mesh *drawn, const limn_mesh *mesh) {
    const limn_plan plan = limn_plan_uniform(mesh, LIMN_LEVEL_MAX);
    drawn->mesh = *mesh;
    index_rows(drawn);
    const uint32_t count =
        limn_templates_write(mesh->domain, LIMN_TOPOLOGY_TRIANGLES, 2, NULL, NULL);
    drawn->templates = malloc(limn_template_count(mesh->domain) * sizeof *drawn->templates);
    drawn->indices = malloc(count * sizeof *drawn->indices);
    drawn->finest = malloc((size_t)plan.vertex_count * sizeof *drawn->finest);
    if (!drawn->templates || !drawn->indices || !drawn->finest) return false;
    limn_templates_write(mesh->domain, LIMN_TOPOLOGY_TRIANGLES, 2, drawn->indices,
                         drawn->templates);
    limn_evaluate(&plan, mesh->controls, 0, plan.patch_count,
                  &(limn_output){.vertices = drawn->finest});
    return true;
}

void drawn_mesh_destroy(drawn_mesh *drawn) {
    free(drawn->templates);
    free(drawn->indices);
    free(drawn->finest);
}

bool drawn_frame_create(drawn_frame *frame, const drawn_mesh *of) {
    const size_t count = (size_t)of->mesh.patch_count * finest_count(&of->mesh);
    *frame = (drawn_frame){.of = of,
                           .memory = malloc(limn_plan_size(&of->mesh)),
                           .vertices = malloc(count * sizeof *frame->vertices),
                           .points = malloc(count * sizeof *frame->points)};
    return frame->memory && frame->vertices && frame->points;
}

void drawn_frame_destroy(drawn_frame *frame) {
    free(frame->memory);
    free(frame->vertices);
    free(frame->points);
}

// -------------------------------------------------------------------------------------------------
// Sampling

/// Grid coordinates of a vertex.
typedef double place[2];

/// The row with which row `t` of an edge is drawn: itself, or where the edge skips it, the nearest
/// of its elders; of the row of level 1, which has none, the start of the edge.
static uint32_t kept_row(const limn_domain *domain, uint32_t edge, uint32_t edge_level,
                         uint32_t t) {
    uint32_t row = domain->edge_rows[edge][t];
    while (domain->rows[row].level > edge_level)
        row = domain->rows[row].level > 1 ? domain->rows[row].sources[0] : edge;
    return row;
}

static void place_edge(const limn_domain *domain, const limn_plan_patch *item, uint32_t edge,
                       place *places) {
    const uint16_t *const along = domain->edge_rows[edge];
    const uint32_t level = item->edge_levels[edge], step = LIMN_GRID_SIZE >> level;
    for (uint32_t t = step; t < LIMN_GRID_SIZE && level > 0; t += 2 * step) {
        const uint16_t *const sources = domain->rows[along[t]].sources;
        for (int axis = 0; axis < 2; axis++) {
            const double from = (places[sources[0]][axis] + places[sources[1]][axis]) / 2;
            places[along[t]][axis] =
                from + (double)item->edge_morphs[edge] * (places[along[t]][axis] - from);
        }
    }
    for (uint32_t t = 1; t < LIMN_GRID_SIZE; t++) {
        const double *const kept = places[kept_row(domain, edge, level, t)];
        for (int axis = 0; axis < 2; axis++)
            places[along[t]][axis] = kept[axis];
    }
}

static void place_rows(const limn_domain *domain, const limn_plan_patch *item, place *places) {
    const uint32_t end = domain->row_counts[item->level];
    const uint32_t begin = item->level ? domain->row_counts[item->level - 1] : end;
    for (uint32_t r = 0; r < end; r++)
        places[r][0] = domain->rows[r].i, places[r][1] = domain->rows[r].j;
    for (uint32_t e = 0; e < domain->corner_count; e++)
        place_edge(domain, item, e, places);
    for (uint32_t r = begin; r < end; r++) {
        const limn_row *const row = &domain->rows[r];
        const double *const a = places[row->parents[0]], *const b = places[row->parents[1]];
        for (int axis = 0; axis < 2 && !row->edges; axis++) {
            const double middle = (a[axis] + b[axis]) / 2;
            places[r][axis] = middle + (double)item->morph * (places[r][axis] - middle);
        }
    }
}

static double cross(const place a, const place b, const place c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double least(double a, double b, double c) {
    return fmin(a, fmin(b, c));
}

/// Samples the grid points in one triangle: corner k is at `places[k]` and drawn at `corners[k]`.
static void sample_triangle(const drawn_mesh *mesh, const double *const places[3],
                            const float *const corners[3], double (*points)[3]) {
    const double *const a = places[0], *const b = places[1], *const c = places[2];
    const double area = cross(a, b, c), slack = 1e-9;
    if (area < slack) return; // what has no extent, another triangle draws
    const double i_end = -least(-a[0], -b[0], -c[0]), j_end = -least(-a[1], -b[1], -c[1]);
    for (double i = ceil(least(a[0], b[0], c[0]) - slack); i <= i_end + slack; i++) {
        for (double j = ceil(least(a[1], b[1], c[1]) - slack); j <= j_end + slack; j++) {
            const place p = {i, j};
            const double u = cross(p, b, c) / area, v = cross(a, p, c) / area, w = 1 - u - v;
            if (u < -slack || v < -slack || w < -slack) continue;
            double *const point = points[mesh->row_at[(int)i][(int)j]];
            for (int axis = 0; axis < 3; axis++)
                point[axis] = u * (double)corners[0][axis] + v * (double)corners[1][axis] +
                              w * (double)corners[2][axis];
        }
    }
}

static void sample_patch(drawn_frame *frame, uint32_t patch) {
    const limn_domain *const domain = frame->of->mesh.domain;
    const limn_plan_patch *const item = &frame->plan.patches[patch];
    const limn_template *const own = &frame->of->templates[item->template_index];
    const float(*const rows)[3] = (const float(*)[3])frame->vertices + item->first_vertex;
    double(*const points)[3] = frame->points + (size_t)patch * finest_count(&frame->of->mesh);
    place places[DRAWN_ROW_MAX] = {{0}};
    place_rows(domain, item, places);
    for (uint32_t i = own->first_index; i < own->first_index + own->index_count; i += 3) {
        const uint16_t *const c = frame->of->indices + i;
        sample_triangle(frame->of,
                        (const double *const[]){places[c[0]], places[c[1]], places[c[2]]},
                        (const float *const[]){rows[c[0]], rows[c[1]], rows[c[2]]}, points);
    }
}

void drawn_frame_make(drawn_frame *frame, const limn_view *view, const limn_lod_desc *desc) {
    const limn_mesh *const mesh = &frame->of->mesh;
    frame->view = *view;
    frame->view.plane_count = 0;
    frame->plan = limn_plan_build(mesh, mesh->controls, &frame->view, 1, desc, NULL, frame->memory);
    drawn_frame_draw(frame);
}

void drawn_frame_draw(drawn_frame *frame) {
    const limn_mesh *const mesh = &frame->of->mesh;
    limn_evaluate(&frame->plan, mesh->controls, 0, frame->plan.patch_count,
                  &(limn_output){.vertices = frame->vertices});
    for (uint32_t patch = 0; patch < frame->plan.patch_count; patch++)
        sample_patch(frame, patch);
}

// -------------------------------------------------------------------------------------------------
// Motion

static double distance(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

/// Pixels that a unit of length takes at the nearest point of a patch.
static double scale_patch(const drawn_frame *frame, uint32_t patch) {
    const limn_view *const view = &frame->view;
    const double eye[3] = {(double)view->eye[0], (double)view->eye[1], (double)view->eye[2]};
    const uint32_t count = finest_count(&frame->of->mesh);
    double nearest = INFINITY;
    for (size_t r = 0; r < count && !view->orthographic; r++)
        nearest = fmin(nearest, distance(eye, frame->points[(size_t)patch * count + r]));
    return (double)view->pixels / (view->orthographic ? 1 : fmax(nearest, (double)view->nearest));
}

/// The largest movement of a patch's points.
static double move_patch(const drawn_frame *before, const drawn_frame *after, uint32_t patch) {
    const uint32_t count = finest_count(&after->of->mesh);
    const size_t first = (size_t)patch * count;
    double largest = 0;
    for (size_t r = first; r < first + count; r++)
        largest = fmax(largest, distance(before->points[r], after->points[r]));
    return largest;
}

/// The level of an edge: level n with weight f is n - 1 + f.
static double edge_level(const limn_plan_patch *item, uint32_t edge) {
    const uint8_t whole = item->edge_levels[edge];
    return whole ? whole - 1 + (double)item->edge_morphs[edge] : 0;
}

/// How far a row is from the middle of two others, as they are drawn.
static double find_reach(const drawn_frame *frame, uint32_t patch, uint32_t row, uint32_t a,
                         uint32_t b) {
    const float *const own =
        frame->of->finest[(size_t)patch * finest_count(&frame->of->mesh) + row];
    const float(*const rows)[3] =
        (const float(*)[3])frame->vertices + frame->plan.patches[patch].first_vertex;
    double from[3], to[3];
    for (int axis = 0; axis < 3; axis++) {
        from[axis] = ((double)rows[a][axis] + (double)rows[b][axis]) / 2;
        to[axis] = (double)own[axis];
    }
    return distance(from, to);
}

/// How far the rows of an edge come within its level; those that it skips, with the row that they
/// are drawn with, and what lies between.
static void reach_edge(const drawn_frame *frame, uint32_t patch, uint32_t edge, double *reach) {
    const limn_domain *const domain = frame->of->mesh.domain;
    const uint16_t *const along = domain->edge_rows[edge];
    const uint32_t level = frame->plan.patches[patch].edge_levels[edge];
    const uint32_t step = LIMN_GRID_SIZE >> level;
    for (uint32_t t = step; t < LIMN_GRID_SIZE && level > 0; t += 2 * step) {
        const uint16_t *const sources = domain->rows[along[t]].sources;
        reach[along[t]] = find_reach(frame, patch, along[t], sources[0], sources[1]);
    }
    for (uint32_t t = 1; t < LIMN_GRID_SIZE; t++) {
        const uint32_t kept = kept_row(domain, edge, level, t);
        if (kept == along[t]) continue;
        reach[along[t]] = reach[kept] + find_reach(frame, patch, along[t], kept, kept);
    }
}

/// How far any row of a patch comes within a whole level: by itself, and with its parents.
static double reach_patch(const drawn_frame *frame, uint32_t patch) {
    const limn_domain *const domain = frame->of->mesh.domain;
    const uint32_t level = frame->plan.patches[patch].level;
    double reach[DRAWN_ROW_MAX] = {0}, largest = 0;
    for (uint32_t e = 0; e < domain->corner_count; e++)
        reach_edge(frame, patch, e, reach);
    for (uint32_t r = 0; r < domain->row_counts[level]; r++) {
        const limn_row *const row = &domain->rows[r];
        const uint32_t a = row->parents[0], b = row->parents[1];
        if (!row->edges && row->level == level)
            reach[r] = find_reach(frame, patch, r, a, b) + (reach[a] + reach[b]) / 2;
        largest = fmax(largest, reach[r]);
    }
    return largest;
}

/// The largest step of the levels of a patch's edges.
static double find_step(const limn_plan_patch *before, const limn_plan_patch *after,
                        uint32_t edge_count) {
    double step = 0;
    for (uint32_t e = 0; e < edge_count; e++)
        step = fmax(step, fabs(edge_level(after, e) - edge_level(before, e)));
    return step;
}

/// Half the length of the longest edge that comes to level 0 or from there beside a finer one.
static double find_seam(const drawn_frame *before, const drawn_frame *after, uint32_t patch) {
    const uint32_t edge_count = after->of->mesh.domain->corner_count;
    const limn_plan_patch *const old = &before->plan.patches[patch];
    const limn_plan_patch *const new = &after->plan.patches[patch];
    double longest = 0;
    for (uint32_t e = 0; e < edge_count && old->level > 0 && new->level > 0; e++) {
        if ((old->edge_levels[e] == 0) == (new->edge_levels[e] == 0)) continue;
        longest =
            fmax(longest, find_reach(after, patch, e, (e + 1) % edge_count, (e + 1) % edge_count));
    }
    return longest / 2;
}

drawn_motion drawn_move(const drawn_frame *before, const drawn_frame *after) {
    const uint32_t edge_count = after->of->mesh.domain->corner_count;
    drawn_motion motion = {0};
    for (uint32_t patch = 0; patch < after->plan.patch_count; patch++) {
        const double scale = scale_patch(after, patch);
        const double pixels = scale * move_patch(before, after, patch);
        const double step =
            find_step(&before->plan.patches[patch], &after->plan.patches[patch], edge_count);
        const double bound =
            scale * step * fmax(reach_patch(before, patch), reach_patch(after, patch));
        const double seam = scale * find_seam(before, after, patch);
        if (seam > 0) {
            motion.seam_pixels = fmax(motion.seam_pixels, pixels);
            motion.seam_share = fmax(motion.seam_share, pixels / (seam + bound));
            continue;
        }
        motion.pixels = fmax(motion.pixels, pixels);
        motion.bound = fmax(motion.bound, bound);
        if (pixels > DRAWN_ROUNDING) motion.share = fmax(motion.share, pixels / bound);
    }
    return motion;
}
