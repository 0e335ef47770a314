/* SPDX-License-Identifier: MIT */
/*
 * Base meshes: every corner of every patch is a vertex that has the bits of the same corner in a
 * plan at level 0, in all formats and with all kernels; vertices are as few as normals and channels
 * allow; and where a base mesh suffices, a plan has no other level.
 */
#include "packs.h"

#include <stdio.h>

typedef struct subject {
    limn_baker *baker;
    limn_pack pack;
    limn_mesh mesh;
    limn_base base;
    void *memory;
    float *normals; ///< of control points
} subject;

static void *allocate(size_t count, size_t size) {
    void *const memory = calloc(count ? count : 1, size);
    if (!memory) abort();
    return memory;
}

/// The stencils have just the room that they need: each point's terms are counted once.
static void check_room(const limn_base *base) {
    uint32_t term_count = 0;
    for (uint32_t v = 0; v < base->vertex_count; v++) {
        const uint32_t end = base->vertices[v].first_term + base->vertices[v].term_count;
        term_count = end > term_count ? end : term_count;
    }
    CHECK_EQUAL((uintptr_t)base->indices - (uintptr_t)base->terms,
                term_count * sizeof *base->terms);
}

static bool open_baked(subject *s) {
    const void *bytes;
    size_t size;
    if (!CHECK_EQUAL(limn_baker_finish(s->baker, &bytes, &size), LIMN_BAKE_OK)) return false;
    if (!CHECK_EQUAL(limn_pack_open(&s->pack, bytes, size), LIMN_OK)) return false;
    s->mesh = limn_pack_mesh(&s->pack, 0);
    const size_t memory_size = limn_base_size(&s->mesh);
    s->memory = allocate(memory_size, 1);
    s->base = limn_base_build(&s->pack, &s->mesh, s->memory);
    CHECK(s->base.size <= memory_size);
    check_room(&s->base);
    s->normals = allocate(s->mesh.normal_count, sizeof(float[3]));
    if (s->mesh.normals) limn_mesh_control_normals(&s->mesh, s->mesh.controls, s->normals);
    return true;
}

static void close_baked(subject *s) {
    limn_baker_destroy(s->baker);
    free(s->memory);
    free(s->normals);
}

// ---- Vertices

/// A vertex of all that there is, with gaps.
enum { STRIDE = 44 };

static limn_output make_output(const subject *s, bool packed, unsigned char *bytes,
                               const limn_lighting *lighting) {
    limn_output output = {.vertices = bytes,
                          .stride = STRIDE,
                          .position_format =
                              packed ? LIMN_POSITION_UNORM16X4 : LIMN_POSITION_FLOAT3};
    if (!s->mesh.normals) return output;
    output.normals = bytes + 16;
    output.normal_stride = output.colour_stride = STRIDE;
    output.normal_format = packed ? LIMN_NORMAL_OCT16X2 : LIMN_NORMAL_FLOAT3;
    output.colours = bytes + 32;
    output.lighting = lighting;
    output.control_normals = s->normals;
    return output;
}

/// Corner k of a plan at level 0 is vertex k.
static void check_vertices(const subject *s, bool packed, unsigned char *corners,
                           unsigned char *vertices) {
    const limn_light lights[] = {
        {.kind = LIMN_LIGHT_DIRECTIONAL, .direction = {0.6f, -0.8f, 0}, .colour = {0.5f, 0.4f, 1}},
        {.kind = LIMN_LIGHT_POINT, .position = {1, 2, 3}, .colour = {1, 0.5f, 0.25f}}};
    const limn_lighting lighting = {
        .ambient = {0.1f, 0.1f, 0.2f}, .lights = lights, .light_count = 2};
    const limn_plan plan = limn_plan_uniform(&s->mesh, 0);
    const limn_output whole = make_output(s, packed, corners, &lighting);
    const limn_output shared = make_output(s, packed, vertices, &lighting);
    const uint32_t middle = s->base.vertex_count / 2;
    limn_evaluate(&plan, s->mesh.controls, 0, plan.patch_count, &whole);
    limn_base_evaluate(&s->base, s->mesh.controls, middle, s->base.vertex_count, &shared);
    limn_base_evaluate(&s->base, s->mesh.controls, 0, middle, &shared);
    const limn_domain *const domain = s->mesh.domain;
    uint32_t wrong = 0;
    for (uint32_t i = 0; i < s->base.index_count; i++) {
        const uint32_t patch = i / domain->index_counts[0];
        const uint32_t corner =
            patch * domain->corner_count + domain->indices[0][i % domain->index_counts[0]];
        wrong += memcmp(corners + (size_t)corner * STRIDE,
                        vertices + (size_t)s->base.indices[i] * STRIDE, STRIDE) != 0;
    }
    CHECK_EQUAL(wrong, 0);
}

static void check_kernels(subject *s) {
    const size_t corner_count = (size_t)s->mesh.patch_count * s->mesh.domain->corner_count;
    unsigned char *const corners = allocate(corner_count, STRIDE);
    unsigned char *const vertices = allocate(s->base.vertex_count, STRIDE);
    for (uint32_t isa = 1; isa <= LIMN_ISA_NEON; isa <<= 1) {
        if (!(limn_isa_supported() & isa)) continue;
        s->mesh.kernels = limn_kernels_select(isa, LIMN_FAMILY_REPRODUCIBLE);
        for (int packed = 0; packed < 2; packed++)
            check_vertices(s, packed, corners, vertices);
    }
    unsigned char *const fast = allocate(s->base.vertex_count, STRIDE);
    const limn_output output = make_output(s, false, fast, &(limn_lighting){.light_count = 0});
    const limn_output reference =
        make_output(s, false, vertices, &(limn_lighting){.light_count = 0});
    limn_base_evaluate(&s->base, s->mesh.controls, 0, s->base.vertex_count, &reference);
    s->mesh.kernels = limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_FAST);
    limn_base_evaluate(&s->base, s->mesh.controls, 0, s->base.vertex_count, &output);
    for (uint32_t v = 0; v < s->base.vertex_count; v++)
        CHECK(memcmp(fast + (size_t)v * STRIDE, vertices + (size_t)v * STRIDE, 12) == 0);
    free(corners);
    free(vertices);
    free(fast);
}

/// No two vertices are alike in what makes them, and each is at the first corner that has it.
static void check_distinct(const subject *s) {
    const limn_domain *const domain = s->mesh.domain;
    uint32_t corners[LIMN_CORNER_MAX], *const points =
                                           allocate(s->base.vertex_count, sizeof *points);
    for (uint32_t v = 0; v < s->base.vertex_count; v++) {
        const uint32_t corner = s->base.vertices[v].corner;
        limn_mesh_corners(&s->mesh, corner / domain->corner_count, corners);
        points[v] = corners[corner % domain->corner_count];
        CHECK(v == 0 || corner > s->base.vertices[v - 1].corner);
        for (uint32_t other = 0; other < v && s->mesh.channel_count == 0; other++)
            CHECK(points[v] != points[other] ||
                  s->base.vertices[v].normal != s->base.vertices[other].normal);
    }
    free(points);
}

static void check_mesh(subject *s, uint32_t vertex_count) {
    if (open_baked(s)) {
        CHECK_EQUAL(s->base.index_count, s->mesh.patch_count * s->mesh.domain->index_counts[0]);
        if (vertex_count) CHECK_EQUAL(s->base.vertex_count, vertex_count);
        check_distinct(s);
        check_kernels(s);
    }
    close_baked(s);
}

// ---- Levels

/// Orthographic, with sizes as they are at that distance.
static limn_view view_from(float distance, bool orthographic) {
    const float eye[] = {0.3f * distance, 0.2f * distance, distance};
    const float target[] = {0, 0, 0}, up[] = {0, 1, 0};
    return orthographic ? limn_view_orthographic(eye, target, up, distance, 1280, 720, 0.01f, 1e6f)
                        : limn_view_perspective(eye, target, up, 1.0f, 1280, 720, 0.01f, 1e6f);
}

/// Walking away, the base mesh suffices from some distance on, which is at most `slack` times that
/// from which on the plan has no other level.
static void check_levels(const subject *s, const limn_lod_desc *desc, bool orthographic,
                         float slack) {
    const float bounds[] = {s->mesh.bounds_min[0], s->mesh.bounds_min[1], s->mesh.bounds_min[2],
                            s->mesh.bounds_max[0], s->mesh.bounds_max[1], s->mesh.bounds_max[2]};
    void *const memory = allocate(1, limn_plan_size(&s->mesh));
    float plan_distance = 0, base_distance = 0;
    for (float distance = 1; distance < 1e5f; distance *= 1.05f) {
        const limn_view view = view_from(distance, orthographic);
        const limn_plan plan =
            limn_plan_build(&s->mesh, s->mesh.controls, &view, 1, desc, NULL, memory);
        const bool enough = limn_base_suffices(&s->base, bounds, &view, 1, desc);
        if (enough) CHECK_EQUAL(plan.level, 0);
        CHECK(enough || base_distance == 0);
        if (plan.level > 0) plan_distance = distance;
        if (enough && base_distance == 0) base_distance = distance;
    }
    CHECK(base_distance > 0 && base_distance < slack * plan_distance + 2);
    free(memory);
}

/// The distance is that from the box, on each side of it.
static void check_sides(const subject *s) {
    const float bounds[] = {-1, -2, -4, 2, 5, 9}, far_enough = s->base.length * 100 / 8;
    for (int side = 0; side < 6; side++) {
        for (int more = 0; more < 2; more++) {
            limn_view view = {.eye = {0, 0, 0}, .pixels = 100, .nearest = 0.01f};
            const float away = far_enough * (more ? 1.01f : 0.99f);
            view.eye[side % 3] = bounds[side] + (side < 3 ? -away : away);
            CHECK_EQUAL(limn_base_suffices(&s->base, bounds, &view, 1, NULL), more);
        }
    }
}

static bool is_among_first(void *count, uint32_t patch) {
    return patch < *(const uint32_t *)count;
}

/// Patches are looked at by blocks of 64: what is left out behind does not change those before.
static void check_kept(const subject *s) {
    void *const memory = allocate(2, limn_plan_size(&s->mesh));
    void *const fewer = (unsigned char *)memory + (limn_plan_size(&s->mesh) + 7) / 8 * 8;
    const limn_view view = {.eye = {0, 1, 2}, .pixels = 400, .nearest = 0.01f};
    const limn_plan all = limn_plan_build(&s->mesh, s->mesh.controls, &view, 1, NULL, NULL, memory);
    for (uint32_t count = 1; count <= 130; count++) {
        const limn_lod_desc desc = {.keep_fn = is_among_first, .keep_user = &count};
        const limn_plan plan =
            limn_plan_build(&s->mesh, s->mesh.controls, &view, 1, &desc, NULL, fewer);
        if (CHECK_EQUAL(plan.patch_count, count))
            CHECK(memcmp(plan.patches, all.patches, count * sizeof *plan.patches) == 0);
    }
    free(memory);
}

/// Nothing is left of what is behind the eye or beside the view, of surfaces that leave the hull of
/// their points, too.
static void check_unseen(const char *path, limn_scheme scheme) {
    static const float targets[][3] = {{0, 0, 100}, {100, 0, 0}, {-100, 0, 0}, {0, 100, 0.5f}};
    const float eye[] = {0, 0, 50}, up[] = {0, 1, 0};
    subject s = {.baker = limn_baker_create(&(limn_bake_desc){.scheme = scheme})};
    if (CHECK_EQUAL(limn_baker_add_file(s.baker, path), LIMN_BAKE_OK) && open_baked(&s)) {
        void *const memory = allocate(1, limn_plan_size(&s.mesh));
        for (size_t v = 0; v < COUNT(targets); v++) {
            const limn_view view =
                limn_view_perspective(eye, targets[v], up, 1.0f, 1280, 720, 1, 1000);
            const limn_plan plan =
                limn_plan_build(&s.mesh, s.mesh.controls, &view, 1, NULL, NULL, memory);
            CHECK_EQUAL(plan.patch_count, 0);
        }
        free(memory);
    }
    close_baked(&s);
}

static void check_when(const char *path) {
    subject s = {.baker = limn_baker_create(NULL)};
    if (CHECK_EQUAL(limn_baker_add_file(s.baker, path), LIMN_BAKE_OK) && open_baked(&s)) {
        check_levels(&s, &(limn_lod_desc){.lod = LIMN_LOD_ERROR}, false, 1.5f);
        check_levels(&s, &(limn_lod_desc){.lod = LIMN_LOD_ERROR}, true, 1.01f);
        check_levels(&s, &(limn_lod_desc){.lod = LIMN_LOD_LENGTH}, false, 1.5f);
        check_levels(&s, &(limn_lod_desc){.lod = LIMN_LOD_LENGTH}, true, 1.01f);
        check_levels(&s, &(limn_lod_desc){.lod = LIMN_LOD_LENGTH, .bias = 1.5f, .pixels = 20},
                     false, 1.5f);
        for (float bias = -0.97f; bias < 1; bias += 0.09f) // its logarithm is not exact
            check_levels(&s, &(limn_lod_desc){.lod = LIMN_LOD_LENGTH, .bias = bias}, true, 1.06f);
        check_levels(&s, &(limn_lod_desc){.lod = LIMN_LOD_ERROR, .bias = -1}, false,
                     6); // errors do not ask the bias
        check_sides(&s);
        check_kept(&s);
        const limn_view view = view_from(1e5f, false);
        const float bounds[6] = {0};
        const limn_lod_desc never[] = {{.min_level = 1},
                                       {.lod = LIMN_LOD_ERROR, .bias = 1},
                                       {.lod = LIMN_LOD_UNIFORM, .level = 0.5f}};
        for (size_t d = 0; d < COUNT(never); d++)
            CHECK(!limn_base_suffices(&s.base, bounds, &view, 1, &never[d]));
        CHECK(limn_base_suffices(&s.base, bounds, &view, 1,
                                 &(limn_lod_desc){.lod = LIMN_LOD_UNIFORM}));
    }
    close_baked(&s);
}

// ---- Meshes

/// A file may have a mesh without patches.
static void check_empty(void) {
    const limn_mesh mesh = {.domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE)};
    const limn_pack pack = {0};
    CHECK_EQUAL(limn_base_size(&mesh), 0);
    CHECK_EQUAL(limn_base_build(&pack, &mesh, NULL).vertex_count, 0);
}

static void check_file(const char *name, const limn_bake_desc *desc) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", getenv("LIMN_ASSETS"), name);
    subject s = {.baker = limn_baker_create(desc)};
    CHECK_EQUAL(limn_baker_add_file(s.baker, path), LIMN_BAKE_OK);
    check_mesh(&s, 0);
}

static void check_case(const mesh_case *m, const limn_bake_desc *desc,
                       const limn_bake_channel *channel, uint32_t vertex_count) {
    subject s = {.baker = limn_baker_create(desc)};
    CHECK_EQUAL(
        limn_baker_add_mesh(s.baker, &(limn_bake_mesh){.positions = m->positions,
                                                       .position_count = m->position_count,
                                                       .face_sizes = m->face_sizes,
                                                       .face_count = m->face_count,
                                                       .face_indices = m->faces,
                                                       .crease_edges = m->crease_edges,
                                                       .crease_sharpness = m->crease_sharpness,
                                                       .crease_count = m->crease_count,
                                                       .channels = channel,
                                                       .channel_count = channel != NULL}),
        LIMN_BAKE_OK);
    check_mesh(&s, vertex_count);
}

/// A seam around one face of the tetrahedron: three vertices more.
static void check_seams(void) {
    const float values[] = {0, 0, 1, 0, 0, 1, 1, 1, 5, 5, 6, 5, 5, 6};
    const uint32_t seam[] = {4, 5, 6, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const uint32_t none[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const limn_bake_desc desc = {.normals = LIMN_NORMALS_EXACT};
    limn_bake_channel channel = {.name = "uv",
                                 .component_count = 2,
                                 .values = values,
                                 .value_count = 7,
                                 .corner_values = seam};
    check_case(&tetrahedron, &desc, &channel, 7);
    channel.corner_values = none;
    check_case(&tetrahedron, &desc, &channel, 4);
}

/// A crease around the face 0 1 2 of the tetrahedron: its vertices have two normals each.
static void check_creases(void) {
    const uint32_t edges[] = {0, 1, 1, 2, 2, 0};
    const float sharpness[] = {INFINITY, INFINITY, INFINITY};
    mesh_case creased = tetrahedron;
    creased.crease_edges = edges;
    creased.crease_sharpness = sharpness;
    creased.crease_count = 3;
    check_case(&creased, &(limn_bake_desc){.normals = LIMN_NORMALS_EXACT}, NULL, 7);
    check_case(&creased, &(limn_bake_desc){.normals = LIMN_NORMALS_NONE}, NULL, 4);
}

/// The tetrahedron with numbers that are far apart, at the ends of what is counted together.
static void check_far_numbers(void) {
    enum { COUNT_OF_ALL = 3 << 15 };
    static const uint32_t numbers[] = {0, (1 << 15) - 1, 1 << 15, COUNT_OF_ALL - 1};
    float *const positions = allocate(COUNT_OF_ALL, sizeof(float[3]));
    uint32_t faces[12];
    for (uint32_t c = 0; c < 4; c++)
        memcpy(positions + 3 * (size_t)numbers[c], tetrahedron_positions + 3 * c, sizeof(float[3]));
    for (uint32_t i = 0; i < 12; i++)
        faces[i] = numbers[tetrahedron_faces[i]];
    mesh_case far_numbers = tetrahedron;
    far_numbers.positions = positions;
    far_numbers.position_count = COUNT_OF_ALL;
    far_numbers.faces = faces;
    check_case(&far_numbers, NULL, NULL, 4);
    free(positions);
}

int main(void) {
    char path[4096];
    make_wheel();
    check_far_numbers();
    for (int isolate = 0; isolate < 2; isolate++) {
        limn_bake_desc desc = {.normals = LIMN_NORMALS_EXACT,
                               .isolate = isolate ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER};
        check_file("imp.obj", &desc);
        check_file("sail.obj", &desc);
        check_file("torus32.obj", &desc);
        check_case(&wheel, &desc, NULL, WHEEL_SIZE + 1);
        check_case(&strip, &desc, NULL, 5);
        desc.scheme = LIMN_SCHEME_CATMARK;
        check_file("mug.obj", &desc);
        check_case(&box, &desc, NULL, 8);
        check_case(&tetrahedron, &desc, NULL, 14); // divided: vertices, faces and edges
        desc.scheme = LIMN_SCHEME_BUTTERFLY;
        check_file("sail.obj", &desc);
    }
    check_case(&twin, NULL, NULL, 4);
    check_empty();
    check_seams();
    check_creases();
    snprintf(path, sizeof path, "%s/imp.obj", getenv("LIMN_ASSETS"));
    check_when(path);
    check_unseen(path, LIMN_SCHEME_LOOP);
    check_unseen(path, LIMN_SCHEME_BUTTERFLY);
    return check_report();
}
