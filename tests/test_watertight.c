/* SPDX-License-Identifier: MIT */
/*
 * Bitwise watertight: for every mesh, level and kernel, every vertex that two patches share has the
 * same bits in both. And the tables: rows sum to 1 and have no negative coefficient.
 */
#include "../baker/base.h"
#include "check.h"
#include "coefficients.h"
#include "limn/format.h"
#include "limn/limn.h"
#include "mesh_files.h"
#include "random_polygons.h"

#include <math.h>
#include <stdlib.h>

enum { ISOLATED_MAX = 5000 }; ///< patches

/// A mesh twice: as the baker connects it, and baked.
typedef struct subject {
    const char *path;
    limni_context context;
    limni_mesh source;
    limni_base base;
    const limni_mesh *mesh; ///< of the base, for its half-edge pairs
    limn_baker *baker;
    limn_pack pack;
    limn_mesh baked;
    uint32_t *patches;      ///< [face_count] the patch of each face; LIMNI_NONE: a hole
    float *control_normals; ///< [normal_count][3]
} subject;

static limn_creases creases; ///< of all bakes from here on

static unsigned long long total_vertices, total_meshes, refused_meshes, split_vertices,
    sheet_vertices;

static bool load(subject *s, const char *path, const limn_bake_desc *desc) {
    const void *blob;
    size_t size;
    *s = (subject){.path = path, .context = {.desc = *desc}, .baker = limn_baker_create(desc)};
    if (limn_baker_add_file(s->baker, path) != LIMN_BAKE_OK) return false;
    CHECK_EQUAL(limn_baker_finish(s->baker, &blob, &size), LIMN_BAKE_OK);
    CHECK_EQUAL(limn_pack_open(&s->pack, blob, size), LIMN_OK);
    s->baked = limn_pack_mesh(&s->pack, 0);

    limni_source source = {0};
    const limni_rules rules = {
        .scheme = desc->scheme, .creases = desc->creases, .isolate = desc->isolate};
    CHECK_EQUAL(limni_read_file(&s->context, path, &source), LIMN_BAKE_OK);
    CHECK_EQUAL(limni_mesh_build(&s->context, &source, &s->source), LIMN_BAKE_OK);
    CHECK_EQUAL(limni_base_begin(&s->context, &s->source, &rules, &s->base), LIMN_BAKE_OK);
    s->mesh = s->base.mesh;
    CHECK_EQUAL(s->mesh->face_count, s->baked.face_count);
    CHECK(s->mesh->hole_count <= s->baked.face_count - s->baked.patch_count);
    s->patches = limni_allocate(&s->context, s->mesh->face_count, sizeof *s->patches);
    memset(s->patches, 0xff, s->mesh->face_count * sizeof *s->patches);
    for (uint32_t patch = 0; patch < s->baked.patch_count; patch++)
        s->patches[limn_mesh_face(&s->baked, patch).face] = patch;
    s->control_normals = limni_allocate(&s->context, s->baked.normal_count, 3 * sizeof(float));
    limn_mesh_control_normals(&s->baked, s->baked.controls, s->control_normals);
    return true;
}

static void unload(subject *s) {
    limni_release_all(&s->context);
    limn_baker_destroy(s->baker);
}

/// The patch of the face at half-edge h, and the edge of the patch that it is.
static uint32_t patch_of(const subject *s, uint32_t h) {
    return s->patches[s->mesh->face_of[h]];
}
static uint32_t edge_of(const subject *s, uint32_t h) {
    const uint32_t face = s->mesh->face_of[h], size = limni_face_size(s->mesh, face);
    const uint32_t rotation = limn_mesh_face(&s->baked, s->patches[face]).rotation;
    return (h - s->mesh->offsets[face] + size - rotation) % size;
}

/// The rows of the patch along half-edge h, in its direction.
static const uint16_t *rows_along(const subject *s, uint32_t h) {
    return s->baked.domain->edge_rows[edge_of(s, h)];
}

/// A position and a normal.
typedef float vertex[6];

/// Which normal a patch has at row t along its edge e: LIMNI_NONE inside a smooth edge.
static uint32_t side_of(const limn_mesh *mesh, uint32_t patch, uint32_t e, uint32_t t) {
    uint32_t corners[LIMN_CORNER_MAX];
    if (t > 0 && t < LIMN_GRID_SIZE)
        return mesh->creases && mesh->creases[patch] >> e & 1 ? patch : LIMNI_NONE;
    const uint32_t corner_count = mesh->domain->corner_count;
    const uint32_t corner = t == 0 ? e : (e + 1) % corner_count;
    limn_mesh_corners(mesh, patch, corners);
    return mesh->corner_normals ? mesh->corner_normals[corner_count * patch + corner]
                                : corners[corner];
}

/// Whether the two patches at half-edge h have a normal in common at row t: not on a crease.
static bool share_normal(const subject *s, uint32_t h, uint32_t t) {
    const uint32_t pair = s->mesh->pairs[h];
    return side_of(&s->baked, patch_of(s, h), edge_of(s, h), t) ==
           side_of(&s->baked, patch_of(s, pair), edge_of(s, pair), LIMN_GRID_SIZE - t);
}

/// How many vertices on shared edges differ in any bit.
static uint64_t count_differences(const subject *s, uint32_t level, const vertex *vertices) {
    const uint32_t row_count = s->baked.domain->row_counts[level];
    const uint32_t step = LIMN_GRID_SIZE >> level;
    uint64_t differences = 0;
    for (uint32_t h = 0; h < s->mesh->half_edge_count; h++) {
        const uint32_t pair = s->mesh->pairs[h];
        if (pair == LIMNI_NONE || pair < h) continue;
        if (patch_of(s, h) == LIMNI_NONE || patch_of(s, pair) == LIMNI_NONE) continue;
        const uint16_t *const along = rows_along(s, h), *const against = rows_along(s, pair);
        const vertex *const a = vertices + (size_t)patch_of(s, h) * row_count;
        const vertex *const b = vertices + (size_t)patch_of(s, pair) * row_count;
        for (uint32_t t = 0; t <= LIMN_GRID_SIZE; t += step) {
            const size_t size = share_normal(s, h, t) ? sizeof *a : 3 * sizeof(float);
            differences += memcmp(a[along[t]], b[against[LIMN_GRID_SIZE - t]], size) != 0;
            total_vertices++;
            split_vertices += size < sizeof *a;
        }
    }
    return differences;
}

/// The sheets that meet in half-edges a and b: whether they have the same ends, and which way.
typedef enum meeting { APART, ALONG, AGAINST } meeting;

static meeting meet(const limni_mesh *mesh, uint32_t a, uint32_t b) {
    const uint32_t *const origins = mesh->origins;
    const uint32_t start = origins[limni_half_edge_start(mesh, a)],
                   end = origins[limni_half_edge_end(mesh, a)];
    const uint32_t other_start = origins[limni_half_edge_start(mesh, b)],
                   other_end = origins[limni_half_edge_end(mesh, b)];
    if (start == other_start && end == other_end) return ALONG;
    return start == other_end && end == other_start ? AGAINST : APART;
}

/// How many vertices on edges where the mesh was split differ in position from those of other
/// sheets.
static uint64_t count_sheet_differences(const subject *s, uint32_t level, const vertex *vertices) {
    const uint32_t row_count = s->baked.domain->row_counts[level];
    uint32_t *const edges = malloc((size_t)s->mesh->half_edge_count * sizeof *edges);
    uint32_t count = 0;
    const uint32_t step = LIMN_GRID_SIZE >> level;
    uint64_t differences = 0;
    for (uint32_t h = 0; h < s->mesh->half_edge_count && s->mesh->origins; h++) {
        if (patch_of(s, h) != LIMNI_NONE &&
            limni_is_split(s->mesh, limni_half_edge_start(s->mesh, h)) &&
            limni_is_split(s->mesh, limni_half_edge_end(s->mesh, h)))
            edges[count++] = h;
    }
    for (uint32_t e = 0; e < count; e++) {
        for (uint32_t f = 0; f < e; f++) {
            const meeting met = meet(s->mesh, edges[e], edges[f]);
            if (met == APART) continue;
            const uint32_t a = patch_of(s, edges[e]), b = patch_of(s, edges[f]);
            const uint16_t *const along = rows_along(s, edges[e]), *const other =
                                                                       rows_along(s, edges[f]);
            for (uint32_t t = 0; t <= LIMN_GRID_SIZE; t += step) {
                const uint32_t at = met == ALONG ? t : LIMN_GRID_SIZE - t;
                differences +=
                    memcmp(vertices[(size_t)a * row_count + along[t]],
                           vertices[(size_t)b * row_count + other[at]], 3 * sizeof(float)) != 0;
                sheet_vertices++;
            }
        }
    }
    free(edges);
    return differences;
}

/// The same for the vertices themselves, where sheets may have no edge in common.
static uint64_t count_corner_differences(const subject *s, uint32_t level, const vertex *vertices) {
    const uint32_t row_count = s->baked.domain->row_counts[level];
    if (!s->mesh->origins) return 0;
    const uint32_t origin_count = s->mesh->origins[s->mesh->control_count - 1] + 1;
    const vertex **const places = calloc(origin_count, sizeof *places);
    uint64_t differences = 0;
    for (uint32_t h = 0; h < s->mesh->half_edge_count; h++) {
        if (patch_of(s, h) == LIMNI_NONE) continue;
        const vertex *const here =
            &vertices[(size_t)patch_of(s, h) * row_count + rows_along(s, h)[0]];
        const vertex **const place = &places[s->mesh->origins[limni_half_edge_start(s->mesh, h)]];
        if (!*place) *place = here;
        differences += memcmp(here, *place, 3 * sizeof(float)) != 0;
    }
    free(places);
    return differences;
}

static uint64_t evaluate_and_count(subject *s, const limn_kernels *kernels, uint32_t level,
                                   vertex *vertices) {
    s->baked.kernels = kernels;
    const limn_plan plan = limn_plan_uniform(&s->baked, level);
    limn_evaluate(&plan, s->baked.controls, 0, plan.patch_count,
                  &(limn_output){.vertices = vertices,
                                 .stride = sizeof(vertex),
                                 .normals = &vertices[0][3],
                                 .normal_stride = sizeof(vertex),
                                 .control_normals = s->control_normals});
    return count_differences(s, level, (const vertex *)vertices) +
           count_sheet_differences(s, level, (const vertex *)vertices) +
           count_corner_differences(s, level, (const vertex *)vertices);
}

/// Unit length everywhere; where the surface is degenerate, the fallback has it too.
static void check_unit_normals(const vertex *vertices, uint64_t count) {
    bool good = true;
    for (uint64_t v = 0; v < count; v++) {
        const float *const n = vertices[v] + 3;
        const double square = (double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2];
        good &= fabs(square - 1) < 1e-6;
    }
    CHECK(good);
}

static void check_mesh(subject *s) {
    const limn_plan largest = limn_plan_uniform(&s->baked, LIMN_LEVEL_MAX);
    vertex *const first = malloc((size_t)largest.vertex_count * sizeof *first);
    vertex *const other = malloc((size_t)largest.vertex_count * sizeof *other);
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        const limn_plan plan = limn_plan_uniform(&s->baked, level);
        const limn_kernels *const scalar =
            limn_kernels_select(LIMN_ISA_SCALAR, LIMN_FAMILY_REPRODUCIBLE);
        CHECK_EQUAL(evaluate_and_count(s, scalar, level, first), 0u);
        check_unit_normals((const vertex *)first, plan.vertex_count);
        for (uint32_t isa = LIMN_ISA_SCALAR << 1; isa <= limn_isa_supported(); isa <<= 1) {
            if (!(limn_isa_supported() & isa)) continue;
            const limn_kernels *const fast = limn_kernels_select(isa, LIMN_FAMILY_FAST);
            CHECK_EQUAL(evaluate_and_count(s, fast, level, other), 0u);
            const limn_kernels *const same = limn_kernels_select(isa, LIMN_FAMILY_REPRODUCIBLE);
            CHECK_EQUAL(evaluate_and_count(s, same, level, other), 0u);
            CHECK(memcmp(first, other, (size_t)plan.vertex_count * sizeof *first) == 0);
        }
    }
    free(first);
    free(other);
}

/// Below 0 only where it is what two floats leave, and with Chaikin's method and the butterfly
/// (docs/mathematics.md).
static double least_coefficient = -0x1p-26;

/// What a row is below 0 in all is never more than the class says, which is what one row is: of the
/// patch or, in pieces, of one of them. Pairs are two floats each.
static void check_bound(const limn_file_class *class, double below) {
    CHECK((double)class->negative >= below - 0x1p-21);
    CHECK((double)class->negative <= below + 0x1p-21);
}

static void check_tables(const limn_mesh *mesh) {
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        const limn_file_class *const class = &mesh->classes[mesh->runs[r].class_index];
        double most_below = 0;
        for (uint32_t row = 0; row < mesh->domain->row_counts[LIMN_LEVEL_MAX]; row++) {
            const column_place place = place_of_row(mesh, r, 0, row);
            double sum = 0, below = 0;
            for (uint32_t slot = 0; slot < class->control_count; slot++) {
                const double coefficient = coefficient_at(&place, slot);
                CHECK(coefficient >= least_coefficient);
                sum += coefficient;
                below -= fmin(coefficient, 0);
            }
            most_below = fmax(most_below, below);
            // Rounding to float moves each coefficient by at most 2^-24 of itself, and they sum
            // to 1.
            CHECK_NEAR(sum, 1.0, 0x1p-24);
        }
        check_bound(class, most_below);
    }
}

/// The points of level 1 likewise; and those of the bind pose are what any kernel makes of it.
static void check_points(limn_mesh *mesh) {
    const uint32_t count = mesh->point_count - mesh->control_count;
    float(*const points)[3] = calloc(mesh->point_count, sizeof *points);
    const size_t size = mesh->point_count * sizeof *points;
    for (uint32_t point = 0; point < count; point++) {
        double sum = 0;
        for (uint32_t t = mesh->stencils[point]; t < mesh->stencils[point + 1]; t++) {
            CHECK((double)mesh->terms[t].weight >= least_coefficient);
            sum += (double)mesh->terms[t].weight;
        }
        CHECK_NEAR(sum, 1.0, 0x1p-24);
    }
    for (uint32_t isa = LIMN_ISA_SCALAR; isa <= limn_isa_supported(); isa <<= 1) {
        mesh->kernels = limn_kernels_select(isa, LIMN_FAMILY_FAST);
        memcpy(points, mesh->controls, mesh->control_count * sizeof *points);
        limn_mesh_refine(mesh, points[0]);
        CHECK(memcmp(points, mesh->controls, size) == 0);
        memset(points, 0, size);
    }
    free(points);
}

static void check_all(subject *s) {
    check_mesh(s);
    check_tables(&s->baked);
    check_points(&s->baked);
}

/// Bakes a mesh, mended if it must be, and checks it. Returns how many patches it has.
static uint32_t check_file(const char *path, limn_bake_desc desc) {
    subject s;
    bool loaded = load(&s, path, &desc);
    if (!loaded) {
        refused_meshes++;
        unload(&s);
        desc.repair = LIMN_REPAIR_ALL;
        desc.non_manifold = LIMN_NON_MANIFOLD_SPLIT;
        loaded = load(&s, path, &desc);
    }
    if (CHECK(loaded)) {
        total_meshes++;
        check_all(&s);
    } else {
        fprintf(stderr, "    %s: %s\n", path, limn_baker_error(s.baker));
    }
    const uint32_t patch_count = s.baked.patch_count;
    unload(&s);
    return patch_count;
}

static void visit_with(const char *path, limn_scheme scheme) {
    limn_bake_desc desc = {.scheme = scheme, .creases = creases, .normals = LIMN_NORMALS_EXACT};
    const uint32_t patch_count = check_file(path, desc);
    desc.isolate = LIMN_ISOLATE_ALWAYS;
    if (patch_count <= ISOLATED_MAX) check_file(path, desc);
}

/// Lomont's rules are for triangles. What poles of 360 faces have, those of test_generated() have in
/// less time; and isolated, large meshes have nothing that others have not.
static void visit(const char *path) {
    if (strstr(path, "pole360")) return;
    const bool lomont = creases == LIMN_CREASES_LOMONT;
    visit_with(path, lomont ? LIMN_SCHEME_LOOP : mesh_files_scheme(path));
}

static void write_vertices(FILE *file, uint32_t count, double height) {
    for (uint32_t v = 0; v < count; v++)
        fprintf(file, "v %.6f %.6f %.6f\n", 900 + cos(6.283185307 * v / count),
                -300 + sin(6.283185307 * v / count), v % 3 * 0.1);
    fprintf(file, "v 900.1 -299.8 %.6f\nv 899.9 -300.2 -1.25\n", height);
}

/// What the files may not have: wide classes and compensated sums beside plain ones, a fan of
/// boundary vertices, and a place far from 0.
static void test_generated(uint32_t valence, bool closed) {
    static const char path[] = "test_watertight_generated.obj";
    FILE *const file = fopen(path, "w");
    if (!CHECK(file)) return;
    write_vertices(file, valence, 1.5);
    for (uint32_t v = 1; v <= valence; v++) {
        const uint32_t next = v % valence + 1;
        if (!closed && v == valence) break;
        fprintf(file, "f %u %u %u\n", v, next, valence + 1);
        if (closed) fprintf(file, "f %u %u %u\n", next, v, valence + 2);
    }
    const int closed_file = fclose(file);
    CHECK(closed_file == 0);
    visit(path);
    remove(path);
}

/// The same of quads, around one pole or between two. From 128 faces on, a patch has more than 256
/// control points.
static void test_generated_quads(uint32_t valence, bool closed) {
    static const char path[] = "test_watertight_generated.obj";
    const uint32_t rim = 2 * valence;
    FILE *const file = fopen(path, "w");
    if (!CHECK(file)) return;
    write_vertices(file, rim, 1.5);
    for (uint32_t v = 0; v < rim; v += 2) {
        const uint32_t next = v + 1, last = (v + 2) % rim, before = (v + rim - 1) % rim;
        if (!closed && last == 0) break;
        fprintf(file, "f %u %u %u %u\n", rim + 1, v + 1, next + 1, last + 1);
        if (closed) fprintf(file, "f %u %u %u %u\n", rim + 2, next + 1, v + 1, before + 1);
    }
    const int closed_file = fclose(file);
    CHECK(closed_file == 0);
    visit_with(path, LIMN_SCHEME_CATMARK);
    remove(path);
}

/// A flat mesh has normals with zeros, whose signs must agree too.
static void test_flat(void) {
    static const char path[] = "test_watertight_flat.obj";
    FILE *const file = fopen(path, "w");
    if (!CHECK(file)) return;
    for (int y = 0; y < 7; y++) {
        for (int x = 0; x < 7; x++)
            fprintf(file, "v %.3f %.3f 0\n", x - 3 + 0.1 * (y % 3), y - 3 + 0.07 * (x % 4));
    }
    for (int corner = 1; corner < 42; corner++) {
        if (corner % 7 == 0) continue;
        fprintf(file, "f %d %d %d %d\n", corner, corner + 1, corner + 8, corner + 7);
    }
    const int closed_file = fclose(file);
    CHECK(closed_file == 0);
    visit_with(path, LIMN_SCHEME_LOOP);
    visit_with(path, LIMN_SCHEME_CATMARK);
    visit_with(path, LIMN_SCHEME_NONE);
    remove(path);
}

/// A torus of 12 by 8 quads, cut in two, with tags from 0 to for ever on a third of its edges:
/// creases that cross, end and stop, beside semi-sharp ones. For Catmull-Clark, of quads.
static void test_tagged(limn_scheme scheme, bool chaikin) {
    enum { AROUND = 12, ACROSS = 8, COUNT = AROUND * ACROSS };
    static const char path[] = "test_watertight_tagged.obj";
    FILE *const file = fopen(path, "w");
    if (!CHECK(file)) return;
    if (chaikin) fprintf(file, "t creasemethod 0/0/1 chaikin\n");
    for (int v = 0; v < COUNT; v++) {
        const double u = 6.283185307 * (v % AROUND) / AROUND,
                     w = 6.283185307 * (v / AROUND) / ACROSS;
        fprintf(file, "v %.6f %.6f %.6f\n", (3 + cos(w)) * cos(u), (3 + cos(w)) * sin(u), sin(w));
    }
    for (int v = 0; v < COUNT; v++) {
        const int right = v / AROUND * AROUND + (v + 1) % AROUND;
        const int up = (v + AROUND) % COUNT, far = (right + AROUND) % COUNT;
        const bool quads = scheme == LIMN_SCHEME_CATMARK;
        if (quads) {
            fprintf(file, "f %d %d %d %d\n", v + 1, right + 1, far + 1, up + 1);
        } else {
            fprintf(file, "f %d %d %d\nf %d %d %d\n", v + 1, right + 1, far + 1, v + 1, far + 1,
                    up + 1);
        }
        const int ends[3] = {right, quads ? up : far, up};
        if (v % 11 == 0) fprintf(file, "t corner 1/1/0 %d %g\n", v, v % 3 * 0.85);
        fprintf(file, "t crease 2/1/0 %d %d %g\n", v, ends[v % 3], v % 4 ? v % 7 * 0.55 : 10.0);
    }
    const int closed_file = fclose(file);
    CHECK(closed_file == 0);
    const unsigned long long before = split_vertices;
    least_coefficient = chaikin ? -1.0 / 24 : -0x1p-26;
    visit_with(path, scheme);
    least_coefficient = -0x1p-26;
    CHECK(split_vertices > before);
    remove(path);
}

/// All sheets have the error of the edge, and with it its level.
static void check_errors(const subject *s) {
    const uint32_t corner_count = s->baked.domain->corner_count;
    for (uint32_t a = 0; a < s->mesh->half_edge_count && s->mesh->origins; a++) {
        for (uint32_t b = 0; b < a; b++) {
            const uint32_t p = patch_of(s, a), q = patch_of(s, b);
            if (meet(s->mesh, a, b) == APART || p == LIMNI_NONE || q == LIMNI_NONE) continue;
            CHECK_EQUAL(s->baked.errors[corner_count * p + edge_of(s, a)],
                        s->baked.errors[corner_count * q + edge_of(s, b)]);
        }
    }
}

/// Four pages of a grid around a spine, which bends, and so numbered that copies behind all others
/// would be in another order on some pages; and a loose face at one corner. For Catmull-Clark pages
/// are of quads but for the last, and so all faces are divided.
static void test_book(limn_scheme scheme) {
    enum { PAGES = 4, LENGTH = 6, WIDTH = 3 };
    static const char path[] = "test_watertight_book.obj";
    FILE *const file = fopen(path, "w");
    if (!CHECK(file)) return;
    for (int v = 0; v < LENGTH; v++) // the spine is 1, 2, ...
        fprintf(file, "v %.6f %.6f %.6f\n", 0.1 * v * v, 0.37 * v, sin(v));
    for (int p = 0; p < PAGES; p++) {
        for (int v = 0; v < LENGTH * WIDTH; v++) {
            const double angle = 1.7 * p + 0.1 * (v % LENGTH), out = 1 + v / LENGTH;
            const int along = v % LENGTH;
            fprintf(file, "v %.6f %.6f %.6f\n", 0.1 * along * along + out * cos(angle),
                    0.37 * along + 0.05 * out * p, sin(along) + out * sin(angle));
        }
    }
    for (int p = 0; p < PAGES; p++) {
        const int page = 1 + LENGTH + p * LENGTH * WIDTH;
        for (int w = 0; w < WIDTH; w++) {
            const int inner = w == 0 ? 1 : page + (w - 1) * LENGTH, outer = page + w * LENGTH;
            for (int v = 0; v + 1 < LENGTH; v++) {
                const int first = p % 2 ? inner + v : outer + v,
                          second = p % 2 ? outer + v : inner + v;
                // On the last page diagonals turn: on the spine there are two faces, or four.
                const int turned = p == PAGES - 1 && v % 2;
                if (scheme == LIMN_SCHEME_CATMARK && p < PAGES - 1) {
                    fprintf(file, "f %d %d %d %d\n", first, first + 1, second + 1, second);
                    continue;
                }
                fprintf(file, "f %d %d %d\nf %d %d %d\n", first, first + 1, second + turned,
                        turned ? first : first + 1, second + 1, second);
            }
        }
    }
    fprintf(file, "v 9 9 9\nv 9 9 8\nf %d -1 -2\n", 1 + LENGTH + LENGTH * WIDTH - 1);
    // Creases of one page that end at the spine, and a corner of it.
    fprintf(file, "t crease 2/1/0 2 %d 1.5\nt crease 2/1/0 3 %d 10\nt corner 1/1/0 4 0.7\n",
            LENGTH + 2, LENGTH + LENGTH * WIDTH + 3);
    const int closed_file = fclose(file);
    CHECK(closed_file == 0);
    const unsigned long long before = sheet_vertices;
    visit_with(path, scheme);
    CHECK(sheet_vertices > before);
    subject s;
    const limn_bake_desc desc = {.scheme = scheme,
                                 .repair = LIMN_REPAIR_ALL,
                                 .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                                 .normals = LIMN_NORMALS_EXACT};
    if (CHECK(load(&s, path, &desc))) check_errors(&s);
    unload(&s);
    remove(path);
}

static void visit_tagged(const char *path) {
    if (mesh_files_have_tags(path)) visit(path);
}

/// Lomont's rules, with tags and at boundaries.
static void test_lomont(void) {
    creases = LIMN_CREASES_LOMONT;
    mesh_files_visit(visit_tagged);
    test_tagged(LIMN_SCHEME_LOOP, false);
    test_generated(20, false);
    test_book(LIMN_SCHEME_LOOP);
    creases = LIMN_CREASES_OPENSUBDIV;
}

/// Closed, and with a boundary.
static void test_butterfly(const char *closed) {
    const limn_bake_desc desc = {.scheme = LIMN_SCHEME_BUTTERFLY, .normals = LIMN_NORMALS_EXACT};
    limn_bake_desc isolated = desc;
    char open[4096];
    isolated.isolate = LIMN_ISOLATE_ALWAYS;
    snprintf(open, sizeof open, "%s/sail.obj", getenv("LIMN_ASSETS"));
    least_coefficient = -0.2;
    check_file(open, desc);
    check_file(open, isolated);
    check_file(closed, isolated);
    least_coefficient = -0x1p-26;
}

static void test_warren(const char *path) {
    check_file(path, (limn_bake_desc){.normals = LIMN_NORMALS_EXACT,
                                      .weights = LIMN_WEIGHTS_WARREN,
                                      .isolate = LIMN_ISOLATE_ALWAYS});
}

/// Quads and other polygons, closed and with boundaries, with tags and without.
static void test_random(uint64_t seed) {
    static const char path[] = "test_watertight_random.obj";
    random_polygons mesh = random_polygons_make(seed, seed % 2, seed / 2 % 2);
    if (!CHECK(random_polygons_write(&mesh, seed / 4 % 2, path))) return;
    visit_with(path, LIMN_SCHEME_CATMARK);
    visit_with(path, LIMN_SCHEME_NONE);
    remove(path);
}

/// The height of a triangle over its longest side; its normal, of unit length, goes to `normal`.
static double measure_triangle(double edges[2][3], double normal[3]) {
    double squares[3] = {0}, doubled_area = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double third = edges[1][axis] - edges[0][axis];
        normal[axis] = edges[0][u] * edges[1][v] - edges[0][v] * edges[1][u];
        doubled_area = hypot(doubled_area, normal[axis]);
        squares[0] += edges[0][axis] * edges[0][axis];
        squares[1] += edges[1][axis] * edges[1][axis];
        squares[2] += third * third;
    }
    for (int axis = 0; axis < 3; axis++)
        normal[axis] /= doubled_area;
    return doubled_area / sqrt(fmax(squares[0], fmax(squares[1], squares[2])));
}

/// How far a vertex is from the place (i, j) in the flat triangle or the bilinear quad of its patch,
/// or its normal from that there by more than points that are `rounding` off explain, whichever is
/// more.
static double off_patch(const limn_mesh *mesh, uint32_t patch, limn_row row, double rounding,
                        const float *values) {
    const double u = (double)row.i / LIMN_GRID_SIZE, v = (double)row.j / LIMN_GRID_SIZE;
    const bool quad = mesh->domain->kind == LIMN_DOMAIN_QUAD;
    uint32_t corners[LIMN_CORNER_MAX];
    double edges[2][3], normal[3], off = 0;
    limn_mesh_corners(mesh, patch, corners);
    for (size_t axis = 0; axis < 3; axis++) {
        double at[LIMN_CORNER_MAX];
        for (uint32_t c = 0; c < mesh->domain->corner_count; c++)
            at[c] = (double)mesh->controls[3 * (size_t)corners[c] + axis];
        const double last = at[quad ? 3 : 2], bend = quad ? at[0] - at[1] + at[2] - at[3] : 0;
        const double place = at[0] + u * (at[1] - at[0]) + v * (last - at[0]) + u * v * bend;
        edges[0][axis] = at[1] - at[0] + v * bend;
        edges[1][axis] = last - at[0] + u * bend;
        off = fmax(off, fabs((double)values[axis] - place));
    }
    const double tilt = rounding / measure_triangle(edges, normal);
    for (int axis = 0; axis < 3; axis++)
        off = fmax(off, fabs((double)values[3 + axis] - normal[axis]) - tilt);
    return off;
}

/// Without a scheme patches are flat triangles, evenly divided, with a normal each, or bilinear.
static void test_no_scheme(const char *path, limn_isolate isolate) {
    subject s;
    const limn_bake_desc desc = {
        .scheme = LIMN_SCHEME_NONE, .normals = LIMN_NORMALS_EXACT, .isolate = isolate};
    check_file(path, desc);
    if (!CHECK(load(&s, path, &desc))) return;
    const limn_plan plan = limn_plan_uniform(&s.baked, LIMN_LEVEL_MAX);
    vertex *const vertices = malloc((size_t)plan.vertex_count * sizeof *vertices);
    CHECK_EQUAL(evaluate_and_count(&s, s.pack.kernels, LIMN_LEVEL_MAX, vertices), 0u);
    double furthest = 0, rounding = 0;
    // Half-sized faces between points of level 1, each rounded in three coordinates.
    for (int axis = 0; axis < 3 && isolate == LIMN_ISOLATE_ALWAYS; axis++)
        rounding +=
            4 * 0x1p-24 * (double)fmaxf(s.baked.bounds_max[axis], -s.baked.bounds_min[axis]);
    for (uint32_t v = 0; v < plan.vertex_count; v++) {
        const uint32_t row_count = s.baked.domain->row_counts[LIMN_LEVEL_MAX];
        const limn_row row = s.baked.domain->rows[v % row_count];
        furthest = fmax(furthest, off_patch(&s.baked, v / row_count, row, rounding, vertices[v]));
    }
    printf("without a scheme: at most %.2e from the faces\n", furthest);
    CHECK(furthest < 1e-6);
    CHECK_EQUAL(s.baked.run_count, 1u);
    free(vertices);
    unload(&s);
}

/// The same of a prism, of which pentagons are divided, and with them all other faces.
static void test_no_scheme_prism(void) {
    static const char path[] = "test_watertight_prism.obj";
    FILE *const file = fopen(path, "w");
    if (!CHECK(file)) return;
    for (int v = 0; v < 10; v++)
        fprintf(file, "v %.6f %.6f %.6f\n", 2 * cos(6.283185307 * v / 5 + v / 5),
                2 * sin(6.283185307 * v / 5 + v / 5), v / 5 * 3 + v % 2 * 0.3);
    for (int v = 1; v <= 5; v++)
        fprintf(file, "f %d %d %d %d\n", v, v % 5 + 1, v % 5 + 6, v + 5);
    fprintf(file, "f 5 4 3 2 1\nf 6 7 8 9 10\n");
    const int closed_file = fclose(file);
    CHECK(closed_file == 0);
    test_no_scheme(path, LIMN_ISOLATE_NEVER);
    test_no_scheme(path, LIMN_ISOLATE_ALWAYS);
    remove(path);
}

/// Puts the control points of every patch in slot order: what watertightness depends on is undone.
static void shuffle(const subject *s, uint8_t *slots) {
    for (uint32_t r = 0; r < s->baked.run_count; r++) {
        const limn_file_run *const run = &s->baked.runs[r];
        const uint32_t count = s->baked.classes[run->class_index].control_count;
        for (uint32_t p = 0; p < run->patch_count; p++) {
            const size_t base = (size_t)run->first_index + (size_t)p * count;
            for (uint32_t k = 0; k < count; k++)
                slots[base + k] = (uint8_t)k;
        }
    }
}

/// This test must be able to fail: without the ascending order, shared vertices do differ.
static void test_order_matters(const char *path, limn_scheme scheme) {
    subject s;
    const limn_bake_desc desc = {.scheme = scheme, .normals = LIMN_NORMALS_EXACT};
    if (!CHECK(load(&s, path, &desc))) return;
    const limn_plan plan = limn_plan_uniform(&s.baked, LIMN_LEVEL_MAX);
    const limn_file_run *const last = &s.baked.runs[s.baked.run_count - 1];
    const size_t index_count =
        (size_t)last->first_index +
        (size_t)last->patch_count * s.baked.classes[last->class_index].control_count;
    vertex *const vertices = malloc((size_t)plan.vertex_count * sizeof *vertices);
    uint8_t *const slots = malloc(index_count);
    shuffle(&s, slots);
    s.baked.slots = slots;
    const uint64_t differences = evaluate_and_count(&s, s.pack.kernels, LIMN_LEVEL_MAX, vertices);
    printf("control points in slot order: %llu shared vertices differ\n",
           (unsigned long long)differences);
    CHECK(differences > 0);
    free(vertices);
    free(slots);
    unload(&s);
}

int main(void) {
    char path[4096];
    CHECK(mesh_files_visit(visit) > 0);
    printf("%llu bakes (%llu of them repaired), %llu shared vertices compared, %llu of them on "
           "creases without their normals, and %llu pairs of vertices of sheets\n",
           total_meshes, refused_meshes, total_vertices, split_vertices, sheet_vertices);
    test_flat();
    test_book(LIMN_SCHEME_LOOP);
    test_book(LIMN_SCHEME_CATMARK);
    for (int chaikin = 0; chaikin < 2; chaikin++) {
        test_tagged(LIMN_SCHEME_LOOP, chaikin);
        test_tagged(LIMN_SCHEME_CATMARK, chaikin);
    }
    test_lomont();
    static const uint32_t valences[] = {3, 7, 20, 26, 64, 255, 300};
    for (int v = 0; v < 7; v++) {
        test_generated(valences[v], true);
        test_generated(valences[v] / 4 + 3, false);
    }
    for (uint32_t valence = 3; valence < 256; valence *= 6) {
        test_generated_quads(valence + 22, true);
        test_generated_quads(valence, false);
    }
    for (uint64_t seed = 0; seed < 8; seed++)
        test_random(seed);
    snprintf(path, sizeof path, "%s/imp.obj", getenv("LIMN_ASSETS"));
    test_warren(path);
    test_butterfly(path);
    test_order_matters(path, LIMN_SCHEME_LOOP);
    test_order_matters(path, LIMN_SCHEME_CATMARK);
    test_no_scheme(path, LIMN_ISOLATE_NEVER);
    test_no_scheme(path, LIMN_ISOLATE_ALWAYS);
    snprintf(path, sizeof path, "%s/cube.off", getenv("LIMN_ASSETS"));
    test_no_scheme(path, LIMN_ISOLATE_NEVER);
    test_no_scheme(path, LIMN_ISOLATE_ALWAYS);
    test_no_scheme_prism();
    return check_report();
}
