/* SPDX-License-Identifier: MIT */
#include "imp_gltf.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

point imp_pose_point(point p) {
    const double size = 0.9, sole = -0.035;
    const double behind = -0.40 - p.z;
    if (behind > 0.0 && p.y < 1.19) p.x += 0.9 * behind * behind;
    p.y -= sole;
    return scale(p, size);
}

/* ---- bones ---- */

/* In the cage: a joint at `from`, whose bone reaches to `to` and moves what is within `radius`. */
typedef struct bone {
    const char *name;
    int parent;
    point from, to;
    double radius;
} bone;

enum {
    hips,
    chest,
    head,
    left_arm,
    left_hand,
    right_arm,
    right_hand,
    left_leg,
    left_foot,
    right_leg,
    right_foot,
    tail,
    tail_middle,
    tail_tip,
    left_ear,
    right_ear,
    bone_count
};

static const bone bones[bone_count] = {
    [hips] = {"hips", -1, {0.0, 0.50, 0.0}, {0.0, 0.75, 0.0}, 0.40},
    [chest] = {"chest", hips, {0.0, 0.85, 0.0}, {0.0, 1.12, 0.0}, 0.30},
    [head] = {"head", chest, {0.0, 1.17, 0.0}, {0.0, 1.95, 0.0}, 0.60},
    [left_arm] = {"left arm", chest, {0.40, 1.00, 0.0}, {0.62, 0.84, 0.0}, 0.13},
    [left_hand] = {"left hand", left_arm, {0.66, 0.77, 0.02}, {0.80, 0.36, 0.17}, 0.15},
    [right_arm] = {"right arm", chest, {-0.40, 0.98, 0.0}, {-0.80, 0.93, 0.04}, 0.13},
    [right_hand] = {"right hand", right_arm, {-0.85, 0.96, 0.05}, {-1.04, 1.34, 0.13}, 0.16},
    [left_leg] = {"left leg", hips, {0.24, 0.38, 0.0}, {0.28, 0.05, 0.0}, 0.18},
    [left_foot] = {"left foot", left_leg, {0.28, 0.02, 0.05}, {0.34, 0.05, 0.48}, 0.16},
    [right_leg] = {"right leg", hips, {-0.24, 0.38, 0.0}, {-0.28, 0.05, 0.0}, 0.18},
    [right_foot] = {"right foot", right_leg, {-0.28, 0.02, 0.05}, {-0.34, 0.05, 0.48}, 0.16},
    [tail] = {"tail", hips, {0.0, 0.52, -0.34}, {0.0, 0.42, -0.70}, 0.11},
    [tail_middle] = {"tail middle", tail, {0.0, 0.44, -0.84}, {0.0, 0.80, -1.04}, 0.10},
    [tail_tip] = {"tail tip", tail_middle, {0.0, 0.86, -1.04}, {0.0, 1.18, -1.00}, 0.20},
    [left_ear] = {"left ear", head, {0.66, 1.68, -0.14}, {1.30, 2.12, -0.32}, 0.15},
    [right_ear] = {"right ear", head, {-0.66, 1.68, -0.14}, {-1.30, 2.12, -0.32}, 0.15},
};

static point joint_place(int b) {
    return imp_pose_point(bones[b].from);
}

/* The squared distance of a point of the imp from a bone, in radii of the bone. */
static double squared_distance_from(const bone *b, point p) {
    const point from = imp_pose_point(b->from);
    const point along = subtract(imp_pose_point(b->to), from);
    const point offset = subtract(p, from);
    double t = dot(offset, along) / dot(along, along);
    t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    const point away = subtract(offset, scale(along, t));
    return dot(away, away) / (b->radius * b->radius) + 1e-3;
}

enum { influence_count = 4 };

typedef struct influences {
    int joints[influence_count];
    double weights[influence_count];
} influences;

/* The nearest bones, each by the eighth power of its nearness, in steps of 1/1024. */
static influences find_influences(point p) {
    influences found = {{0}, {0}};
    for (int b = 0; b < bone_count; ++b) {
        const double square = squared_distance_from(&bones[b], p);
        double weight = 1.0 / (square * square * square * square);
        int joint = b;
        for (int i = 0; i < influence_count; ++i) {
            if (weight <= found.weights[i]) continue;
            const double other = found.weights[i];
            const int other_joint = found.joints[i];
            found.weights[i] = weight;
            found.joints[i] = joint;
            weight = other;
            joint = other_joint;
        }
    }
    double sum = 0.0, rest = 1.0;
    for (int i = 0; i < influence_count; ++i) {
        sum += found.weights[i];
    }
    for (int i = influence_count - 1; i >= 0; --i) {
        found.weights[i] = i ? floor(found.weights[i] / sum * 1024.0 + 0.5) / 1024.0 : rest;
        if (found.weights[i] == 0.0) found.joints[i] = 0;
        rest -= found.weights[i];
    }
    return found;
}

/* ---- what moves ---- */

enum { key_count = 9 };

static const double key_step = 0.25; /* seconds */

/* Turns of a joint about an axis at the keys, as tangents of half the angles. */
typedef struct turn {
    int joint;
    point axis;
    double keys[key_count];
} turn;

static const turn turns[] = {
    {right_arm, {0, 0, 1}, {0, -0.10, -0.16, -0.10, 0, -0.10, -0.16, -0.10, 0}},
    {right_hand, {0, 0, 1}, {0, 0.24, 0, -0.12, 0, 0.24, 0, -0.12, 0}},
    {head, {0, 0, 1}, {0, -0.04, -0.07, -0.04, 0, 0.04, 0.07, 0.04, 0}},
    {chest, {0, 1, 0}, {0, 0.04, 0.06, 0.04, 0, -0.04, -0.06, -0.04, 0}},
    {left_hand, {1, 0, 0}, {0, 0.06, 0.10, 0.06, 0, -0.06, -0.10, -0.06, 0}},
    {tail, {0, 1, 0}, {0.10, 0, -0.12, -0.18, -0.12, 0, 0.12, 0.15, 0.10}},
    {tail_middle, {0, 1, 0}, {0.16, 0.10, 0, -0.12, -0.18, -0.12, 0, 0.12, 0.16}},
    {tail_tip, {0, 0, 1}, {0.10, 0.16, 0.10, 0, -0.12, -0.18, -0.12, 0, 0.10}},
    {left_ear, {0, 0, 1}, {0, 0, -0.10, 0, 0, 0, -0.10, 0, 0}},
    {right_ear, {0, 0, 1}, {0, 0, 0.10, 0, 0, 0, 0.10, 0, 0}},
};
enum { turn_count = sizeof turns / sizeof turns[0] };

static const double breaths[key_count] = {0, 0.3, 0.8, 1, 0.6, 0.2, 0.3, 0.2, 0};

/* The morph target: the belly comes forward. */
static point belly_delta(point p) {
    const double low = p.y - 0.45, high = 1.05 - p.y;
    if (low <= 0.0 || high <= 0.0 || p.z <= 0.0) return (point){0, 0, 0};
    const double share = low * high * 4.0;
    return (point){0.25 * share * p.x, 0.0, 0.7 * share * p.z};
}

/* ---- the buffer ---- */

enum { max_vertices = 2 * max_points, max_bytes = 1 << 19 };

/* Texture coordinates have an island for what faces the front and one for what does not, so a
 * vertex may be on both. */
typedef struct character {
    const mesh *m;
    int vertex_count;
    int points[max_vertices];
    bool is_back[max_vertices];
    int vertices[max_points][2]; /* of each point, in front and behind; -1: none */
    size_t byte_count;
    unsigned char bytes[max_bytes];
} character;

static bool faces_back(const mesh *m, const face *f) {
    const point a = m->points[f->corners[0]];
    const point normal =
        cross(subtract(m->points[f->corners[1]], a), subtract(m->points[f->corners[2]], a));
    return normal.z < 0.0;
}

static int vertex_of(character *c, int p, bool back) {
    int *const vertex = &c->vertices[p][back];
    if (*vertex >= 0) return *vertex;
    c->points[c->vertex_count] = p;
    c->is_back[c->vertex_count] = back;
    return *vertex = c->vertex_count++;
}

static void put_bytes(character *c, uint32_t value, int size) {
    if (c->byte_count + (size_t)size > max_bytes) fail("imp.gltf", "too many bytes");
    for (int i = 0; i < size; ++i) {
        c->bytes[c->byte_count++] = (unsigned char)(value >> 8 * i);
    }
}

static void put_float(character *c, double value) {
    const float rounded = (float)value;
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    put_bytes(c, bits, 4);
}

static void put_point(character *c, point p) {
    put_float(c, p.x);
    put_float(c, p.y);
    put_float(c, p.z);
}

/* The accessors, each with a view of its own. */
enum {
    of_indices,
    of_positions,
    of_uvs,
    of_joints,
    of_weights,
    of_deltas,
    of_matrices,
    of_times,
    of_breaths,
    of_turns, /* and so many behind it */
    accessor_count = of_turns + turn_count
};

static void put_vertices(character *c, int accessor) {
    for (int v = 0; v < c->vertex_count; ++v) {
        const point p = c->m->points[c->points[v]];
        const influences i = find_influences(p);
        if (accessor == of_positions) put_point(c, p);
        if (accessor == of_deltas) put_point(c, belly_delta(p));
        if (accessor == of_uvs) {
            put_float(c, 0.25 + (c->is_back[v] ? 0.5 : 0.0) + 0.18 * p.x);
            put_float(c, 1.0 - p.y / 2.4);
        }
        for (int k = 0; k < influence_count; ++k) {
            if (accessor == of_joints) put_bytes(c, (uint32_t)i.joints[k], 1);
            if (accessor == of_weights) put_float(c, i.weights[k]);
        }
    }
}

/* Column after column: only what moves a joint to the origin. */
static void put_inverse_bind(character *c, int b) {
    const point place = scale(joint_place(b), -1.0);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 4; ++row) {
            put_float(c, row == column ? 1.0 : 0.0);
        }
    }
    put_point(c, place);
    put_float(c, 1.0);
}

static void put_turn(character *c, const turn *t) {
    for (int k = 0; k < key_count; ++k) {
        const double w = 1.0 / sqrt(1.0 + t->keys[k] * t->keys[k]);
        put_point(c, scale(t->axis, t->keys[k] * w));
        put_float(c, w);
    }
}

static void put_indices(character *c) {
    for (int i = 0; i < c->m->face_count; ++i) {
        const face *f = &c->m->faces[i];
        for (int k = 0; k < 3; ++k) {
            put_bytes(c, (uint32_t)vertex_of(c, f->corners[k], faces_back(c->m, f)), 2);
        }
    }
}

static void put_accessor(character *c, int accessor) {
    if (accessor == of_indices) put_indices(c);
    if (accessor > of_indices && accessor <= of_deltas) put_vertices(c, accessor);
    for (int b = 0; accessor == of_matrices && b < bone_count; ++b) {
        put_inverse_bind(c, b);
    }
    for (int k = 0; k < key_count; ++k) {
        if (accessor == of_times) put_float(c, key_step * k);
        if (accessor == of_breaths) put_float(c, breaths[k]);
    }
    if (accessor >= of_turns) put_turn(c, &turns[accessor - of_turns]);
}

/* ---- the file ---- */

static void print_bytes(const character *c, FILE *out) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    fprintf(out,
            "  \"buffers\": [{\"byteLength\": %zu, \"uri\": "
            "\"data:application/octet-stream;base64,",
            c->byte_count);
    for (size_t i = 0; i < c->byte_count; i += 3) {
        const size_t left = c->byte_count - i;
        const unsigned bits = (unsigned)c->bytes[i] << 16 |
                              (left > 1 ? (unsigned)c->bytes[i + 1] << 8 : 0u) |
                              (left > 2 ? c->bytes[i + 2] : 0u);
        fputc(digits[bits >> 18 & 63], out);
        fputc(digits[bits >> 12 & 63], out);
        fputc(left > 1 ? digits[bits >> 6 & 63] : '=', out);
        fputc(left > 2 ? digits[bits & 63] : '=', out);
    }
    fputs("\"}]\n", out);
}

static float float_at(const character *c, size_t at) {
    uint32_t bits = 0;
    float value;
    for (int i = 0; i < 4; ++i) {
        bits |= (uint32_t)c->bytes[at + (size_t)i] << 8 * i;
    }
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The smallest and the largest of each component of the floats in [begin, end): exactly. */
static void print_bounds(const character *c, size_t begin, size_t end, size_t width, FILE *out) {
    for (int largest = 0; largest < 2; ++largest) {
        fprintf(out, ", \"%s\": [", largest ? "max" : "min");
        for (size_t component = 0; component < width; ++component) {
            float bound = float_at(c, begin + 4 * component);
            for (size_t at = begin + 4 * component; at < end; at += 4 * width) {
                const float value = float_at(c, at);
                if (largest ? value > bound : value < bound) bound = value;
            }
            fprintf(out, "%s%.9g", component ? ", " : "", bound);
        }
        fputs("]", out);
    }
}

static void print_accessors(const character *c, const size_t starts[accessor_count + 1],
                            FILE *out) {
    static const struct {
        const char *type;
        int component, vertex_elements;
    } kinds[] = {
        [of_indices] = {"SCALAR", 5123, 0}, [of_positions] = {"VEC3", 5126, 1},
        [of_uvs] = {"VEC2", 5126, 1},       [of_joints] = {"VEC4", 5121, 1},
        [of_weights] = {"VEC4", 5126, 1},   [of_deltas] = {"VEC3", 5126, 1},
        [of_matrices] = {"MAT4", 5126, 0},  [of_times] = {"SCALAR", 5126, 0},
        [of_breaths] = {"SCALAR", 5126, 0}, [of_turns] = {"VEC4", 5126, 0},
    };
    fputs("  \"accessors\": [\n", out);
    for (int a = 0; a < accessor_count; ++a) {
        const int kind = a < of_turns ? a : of_turns;
        const int count = kind == of_indices                ? 3 * c->m->face_count
                          : kinds[kind].vertex_elements > 0 ? c->vertex_count
                          : kind == of_matrices             ? bone_count
                                                            : key_count;
        fprintf(out,
                "    {\"bufferView\": %d, \"componentType\": %d, \"count\": %d, \"type\": \"%s\"",
                a, kinds[kind].component, count, kinds[kind].type);
        if (kind == of_positions || kind == of_deltas || kind == of_times)
            print_bounds(c, starts[a], starts[a + 1], kind == of_times ? 1 : 3, out);
        fprintf(out, "}%s\n", a + 1 < accessor_count ? "," : "");
    }
    fputs("  ],\n  \"bufferViews\": [\n", out);
    for (int a = 0; a < accessor_count; ++a)
        fprintf(out, "    {\"buffer\": 0, \"byteOffset\": %zu, \"byteLength\": %zu}%s\n", starts[a],
                starts[a + 1] - starts[a], a + 1 < accessor_count ? "," : "");
    fputs("  ],\n", out);
}

/* Joints are nodes 0 and on; behind them is the node of the mesh. */
static void print_nodes(FILE *out) {
    fputs("  \"nodes\": [\n", out);
    for (int b = 0; b < bone_count; ++b) {
        const point origin = {0, 0, 0};
        const point from = bones[b].parent < 0 ? origin : joint_place(bones[b].parent);
        const point place = subtract(joint_place(b), from);
        fprintf(out, "    {\"name\": \"%s\", \"translation\": [%.6f, %.6f, %.6f]", bones[b].name,
                place.x, place.y, place.z);
        bool any = false;
        for (int child = 0; child < bone_count; ++child) {
            if (bones[child].parent != b) continue;
            fprintf(out, "%s%d", any ? ", " : ", \"children\": [", child);
            any = true;
        }
        fputs(any ? "]},\n" : "},\n", out);
    }
    fputs("    {\"name\": \"imp\", \"mesh\": 0, \"skin\": 0}\n  ],\n", out);
}

static void print_clip(FILE *out) {
    fputs("  \"animations\": [{\"name\": \"wave\",\n    \"samplers\": [\n", out);
    for (int t = 0; t <= turn_count; ++t)
        fprintf(out, "      {\"input\": %d, \"output\": %d}%s\n", of_times,
                t < turn_count ? of_turns + t : of_breaths, t < turn_count ? "," : "");
    fputs("    ],\n    \"channels\": [\n", out);
    for (int t = 0; t < turn_count; ++t)
        fprintf(out,
                "      {\"sampler\": %d, \"target\": {\"node\": %d, \"path\": \"rotation\"}},\n", t,
                turns[t].joint);
    fprintf(out,
            "      {\"sampler\": %d, \"target\": {\"node\": %d, \"path\": \"weights\"}}\n    ]\n  "
            "}],\n",
            turn_count, bone_count);
}

static void print_mesh(FILE *out) {
    fprintf(
        out,
        "  \"meshes\": [{\"name\": \"imp\", \"weights\": [0], \"extras\": {\"targetNames\": "
        "[\"breath\"]},\n"
        "    \"primitives\": [{\"indices\": %d, \"material\": 0, \"attributes\": {\"POSITION\": "
        "%d, \"TEXCOORD_0\": %d,\n"
        "      \"JOINTS_0\": %d, \"WEIGHTS_0\": %d}, \"targets\": [{\"POSITION\": %d}]}]}],\n",
        of_indices, of_positions, of_uvs, of_joints, of_weights, of_deltas);
    fputs("  \"materials\": [{\"name\": \"skin\", \"pbrMetallicRoughness\": {\"baseColorFactor\": "
          "[0.36, 0.6, 0.3, 1]}}],\n",
          out);
    fprintf(out, "  \"skins\": [{\"inverseBindMatrices\": %d, \"joints\": [", of_matrices);
    for (int b = 0; b < bone_count; ++b)
        fprintf(out, "%s%d", b ? ", " : "", b);
    fputs("]}],\n", out);
}

void imp_print_gltf(const mesh *m, FILE *out) {
    static character c;
    size_t starts[accessor_count + 1] = {0};
    c.m = m;
    c.vertex_count = 0;
    c.byte_count = 0;
    memset(c.vertices, -1, sizeof c.vertices);
    for (int a = 0; a < accessor_count; ++a) {
        while (c.byte_count % 4 != 0) {
            put_bytes(&c, 0, 1);
        }
        starts[a] = c.byte_count;
        put_accessor(&c, a);
        starts[a + 1] = c.byte_count;
    }
    fputs("{\n  \"asset\": {\"version\": \"2.0\", \"generator\": \"assets/generate_meshes.c; "
          "MIT\"},\n",
          out);
    fprintf(out, "  \"scene\": 0, \"scenes\": [{\"nodes\": [%d, %d]}],\n", hips, bone_count);
    print_nodes(out);
    print_mesh(out);
    print_clip(out);
    print_accessors(&c, starts, out);
    print_bytes(&c, out);
    fputs("}\n", out);
}
