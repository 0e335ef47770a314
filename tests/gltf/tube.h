/* SPDX-License-Identifier: MIT */
/*
 * A small scene with all that the importer reads: a tube with two joints, a seam in its texture
 * coordinates, a lid of another material and a morph target; the same tube bound otherwise; a
 * propeller that turns as a whole, below a node that mirrors; and a still base, mirrored, too.
 */
#ifndef TUBE_H
#define TUBE_H

#include "glb.h"

#include <math.h>

enum { TUBE_RINGS = 4, TUBE_SIDES = 6, TUBE_COLUMNS = TUBE_SIDES + 1 };
enum { TUBE_VERTICES = TUBE_RINGS * TUBE_COLUMNS, LID_VERTICES = TUBE_SIDES + 2 };
enum { TUBE_TRIANGLES = 2 * TUBE_SIDES * (TUBE_RINGS - 1), LID_TRIANGLES = TUBE_SIDES };

/// A point of a ring; the last column is the first.
static inline void tube_point(int ring, int column, float p[3]) {
    const double angle = 6.28318530717958647692 * (column % TUBE_SIDES) / TUBE_SIDES;
    p[0] = (float)cos(angle);
    p[1] = (float)ring;
    p[2] = (float)-sin(angle);
}

static inline void tube_add_wall(glb *file, char *primitive, size_t room) {
    float positions[TUBE_VERTICES][3], uv[TUBE_VERTICES][2];
    uint8_t joints[TUBE_VERTICES][4] = {{0}}, weights[TUBE_VERTICES][4] = {{0}};
    uint16_t indices[TUBE_TRIANGLES][3];
    static const uint8_t second[TUBE_RINGS] = {0, 51, 204, 255}; // of 255
    for (int v = 0; v < TUBE_VERTICES; v++) {
        const int ring = v / TUBE_COLUMNS, column = v % TUBE_COLUMNS;
        tube_point(ring, column, positions[v]);
        uv[v][0] = (float)column / TUBE_SIDES;
        uv[v][1] = (float)ring / (TUBE_RINGS - 1);
        joints[v][1] = 1;
        weights[v][0] = (uint8_t)(255 - second[ring]);
        weights[v][1] = second[ring];
    }
    for (int t = 0; t < TUBE_TRIANGLES; t++) {
        const int ring = t / (2 * TUBE_SIDES), column = t / 2 % TUBE_SIDES;
        const int a = ring * TUBE_COLUMNS + column, up = a + TUBE_COLUMNS;
        const int corners[2][3] = {{a, a + 1, up + 1}, {a, up + 1, up}};
        for (int c = 0; c < 3; c++)
            indices[t][c] = (uint16_t)corners[t % 2][c];
    }
    // The third ring moves outwards, as a sparse accessor.
    uint16_t moved[TUBE_COLUMNS];
    float deltas[TUBE_COLUMNS][3];
    for (int c = 0; c < TUBE_COLUMNS; c++) {
        moved[c] = (uint16_t)(2 * TUBE_COLUMNS + c);
        tube_point(0, c, deltas[c]);
    }
    char sparse[256];
    const int points = glb_view(file, moved, sizeof moved);
    const int movements = glb_view(file, deltas, sizeof deltas);
    snprintf(sparse, sizeof sparse,
             ",\"sparse\":{\"count\":%d,\"indices\":{\"bufferView\":%d,\"componentType\":5123},"
             "\"values\":{\"bufferView\":%d}}",
             TUBE_COLUMNS, points, movements);
    const int target =
        glb_accessor(file, "wall target", NULL, 0, 5126, "VEC3", TUBE_VERTICES, sparse);
    const int position = glb_floats(file, "wall positions", positions[0], "VEC3", 3, TUBE_VERTICES);
    const int texture = glb_floats(file, "wall uv", uv[0], "VEC2", 2, TUBE_VERTICES);
    const int joint =
        glb_accessor(file, "wall joints", joints, sizeof joints, 5121, "VEC4", TUBE_VERTICES, "");
    const int weight = glb_accessor(file, "wall weights", weights, sizeof weights, 5121, "VEC4",
                                    TUBE_VERTICES, ",\"normalized\":true");
    const int index = glb_accessor(file, "wall indices", indices, sizeof indices, 5123, "SCALAR",
                                   3 * TUBE_TRIANGLES, "");
    glb_append(primitive, room,
               "{\"attributes\":{\"POSITION\":%d,\"TEXCOORD_0\":%d,\"JOINTS_0\":%d,"
               "\"WEIGHTS_0\":%d},\"indices\":%d,\"material\":0,\"targets\":[{\"POSITION\":%d}]}",
               position, texture, joint, weight, index, target);
}

/// A fan around the middle, on the last ring of the wall.
static inline void tube_add_lid(glb *file, char *primitive, size_t room) {
    float positions[LID_VERTICES][3] = {{0, TUBE_RINGS - 1, 0}};
    float weights[LID_VERTICES][4] = {{0}}, colours[LID_VERTICES][4];
    uint16_t joints[LID_VERTICES][4] = {{0}};
    for (int v = 0; v < LID_VERTICES; v++) {
        if (v > 0) tube_point(TUBE_RINGS - 1, v - 1, positions[v]);
        joints[v][0] = 1;
        weights[v][0] = 1;
        for (int c = 0; c < 4; c++)
            colours[v][c] = c == 3 ? 1 : (float)v / LID_VERTICES;
    }
    const int position = glb_floats(file, "lid positions", positions[0], "VEC3", 3, LID_VERTICES);
    const int joint =
        glb_accessor(file, "lid joints", joints, sizeof joints, 5123, "VEC4", LID_VERTICES, "");
    const int weight = glb_floats(file, "lid weights", weights[0], "VEC4", 4, LID_VERTICES);
    const int colour = glb_floats(file, "lid colours", colours[0], "VEC4", 4, LID_VERTICES);
    const int target = glb_accessor(file, "lid target", NULL, 0, 5126, "VEC3", LID_VERTICES, "");
    glb_append(primitive, room,
               "{\"mode\":6,\"attributes\":{\"POSITION\":%d,\"JOINTS_0\":%d,\"WEIGHTS_0\":%d,"
               "\"COLOR_0\":%d},\"material\":1,\"targets\":[{\"POSITION\":%d}]}",
               position, joint, weight, colour, target);
}

static inline int tube_add_binds(glb *file, const char *name, float lower, float upper) {
    float matrices[2][16] = {{0}};
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 4; i++)
            matrices[j][5 * i] = 1;
        matrices[j][13] = j ? -upper : -lower;
    }
    return glb_floats(file, name, matrices[0], "MAT4", 16, 2);
}

/// Channels of an animation come with a sampler each.
static inline void tube_add_channel(char *channels, char *samplers, size_t room, int node,
                                    const char *path, const char *interpolation, int input,
                                    int output) {
    int count = 0;
    for (const char *c = samplers; (c = strstr(c, "input")); c++)
        count++;
    glb_append(channels, room, "%s{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"%s\"}}",
               count ? "," : "", count, node, path);
    glb_append(samplers, room, "%s{\"input\":%d,\"interpolation\":\"%s\",\"output\":%d}",
               count ? "," : "", input, interpolation, output);
}

enum { NODE_ARMATURE, NODE_LOWER, NODE_UPPER, NODE_TUBE, NODE_TWIN, NODE_MIRROR, NODE_PROPELLER };

static inline void tube_add_clips(glb *file) {
    static const float times[] = {0.25f, 0.5f, 2}, late[] = {0, 1};
    static const float turns[3][4] = {
        {0, 0, 0, 1}, {0.6f, 0, 0, 0.8f}, {-0.28f, 0, 0.f, -0.96f}}; // the last the long way
    static const float moves[2][3][3] = {{{0, 0, 0}, {0, 0.5f, 0}, {1, 0, 0.5f}},
                                         {{-1, 0, 1}, {0.5f, 1, 0}, {0, 0, 0}}};
    static const float scales[3][3] = {{1, 1, 1}, {1, 2, 1}, {0.5f, 1, 1.5f}};
    static const float weights[3] = {0, 1, -0.25f};
    static const float spin[2][4] = {{0, 0, 0, 1}, {0, 1, 0, 0}};
    const int time = glb_floats(file, "times", times, "SCALAR", 1, 3);
    const int two = glb_floats(file, "two times", late, "SCALAR", 1, 2);
    const int turn = glb_floats(file, "turns", turns[0], "VEC4", 4, 3);
    const int move = glb_floats(file, "moves", moves[0][0], "VEC3", 3, 6);
    const int scale = glb_floats(file, "scales", scales[0], "VEC3", 3, 3);
    const int weight = glb_floats(file, "weights", weights, "SCALAR", 1, 3);
    const int spins = glb_floats(file, "spins", spin[0], "VEC4", 4, 2);
    char channels[2048] = "", samplers[2048] = "", others[512] = "", other_samplers[512] = "";
    tube_add_channel(channels, samplers, sizeof channels, NODE_TUBE, "weights", "LINEAR", time,
                     weight);
    tube_add_channel(channels, samplers, sizeof channels, NODE_UPPER, "rotation", "LINEAR", time,
                     turn);
    tube_add_channel(channels, samplers, sizeof channels, NODE_LOWER, "translation", "CUBICSPLINE",
                     two, move);
    tube_add_channel(channels, samplers, sizeof channels, NODE_LOWER, "scale", "STEP", time, scale);
    tube_add_channel(others, other_samplers, sizeof others, NODE_PROPELLER, "rotation", "LINEAR",
                     two, spins);
    glb_append(file->rest, sizeof file->rest,
               "\"animations\":[{\"name\":\"bend\",\"channels\":[%s],\"samplers\":[%s]},"
               "{\"name\":\"spin\",\"channels\":[%s],\"samplers\":[%s]}]",
               channels, samplers, others, other_samplers);
}

static inline void tube_make(glb *file) {
    static const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const uint8_t turns[6] = {0, 2, 1, 3, 0, 2}; // a strip
    char primitives[2048] = "";
    memset(file, 0, sizeof *file);
    tube_add_wall(file, primitives, sizeof primitives);
    glb_append(primitives, sizeof primitives, ",");
    tube_add_lid(file, primitives, sizeof primitives);
    const int binds = tube_add_binds(file, "binds", 0, 1.5f);
    const int others = tube_add_binds(file, "other binds", 0.5f, 1.25f);
    const int solid = glb_floats(file, "solid positions", corners[0], "VEC3", 3, 4);
    const int index =
        glb_accessor(file, "solid indices", turns, sizeof turns, 5121, "SCALAR", 6, "");
    glb_append(
        file->rest, sizeof file->rest,
        "\"scene\":0,\"scenes\":[{\"nodes\":[0,3,4,5,7]}],\"nodes\":["
        "{\"name\":\"armature\",\"children\":[1],\"matrix\":[0,0,-2,0,0,2,0,0,2,0,0,0,5,6,7,1]},"
        "{\"name\":\"lower\",\"children\":[2],\"rotation\":[0,0.6,0,0.8]},"
        "{\"name\":\"upper\",\"translation\":[0,1.5,0]},"
        "{\"name\":\"tube\",\"mesh\":0,\"skin\":0,\"translation\":[100,0,0]},"
        "{\"name\":\"twin\",\"mesh\":0,\"skin\":1,\"weights\":[0.5]},"
        "{\"name\":\"mirror\",\"children\":[6],\"scale\":[-1,2,1],\"translation\":[3,0,0]},"
        "{\"name\":\"propeller\",\"mesh\":1,\"translation\":[0,1,0]},"
        "{\"name\":\"base\",\"mesh\":1,\"scale\":[2,-2,2],\"translation\":[0,-3,0]}],"
        "\"meshes\":[{\"name\":\"tube\",\"primitives\":[%s],\"weights\":[0.25],"
        "\"extras\":{\"targetNames\":[\"swell\"],\"limn\":{\"creases\":[[0,1,2.5],[1,2,1e3]],"
        "\"corners\":[[3,4]],\"boundary\":\"edge-and-corner\"}}},"
        "{\"name\":\"solid\",\"primitives\":[{\"mode\":5,\"attributes\":{\"POSITION\":%d},"
        "\"indices\":%d}]}],"
        "\"skins\":[{\"name\":\"body\",\"joints\":[1,2],\"inverseBindMatrices\":%d},"
        "{\"name\":\"other\",\"joints\":[1,2],\"inverseBindMatrices\":%d}],"
        "\"materials\":[{\"name\":\"wall\",\"pbrMetallicRoughness\":{\"baseColorFactor\":"
        "[1,0.5,0.25,1],\"baseColorTexture\":{\"index\":0}}},{\"name\":\"lid\","
        "\"normalTexture\":{\"index\":0}}],"
        "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"not_there.png\"}],",
        primitives, solid, index, binds, others);
    tube_add_clips(file);
}

#endif
