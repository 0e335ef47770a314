/* SPDX-License-Identifier: MIT */
/*
 * Levels by projected error keep their word: over many meshes and random cameras, what is drawn is
 * as near to the limit surface as was asked for, and not much nearer than that. The limit is
 * sampled twice as densely as the finest level has rows, through the once subdivided control mesh,
 * and each sample compared with the nearest triangle drawn of its patch and of the neighbours.
 */
#include "../runtime/edge_error.h"
#include "check.h"
#include "limn/bake.h"
#include "mesh_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FACES_MAX = 3000, CAMERAS = 2, PATCHES = 10, CHILDREN = 4, ROWS = 153, LOWER_STEPS = 8 };

static const float tolerances[] = {0.5f, 1, 4}; ///< pixels
static const float lower_step = 0.25f;

static const limn_domain *domain;
static uint16_t indices[100000];
static limn_template templates[225];

static uint64_t random_state = 1;

static float random_float(float low, float high) {
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (float)(random_state >> 33) / 2147483648.0f;
}

// ---- Edges

/// An edge of the base mesh.
typedef struct edge {
    uint32_t ends[2]; ///< ascending; equal: a free place of the table
    uint32_t faces[2], count;
    uint32_t opposite[2];
} edge;

typedef struct subject {
    limn_baker *baker, *fine_baker;
    limn_mesh mesh, fine;
    uint32_t (*faces)[3];
    uint32_t *patch_of_face;
    edge *edges; ///< a hash table
    uint32_t edge_room;
    float (*limits)[CHILDREN][ROWS][3]; ///< [face]
    void *memory;
    float (*vertices)[3];
    limn_plan plan;
    uint32_t *item_of_patch;
    float diagonal;
} subject;

static edge *find_edge(const subject *s, uint32_t a, uint32_t b) {
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    uint32_t at = (low * 2654435761u ^ high * 2246822519u) % s->edge_room;
    while (s->edges[at].count && (s->edges[at].ends[0] != low || s->edges[at].ends[1] != high))
        at = (at + 1) % s->edge_room;
    s->edges[at].ends[0] = low;
    s->edges[at].ends[1] = high;
    return &s->edges[at];
}

/// Returns whether no edge has more than two faces.
static bool find_edges(subject *s) {
    bool manifold = true;
    s->edge_room = 6 * s->mesh.patch_count;
    s->edges = calloc(s->edge_room, sizeof *s->edges);
    for (uint32_t f = 0; f < s->mesh.patch_count; f++) {
        for (uint32_t c = 0; c < 3; c++) {
            edge *const e = find_edge(s, s->faces[f][c], s->faces[f][(c + 1) % 3]);
            manifold = manifold && e->count < 2;
            if (!manifold) return false;
            e->faces[e->count] = f;
            e->opposite[e->count++] = s->faces[f][(c + 2) % 3];
        }
    }
    return manifold;
}

static void find_faces(subject *s) {
    s->faces = malloc(s->mesh.patch_count * sizeof *s->faces);
    s->patch_of_face = malloc(s->mesh.patch_count * sizeof *s->patch_of_face);
    for (uint32_t p = 0; p < s->mesh.patch_count; p++) {
        const limn_patch_face face = limn_mesh_face(&s->mesh, p);
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(&s->mesh, p, corners);
        s->patch_of_face[face.face] = p;
        for (uint32_t c = 0; c < 3; c++)
            s->faces[face.face][(c + face.rotation) % 3] = corners[c];
    }
}

// ---- The same surface from a finer control mesh

static void add(float *sum, float weight, const float *point) {
    for (int axis = 0; axis < 3; axis++)
        sum[axis] += weight * point[axis];
}

/// Loop's masks for the vertices: their neighbours, or on a boundary those along it.
static void move_vertices(const subject *s, float (*points)[3]) {
    const float(*const controls)[3] = (const float(*)[3])s->mesh.controls;
    uint32_t *const counts = calloc(s->mesh.control_count, sizeof *counts);
    uint32_t *const open = calloc(s->mesh.control_count, sizeof *open);
    for (uint32_t e = 0; e < s->edge_room; e++) {
        for (int end = 0; end < 2 && s->edges[e].count; end++) {
            counts[s->edges[e].ends[end]]++;
            open[s->edges[e].ends[end]] += s->edges[e].count == 1;
        }
    }
    for (uint32_t c = 0; c < s->mesh.control_count; c++) {
        const float cosine = 3 + 2 * cosf(6.2831853f / (float)counts[c]);
        const float around = (40 - cosine * cosine) / 64;
        memset(points[c], 0, sizeof points[c]);
        add(points[c], counts[c] == 0 ? 1 : open[c] ? 0.75f : 1 - around, controls[c]);
    }
    for (uint32_t e = 0; e < s->edge_room; e++) {
        for (int end = 0; end < 2 && s->edges[e].count; end++) {
            const uint32_t c = s->edges[e].ends[end], other = s->edges[e].ends[1 - end];
            const float cosine = 3 + 2 * cosf(6.2831853f / (float)counts[c]);
            const float weight = (40 - cosine * cosine) / 64 / (float)counts[c];
            if (!open[c]) add(points[c], weight, controls[other]);
            if (open[c] && s->edges[e].count == 1) add(points[c], 0.125f, controls[other]);
        }
    }
    free(counts);
    free(open);
}

static void place_middle(const subject *s, const edge *e, float *point) {
    const float(*const controls)[3] = (const float(*)[3])s->mesh.controls;
    const float near = e->count == 1 ? 0.5f : 0.375f;
    memset(point, 0, sizeof(float[3]));
    for (int k = 0; k < 2; k++) {
        add(point, near, controls[e->ends[k]]);
        if (e->count == 2) add(point, 0.125f, controls[e->opposite[k]]);
    }
}

/// The children of a face: at its corners, and in its middle.
static void split_face(const subject *s, uint32_t face, uint32_t children[CHILDREN][3]) {
    const uint32_t *const v = s->faces[face];
    uint32_t middles[3];
    for (uint32_t c = 0; c < 3; c++)
        middles[c] =
            s->mesh.control_count + (uint32_t)(find_edge(s, v[c], v[(c + 1) % 3]) - s->edges);
    for (uint32_t c = 0; c < 3; c++) {
        children[c][c] = v[c];
        children[c][(c + 1) % 3] = middles[c];
        children[c][(c + 2) % 3] = middles[(c + 2) % 3];
        children[3][c] = middles[(c + 1) % 3];
    }
}

static limn_bake_status bake_fine(subject *s) {
    const uint32_t count = s->mesh.control_count + s->edge_room;
    float(*const points)[3] = calloc(count, sizeof *points);
    uint32_t(*const faces)[CHILDREN][3] = malloc(s->mesh.patch_count * sizeof *faces);
    move_vertices(s, points);
    for (uint32_t e = 0; e < s->edge_room; e++) {
        if (s->edges[e].count) place_middle(s, &s->edges[e], points[s->mesh.control_count + e]);
    }
    for (uint32_t f = 0; f < s->mesh.patch_count; f++)
        split_face(s, f, faces[f]);
    s->fine_baker = limn_baker_create(NULL);
    const limn_bake_status status =
        limn_baker_add_mesh(s->fine_baker, &(limn_bake_mesh){.positions = points[0],
                                                             .position_count = count,
                                                             .face_count = 4 * s->mesh.patch_count,
                                                             .face_indices = faces[0][0]});
    free(points);
    free(faces);
    return status;
}

static void sample_limit(subject *s) {
    const limn_plan plan = limn_plan_uniform(&s->fine, LIMN_LEVEL_MAX);
    float(*const points)[ROWS][3] = malloc((size_t)plan.patch_count * sizeof *points);
    s->limits = malloc((size_t)s->mesh.patch_count * sizeof *s->limits);
    limn_evaluate(&plan, s->fine.controls, 0, plan.patch_count, &(limn_output){.vertices = points});
    for (uint32_t p = 0; p < plan.patch_count; p++) {
        const uint32_t face = limn_mesh_face(&s->fine, p).face;
        memcpy(s->limits[face / 4][face % 4], points[p], sizeof points[p]);
    }
    free(points);
}

// ---- Subjects

/// tagged  out: whether creases or corners shape the surface; or NULL
static bool open_baked(limn_baker *baker, limn_mesh *mesh, bool *tagged) {
    const void *blob;
    size_t size;
    limn_pack pack;
    if (limn_baker_finish(baker, &blob, &size) != LIMN_BAKE_OK) return false;
    CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK);
    *mesh = limn_pack_mesh(&pack, 0);
    if (tagged) *tagged = strstr(pack.info, "creases=") != NULL;
    return true;
}

static bool load(subject *s, const char *path) {
    const limn_bake_desc desc = {.repair = LIMN_REPAIR_ALL, .boundary = LIMN_BOUNDARY_EDGE_ONLY};
    *s = (subject){.baker = limn_baker_create(&desc)};
    if (limn_baker_add_file(s->baker, path) != LIMN_BAKE_OK) return false;
    bool tagged;
    if (!open_baked(s->baker, &s->mesh, &tagged) || s->mesh.patch_count > FACES_MAX) return false;
    // The mesh is subdivided once more here, by the smooth rules, from what the file holds.
    if (tagged || s->mesh.patch_count < s->mesh.face_count) return false;
    find_faces(s);
    // A vertex of valence 2 gives two edges with the same ends.
    if (!find_edges(s) || bake_fine(s) != LIMN_BAKE_OK) return false;
    if (!open_baked(s->fine_baker, &s->fine, NULL)) return false;
    sample_limit(s);
    s->memory = malloc(limn_plan_size(&s->mesh));
    s->vertices = malloc((size_t)s->mesh.patch_count * ROWS * sizeof *s->vertices);
    s->item_of_patch = malloc(s->mesh.patch_count * sizeof *s->item_of_patch);
    for (int axis = 0; axis < 3; axis++)
        s->diagonal = hypotf(s->diagonal, s->mesh.bounds_max[axis] - s->mesh.bounds_min[axis]);
    return s->diagonal > 0;
}

static void unload(subject *s) {
    free(s->faces);
    free(s->patch_of_face);
    free(s->edges);
    free(s->limits);
    free(s->memory);
    free(s->vertices);
    free(s->item_of_patch);
    limn_baker_destroy(s->baker);
    limn_baker_destroy(s->fine_baker);
}

/// Both samplings of the limit surface agree where they meet: in the corners.
static void check_limits(subject *s) {
    const limn_plan plan = limn_plan_uniform(&s->mesh, 0);
    limn_evaluate(&plan, s->mesh.controls, 0, plan.patch_count,
                  &(limn_output){.vertices = s->vertices});
    float largest = 0;
    for (uint32_t p = 0; p < plan.patch_count; p++) {
        const limn_patch_face face = limn_mesh_face(&s->mesh, p);
        for (uint32_t c = 0; c < 3; c++) {
            const uint32_t corner = (c + face.rotation) % 3;
            const float *const seen = s->vertices[3 * p + c];
            float nearest = INFINITY; // one of the child's corners, whatever its rotation
            for (uint32_t row = 0; row < 3; row++) {
                const float *const limit = s->limits[face.face][corner][row];
                nearest = fminf(nearest, hypotf(hypotf(seen[0] - limit[0], seen[1] - limit[1]),
                                                seen[2] - limit[2]));
            }
            largest = fmaxf(largest, nearest);
        }
    }
    CHECK(largest < 2e-6f * s->diagonal);
}

/// Both patches at an edge have the same number.
static void check_sides(const subject *s) {
    bool same = true;
    for (uint32_t e = 0; e < s->edge_room; e++) {
        uint16_t errors[2];
        for (uint32_t k = 0; k < s->edges[e].count; k++) {
            const uint32_t patch = s->patch_of_face[s->edges[e].faces[k]];
            const uint32_t rotation = limn_mesh_face(&s->mesh, patch).rotation;
            const uint32_t *const corners = s->faces[s->edges[e].faces[k]];
            for (uint32_t c = 0; c < 3; c++) {
                if (find_edge(s, corners[c], corners[(c + 1) % 3]) == &s->edges[e])
                    errors[k] = s->mesh.errors[3 * patch + (c + 3 - rotation) % 3];
            }
        }
        same = same && (s->edges[e].count < 2 || errors[0] == errors[1]);
    }
    CHECK(same);
}

// ---- What the numbers say

static float packed_level(uint32_t packed, float length, float tolerance) {
    const limni_error_curve curve = limni_error_unpack(packed);
    return limni_error_level(&curve, length, tolerance);
}

/// The error that was asked for, by its formula, where levels can give it; and never a jump. What
/// needs more than the highest level needs one more for a quarter of the tolerance.
static void check_number(uint16_t packed) {
    double errors[LIMN_LEVEL_COUNT];
    for (uint32_t n = 0; n <= LIMN_LEVEL_MAX; n++)
        errors[n] = (double)limni_error_at(packed, n);
    const float beyond = packed_level(packed, 1, (float)(errors[LIMN_LEVEL_MAX] / 16));
    CHECK_NEAR((double)beyond, LIMN_LEVEL_MAX + 2, 0.01);
    float last = packed_level(packed, 1, (float)errors[0] / 1100);
    for (double part = 1.0 / 1024; part <= 2; part *= 1.0625) {
        const double tolerance = errors[0] * part;
        const float level = packed_level(packed, 1, (float)tolerance);
        CHECK(level >= 0 && level <= last && last - level < 0.35f);
        last = level;
        if (level == 0 || level >= LIMN_LEVEL_MAX) continue;
        const double above = ceil((double)level), weight = (double)level - (above - 1);
        const uint32_t n = (uint32_t)above;
        const double fallen = (2 * weight + weight * weight) / 3;
        CHECK_NEAR((1 - fallen) * errors[n - 1] + fallen * errors[n], tolerance, 1e-5 * errors[0]);
    }
    CHECK(last == 0);
}

static void test_numbers(void) {
    for (uint32_t code = 1; code <= LIMNI_ERROR_FIRST_MAX; code += 9) {
        for (uint32_t factors = 0; factors < 1u << 9; factors += 5)
            check_number((uint16_t)(factors << LIMNI_ERROR_FIRST_BITS | code));
    }
    CHECK(limni_error_first(1) == 1.25f / (1 << 20) && limni_error_first(127) == 1.75f * 2048);
    const uint32_t largest = LIMNI_ERROR_FIRST_MAX;
    CHECK(packed_level(0, 1, 1e-30f) == 0); // flat
    CHECK(packed_level(0, INFINITY, 1) == 0);
    CHECK(packed_level(0, 0, 1) == 0);
    CHECK(packed_level(largest, 0, 1e-30f) == 0); // without length
    CHECK(packed_level(largest, INFINITY, 1) > 2 * LIMN_LEVEL_MAX);
    CHECK(packed_level(largest, NAN, 1) == 0);
}

/// Two faces across an edge without length, and flat ones: every number is one that levels follow
/// from.
static void test_degenerate(void) {
    static const float positions[] = {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0.5f};
    static const uint32_t faces[] = {0, 1, 2, 0, 2, 3};
    for (int flat = 0; flat < 2; flat++) {
        limn_baker *const baker = limn_baker_create(NULL);
        limn_mesh mesh;
        const limn_bake_mesh given = {.positions = flat ? (const float[12]){0} : positions,
                                      .position_count = 4,
                                      .face_count = flat ? 1 : 2,
                                      .face_indices = faces};
        CHECK_EQUAL(limn_baker_add_mesh(baker, &given), LIMN_BAKE_OK);
        if (CHECK(open_baked(baker, &mesh, NULL))) {
            const limn_patch_face face = limn_mesh_face(&mesh, 0);
            const uint32_t without_length = (1 + 3 - face.rotation) % 3;
            CHECK_EQUAL(mesh.errors[without_length] & LIMNI_ERROR_FIRST_MAX,
                        flat ? 0 : LIMNI_ERROR_FIRST_MAX);
        }
        limn_baker_destroy(baker);
    }
}

// ---- Distances

typedef double vector[3];

static double dot(const vector a, const vector b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(const float *a, const float *b, vector difference) {
    for (int axis = 0; axis < 3; axis++)
        difference[axis] = (double)a[axis] - (double)b[axis];
}

static double square_to_side(const float *point, const float *a, const float *b) {
    vector side, offset;
    subtract(b, a, side);
    subtract(point, a, offset);
    const double whole = dot(side, side);
    const double part = whole > 0 ? fmin(fmax(dot(offset, side) / whole, 0), 1) : 0;
    for (int axis = 0; axis < 3; axis++)
        offset[axis] -= part * side[axis];
    return dot(offset, offset);
}

static double square_to_triangle(const float *point, const float *a, const float *b,
                                 const float *c) {
    vector u, v, offset;
    subtract(b, a, u);
    subtract(c, a, v);
    subtract(point, a, offset);
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), area = uu * vv - uv * uv;
    const double ou = dot(offset, u), ov = dot(offset, v);
    const double s = (vv * ou - uv * ov) / area, t = (uu * ov - uv * ou) / area;
    if (area > 0 && s >= 0 && t >= 0 && s + t <= 1) {
        for (int axis = 0; axis < 3; axis++)
            offset[axis] -= s * u[axis] + t * v[axis];
        return dot(offset, offset);
    }
    return fmin(square_to_side(point, a, b),
                fmin(square_to_side(point, b, c), square_to_side(point, c, a)));
}

/// Lowers *nearest by what one patch of the plan draws, until it is small enough.
static void look_at_patch(const subject *s, uint32_t patch, const float *point, double enough,
                          double *nearest) {
    static uint32_t last; // neighbouring points have the same nearest triangle, as a rule
    if (s->item_of_patch[patch] == UINT32_MAX) return;
    const limn_plan_patch *const item = &s->plan.patches[s->item_of_patch[patch]];
    const limn_template *const template = &templates[item->template_index];
    const uint16_t *const triangles = indices + template->first_index;
    const uint32_t count = template->index_count / 3;
    const float(*const vertices)[3] = (const float(*)[3])s->vertices + item->first_vertex;
    for (uint32_t k = 0; k<count && * nearest> enough; k++) {
        const uint32_t t = (last + k) % count;
        const double square =
            square_to_triangle(point, vertices[triangles[3 * t]], vertices[triangles[3 * t + 1]],
                               vertices[triangles[3 * t + 2]]);
        if (square < *nearest) *nearest = square;
        if (square <= enough) last = t;
    }
}

static bool is_inside(const limn_view *view, const float *point) {
    for (uint32_t k = 0; k < view->plane_count; k++) {
        const float *const plane = view->planes[k];
        if (plane[0] * point[0] + plane[1] * point[1] + plane[2] * point[2] + plane[3] < 0)
            return false;
    }
    return true;
}

/// Pixels for each unit of length at a point, as levels understand it: seen straight on.
static double pixels_at(const limn_view *view, const float *point) {
    vector offset;
    subtract(point, view->eye, offset);
    return view->orthographic
               ? (double)view->pixels
               : (double)view->pixels / fmax(sqrt(dot(offset, offset)), (double)view->nearest);
}

/// The largest distance in pixels from the limit surface of a patch, where it is in view, to what
/// is drawn of it and of its neighbours; or `least`, if it is smaller.
static double measure_patch(const subject *s, const limn_view *view, uint32_t patch, double least) {
    const uint32_t face = limn_mesh_face(&s->mesh, patch).face;
    double worst = least;
    for (uint32_t k = 0; k < CHILDREN * ROWS; k++) {
        const float *const point = s->limits[face][k / ROWS][k % ROWS];
        if (!is_inside(view, point)) continue;
        const double pixels = pixels_at(view, point);
        const double enough = worst * worst / (pixels * pixels);
        double nearest = INFINITY;
        look_at_patch(s, patch, point, enough, &nearest);
        for (uint32_t c = 0; c < 3 && nearest > enough; c++) {
            const edge *const e = find_edge(s, s->faces[face][c], s->faces[face][(c + 1) % 3]);
            const uint32_t other = e->faces[e->count == 2 && e->faces[0] == face];
            look_at_patch(s, s->patch_of_face[other], point, enough, &nearest);
        }
        worst = fmax(worst, sqrt(nearest) * pixels);
    }
    return worst;
}

// ---- Frames

/// Of all patches that were measured.
typedef struct tally {
    unsigned long measured, kept;
    unsigned long limited; ///< not measured: an edge is at the finest level
    double worst;          ///< in tolerances
    double level, needed;  ///< sums of the levels of patches that are not at 0, for one tolerance,
                           ///< and of the levels that would have done
    unsigned long raised;  ///< how many these are
} tally;

static limn_view random_view(const subject *s, bool orthographic) {
    float eye[3], target[3];
    const float up[3] = {0.1f, 1, 0.2f}, distance = s->diagonal * random_float(0.2f, 4);
    for (int axis = 0; axis < 3; axis++) {
        const float low = s->mesh.bounds_min[axis], high = s->mesh.bounds_max[axis];
        target[axis] = random_float(low, high);
        eye[axis] = (low + high) / 2 + random_float(-1, 1) * distance;
    }
    if (orthographic)
        return limn_view_orthographic(eye, target, up, s->diagonal * random_float(0.2f, 2), 1280,
                                      720, -s->diagonal, 9 * s->diagonal);
    return limn_view_perspective(eye, target, up, random_float(0.5f, 1.5f), 1280, 720,
                                 s->diagonal / 1000, 9 * s->diagonal);
}

static void draw(subject *s, const limn_view *view, const limn_lod_desc *desc) {
    s->plan = limn_plan_build(&s->mesh, s->mesh.controls, view, 1, desc, templates, s->memory);
    memset(s->item_of_patch, 0xff, s->mesh.patch_count * sizeof *s->item_of_patch);
    for (uint32_t i = 0; i < s->plan.patch_count; i++)
        s->item_of_patch[s->plan.patches[i].patch] = i;
    limn_evaluate(&s->plan, s->mesh.controls, 0, s->plan.patch_count,
                  &(limn_output){.vertices = s->vertices});
}

static float level_of(const limn_plan_patch *item) {
    return item->level ? (float)(item->level - 1) + item->morph : 0;
}

static bool is_limited(const limn_plan_patch *item) {
    for (uint32_t e = 0; e < 3; e++) {
        if (item->edge_levels[e] == LIMN_LEVEL_MAX && item->edge_morphs[e] == 1) return true;
    }
    return false;
}

/// The patches that are looked at.
typedef struct chosen {
    uint32_t patches[PATCHES], count;
    float levels[PATCHES];
    bool failed[PATCHES];
} chosen;

static void choose(const subject *s, chosen *some, tally *sum) {
    const uint32_t step = s->plan.patch_count / PATCHES + 1;
    some->count = 0;
    for (uint32_t i = 0; i < s->plan.patch_count; i += step) {
        const limn_plan_patch *const item = &s->plan.patches[i];
        sum->limited += is_limited(item);
        if (is_limited(item)) continue;
        some->levels[some->count] = level_of(item);
        some->failed[some->count] = false;
        some->patches[some->count++] = item->patch;
    }
}

/// Lowers all levels until patches fail, to see how much less would have done.
static void lower(subject *s, const limn_view *view, limn_lod_desc desc, chosen *some, tally *sum) {
    for (int step = 1; step <= LOWER_STEPS; step++) {
        desc.bias = -(float)step * lower_step;
        draw(s, view, &desc);
        for (uint32_t k = 0; k < some->count; k++) {
            if (some->failed[k] || some->levels[k] == 0) continue;
            const double pixels = (double)desc.pixels;
            some->failed[k] =
                measure_patch(s, view, some->patches[k], pixels) > pixels || step == LOWER_STEPS;
            if (!some->failed[k]) continue;
            sum->raised++;
            sum->level += (double)some->levels[k];
            sum->needed += fmax((double)(some->levels[k] - (float)(step - 1) * lower_step), 0);
        }
    }
}

static void test_frame(subject *s, int camera, float pixels, tally *sum) {
    const limn_view view = random_view(s, camera == 0);
    const limn_lod_desc desc = {.lod = LIMN_LOD_ERROR, .pixels = pixels};
    chosen some;
    draw(s, &view, &desc);
    choose(s, &some, sum);
    for (uint32_t k = 0; k < some.count; k++) {
        const double error = measure_patch(s, &view, some.patches[k], 0.25 * (double)pixels);
        sum->measured++;
        sum->kept += error <= (double)pixels;
        sum->worst = fmax(sum->worst, error / (double)pixels);
        some.failed[k] = error > (double)pixels;
    }
    if (pixels == 1) lower(s, &view, desc, &some, sum);
}

// ---- All meshes

static tally total;

static void print_tally(const char *name, const tally *t) {
    const double raised = t->raised ? (double)t->raised : 1;
    printf("%-32s %6lu of %6lu kept, the worst %4.2f tolerances off; %5lu at level 4; level %.2f, "
           "needed %.2f\n",
           name, t->kept, t->measured, t->worst, t->limited, t->level / raised, t->needed / raised);
}

static void visit(const char *path) {
    subject s;
    tally sum = {0};
    if (load(&s, path)) {
        check_limits(&s);
        check_sides(&s);
        for (int frame = 0; frame < 3 * CAMERAS; frame++)
            test_frame(&s, frame / 3, tolerances[frame % 3], &sum);
        print_tally(s.mesh.name, &sum);
        total.measured += sum.measured;
        total.kept += sum.kept;
        total.limited += sum.limited;
        total.worst = fmax(total.worst, sum.worst);
        total.level += sum.level;
        total.needed += sum.needed;
        total.raised += sum.raised;
    }
    unload(&s);
}

int main(void) {
    domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    limn_templates_write(domain, LIMN_TOPOLOGY_TRIANGLES, 2, indices, templates);
    test_numbers();
    test_degenerate();
    CHECK(mesh_files_visit(visit) > 0);
    print_tally("all", &total);
    CHECK(total.measured > 100 && (double)total.kept >= 0.99 * (double)total.measured);
    CHECK(total.level - total.needed < 0.5 * (double)total.raised);
    return check_report();
}
