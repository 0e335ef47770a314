/* SPDX-License-Identifier: MIT */
/*
 * Lomont's Figure 3: a cube with one face missing, its corners of varying sharpness. Writes the cube
 * and six levels of it, cube_0.obj to cube_6.obj, into a folder; the last at its limit.
 */
#include "tagged.h"

#include <stdio.h>
#include <stdlib.h>

/// The cube from 0 to 1, open at the top. The vertex at (x, y, z) is x + 2 y + 4 z.
static random_mesh make_cube(void) {
    static const uint32_t faces[10][3] = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {1, 3, 7},
                                          {1, 7, 5}, {3, 2, 6}, {3, 6, 7}, {2, 0, 4}, {2, 4, 6}};
    static const float weights[8] = {0, 0.5f, 1, 2, 0, 1, 2, INFINITY};
    random_mesh cube = {.face_count = 10};
    memcpy(cube.faces, faces, sizeof faces);
    memcpy(cube.vertex_weights, weights, sizeof weights);
    for (int v = 0; v < 8; v++)
        random_mesh_add_vertex(&cube, (float)(v & 1), (float)(v >> 1 & 1), (float)(v >> 2));
    return cube;
}

static void write_obj(const lomont_mesh *mesh, const double (*positions)[3], FILE *stream) {
    for (int v = 0; v < mesh->vertex_count; v++)
        fprintf(stream, "v %.9g %.9g %.9g\n", positions[v][0], positions[v][1], positions[v][2]);
    for (int f = 0; f < mesh->face_count; f++) {
        const int *const v = mesh->faces[f];
        fprintf(stream, "f %d %d %d\n", v[0] + 1, v[1] + 1, v[2] + 1);
    }
}

/// Returns whether the file was written.
static bool write_level(const lomont_mesh *mesh, const char *folder, int level, bool at_limit) {
    char path[4096];
    snprintf(path, sizeof path, "%s/cube_%d.obj", folder, level);
    double(*const positions)[3] = malloc((size_t)mesh->vertex_count * sizeof *positions);
    FILE *const stream = fopen(path, "w");
    if (!positions || !stream) {
        perror(path);
        return false;
    }
    for (int v = 0; v < mesh->vertex_count; v++)
        memcpy(positions[v], mesh->vertices[v].position, sizeof *positions);
    if (at_limit) lomont_limits(mesh, positions);
    write_obj(mesh, (const double(*)[3])positions, stream);
    free(positions);
    return fclose(stream) == 0;
}

int main(int argument_count, char **arguments) {
    enum { LEVEL = 6 };
    if (argument_count != 2) {
        fprintf(stderr, "usage: %s FOLDER\n", arguments[0]);
        return 2;
    }
    const random_mesh cube = make_cube();
    lomont_mesh mesh = lomont_from_random(&cube);
    bool written = true;
    for (int level = 0; level <= LEVEL && written; level++) {
        written = write_level(&mesh, arguments[1], level, level == LEVEL);
        lomont_refine(&mesh, 1);
    }
    lomont_destroy(&mesh);
    return !written;
}
