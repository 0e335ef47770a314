/* SPDX-License-Identifier: MIT */
/*
 * Diffuse light on the rows of one patch (Brickhill): the cosine between normal and light, clamped,
 * times what of the light arrives. The cosine is found at the corners and is linear between them, or
 * it is found at every row; the rest always is found at every row.
 *
 * Rows that patches share get the same bits. On an edge, all weights but those of its ends are 0,
 * and a sum of two products and zeros does not depend on the order of the corners; so no product is
 * fused into a sum here, in either family. All loops go on to the end of a vector.
 */
#ifndef LIGHT_H
#define LIGHT_H

#include "formats.h"

/// A light as rows take it.
typedef struct lamp {
    float place[3];       ///< of a directional light, the unit vector towards it
    float back[3];        ///< against its direction
    float colour[3];      ///< what it adds to each plane
    float attenuation[3]; ///< constant, linear, quadratic
    float per_range;      ///< 1 / range^2
    float outer, per_cone;
} lamp;

static inline lamp make_lamp(const limn_light *light) {
    const float range = light->range, *const a = light->attenuation;
    lamp l = {.attenuation = {a[0], a[1], a[2]},
              .per_range = range > 0 ? 1.0f / (range * range) : 0.0f,
              .outer = light->outer_cosine,
              .per_cone = 1.0f / (light->inner_cosine - light->outer_cosine)};
    if (a[0] == 0 && a[1] == 0 && a[2] == 0) l.attenuation[0] = 1;
    for (int axis = 0; axis < 3; axis++) {
        l.back[axis] = -light->direction[axis];
        l.colour[axis] = light->colour[axis];
        l.place[axis] =
            light->kind == LIMN_LIGHT_DIRECTIONAL ? l.back[axis] : light->position[axis];
    }
    return l;
}

/// What leads from some rows to a light.
typedef struct beam {
    lanes way[3]; ///< unit vector; 0 at the light itself
    lanes square, distance;
} beam;

static inline lanes dot(const lanes a[3], const lanes b[3]) {
    return lanes_add(lanes_add(lanes_multiply(a[0], b[0]), lanes_multiply(a[1], b[1])),
                     lanes_multiply(a[2], b[2]));
}

static inline void load_vector(const vectors *from, size_t row, lanes to[3]) {
    for (int axis = 0; axis < 3; axis++)
        to[axis] = lanes_load_any(&from->axes[axis][row]);
}

static inline void splat_vector(const float from[3], lanes to[3]) {
    for (int axis = 0; axis < 3; axis++)
        to[axis] = lanes_splat(from[axis]);
}

static LIMNI_INLINE beam find_beam(limn_light_kind kind, const lamp *l, const vectors *positions,
                                   size_t row) {
    beam b = {.square = lanes_zero(), .distance = lanes_zero()};
    splat_vector(l->place, b.way);
    if (kind == LIMN_LIGHT_DIRECTIONAL) return b;
    lanes position[3];
    load_vector(positions, row, position);
    for (int axis = 0; axis < 3; axis++)
        b.way[axis] = lanes_subtract(b.way[axis], position[axis]);
    b.square = clamp(dot(b.way, b.way), lanes_splat(LEAST_SQUARE), lanes_splat(MOST_SQUARE));
    const lanes root = inverse_root(b.square);
    b.distance = lanes_multiply(b.square, root);
    for (int axis = 0; axis < 3; axis++)
        b.way[axis] = lanes_multiply(b.way[axis], root);
    return b;
}

/// The cosine between the normals of some rows and their way to a light; 0 where it is negative.
static inline lanes find_cosine(const beam *b, const vectors *normals, size_t row) {
    lanes normal[3];
    load_vector(normals, row, normal);
    return lanes_max(dot(normal, b->way), lanes_zero());
}

/// `share` of a light, less what does not arrive.
static LIMNI_INLINE lanes attenuate(limn_light_kind kind, const lamp *l, const beam *b,
                                    lanes share) {
    const lanes zero = lanes_zero(), one = lanes_splat(1.0f);
    if (kind == LIMN_LIGHT_DIRECTIONAL) return share;
    if (kind == LIMN_LIGHT_SPOT) {
        lanes back[3];
        splat_vector(l->back, back);
        const lanes inside = lanes_subtract(dot(back, b->way), lanes_splat(l->outer));
        const lanes part = clamp(lanes_multiply(inside, lanes_splat(l->per_cone)), zero, one);
        share = lanes_multiply(share, lanes_multiply(part, part));
    }
    const lanes squares = lanes_multiply(b->square, lanes_splat(l->per_range));
    const lanes left = lanes_subtract(one, lanes_multiply(squares, squares));
    const lanes linear = lanes_multiply(lanes_splat(l->attenuation[1]), b->distance);
    const lanes quadratic = lanes_multiply(lanes_splat(l->attenuation[2]), b->square);
    const lanes divisor = lanes_add(lanes_add(lanes_splat(l->attenuation[0]), linear), quadratic);
    share = lanes_multiply(share, lanes_max(left, zero));
    return lanes_divide(share, divisor);
}

/// How the cosines of the rows of a patch are found.
typedef enum shading { SHADE_TRIANGLE, SHADE_QUAD, SHADE_EXACT } shading;

typedef struct lit_patch {
    const limni_grid *grid;
    const vectors *positions;
    const vectors *normals; ///< of all rows, or of the corners
    size_t corner_count, row_count;
    vectors *colours; ///< red, green and blue
} lit_patch;

/// From the corners to some rows: (1 - u - v) a + u b + v c, or
/// (1 - v) ((1 - u) a + u b) + v ((1 - u) d + u c).
static LIMNI_INLINE lanes interpolate(shading how, const limni_grid *grid, const float *corners,
                                      size_t row) {
    const lanes u = lanes_load_any(grid->u + row), v = lanes_load_any(grid->v + row);
    const lanes a = lanes_splat(corners[0]), b = lanes_splat(corners[1]);
    const lanes c = lanes_splat(corners[2]), rest = lanes_subtract(lanes_splat(1.0f), u);
    if (how == SHADE_TRIANGLE) {
        const lanes first = lanes_multiply(lanes_subtract(rest, v), a);
        return lanes_add(lanes_add(first, lanes_multiply(u, b)), lanes_multiply(v, c));
    }
    const lanes d = lanes_splat(corners[3]), below = lanes_subtract(lanes_splat(1.0f), v);
    const lanes ab = lanes_add(lanes_multiply(rest, a), lanes_multiply(u, b));
    const lanes dc = lanes_add(lanes_multiply(rest, d), lanes_multiply(u, c));
    return lanes_add(lanes_multiply(below, ab), lanes_multiply(v, dc));
}

static LIMNI_INLINE void add_light(limn_light_kind kind, shading how, const lamp *l,
                                   const lit_patch *p) {
    float corners[LIMN_CORNER_MAX + LANES_WIDTH];
    for (size_t row = 0; how != SHADE_EXACT && row < p->corner_count; row += LANES_WIDTH) {
        const beam b = find_beam(kind, l, p->positions, row);
        lanes_store(corners + row, find_cosine(&b, p->normals, row));
    }
    for (size_t row = 0; row < p->row_count; row += LANES_WIDTH) {
        const beam b = find_beam(kind, l, p->positions, row);
        const lanes cosine = how == SHADE_EXACT ? find_cosine(&b, p->normals, row)
                                                : interpolate(how, p->grid, corners, row);
        const lanes share = attenuate(kind, l, &b, cosine);
        for (int axis = 0; axis < 3; axis++) {
            float *const plane = &p->colours->axes[axis][row];
            const lanes added = lanes_multiply(lanes_splat(l->colour[axis]), share);
            lanes_store(plane, lanes_add(lanes_load_any(plane), added));
        }
    }
}

/// Each kind of light has its own loops, without branches.
static LIMNI_INLINE void add_lights(shading how, const limn_lighting *lighting,
                                    const lit_patch *p) {
    for (uint32_t i = 0; i < lighting->light_count; i++) {
        const lamp l = make_lamp(&lighting->lights[i]);
        switch (lighting->lights[i].kind) {
        case LIMN_LIGHT_DIRECTIONAL:
            add_light(LIMN_LIGHT_DIRECTIONAL, how, &l, p);
            break;
        case LIMN_LIGHT_POINT:
            add_light(LIMN_LIGHT_POINT, how, &l, p);
            break;
        default:
            add_light(LIMN_LIGHT_SPOT, how, &l, p);
            break;
        }
    }
}

/// All light on a patch.
static LIMNI_NOINLINE void light_patch(const limn_lighting *lighting, const lit_patch *p) {
    for (int axis = 0; axis < 3; axis++) {
        const lanes ambient = lanes_splat(lighting->ambient[axis]);
        for (size_t row = 0; row < p->row_count; row += LANES_WIDTH)
            lanes_store(&p->colours->axes[axis][row], ambient);
    }
    // At level 0 there is nothing between the corners, where both modes are the same.
    if (lighting->mode == LIMN_LIGHT_EXACT || p->row_count == p->corner_count) {
        add_lights(SHADE_EXACT, lighting, p);
    } else if (p->corner_count == 3) {
        add_lights(SHADE_TRIANGLE, lighting, p);
    } else {
        add_lights(SHADE_QUAD, lighting, p);
    }
}

#endif
