/* SPDX-License-Identifier: MIT */
/*
 * Loop's weights beside Warren's: how far the two surfaces of a mesh are apart, their curvature,
 * and what the tables take. Closed meshes, triangulated alike; everything at level 4.
 */
#include "bench.h"

#include "limn/bake.h"
#include "limn/format.h"
#include "limn/limn.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 153, VALENCE_MAX = 24 };

static const char help[] =
    "Usage: limn-bench weights MESH...\n\n"
    "Bakes each mesh with Loop's and with Warren's weights. Prints how far vertices at the same "
    "place\n"
    "of the surface are apart, of the diagonal; the integral of the squared mean curvature, which "
    "is\n"
    "the lower the fairer the surface, and 4 pi on a sphere; by valence the Gaussian curvature at\n"
    "control points, in 1 / diagonal^2; and the bytes of the tables. Boundaries are left out.\n";

/// A surface at level 4.
typedef struct surface {
    limn_baker *baker;
    limn_pack pack;
    limn_mesh mesh;
    float (*vertices)[3]; ///< [patch_count][ROWS]
    uint32_t *places;     ///< [patch_count][ROWS] equal for equal positions
    uint32_t place_count;
    double diagonal;
} surface;

static bool bake(const char *path, limn_weights weights, surface *s) {
    const void *blob;
    size_t size;
    *s = (surface){.baker = limn_baker_create(&(limn_bake_desc){
                       .weights = weights,
                       .repair = LIMN_REPAIR_ALL,
                       .non_manifold = LIMN_NON_MANIFOLD_SPLIT,
                   })};
    if (!s->baker || limn_baker_add_file(s->baker, path) != LIMN_BAKE_OK ||
        limn_baker_finish(s->baker, &blob, &size) != LIMN_BAKE_OK ||
        limn_pack_open(&s->pack, blob, size) != LIMN_OK) {
        fprintf(stderr, "limn-bench: %s\n", limn_baker_error(s->baker));
        return false;
    }
    s->mesh = limn_pack_mesh(&s->pack, 0);
    const limn_plan plan = limn_plan_uniform(&s->mesh, LIMN_LEVEL_MAX);
    s->vertices = malloc((size_t)plan.vertex_count * sizeof *s->vertices);
    s->places = malloc((size_t)plan.vertex_count * sizeof *s->places);
    if (!s->vertices || !s->places) abort();
    limn_evaluate(&plan, s->mesh.controls, 0, plan.patch_count,
                  &(limn_output){.vertices = s->vertices});
    for (int axis = 0; axis < 3; axis++)
        s->diagonal =
            hypot(s->diagonal, (double)s->mesh.bounds_max[axis] - (double)s->mesh.bounds_min[axis]);
    return true;
}

static void release(surface *s) {
    limn_baker_destroy(s->baker);
    free(s->vertices);
    free(s->places);
}

// ---- Places

typedef struct placed {
    float position[3];
    uint32_t vertex;
} placed;

static int compare_placed(const void *a, const void *b) {
    return memcmp(((const placed *)a)->position, ((const placed *)b)->position, 3 * sizeof(float));
}

static void find_places(surface *s) {
    const uint32_t count = s->mesh.patch_count * ROWS;
    placed *const sorted = malloc(count * sizeof *sorted);
    if (!sorted) abort();
    for (uint32_t v = 0; v < count; v++) {
        sorted[v].vertex = v;
        for (int axis = 0; axis < 3; axis++)
            sorted[v].position[axis] = s->vertices[v][axis] + 0.0f;
    }
    qsort(sorted, count, sizeof *sorted, compare_placed);
    for (uint32_t k = 0; k < count; k++) {
        s->place_count += k == 0 || compare_placed(&sorted[k - 1], &sorted[k]) != 0;
        s->places[sorted[k].vertex] = s->place_count - 1;
    }
    free(sorted);
}

// ---- Curvature

/// Around a place, summed over its triangles (Meyer, Desbrun, Schroeder and Barr 2003).
typedef struct curvature {
    double angle;     ///< all angles there
    double area;      ///< a third of the triangles'
    double normal[3]; ///< 4 H times the area, along the normal
} curvature;

static void subtract(const float *a, const float *b, double difference[3]) {
    for (int axis = 0; axis < 3; axis++)
        difference[axis] = (double)a[axis] - (double)b[axis];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double cross_length(const double a[3], const double b[3]) {
    return sqrt(fmax(0, dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b)));
}

static void add_triangle(const surface *s, const uint32_t corners[3], curvature *curvatures) {
    for (int c = 0; c < 3; c++) {
        const uint32_t at = corners[c], next = corners[(c + 1) % 3], last = corners[(c + 2) % 3];
        double u[3], v[3], across[3];
        subtract(s->vertices[next], s->vertices[at], u);
        subtract(s->vertices[last], s->vertices[at], v);
        subtract(s->vertices[next], s->vertices[last], across);
        const double twice_area = cross_length(u, v), cotangent = dot(u, v) / twice_area;
        curvature *const here = &curvatures[s->places[at]];
        if (!(twice_area > 0)) continue;
        here->angle += atan2(twice_area, dot(u, v));
        here->area += twice_area / 6;
        for (int axis = 0; axis < 3; axis++) { // the edge opposite, at both its ends
            curvatures[s->places[next]].normal[axis] += cotangent * across[axis];
            curvatures[s->places[last]].normal[axis] -= cotangent * across[axis];
        }
    }
}

static curvature *measure(surface *s) {
    find_places(s);
    curvature *const curvatures = calloc(s->place_count, sizeof *curvatures);
    const limn_domain *const domain = s->mesh.domain;
    if (!curvatures) abort();
    for (uint32_t p = 0; p < s->mesh.patch_count; p++) {
        for (uint32_t i = 0; i < domain->index_counts[LIMN_LEVEL_MAX]; i += 3) {
            const uint16_t *const rows = domain->indices[LIMN_LEVEL_MAX] + i;
            const uint32_t corners[3] = {p * ROWS + rows[0], p * ROWS + rows[1],
                                         p * ROWS + rows[2]};
            add_triangle(s, corners, curvatures);
        }
    }
    return curvatures;
}

static double gaussian(const curvature *c) {
    return (6.283185307179586 - c->angle) / c->area;
}

/// The integral of the squared mean curvature: H = |normal| / (4 area).
static double bending(const surface *s, const curvature *curvatures) {
    double sum = 0;
    for (uint32_t k = 0; k < s->place_count; k++) {
        const curvature *const c = &curvatures[k];
        if (c->area > 0) sum += dot(c->normal, c->normal) / (16 * c->area);
    }
    return sum;
}

typedef struct spread {
    uint32_t count;
    double sum, least, most;
} spread;

/// Of the Gaussian curvature at control points, by valence; at those with a boundary nothing is
/// said.
static void collect(const surface *s, const curvature *curvatures, spread spreads[VALENCE_MAX]) {
    bool *const seen = calloc(s->place_count, sizeof *seen);
    if (!seen) abort();
    for (uint32_t r = 0; r < s->mesh.run_count; r++) {
        const limn_file_run *const run = &s->mesh.runs[r];
        const limn_file_class *const class = &s->mesh.classes[run->class_index];
        for (uint32_t k = 0; k < 3 * run->patch_count; k++) {
            const uint32_t corner = k % 3, valence = class->valences[corner];
            const uint32_t place = s->places[(run->first_patch + k / 3) * ROWS + corner];
            if (seen[place] || class->boundary_corners >> corner & 1 || valence >= VALENCE_MAX)
                continue;
            seen[place] = true;
            const double value = gaussian(&curvatures[place]) * s->diagonal * s->diagonal;
            spread *const at = &spreads[valence];
            if (at->count == 0 || value < at->least) at->least = value;
            if (at->count == 0 || value > at->most) at->most = value;
            at->count++;
            at->sum += value;
        }
    }
    free(seen);
}

// ---- Both

/// Vertices at the same place of the mesh; patches may be in another order.
static void print_distance(const surface *loop, const surface *warren) {
    uint32_t *const patches = malloc(loop->mesh.face_count * sizeof *patches);
    double largest = 0, sum = 0;
    if (!patches) abort();
    for (uint32_t p = 0; p < warren->mesh.patch_count; p++)
        patches[limn_mesh_face(&warren->mesh, p).face] = p;
    for (uint32_t v = 0; v < loop->mesh.patch_count * ROWS; v++) {
        const uint32_t face = limn_mesh_face(&loop->mesh, v / ROWS).face;
        double difference[3];
        subtract(loop->vertices[v], warren->vertices[patches[face] * ROWS + v % ROWS], difference);
        const double distance = sqrt(dot(difference, difference)) / loop->diagonal;
        largest = fmax(largest, distance);
        sum += distance;
    }
    printf("  distance: largest %.3g, mean %.3g of the diagonal\n", largest,
           sum / (loop->mesh.patch_count * (double)ROWS));
    free(patches);
}

static uint64_t table_bytes(const limn_pack *pack, const limn_mesh *mesh) {
    uint64_t bytes = 0;
    for (uint32_t c = 0; c < pack->class_count; c++)
        bytes += limn_file_table_size(&mesh->classes[c]) * sizeof(float);
    return bytes;
}

static void print_curvature(surface *both) {
    spread spreads[2][VALENCE_MAX] = {0};
    double energies[2];
    for (int w = 0; w < 2; w++) {
        curvature *const curvatures = measure(&both[w]);
        energies[w] = bending(&both[w], curvatures);
        collect(&both[w], curvatures, spreads[w]);
        free(curvatures);
    }
    printf("  squared mean curvature: Loop %.4f, Warren %.4f\n", energies[0], energies[1]);
    for (int valence = 0; valence < VALENCE_MAX; valence++) {
        const spread *const a = &spreads[0][valence], *const b = &spreads[1][valence];
        if (a->count == 0) continue;
        printf("  Gaussian curvature, %4u of valence %2d: Loop %8.2f (%.2f to %.2f), "
               "Warren %8.2f (%.2f to %.2f)\n",
               a->count, valence, a->sum / a->count, a->least, a->most, b->sum / b->count, b->least,
               b->most);
    }
}

static bool compare(const char *path) {
    surface both[2];
    const bool good =
        bake(path, LIMN_WEIGHTS_LOOP, &both[0]) & bake(path, LIMN_WEIGHTS_WARREN, &both[1]);
    if (good) {
        printf("%s: %u faces\n", both[0].mesh.name, both[0].mesh.patch_count);
        print_distance(&both[0], &both[1]);
        print_curvature(both);
        printf("  tables: Loop %u classes, %llu bytes; Warren %u, %llu\n", both[0].pack.class_count,
               (unsigned long long)table_bytes(&both[0].pack, &both[0].mesh),
               both[1].pack.class_count,
               (unsigned long long)table_bytes(&both[1].pack, &both[1].mesh));
    }
    release(&both[0]);
    release(&both[1]);
    return good;
}

int bench_weights(int argc, char **argv) {
    static const struct option options[] = {{"help", no_argument, NULL, 'h'}, {0}};
    for (int option; (option = getopt_long(argc, argv, "h", options, NULL)) != -1;) {
        if (option != 'h') return 2;
        fputs(help, stdout);
        return 0;
    }
    bool good = optind < argc;
    if (!good) fputs(help, stderr);
    for (int i = optind; i < argc; i++)
        good &= compare(argv[i]);
    return good ? 0 : optind < argc ? 1 : 2;
}
