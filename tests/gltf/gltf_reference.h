/* SPDX-License-Identifier: MIT */
/*
 * What glTF 2.0 says about the vertices of a mesh at a moment of an animation, in double precision
 * and from the document alone: no code of the importer or of the runtime. For good files.
 */
#ifndef GLTF_REFERENCE_H
#define GLTF_REFERENCE_H

#include "../../baker/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Columns, as in the file: m[4 * column + row].
typedef struct reference_matrix {
    double m[16];
} reference_matrix;

static inline reference_matrix reference_identity(void) {
    return (reference_matrix){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
}

static inline reference_matrix reference_product(reference_matrix a, reference_matrix b) {
    reference_matrix c = {{0}};
    for (int i = 0; i < 64; i++)
        c.m[4 * (i / 16) + i % 4] += a.m[4 * (i / 4 % 4) + i % 4] * b.m[4 * (i / 16) + i / 4 % 4];
    return c;
}

static inline void reference_apply(reference_matrix a, const double p[3], double out[3]) {
    const double from[3] = {p[0], p[1], p[2]};
    for (int row = 0; row < 3; row++)
        out[row] =
            a.m[row] * from[0] + a.m[4 + row] * from[1] + a.m[8 + row] * from[2] + a.m[12 + row];
}

static inline double reference_component(const unsigned char *bytes, int type, bool normalised) {
    int8_t i8;
    int16_t i16;
    uint16_t u16;
    uint32_t u32;
    float f;
    switch (type) {
    case 5120:
        memcpy(&i8, bytes, 1);
        return normalised ? fmax(i8 / 127.0, -1) : i8;
    case 5121:
        return normalised ? *bytes / 255.0 : *bytes;
    case 5122:
        memcpy(&i16, bytes, 2);
        return normalised ? fmax(i16 / 32767.0, -1) : i16;
    case 5123:
        memcpy(&u16, bytes, 2);
        return normalised ? u16 / 65535.0 : u16;
    case 5125:
        memcpy(&u32, bytes, 4);
        return u32;
    default:
        memcpy(&f, bytes, 4);
        return (double)f;
    }
}

/// All components of an accessor, for the caller to free.
static inline double *reference_read(const limni_gltf *d, int index) {
    static const size_t sizes[] = {1, 1, 2, 2, 0, 4, 4};
    const limni_gltf_accessor *const a = &d->accessors[index];
    const size_t n = a->component_count, size = sizes[a->component_type - 5120];
    double *const values = calloc(a->count * n, sizeof *values);
    for (size_t i = 0; a->view >= 0 && i < a->count * n; i++) {
        const limni_gltf_view *const v = &d->views[a->view];
        const size_t stride = v->stride ? v->stride : n * size;
        values[i] = reference_component(d->buffers[v->buffer].bytes + v->offset + a->offset +
                                            i / n * stride + i % n * size,
                                        a->component_type, a->normalised);
    }
    for (size_t s = 0; s < a->sparse_count; s++) {
        const limni_gltf_view *const iv = &d->views[a->sparse_index_view];
        const limni_gltf_view *const vv = &d->views[a->sparse_value_view];
        const size_t at = (size_t)reference_component(d->buffers[iv->buffer].bytes + iv->offset +
                                                          a->sparse_index_offset +
                                                          s * sizes[a->sparse_index_type - 5120],
                                                      a->sparse_index_type, false);
        for (size_t c = 0; c < n; c++)
            values[at * n + c] =
                reference_component(d->buffers[vv->buffer].bytes + vv->offset +
                                        a->sparse_value_offset + (s * n + c) * size,
                                    a->component_type, a->normalised);
    }
    return values;
}

// ---- Animation

/// Values of two keys and what lies between them.
typedef struct reference_span {
    const double *a, *b; ///< with the tangents of cubic ones around them
    double t, seconds;
    size_t width;
    bool between;
} reference_span;

static inline double reference_cubic(const reference_span *s, size_t i) {
    const double t = s->t, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * s->a[i] + s->seconds * (t3 - 2 * t2 + t) * s->a[i + s->width] +
           (-2 * t3 + 3 * t2) * s->b[i] + s->seconds * (t3 - t2) * *(s->b + i - s->width);
}

static inline double reference_slerp(const reference_span *s, size_t i) {
    double dot = 0;
    for (size_t k = 0; k < s->width; k++)
        dot += s->a[k] * s->b[k];
    const double angle = acos(fmin(fabs(dot), 1)), b = dot < 0 ? -s->b[i] : s->b[i];
    if (angle < 1e-9) return (1 - s->t) * s->a[i] + s->t * b;
    return sin((1 - s->t) * angle) / sin(angle) * s->a[i] + sin(s->t * angle) / sin(angle) * b;
}

static inline double reference_between(const reference_span *s, const char *interpolation,
                                       bool rotation, size_t i) {
    if (!s->between || strcmp(interpolation, "STEP") == 0) return s->a[i];
    if (strcmp(interpolation, "CUBICSPLINE") == 0) return reference_cubic(s, i);
    return rotation ? reference_slerp(s, i) : (1 - s->t) * s->a[i] + s->t * s->b[i];
}

static inline void reference_sample_channel(const limni_gltf *d, const limni_gltf_channel *channel,
                                            double time, size_t width, double *value) {
    double *const times = reference_read(d, channel->input);
    double *const values = reference_read(d, channel->output);
    const size_t count = d->accessors[channel->input].count;
    const bool cubic = strcmp(channel->interpolation, "CUBICSPLINE") == 0;
    const size_t step = (cubic ? 3 : 1) * width;
    size_t k = 0;
    while (k + 1 < count && times[k + 1] <= time)
        k++;
    reference_span s = {.a = values + k * step + (cubic ? width : 0), .width = width};
    s.between = time > times[k] && k + 1 < count;
    if (s.between) {
        s.b = s.a + step;
        s.seconds = times[k + 1] - times[k];
        s.t = (time - times[k]) / s.seconds;
    }
    for (size_t i = 0; i < width; i++)
        value[i] = reference_between(&s, channel->interpolation,
                                     strcmp(channel->path, "rotation") == 0, i);
    free(times);
    free(values);
}

/// A property of a node: its own value, or that of a channel at a time.
static inline void reference_sample(const limni_gltf *d, const limni_gltf_animation *animation,
                                    double time, int node, const char *path, size_t width,
                                    double *value) {
    for (uint32_t c = 0; animation && c < animation->channel_count; c++) {
        const limni_gltf_channel *const channel = &animation->channels[c];
        if (channel->node == node && strcmp(channel->path, path) == 0)
            reference_sample_channel(d, channel, time, width, value);
    }
}

static inline reference_matrix reference_local(const limni_gltf *d,
                                               const limni_gltf_animation *animation, double time,
                                               int index) {
    const limni_model_node *const node = &d->nodes[index];
    double t[3], q[4], s[3];
    bool animated = false;
    for (uint32_t c = 0; animation && c < animation->channel_count; c++)
        animated |= animation->channels[c].node == index;
    memcpy(t, node->translation, sizeof t);
    memcpy(q, node->rotation, sizeof q);
    memcpy(s, node->scale, sizeof s);
    if (node->has_matrix && !animated) {
        reference_matrix m;
        memcpy(m.m, node->matrix, sizeof m.m);
        return m;
    }
    reference_sample(d, animation, time, index, "translation", 3, t);
    reference_sample(d, animation, time, index, "rotation", 4, q);
    reference_sample(d, animation, time, index, "scale", 3, s);
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    reference_matrix m = reference_identity();
    for (int column = 0; column < 3; column++) {
        // q e q*, with e the axis: e + 2 w (v x e) + 2 v x (v x e)
        const double e[3] = {column == 0, column == 1, column == 2};
        const double v[3] = {q[0] / length, q[1] / length, q[2] / length}, w = q[3] / length;
        const double c[3] = {v[1] * e[2] - v[2] * e[1], v[2] * e[0] - v[0] * e[2],
                             v[0] * e[1] - v[1] * e[0]};
        const double cc[3] = {v[1] * c[2] - v[2] * c[1], v[2] * c[0] - v[0] * c[2],
                              v[0] * c[1] - v[1] * c[0]};
        for (int row = 0; row < 3; row++)
            m.m[4 * column + row] = (e[row] + 2 * w * c[row] + 2 * cc[row]) * s[column];
        m.m[12 + column] = t[column];
    }
    return m;
}

static inline reference_matrix reference_global(const limni_gltf *d,
                                                const limni_gltf_animation *animation, double time,
                                                int index) {
    const reference_matrix local = reference_local(d, animation, time, index);
    for (uint32_t n = 0; n < d->node_count; n++) {
        for (uint32_t c = 0; c < d->nodes[n].child_count; c++) {
            if (d->nodes[n].children[c] == index)
                return reference_product(reference_global(d, animation, time, (int)n), local);
        }
    }
    return local;
}

// ---- Vertices

static inline int reference_attribute(const limni_gltf_attributes *attributes, const char *name) {
    for (uint32_t a = 0; a < attributes->count; a++) {
        if (strcmp(attributes->items[a].name, name) == 0) return attributes->items[a].accessor;
    }
    return -1;
}

/// A moment of an animation.
typedef struct reference_moment {
    const limni_gltf *document;
    const limni_gltf_animation *animation; ///< NULL: at rest
    double time;
} reference_moment;

static inline void reference_morph(const reference_moment *at, int index,
                                   const limni_gltf_primitive *primitive, double *points,
                                   size_t count) {
    const limni_gltf *const d = at->document;
    const limni_model_node *const node = &d->nodes[index];
    const limni_gltf_mesh *const mesh = &d->meshes[node->mesh];
    double weights[64] = {0};
    for (uint32_t t = 0; t < primitive->target_count; t++)
        weights[t] = node->weight_count   ? node->weights[t]
                     : mesh->weight_count ? mesh->weights[t]
                                          : 0;
    reference_sample(d, at->animation, at->time, index, "weights", primitive->target_count,
                     weights);
    for (uint32_t t = 0; t < primitive->target_count; t++) {
        double *const deltas =
            reference_read(d, reference_attribute(&primitive->targets[t], "POSITION"));
        for (size_t i = 0; i < 3 * count; i++)
            points[i] += weights[t] * deltas[i];
        free(deltas);
    }
}

static inline reference_matrix *reference_joints(const reference_moment *at,
                                                 const limni_gltf_skin *skin) {
    const limni_gltf *const d = at->document;
    double *const binds = skin->inverse_binds >= 0 ? reference_read(d, skin->inverse_binds) : NULL;
    reference_matrix *const matrices = malloc(skin->joint_count * sizeof *matrices);
    for (uint32_t j = 0; j < skin->joint_count; j++) {
        reference_matrix bind = reference_identity();
        if (binds) memcpy(bind.m, binds + 16 * (size_t)j, sizeof bind.m);
        matrices[j] =
            reference_product(reference_global(d, at->animation, at->time, skin->joints[j]), bind);
    }
    free(binds);
    return matrices;
}

static inline void reference_skin(const reference_moment *at, const limni_gltf_skin *skin,
                                  const limni_gltf_primitive *primitive, double *points,
                                  size_t count) {
    const limni_gltf *const d = at->document;
    double *const joints =
        reference_read(d, reference_attribute(&primitive->attributes, "JOINTS_0"));
    double *const shares =
        reference_read(d, reference_attribute(&primitive->attributes, "WEIGHTS_0"));
    reference_matrix *const matrices = reference_joints(at, skin);
    for (size_t i = 0; i < count; i++) {
        double sum[3] = {0}, total = 0;
        for (size_t k = 4 * i; k < 4 * i + 4; k++) {
            double moved[3];
            reference_apply(matrices[(size_t)joints[k]], points + 3 * i, moved);
            for (int axis = 0; axis < 3; axis++)
                sum[axis] += shares[k] * moved[axis];
            total += shares[k];
        }
        for (size_t axis = 0; axis < 3; axis++)
            points[3 * i + axis] = sum[axis] / total;
    }
    free(joints);
    free(shares);
    free(matrices);
}

/// Vertices of one primitive of a node, for the caller to free.
///
/// posed  false: in the bind pose, without morph targets; a mesh without a skin at its node's rest
static inline double *reference_vertices(const reference_moment *at, int index,
                                         uint32_t primitive_index, bool posed, size_t *count) {
    const limni_gltf *const d = at->document;
    const limni_model_node *const node = &d->nodes[index];
    const limni_gltf_primitive *const primitive =
        &d->meshes[node->mesh].primitives[primitive_index];
    const int positions = reference_attribute(&primitive->attributes, "POSITION");
    double *const points = reference_read(d, positions);
    *count = d->accessors[positions].count;
    if (posed) reference_morph(at, index, primitive, points, *count);
    if (node->skin >= 0) {
        if (posed) reference_skin(at, &d->skins[node->skin], primitive, points, *count);
        return points;
    }
    const reference_matrix m = reference_global(d, posed ? at->animation : NULL, at->time, index);
    for (size_t i = 0; i < *count; i++)
        reference_apply(m, points + 3 * i, points + 3 * i);
    return points;
}

#endif
