/* SPDX-License-Identifier: MIT */
/* A program that uses the installed runtime: loads a pack, evaluates its first mesh at level 2, and
 * checks it. */
#include <limn/limn.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEVEL = 2, ALIGNMENT = 64 };

static int fail(const char *text) {
    fprintf(stderr, "app: %s\n", text);
    return EXIT_FAILURE;
}

/// The whole file in aligned memory, or NULL.
static void *load(const char *path, size_t *size) {
    FILE *const file = fopen(path, "rb");
    if (!file) return NULL;
    void *bytes = NULL;
    if (fseek(file, 0, SEEK_END) == 0 && ftell(file) > 0) {
        *size = (size_t)ftell(file);
        bytes = aligned_alloc(ALIGNMENT, (*size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT);
        rewind(file);
        if (bytes && fread(bytes, 1, *size, file) != *size) {
            free(bytes);
            bytes = NULL;
        }
    }
    fclose(file);
    return bytes;
}

/// No coefficient is negative and they sum to 1: the surface stays within the control points'
/// bounds.
static int count_outside(const limn_mesh *mesh, const float *vertices, size_t vertex_count) {
    int outside = 0;
    for (size_t v = 0; v < 3 * vertex_count; v++) {
        const float low = mesh->bounds_min[v % 3], high = mesh->bounds_max[v % 3];
        const float slack = 1e-5f * (high - low);
        outside += !(vertices[v] >= low - slack && vertices[v] <= high + slack);
    }
    return outside;
}

int main(int argc, char **argv) {
    if (argc != 2) return fail("usage: app FILE.limn");
    size_t size = 0;
    void *const blob = load(argv[1], &size);
    if (!blob) return fail("cannot load the file");

    limn_pack pack;
    const limn_result result = limn_pack_open(&pack, blob, size);
    if (result != LIMN_OK) return fail(limn_result_text(result));
    const limn_mesh mesh = limn_pack_mesh(&pack, 0);
    const limn_plan plan = limn_plan_uniform(&mesh, LEVEL);
    const size_t vertex_count = (size_t)plan.vertex_count;
    float *const vertices = malloc(vertex_count * 3 * sizeof *vertices);
    if (!vertices) return fail("out of memory");
    memset(vertices, 0xff, vertex_count * 3 * sizeof *vertices); // not a number
    limn_evaluate(&plan, mesh.controls, 0, plan.patch_count, &(limn_output){.vertices = vertices});

    if (vertex_count != (size_t)mesh.patch_count * mesh.domain->row_counts[LEVEL])
        return fail("wrong vertex count");
    if (count_outside(&mesh, vertices, vertex_count) != 0)
        return fail("vertices outside of the bounds");
    printf("%s: meshes %u, patches %u, vertices %zu, width %.3f\n", mesh.name, pack.mesh_count,
           plan.patch_count, vertex_count, (double)(mesh.bounds_max[0] - mesh.bounds_min[0]));
    free(vertices);
    free(blob);
    return EXIT_SUCCESS;
}
