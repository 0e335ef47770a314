/* SPDX-License-Identifier: MIT */
#include "butterfly.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static void *allocate(int count, size_t size) {
    void *const memory = calloc((size_t)count + 1, size);
    if (!memory) abort();
    return memory;
}

static butterfly_mesh allocate_mesh(int vertex_count, int face_count) {
    return (butterfly_mesh){
        .vertex_count = vertex_count,
        .face_count = face_count,
        .positions = allocate(vertex_count, sizeof(double[3])),
        .faces = allocate(face_count, sizeof(int[3])),
        .pairs = allocate(3 * face_count, sizeof(int)),
        .first_edges = allocate(vertex_count, sizeof(int)),
    };
}

void butterfly_destroy(butterfly_mesh *mesh) {
    free(mesh->positions);
    free(mesh->faces);
    free(mesh->pairs);
    free(mesh->first_edges);
    *mesh = (butterfly_mesh){0};
}

// ---- Half-edges

static int next_of(int h) {
    return h / 3 * 3 + (h + 1) % 3;
}

static int previous_of(int h) {
    return h / 3 * 3 + (h + 2) % 3;
}

static int start_of(const butterfly_mesh *mesh, int h) {
    return mesh->faces[h / 3][h % 3];
}

static int end_of(const butterfly_mesh *mesh, int h) {
    return start_of(mesh, next_of(h));
}

/// Finds pairs, first edges and the number of edges, from the faces.
static void connect(butterfly_mesh *mesh) {
    const int count = 3 * mesh->face_count;
    int *const latest = allocate(mesh->vertex_count, sizeof(int)); // that leaves a vertex
    int *const earlier = allocate(count, sizeof(int));
    for (int v = 0; v < mesh->vertex_count; v++)
        latest[v] = -1;
    for (int h = 0; h < count; h++) {
        earlier[h] = latest[start_of(mesh, h)];
        latest[start_of(mesh, h)] = h;
    }
    int boundary_count = 0;
    for (int h = 0; h < count; h++) {
        int pair = latest[end_of(mesh, h)];
        while (pair != -1 && end_of(mesh, pair) != start_of(mesh, h))
            pair = earlier[pair];
        mesh->pairs[h] = pair;
        boundary_count += pair == -1;
    }
    mesh->edge_count = (count + boundary_count) / 2;
    for (int v = 0; v < mesh->vertex_count; v++) {
        mesh->first_edges[v] = latest[v];
        for (int h = latest[v]; h != -1; h = earlier[h]) {
            if (mesh->pairs[h] == -1) mesh->first_edges[v] = h;
        }
    }
    free(latest);
    free(earlier);
}

butterfly_mesh butterfly_create(const float (*positions)[3], uint32_t position_count,
                                const uint32_t (*faces)[3], uint32_t face_count) {
    butterfly_mesh mesh = allocate_mesh((int)position_count, (int)face_count);
    for (int i = 0; i < 3 * mesh.vertex_count; i++)
        mesh.positions[i / 3][i % 3] = (double)positions[i / 3][i % 3];
    for (int h = 0; h < 3 * mesh.face_count; h++)
        mesh.faces[h / 3][h % 3] = (int)faces[h / 3][h % 3];
    connect(&mesh);
    return mesh;
}

// ---- The neighbours of a vertex

/// Counter-clockwise; on a boundary, from boundary to boundary.
typedef struct vertex_star {
    int vertex;
    bool closed;
    int count;
    int neighbours[BUTTERFLY_VALENCE_MAX];
} vertex_star;

static void add_neighbour(vertex_star *star, int neighbour) {
    if (star->count == BUTTERFLY_VALENCE_MAX) abort();
    star->neighbours[star->count++] = neighbour;
}

static vertex_star look_around(const butterfly_mesh *mesh, int vertex) {
    vertex_star star = {.vertex = vertex};
    const int first = mesh->first_edges[vertex];
    int h = first;
    do {
        add_neighbour(&star, end_of(mesh, h));
        const int arriving = previous_of(h);
        h = mesh->pairs[arriving];
        if (h == -1) add_neighbour(&star, start_of(mesh, arriving));
    } while (h != -1 && h != first);
    star.closed = h == first;
    return star;
}

static bool is_regular(const vertex_star *star) {
    return star->count == (star->closed ? 6 : 4);
}

static int place_of(const vertex_star *star, int neighbour) {
    for (int i = 0; i < star->count; i++) {
        if (star->neighbours[i] == neighbour) return i;
    }
    abort();
}

/// Around an inner vertex i is any number.
static int neighbour_at(const vertex_star *star, int i) {
    return star->neighbours[(i % star->count + star->count) % star->count];
}

static int last_of(const vertex_star *star) {
    return star->neighbours[star->count - 1];
}

bool butterfly_is_on_boundary(const butterfly_mesh *mesh, int vertex) {
    return mesh->pairs[mesh->first_edges[vertex]] == -1;
}

int butterfly_valence(const butterfly_mesh *mesh, int vertex) {
    return look_around(mesh, vertex).count;
}

// ---- Masks

static void add(butterfly_mask *mask, int vertex, double weight) {
    if (mask->count == BUTTERFLY_MASK_MAX) abort();
    mask->vertices[mask->count] = vertex;
    mask->weights[mask->count++] = weight;
}

void butterfly_apply(const butterfly_mesh *mesh, const butterfly_mask *mask, double sum[3]) {
    for (int axis = 0; axis < 3; axis++) {
        sum[axis] = 0;
        for (int t = 0; t < mask->count; t++)
            sum[axis] += mask->weights[t] * mesh->positions[mask->vertices[t]][axis];
    }
}

/// The weights of a regular stencil: of the wings, -1/16 - w, and of the two points that only the
/// stencil of ten has, w.
typedef struct regular_weights {
    double wing, far;
} regular_weights;

static regular_weights weights_of(const butterfly_mesh *mesh) {
    return (regular_weights){.wing = -1 / 16. - mesh->tension,
                             .far = mesh->stencil == BUTTERFLY_TEN ? mesh->tension : 0};
}

/// What one of two regular inner ends adds, i being the place of the other.
static void add_regular_half(regular_weights w, const vertex_star *star, int i,
                             butterfly_mask *mask) {
    add(mask, star->vertex, 1 / 2. - w.far);
    add(mask, neighbour_at(star, i + 1), -w.wing); // and once more from the other end
    add(mask, neighbour_at(star, i - 1), -w.wing);
    add(mask, neighbour_at(star, i + 2), w.wing);
    add(mask, neighbour_at(star, i - 2), w.wing);
    add(mask, neighbour_at(star, i + 3), w.far);
}

/// Item 7.
static void add_regular_to_boundary(const vertex_star *boundary, const vertex_star *inner,
                                    butterfly_mask *mask) {
    const int i = place_of(boundary, inner->vertex), j = place_of(inner, boundary->vertex);
    const int side = i == 1 ? 1 : -1; // where the inner end sees the boundary
    add(mask, boundary->vertex, 3 / 8.);
    add(mask, inner->vertex, 5 / 8.);
    add(mask, boundary->neighbours[i == 1 ? 0 : 3], 1 / 16.);
    add(mask, boundary->neighbours[3 - i], 3 / 16.);
    add(mask, boundary->neighbours[i == 1 ? 3 : 0], -1 / 16.);
    add(mask, neighbour_at(inner, j + 2 * side), -1 / 16.);
    add(mask, neighbour_at(inner, j - 2 * side), -1 / 8.);
}

/// Items 8 and 9: what one of two regular ends on a boundary adds.
static void add_regular_across(const vertex_star *star, int i, bool has_corner,
                               butterfly_mask *mask) {
    add(mask, star->vertex, 1 / 2.);
    if (!has_corner) return;
    add(mask, star->neighbours[3 - i], 1 / 8.); // and once more from the other end
    add(mask, star->neighbours[i == 1 ? 3 : 0], -1 / 8.);
}

static void add_regular(const butterfly_mesh *mesh, const vertex_star *a, const vertex_star *b,
                        butterfly_mask *mask) {
    const int i = place_of(a, b->vertex), j = place_of(b, a->vertex);
    if (a->closed && b->closed) {
        add_regular_half(weights_of(mesh), a, i, mask);
        add_regular_half(weights_of(mesh), b, j, mask);
    } else if (a->closed || b->closed) {
        add_regular_to_boundary(a->closed ? b : a, a->closed ? a : b, mask);
    } else {
        add_regular_across(a, i, i != j, mask);
        add_regular_across(b, j, i != j, mask);
    }
}

static double extraordinary_weight(int n, int j) {
    static const double of_3[3] = {5 / 12., -1 / 12., -1 / 12.}, of_4[4] = {3 / 8., 0, -1 / 8., 0};
    if (n == 3) return of_3[j];
    if (n == 4) return of_4[j];
    return (1 / 4. + cos(2 * pi * j / n) + cos(4 * pi * j / n) / 2) / n;
}

/// i is the place of the other end.
static void add_extraordinary_inner(const vertex_star *star, int i, double share,
                                    butterfly_mask *mask) {
    add(mask, star->vertex, share * 3 / 4);
    for (int j = 0; j < star->count; j++)
        add(mask, neighbour_at(star, i + j), share * extraordinary_weight(star->count, j));
}

/// Item 10.
static void add_extraordinary_boundary(const vertex_star *star, int i, double share,
                                       butterfly_mask *mask) {
    const int k = star->count - 1;
    const double z = pi / k;
    const double end = (cos(i * z) - sin(2 * z) * sin(2 * i * z) / (k * (cos(z) - cos(2 * z)))) / 4;
    add(mask, star->vertex, share * (1 - sin(i * z) / (k * tan(z / 2))));
    add(mask, star->neighbours[0], share * end);
    add(mask, star->neighbours[k], -share * end);
    for (int j = 1; j < k; j++) {
        const double weight = sin(i * z) * sin(j * z) + sin(2 * i * z) * sin(2 * j * z) / 2;
        add(mask, star->neighbours[j], share * weight / k);
    }
}

static void add_extraordinary(const vertex_star *star, int other, double share,
                              butterfly_mask *mask) {
    const int i = place_of(star, other);
    if (star->closed)
        add_extraordinary_inner(star, i, share, mask);
    else
        add_extraordinary_boundary(star, i, share, mask);
}

static void add_boundary_edge(const vertex_star *start, const vertex_star *end,
                              butterfly_mask *mask) {
    add(mask, last_of(start), -1 / 16.);
    add(mask, start->vertex, 9 / 16.);
    add(mask, end->vertex, 9 / 16.);
    add(mask, end->neighbours[0], -1 / 16.);
}

butterfly_mask butterfly_edge_mask(const butterfly_mesh *mesh, int half_edge) {
    const vertex_star start = look_around(mesh, start_of(mesh, half_edge));
    const vertex_star end = look_around(mesh, end_of(mesh, half_edge));
    butterfly_mask mask = {0};
    if (mesh->pairs[half_edge] == -1) {
        add_boundary_edge(&start, &end, &mask);
    } else if (is_regular(&start) && is_regular(&end)) {
        add_regular(mesh, &start, &end, &mask);
    } else {
        const double share = is_regular(&start) || is_regular(&end) ? 1 : 1 / 2.;
        if (!is_regular(&start)) add_extraordinary(&start, end.vertex, share, &mask);
        if (!is_regular(&end)) add_extraordinary(&end, start.vertex, share, &mask);
    }
    return mask;
}

// ---- A level

/// Places the new vertices and numbers them: half-edges to vertices. Free it.
static int *place_new_vertices(const butterfly_mesh *old, butterfly_mesh *new) {
    int *const middles = allocate(3 * old->face_count, sizeof(int));
    int used = old->vertex_count;
    for (int h = 0; h < 3 * old->face_count; h++) {
        const int pair = old->pairs[h];
        if (pair != -1 && pair < h) {
            middles[h] = middles[pair];
            continue;
        }
        const butterfly_mask mask = butterfly_edge_mask(old, h);
        butterfly_apply(old, &mask, new->positions[used]);
        middles[h] = used++;
    }
    return middles;
}

static void split_faces(const butterfly_mesh *old, const int *middles, butterfly_mesh *new) {
    for (int f = 0; f < old->face_count; f++) {
        const int *const v = old->faces[f], *const m = middles + 3 * f;
        const int parts[4][3] = {
            {v[0], m[0], m[2]}, {m[0], v[1], m[1]}, {m[2], m[1], v[2]}, {m[0], m[1], m[2]}};
        memcpy(new->faces[4 * f], parts, sizeof parts);
    }
}

butterfly_mesh butterfly_subdivide(const butterfly_mesh *old) {
    butterfly_mesh new = allocate_mesh(old->vertex_count + old->edge_count, 4 * old->face_count);
    new.stencil = old->stencil;
    new.tension = old->tension;
    memcpy(new.positions, old->positions, (size_t)old->vertex_count * sizeof *old->positions);
    int *const middles = place_new_vertices(old, &new);
    split_faces(old, middles, &new);
    free(middles);
    connect(&new);
    return new;
}

// ---- Tangents

/// Whether all neighbours of a vertex are regular, and on a boundary only where the edge is.
static bool has_regular_neighbours(const butterfly_mesh *mesh, const vertex_star *star) {
    for (int i = 0; i < star->count; i++) {
        const vertex_star ring = look_around(mesh, star->neighbours[i]);
        const bool inner = star->closed || (i > 0 && i < star->count - 1);
        if (!is_regular(&ring) || ring.closed != inner) return false;
    }
    return true;
}

static void add_circular(int vertex, double angle, double weight, butterfly_mask tangents[2]) {
    add(&tangents[0], vertex, weight * cos(angle));
    add(&tangents[1], vertex, weight * sin(angle));
}

/// The ring, the six vertices between two of its spokes and the six behind it.
static void fill_interior_tangents(const butterfly_mesh *mesh, const vertex_star *star,
                                   butterfly_mask tangents[2]) {
    const regular_weights w = weights_of(mesh);
    const double between = sqrt(3) * w.wing / (1 / 2. - w.far + 2 * w.wing);
    const double behind = 2 * w.far + 2 * sqrt(3) * w.wing * between;
    for (int i = 0; i < 6; i++) {
        const vertex_star ring = look_around(mesh, star->neighbours[i]);
        const int j = place_of(&ring, star->vertex);
        add_circular(ring.vertex, i * pi / 3, 1, tangents);
        add_circular(neighbour_at(&ring, j - 2), (i + 1 / 2.) * pi / 3, between, tangents);
        add_circular(neighbour_at(&ring, j + 3), i * pi / 3, behind, tangents);
    }
}

static void fill_ring_tangents(const vertex_star *star, butterfly_mask tangents[2]) {
    for (int i = 0; i < star->count; i++)
        add_circular(star->neighbours[i], 2 * pi * i / star->count, 1, tangents);
}

static void fill_along(const butterfly_mesh *mesh, const vertex_star *star, butterfly_mask *along) {
    const vertex_star first = look_around(mesh, star->neighbours[0]);
    const vertex_star last = look_around(mesh, last_of(star));
    add(along, first.vertex, 8);
    add(along, last.vertex, -8);
    add(along, first.neighbours[0], -1);
    add(along, last_of(&last), 1);
}

static void fill_extraordinary_across(const vertex_star *star, butterfly_mask *across) {
    const int k = star->count - 1;
    add(across, star->vertex, -1 / tan(pi / (2 * k)));
    for (int j = 1; j < k; j++)
        add(across, star->neighbours[j], sin(j * pi / k));
}

static void add_both(butterfly_mask *mask, int a, int b, double weight) {
    add(mask, a, weight);
    add(mask, b, weight);
}

/// Of the vertex, two neighbours on the boundary each way, the four vertices of the next row and
/// three of the one behind it, with f for the far weight and q for the wing's.
static void fill_regular_across(const butterfly_mesh *mesh, const vertex_star *star,
                                butterfly_mask *across) {
    const double f = weights_of(mesh).far, q = weights_of(mesh).wing;
    const int *const ring = star->neighbours;
    const vertex_star right_end = look_around(mesh, ring[0]), left_end = look_around(mesh, ring[3]);
    const vertex_star right = look_around(mesh, ring[1]), left = look_around(mesh, ring[2]);
    const int at_right = place_of(&right, star->vertex), at_left = place_of(&left, star->vertex);
    add(across, star->vertex, 304 * f + 192 * q - 22);
    add_both(across, ring[0], ring[3], -128 * f - 224 * q - 16);
    add_both(across, right_end.neighbours[0], left_end.neighbours[3], 24 * f + 32 * q + 3);
    add_both(across, right.vertex, left.vertex, 40 + 160 * q);
    add_both(across, right_end.neighbours[1], left_end.neighbours[2], -64 * f - 32 * q - 8);
    add_both(across, neighbour_at(&right, at_right + 3), neighbour_at(&left, at_left + 3),
             16 * f - 32 * q + 2);
    add(across, neighbour_at(&right, at_right - 2), -20);
}

bool butterfly_tangents(const butterfly_mesh *mesh, int vertex, butterfly_mask tangents[2]) {
    const vertex_star star = look_around(mesh, vertex);
    if (!has_regular_neighbours(mesh, &star)) abort();
    tangents[0].count = tangents[1].count = 0;
    if (star.closed) {
        if (is_regular(&star))
            fill_interior_tangents(mesh, &star, tangents);
        else
            fill_ring_tangents(&star, tangents);
        return true;
    }
    if (star.count == 2) return false;
    fill_along(mesh, &star, &tangents[0]);
    if (is_regular(&star))
        fill_regular_across(mesh, &star, &tangents[1]);
    else
        fill_extraordinary_across(&star, &tangents[1]);
    return true;
}

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

/// The edges to both neighbours of a vertex with one face.
static void fill_face_tangents(const butterfly_mesh *mesh, int vertex, butterfly_mask tangents[2]) {
    const vertex_star star = look_around(mesh, vertex);
    for (int t = 0; t < 2; t++) {
        add(&tangents[t], star.neighbours[t], 1);
        add(&tangents[t], vertex, -1);
    }
}

void butterfly_normals(const butterfly_mesh *mesh, double (*normals)[3]) {
    butterfly_mesh finer = butterfly_subdivide(mesh);
    butterfly_mask tangents[2];
    for (int v = 0; v < mesh->vertex_count; v++) {
        const bool smooth = butterfly_tangents(&finer, v, tangents);
        if (!smooth) fill_face_tangents(mesh, v, tangents);
        double sums[2][3];
        for (int t = 0; t < 2; t++)
            butterfly_apply(smooth ? &finer : mesh, &tangents[t], sums[t]);
        set_normal(sums[0], sums[1], normals[v]);
    }
    butterfly_destroy(&finer);
}
