/* SPDX-License-Identifier: MIT */
/*
 * Levels by projected error keep their word: over many meshes and random cameras, what is drawn is
 * as near to the limit surface as was asked for, and not much nearer than that. The limit is
 * sampled twice as densely as the finest level has rows, through the once subdivided control mesh,
 * and each sample compared with the nearest triangle drawn of its patch and of the neighbours.
 * Meshes where something is sharp for some levels only are left out: the control mesh is subdivided
 * here, and only with what is sharp for ever.
 */
#include "../baker/mesh.h"
#include "../runtime/edge_error.h"
#include "check.h"
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

// ---- A mesh and what is drawn of it

typedef struct subject {
    limni_context context;
    limni_mesh base; ///< with its tags
    limn_baker *baker, *fine_baker;
    limn_mesh mesh, fine;
    uint32_t *patch_of_face;            ///< LIMNI_NONE: a hole
    float (*limits)[CHILDREN][ROWS][3]; ///< [face]
    void *memory;
    float (*vertices)[3];
    limn_plan plan;
    uint32_t *item_of_patch;
    float diagonal;
} subject;

/// The half-edge that stands for its edge.
static uint32_t edge_of(const limni_mesh *base, uint32_t h) {
    return base->pairs[h] < h ? base->pairs[h] : h;
}

/// The patch beyond half-edge h, or LIMNI_NONE.
static uint32_t patch_beyond(const subject *s, uint32_t h) {
    const uint32_t pair = s->base.pairs[h];
    return pair == LIMNI_NONE ? LIMNI_NONE : s->patch_of_face[pair / 3];
}

static void find_patches(subject *s) {
    const size_t size = s->base.face_count * sizeof *s->patch_of_face;
    s->patch_of_face = malloc(size);
    memset(s->patch_of_face, 0xff, size);
    for (uint32_t p = 0; p < s->mesh.patch_count; p++)
        s->patch_of_face[limn_mesh_face(&s->mesh, p).face] = p;
}

// ---- The same surface from a finer control mesh

static bool is_sharp_edge(const limni_mesh *base, uint32_t h) {
    return base->pairs[h] == LIMNI_NONE || base->edge_sharpness[h] >= LIMNI_SHARP_FOR_EVER;
}

static bool is_sharp_vertex(const limni_mesh *base, uint32_t control) {
    return base->vertex_sharpness[control] >= LIMNI_SHARP_FOR_EVER;
}

/// Whether anything is sharp for some levels only, which the rules below do not know.
static bool has_semi_sharpness(const limni_mesh *base) {
    bool any = false;
    for (uint32_t h = 0; h < base->half_edge_count; h++)
        any |= base->edge_sharpness[h] > 0 && !is_sharp_edge(base, h);
    for (uint32_t c = 0; c < base->control_count; c++)
        any |= base->vertex_sharpness[c] > 0 && !is_sharp_vertex(base, c);
    return any;
}

static void add(float *sum, float weight, const float *point) {
    for (int axis = 0; axis < 3; axis++)
        sum[axis] += weight * point[axis];
}

/// The edges at a control point.
typedef struct edges_around {
    uint32_t count, sharp_count;
} edges_around;

/// What a control point takes of the one at the other end of an edge.
static float weight_across(edges_around around, bool sharp_vertex, bool sharp_edge) {
    if (sharp_vertex || around.sharp_count > 2) return 0;
    if (around.sharp_count == 2) return sharp_edge ? 0.125f : 0;
    const float cosine = 3 + 2 * cosf(6.2831853f / (float)around.count);
    return (40 - cosine * cosine) / 64 / (float)around.count;
}

/// Adds what the end of half-edge h has of its start.
static void pull(const limni_mesh *base, uint32_t h, const edges_around *around,
                 float (*points)[3]) {
    const uint32_t start = limni_half_edge_start(base, h), end = limni_half_edge_end(base, h);
    for (int k = 0; k < 2; k++) {
        const uint32_t here = k ? start : end, there = k ? end : start;
        const float weight =
            weight_across(around[here], is_sharp_vertex(base, here), is_sharp_edge(base, h));
        add(points[here], weight, base->controls[there]);
        add(points[here], -weight, base->controls[here]);
    }
}

/// Loop's masks for the vertices: their neighbours, or on a crease those along it.
static void move_vertices(const limni_mesh *base, float (*points)[3]) {
    edges_around *const around = calloc(base->control_count, sizeof *around);
    for (uint32_t h = 0; h < base->half_edge_count; h++) {
        const uint32_t ends[2] = {limni_half_edge_start(base, h), limni_half_edge_end(base, h)};
        for (int k = 0; k < 2 && edge_of(base, h) == h; k++) {
            around[ends[k]].count++;
            around[ends[k]].sharp_count += is_sharp_edge(base, h);
        }
    }
    memcpy(points, base->controls, base->control_count * sizeof *points);
    for (uint32_t h = 0; h < base->half_edge_count; h++) {
        if (edge_of(base, h) == h) pull(base, h, around, points);
    }
    free(around);
}

static void place_middle(const limni_mesh *base, uint32_t h, float *point) {
    const bool sharp = is_sharp_edge(base, h);
    const uint32_t sides[2] = {h, base->pairs[h]};
    add(point, sharp ? 0.5f : 0.375f, base->controls[limni_half_edge_start(base, h)]);
    add(point, sharp ? 0.5f : 0.375f, base->controls[limni_half_edge_end(base, h)]);
    for (int k = 0; k < 2 && !sharp; k++) {
        const uint32_t opposite = limni_half_edge_previous(base, sides[k]);
        add(point, 0.125f, base->controls[limni_half_edge_start(base, opposite)]);
    }
}

/// The children of a face: at its corners, and in its middle.
static void split_face(const limni_mesh *base, uint32_t face, uint32_t children[CHILDREN][3]) {
    uint32_t middles[3];
    for (uint32_t c = 0; c < 3; c++)
        middles[c] = base->control_count + edge_of(base, 3 * face + c);
    for (uint32_t c = 0; c < 3; c++) {
        children[c][c] = base->corners[3 * face + c];
        children[c][(c + 1) % 3] = middles[c];
        children[c][(c + 2) % 3] = middles[(c + 2) % 3];
        children[3][c] = middles[(c + 1) % 3];
    }
}

/// A mesh of one more level, with room for the most that there may be of each.
typedef struct finer {
    float (*points)[3];
    uint32_t (*faces)[CHILDREN][3];
    uint32_t (*creases)[2], *corners, *holes;
    float *sharpness; ///< of all of them
    uint32_t crease_count, corner_count, hole_count;
} finer;

static finer subdivide(const limni_mesh *base) {
    const size_t edge_room = base->half_edge_count;
    finer made = {.points = calloc(base->control_count + edge_room, sizeof *made.points),
                  .faces = malloc(base->face_count * sizeof *made.faces),
                  .creases = malloc(2 * edge_room * sizeof *made.creases),
                  .corners = malloc(base->control_count * sizeof *made.corners),
                  .holes = malloc(CHILDREN * base->face_count * sizeof *made.holes),
                  .sharpness = malloc((base->control_count + 2 * edge_room) * sizeof(float))};
    move_vertices(base, made.points);
    for (uint32_t h = 0; h < edge_room; h++) {
        const uint32_t middle = base->control_count + h;
        if (edge_of(base, h) != h) continue;
        place_middle(base, h, made.points[middle]);
        for (int k = 0; k < 2 && is_sharp_edge(base, h); k++) {
            made.creases[made.crease_count][0] =
                k ? limni_half_edge_end(base, h) : limni_half_edge_start(base, h);
            made.creases[made.crease_count++][1] = middle;
        }
    }
    for (uint32_t c = 0; c < base->control_count; c++) {
        if (is_sharp_vertex(base, c)) made.corners[made.corner_count++] = c;
    }
    for (uint32_t f = 0; f < base->face_count; f++) {
        split_face(base, f, made.faces[f]);
        for (uint32_t k = 0; k < CHILDREN && base->holes[f]; k++)
            made.holes[made.hole_count++] = CHILDREN * f + k;
    }
    for (size_t k = 0; k < base->control_count + 2 * edge_room; k++)
        made.sharpness[k] = INFINITY;
    return made;
}

static limn_bake_status bake_fine(subject *s) {
    const finer made = subdivide(&s->base);
    s->fine_baker = limn_baker_create(NULL);
    const limn_bake_mesh mesh = {.positions = made.points[0],
                                 .position_count = s->base.control_count + s->base.half_edge_count,
                                 .face_count = CHILDREN * s->base.face_count,
                                 .face_indices = made.faces[0][0],
                                 .crease_edges = made.creases[0],
                                 .crease_sharpness = made.sharpness,
                                 .crease_count = made.crease_count,
                                 .sharp_vertices = made.corners,
                                 .vertex_sharpness = made.sharpness,
                                 .sharp_vertex_count = made.corner_count,
                                 .holes = made.holes,
                                 .hole_count = made.hole_count};
    const limn_bake_status status = limn_baker_add_mesh(s->fine_baker, &mesh);
    free(made.points);
    free(made.faces);
    free(made.creases);
    free(made.corners);
    free(made.holes);
    free(made.sharpness);
    return status;
}

static void sample_limit(subject *s) {
    const limn_plan plan = limn_plan_uniform(&s->fine, LIMN_LEVEL_MAX);
    float(*const points)[ROWS][3] = malloc((size_t)plan.patch_count * sizeof *points);
    s->limits = malloc((size_t)s->base.face_count * sizeof *s->limits);
    limn_evaluate(&plan, s->fine.controls, 0, plan.patch_count, &(limn_output){.vertices = points});
    for (uint32_t p = 0; p < plan.patch_count; p++) {
        const uint32_t face = limn_mesh_face(&s->fine, p).face;
        memcpy(s->limits[face / CHILDREN][face % CHILDREN], points[p], sizeof points[p]);
    }
    free(points);
}

// ---- Subjects

static bool open_baked(limn_baker *baker, limn_mesh *mesh) {
    const void *blob;
    size_t size;
    limn_pack pack;
    if (limn_baker_finish(baker, &blob, &size) != LIMN_BAKE_OK) return false;
    CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK);
    *mesh = limn_pack_mesh(&pack, 0);
    return true;
}

static bool load(subject *s, const char *path) {
    const limn_bake_desc desc = {.repair = LIMN_REPAIR_ALL,
                                 .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                                 .boundary = LIMN_BOUNDARY_EDGE_ONLY};
    *s = (subject){.context = {.desc = desc}, .baker = limn_baker_create(&desc)};
    limni_source source = {0};
    if (limni_read_file(&s->context, path, &source) != LIMN_BAKE_OK ||
        limni_mesh_build(&s->context, &source, &s->base) != LIMN_BAKE_OK)
        return false;
    if (s->base.face_count > FACES_MAX || has_semi_sharpness(&s->base)) return false;
    if (limn_baker_add_file(s->baker, path) != LIMN_BAKE_OK) return false;
    if (!open_baked(s->baker, &s->mesh)) return false;
    find_patches(s);
    // Around vertices of valence 2 two edges may have the same ends, and their halves then cannot
    // be told apart.
    if (bake_fine(s) != LIMN_BAKE_OK) return false;
    if (!open_baked(s->fine_baker, &s->fine)) return false;
    sample_limit(s);
    s->memory = malloc(limn_plan_size(&s->mesh));
    s->vertices = malloc((size_t)s->mesh.patch_count * ROWS * sizeof *s->vertices);
    s->item_of_patch = malloc(s->mesh.patch_count * sizeof *s->item_of_patch);
    for (int axis = 0; axis < 3; axis++)
        s->diagonal = hypotf(s->diagonal, s->mesh.bounds_max[axis] - s->mesh.bounds_min[axis]);
    return s->diagonal > 0;
}

static void unload(subject *s) {
    free(s->patch_of_face);
    free(s->limits);
    free(s->memory);
    free(s->vertices);
    free(s->item_of_patch);
    limn_baker_destroy(s->baker);
    limn_baker_destroy(s->fine_baker);
    limni_release_all(&s->context);
}

static float distance(const float *a, const float *b) {
    return hypotf(hypotf(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/// Both samplings of the limit surface agree where they meet: in the corners of the children.
static void check_limits(subject *s) {
    const limn_plan plan = limn_plan_uniform(&s->mesh, 1);
    const uint32_t count = domain->row_counts[1];
    limn_evaluate(&plan, s->mesh.controls, 0, plan.patch_count,
                  &(limn_output){.vertices = s->vertices});
    float largest = 0;
    for (uint32_t v = 0; v < plan.vertex_count; v++) {
        const uint32_t face = limn_mesh_face(&s->mesh, v / count).face;
        float nearest = INFINITY; // whatever the rotations are
        for (uint32_t k = 0; k < CHILDREN * 3; k++)
            nearest = fminf(nearest, distance(s->vertices[v], s->limits[face][k / 3][k % 3]));
        largest = fmaxf(largest, nearest);
    }
    CHECK(largest < 2e-6f * s->diagonal);
}

/// The number of the edge of half-edge h, as its own patch has it.
static uint16_t error_at(const subject *s, uint32_t h) {
    const uint32_t patch = s->patch_of_face[h / 3];
    const uint32_t rotation = limn_mesh_face(&s->mesh, patch).rotation;
    return s->mesh.errors[3 * patch + (h % 3 + 3 - rotation) % 3];
}

/// Both patches at an edge have the same number.
static void check_sides(const subject *s) {
    bool same = true;
    for (uint32_t h = 0; h < s->base.half_edge_count; h++) {
        if (s->patch_of_face[h / 3] == LIMNI_NONE || patch_beyond(s, h) == LIMNI_NONE) continue;
        same = same && error_at(s, h) == error_at(s, s->base.pairs[h]);
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
        if (CHECK(open_baked(baker, &mesh))) {
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
            const uint32_t other = patch_beyond(s, 3 * face + c);
            if (other != LIMNI_NONE) look_at_patch(s, other, point, enough, &nearest);
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
