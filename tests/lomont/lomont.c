/* SPDX-License-Identifier: MIT */
#include "lomont.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

static void *allocate(int count, size_t size) {
    void *const memory = calloc((size_t)count + 1, size);
    if (!memory) abort();
    return memory;
}

static lomont_mesh allocate_mesh(int vertex_count, int face_count) {
    return (lomont_mesh){
        .vertex_count = vertex_count,
        .face_count = face_count,
        .vertices = allocate(vertex_count, sizeof(lomont_vertex)),
        .faces = allocate(face_count, sizeof(int[3])),
        .half_edges = allocate(3 * face_count, sizeof(lomont_half_edge)),
    };
}

void lomont_destroy(lomont_mesh *mesh) {
    free(mesh->vertices);
    free(mesh->faces);
    free(mesh->half_edges);
    *mesh = (lomont_mesh){0};
}

// ---- Half-edges

static int next_of(int h) {
    return h / 3 * 3 + (h + 1) % 3;
}

static int previous_of(int h) {
    return h / 3 * 3 + (h + 2) % 3;
}

static int start_of(const lomont_mesh *mesh, int h) {
    return mesh->faces[h / 3][h % 3];
}

static int end_of(const lomont_mesh *mesh, int h) {
    return start_of(mesh, next_of(h));
}

/// Gives each vertex a half-edge that ends there, a boundary's if there is one.
static void tag_vertices(lomont_mesh *mesh) {
    for (int v = 0; v < mesh->vertex_count; v++)
        mesh->vertices[v].half_edge = -1;
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        int *const tag = &mesh->vertices[end_of(mesh, h)].half_edge;
        if (*tag == -1 || mesh->half_edges[h].pair == -1) *tag = h;
    }
}

static int find_half_edge(const lomont_mesh *mesh, int start, int end) {
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        if (start_of(mesh, h) == start && end_of(mesh, h) == end) return h;
    }
    return -1;
}

lomont_mesh lomont_create(const float (*positions)[3], uint32_t position_count,
                          const uint32_t (*faces)[3], uint32_t face_count) {
    lomont_mesh mesh = allocate_mesh((int)position_count, (int)face_count);
    for (int v = 0; v < mesh.vertex_count; v++) {
        for (int axis = 0; axis < 3; axis++)
            mesh.vertices[v].position[axis] = (double)positions[v][axis];
    }
    for (int h = 0; h < 3 * mesh.face_count; h++)
        mesh.faces[h / 3][h % 3] = (int)faces[h / 3][h % 3];
    int boundary_count = 0;
    for (int h = 0; h < 3 * mesh.face_count; h++) {
        const int pair = find_half_edge(&mesh, end_of(&mesh, h), start_of(&mesh, h));
        mesh.half_edges[h] = (lomont_half_edge){pair, pair == -1 ? (double)INFINITY : 0};
        boundary_count += pair == -1;
    }
    mesh.edge_count = (3 * mesh.face_count + boundary_count) / 2;
    tag_vertices(&mesh);
    return mesh;
}

bool lomont_set_edge_weight(lomont_mesh *mesh, int a, int b, double weight) {
    const int h = find_half_edge(mesh, a, b);
    if (h == -1 || mesh->half_edges[h].pair == -1) return false;
    mesh->half_edges[h].weight = weight;
    mesh->half_edges[mesh->half_edges[h].pair].weight = weight;
    return true;
}

static bool is_settled(double weight) {
    return weight == 0 || isinf(weight);
}

bool lomont_is_settled(const lomont_mesh *mesh) {
    for (int v = 0; v < mesh->vertex_count; v++) {
        if (!is_settled(mesh->vertices[v].weight)) return false;
    }
    for (int h = 0; h < 3 * mesh->face_count; h++) {
        if (!is_settled(mesh->half_edges[h].weight)) return false;
    }
    return true;
}

// ---- The neighbours of a vertex

/// Clockwise; from boundary to boundary, or around from anywhere.
typedef struct vertex_star {
    bool closed;
    int count;
    int neighbours[LOMONT_VALENCE_MAX];
    double weights[LOMONT_VALENCE_MAX]; ///< of the edges to the neighbours
    int corners[LOMONT_VALENCE_MAX];    ///< 3 f + k, of the face between neighbours r and r + 1
    lomont_type type;
    int sharp_count;
    int sharp[LOMONT_VALENCE_MAX]; ///< places of the neighbours along sharp edges, ascending
} vertex_star;

static void add_neighbour(vertex_star *star, int neighbour, double weight) {
    if (star->count == LOMONT_VALENCE_MAX) abort();
    star->neighbours[star->count] = neighbour;
    star->weights[star->count++] = weight;
}

static void walk_around(const lomont_mesh *mesh, int vertex, vertex_star *star) {
    const int first = mesh->vertices[vertex].half_edge;
    int h = first;
    star->count = 0;
    do {
        const int leaving = next_of(h);
        add_neighbour(star, start_of(mesh, h), mesh->half_edges[h].weight);
        star->corners[star->count - 1] = leaving;
        h = mesh->half_edges[leaving].pair;
        if (h == -1) add_neighbour(star, end_of(mesh, leaving), mesh->half_edges[leaving].weight);
    } while (h != -1 && h != first);
    star->closed = h != -1;
}

static bool is_regular(const vertex_star *star) {
    if (!star->closed) return star->count == 4;
    return star->count == 6 && star->sharp[1] - star->sharp[0] == 3;
}

static lomont_type type_of(const vertex_star *star, double vertex_weight) {
    if (star->sharp_count > 2 || vertex_weight >= 1) return LOMONT_CORNER;
    if (star->sharp_count == 2) return is_regular(star) ? LOMONT_REGULAR : LOMONT_NON_REGULAR;
    return star->sharp_count == 1 ? LOMONT_DART : LOMONT_SMOOTH;
}

/// The star of a vertex, with fractional edges taken for sharp ones or for smooth ones.
static void look_around(const lomont_mesh *mesh, int vertex, bool fractions_are_sharp,
                        vertex_star *star) {
    walk_around(mesh, vertex, star);
    star->sharp_count = 0;
    for (int r = 0; r < star->count; r++) {
        const double weight = star->weights[r];
        if (fractions_are_sharp ? weight > 0 : weight >= 1) star->sharp[star->sharp_count++] = r;
    }
    star->type = type_of(star, mesh->vertices[vertex].weight);
}

lomont_type lomont_vertex_type(const lomont_mesh *mesh, int vertex) {
    vertex_star star;
    look_around(mesh, vertex, false, &star);
    return star.type;
}

// ---- Masks

/// What each neighbour weighs, with 1 left for the centre and all others together.
typedef struct ring_mask {
    double smooth; ///< of each neighbour of a smooth vertex or dart
    double crease; ///< of each of the two neighbours of a vertex along its crease
} ring_mask;

static double b(int n) {
    const double root = 3 + 2 * cos(2 * pi / n);
    return (40 - root * root) / 64;
}

static void apply(const lomont_mesh *mesh, int vertex, const vertex_star *star, lomont_type type,
                  ring_mask mask, double result[3]) {
    double weights[LOMONT_VALENCE_MAX] = {0};
    const bool smooth = type == LOMONT_SMOOTH || type == LOMONT_DART;
    for (int r = 0; smooth && r < star->count; r++)
        weights[r] = mask.smooth;
    for (int s = 0; !smooth && type != LOMONT_CORNER && s < 2; s++)
        weights[star->sharp[s]] = mask.crease;
    const double *const centre = mesh->vertices[vertex].position;
    for (int axis = 0; axis < 3; axis++) {
        double sum = 0, weight_sum = 0;
        for (int r = 0; r < star->count; r++) {
            sum += weights[r] * mesh->vertices[star->neighbours[r]].position[axis];
            weight_sum += weights[r];
        }
        result[axis] = (1 - weight_sum) * centre[axis] + sum;
    }
}

/// The new position of an old vertex.
static void move_vertex(const lomont_mesh *mesh, int vertex, double result[3]) {
    vertex_star star;
    look_around(mesh, vertex, false, &star);
    const ring_mask mask = {.smooth = b(star.count) / star.count, .crease = 1 / 8.};
    apply(mesh, vertex, &star, type_of(&star, 0), mask, result);
    const double w = fmin(mesh->vertices[vertex].weight, 1);
    for (int axis = 0; axis < 3; axis++)
        result[axis] = (1 - w) * result[axis] + w * mesh->vertices[vertex].position[axis];
}

static void limit_of(const lomont_mesh *mesh, int vertex, double result[3]) {
    vertex_star star;
    look_around(mesh, vertex, false, &star);
    const int n = star.count;
    const ring_mask mask = {.smooth = 1 / (n + 3 * n / (8 * b(n))),
                            .crease = star.type == LOMONT_REGULAR ? 1 / 6. : 1 / 5.};
    apply(mesh, vertex, &star, star.type, mask, result);
}

/// The weight of the start of a sharp edge, by Table 2; the rest goes with its end. 0 stands for
/// the smooth mask.
static double sharp_start_weight(lomont_type start, lomont_type end) {
    enum { SMOOTH_MASK = 1, EVEN_MASK, UNEVEN_MASK };
    static const int table[4][4] = {{1, 1, 1, 1}, {1, 2, 3, 3}, {1, 3, 2, 2}, {1, 3, 2, 2}};
    const int kind = table[start - LOMONT_DART][end - LOMONT_DART];
    if (kind == SMOOTH_MASK) return 0;
    if (kind == EVEN_MASK) return 1 / 2.;
    return start == LOMONT_REGULAR ? 5 / 8. : 3 / 8.;
}

static double find_sharp_start_weight(const lomont_mesh *mesh, int h) {
    const double weight = mesh->half_edges[h].weight;
    vertex_star start, end;
    if (weight == 0) return 0;
    look_around(mesh, start_of(mesh, h), weight < 1, &start);
    look_around(mesh, end_of(mesh, h), weight < 1, &end);
    return sharp_start_weight(start.type, end.type);
}

/// The vertex in the middle of an edge.
static void place_edge_vertex(const lomont_mesh *mesh, int h, double result[3]) {
    const lomont_vertex *const v = mesh->vertices;
    const double *const start = v[start_of(mesh, h)].position;
    const double *const end = v[end_of(mesh, h)].position;
    const int pair = mesh->half_edges[h].pair;
    const double *const left = v[start_of(mesh, previous_of(h))].position;
    const double *const right = pair == -1 ? left : v[start_of(mesh, previous_of(pair))].position;
    const double start_weight = find_sharp_start_weight(mesh, h);
    const double w = start_weight > 0 ? fmin(mesh->half_edges[h].weight, 1) : 0;
    for (int axis = 0; axis < 3; axis++) {
        const double smooth = 3 / 8. * (start[axis] + end[axis]) + (left[axis] + right[axis]) / 8;
        const double sharp = start_weight * start[axis] + (1 - start_weight) * end[axis];
        result[axis] = (1 - w) * smooth + w * sharp;
    }
}

// ---- The steps of a level

static double lower(double weight) {
    return fmax(weight - 1, 0);
}

/// Compute New Edge Vertices. Fills the edge map, EM, of half-edges to new vertices.
static void insert_edge_vertices(const lomont_mesh *old, lomont_mesh *new, int *edge_map) {
    int used = old->vertex_count;
    for (int h = 0; h < 3 * old->face_count; h++)
        edge_map[h] = -1;
    for (int h = 0; h < 3 * old->face_count; h++) {
        if (edge_map[h] != -1) continue;
        place_edge_vertex(old, h, new->vertices[used].position);
        const int pair = old->half_edges[h].pair;
        edge_map[h] = used;
        if (pair != -1) edge_map[pair] = used;
        used++;
    }
}

/// Update Original Vertices.
static void move_vertices(const lomont_mesh *old, lomont_mesh *new) {
    for (int v = 0; v < old->vertex_count; v++) {
        move_vertex(old, v, new->vertices[v].position);
        new->vertices[v].weight = lower(old->vertices[v].weight);
    }
}

/// Split Faces, as in his Figure 5.
static void split_faces(const lomont_mesh *old, const int *edge_map, lomont_mesh *new) {
    for (int f = 0; f < old->face_count; f++) {
        const int *const v = old->faces[f], *const j = edge_map + 3 * f;
        const int parts[4][3] = {
            {j[2], v[0], j[0]}, {j[0], v[1], j[1]}, {j[1], v[2], j[2]}, {j[2], j[0], j[1]}};
        for (int h = 0; h < 12; h++)
            new->faces[4 * f + h / 3][h % 3] = parts[h / 3][h % 3];
    }
}

typedef enum edge_half { A, B } edge_half;

/// nIndex: the pair of the first or second half of an old half-edge.
static int paired_half(const lomont_mesh *old, int h, edge_half half) {
    static const int offsets[6] = {3, 1, 6, 4, 0, 7};
    const int pair = old->half_edges[h].pair;
    if (pair == -1) return -1;
    return 12 * (pair / 3) + offsets[2 * (pair % 3) + (int)half];
}

/// Create New Half-edge Info.
static void create_half_edges(const lomont_mesh *old, lomont_mesh *new) {
    for (int f = 0; f < old->face_count; f++) {
        const int e0 = 3 * f, e1 = e0 + 1, e2 = e0 + 2, base = 12 * f;
        const int pairs[12] = {paired_half(old, e2, B),
                               paired_half(old, e0, A),
                               base + 9,
                               paired_half(old, e0, B),
                               paired_half(old, e1, A),
                               base + 10,
                               paired_half(old, e1, B),
                               paired_half(old, e2, A),
                               base + 11,
                               base + 2,
                               base + 5,
                               base + 8};
        const int parents[12] = {e2, e0, -1, e0, e1, -1, e1, e2, -1, -1, -1, -1};
        for (int h = 0; h < 12; h++) {
            const double weight = parents[h] == -1 ? 0 : lower(old->half_edges[parents[h]].weight);
            new->half_edges[base + h] = (lomont_half_edge){pairs[h], weight};
        }
    }
}

lomont_mesh lomont_subdivide(const lomont_mesh *old) {
    lomont_mesh new = allocate_mesh(old->vertex_count + old->edge_count, 4 * old->face_count);
    new.edge_count = 2 * old->edge_count + 3 * old->face_count;
    int *const edge_map = allocate(3 * old->face_count, sizeof *edge_map);
    insert_edge_vertices(old, &new, edge_map);
    move_vertices(old, &new);
    split_faces(old, edge_map, &new);
    create_half_edges(old, &new);
    tag_vertices(&new);
    free(edge_map);
    return new;
}

// ---- Normals

static void set_normal(const double a[3], const double b[3], double normal[3]) {
    double square = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        normal[axis] = a[u] * b[v] - a[v] * b[u];
        square += normal[axis] * normal[axis];
    }
    for (int axis = 0; axis < 3; axis++)
        normal[axis] /= sqrt(square);
}

/// Some neighbours of a vertex, one after the other clockwise, and the faces between them.
typedef struct star_side {
    const lomont_mesh *mesh;
    const vertex_star *star;
    int vertex;
    int first, count;
} star_side;

/// The sum of weights[0] times the vertex and weights[i] times neighbour i = 1, … of the side.
static void weigh(const star_side *side, const double *weights, double sum[3]) {
    const lomont_vertex *const v = side->mesh->vertices;
    for (int axis = 0; axis < 3; axis++) {
        sum[axis] = weights[0] * v[side->vertex].position[axis];
        for (int i = 1; i <= side->count; i++) {
            const int r = (side->first + i - 1) % side->star->count;
            sum[axis] += weights[i] * v[side->star->neighbours[r]].position[axis];
        }
    }
}

/// The first tangent of each comes before the second in the product: the normal looks at
/// counter-clockwise faces.
static void smooth_tangents(const star_side *side, double first[3], double second[3]) {
    double cosines[LOMONT_VALENCE_MAX + 1] = {0}, sines[LOMONT_VALENCE_MAX + 1] = {0};
    for (int i = 1; i <= side->count; i++) {
        cosines[i] = cos(2 * pi * i / side->count);
        sines[i] = sin(2 * pi * i / side->count);
    }
    weigh(side, sines, first);
    weigh(side, cosines, second);
}

/// Across a crease, into a side of n neighbours, the first and the last of them on the crease.
static void fill_across(int n, bool regular, double *weights) {
    if (n == 2) {
        weights[0] = -2, weights[1] = weights[2] = 1;
    } else if (n == 3) {
        weights[0] = -1, weights[2] = 1;
    } else if (regular) {
        weights[0] = -2, weights[1] = weights[4] = -1, weights[2] = weights[3] = 2;
    } else {
        const double z = pi / (n - 1);
        weights[1] = weights[n] = -sin(z);
        for (int i = 2; i < n; i++)
            weights[i] = (2 - 2 * cos(z)) * sin((i - 1) * z);
    }
}

static void crease_tangents(const star_side *side, double first[3], double second[3]) {
    double along[LOMONT_VALENCE_MAX + 1] = {0}, across[LOMONT_VALENCE_MAX + 1] = {0};
    along[1] = -1, along[side->count] = 1;
    fill_across(side->count, side->star->type == LOMONT_REGULAR, across);
    weigh(side, along, first);
    weigh(side, across, second);
}

/// Between two sharp edges of a corner.
static void corner_tangents(const star_side *side, double first[3], double second[3]) {
    double to_last[LOMONT_VALENCE_MAX + 1] = {-1}, to_first[LOMONT_VALENCE_MAX + 1] = {-1};
    to_last[side->count] = to_first[1] = 1;
    weigh(side, to_last, first);
    weigh(side, to_first, second);
}

static void write_side(const star_side *side, double (*normals)[3]) {
    const vertex_star *const star = side->star;
    const bool whole = star->type == LOMONT_SMOOTH || star->type == LOMONT_DART;
    double first[3], second[3], normal[3];
    if (whole)
        smooth_tangents(side, first, second);
    else if (star->type == LOMONT_CORNER)
        corner_tangents(side, first, second);
    else
        crease_tangents(side, first, second);
    set_normal(first, second, normal);
    for (int i = 0; i < (whole ? side->count : side->count - 1); i++) {
        for (int axis = 0; axis < 3; axis++)
            normals[star->corners[(side->first + i) % star->count]][axis] = normal[axis];
    }
}

/// The sides between the sharp edges of a crease or corner.
static void write_sides(const lomont_mesh *mesh, int vertex, const vertex_star *star,
                        double (*normals)[3]) {
    const int last = star->closed ? star->sharp_count : star->sharp_count - 1;
    for (int s = 0; s < last; s++) {
        const int first = star->sharp[s], wrapped = s + 1 == star->sharp_count;
        const int end = wrapped ? star->sharp[0] + star->count : star->sharp[s + 1];
        write_side(&(star_side){mesh, star, vertex, first, end - first + 1}, normals);
    }
}

static void write_normals(const lomont_mesh *mesh, int vertex, double (*normals)[3]) {
    vertex_star star;
    look_around(mesh, vertex, false, &star);
    if (star.type == LOMONT_SMOOTH || star.type == LOMONT_DART) {
        write_side(&(star_side){mesh, &star, vertex, 0, star.count}, normals);
    } else if (star.sharp_count >= 2) {
        write_sides(mesh, vertex, &star, normals);
    } else {
        for (int r = 0; r < star.count; r++)
            write_side(&(star_side){mesh, &star, vertex, r, 2}, normals);
    }
}

// ---- Final Step, for which all vertices get neighbours that are regular if they are on creases

void lomont_limits(const lomont_mesh *mesh, double (*positions)[3]) {
    lomont_mesh finer = lomont_subdivide(mesh);
    for (int v = 0; v < mesh->vertex_count; v++)
        limit_of(&finer, v, positions[v]);
    lomont_destroy(&finer);
}

void lomont_normals(const lomont_mesh *mesh, double (*normals)[3]) {
    lomont_mesh finer = lomont_subdivide(mesh);
    double(*const finer_normals)[3] = allocate(3 * finer.face_count, sizeof *finer_normals);
    for (int v = 0; v < mesh->vertex_count; v++)
        write_normals(&finer, v, finer_normals);
    for (int c = 0; c < 3 * mesh->face_count; c++) {
        for (int axis = 0; axis < 3; axis++)
            normals[c][axis] = finer_normals[3 * (4 * (c / 3) + c % 3) + 1][axis];
    }
    free(finer_normals);
    lomont_destroy(&finer);
}
