/* SPDX-License-Identifier: MIT */
/*
 * Channels at run time. Values that are positions, with the same topology, come out as the positions
 * do, bit for bit, row by row, in any plan: so texture coordinates stay with their vertices. Values
 * that patches share along an edge agree in every bit. All formats are what they say, the same bits
 * with every kernel. Values follow their corners through all repairs. Damaged files are refused.
 */
#include "packs.h"

#include <string.h>

enum { PATCHES_MAX = 512, ROWS = 289 };

// ---- Meshes

static const float cube_positions[] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                       -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1.5f};
static const uint32_t cube_faces[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4,
                                      1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
static const uint32_t cube_sizes[] = {4, 4, 4, 4, 4, 4};
/// One corner of the cube cut off.
static const float cut_positions[] = {-1, -1, -1, 1,  -1, -1, 1, 1, -1, -1, 1,    -1, -1, -1, 1,
                                      1,  -1, 1,  -1, 1,  1,  1, 1, 0,  1,  0.5f, 1,  0,  1,  1};
static const uint32_t cut_faces[] = {0, 3, 2, 1, 4, 5, 8, 9, 6, 0, 1, 5, 4, 1, 2,
                                     7, 8, 5, 2, 3, 6, 9, 7, 3, 0, 4, 6, 7, 9, 8};
static const uint32_t cut_sizes[] = {4, 5, 4, 5, 5, 4, 3};

enum { GRID = 5 };
static float grid_positions[3 * (GRID + 1) * (GRID + 1)];
static uint32_t grid_faces[4 * GRID * GRID], grid_sizes[GRID * GRID];

static void make_grid(void) {
    for (uint32_t v = 0; v < (GRID + 1) * (GRID + 1); v++) {
        grid_positions[3 * v] = (float)(v % (GRID + 1));
        grid_positions[3 * v + 1] = (float)(v / (GRID + 1)) + 0.1f * (float)(v % 3);
        grid_positions[3 * v + 2] = 0.25f * (float)(v * v % 7);
    }
    for (uint32_t f = 0; f < GRID * GRID; f++) {
        const uint32_t v = f / GRID * (GRID + 1) + f % GRID;
        memcpy(grid_faces + 4 * f, (uint32_t[]){v, v + 1, v + GRID + 2, v + GRID + 1},
               4 * sizeof *grid_faces);
        grid_sizes[f] = 4;
    }
}

static const limn_bake_mesh cube = {.name = "cube",
                                    .positions = cube_positions,
                                    .position_count = 8,
                                    .face_sizes = cube_sizes,
                                    .face_count = 6,
                                    .face_indices = cube_faces};
static const limn_bake_mesh cut_cube = {.name = "cut",
                                        .positions = cut_positions,
                                        .position_count = 10,
                                        .face_sizes = cut_sizes,
                                        .face_count = 7,
                                        .face_indices = cut_faces};
static const limn_bake_mesh grid = {.name = "grid",
                                    .positions = grid_positions,
                                    .position_count = (GRID + 1) * (GRID + 1),
                                    .face_sizes = grid_sizes,
                                    .face_count = GRID * GRID,
                                    .face_indices = grid_faces};

static uint32_t corner_count_of(const limn_bake_mesh *mesh) {
    uint32_t count = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        count += mesh->face_sizes[f];
    return count;
}

// ---- Files

typedef struct subject {
    limn_baker *baker;
    limn_pack pack;
    limn_mesh mesh;
    limn_channel channel; ///< the first
} subject;

static void open_subject(const limn_bake_desc *desc, const limn_bake_mesh *mesh,
                         const limn_bake_channel *channel, subject *s) {
    const void *bytes = NULL;
    size_t size = 0;
    limn_bake_mesh with = *mesh;
    with.channels = channel;
    with.channel_count = 1;
    s->baker = limn_baker_create(desc);
    CHECK_EQUAL(limn_baker_add_mesh(s->baker, &with), LIMN_BAKE_OK);
    CHECK_EQUAL(limn_baker_finish(s->baker, &bytes, &size), LIMN_BAKE_OK);
    CHECK_TEXT(limn_baker_error(s->baker), "");
    if (!CHECK_EQUAL(limn_pack_open(&s->pack, bytes, size), LIMN_OK)) exit(check_report());
    s->mesh = limn_pack_mesh(&s->pack, 0);
    CHECK_EQUAL(s->mesh.channel_count, 1);
    s->channel = limn_mesh_channel(&s->pack, &s->mesh, 0);
    CHECK(s->mesh.patch_count <= PATCHES_MAX);
}

// ---- The same rows

static float positions[PATCHES_MAX * ROWS][3], values[PATCHES_MAX * ROWS][3];

static void check_same(const subject *s, const limn_plan *plan) {
    const size_t size = (size_t)plan->vertex_count * sizeof *positions;
    memset(values, 0x55, size);
    limn_evaluate(plan, s->mesh.controls, 0, plan->patch_count,
                  &(limn_output){.vertices = positions});
    limn_evaluate_channel(plan, &s->channel, s->channel.mesh.controls, 0, plan->patch_count,
                          &(limn_value_output){.values = values});
    CHECK(plan->vertex_count > 0 && memcmp(positions, values, size) == 0);
}

/// From near by, so that levels differ and weights are anything.
static void check_frame(const subject *s) {
    const float eye[3] = {1.5f, 1.25f, 3}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const limn_view view = limn_view_perspective(eye, target, up, 1, 256, 256, 0.1f, 100);
    void *const memory = malloc(limn_plan_size(&s->mesh));
    const limn_plan plan = limn_plan_build(&s->mesh, s->mesh.controls, &view, 1,
                                           &(limn_lod_desc){.pixels = 11}, NULL, memory);
    bool mixed = false;
    for (uint32_t p = 0; p < plan.patch_count; p++)
        mixed |= plan.patches[p].morph > 0 && plan.patches[p].morph < 1;
    CHECK(mixed);
    check_same(s, &plan);
    free(memory);
}

/// Positions as values: three components at the same corners.
static void check_positions(const limn_bake_desc *desc, const limn_bake_mesh *mesh) {
    const limn_bake_channel channel = {.kind = LIMN_CHANNEL_COLOUR,
                                       .component_count = 3,
                                       .values = mesh->positions,
                                       .value_count = mesh->position_count,
                                       .corner_values = mesh->face_indices};
    subject s;
    open_subject(desc, mesh, &channel, &s);
    CHECK_TEXT(s.channel.mesh.name, "channel");
    for (uint32_t level = 0; level <= LIMN_LEVEL_MAX; level++) {
        const limn_plan plan = limn_plan_uniform(&s.mesh, level);
        check_same(&s, &plan);
    }
    check_frame(&s);
    limn_baker_destroy(s.baker);
}

static void test_rows(void) {
    const limn_scheme schemes[] = {LIMN_SCHEME_LOOP, LIMN_SCHEME_CATMARK, LIMN_SCHEME_BUTTERFLY};
    for (size_t k = 0; k < COUNT(schemes); k++) {
        for (int isolate = 0; isolate < 2; isolate++) {
            const limn_bake_desc desc = {
                .scheme = schemes[k],
                .isolate = isolate ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER,
                .normals = isolate ? LIMN_NORMALS_NONE : LIMN_NORMALS_EXACT,
                .face_varying = LIMN_FACE_VARYING_NONE};
            check_positions(&desc, &cube);
            check_positions(&desc, &cut_cube);
            check_positions(&desc, &grid);
        }
    }
    const limn_bake_desc flat = {.scheme = LIMN_SCHEME_NONE};
    check_positions(&flat, &grid);
}

// ---- Seams

/// The grid as an atlas: two charts, and a slit that ends inside.
static void make_atlas(float *uv, uint32_t *corners) {
    for (uint32_t f = 0; f < GRID * GRID; f++) {
        const uint32_t row = f / GRID, column = f % GRID;
        for (uint32_t c = 0; c < 4; c++) {
            const uint32_t vertex = grid_faces[4 * f + c];
            const bool slit = row == 1 && column < 2 && c < 2 && vertex % (GRID + 1) < 2;
            const uint32_t chart = column > 2 ? 1 : slit ? 2 : 0;
            const uint32_t value = chart * (GRID + 1) * (GRID + 1) + vertex;
            corners[4 * f + c] = value;
            uv[2 * value] = 0.1f * grid_positions[3 * vertex] + 0.3f * (float)chart;
            uv[2 * value + 1] = 0.1f * grid_positions[3 * vertex + 1] + 0.01f * (float)(vertex % 5);
        }
    }
}

enum { ATLAS_SIZE = 3 * (GRID + 1) * (GRID + 1) };
static float atlas_uv[2 * ATLAS_SIZE];
static uint32_t atlas_corners[4 * GRID * GRID];
static const limn_bake_channel atlas = {.name = "uv",
                                        .kind = LIMN_CHANNEL_UV,
                                        .component_count = 2,
                                        .values = atlas_uv,
                                        .value_count = ATLAS_SIZE,
                                        .corner_values = atlas_corners};

/// Whether edge e of patch p runs against edge f of patch q, by points.
static bool is_same_edge(const limn_mesh *mesh, uint32_t p, uint32_t e, uint32_t q, uint32_t f) {
    const uint32_t count = mesh->domain->corner_count;
    uint32_t a[LIMN_CORNER_MAX], b[LIMN_CORNER_MAX];
    limn_mesh_corners(mesh, p, a);
    limn_mesh_corners(mesh, q, b);
    return a[e] == b[(f + 1) % count] && a[(e + 1) % count] == b[f];
}

static void check_edge(const limn_domain *domain, uint32_t p, uint32_t e, uint32_t q, uint32_t f) {
    const size_t rows = domain->row_counts[LIMN_LEVEL_MAX];
    for (uint32_t t = 0; t <= LIMN_GRID_SIZE; t++)
        CHECK(memcmp(values[p * rows + domain->edge_rows[e][t]],
                     values[q * rows + domain->edge_rows[f][LIMN_GRID_SIZE - t]],
                     sizeof *values) == 0);
}

static void check_edges(const subject *s) {
    const uint32_t count = s->mesh.domain->corner_count;
    uint32_t continuous = 0, seams = 0;
    for (uint32_t p = 0; p < s->mesh.patch_count; p++) {
        for (uint32_t q = 0; q < p; q++) {
            for (uint32_t k = 0; k < count * count; k++) {
                const uint32_t e = k / count, f = k % count;
                if (!is_same_edge(&s->mesh, p, e, q, f)) continue;
                const bool same = is_same_edge(&s->channel.mesh, p, e, q, f);
                continuous += same;
                seams += !same;
                if (same) check_edge(s->mesh.domain, p, e, q, f);
            }
        }
    }
    CHECK(continuous > 30 && seams >= 7);
}

static void check_seams(const limn_bake_desc *desc) {
    subject s;
    open_subject(desc, &grid, &atlas, &s);
    const limn_plan plan = limn_plan_uniform(&s.mesh, LIMN_LEVEL_MAX);
    for (int k = 0; k < 2 * 4; k++) {
        s.channel.mesh.kernels =
            limn_kernels_select((1u << k / 2 | LIMN_ISA_SCALAR) & LIMN_ISA_ALL,
                                k % 2 ? LIMN_FAMILY_FAST : LIMN_FAMILY_REPRODUCIBLE);
        limn_evaluate_channel(&plan, &s.channel, s.channel.mesh.controls, 0, plan.patch_count,
                              &(limn_value_output){.values = values});
        check_edges(&s);
    }
    limn_baker_destroy(s.baker);
}

static void test_seams(void) {
    const limn_scheme schemes[] = {LIMN_SCHEME_LOOP, LIMN_SCHEME_CATMARK, LIMN_SCHEME_BUTTERFLY,
                                   LIMN_SCHEME_NONE};
    for (int mode = LIMN_FACE_VARYING_DEFAULT; mode <= LIMN_FACE_VARYING_ALL; mode++) {
        for (size_t k = 0; k < COUNT(schemes); k++) {
            const bool isolated = (mode + (int)k) % 2;
            if (schemes[k] == LIMN_SCHEME_NONE && mode != LIMN_FACE_VARYING_DEFAULT &&
                mode != LIMN_FACE_VARYING_ALL)
                continue; // refused
            check_seams(
                &(limn_bake_desc){.scheme = schemes[k],
                                  .isolate = isolated ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER,
                                  .face_varying = (limn_face_varying)mode});
        }
    }
}

/// A linear channel has one table, of as many columns as a face has corners.
static void test_linear(void) {
    const limn_bake_desc desc = {.scheme = LIMN_SCHEME_CATMARK,
                                 .isolate = LIMN_ISOLATE_ALWAYS,
                                 .face_varying = LIMN_FACE_VARYING_ALL};
    subject s;
    open_subject(&desc, &grid, &atlas, &s);
    CHECK_EQUAL(s.channel.mesh.run_count, 1);
    CHECK_EQUAL(s.pack.classes[s.channel.mesh.runs[0].class_index].control_count, 4);
    CHECK_EQUAL(s.channel.mesh.point_count, s.channel.mesh.control_count);
    limn_baker_destroy(s.baker);
}

// ---- Formats

/// The value of a half.
static double decode(uint32_t half) {
    const int exponent = (int)(half >> 10 & 31), fraction = (int)(half & 1023);
    const double size =
        exponent == 0 ? ldexp(fraction, -24) : ldexp(1024 + fraction, exponent - 25);
    return half & 0x8000 ? -size : size;
}

static void check_half(float value, uint32_t half) {
    const double got = decode(half), size = fabs((double)value);
    const double step = size < 0x1p-14 ? 0x1p-24 : ldexp(1, ilogb(size) - 10);
    if (size > 65504) {
        CHECK(fabs(got) == 65504);
    } else {
        CHECK(fabs(got - (double)value) <= step / 2);
    }
    CHECK(half >> 15 == (uint32_t)signbit(value));
}

static uint32_t quantise(float value, float low, float high, double limit) {
    const double clamped = fmin(fmax(((double)value - (double)low) / (double)(high - low), 0), 1);
    return (uint32_t)lrint(clamped * limit);
}

/// Words of a plan in one format, with a stride.
static void evaluate_words(const subject *s, const limn_plan *plan, limn_value_format format,
                           uint32_t stride, const float *bounds, uint32_t *words) {
    limn_evaluate_channel(
        plan, &s->channel, s->channel.mesh.controls, 0, plan->patch_count,
        &(limn_value_output){.values = words, .stride = stride, .format = format, .box = bounds});
}

static uint32_t words[2][PATCHES_MAX * ROWS * 4];

static void check_formats(const subject *s, const limn_plan *plan) {
    static const float bounds[] = {0, 0.05f, 0, 0.5f, 0.4f, 1};
    const size_t count = (size_t)plan->vertex_count;
    evaluate_words(s, plan, LIMN_VALUE_FLOAT3, 0, NULL, (uint32_t *)(void *)values);
    evaluate_words(s, plan, LIMN_VALUE_FLOAT2, 0, NULL, words[0]);
    for (size_t v = 0; v < count; v++)
        CHECK(memcmp(&words[0][2 * v], values[v], 8) == 0 && values[v][2] == 0);
    evaluate_words(s, plan, LIMN_VALUE_HALF2, 12, NULL, words[0]);
    for (size_t v = 0; v < count; v++) {
        check_half(values[v][0], words[0][3 * v] & 0xffff);
        check_half(values[v][1], words[0][3 * v] >> 16);
    }
    evaluate_words(s, plan, LIMN_VALUE_UNORM16X2, 0, bounds, words[0]);
    for (size_t v = 0; v < count; v++) {
        CHECK_NEAR((double)(words[0][v] & 0xffff), quantise(values[v][0], 0, 0.5f, 65535), 1.0);
        CHECK_NEAR((double)(words[0][v] >> 16), quantise(values[v][1], 0.05f, 0.4f, 65535), 1.0);
    }
    evaluate_words(s, plan, LIMN_VALUE_RGBA8, 0, NULL, words[0]);
    for (size_t v = 0; v < count; v++) {
        CHECK_NEAR((double)(words[0][v] & 0xff), quantise(values[v][0], 0, 1, 255), 1.0);
        CHECK_NEAR((double)(words[0][v] >> 8 & 0xff), quantise(values[v][1], 0, 1, 255), 1.0);
        CHECK_EQUAL(words[0][v] >> 16, 0xff00);
    }
}

static void check_kernels(subject *s, const limn_plan *plan) {
    for (int format = LIMN_VALUE_FLOAT3; format <= LIMN_VALUE_RGBA8; format++) {
        for (uint32_t stride = 0; stride <= 16; stride += 16) {
            memset(words, 0xaa, sizeof words);
            s->channel.mesh.kernels =
                limn_kernels_select(LIMN_ISA_SCALAR, LIMN_FAMILY_REPRODUCIBLE);
            evaluate_words(s, plan, (limn_value_format)format, stride, NULL, words[0]);
            s->channel.mesh.kernels = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_REPRODUCIBLE);
            evaluate_words(s, plan, (limn_value_format)format, stride, NULL, words[1]);
            CHECK(memcmp(words[0], words[1], sizeof words[0]) == 0);
        }
    }
}

static void test_formats(void) {
    subject s;
    open_subject(&(limn_bake_desc){.scheme = LIMN_SCHEME_CATMARK}, &grid, &atlas, &s);
    for (uint32_t level = 0; level <= 3; level++) {
        const limn_plan plan = limn_plan_uniform(&s.mesh, level);
        check_formats(&s, &plan);
        check_kernels(&s, &plan);
    }
    limn_baker_destroy(s.baker);
}

/// All halves come back as they were, and what is half way between goes to the even one.
static void test_halves(void) {
    static float given[ATLAS_SIZE][3];
    subject s;
    open_subject(&(limn_bake_desc){.face_varying = LIMN_FACE_VARYING_ALL}, &grid, &atlas, &s);
    memset(s.channel.mesh.origin, 0, sizeof s.channel.mesh.origin);
    const limn_plan plan = limn_plan_uniform(&s.mesh, 0);
    for (uint32_t half = 0; half < 0x7c00; half++) {
        const double own = decode(half), next = half < 0x7bff ? decode(half + 1) : own;
        for (uint32_t v = 0; v < s.channel.mesh.point_count; v++) {
            given[v][0] = (float)own;
            given[v][1] = (float)((own + next) / 2);
        }
        limn_evaluate_channel(&plan, &s.channel, given[0], 0, 1,
                              &(limn_value_output){.values = words[0], .format = LIMN_VALUE_HALF2});
        const uint32_t even = half < 0x7bff ? half + (half & 1) : half;
        CHECK_EQUAL(words[0][0], half | even << 16);
    }
    limn_baker_destroy(s.baker);
}

// ---- Repairs

/// Values that are x and y of each corner are still, whatever became of the faces.
static void check_repaired(const limn_bake_mesh *mesh, limn_scheme scheme) {
    float uv[2 * 64];
    uint32_t corners[64];
    const uint32_t count = corner_count_of(mesh);
    for (uint32_t c = 0; c < count; c++) {
        memcpy(&uv[2 * c], &mesh->positions[3 * mesh->face_indices[c]], 8);
        corners[c] = c;
    }
    const limn_bake_channel channel = {.kind = LIMN_CHANNEL_UV,
                                       .component_count = 2,
                                       .values = uv,
                                       .value_count = count,
                                       .corner_values = corners};
    const limn_bake_desc desc = {.scheme = scheme,
                                 .face_varying = LIMN_FACE_VARYING_ALL,
                                 .repair = LIMN_REPAIR_ALL,
                                 .non_manifold = LIMN_NON_MANIFOLD_SPLIT};
    subject s;
    open_subject(&desc, mesh, &channel, &s);
    for (uint32_t p = 0; p < s.mesh.patch_count; p++) {
        uint32_t points[LIMN_CORNER_MAX], own[LIMN_CORNER_MAX];
        limn_mesh_corners(&s.mesh, p, points);
        limn_mesh_corners(&s.channel.mesh, p, own);
        for (uint32_t c = 0; c < 2 * s.mesh.domain->corner_count; c++)
            CHECK_NEAR(s.mesh.controls[3 * points[c / 2] + c % 2],
                       s.channel.mesh.controls[3 * own[c / 2] + c % 2], 1e-6f);
    }
    limn_baker_destroy(s.baker);
}

static void test_repairs(void) {
    /// A hexagon, a quad with a corner twice, a repeated face, three faces at one edge, and a point
    /// that is there twice.
    static const float points[] = {0, 0, 0, 2, 0,  0, 3, 1, 0, 2, 2, 0, 0, 2, 0, -1, 1, 0,
                                   2, 0, 0, 1, -2, 0, 5, 0, 1, 5, 1, 1, 1, 4, 2, 4,  5, 0};
    static const uint32_t sizes[] = {6, 4, 3, 3, 3, 3, 3};
    static const uint32_t faces[] = {0, 1, 2, 3, 4, 5, 1,  0, 7, 7, 2, 6, 8,
                                     2, 8, 9, 2, 9, 3, 10, 4, 3, 3, 4, 11};
    const limn_bake_mesh mesh = {.name = "broken",
                                 .positions = points,
                                 .position_count = 12,
                                 .face_sizes = sizes,
                                 .face_count = 7,
                                 .face_indices = faces};
    check_repaired(&mesh, LIMN_SCHEME_LOOP);
    check_repaired(&mesh, LIMN_SCHEME_NONE);
}

// ---- Damage

enum { CHANNEL = 1 }; ///< behind the only mesh

static limn_file_channel *channel_of(const blob *file) {
    return chunk_data(file, CHANNEL, LIMN_CHUNK_CHANNEL);
}

static void no_channels(const blob *file) {
    header_of(file)->channel_count = 0;
}
static void many_channels(const blob *file) {
    header_of(file)->channel_count = UINT32_MAX;
}
static void mesh_without_channels(const blob *file) {
    record_of(file, 0)->channel_count = 0;
}
static void mesh_with_many_channels(const blob *file) {
    record_of(file, 0)->channel_count = 2;
}
static void channels_elsewhere(const blob *file) {
    record_of(file, 0)->first_channel = 1;
}
static void channel_of_channel(const blob *file) {
    record_of(file, CHANNEL)->channel_count = 1;
}
static void channel_kind(const blob *file) {
    channel_of(file)->kind = 2;
}
static void channel_without_components(const blob *file) {
    channel_of(file)->component_count = 0;
}
/// Not damage.
static void channel_with_one_component(const blob *file) {
    channel_of(file)->component_count = 1;
}
static void channel_with_many_components(const blob *file) {
    channel_of(file)->component_count = 4;
}
static void channel_with_fewer_patches(const blob *file) {
    record_of(file, CHANNEL)->patch_count--;
}
static void channel_with_holes(const blob *file) {
    record_of(file, CHANNEL)->hole_count++;
}
static void channel_of_triangles(const blob *file) {
    record_of(file, CHANNEL)->domain = LIMN_DOMAIN_TRIANGLE;
}
static void channel_without_record(const blob *file) {
    find_chunk(file, CHANNEL, LIMN_CHUNK_CHANNEL)->size = 0;
}
static void channel_not_finite(const blob *file) {
    *(float *)chunk_data(file, CHANNEL, LIMN_CHUNK_CONTROLS) = NAN;
}
static void channel_index(const blob *file) {
    *(uint32_t *)chunk_data(file, CHANNEL, LIMN_CHUNK_INDICES) = UINT32_MAX;
}
static void channel_run(const blob *file) {
    ((limn_file_run *)chunk_data(file, CHANNEL, LIMN_CHUNK_RUNS))->class_index = UINT32_MAX;
}

static const damage damages[] = {
    DAMAGE(no_channels, LIMN_ERROR_CHUNK),
    DAMAGE(many_channels, LIMN_ERROR_CHANNEL),
    DAMAGE(mesh_without_channels, LIMN_ERROR_CHANNEL),
    DAMAGE(mesh_with_many_channels, LIMN_ERROR_CHANNEL),
    DAMAGE(channels_elsewhere, LIMN_ERROR_CHANNEL),
    DAMAGE(channel_of_channel, LIMN_ERROR_CHANNEL),
    DAMAGE(channel_kind, LIMN_ERROR_CHANNEL),
    DAMAGE(channel_without_components, LIMN_ERROR_CHANNEL),
    DAMAGE(channel_with_one_component, LIMN_OK),
    DAMAGE(channel_with_many_components, LIMN_ERROR_CHANNEL),
    DAMAGE(channel_with_fewer_patches, LIMN_ERROR_CHANNEL),
    DAMAGE(channel_with_holes, LIMN_ERROR_CHANNEL),
    DAMAGE(channel_of_triangles, LIMN_ERROR_CHANNEL),
    DAMAGE(channel_without_record, LIMN_ERROR_CHUNK),
    DAMAGE(channel_not_finite, LIMN_ERROR_CONTROLS),
    DAMAGE(channel_index, LIMN_ERROR_INDEX),
    DAMAGE(channel_run, LIMN_ERROR_RUN),
};

static blob bake_atlas(const limn_bake_desc *desc) {
    subject s;
    open_subject(desc, &grid, &atlas, &s);
    const blob source = {.bytes = (unsigned char *)(uintptr_t)s.pack.blob,
                         .size = s.pack.blob_size};
    const blob file = copy_blob(&source, source.size);
    limn_baker_destroy(s.baker);
    return file;
}

static void test_damages(void) {
    const blob file = bake_atlas(&(limn_bake_desc){.scheme = LIMN_SCHEME_CATMARK});
    check_damages(&file, damages, COUNT(damages));
    check_gaps(&file);
    free(file.bytes);
}

/// Meshes are not channels, and channels have no faces, errors and normals of their own.
static void test_chunks_of_others(void) {
    static const limn_file_chunk added[] = {
        {.mesh = 0, .kind = LIMN_CHUNK_CHANNEL},
        {.mesh = CHANNEL, .kind = LIMN_CHUNK_FACES},
        {.mesh = CHANNEL, .kind = LIMN_CHUNK_ERRORS},
        {.mesh = CHANNEL, .kind = LIMN_CHUNK_NORMALS},
        {.mesh = CHANNEL, .kind = LIMN_CHUNK_CREASES},
        {.mesh = CHANNEL, .kind = LIMN_CHUNK_SIDES},
        {.mesh = CHANNEL, .kind = LIMN_CHUNK_CORNERS},
    };
    const blob file = bake_atlas(&(limn_bake_desc){.scheme = LIMN_SCHEME_CATMARK});
    for (size_t a = 0; a < COUNT(added); a++) {
        const blob longer = insert_chunk(&file, &added[a]);
        CHECK_EQUAL(open_result(longer.bytes, longer.size), LIMN_ERROR_CHUNK);
        free(longer.bytes);
    }
    free(file.bytes);
}

/// Words of a small file at the limits of their types: refused, or evaluated safely.
static void test_mended_words(void) {
    static const uint32_t corners[] = {0, 1, 2, 3, 1, 4, 1, 2, 4, 2, 0, 4};
    static const float uv[] = {0, 0, 1, 0, 0, 1, 0.5f, 0, 1, 1};
    const limn_bake_channel channel = {.kind = LIMN_CHANNEL_UV,
                                       .component_count = 2,
                                       .values = uv,
                                       .value_count = 5,
                                       .corner_values = corners};
    const limn_bake_mesh mesh = {.positions = tetrahedron.positions,
                                 .position_count = tetrahedron.position_count,
                                 .face_sizes = (const uint32_t[]){3, 3, 3, 3},
                                 .face_count = 4,
                                 .face_indices = tetrahedron.faces};
    subject s;
    open_subject(&(limn_bake_desc){0}, &mesh, &channel, &s);
    const blob source = {.bytes = (unsigned char *)(uintptr_t)s.pack.blob,
                         .size = s.pack.blob_size};
    check_mended_words(&source);
    limn_baker_destroy(s.baker);
}

static void test_bad_channels(void) {
    limn_bake_channel channel = atlas;
    limn_bake_mesh mesh = grid;
    mesh.channels = &channel;
    mesh.channel_count = 1;
    channel.value_count = 3;
    limn_baker *baker = limn_baker_create(NULL);
    CHECK_EQUAL(limn_baker_add_mesh(baker, &mesh), LIMN_BAKE_BAD_INPUT);
    CHECK_TEXT(limn_baker_error(baker), "grid: corner 2 refers to value 7 of uv, but there are 3");
    limn_baker_destroy(baker);
    channel.component_count = 4;
    baker = limn_baker_create(NULL);
    CHECK_EQUAL(limn_baker_add_mesh(baker, &mesh), LIMN_BAKE_BAD_INPUT);
    CHECK_TEXT(limn_baker_error(baker), "grid: uv has 4 components; 1 to 3 are right");
    limn_baker_destroy(baker);
}

int main(void) {
    make_grid();
    make_atlas(atlas_uv, atlas_corners);
    test_rows();
    test_seams();
    test_linear();
    test_formats();
    test_halves();
    test_repairs();
    test_damages();
    test_chunks_of_others();
    test_mended_words();
    test_bad_channels();
    return check_report();
}
