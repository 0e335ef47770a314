/* SPDX-License-Identifier: MIT */
/* A scene of `limn-bench frame`, as a text file describes it. Lengths are in diagonals of the mesh,
 * around the middle of its bounds in the bind pose. */
#ifndef FRAME_SCRIPT_H
#define FRAME_SCRIPT_H

#include "limn/bake.h"
#include "limn/limn.h"

enum { FRAME_KEY_MAX = 64, FRAME_LIGHT_MAX = 8, FRAME_COUNT_MAX = 65536 };

/// What lines of a scene may say: key, the fewest and the most words after it, what they are
/// (with a space before), and what it means.
#define FRAME_SCRIPT_LINES(X)                                                                      \
    X(mesh, 1, 2, " FILE | terrain SIDE", "beside the scene; or made-up hills")                    \
    X(scheme, 1, 1, " loop | catmark", "to bake with (default loop)")                              \
    X(isolate, 1, 1, " 0 | 1", "1: with small tables")                                             \
    X(clip, 1, 1, " NAME", "of the mesh's file; default the first, or a made-up wobble")           \
    X(still, 0, 0, "", "nothing moves but the camera")                                             \
    X(count, 1, 1, " N", "characters (default 1, at the origin)")                                  \
    X(area, 2, 2, " WIDTH DEPTH", "where they stand: along x, and from 0 along -z")                \
    X(lod, 2, 2, " error PX | length PX | uniform LEVEL", "how levels are chosen")                 \
    X(viewport, 2, 2, " WIDTH HEIGHT", "pixels (default 1280 720)")                                \
    X(fov, 1, 1, " DEGREES", "vertical angle of view (default 40)")                                \
    X(camera, 7, 7, " T EX EY EZ TX TY TZ",                                                        \
      "eye and target at T, 0 to 1: the first and the last frame")                                 \
    X(output, 1, 1, " packed | float", "positions of 8 bytes and normals of 4, or both of 12")     \
    X(normals, 1, 1, " all | none", "none: where light is all that they are for")                  \
    X(light, 1, 1, " none | interpolated | exact", "4 bytes of colour more, but for none")         \
    X(ambient, 3, 3, " R G B", "light from everywhere")                                            \
    X(sun, 6, 6, " DX DY DZ R G B", "a directional light: the way that it goes, and its colour")   \
    X(lamp, 7, 7, " X Y Z RANGE R G B", "a point light, relative to each character")

#define FRAME_SCRIPT_HELP_LINE(key, least, most, form, meaning)                                    \
    "  " #key form "\n                      " meaning "\n"

/// The same as text.
#define FRAME_SCRIPT_HELP FRAME_SCRIPT_LINES(FRAME_SCRIPT_HELP_LINE)

typedef enum frame_light {
    FRAME_LIGHT_NONE,
    FRAME_LIGHT_INTERPOLATED,
    FRAME_LIGHT_EXACT
} frame_light;

/// Where the camera is at one time.
typedef struct frame_key {
    float time;
    float eye[3], target[3];
} frame_key;

typedef struct frame_script {
    char name[64];
    char mesh[1024];       ///< a path; "": terrain
    uint32_t terrain_side; ///< squares
    limn_scheme scheme;
    limn_isolate isolate;
    char clip[64]; ///< "": the first
    bool still;
    uint32_t count;
    float area[2];
    limn_lod_desc lod;
    float viewport[2];
    float fov; ///< radians
    frame_key keys[FRAME_KEY_MAX];
    uint32_t key_count;
    bool packed, normals;
    frame_light light;
    float ambient[3];
    limn_light lights[FRAME_LIGHT_MAX];
    uint32_t light_count;
} frame_script;

/// Reads a scene: a path, or the name of one in bench/scenes. False after a message with file and
/// line.
bool frame_script_read(frame_script *script, const char *name);

/// Chooses levels in another way: "error", "length" or "uniform" and a number. False: neither.
bool frame_script_set_lod(frame_script *script, const char *kind, const char *number);

/// "0" or "1". False: neither.
bool frame_script_set_isolate(frame_script *script, const char *number);

#endif
