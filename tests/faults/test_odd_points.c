/* SPDX-License-Identifier: MIT */
/*
 * Control points that no modeller made, at run time: refined, planned, evaluated with normals and
 * light, in every format, with every kernel. Nothing hangs or writes outside of its buffer, plans
 * stay plans, and patches that do not use an odd point have the bits that they have without it.
 *
 * usage: test_odd_points FILE.limn...      meshes with normals
 */
#include "../check.h"
#include "blob_file.h"

#include "limn/format.h"
#include "limn/limn.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { GUARD = 64, VERTEX_SIZE = 28, ODD_KINDS = 9 };

static const float odd_values[ODD_KINDS] = {NAN,     INFINITY, -INFINITY, 1e30f, FLT_MAX,
                                            -1e-39f, 1e-45f,   3,         1e19f};

// ---- Buffers with guards around them

static unsigned char *guarded(size_t size) {
    unsigned char *const memory = malloc(size + 2 * GUARD);
    if (!memory) abort();
    memset(memory, 0xa5, size + 2 * GUARD);
    return memory + GUARD;
}

static void release(unsigned char *bytes, size_t size) {
    bool whole = true;
    for (size_t g = 0; g < GUARD; g++)
        whole &= bytes[size + g] == 0xa5 && (bytes - GUARD)[g] == 0xa5;
    CHECK(whole);
    free(bytes - GUARD);
}

// ---- A frame of a mesh

typedef struct frame {
    const limn_mesh *mesh;
    unsigned char *points, *normals, *plan_memory, *vertices;
    size_t points_size, normals_size, plan_size, vertices_size;
    limn_plan plan;
} frame;

static limn_plan make_plan(const frame *f, int kind) {
    static const float eye[3] = {0.5f, 2, 3}, target[3] = {0}, up[3] = {0, 1, 0};
    static const limn_lod_desc descs[] = {{.lod = LIMN_LOD_LENGTH},
                                          {.lod = LIMN_LOD_ERROR},
                                          {.lod = LIMN_LOD_LENGTH, .vertex_budget = 500}};
    if (kind == 0) return limn_plan_uniform(f->mesh, 3);
    limn_view view = limn_view_perspective(eye, target, up, 1, 640, 480, 0.01f, 1000);
    if (kind != 2) view.plane_count = 0; // nothing is left out
    return limn_plan_build(f->mesh, (const float *)(const void *)f->points, &view, 1,
                           &descs[kind - 1], NULL, f->plan_memory);
}

static void check_plan(const limn_plan *plan) {
    uint64_t vertex = 0;
    bool right = plan->patch_count <= plan->mesh->patch_count;
    for (uint32_t p = 0; plan->patches && p < plan->patch_count; p++) {
        const limn_plan_patch *const patch = &plan->patches[p];
        right &= patch->patch < plan->mesh->patch_count && patch->level <= LIMN_LEVEL_MAX &&
                 patch->first_vertex == vertex && patch->morph >= 0 && patch->morph <= 1;
        for (uint32_t e = 0; e < plan->mesh->domain->corner_count; e++)
            right &= patch->edge_levels[e] <= patch->level && patch->edge_morphs[e] >= 0 &&
                     patch->edge_morphs[e] <= 1;
        vertex += plan->mesh->domain->row_counts[patch->level > 4 ? 4 : patch->level];
    }
    CHECK(right);
    CHECK(!plan->patches || vertex == plan->vertex_count);
}

static const limn_light lights[] = {
    {.kind = LIMN_LIGHT_DIRECTIONAL, .colour = {1, 1, 1}, .direction = {0, -1, 0}},
    {.kind = LIMN_LIGHT_SPOT,
     .colour = {1, 2, 3},
     .position = {0, 1, 2},
     .direction = {0, 0, -1},
     .attenuation = {0, 0, 1},
     .range = 5,
     .inner_cosine = 0.9f,
     .outer_cosine = 0.5f}};

static void evaluate(frame *f, bool packed) {
    const limn_lighting lighting = {.mode = packed ? LIMN_LIGHT_INTERPOLATED : LIMN_LIGHT_EXACT,
                                    .lights = lights,
                                    .light_count = sizeof lights / sizeof *lights};
    f->vertices_size = (size_t)f->plan.vertex_count * VERTEX_SIZE;
    f->vertices = guarded(f->vertices_size);
    limn_output output = {.vertices = f->vertices,
                          .stride = VERTEX_SIZE,
                          .normals = f->vertices + 12,
                          .normal_stride = VERTEX_SIZE,
                          .colours = f->vertices + 24,
                          .colour_stride = VERTEX_SIZE,
                          .control_normals = (const float *)(const void *)f->normals,
                          .lighting = &lighting};
    if (packed) {
        output.position_format = LIMN_POSITION_UNORM16X4;
        output.normal_format = LIMN_NORMAL_OCT8X2;
    }
    limn_evaluate(&f->plan, (const float *)(const void *)f->points, 0, f->plan.patch_count,
                  &output);
}

/// controls  [mesh->control_count][3]
static frame draw(const limn_mesh *mesh, const float *controls, int plan_kind, bool packed) {
    frame f = {.mesh = mesh,
               .points_size = mesh->point_count * sizeof(float[3]),
               .normals_size = mesh->normal_count * sizeof(float[3]),
               .plan_size = limn_plan_size(mesh)};
    f.points = guarded(f.points_size);
    f.normals = guarded(f.normals_size);
    f.plan_memory = guarded(f.plan_size);
    memcpy(f.points, controls, mesh->control_count * sizeof(float[3]));
    limn_mesh_refine(mesh, (float *)(void *)f.points);
    limn_mesh_control_normals(mesh, (const float *)(const void *)f.points,
                              (float *)(void *)f.normals);
    f.plan = make_plan(&f, plan_kind);
    check_plan(&f.plan);
    evaluate(&f, packed);
    return f;
}

static void end(frame *f) {
    release(f->points, f->points_size);
    release(f->normals, f->normals_size);
    release(f->plan_memory, f->plan_size);
    release(f->vertices, f->vertices_size);
}

// ---- All points odd

static void test_all(const limn_mesh *mesh, float value, float *controls) {
    for (uint32_t c = 0; c < 3 * mesh->control_count; c++)
        controls[c] = value;
    for (int kind = 0; kind < 4; kind++) {
        frame f = draw(mesh, controls, kind, kind % 2);
        end(&f);
    }
}

// ---- One point odd

/// Which points follow from the odd one.
static void spread(const limn_mesh *mesh, bool *odd) {
    for (uint32_t p = mesh->control_count; p < mesh->point_count; p++) {
        const uint32_t k = p - mesh->control_count;
        for (uint32_t t = mesh->stencils[k]; t < mesh->stencils[k + 1]; t++)
            odd[p] |= odd[mesh->terms[t].point];
    }
}

static void mark_patches(const limn_mesh *mesh, const bool *odd, bool *spoilt) {
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        const limn_file_run *const run = &mesh->runs[r];
        const uint32_t count = mesh->classes[run->class_index].control_count;
        const uint32_t *index = mesh->indices + run->first_index;
        for (uint32_t p = 0; p < run->patch_count; p++) {
            for (uint32_t k = 0; k < count; k++)
                spoilt[run->first_patch + p] |= odd[*index++];
        }
    }
}

/// Where a patch of the plan is in its vertices.
static const unsigned char *vertices_of(const frame *f, uint32_t p, size_t *size) {
    const uint32_t level = f->plan.patches ? f->plan.patches[p].level : f->plan.level;
    *size = (size_t)f->mesh->domain->row_counts[level] * VERTEX_SIZE;
    return f->vertices + limn_plan_first_vertex(&f->plan, p) * VERTEX_SIZE;
}

/// Returns how many patches are as they were.
static uint32_t compare(const frame *expected, const frame *actual, const bool *spoilt) {
    uint32_t same = 0, tried = 0;
    if (!CHECK_EQUAL(actual->plan.patch_count, expected->plan.patch_count)) return 0;
    for (uint32_t p = 0; p < expected->plan.patch_count; p++) {
        const uint32_t patch = expected->plan.patches ? expected->plan.patches[p].patch : p;
        size_t size, expected_size;
        if (spoilt[patch]) continue;
        const unsigned char *const now = vertices_of(actual, p, &size);
        const unsigned char *const before = vertices_of(expected, p, &expected_size);
        tried++;
        same += size == expected_size && memcmp(now, before, size) == 0;
    }
    CHECK_EQUAL(same, tried);
    return same;
}

static uint32_t test_one(const limn_mesh *mesh, float value, uint32_t control, float *controls) {
    bool *const odd = calloc(mesh->point_count + mesh->patch_count, 1);
    bool *const spoilt = odd + mesh->point_count;
    uint32_t same = 0;
    if (!odd) abort();
    odd[control] = true;
    spread(mesh, odd);
    mark_patches(mesh, odd, spoilt);
    for (int kind = 0; kind < 2; kind++) {
        memcpy(controls, mesh->controls, mesh->control_count * sizeof(float[3]));
        frame expected = draw(mesh, controls, kind, false);
        controls[3 * control + 1] = value;
        frame actual = draw(mesh, controls, kind, false);
        same += compare(&expected, &actual, spoilt);
        end(&expected);
        end(&actual);
    }
    free(odd);
    return same;
}

static void test_mesh(const limn_mesh *mesh) {
    float *const controls = malloc(mesh->control_count * sizeof(float[3]));
    uint32_t same = 0;
    if (!controls) abort();
    for (int kind = 0; kind < ODD_KINDS; kind++) {
        const uint32_t control = (uint32_t)kind * 7 % mesh->control_count;
        test_all(mesh, odd_values[kind], controls);
        same += test_one(mesh, odd_values[kind], control, controls);
    }
    CHECK(same > 100);
    free(controls);
}

static void test_file(const char *path) {
    char error[1024];
    limni_blob_file file;
    limn_pack pack;
    if (!CHECK(limni_blob_file_open(&file, path, error, sizeof error))) return;
    if (CHECK(limn_pack_open(&pack, file.bytes, file.size) == LIMN_OK)) {
        for (uint32_t isa = LIMN_ISA_SCALAR; isa <= LIMN_ISA_NEON; isa <<= 1) {
            if (!(limn_isa_supported() & isa)) continue;
            for (int family = LIMN_FAMILY_REPRODUCIBLE; family <= LIMN_FAMILY_FAST; family++) {
                pack.kernels = limn_kernels_select(isa, (limn_family)family);
                const limn_mesh mesh = limn_pack_mesh(&pack, 0);
                test_mesh(&mesh);
            }
        }
    }
    limni_blob_file_close(&file);
}

int main(int argc, char **argv) {
    for (int i = 1; i < argc; i++)
        test_file(argv[i]);
    return check_report();
}
