/* SPDX-License-Identifier: MIT */
/* From polygons to a manifold: what is refused and where, what is mended and how, and triangles. */
#include "../baker/mesh.h"
#include "limn/format.h"
#include "limn/limn.h"

#include "../baker/patches.h"
#include "../baker/refine.h"
#include "check.h"
#include "coefficients.h"

#include <math.h>
#include <stdlib.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

// ---- Surfaces

/// Every face of an open fan is a class of its own: time grows with the cube of this.
enum { OPEN_FAN_SIZE = 256 };

typedef struct surface {
    const char *name;
    const float *positions;
    uint32_t position_count;
    const uint32_t *sizes; ///< NULL: triangles
    const uint32_t *corners;
    uint32_t face_count;
} surface;

/// Points that serve wherever the shape does not matter.
static const float points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, -1};

#define TRIANGLES(position_count, ...)                                                             \
    {                                                                                              \
        "t", points, position_count, NULL, (const uint32_t[]){__VA_ARGS__},                        \
            COUNT(((const uint32_t[]){__VA_ARGS__})) / 3                                           \
    }

/// The rim of a bipyramid is 0 … n - 1, its apexes are n and n + 1. Their valence is n.
static surface make_bipyramid(uint32_t n) {
    float *const positions = calloc((size_t)n + 2, 3 * sizeof *positions);
    uint32_t *const corners = malloc(6 * (size_t)n * sizeof *corners);
    if (!positions || !corners) abort();
    for (uint32_t k = 0; k < n; k++) {
        const double angle = 6.283185307179586 * k / n;
        const uint32_t next = (k + 1) % n, faces[6] = {k, next, n, next, k, n + 1};
        positions[3 * k] = (float)cos(angle);
        positions[3 * k + 1] = (float)sin(angle);
        memcpy(corners + 6 * k, faces, sizeof faces);
    }
    positions[3 * n + 2] = 1;
    positions[3 * n + 5] = -1;
    return (surface){"bipyramid", positions, n + 2, NULL, corners, 2 * n};
}

/// n triangles around vertex 0, from a half turn to the boundary: its valence is n + 1.
static surface make_open_fan(uint32_t n) {
    float *const positions = calloc((size_t)n + 2, 3 * sizeof *positions);
    uint32_t *const corners = malloc(3 * (size_t)n * sizeof *corners);
    if (!positions || !corners) abort();
    for (uint32_t k = 0; k <= n; k++) {
        positions[3 * k + 3] = (float)cos(3.141592653589793 * k / n);
        positions[3 * k + 4] = (float)sin(3.141592653589793 * k / n);
    }
    for (uint32_t k = 0; k < n; k++)
        memcpy(corners + 3 * k, (const uint32_t[]){0, k + 1, k + 2}, 3 * sizeof *corners);
    return (surface){"fan", positions, n + 2, NULL, corners, n};
}

static void free_surface(const surface *made) {
    free((void *)(uintptr_t)made->positions);
    free((void *)(uintptr_t)made->corners);
}

// ---- Baking

typedef struct notes {
    uint32_t count;
    char text[2048]; ///< all of them, one per line
} notes;

static void take_note(void *user, const char *text) {
    notes *const taken = user;
    const size_t used = strlen(taken->text);
    snprintf(taken->text + used, sizeof taken->text - used, "%s\n", text);
    taken->count++;
}

typedef struct baked {
    limn_baker *baker;
    limn_bake_status status;
    limn_pack pack; ///< of `status` LIMN_BAKE_OK
    notes notes;
} baked;

/// What may be done to a mesh: LIMN_REPAIR_… and this bit.
enum { SPLIT = 1 << 16 };

static limn_bake_desc desc_for(uint32_t allowed) {
    return (limn_bake_desc){.repair = allowed & LIMN_REPAIR_ALL,
                            .non_manifold = allowed & SPLIT ? LIMN_NON_MANIFOLD_SPLIT
                                                            : LIMN_NON_MANIFOLD_REFUSE};
}

static void bake(baked *result, const surface *const *surfaces, size_t count, uint32_t allowed) {
    limn_bake_desc desc = desc_for(allowed);
    *result = (baked){0};
    desc.note = take_note;
    desc.user = &result->notes;
    result->baker = limn_baker_create(&desc);
    if (!result->baker) abort();
    for (size_t s = 0; s < count && result->status == LIMN_BAKE_OK; s++)
        result->status = limn_baker_add_mesh(
            result->baker, &(limn_bake_mesh){.name = surfaces[s]->name,
                                             .positions = surfaces[s]->positions,
                                             .position_count = surfaces[s]->position_count,
                                             .face_sizes = surfaces[s]->sizes,
                                             .face_count = surfaces[s]->face_count,
                                             .face_indices = surfaces[s]->corners});
    if (result->status != LIMN_BAKE_OK) return;
    const void *blob = NULL;
    size_t size = 0;
    result->status = limn_baker_finish(result->baker, &blob, &size);
    if (result->status == LIMN_BAKE_OK)
        CHECK_EQUAL(limn_pack_open(&result->pack, blob, size), LIMN_OK);
}

/// Every row of every table sums to 1 and has no negative coefficient.
static void check_tables(const limn_mesh *mesh) {
    const limn_domain *const domain = mesh->domain;
    double furthest = 0, smallest = 0;
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        const limn_file_class *const class = &mesh->classes[mesh->runs[r].class_index];
        for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++) {
            const column_place place = place_of_row(mesh, r, 0, row);
            double sum = 0;
            for (uint32_t slot = 0; slot < class->control_count; slot++) {
                const double coefficient = coefficient_at(&place, slot);
                sum += coefficient;
                smallest = fmin(smallest, coefficient);
            }
            furthest = fmax(furthest, fabs(sum - 1));
        }
    }
    CHECK(furthest < 2e-7);
    CHECK(smallest >= -0x1p-26); // below 0 only where it is what two floats leave
}

/// With all control points in one place, so are all vertices, at every level.
static void check_evaluation(const limn_mesh *mesh) {
    static const float place[3] = {1, -2, 0.5f};
    float *const controls = malloc(mesh->control_count * sizeof place);
    if (!controls) abort();
    for (uint32_t c = 0; c < mesh->control_count; c++)
        memcpy(controls + 3 * c, place, sizeof place);
    for (uint32_t level = 0; level <= LIMN_LEVEL_MAX; level++) {
        const limn_plan plan = limn_plan_uniform(mesh, level);
        float(*const vertices)[3] = malloc((size_t)plan.vertex_count * sizeof *vertices);
        if (!vertices) abort();
        limn_evaluate(&plan, controls, 0, plan.patch_count, &(limn_output){.vertices = vertices});
        float furthest = 0;
        for (uint64_t v = 0; v < plan.vertex_count; v++) {
            for (int axis = 0; axis < 3; axis++)
                furthest = fmaxf(furthest, fabsf(vertices[v][axis] - place[axis]));
        }
        CHECK(furthest < 3e-6f);
        free(vertices);
    }
    free(controls);
}

/// Bakes one surface without mistakes; the caller looks at the result and then ends it.
static limn_mesh check_accepted(baked *result, const surface *given, uint32_t allowed) {
    bake(result, &given, 1, allowed);
    if (!CHECK_EQUAL(result->status, LIMN_BAKE_OK)) {
        fprintf(stderr, "    %s\n", limn_baker_error(result->baker));
        return (limn_mesh){0};
    }
    CHECK_TEXT(limn_baker_error(result->baker), "");
    const limn_mesh mesh = limn_pack_mesh(&result->pack, 0);
    check_tables(&mesh);
    check_evaluation(&mesh);
    return mesh;
}

static void check_refused(const surface *given, uint32_t allowed, const char *part) {
    baked result;
    bake(&result, &given, 1, allowed);
    CHECK_EQUAL(result.status, LIMN_BAKE_BAD_INPUT);
    CHECK_CONTAINS(limn_baker_error(result.baker), part);
    limn_baker_destroy(result.baker);
}

/// Patches with a corner on a boundary.
static uint32_t count_boundary_patches(const limn_mesh *mesh) {
    uint32_t count = 0;
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        if (mesh->classes[mesh->runs[r].class_index].boundary_corners)
            count += mesh->runs[r].patch_count;
    }
    return count;
}

// ---- What is refused

static void test_refused(void) {
    const struct {
        surface given;
        const char *text;
    } cases[] = {
        {TRIANGLES(5, 0, 1, 2, 1, 0, 3, 0, 1, 4),
         "t: non-manifold edge from vertex 0 to vertex 1: 3 faces share it, among them face 0 and "
         "face 2"},
        {TRIANGLES(6, 0, 1, 2, 1, 0, 3, 0, 1, 4, 1, 0, 5), ": 4 faces share it"},
        {TRIANGLES(5, 0, 1, 2, 0, 3, 4), "t: non-manifold vertex 0: face 0 and face 1 meet"},
        {TRIANGLES(6, 1, 2, 3, 1, 3, 0, 1, 4, 5),
         "t: non-manifold vertex 1: face 0 and face 2 meet"},
        {TRIANGLES(4, 0, 1, 2, 0, 1, 3),
         "t: inconsistent winding: face 0 and face 1 both run from vertex 0 to vertex 1"},
        {TRIANGLES(4, 0, 2, 1, 0, 1, 3, 1, 3, 2, 2, 0, 3), "inconsistent winding: face 1 and face 2"
                                                           " both run from vertex 1 to vertex 3"},
        {TRIANGLES(4, 0, 1, 2, 1, 0, 1), "t: face 1: degenerate face: it uses a vertex twice"},
        {TRIANGLES(4, 0, 0, 2), "t: face 0: degenerate face"},
        {TRIANGLES(4, 2, 2, 2), "t: face 0: degenerate face"},
        {TRIANGLES(4, 0, 1, 2, 1, 0, 3, 1, 2, 0), "t: face 2: repeated face"},
        {TRIANGLES(3, 0, 1, 3), "t: face 0 refers to vertex 3, but there are 3"},
        {TRIANGLES(3, 0, 1, 2, 2, 1, UINT32_MAX), "t: face 1 refers to vertex 4294967295"},
        {{"t", points, 3, NULL, (const uint32_t[]){0, 1, 2}, 0}, "t: the mesh is empty"},
        {{"t", points, 0, NULL, (const uint32_t[]){0, 1, 2}, 1}, "t: the mesh is empty"},
        {{"t", points, 3, (const uint32_t[]){3, 2}, (const uint32_t[]){0, 1, 2, 0, 1}, 2},
         "t: face 1 has 2 corners"},
        {{NULL, points, 3, NULL, (const uint32_t[]){0, 1, 1}, 1}, "mesh: face 0: degenerate face"},
    };
    for (size_t c = 0; c < COUNT(cases); c++)
        check_refused(&cases[c].given, 0, cases[c].text);
}

static void test_not_finite(void) {
    static const float values[] = {NAN, INFINITY, -INFINITY};
    static const uint32_t corners[] = {0, 1, 2};
    for (size_t v = 0; v < COUNT(values); v++) {
        for (uint32_t at = 0; at < 9; at++) {
            float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
            char text[64];
            positions[at] = values[v];
            snprintf(text, sizeof text, "t: vertex %u is not finite", at / 3);
            check_refused(&(surface){"t", positions, 3, NULL, corners, 1}, LIMN_REPAIR_ALL, text);
        }
    }
}

static void test_nothing_added(void) {
    const void *blob = NULL;
    size_t size = 0;
    limn_baker *const baker = limn_baker_create(NULL);
    CHECK_TEXT(limn_baker_error(baker), "");
    CHECK_EQUAL(limn_baker_finish(baker, &blob, &size), LIMN_BAKE_BAD_INPUT);
    CHECK_CONTAINS(limn_baker_error(baker), "no mesh");
    CHECK(blob == NULL && size == 0);
    limn_baker_destroy(baker);
    limn_baker_destroy(NULL);
}

// ---- What is accepted

/// Corners of valence 2: a lone triangle, and two back to back, which is closed.
static void test_valence_2(void) {
    const surface lone = TRIANGLES(3, 0, 1, 2), pillow = TRIANGLES(3, 0, 1, 2, 0, 2, 1);
    baked result;
    limn_mesh mesh = check_accepted(&result, &lone, 0);
    CHECK_EQUAL(count_boundary_patches(&mesh), 1);
    limn_baker_destroy(result.baker);

    mesh = check_accepted(&result, &pillow, 0);
    CHECK_EQUAL(mesh.patch_count, 2);
    CHECK_EQUAL(result.pack.class_count, 1);
    CHECK_EQUAL(count_boundary_patches(&mesh), 0);
    for (uint32_t c = 0; c < 3; c++)
        CHECK_EQUAL(mesh.classes[0].valences[c], 2);
    limn_baker_destroy(result.baker);
}

static void test_high_valence(void) {
    baked result;
    const surface closed = make_bipyramid(500);
    limn_mesh mesh = check_accepted(&result, &closed, 0);
    CHECK_EQUAL(mesh.patch_count, 1000);
    CHECK_EQUAL(result.pack.class_count, 1);
    CHECK(mesh.classes[0].control_count > LIMN_FORMAT_NARROW_SLOTS);
    CHECK_EQUAL(mesh.classes[0].valences[0], 500); // the odd one first
    limn_baker_destroy(result.baker);
    free_surface(&closed);

    const surface open = make_open_fan(OPEN_FAN_SIZE);
    mesh = check_accepted(&result, &open, 0);
    CHECK_EQUAL(mesh.patch_count, OPEN_FAN_SIZE);
    CHECK_EQUAL(count_boundary_patches(&mesh), OPEN_FAN_SIZE);
    limn_baker_destroy(result.baker);
    free_surface(&open);
}

static void test_too_high_valence(void) {
    const surface closed = make_bipyramid(5000), open = make_open_fan(5000);
    check_refused(&closed, 0, "bipyramid: vertex 5000 has valence 5000: the corners of face 0");
    check_refused(&open, 0, "fan: vertex 0 has valence 5001: the corners of face 0");
    free_surface(&closed);
    free_surface(&open);
}

static void test_unused(void) {
    const surface given = TRIANGLES(7, 1, 2, 3);
    baked result;
    const limn_mesh mesh = check_accepted(&result, &given, 0);
    CHECK_EQUAL(mesh.control_count, 7);
    CHECK_EQUAL(result.notes.count, 1);
    CHECK_CONTAINS(result.notes.text, "t: 4 control points are used by no face (the first is "
                                      "vertex 0)");
    limn_baker_destroy(result.baker);
}

static void test_shared_classes(void) {
    const surface tetrahedron = TRIANGLES(4, 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3);
    const surface twin = TRIANGLES(5, 4, 2, 3, 3, 2, 1, 1, 2, 4, 1, 4, 3);
    const surface pillow = TRIANGLES(3, 0, 1, 2, 0, 2, 1);
    baked one, both, three;
    bake(&one, (const surface *[]){&tetrahedron}, 1, 0);
    bake(&both, (const surface *[]){&tetrahedron, &twin}, 2, 0);
    bake(&three, (const surface *[]){&tetrahedron, &twin, &pillow}, 3, 0);
    CHECK_EQUAL(one.pack.class_count, 1);
    CHECK_EQUAL(both.pack.class_count, 1);
    CHECK_EQUAL(both.pack.mesh_count, 2);
    CHECK_EQUAL(three.pack.class_count, 2);
    limn_baker_destroy(one.baker);
    limn_baker_destroy(both.baker);
    limn_baker_destroy(three.baker);
}

// ---- What is mended

/// Counts after a repair, and what the notes must say.
static void check_repaired(const surface *given, uint32_t allowed, uint32_t control_count,
                           uint32_t patch_count, uint32_t boundary_patches, const char *note) {
    baked result;
    const limn_mesh mesh = check_accepted(&result, given, allowed);
    CHECK_EQUAL(mesh.control_count, control_count);
    CHECK_EQUAL(mesh.patch_count, patch_count);
    CHECK_EQUAL(count_boundary_patches(&mesh), boundary_patches);
    CHECK_CONTAINS(result.notes.text, note);
    limn_baker_destroy(result.baker);
}

static void test_weld(void) {
    // A tetrahedron whose faces have nothing in common, with both zeros.
    static const float loose_positions[] = {
        0, 0, 0, 0, 1, 0, 1,     0, 0, 0,     -0.0f, 0, 1, 0, -0.0f, 0, 0, 1,
        1, 0, 0, 0, 1, 0, -0.0f, 0, 1, -0.0f, 1,     0, 0, 0, 0,     0, 0, 1,
    };
    static const uint32_t corners[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    static const surface loose = {"loose", loose_positions, 12, NULL, corners, 4};
    check_repaired(&loose, 0, 12, 4, 4, "");
    check_repaired(&loose, LIMN_REPAIR_WELD, 4, 4, 0,
                   "loose: repaired: 8 control points welded into others");
    check_repaired(&loose, LIMN_REPAIR_DROP | SPLIT, 12, 4, 4, "");

    // Welding may leave a face with a corner twice.
    static const float flat_positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 1, 0};
    static const uint32_t flat_corners[] = {0, 1, 2, 1, 3, 2, 1, 4, 3};
    static const surface flat = {"flat", flat_positions, 5, NULL, flat_corners, 3};
    check_repaired(&flat, 0, 5, 3, 3, "");
    check_refused(&flat, LIMN_REPAIR_WELD, "flat: face 1: degenerate face");
    check_repaired(&flat, LIMN_REPAIR_WELD | LIMN_REPAIR_DROP, 4, 2, 2,
                   "flat: repaired: 1 degenerate and 0 repeated faces dropped");
}

static void test_drop(void) {
    const surface given =
        TRIANGLES(4, 0, 1, 1, 0, 1, 2, 2, 2, 2, 1, 2, 0, 2, 1, 3, 3, 2, 1, 1, 3, 2);
    check_refused(&given, LIMN_REPAIR_WELD | SPLIT, "t: face 0: degenerate face");
    check_repaired(&given, LIMN_REPAIR_DROP, 4, 2, 2,
                   "t: repaired: 2 degenerate and 3 repeated faces dropped");

    const surface hopeless = TRIANGLES(4, 0, 1, 1, 2, 2, 2);
    check_refused(&hopeless, LIMN_REPAIR_ALL, "t: the mesh has no faces");
}

/// A polygon that only repeats a corner is mended, not dropped, and that is said too.
static void test_repeated_corners(void) {
    static const uint32_t sizes[] = {4, 5, 4}, corners[] = {0, 0, 1, 2, 0, 2, 2, 3, 3, 3, 3, 4, 4};
    static const surface given = {"t", points, 5, sizes, corners, 3};
    check_refused(&given, 0, "t: face 0: degenerate face");
    check_repaired(&given, LIMN_REPAIR_DROP, 5, 2, 2, "t: repaired: ");

    static const uint32_t only_sizes[] = {4}, only_corners[] = {1, 2, 3, 1};
    static const surface only = {"t", points, 4, only_sizes, only_corners, 1};
    check_repaired(&only, LIMN_REPAIR_DROP, 4, 1, 1, "t: repaired: ");
}

static void test_split_open(void) {
    const surface bow_tie = TRIANGLES(5, 0, 1, 2, 0, 3, 4);
    check_repaired(&bow_tie, SPLIT, 6, 2, 2,
                   "t: split: 0 edges, sharp now, and 1 vertices, of which 1 are corners now; "
                   "1 control points added");

    const surface book = TRIANGLES(5, 0, 1, 2, 1, 0, 3, 0, 1, 4);
    check_repaired(&book, SPLIT, 9, 3, 3,
                   "t: split: 1 edges, sharp now, and 2 vertices, of which 2 are corners now; "
                   "4 control points added");

    const surface wound = TRIANGLES(4, 0, 1, 2, 0, 1, 3);
    check_repaired(&wound, SPLIT, 6, 2, 2, "2 control points added");

    // A Möbius strip of five triangles cannot be wound consistently.
    const surface strip = TRIANGLES(5, 0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 0, 4, 0, 1);
    check_refused(&strip, LIMN_REPAIR_WELD | LIMN_REPAIR_DROP, "t: inconsistent winding");
    check_repaired(&strip, SPLIT, 7, 5, 5, "2 control points added");
}

/// Cutting off what is too much leaves the rest closed.
static void test_split_closed(void) {
    // A bipyramid over a triangle with one face too many, in both directions and on both kinds of
    // edge, so that patches begin at either end of the edge that was cut.
    static const uint32_t flaps[][3] = {{1, 3, 5}, {3, 1, 5}, {0, 1, 5}, {1, 0, 5}, {5, 4, 2}};
    for (size_t f = 0; f < COUNT(flaps); f++) {
        uint32_t corners[] = {0, 1, 3, 1, 2, 3, 2, 0, 3, 1, 0, 4, 2, 1, 4, 0, 2, 4, 0, 0, 0};
        memcpy(corners + 18, flaps[f], sizeof flaps[f]);
        const surface given = {"flap", points, 6, NULL, corners, 7};
        check_refused(&given, 0, "flap: non-manifold edge from vertex ");
        check_repaired(&given, SPLIT, 8, 7, 1, "flap: split: 1 edges, sharp now, and 2 vertices");
    }
    // Two tetrahedra with a common edge; two with a common vertex.
    const surface edge =
        TRIANGLES(6, 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 5, 1, 0, 1, 4, 1, 5, 4, 5, 0, 4);
    check_refused(&edge, 0, ": 4 faces share it");
    check_repaired(&edge, SPLIT, 8, 8, 0, "2 control points added");
    const surface vertex =
        TRIANGLES(7, 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 5, 4, 0, 4, 6, 4, 5, 6, 5, 0, 6);
    check_refused(&vertex, 0, "t: non-manifold vertex 0: face 0 and face 4 meet");
    check_repaired(&vertex, SPLIT, 8, 8, 0, "1 control points added");
}

/// A control point made by splitting has no number and no line of its own in the file.
static void test_split_too_high_valence(void) {
    const surface fan = make_open_fan(3000);
    uint32_t *const corners = malloc(3 * 3001 * sizeof *corners);
    float *const positions = calloc(3004, 3 * sizeof *positions);
    if (!corners || !positions) abort();
    memcpy(positions, fan.positions, 3002 * 3 * sizeof *positions);
    memcpy(corners, (const uint32_t[]){0, 3002, 3003}, 3 * sizeof *corners);
    memcpy(corners + 3, fan.corners, 3 * 3000 * sizeof *corners);
    const surface both = {"both", positions, 3004, NULL, corners, 3001};
    check_refused(&both, SPLIT, " has valence 3001: the corners of face 1");
    free_surface(&both);
    free_surface(&fan);
}

/// What the repairs say they can do, they do: any faces at all become a surface that evaluates.
static void test_repair_anything(void) {
    uint64_t state = 7;
    for (uint32_t round = 0; round < 300; round++) {
        const uint32_t face_count = 1 + round % 24, point_count = 4 + round % 4;
        uint32_t corners[3 * 24];
        for (uint32_t c = 0; c < 3 * face_count; c++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            corners[c] = (uint32_t)(state >> 33) % point_count;
        }
        const surface given = {"any", points, point_count, NULL, corners, face_count},
                      *any = &given;
        baked result;
        bake(&result, &any, 1, LIMN_REPAIR_ALL | SPLIT);
        if (result.status == LIMN_BAKE_OK) {
            const limn_mesh mesh = limn_pack_mesh(&result.pack, 0);
            check_tables(&mesh);
            check_evaluation(&mesh);
        } else {
            CHECK_TEXT(limn_baker_error(result.baker), "any: the mesh has no faces");
        }
        limn_baker_destroy(result.baker);
    }
}

// ---- Triangulation

/// The source as a reader would give it.
static void build(limni_context *context, const surface *given, limni_mesh *mesh) {
    uint32_t corner_count = 0;
    limni_source source = {
        .name = given->name,
        .positions = limni_allocate(context, given->position_count, 3 * sizeof(float)),
        .position_count = given->position_count,
        .face_count = given->face_count,
        .face_offsets = limni_allocate(context, (size_t)given->face_count + 1, sizeof(uint32_t)),
    };
    for (uint32_t face = 0; face < given->face_count; face++) {
        source.face_offsets[face] = corner_count;
        corner_count += given->sizes ? given->sizes[face] : 3;
    }
    source.face_offsets[given->face_count] = corner_count;
    source.face_corners = limni_allocate(context, corner_count, sizeof(uint32_t));
    memcpy(source.face_corners, given->corners, corner_count * sizeof(uint32_t));
    memcpy(source.positions, given->positions, given->position_count * 3 * sizeof(float));
    *mesh = (limni_mesh){0};
    if (!CHECK_EQUAL(limni_mesh_build(context, &source, mesh), LIMN_BAKE_OK))
        fprintf(stderr, "    %s\n", context->error);
}

static bool has_edge(const limni_mesh *mesh, uint32_t a, uint32_t b) {
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        const uint32_t start = limni_half_edge_start(mesh, h), end = limni_half_edge_end(mesh, h);
        if ((start == a && end == b) || (start == b && end == a)) return true;
    }
    return false;
}

/// The one diagonal of a quad.
static void check_diagonal(const float *positions, const uint32_t corners[4], uint32_t a,
                           uint32_t b) {
    static const uint32_t sizes[] = {4};
    limni_context context = {0};
    limni_mesh mesh;
    build(&context, &(surface){"quad", positions, 4, sizes, corners, 1}, &mesh);
    CHECK_EQUAL(mesh.face_count, 2);
    if (!CHECK(has_edge(&mesh, a, b))) fprintf(stderr, "    no edge %u-%u\n", a, b);
    limni_release_all(&context);
}

static void test_quads(void) {
    static const float kite[] = {-1, 0, 0, 0, -3, 0, 1, 0, 0, 0, 3, 0};
    static const float square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const float crossed[] = {0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 1, 0};
    static const float last[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
    for (uint32_t shift = 0; shift < 4; shift++) {
        uint32_t forward[4], backward[4], other[4], third[4];
        for (uint32_t c = 0; c < 4; c++) {
            forward[c] = (c + shift) % 4;
            backward[c] = (3 + shift - c) % 4;
            other[c] = (const uint32_t[]){0, 2, 1, 3}[(c + shift) % 4];
            third[c] = (const uint32_t[]){0, 2, 3, 1}[(c + shift) % 4];
        }
        check_diagonal(kite, forward, 0, 2);
        check_diagonal(kite, backward, 0, 2);
        // Ties go to the diagonal with the smallest control point.
        check_diagonal(square, forward, 0, 2);
        check_diagonal(square, backward, 0, 2);
        check_diagonal(crossed, other, 0, 1);
        check_diagonal(last, third, 0, 3);
    }
}

/// Twice the area of a triangle in the plane of two axes.
static double area_of(const limni_mesh *mesh, uint32_t face, int u, int v) {
    const float *const a = mesh->controls[mesh->corners[3 * face + 0]];
    const float *const b = mesh->controls[mesh->corners[3 * face + 1]];
    const float *const c = mesh->controls[mesh->corners[3 * face + 2]];
    return ((double)b[u] - a[u]) * ((double)c[v] - a[v]) -
           ((double)b[v] - a[v]) * ((double)c[u] - a[u]);
}

/// A plane polygon, counter-clockwise: no triangle is turned over, and together they cover it.
/// Tried in all three planes and from every corner.
static void check_polygon(const float (*plane)[2], uint32_t size, double twice_area) {
    for (uint32_t variant = 0; variant < 3 * size; variant++) {
        const int u = (int)(variant % 3), v = (u + 1) % 3;
        float positions[16][3] = {0};
        uint32_t corners[16];
        for (uint32_t c = 0; c < size; c++) {
            positions[c][u] = plane[c][0];
            positions[c][v] = plane[c][1];
            corners[c] = (c + variant / 3) % size;
        }
        limni_context context = {0};
        limni_mesh mesh;
        build(&context, &(surface){"polygon", positions[0], size, &size, corners, 1}, &mesh);
        CHECK_EQUAL(mesh.face_count, size - 2);
        double sum = 0;
        for (uint32_t face = 0; face < mesh.face_count; face++) {
            CHECK(area_of(&mesh, face, u, v) > 0);
            CHECK_EQUAL(mesh.polygons[face], 0);
            sum += area_of(&mesh, face, u, v);
        }
        CHECK_NEAR(sum, twice_area, 1e-9);
        limni_release_all(&context);
    }
}

static void test_polygons(void) {
    static const float house[][2] = {{0, 0}, {2, 0}, {2, 2}, {1, 3}, {0, 2}};
    static const float corner[][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    static const float comb[][2] = {{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {3, 1},
                                    {3, 4}, {2, 4}, {2, 1}, {1, 1}, {1, 4}, {0, 4}};
    static const float star[][2] = {{4, 0},  {1, 1},   {0, 4},  {-1, 1},
                                    {-4, 0}, {-1, -1}, {0, -4}, {1, -1}};
    check_polygon(house, COUNT(house), 10);
    check_polygon(corner, COUNT(corner), 6);
    check_polygon(comb, COUNT(comb), 28);
    check_polygon(star, COUNT(star), 32);

    // The shortest diagonal comes first: the roof of the house.
    static const float roof[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 1, 3, 0, 0, 2, 0};
    static const uint32_t size = 5, corners[] = {0, 1, 2, 3, 4};
    limni_context context = {0};
    limni_mesh mesh;
    build(&context, &(surface){"house", roof, 5, &size, corners, 1}, &mesh);
    CHECK(has_edge(&mesh, 2, 4));
    CHECK(has_edge(&mesh, 0, 2));
    limni_release_all(&context);
}

/// Two quads that share two edges round vertex 0: the short diagonal 1-2 is in both, but can be
/// cut only once.
static void test_existing_edges(void) {
    static const float positions[] = {0, 0, 1, -1, 0, 0, 1, 0, 0, 0, 5, 0, 0, -5, 0};
    static const uint32_t sizes[] = {4, 4}, corners[] = {1, 0, 2, 3, 2, 0, 1, 4};
    const surface given = {"hinge", positions, 5, sizes, corners, 2};
    limni_context context = {0};
    limni_mesh mesh;
    build(&context, &given, &mesh);
    CHECK_EQUAL(mesh.face_count, 4);
    CHECK(has_edge(&mesh, 1, 2));
    CHECK(has_edge(&mesh, 0, 4));
    CHECK(!has_edge(&mesh, 0, 3));
    limni_release_all(&context);

    // The same with a triangle that has that edge already.
    static const uint32_t mixed_sizes[] = {4, 3}, mixed[] = {1, 0, 2, 3, 2, 0, 1};
    build(&context, &(surface){"mixed", positions, 5, mixed_sizes, mixed, 2}, &mesh);
    CHECK(has_edge(&mesh, 0, 3));
    limni_release_all(&context);

    baked result;
    const limn_mesh baked_mesh = check_accepted(&result, &given, 0);
    CHECK_EQUAL(baked_mesh.patch_count, 4);
    limn_baker_destroy(result.baker);
}

static void test_triangulation_notes(void) {
    static const float positions[] = {0, 0, 0, 1, 0,    0, 1, 1,  0, 0, 1,  0, 2, 0,
                                      0, 2, 1, 0, 0.5f, 2, 0, -1, 0, 0, -1, 1, 0};
    static const uint32_t sizes[] = {4, 3, 4, 4, 3};
    static const uint32_t corners[] = {0, 1, 2, 3, 3, 2, 6, 1, 4, 5, 2, 7, 0, 3, 8, 2, 5, 6};
    static const uint32_t joined_sizes[] = {4, 5, 6},
                          joined[] = {0, 1, 2, 3, 1, 4, 5, 6, 2, 7, 0, 3, 2, 6, 8};
    baked result;
    check_accepted(&result, &(surface){"quads", positions, 9, sizes, corners, 5}, 0);
    CHECK_EQUAL(result.notes.count, 1);
    CHECK_CONTAINS(result.notes.text, "quads: triangulated 3 quads and 0 larger polygons: 5 faces "
                                      "became 8");
    limn_baker_destroy(result.baker);

    check_accepted(&result, &(surface){"mixed", positions, 9, joined_sizes, joined, 3}, 0);
    CHECK_CONTAINS(result.notes.text, "mixed: triangulated 1 quads and 2 larger polygons: 3 faces "
                                      "became 9");
    limn_baker_destroy(result.baker);

    const surface triangle = TRIANGLES(3, 0, 1, 2);
    check_accepted(&result, &triangle, LIMN_REPAIR_ALL);
    CHECK_TEXT(result.notes.text, "");
    limn_baker_destroy(result.baker);
}

// ---- Tags

/// A cube of quads, its bottom missing. Vertex v lies at the bits of v.
static const float cube_positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,
                                       0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
static const uint32_t cube_sizes[] = {4, 4, 4, 4, 4};
static const uint32_t cube_corners[] = {4, 5, 7, 6, 0, 1, 5, 4, 1, 3, 7, 5, 3, 2, 6, 7, 2, 0, 4, 6};

/// The sharpness of all half-edges between two places; -1 if they differ, or if there are none.
static float sharpness_between(const limni_mesh *mesh, uint32_t a, uint32_t b) {
    float found = -1;
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        const float *const start = mesh->controls[limni_half_edge_start(mesh, h)];
        const float *const end = mesh->controls[limni_half_edge_end(mesh, h)];
        const float *const p = cube_positions + 3 * a, *const q = cube_positions + 3 * b;
        const bool along = memcmp(start, p, 12) == 0 && memcmp(end, q, 12) == 0;
        const bool against = memcmp(start, q, 12) == 0 && memcmp(end, p, 12) == 0;
        if (!along && !against) continue;
        if (found >= 0 && mesh->edge_sharpness[h] != found) return -1;
        found = mesh->edge_sharpness[h];
    }
    return found;
}

/// How many half-edges are not smooth.
static uint32_t count_sharp(const limni_mesh *mesh) {
    uint32_t count = 0;
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++)
        count += mesh->edge_sharpness[h] != 0;
    return count;
}

/// The cube with its tags, of which any may be changed, and built.
typedef struct tagged {
    limni_context context;
    limni_crease creases[4];
    limni_sharp_vertex vertices[3];
    limni_hole holes[3];
    limni_source source;
    limni_mesh mesh;
    char notes[512];
} tagged;

static void append_note(void *user, const char *text) {
    tagged *const t = user;
    const size_t used = strlen(t->notes);
    snprintf(t->notes + used, sizeof t->notes - used, "%s\n", text);
}

static void *copy(limni_context *context, const void *bytes, size_t size) {
    void *const copied = limni_allocate(context, size, 1);
    memcpy(copied, bytes, size);
    return copied;
}

/// Creases: an edge inside, one of the boundary, a diagonal; and one again, turned round.
static void begin_tagged(tagged *t, uint32_t allowed) {
    static const uint32_t offsets[] = {0, 4, 8, 12, 16, 20};
    *t = (tagged){.creases = {{5, 7, 1.5f, 11}, {0, 1, 3, 12}, {4, 7, 2, 13}, {7, 5, 2.5f, 14}},
                  .vertices = {{4, 1, 21}, {6, INFINITY, 22}, {4, 0.5f, 23}},
                  .holes = {{2, 31}, {2, 32}, {4, 33}}};
    t->context.desc = desc_for(allowed);
    t->context.desc.note = append_note;
    t->context.desc.user = t;
    t->source =
        (limni_source){.name = "cube",
                       .positions = copy(&t->context, cube_positions, sizeof cube_positions),
                       .position_count = 8,
                       .face_count = 5,
                       .face_offsets = copy(&t->context, offsets, sizeof offsets),
                       .face_corners = copy(&t->context, cube_corners, sizeof cube_corners),
                       .tags = {.creases = t->creases,
                                .sharp_vertices = t->vertices,
                                .holes = t->holes,
                                .crease_count = 4,
                                .sharp_vertex_count = 3,
                                .hole_count = 3,
                                .boundary = LIMN_BOUNDARY_EDGE_AND_CORNER,
                                .creasing = LIMN_CREASING_CHAIKIN}};
}

static bool build_tagged(tagged *t) {
    if (CHECK_EQUAL(limni_mesh_build(&t->context, &t->source, &t->mesh), LIMN_BAKE_OK)) return true;
    fprintf(stderr, "    %s\n", t->context.error);
    return false;
}

static void test_tags(void) {
    tagged t;
    begin_tagged(&t, 0);
    if (!build_tagged(&t)) return;
    const limni_mesh *const mesh = &t.mesh;
    CHECK(sharpness_between(mesh, 5, 7) == 2.5f);
    CHECK(sharpness_between(mesh, 0, 1) == 3);
    CHECK(has_edge(mesh, 4, 7) && sharpness_between(mesh, 4, 7) == 0);
    CHECK_EQUAL(count_sharp(mesh), 3);
    for (uint32_t c = 0; c < 8; c++)
        CHECK(mesh->vertex_sharpness[c] == (c == 4 ? 0.5f : c == 6 ? INFINITY : 0));
    CHECK_EQUAL(mesh->hole_count, 4);
    for (uint32_t face = 0; face < mesh->face_count; face++)
        CHECK_EQUAL(mesh->holes[face], mesh->polygons[face] == 2 || mesh->polygons[face] == 4);
    CHECK_EQUAL(mesh->boundary, LIMN_BOUNDARY_EDGE_AND_CORNER);
    CHECK_EQUAL(mesh->creasing, LIMN_CREASING_CHAIKIN);
    CHECK_CONTAINS(t.notes, "cube: ignored: 1 creases that name no edge of a face (the first is in "
                            "line 13)\n");
    limni_release_all(&t.context);
}

/// From memory, without lines.
static void test_ignored_tags(void) {
    tagged t;
    begin_tagged(&t, 0);
    t.creases[0] = (limni_crease){0, 3, 1, 0};
    t.creases[1] = (limni_crease){0, UINT32_MAX, 1, 0};
    t.creases[2] = (limni_crease){1, 1, 1, 0};
    t.vertices[1] = (limni_sharp_vertex){8, 1, 0};
    t.holes[1] = (limni_hole){5, 0};
    if (!build_tagged(&t)) return;
    CHECK_EQUAL(count_sharp(&t.mesh), 2);
    CHECK_EQUAL(t.mesh.hole_count, 4);
    CHECK_CONTAINS(t.notes,
                   "ignored: 3 creases that name no edge of a face (the first is number 0)");
    CHECK_CONTAINS(t.notes, "ignored: 1 corners that name no vertex (the first is number 1)");
    CHECK_CONTAINS(t.notes, "ignored: 1 holes that name no face (the first is number 1)");
    limni_release_all(&t.context);
}

/// A cube of loose quads: tags follow the control points that are welded, and the faces that move
/// up when one is dropped.
static void test_tags_follow_repairs(void) {
    tagged t;
    begin_tagged(&t, LIMN_REPAIR_ALL);
    limni_source *const source = &t.source;
    float loose[20][3];
    for (uint32_t c = 0; c < 20; c++) {
        memcpy(loose[c], cube_positions + 3 * cube_corners[c], sizeof loose[c]);
        source->face_corners[c] = c;
    }
    source->positions = copy(&t.context, loose, sizeof loose);
    source->position_count = 20;
    source->face_corners[6] = source->face_corners[5] =
        source->face_corners[4];                   // face 1 is dropped
    t.creases[0] = (limni_crease){1, 2, 1.5f, 1};  // 5-7 in face 0
    t.creases[1] = (limni_crease){17, 18, 3, 2};   // 0-4 in face 4
    t.creases[2] = (limni_crease){12, 13, 4, 3};   // 3-2 in face 3
    t.creases[3] = (limni_crease){13, 12, 0, 4};   // smooth again
    t.vertices[0] = (limni_sharp_vertex){3, 7, 5}; // 6
    t.source.tags.sharp_vertex_count = 1;
    if (!build_tagged(&t)) return;
    CHECK_EQUAL(t.mesh.control_count, 8);
    CHECK(sharpness_between(&t.mesh, 5, 7) == 1.5f);
    CHECK(sharpness_between(&t.mesh, 0, 4) == 3);
    CHECK(sharpness_between(&t.mesh, 3, 2) == 0);
    CHECK_EQUAL(count_sharp(&t.mesh), 3);
    for (uint32_t c = 0; c < 8; c++) {
        const bool is_6 = memcmp(t.mesh.controls[c], cube_positions + 3 * 6, 12) == 0;
        CHECK(t.mesh.vertex_sharpness[c] == (is_6 ? 7 : 0));
    }
    for (uint32_t face = 0; face < t.mesh.face_count; face++) {
        const uint32_t number = t.mesh.face_numbers[t.mesh.polygons[face]];
        CHECK_EQUAL(t.mesh.holes[face], number == 2 || number == 4);
    }
    limni_release_all(&t.context);
}

/// Where a mesh is split, all is sharp for ever; elsewhere tags stay.
static void test_tags_follow_splits(void) {
    tagged t;
    begin_tagged(&t, SPLIT);
    static const uint32_t fin[] = {5, 7, 2}; // a third face at edge 5-7
    uint32_t *const corners = limni_resize(&t.context, t.source.face_corners, 23, sizeof *corners);
    uint32_t *const offsets = limni_resize(&t.context, t.source.face_offsets, 7, sizeof *offsets);
    memcpy(corners + 20, fin, sizeof fin);
    offsets[6] = 23;
    t.source.face_corners = corners;
    t.source.face_offsets = offsets;
    t.source.face_count = 6;
    if (!build_tagged(&t)) return;
    CHECK_EQUAL(t.mesh.control_count, 11);
    for (uint32_t c = 0; c < t.mesh.control_count; c++) {
        const uint32_t origin = t.mesh.origins[c];
        CHECK(memcmp(t.mesh.controls[c], cube_positions + 3 * origin, 12) == 0);
        const bool split = origin == 2 || origin == 5 || origin == 7;
        CHECK_EQUAL(limni_is_split(&t.mesh, c), split);
        CHECK(t.mesh.vertex_sharpness[c] == (origin == 4            ? 0.5f
                                             : split || origin == 6 ? INFINITY
                                                                    : 0));
    }
    uint32_t sharp_for_ever = 0;
    for (uint32_t h = 0; h < 3 * t.mesh.face_count; h++)
        sharp_for_ever += t.mesh.edge_sharpness[h] == INFINITY;
    CHECK_EQUAL(sharp_for_ever, 3);       // 5-7 of both quads and the fin
    CHECK_EQUAL(count_sharp(&t.mesh), 4); // and 0-1
    CHECK_CONTAINS(t.notes, "cube: split: 1 edges, sharp now, and 3 vertices, of which 3 are");
    limni_release_all(&t.context);
}

static limn_bake_mesh tagged_mesh(void) {
    static const uint32_t crease[] = {5, 7}, vertex[] = {6}, holes[] = {1, 3};
    static const float sharpness[] = {2};
    return (limn_bake_mesh){.name = "cube",
                            .positions = cube_positions,
                            .position_count = 8,
                            .face_sizes = cube_sizes,
                            .face_count = 5,
                            .face_indices = cube_corners,
                            .crease_edges = crease,
                            .crease_sharpness = sharpness,
                            .crease_count = 1,
                            .sharp_vertices = vertex,
                            .vertex_sharpness = sharpness,
                            .sharp_vertex_count = 1,
                            .holes = holes,
                            .hole_count = 2};
}

static const char *bake_error(const limn_bake_mesh *mesh) {
    static char text[256];
    limn_baker *const baker = limn_baker_create(NULL);
    CHECK_EQUAL(limn_baker_add_mesh(baker, mesh), LIMN_BAKE_BAD_INPUT);
    snprintf(text, sizeof text, "%s", limn_baker_error(baker));
    limn_baker_destroy(baker);
    return text;
}

static void test_bad_tags(void) {
    static const float negative[] = {-1}, not_a_number[] = {NAN};
    static const uint32_t all[] = {0, 1, 2, 3, 4};
    limn_bake_mesh mesh = tagged_mesh();
    mesh.crease_sharpness = negative;
    CHECK_TEXT(bake_error(&mesh), "cube: the sharpness of crease 0 is negative or not a number");
    mesh = tagged_mesh();
    mesh.vertex_sharpness = not_a_number;
    CHECK_TEXT(bake_error(&mesh),
               "cube: the sharpness of sharp vertex 0 is negative or not a number");
    mesh = tagged_mesh();
    mesh.holes = all;
    mesh.hole_count = 5;
    CHECK_TEXT(bake_error(&mesh), "cube: every face is a hole");
}

/// Holes have no patches, and leave those of the other faces as they are.
static void test_holes(void) {
    const limn_bake_mesh given = tagged_mesh();
    limn_bake_mesh whole_mesh = given;
    whole_mesh.hole_count = 0;
    limn_pack packs[2];
    limn_mesh meshes[2];
    limn_baker *bakers[2];
    for (int k = 0; k < 2; k++) {
        const void *blob;
        size_t size;
        bakers[k] = limn_baker_create(NULL);
        CHECK_EQUAL(limn_baker_add_mesh(bakers[k], k ? &whole_mesh : &given), LIMN_BAKE_OK);
        CHECK_EQUAL(limn_baker_finish(bakers[k], &blob, &size), LIMN_BAKE_OK);
        CHECK_EQUAL(limn_pack_open(&packs[k], blob, size), LIMN_OK);
        meshes[k] = limn_pack_mesh(&packs[k], 0);
    }
    CHECK_EQUAL(meshes[0].patch_count, 6);
    CHECK_EQUAL(meshes[0].face_count, 10);
    CHECK_EQUAL(meshes[1].patch_count, 10);
    float(*const vertices[])[153][3] = {calloc(10, sizeof **vertices),
                                        calloc(10, sizeof **vertices)};
    for (int k = 0; k < 2; k++) {
        const limn_plan plan = limn_plan_uniform(&meshes[k], LIMN_LEVEL_MAX);
        limn_evaluate(&plan, meshes[k].controls, 0, plan.patch_count,
                      &(limn_output){.vertices = vertices[k]});
    }
    for (uint32_t p = 0; p < 6; p++) {
        const uint32_t face = limn_mesh_face(&meshes[0], p).face;
        CHECK(face / 2 != 1 && face / 2 != 3);
        uint32_t other = 0;
        while (limn_mesh_face(&meshes[1], other).face != face)
            other++;
        CHECK(memcmp(vertices[0][p], vertices[1][other], sizeof **vertices) == 0);
    }
    for (int k = 0; k < 2; k++) {
        limn_baker_destroy(bakers[k]);
        free(vertices[k]);
    }
}

/// What the mesh asks for, unless the options say otherwise.
static void test_boundary_of_mesh(void) {
    static const limn_boundary all[] = {LIMN_BOUNDARY_DEFAULT, LIMN_BOUNDARY_EDGE_ONLY,
                                        LIMN_BOUNDARY_EDGE_AND_CORNER};
    for (int option = 0; option < 3; option++) {
        for (int asked = 0; asked < 3; asked++) {
            const void *blob;
            size_t size;
            limn_pack pack;
            limn_bake_mesh mesh = tagged_mesh();
            mesh.boundary = all[asked];
            limn_baker *const baker = limn_baker_create(&(limn_bake_desc){.boundary = all[option]});
            CHECK_EQUAL(limn_baker_add_mesh(baker, &mesh), LIMN_BAKE_OK);
            CHECK_EQUAL(limn_baker_finish(baker, &blob, &size), LIMN_BAKE_OK);
            CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK);
            const bool corners = (option == 0 ? asked : option) == 2;
            CHECK_CONTAINS(pack.info, corners ? "boundary=edge-and-corner" : "boundary=edge-only");
            limn_baker_destroy(baker);
        }
    }
}

/// Options that a scheme does not have, or not with others: the baker is refused, whatever the mesh.
static void test_refused_options(void) {
    static const struct {
        limn_bake_desc desc;
        const char *text;
    } refused[] = {
        {{.scheme = LIMN_SCHEME_CATMARK, .weights = LIMN_WEIGHTS_WARREN}, "--weights"},
        {{.tension = 0.01f}, "--tension is that of"},
        {{.scheme = LIMN_SCHEME_BUTTERFLY, .tension = 0.26f}, "--tension is not between"},
        {{.scheme = LIMN_SCHEME_BUTTERFLY, .tension = NAN}, "--tension is not between"},
        {{.scheme = LIMN_SCHEME_NONE, .creases = LIMN_CREASES_LOMONT}, "--creases lomont"},
        {{.scheme = LIMN_SCHEME_BUTTERFLY, .creasing = LIMN_CREASING_UNIFORM}, "--creasing goes"},
        {{.creases = LIMN_CREASES_LOMONT, .creasing = LIMN_CREASING_CHAIKIN}, "--creasing chaikin"},
        {{.scheme = LIMN_SCHEME_NONE, .boundary = LIMN_BOUNDARY_EDGE_AND_CORNER}, "--boundary"},
    };
    const limn_bake_mesh mesh = tagged_mesh();
    for (size_t r = 0; r < sizeof refused / sizeof *refused; r++) {
        limn_baker *const baker = limn_baker_create(&refused[r].desc);
        CHECK_CONTAINS(limn_baker_error(baker), refused[r].text);
        CHECK_EQUAL(limn_baker_add_mesh(baker, &mesh), LIMN_BAKE_BAD_INPUT);
        CHECK_CONTAINS(limn_baker_error(baker), refused[r].text);
        limn_baker_destroy(baker);
    }
}

// ---- The baker's own check

/// Patches that do not agree on an edge must not be written. They always agree; so one is made not
/// to.
static void test_disagreement(void) {
    uint32_t faces[][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}};
    float corners[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    uint32_t offsets[] = {0, 3, 6, 9, 12};
    limni_context context = {0};
    limni_source source = {.name = "t",
                           .positions = corners,
                           .position_count = 4,
                           .face_count = 4,
                           .face_offsets = offsets,
                           .face_corners = faces[0]};
    const limni_rules rules = {0};
    limni_classes classes = {0}, pieces = {0};
    limni_patches patches;
    limni_mesh mesh;
    limni_base base;
    CHECK_EQUAL(limni_mesh_build(&context, &source, &mesh), LIMN_BAKE_OK);
    CHECK_EQUAL(limni_base_begin(&context, &mesh, &rules, &base), LIMN_BAKE_OK);
    CHECK_EQUAL(limni_patches_build(&context, &base, &rules, NULL, 0, &classes, &pieces, &patches),
                LIMN_BAKE_OK);
    classes.items[0].prints[1].along[0].positions ^= 1;
    CHECK_EQUAL(limni_patches_build(&context, &base, &rules, NULL, 0, &classes, &pieces, &patches),
                LIMN_BAKE_INTERNAL);
    CHECK_CONTAINS(context.error, "disagree on their common edge");
    limni_release_all(&context);
}

// ---- Limits

/// Of what is refused nothing but the counts is looked at.
static void check_limit(uint32_t position_count, uint32_t corner_count, uint32_t crease_count,
                        const char *expected) {
    const uint32_t offsets[] = {0, corner_count};
    limni_context context = {0};
    limni_source source = {.name = "large",
                           .position_count = position_count,
                           .face_count = 1,
                           .face_offsets = (uint32_t *)(uintptr_t)offsets,
                           .tags.crease_count = crease_count};
    limni_mesh mesh = {0};
    CHECK_EQUAL(limni_mesh_begin(&context, &source, &mesh), LIMN_BAKE_BAD_INPUT);
    CHECK_TEXT(context.error, expected);
    limni_release_all(&context);
}

static void test_limits(void) {
    const uint32_t more = LIMNI_CORNERS_MAX + 1;
    check_limit(more, 3, 0, "large: more than 268435456 vertices, or corners of faces");
    check_limit(3, more, 0, "large: more than 268435456 vertices, or corners of faces");
    check_limit(3, 3, more, "large: more than 268435456 creases");

    limni_context context = {0};
    limni_refined refined;
    const limni_mesh mesh = {.name = "large", .half_edge_count = more};
    CHECK_EQUAL(limni_refine(&context, &mesh, NULL, NULL, &refined), LIMN_BAKE_BAD_INPUT);
    CHECK_TEXT(context.error, "large: more than 268435456 corners of faces to subdivide");
    limni_release_all(&context);
}

int main(void) {
    test_limits();
    test_disagreement();
    test_refused();
    test_not_finite();
    test_nothing_added();
    test_valence_2();
    test_high_valence();
    test_too_high_valence();
    test_unused();
    test_shared_classes();
    test_weld();
    test_drop();
    test_repeated_corners();
    test_split_open();
    test_split_closed();
    test_split_too_high_valence();
    test_repair_anything();
    test_quads();
    test_polygons();
    test_existing_edges();
    test_triangulation_notes();
    test_tags();
    test_ignored_tags();
    test_tags_follow_repairs();
    test_tags_follow_splits();
    test_bad_tags();
    test_holes();
    test_boundary_of_mesh();
    test_refused_options();
    return check_report();
}
