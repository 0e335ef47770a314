/* SPDX-License-Identifier: MIT */
/* What the generator of the meshes works on. */
#ifndef ASSETS_MESH_H
#define ASSETS_MESH_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    max_points = 1024,
    max_faces = 1024,
    max_corners = 8,
    max_edges = 3072,
    max_creases = 64,
    max_path = 1024
};

typedef struct point {
    double x, y, z;
} point;

typedef struct face {
    int count;
    int corners[max_corners]; /* counter-clockwise seen from outside */
} face;

typedef struct crease {
    int a, b;
    double sharpness;
} crease;

typedef struct mesh {
    int point_count, face_count, crease_count;
    point points[max_points];
    face faces[max_faces];
    crease creases[max_creases];
} mesh;

/* Says what is wrong with which file or mesh, and ends the program. */
static inline _Noreturn void fail(const char *which, const char *what) {
    fprintf(stderr, "generate_meshes: %s: %s\n", which, what);
    exit(EXIT_FAILURE);
}

static const point along_x = {1.0, 0.0, 0.0};
static const point along_z = {0.0, 0.0, 1.0};

static inline point add(point a, point b) {
    return (point){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline point scale(point a, double s) {
    return (point){a.x * s, a.y * s, a.z * s};
}

static inline point subtract(point a, point b) {
    return add(a, scale(b, -1.0));
}

static inline point cross(point a, point b) {
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double dot(point a, point b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline point normalise(point a) {
    return scale(a, 1.0 / sqrt(dot(a, a)));
}

#endif
