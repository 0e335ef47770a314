/* SPDX-License-Identifier: MIT */
/*
 * Light on baked meshes: every kernel beside a plain reference, bit for bit, and that beside double
 * precision; a spot inside of a face; creases, morphing, and what is refused. That patches agree by
 * bits, whatever their levels, is in test_frames.c.
 */
#include "check.h"
#include "limn/bake.h"
#include "limn/limn.h"

#include <math.h>
#include <stdlib.h>

enum { LIGHTS = 5 };

typedef struct subject {
    limn_baker *baker;
    limn_mesh mesh;
    float *control_normals; ///< [normal_count][3]
    limn_light lights[LIGHTS];
    limn_lighting lighting;
} subject;

static void *allocate(size_t count, size_t size) {
    void *const memory = calloc(count ? count : 1, size);
    if (!memory) abort();
    return memory;
}

/// All kinds, more than one of each but one, none of them beyond white.
static void place_lights(subject *s) {
    float middle[3], size = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float low = s->mesh.bounds_min[axis], high = s->mesh.bounds_max[axis];
        middle[axis] = (low + high) / 2;
        size = fmaxf(size, high - low);
    }
    const float x = middle[0], y = middle[1], z = middle[2];
    const limn_light lights[LIGHTS] = {
        {.colour = {0.2f, 0.15f, 0.1f}, .direction = {0.48f, -0.6f, -0.64f}},
        {.kind = LIMN_LIGHT_POINT,
         .colour = {0.1f, 0.3f, 0.4f},
         .position = {x + size, y + size / 2, z},
         .attenuation = {0.5f, 0.25f / size, 0.5f / (size * size)}},
        {.kind = LIMN_LIGHT_SPOT,
         .colour = {0.5f, 0.4f, 0.2f},
         .position = {x, y + 1.5f * size, z},
         .direction = {0, -1, 0},
         .range = 3 * size,
         .inner_cosine = 0.98f,
         .outer_cosine = 0.93f},
        {.kind = LIMN_LIGHT_SPOT,
         .colour = {-0.1f, 0.2f, 0.1f},
         .position = {x, y, z + size},
         .direction = {0, 0, -1},
         .attenuation = {0, 0, 1 / (size * size)},
         .inner_cosine = 0.97f,
         .outer_cosine = 0.97f},
        {.kind = LIMN_LIGHT_POINT,
         .colour = {0.6f, 0.1f, 0.1f},
         .position = {x - 0.4f * size, y, z},
         .range = 0.5f * size}};
    memcpy(s->lights, lights, sizeof lights);
    s->lighting = (limn_lighting){
        .ambient = {0.02f, 0.03f, 0.05f}, .lights = s->lights, .light_count = LIGHTS};
    CHECK_EQUAL(limn_lights_check(s->lights, LIGHTS, NULL), LIMN_OK);
}

static void open_baked(subject *s, limn_bake_status added) {
    const void *blob;
    size_t size;
    limn_pack pack;
    if (!CHECK_EQUAL(added, LIMN_BAKE_OK) ||
        !CHECK_EQUAL(limn_baker_finish(s->baker, &blob, &size), LIMN_BAKE_OK) ||
        !CHECK_EQUAL(limn_pack_open(&pack, blob, size), LIMN_OK))
        abort();
    s->mesh = limn_pack_mesh(&pack, 0);
    s->control_normals = allocate(s->mesh.normal_count, sizeof(float[3]));
    if (s->mesh.normals) limn_mesh_control_normals(&s->mesh, s->mesh.controls, s->control_normals);
    place_lights(s);
}

static void load_as(subject *s, const char *name, limn_bake_desc desc) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", getenv("LIMN_ASSETS"), name);
    s->baker = limn_baker_create(&desc);
    open_baked(s, limn_baker_add_file(s->baker, path));
}

static void load(subject *s, const char *name, limn_bake_desc desc) {
    desc.normals = LIMN_NORMALS_EXACT;
    load_as(s, name, desc);
}

/// With flat sides: of two triangles each, or a quad.
static void make_cube(subject *s, limn_domain_kind domain) {
    static const uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    float points[8][3];
    uint32_t corners[36], sizes[12], corner_count = 0, face_count = 0;
    const uint32_t cuts = domain == LIMN_DOMAIN_QUAD ? 1 : 2,
                   size = domain == LIMN_DOMAIN_QUAD ? 4 : 3;
    for (uint32_t p = 0; p < 8; p++) {
        for (uint32_t axis = 0; axis < 3; axis++)
            points[p][axis] = p >> axis & 1 ? 1 : -1;
    }
    for (uint32_t f = 0; f < 6 * cuts; f++) {
        sizes[face_count++] = size;
        for (uint32_t c = 0; c < size; c++)
            corners[corner_count++] = sides[f / cuts][(c + 2 * (f % cuts)) % 4];
    }
    s->baker = limn_baker_create(
        &(limn_bake_desc){.scheme = LIMN_SCHEME_NONE, .normals = LIMN_NORMALS_EXACT});
    open_baked(s, limn_baker_add_mesh(s->baker, &(limn_bake_mesh){.name = "cube",
                                                                  .positions = points[0],
                                                                  .position_count = 8,
                                                                  .face_sizes = sizes,
                                                                  .face_indices = corners,
                                                                  .face_count = face_count}));
    CHECK_EQUAL(s->mesh.domain->kind, domain);
}

static void unload(subject *s) {
    free(s->control_normals);
    limn_baker_destroy(s->baker);
}

/// A vertex with everything.
typedef struct vertex {
    float position[3], normal[3];
    uint8_t colour[4];
} vertex;

static void evaluate(const subject *s, const limn_plan *plan, vertex *vertices) {
    limn_evaluate(plan, s->mesh.controls, 0, plan->patch_count,
                  &(limn_output){.vertices = vertices[0].position,
                                 .stride = sizeof *vertices,
                                 .normals = vertices[0].normal,
                                 .normal_stride = sizeof *vertices,
                                 .control_normals = s->control_normals,
                                 .colours = vertices[0].colour,
                                 .colour_stride = sizeof *vertices,
                                 .lighting = &s->lighting});
}

// ---- The reference: as docs/mathematics.md has it, in floats

/// The inverse root of the runtime: a guess from the bits, and three steps.
static float inverse_root(float a) {
    uint32_t bits;
    float root;
    memcpy(&bits, &a, sizeof bits);
    bits = 0x5f375a86 - (bits >> 1);
    memcpy(&root, &bits, sizeof root);
    for (int step = 0; step < 3; step++)
        root = root * (1.5f - a * 0.5f * (root * root));
    return root;
}

static float dot(const float a[3], const float b[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/// The way to a light, a unit vector. Returns the square of the distance.
static float find_way(const limn_light *light, const float position[3], float way[3]) {
    if (light->kind == LIMN_LIGHT_DIRECTIONAL) {
        for (int axis = 0; axis < 3; axis++)
            way[axis] = -light->direction[axis];
        return 0;
    }
    for (int axis = 0; axis < 3; axis++)
        way[axis] = light->position[axis] - position[axis];
    const float square = dot(way, way), root = inverse_root(square);
    for (int axis = 0; axis < 3; axis++)
        way[axis] *= root;
    return square;
}

static float cosine_of(const limn_light *light, const vertex *at, const float normal[3]) {
    float way[3];
    find_way(light, at->position, way);
    const float cosine = dot(normal, way);
    return cosine > 0 ? cosine : 0;
}

static float attenuate(const limn_light *light, const float position[3], float share) {
    if (light->kind == LIMN_LIGHT_DIRECTIONAL) return share;
    float way[3];
    const float square = find_way(light, position, way), distance = square * inverse_root(square);
    const float back[3] = {-light->direction[0], -light->direction[1], -light->direction[2]};
    const float *const a = light->attenuation;
    if (light->kind == LIMN_LIGHT_SPOT) {
        const float per_cone = 1 / (light->inner_cosine - light->outer_cosine);
        const float part = (dot(back, way) - light->outer_cosine) * per_cone;
        const float clamped = part > 1 ? 1 : part > 0 ? part : 0;
        share = share * (clamped * clamped);
    }
    const float per_range = light->range > 0 ? 1 / (light->range * light->range) : 0;
    const float left = 1 - square * per_range * (square * per_range);
    const bool even = a[0] == 0 && a[1] == 0 && a[2] == 0;
    const float divisor = (even ? 1 : a[0]) + a[1] * distance + a[2] * square;
    return share * (left > 0 ? left : 0) / divisor;
}

static float interpolate(const limn_domain *domain, const float c[], limn_row row) {
    const float u = (float)row.i / 16, v = (float)row.j / 16;
    if (domain->kind == LIMN_DOMAIN_TRIANGLE) return ((1 - u - v) * c[0] + u * c[1]) + v * c[2];
    return (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]);
}

/// By light and corner.
typedef float cosines[LIGHTS][LIMN_CORNER_MAX];

static void find_cosines(const subject *s, const vertex *patch, cosines at) {
    for (uint32_t i = 0; i < s->lighting.light_count; i++) {
        for (uint32_t c = 0; c < s->mesh.domain->corner_count; c++)
            at[i][c] = cosine_of(&s->lighting.lights[i], &patch[c], patch[c].normal);
    }
}

/// Of one row of a patch.
static void find_colour(const subject *s, const vertex *patch, const cosines corners, uint32_t row,
                        float colour[3]) {
    const limn_domain *const domain = s->mesh.domain;
    memcpy(colour, s->lighting.ambient, sizeof(float[3]));
    for (uint32_t i = 0; i < s->lighting.light_count; i++) {
        const limn_light *const light = &s->lighting.lights[i];
        const float cosine = s->lighting.mode == LIMN_LIGHT_EXACT
                                 ? cosine_of(light, &patch[row], patch[row].normal)
                                 : interpolate(domain, corners[i], domain->rows[row]);
        const float share = attenuate(light, patch[row].position, cosine);
        for (int axis = 0; axis < 3; axis++)
            colour[axis] += light->colour[axis] * share;
    }
}

static uint8_t quantise(float a) {
    const float scaled = a * 255;
    return (uint8_t)rintf(scaled > 255 ? 255 : scaled > 0 ? scaled : 0);
}

// ---- In double precision, from the definition

static double exact_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double exact_way(const limn_light *light, const float position[3], double way[3]) {
    const bool directional = light->kind == LIMN_LIGHT_DIRECTIONAL;
    for (int axis = 0; axis < 3; axis++)
        way[axis] = directional ? -(double)light->direction[axis]
                                : (double)light->position[axis] - (double)position[axis];
    const double distance = sqrt(exact_dot(way, way));
    for (int axis = 0; axis < 3 && !directional; axis++)
        way[axis] /= distance;
    return distance;
}

static double exact_cosine(const limn_light *light, const vertex *at) {
    double way[3];
    const double normal[3] = {at->normal[0], at->normal[1], at->normal[2]};
    exact_way(light, at->position, way);
    return fmax(exact_dot(normal, way), 0);
}

static double exact_share(const limn_light *light, const float position[3]) {
    double way[3], share = 1;
    const double d = exact_way(light, position, way);
    if (light->kind == LIMN_LIGHT_DIRECTIONAL) return 1;
    const float *const a = light->attenuation;
    const double divisor = (double)a[0] + (double)a[1] * d + (double)a[2] * d * d;
    if (divisor > 0) share /= divisor;
    if (light->range > 0) share *= fmax(1 - pow(d / (double)light->range, 4), 0);
    if (light->kind == LIMN_LIGHT_POINT) return share;
    const double inner = light->inner_cosine, outer = light->outer_cosine;
    double cosine = 0;
    for (int axis = 0; axis < 3; axis++)
        cosine -= (double)light->direction[axis] * way[axis];
    if (inner == outer) return cosine > outer ? share : 0;
    return share * pow(fmin(fmax((cosine - outer) / (inner - outer), 0), 1), 2);
}

/// Barycentric, or the same twice.
static double exact_cosine_between(const limn_domain *domain, const limn_light *light,
                                   const vertex *patch, limn_row row) {
    const double u = row.i / 16.0, v = row.j / 16.0;
    const double triangle[4] = {1 - u - v, u, v, 0};
    const double quad[4] = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
    const double *const weights = domain->kind == LIMN_DOMAIN_TRIANGLE ? triangle : quad;
    double sum = 0;
    for (uint32_t c = 0; c < domain->corner_count; c++)
        sum += weights[c] * exact_cosine(light, &patch[c]);
    return sum;
}

/// Whether a row is so close to a hard edge that rounding may put it on either side.
static bool is_doubtful(const subject *s, const float position[3]) {
    for (uint32_t i = 0; i < s->lighting.light_count; i++) {
        const limn_light *const light = &s->lighting.lights[i];
        double way[3], cosine = 0;
        if (light->kind != LIMN_LIGHT_SPOT || light->inner_cosine > light->outer_cosine) continue;
        exact_way(light, position, way);
        for (int axis = 0; axis < 3; axis++)
            cosine -= (double)light->direction[axis] * way[axis];
        if (fabs(cosine - (double)light->outer_cosine) < 1e-6) return true;
    }
    return false;
}

static double exact_colour(const subject *s, const vertex *patch, uint32_t row, int axis) {
    double sum = s->lighting.ambient[axis];
    for (uint32_t i = 0; i < s->lighting.light_count; i++) {
        const limn_light *const light = &s->lighting.lights[i];
        const double cosine =
            s->lighting.mode == LIMN_LIGHT_EXACT
                ? exact_cosine(light, &patch[row])
                : exact_cosine_between(s->mesh.domain, light, patch, s->mesh.domain->rows[row]);
        sum += (double)light->colour[axis] * cosine * exact_share(light, patch[row].position);
    }
    return sum;
}

// ---- All rows

static bool has_reference_bits(const subject *s, const vertex *patch, uint32_t row_count) {
    cosines corners;
    bool same = true;
    find_cosines(s, patch, corners);
    for (uint32_t row = 0; row < row_count; row++) {
        float colour[3];
        find_colour(s, patch, (const float(*)[LIMN_CORNER_MAX])corners, row, colour);
        for (int axis = 0; axis < 3; axis++)
            same &= patch[row].colour[axis] == quantise(colour[axis]);
        same &= patch[row].colour[3] == 255;
    }
    return same;
}

/// In steps of colours.
static double find_error(const subject *s, const vertex *patch, uint32_t row_count) {
    double furthest = 0;
    for (uint32_t row = 0; row < row_count; row++) {
        if (is_doubtful(s, patch[row].position)) continue;
        for (int axis = 0; axis < 3; axis++) {
            const double exact = fmin(fmax(exact_colour(s, patch, row, axis), 0), 1) * 255;
            furthest = fmax(furthest, fabs(patch[row].colour[axis] - exact));
        }
    }
    return furthest;
}

/// One level, by one table of kernels.
static void test_rows(subject *s, const limn_kernels *kernels, uint32_t level, bool exactly) {
    s->mesh.kernels = kernels;
    const limn_plan plan = limn_plan_uniform(&s->mesh, level);
    const uint32_t row_count = s->mesh.domain->row_counts[level];
    vertex *const vertices = allocate((size_t)plan.vertex_count, sizeof *vertices);
    double furthest = 0;
    bool same = true;
    evaluate(s, &plan, vertices);
    for (uint32_t p = 0; p < plan.patch_count; p++) {
        const vertex *const patch = vertices + (size_t)p * row_count;
        same &= has_reference_bits(s, patch, row_count);
        if (exactly) furthest = fmax(furthest, find_error(s, patch, row_count));
    }
    CHECK(same);
    CHECK(furthest < 0.502);
    free(vertices);
}

/// Light without normals in the output, which takes other ways, is the same.
static void test_alone(subject *s) {
    const limn_plan plan = limn_plan_uniform(&s->mesh, 3);
    vertex *const vertices = allocate((size_t)plan.vertex_count, sizeof *vertices);
    typedef struct lit {
        float position[3];
        uint8_t colour[4];
    } lit;
    lit *const alone = allocate((size_t)plan.vertex_count, sizeof *alone);
    evaluate(s, &plan, vertices);
    limn_evaluate(&plan, s->mesh.controls, 0, plan.patch_count,
                  &(limn_output){.vertices = alone[0].position,
                                 .stride = sizeof *alone,
                                 .control_normals = s->control_normals,
                                 .colours = alone[0].colour,
                                 .colour_stride = sizeof *alone,
                                 .lighting = &s->lighting});
    bool same = true;
    for (size_t v = 0; v < plan.vertex_count; v++)
        same &= memcmp(vertices[v].position, alone[v].position, 12) == 0 &&
                memcmp(vertices[v].colour, alone[v].colour, 4) == 0;
    CHECK(same);
    free(alone);
    free(vertices);
}

static bool is_clamped(uint8_t colour) {
    return colour == 0 || colour == 255;
}

/// Of level 2.5: rows that are new at level 3 have the colour half way from the middle of their
/// sources, within what three roundings to 255 steps are. No patch is left out: they are in order.
static void test_morphing(subject *s) {
    static const limn_view view = {.pixels = 1, .nearest = 1};
    const limn_lod_desc desc = {.lod = LIMN_LOD_UNIFORM, .level = 2.5f};
    const limn_domain *const domain = s->mesh.domain;
    const limn_plan whole = limn_plan_uniform(&s->mesh, 3);
    void *const memory = allocate(1, limn_plan_size(&s->mesh));
    vertex *const shown = allocate((size_t)whole.vertex_count, sizeof *shown);
    vertex *const still = allocate((size_t)whole.vertex_count, sizeof *still);
    const limn_plan plan =
        limn_plan_build(&s->mesh, s->mesh.controls, &view, 1, &desc, NULL, memory);
    CHECK_EQUAL(plan.vertex_count, whole.vertex_count);
    evaluate(s, &whole, still);
    evaluate(s, &plan, shown);
    double furthest = 0;
    uint32_t moved = 0;
    for (size_t v = 0; v < plan.vertex_count; v++) {
        const limn_row row = domain->rows[v % domain->row_counts[3]];
        const vertex *const patch = still + v - v % domain->row_counts[3];
        for (int axis = 0; axis < 3; axis++) {
            const uint8_t own = still[v].colour[axis], a = patch[row.sources[0]].colour[axis],
                          b = patch[row.sources[1]].colour[axis];
            if (is_clamped(own) || is_clamped(a) || is_clamped(b)) continue;
            const double middle = (a + b) / 2.0;
            const double between = row.level == 3 ? (own + middle) / 2 : own;
            furthest = fmax(furthest, fabs(shown[v].colour[axis] - between));
            moved += shown[v].colour[axis] != own;
        }
    }
    CHECK(moved > 0);
    CHECK(furthest < 1.01);
    free(still);
    free(shown);
    free(memory);
}

/// Levels 0 to 2 by scalar kernels, and the last of them by all.
static void test_mesh(const char *name, limn_bake_desc desc) {
    subject s;
    load(&s, name, desc);
    for (int mode = 0; mode < 2; mode++) {
        s.lighting.mode = (limn_light_mode)mode;
        for (uint32_t level = 0; level <= 2; level++)
            test_rows(&s, limn_kernels_select(0, LIMN_FAMILY_REPRODUCIBLE), level, level == 2);
        for (uint32_t isa = LIMN_ISA_SSE2; isa <= LIMN_ISA_NEON; isa <<= 1) {
            if (!(limn_isa_supported() & isa)) continue;
            for (int family = 0; family < 2; family++)
                test_rows(&s, limn_kernels_select(isa, (limn_family)family), 2, false);
        }
        test_alone(&s);
        test_morphing(&s);
    }
    unload(&s);
}

/// A mesh without normals is lit by those that the caller brings.
static void test_without_normals(void) {
    subject with, without;
    load(&with, "imp.obj", (limn_bake_desc){0});
    load_as(&without, "imp.obj", (limn_bake_desc){0});
    const limn_plan plans[2] = {limn_plan_uniform(&with.mesh, 3),
                                limn_plan_uniform(&without.mesh, 3)};
    const size_t count = (size_t)plans[0].vertex_count;
    uint32_t(*const colours)[2] = allocate(count, sizeof *colours);
    CHECK(!without.mesh.normals);
    for (int i = 0; i < 2; i++) {
        float *const positions = allocate(count, sizeof(float[3]));
        limn_evaluate(&plans[i], with.mesh.controls, 0, plans[i].patch_count,
                      &(limn_output){.vertices = positions,
                                     .control_normals = with.control_normals,
                                     .colours = &colours[0][i],
                                     .colour_stride = sizeof *colours,
                                     .lighting = &with.lighting});
        free(positions);
    }
    bool same = true;
    for (size_t v = 0; v < count; v++)
        same &= colours[v][0] == colours[v][1] && colours[v][0] != 0;
    CHECK(same);
    free(colours);
    unload(&with);
    unload(&without);
}

// ---- One face

static bool is_black(const vertex *v) {
    return v->colour[0] + v->colour[1] + v->colour[2] == 0;
}

/// A cube with flat sides: a spot above the middle of a patch reaches no corner of any, but rows
/// inside of that patch.
static void test_spot(limn_domain_kind domain) {
    const uint32_t patch = 3;
    subject s;
    make_cube(&s, domain);
    const limn_plan plan = limn_plan_uniform(&s.mesh, LIMN_LEVEL_MAX);
    const uint32_t row_count = s.mesh.domain->row_counts[LIMN_LEVEL_MAX];
    const uint32_t corner_count = s.mesh.domain->corner_count;
    vertex *const vertices = allocate((size_t)plan.vertex_count, sizeof *vertices);
    limn_light spot = {
        .kind = LIMN_LIGHT_SPOT, .colour = {1, 1, 1}, .inner_cosine = 0.99f, .outer_cosine = 0.97f};
    s.lighting = (limn_lighting){.lights = &spot, .light_count = 1};
    evaluate(&s, &plan, vertices);
    const vertex *const corners = vertices + (size_t)patch * row_count;
    for (int axis = 0; axis < 3; axis++) {
        for (uint32_t c = 0; c < corner_count; c++)
            spot.position[axis] += corners[c].position[axis] / (float)corner_count;
        spot.position[axis] += corners[0].normal[axis];
        spot.direction[axis] = -corners[0].normal[axis];
    }
    for (int mode = 0; mode < 2; mode++) {
        uint32_t lit = 0, lit_corners = 0, lit_others = 0;
        s.lighting.mode = (limn_light_mode)mode;
        evaluate(&s, &plan, vertices);
        for (uint32_t v = 0; v < plan.vertex_count; v++) {
            lit += !is_black(&vertices[v]);
            lit_corners += v % row_count < corner_count && !is_black(&vertices[v]);
            lit_others += v / row_count != patch && !is_black(&vertices[v]);
        }
        CHECK(lit > 8);
        CHECK_EQUAL(lit_corners, 0);
        CHECK_EQUAL(lit_others, 0);
    }
    free(vertices);
    unload(&s);
}

/// From above, what a cube with sharp edges has on top is white, and the rest black, up to the edges
/// that they share.
static void test_creases(limn_domain_kind domain) {
    subject s;
    make_cube(&s, domain);
    const limn_plan plan = limn_plan_uniform(&s.mesh, 3);
    vertex *const vertices = allocate((size_t)plan.vertex_count, sizeof *vertices);
    const limn_light above = {.colour = {1, 1, 1}, .direction = {0, -1, 0}};
    s.lighting = (limn_lighting){.lights = &above, .light_count = 1};
    for (int mode = 0; mode < 2; mode++) {
        uint32_t white = 0, wrong = 0;
        s.lighting.mode = (limn_light_mode)mode;
        evaluate(&s, &plan, vertices);
        for (uint32_t v = 0; v < plan.vertex_count; v++) {
            const bool top = vertices[v].normal[1] > 0.5f;
            white += top && vertices[v].colour[0] == 255;
            wrong += top ? vertices[v].colour[0] != 255 : !is_black(&vertices[v]);
        }
        CHECK(white > 0);
        CHECK_EQUAL(wrong, 0);
    }
    free(vertices);
    unload(&s);
}

/// A vertex at the very place of a light gets the other light that there is, and nothing of it.
static void test_at_the_light(void) {
    subject s;
    load(&s, "imp.obj", (limn_bake_desc){0});
    const limn_plan plan = limn_plan_uniform(&s.mesh, 0);
    vertex *const vertices = allocate((size_t)plan.vertex_count, sizeof *vertices);
    limn_light light = {
        .kind = LIMN_LIGHT_SPOT, .colour = {1, 1, 1}, .direction = {0, -1, 0}, .inner_cosine = 1};
    light.attenuation[2] = 1;
    s.lighting = (limn_lighting){.ambient = {1, 0.2f, 0}, .lights = &light, .light_count = 1};
    evaluate(&s, &plan, vertices);
    memcpy(light.position, vertices[1].position, sizeof light.position);
    evaluate(&s, &plan, vertices);
    CHECK_EQUAL(vertices[1].colour[0], 255);
    CHECK_EQUAL(vertices[1].colour[1], 51);
    CHECK_EQUAL(vertices[1].colour[2], 0);
    free(vertices);
    unload(&s);
}

static void test_refused(void) {
    static const limn_light good = {.kind = LIMN_LIGHT_SPOT, .direction = {0, 0, 1}};
    limn_light bad[9] = {good, good, good, good, good, good, good, good, good};
    bad[0].kind = (limn_light_kind)3;
    bad[1].colour[2] = NAN;
    bad[2].position[0] = INFINITY;
    bad[3].direction[0] = 0.1f;
    bad[4].attenuation[1] = -1;
    bad[5].attenuation[0] = NAN;
    bad[6].range = -1;
    bad[7].outer_cosine = 0.5f;
    bad[8].inner_cosine = 1.5f;
    for (uint32_t i = 0; i < 9; i++) {
        const limn_light lights[3] = {good, good, bad[i]};
        uint32_t index = 7;
        CHECK_EQUAL(limn_lights_check(lights, 2, &index), LIMN_OK);
        CHECK_EQUAL(index, 7);
        CHECK_EQUAL(limn_lights_check(lights, 3, &index), LIMN_ERROR_LIGHT);
        CHECK_EQUAL(index, 2);
    }
    CHECK_EQUAL(limn_lights_check(NULL, 0, NULL), LIMN_OK);
}

int main(void) {
    test_mesh("imp.obj", (limn_bake_desc){0});
    test_mesh("imp.obj", (limn_bake_desc){.isolate = LIMN_ISOLATE_ALWAYS});
    test_mesh("imp.obj", (limn_bake_desc){.scheme = LIMN_SCHEME_CATMARK});
    test_mesh("cube.off",
              (limn_bake_desc){.scheme = LIMN_SCHEME_CATMARK, .isolate = LIMN_ISOLATE_ALWAYS});
    test_mesh("sail.obj", (limn_bake_desc){0});
    test_mesh("../docs/box.obj", (limn_bake_desc){0});
    for (int domain = 0; domain < LIMN_DOMAIN_COUNT; domain++) {
        test_spot((limn_domain_kind)domain);
        test_creases((limn_domain_kind)domain);
    }
    test_without_normals();
    test_at_the_light();
    test_refused();
    return check_report();
}
