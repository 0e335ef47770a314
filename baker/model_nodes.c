/* SPDX-License-Identifier: MIT */
/* The tree of nodes: order, places at rest, and what moves. */
#include "model_reader.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *limni_label_make(limni_label text, const char *what, uint32_t index, const char *name) {
    if (name[0])
        snprintf(text, sizeof(limni_label), "%s %u '%.60s'", what, index, name);
    else
        snprintf(text, sizeof(limni_label), "%s %u", what, index);
    return text;
}

// ---- Transforms

limni_transform limni_model_local(const limni_model_node *node) {
    if (!node->has_matrix)
        return limni_transform_make(node->translation, node->rotation, node->scale);
    limni_transform t;
    for (int i = 0; i < 12; i++)
        t.rows[i % 3][i / 3] = node->matrix[4 * (i / 3) + i % 3];
    return t;
}

/// The cofactors of the linear part: column `column` of its inverse, but for the determinant.
static void cross(const double a[4], const double b[4], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double limni_transform_determinant(const limni_transform *t) {
    double product[3];
    cross(t->rows[1], t->rows[2], product);
    return t->rows[0][0] * product[0] + t->rows[0][1] * product[1] + t->rows[0][2] * product[2];
}

bool limni_transform_invert(const limni_transform *t, limni_transform *inverse) {
    const double determinant = limni_transform_determinant(t);
    double size = 1;
    for (int row = 0; row < 3; row++)
        size *= length_of(t->rows[row]);
    if (!(fabs(determinant) > 1e-9 * size)) return false;
    for (int column = 0; column < 3; column++) {
        double cofactors[3];
        cross(t->rows[(column + 1) % 3], t->rows[(column + 2) % 3], cofactors);
        for (int row = 0; row < 3; row++)
            inverse->rows[row][column] = cofactors[row] / determinant;
    }
    for (int row = 0; row < 3; row++)
        inverse->rows[row][3] =
            -(inverse->rows[row][0] * t->rows[0][3] + inverse->rows[row][1] * t->rows[1][3] +
              inverse->rows[row][2] * t->rows[2][3]);
    return true;
}

/// Of a rotation matrix, from the largest of its components (Shepperd).
static void to_quaternion(const double m[3][3], double q[4]) {
    const double trace = m[0][0] + m[1][1] + m[2][2];
    int largest = 3;
    for (int i = 0; i < 3; i++) {
        if (m[i][i] > (largest == 3 ? trace : m[largest][largest])) largest = i;
    }
    if (largest == 3) {
        for (int i = 0; i < 3; i++)
            q[i] = m[(i + 2) % 3][(i + 1) % 3] - m[(i + 1) % 3][(i + 2) % 3];
        q[3] = 1 + trace;
    } else {
        const int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
        q[i] = 1 + m[i][i] - m[j][j] - m[k][k];
        q[j] = m[j][i] + m[i][j];
        q[k] = m[k][i] + m[i][k];
        q[3] = m[k][j] - m[j][k];
    }
    limni_quaternion_normalise(q);
}

bool limni_transform_decompose(const limni_transform *t, double translation[3], double rotation[4],
                               double scale[3]) {
    double turned[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, shear = 0;
    const bool mirrors = limni_transform_determinant(t) < 0;
    for (int column = 0; column < 3; column++) {
        double axis[3];
        for (int row = 0; row < 3; row++)
            axis[row] = t->rows[row][column];
        translation[column] = t->rows[column][3];
        scale[column] = length_of(axis) * (mirrors && column == 0 ? -1 : 1);
    }
    const bool flat = scale[0] == 0 || scale[1] == 0 || scale[2] == 0;
    for (int i = 0; i < 9 && !flat; i++)
        turned[i / 3][i % 3] = t->rows[i / 3][i % 3] / scale[i % 3];
    for (int column = 0; column < 3; column++) {
        const int other = (column + 1) % 3;
        double product = 0;
        for (int row = 0; row < 3; row++)
            product += turned[row][column] * turned[row][other];
        shear = fmax(shear, fabs(product));
    }
    to_quaternion((const double(*)[3])turned, rotation);
    return shear < 1e-4;
}

bool limni_transform_round(const limni_transform *t, float rows[3][4]) {
    bool finite = true;
    for (int i = 0; i < 12; i++) {
        rows[i / 4][i % 4] = (float)t->rows[i / 4][i % 4];
        finite &= isfinite(rows[i / 4][i % 4]) != 0;
    }
    return finite;
}

// ---- The tree

static limn_bake_status refuse_node(const limni_model_reader *reader, uint32_t node,
                                    const char *text) {
    limni_label label;
    return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: %s", reader->model->path,
                      limni_label_make(label, "node", node, reader->model->nodes[node].name), text);
}

static limn_bake_status find_parents(limni_model_reader *reader) {
    const limni_model *const model = reader->model;
    for (uint32_t n = 0; n < model->node_count; n++) {
        const limni_model_node *const node = &model->nodes[n];
        for (uint32_t c = 0; c < node->child_count; c++) {
            const int child = node->children[c];
            if (child < 0 || (uint32_t)child >= model->node_count)
                return refuse_node(reader, n, "it has a child that does not exist");
            if (reader->places[child].parent != LIMN_FORMAT_NONE)
                return refuse_node(reader, (uint32_t)child, "it is a child of two nodes, or twice");
            reader->places[child].parent = n;
        }
    }
    return LIMN_BAKE_OK;
}

/// Depth first. Nodes that are their own ancestors are not met: nothing leads to them from a root.
static limn_bake_status find_order(limni_model_reader *reader) {
    const limni_model *const model = reader->model;
    uint32_t *const waiting = limni_allocate(reader->context, model->node_count, sizeof *waiting);
    bool *const met = limni_allocate_zeroed(reader->context, model->node_count, sizeof *met);
    if (!waiting || !met) return LIMN_BAKE_MEMORY;
    uint32_t count = 0;
    for (uint32_t root = 0; root < model->node_count; root++) {
        if (reader->places[root].parent != LIMN_FORMAT_NONE) continue;
        uint32_t waiting_count = 0;
        waiting[waiting_count++] = root;
        while (waiting_count) {
            const uint32_t n = waiting[--waiting_count];
            const limni_model_node *const node = &model->nodes[n];
            reader->order[count++] = n;
            met[n] = true;
            for (uint32_t c = node->child_count; c-- > 0;)
                waiting[waiting_count++] = (uint32_t)node->children[c];
        }
    }
    for (uint32_t n = 0; n < model->node_count; n++) {
        if (!met[n]) return refuse_node(reader, n, "it is its own ancestor, or hangs on one");
    }
    limni_release(reader->context, waiting);
    limni_release(reader->context, met);
    return LIMN_BAKE_OK;
}

static limn_bake_status mark_scene(limni_model_reader *reader) {
    const limni_model *const model = reader->model;
    for (uint32_t r = 0; r < model->root_count; r++) {
        const int root = model->roots[r];
        if (root < 0 || (uint32_t)root >= model->node_count)
            return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: the scene has node %d, but there are %u", model->path, root,
                              model->node_count);
        reader->places[root].in_scene = true;
    }
    for (uint32_t n = 0; n < model->node_count && !model->has_scene; n++)
        reader->places[n].in_scene = true;
    return LIMN_BAKE_OK;
}

static void mark_moving(limni_model_reader *reader) {
    const limni_model *const model = reader->model;
    for (uint32_t a = 0; a < model->animation_count; a++) {
        const limni_model_animation *const animation = &model->animations[a];
        for (uint32_t c = 0; c < animation->channel_count; c++) {
            const limni_model_channel *const channel = &animation->channels[c];
            if (channel->node >= 0 && (uint32_t)channel->node < model->node_count &&
                channel->path != LIMN_FORMAT_TARGET_WEIGHTS)
                reader->places[channel->node].moves = true;
        }
    }
}

/// Whether floats hold where a node is, and how it turns.
static bool is_finite(const limni_model_node *node, const limni_transform *local,
                      const limni_transform *global) {
    float rounded[3][4];
    bool finite = limni_transform_round(local, rounded) && limni_transform_round(global, rounded);
    for (int i = 0; i < 4; i++)
        finite &= fabs(node->rotation[i]) <= (double)FLT_MAX;
    return finite;
}

limn_bake_status limni_model_read_nodes(limni_model_reader *reader) {
    const limni_model *const model = reader->model;
    const uint32_t count = model->node_count;
    reader->places = limni_allocate_zeroed(reader->context, count, sizeof *reader->places);
    reader->order = limni_allocate(reader->context, count, sizeof *reader->order);
    if (!reader->places || !reader->order) return LIMN_BAKE_MEMORY;
    for (uint32_t n = 0; n < count; n++)
        reader->places[n].parent = reader->places[n].joint = reader->places[n].mesh =
            LIMN_FORMAT_NONE;
    LIMNI_TRY(find_parents(reader));
    LIMNI_TRY(find_order(reader));
    LIMNI_TRY(mark_scene(reader));
    mark_moving(reader);
    for (uint32_t o = 0; o < count; o++) {
        limni_model_place *const place = &reader->places[reader->order[o]];
        const limni_model_node *const node = &model->nodes[reader->order[o]];
        const limni_transform local = limni_model_local(node);
        if (node->mistake) return refuse_node(reader, reader->order[o], node->mistake);
        place->global = local;
        if (place->parent != LIMN_FORMAT_NONE) {
            const limni_model_place *const parent = &reader->places[place->parent];
            place->global = limni_transform_multiply(&parent->global, &local);
            place->in_scene |= parent->in_scene;
            place->moves |= parent->moves;
        }
        if (!is_finite(node, &local, &place->global))
            return refuse_node(reader, reader->order[o], "its place is not finite");
    }
    return LIMN_BAKE_OK;
}
