/* SPDX-License-Identifier: MIT */
/*
 * A program with its mesh inside: limn_bake(… C_ARRAY torus) makes C source of it. Nothing is read,
 * nothing is allocated. Writes the surface at level 2 to stdout, as an OBJ.
 */
#include <limn/limn.h>
#include <stdio.h>

extern const unsigned char torus[];
extern const size_t torus_size;

enum { LEVEL = 2, MAX_VERTICES = 1024 };

static void print_obj(const limn_plan *plan, float vertices[][3]) {
    const limn_domain *const domain = plan->mesh->domain;
    for (uint64_t v = 0; v < plan->vertex_count; v++)
        printf("v %.9g %.9g %.9g\n", vertices[v][0], vertices[v][1], vertices[v][2]);
    for (uint32_t p = 0; p < plan->patch_count; p++) {
        const uint64_t first = limn_plan_first_vertex(plan, p) + 1;
        const uint16_t *const indices = domain->indices[LEVEL];
        for (uint32_t i = 0; i < domain->index_counts[LEVEL]; i += 3)
            printf("f %llu %llu %llu\n", (unsigned long long)(first + indices[i]),
                   (unsigned long long)(first + indices[i + 1]),
                   (unsigned long long)(first + indices[i + 2]));
    }
}

int main(void) {
    static float vertices[MAX_VERTICES][3];
    limn_pack pack;
    const limn_result result = limn_pack_open(&pack, torus, torus_size);
    if (result != LIMN_OK) {
        fprintf(stderr, "%s\n", limn_result_text(result));
        return 1;
    }
    const limn_mesh mesh = limn_pack_mesh(&pack, 0);
    const limn_plan plan = limn_plan_uniform(&mesh, LEVEL);
    if (plan.vertex_count > MAX_VERTICES) return 1;
    limn_evaluate(&plan, mesh.controls, 0, plan.patch_count, &(limn_output){.vertices = vertices});
    print_obj(&plan, vertices);
    return 0;
}
