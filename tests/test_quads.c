/* SPDX-License-Identifier: MIT */
/*
 * Meshes of quads, in files made here: with tables and in pieces, divided before or not. Their rows
 * beside the surface, whole frames by bits, culling with negative coefficients, and damage.
 */
#include "check.h"
#include "quads.h"

#include <math.h>

static const quad_kind kinds[4] = {{false, false}, {true, false}, {false, true}, {true, true}};

static quad_torus torus;
static uint32_t state = 99;

static uint32_t next_random(void) {
    state = state * 1664525u + 1013904223u;
    return state >> 8;
}

static float random_float(float low, float high) {
    return low + (high - low) * (float)next_random() / 16777216.0f;
}

static void *allocate(size_t size) {
    void *const memory = malloc(size);
    if (!memory) abort();
    return memory;
}

// ---- The surface

/// At (u, v) in the grid of control points, and what it is by either.
static void surface_at(double u, double v, double at[3][3]) {
    const int first_u = (int)floor(u), first_v = (int)floor(v);
    const double s = u - first_u, t = v - first_v;
    const double bu[2][4] = {
        {(1 - s) * (1 - s) * (1 - s) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
         (-3 * s * s * s + 3 * s * s + 3 * s + 1) / 6, s * s * s / 6},
        {-(1 - s) * (1 - s) / 2, (3 * s * s - 4 * s) / 2, (-3 * s * s + 2 * s + 1) / 2, s * s / 2}};
    const double bv[2][4] = {
        {(1 - t) * (1 - t) * (1 - t) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
         (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6},
        {-(1 - t) * (1 - t) / 2, (3 * t * t - 4 * t) / 2, (-3 * t * t + 2 * t + 1) / 2, t * t / 2}};
    memset(at, 0, 3 * sizeof *at);
    for (int k = 0; k < 16; k++) {
        const int a = k % 4, b = k / 4;
        const grid_point p = {first_u + a - 1, first_v + b - 1};
        const float *const point = torus.points[control_at(&torus, p)];
        for (int axis = 0; axis < 3; axis++) {
            at[0][axis] += bu[0][a] * bv[0][b] * (double)point[axis];
            at[1][axis] += bu[1][a] * bv[0][b] * (double)point[axis];
            at[2][axis] += bu[0][a] * bv[1][b] * (double)point[axis];
        }
    }
}

static void exact_vertex(uint32_t packed_face, limn_row row, double vertex[6]) {
    const uint32_t face = packed_face >> 2, u = face % torus.size, v = face / torus.size;
    const grid_point p = in_grid(u, v, packed_face & 3, 16, (grid_point){row.i, row.j});
    const double scale = (torus.kind.divided ? 2 : 1) * 16.0;
    double at[3][3], length = 0;
    surface_at(p.u / scale, p.v / scale, at);
    for (int axis = 0; axis < 3; axis++) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        vertex[axis] = at[0][axis];
        vertex[3 + axis] = at[1][a] * at[2][b] - at[1][b] * at[2][a];
        length += vertex[3 + axis] * vertex[3 + axis];
    }
    for (int axis = 3; axis < 6; axis++)
        vertex[axis] /= sqrt(length);
}

typedef struct drawing {
    const limn_mesh *mesh;
    float *normals;       ///< of base vertices
    float (*vertices)[6]; ///< positions and normals
} drawing;

static void draw(const drawing *d, const limn_plan *plan) {
    limn_mesh_control_normals(d->mesh, d->mesh->controls, d->normals);
    limn_evaluate(plan, d->mesh->controls, 0, plan->patch_count,
                  &(limn_output){.vertices = d->vertices[0],
                                 .stride = 24,
                                 .normals = d->vertices[0] + 3,
                                 .normal_stride = 24,
                                 .control_normals = d->normals});
}

/// Rows of all levels are on the surface.
static void test_surface(const drawing *d) {
    double furthest = 0, turned = 0;
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        const limn_plan plan = limn_plan_uniform(d->mesh, level);
        draw(d, &plan);
        for (uint32_t patch = 0; patch < plan.patch_count; patch++) {
            const float(*const rows)[6] =
                (const float(*)[6])d->vertices + limn_plan_first_vertex(&plan, patch);
            for (uint32_t row = 0; row < d->mesh->domain->row_counts[level]; row++) {
                double exact[6];
                exact_vertex(d->mesh->faces[patch], d->mesh->domain->rows[row], exact);
                for (int k = 0; k < 6; k++) {
                    double *const largest = k < 3 ? &furthest : &turned;
                    *largest = fmax(*largest, fabs((double)rows[row][k] - exact[k]));
                }
            }
        }
    }
    CHECK(furthest < 2e-6);
    CHECK(turned < 1e-5);
}

// ---- What the runtime says of the mesh

static void test_mesh(const limn_mesh *mesh) {
    const uint32_t control_count = SIZE * SIZE, base_count = torus.size * torus.size;
    CHECK(mesh->domain == limn_domain_get(LIMN_DOMAIN_QUAD));
    CHECK_EQUAL(mesh->control_count, control_count);
    CHECK_EQUAL(mesh->base_first, torus.kind.divided ? control_count : 0);
    CHECK_EQUAL(mesh->base_count, base_count);
    CHECK_EQUAL(mesh->point_count, torus.point_count);
    CHECK_EQUAL(mesh->normal_count, base_count);
    for (uint32_t patch = 0; patch < mesh->patch_count; patch++) {
        static const grid_point places[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        const limn_patch_face face = limn_mesh_face(mesh, patch);
        const uint32_t u = face.face % torus.size, v = face.face / torus.size;
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(mesh, patch, corners);
        for (uint32_t c = 0; c < 4; c++) {
            const grid_point p = places[(c + face.rotation) % 4];
            CHECK_EQUAL(corners[c], base_at(&torus, (grid_point){(int)u + p.u, (int)v + p.v}));
        }
    }
}

/// The points behind the control points, by every kernel of either family.
static void test_refine(limn_mesh mesh) {
    const size_t size = mesh.point_count * sizeof(float[3]);
    float *const points = allocate(size);
    for (uint32_t isa = LIMN_ISA_SCALAR; isa <= limn_isa_supported(); isa <<= 1) {
        mesh.kernels = limn_kernels_select(isa, LIMN_FAMILY_FAST);
        memset(points, 0, size);
        memcpy(points, mesh.controls, mesh.control_count * sizeof(float[3]));
        limn_mesh_refine(&mesh, points);
        CHECK(memcmp(points, mesh.controls, size) == 0);
    }
    free(points);
}

// ---- Frames

static uint16_t indices[1000000];
static limn_template templates[979];

static uint64_t mix(uint64_t hash, uint64_t word) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 29;
}

static uint64_t hash_vertex(const float vertex[6]) {
    uint32_t words[6];
    uint64_t hash = 1;
    memcpy(words, vertex, sizeof words);
    for (int w = 0; w < 6; w++)
        hash = mix(hash, words[w]);
    return hash;
}

/// 0 where each directed edge between vertices, which are the same if all their bits are, has its
/// opposite.
static uint64_t sum_edges(const float (*vertices)[6], const limn_template *template) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < template->index_count; i += 3) {
        const uint16_t *const corner = indices + template->first_index + i;
        for (uint32_t c = 0; c < 3; c++) {
            const uint64_t a = hash_vertex(vertices[corner[c]]);
            const uint64_t b = hash_vertex(vertices[corner[(c + 1) % 3]]);
            sum += mix(mix(0, a), b) - mix(mix(0, b), a);
        }
    }
    return sum;
}

static void check_closed(const drawing *d, const limn_plan *plan) {
    uint64_t sum = 0;
    draw(d, plan);
    for (uint32_t p = 0; p < plan->patch_count; p++) {
        const limn_plan_patch *const item = &plan->patches[p];
        sum += sum_edges((const float(*)[6])d->vertices + item->first_vertex,
                         &templates[item->template_index]);
    }
    CHECK(sum == 0);
}

/// Any level on any edge, the same on both sides.
static void scramble(limn_plan *plan, limn_plan_patch *patches) {
    const uint32_t salt = next_random();
    plan->vertex_count = 0;
    for (uint32_t p = 0; p < plan->patch_count; p++) {
        limn_plan_patch *const item = &patches[p];
        uint32_t corners[LIMN_CORNER_MAX];
        float highest = 0;
        limn_mesh_corners(plan->mesh, item->patch, corners);
        for (uint32_t e = 0; e < 4; e++) {
            const uint32_t a = corners[e], b = corners[(e + 1) % 4];
            const uint64_t hash = mix(mix(salt, a < b ? a : b), a < b ? b : a);
            const float level = (float)(hash >> 40) / 16777216.0f * 4;
            highest = level > highest ? level : highest;
            item->edge_levels[e] = (uint8_t)ceilf(level);
            item->edge_morphs[e] = level > 0 ? level - ceilf(level) + 1 : 1;
        }
        item->level = (uint8_t)ceilf(highest);
        item->morph = highest > 0 ? highest - ceilf(highest) + 1 : 1;
        item->template_index =
            (uint16_t)limn_template_find(plan->mesh->domain, item->level, item->edge_levels);
        item->first_vertex = (uint32_t)plan->vertex_count;
        plan->vertex_count += plan->mesh->domain->row_counts[item->level];
    }
}

static limn_view random_view(float extent) {
    const float eye[3] = {random_float(-9, 9), random_float(-9, 9), random_float(4, 9)};
    const float target[3] = {random_float(-3, 3), random_float(-3, 3), 0}, up[3] = {0.1f, 1, 0};
    return limn_view_orthographic(eye, target, up, extent, 640, 480, 1, 40);
}

/// Levels by length follow from the base vertices at the ends of an edge.
static void check_levels(const limn_plan *plan, const limn_view *view, float pixels) {
    bool right = true;
    for (uint32_t p = 0; p < plan->patch_count; p++) {
        const limn_plan_patch *const item = &plan->patches[p];
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(plan->mesh, item->patch, corners);
        for (uint32_t e = 0; e < 4; e++) {
            const float *const a = plan->mesh->controls + 3 * (size_t)corners[e];
            const float *const b = plan->mesh->controls + 3 * (size_t)corners[(e + 1) % 4];
            double square = 0;
            for (int axis = 0; axis < 3; axis++)
                square += ((double)a[axis] - (double)b[axis]) * ((double)a[axis] - (double)b[axis]);
            const double wanted = log2(sqrt(square) * (double)(view->pixels / pixels));
            const double level = item->edge_levels[e] - 1 + (double)item->edge_morphs[e];
            right &= fabs(level - fmin(fmax(wanted, 0), 4)) < 0.02;
        }
    }
    CHECK(right);
}

/// By length, by error, and any levels; the whole torus is in view.
static void test_frames(const drawing *d, void *memory) {
    uint32_t levels = 0;
    for (uint32_t frame = 0; frame < 12; frame++) {
        const limn_view view = random_view(20);
        const limn_lod_desc desc = {.lod = frame % 2 ? LIMN_LOD_ERROR : LIMN_LOD_LENGTH,
                                    .pixels = frame % 2 ? random_float(0.01f, 0.5f)
                                                        : random_float(0.5f, 12)};
        limn_plan plan =
            limn_plan_build(d->mesh, d->mesh->controls, &view, 1, &desc, templates, memory);
        CHECK_EQUAL(plan.patch_count, d->mesh->patch_count);
        if (desc.lod == LIMN_LOD_LENGTH) check_levels(&plan, &view, desc.pixels);
        uint64_t index_count = 0;
        for (uint32_t p = 0; p < plan.patch_count; p++) {
            index_count += templates[plan.patches[p].template_index].index_count;
            levels |= 1u << plan.patches[p].level;
        }
        CHECK_EQUAL(index_count, plan.index_count);
        check_closed(d, &plan);
        scramble(&plan, memory);
        check_closed(d, &plan);
    }
    CHECK(levels >= 1u << 3); // fine ones, too
}

/// All patches at level 0, of two triangles each.
static void test_coarsest(const drawing *d) {
    const limn_plan plan = limn_plan_uniform(d->mesh, 0);
    draw(d, &plan);
    uint64_t sum = 0;
    const limn_template whole = {0, 6};
    CHECK(memcmp(indices, d->mesh->domain->indices[0], 6 * sizeof *indices) == 0);
    for (uint32_t p = 0; p < plan.patch_count; p++)
        sum += sum_edges((const float(*)[6])d->vertices + 4 * (size_t)p, &whole);
    CHECK(sum == 0);
}

// ---- Culling

/// How far a patch reaches over a plane, at most.
static double reach(const limn_mesh *mesh, uint32_t patch, const float plane[4], double negative) {
    const uint32_t count = mesh->classes->control_count;
    double high = -INFINITY, low = INFINITY;
    for (uint32_t k = 0; k < count; k++) {
        const float *const point = mesh->controls + 3 * (size_t)mesh->indices[patch * count + k];
        double side = (double)plane[3];
        for (int axis = 0; axis < 3; axis++)
            side += (double)plane[axis] * (double)point[axis];
        high = fmax(high, side);
        low = fmin(low, side);
    }
    return high + negative * (high - low);
}

/// Patches are left out if, and but for rounding only if, all they may reach is outside.
static void check_culling(const limn_mesh *mesh, float negative, void *memory, uint32_t *kept) {
    const limn_view views[2] = {random_view(0.3f), random_view(0.3f)};
    const limn_plan plan = limn_plan_build(mesh, mesh->controls, views, 2, NULL, NULL, memory);
    uint32_t next = 0;
    for (uint32_t patch = 0; patch < mesh->patch_count; patch++) {
        double best = -INFINITY; // over the views, of the worst plane
        for (uint32_t v = 0; v < 2; v++) {
            double worst = INFINITY;
            for (uint32_t k = 0; k < views[v].plane_count; k++)
                worst = fmin(worst, reach(mesh, patch, views[v].planes[k], (double)negative));
            best = fmax(best, worst);
        }
        const bool drawn = next < plan.patch_count && plan.patches[next].patch == patch;
        next += drawn;
        if (fabs(best) > 1e-4) CHECK_EQUAL(drawn, best > 0);
    }
    *kept += plan.patch_count;
}

/// The same views with several bounds, which keep more and more.
static void test_culling(const blob *file, void *memory) {
    uint32_t last = 0;
    for (int step = 0; step < 3; step++) {
        uint32_t kept = 0;
        limn_pack pack;
        classes_of(file)->negative = (float)step / 8;
        fix_checksum(file);
        if (!CHECK_EQUAL(limn_pack_open(&pack, file->bytes, file->size), LIMN_OK)) return;
        const limn_mesh mesh = limn_pack_mesh(&pack, 0);
        state = 7;
        for (int view = 0; view < 20; view++)
            check_culling(&mesh, (float)step / 8, memory, &kept);
        CHECK(kept > last && (step > 0 || kept < 20 * mesh.patch_count));
        last = kept;
    }
}

// ---- Damage

static limn_file_piece *pieces_of(const blob *file) {
    return chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_PIECES);
}
static limn_file_term *first_term(const blob *file, uint32_t point) {
    const uint32_t *const stencils = chunk_data(file, 0, LIMN_CHUNK_STENCILS);
    limn_file_term *const terms = chunk_data(file, 0, LIMN_CHUNK_TERMS);
    return terms + stencils[point - SIZE * SIZE];
}
static uint32_t *last_ring(const blob *file) {
    const limn_file_chunk *const chunk = find_chunk(file, 0, LIMN_CHUNK_RINGS);
    return (uint32_t *)chunk_data(file, 0, LIMN_CHUNK_RINGS) + chunk->size / sizeof(uint32_t) - 1;
}

static void class_pairs(const blob *file) {
    classes_of(file)->pair_count = 1;
}
static void class_of_triangles(const blob *file) {
    classes_of(file)->domain = LIMN_DOMAIN_TRIANGLE;
}
/// Not damage: quads have four.
static void face_rotation(const blob *file) {
    faces_of(file, 0)[0] |= 3;
}
static void hole_count(const blob *file) {
    record_of(file, 0)->hole_count = UINT32_MAX;
}
static const damage of_tables[] = {
    DAMAGE(class_pairs, LIMN_ERROR_CLASS),
    DAMAGE(class_of_triangles, LIMN_ERROR_RUN),
    DAMAGE(face_rotation, LIMN_OK),
    DAMAGE(hole_count, LIMN_ERROR_MESH),
};

static void piece_in_middle(const blob *file) {
    pieces_of(file)->kind = 1;
}
static void piece_of_triangles(const blob *file) {
    pieces_of(file)->domain = LIMN_DOMAIN_TRIANGLE;
}
static const damage of_pieces[] = {
    DAMAGE(piece_in_middle, LIMN_ERROR_PIECE),
    DAMAGE(piece_of_triangles, LIMN_ERROR_PIECE),
    DAMAGE(class_pairs, LIMN_ERROR_PIECE),
};

static void divided_too_few(const blob *file) {
    record_of(file, 0)->divided_count--;
}
static void divided_too_many(const blob *file) {
    record_of(file, 0)->divided_count++;
}
/// A corner that is a control point of the mesh before.
static void corner_before_base(const blob *file) {
    const uint8_t *const slots = chunk_data(file, 0, LIMN_CHUNK_SLOTS);
    indices_of(file, 0)[slots[0]] = torus.base_first - 1;
}
static void term_of_itself(const blob *file) {
    first_term(file, torus.base_first + 2)->point = torus.base_first + 2;
}
static void term_of_later_point(const blob *file) {
    first_term(file, torus.base_first + 2)->point = torus.point_count - 1;
}
/// Not damage.
static void term_of_point_before(const blob *file) {
    first_term(file, torus.base_first + 2)->point = torus.base_first + 1;
}
static void ring_beyond_base(const blob *file) {
    *last_ring(file) = torus.fine_first;
}
/// Not damage.
static void ring_of_last_base(const blob *file) {
    *last_ring(file) = torus.fine_first - 1;
}
static const damage of_divided[] = {
    DAMAGE(term_of_itself, LIMN_ERROR_STENCIL), DAMAGE(term_of_later_point, LIMN_ERROR_STENCIL),
    DAMAGE(term_of_point_before, LIMN_OK),      DAMAGE(ring_beyond_base, LIMN_ERROR_NORMALS),
    DAMAGE(ring_of_last_base, LIMN_OK),         DAMAGE(corner_before_base, LIMN_ERROR_INDEX),
};
/// Where no further points follow, the count of base vertices follows from the others.
static const damage of_divided_alone[] = {
    DAMAGE(divided_too_few, LIMN_ERROR_MESH),
    DAMAGE(divided_too_many, LIMN_ERROR_MESH),
};
static const damage of_divided_pieces[] = {
    DAMAGE(divided_too_few, LIMN_ERROR_INDEX),
    DAMAGE(divided_too_many, LIMN_ERROR_INDEX),
};

static void test_damages(const blob *file) {
    const quad_kind kind = torus.kind;
    if (kind.isolated) {
        check_damages(file, of_pieces, COUNT(of_pieces));
    } else {
        check_damages(file, of_tables, COUNT(of_tables));
    }
    if (!kind.divided) return;
    check_damages(file, of_divided, COUNT(of_divided));
    if (kind.isolated) {
        check_damages(file, of_divided_pieces, COUNT(of_divided_pieces));
    } else {
        check_damages(file, of_divided_alone, COUNT(of_divided_alone));
    }
}

/// Any word at the limits of its type, of all records and of some of the long lists.
static void test_mended_words(quad_kind kind) {
    static const uint32_t values[] = {0, 1, 3, 0xffff, 0x3fffffff, 0x80000000, 0xffffffff};
    const blob file = make_quads(&torus, kind, 2);
    const limn_file_chunk *const chunks = directory_of(&file);
    for (uint32_t c = 0; c < header_of(&file)->chunk_count; c++) {
        const size_t words = (size_t)chunks[c].size / 4, step = 1 + words / 24;
        for (size_t at = 0; at < words; at += step) {
            for (size_t v = 0; v < COUNT(values); v++) {
                const blob changed = copy_blob(&file, file.size);
                memcpy(changed.bytes + chunks[c].offset + 4 * at, &values[v], sizeof values[v]);
                check_safe(&changed);
                free(changed.bytes);
            }
        }
    }
    free(file.bytes);
}

static void test_kind(quad_kind kind) {
    const blob file = make_quads(&torus, kind, PATCHES_MAX);
    limn_pack pack;
    if (!CHECK_EQUAL(limn_pack_open(&pack, file.bytes, file.size), LIMN_OK)) return;
    limn_mesh mesh = limn_pack_mesh(&pack, 0);
    const drawing d = {.mesh = &mesh,
                       .normals = allocate(mesh.normal_count * sizeof(float[3])),
                       .vertices = allocate(mesh.patch_count * 289 * sizeof(float[6]))};
    void *const memory = allocate(limn_plan_size(&mesh));
    test_mesh(&mesh);
    test_refine(mesh);
    for (uint32_t isa = LIMN_ISA_SCALAR; isa <= limn_isa_supported(); isa <<= 1) {
        mesh.kernels = limn_kernels_select(isa, LIMN_FAMILY_REPRODUCIBLE);
        test_surface(&d);
        test_coarsest(&d);
        test_frames(&d, memory);
    }
    test_culling(&file, memory);
    test_damages(&file);
    free(d.normals);
    free(d.vertices);
    free(memory);
    free(file.bytes);
}

int main(void) {
    limn_templates_write(limn_domain_get(LIMN_DOMAIN_QUAD), LIMN_TOPOLOGY_TRIANGLES, 2, indices,
                         templates);
    for (size_t k = 0; k < COUNT(kinds); k++) {
        test_kind(kinds[k]);
        test_mended_words(kinds[k]);
    }
    return check_report();
}
