/* SPDX-License-Identifier: MIT */
/* The options that describe a frame, the same for every program that shows one. */
#ifndef LIMNI_FRAME_OPTIONS_H
#define LIMNI_FRAME_OPTIONS_H

#include "limn/limn.h"

#if defined(__GNUC__)
#define LIMNI_FRAME_PRINTF __attribute__((format(printf, 2, 3)))
#else
#define LIMNI_FRAME_PRINTF
#endif

/// X(key, name, argument as in `struct option`)
#define LIMNI_FRAME_OPTIONS(X)                                                                     \
    X(LEVEL, "level", required_argument)                                                           \
    X(EYE, "eye", required_argument)                                                               \
    X(TARGET, "target", required_argument)                                                         \
    X(UP, "up", required_argument)                                                                 \
    X(FOV, "fov", required_argument)                                                               \
    X(VIEWPORT, "viewport", required_argument)                                                     \
    X(NEAR, "near", required_argument)                                                             \
    X(FAR, "far", required_argument)                                                               \
    X(CULL, "cull", no_argument)                                                                   \
    X(LOD, "lod", required_argument)                                                               \
    X(TOLERANCE, "tolerance", required_argument)                                                   \
    X(BIAS, "bias", required_argument)                                                             \
    X(MIN_LEVEL, "min-level", required_argument)                                                   \
    X(MAX_LEVEL, "max-level", required_argument)                                                   \
    X(BUDGET, "budget", required_argument)                                                         \
    X(NO_MORPH, "no-morph", no_argument)                                                           \
    X(CLIP, "clip", required_argument)                                                             \
    X(TIME, "time", required_argument)

/// What getopt_long() returns for them: above all characters.
enum limni_frame_key {
    LIMNI_FRAME_BEFORE = 999,
#define LIMNI_FRAME_KEY(key, name, argument) LIMNI_FRAME_##key,
    LIMNI_FRAME_OPTIONS(LIMNI_FRAME_KEY)
#undef LIMNI_FRAME_KEY
        LIMNI_FRAME_END,
    LIMNI_FRAME_FIRST = LIMNI_FRAME_BEFORE + 1
};

/// Rows of a `struct option` array: LIMNI_FRAME_OPTIONS(LIMNI_FRAME_LONG_OPTION)
#define LIMNI_FRAME_LONG_OPTION(key, name, argument) {name, argument, NULL, LIMNI_FRAME_##key},

/// Their help, but for that of --level, which every program says itself.
#define LIMNI_FRAME_HELP                                                                           \
    "A frame, seen from an eye, has levels of detail:\n"                                           \
    "      --eye X,Y,Z         where the camera is, in model units\n"                              \
    "      --target X,Y,Z      what it looks at; default the middle of the bounds\n"               \
    "      --up X,Y,Z          default 0,1,0; 0,0,-1 where that is the line of sight\n"            \
    "      --fov DEG           vertical angle of view, 0.01 to 179 degrees; default 45\n"          \
    "      --viewport WxH      in pixels, up to 65535 each; default 1280x720\n"                    \
    "      --near D, --far D   planes that bound the view; by default far is behind all there\n"   \
    "                          is, and near a thousandth of far\n"                                 \
    "      --cull              leave out patches that are outside of the view\n"                   \
    "      --lod MODE          length: by the projected length of edges (default);\n"              \
    "                          error: by the projected distance from the surface;\n"               \
    "                          uniform: --level everywhere, which says the same alone\n"           \
    "      --tolerance PX      length: pixels of a step along an edge, default 8;\n"               \
    "                          error: pixels off the surface, default 1\n"                         \
    "With or without an eye:\n"                                                                    \
    "      --bias B            added to all levels, -16 to 16\n"                                   \
    "      --min-level L, --max-level L\n"                                                         \
    "                          limits of all levels, 0 to 4\n"                                     \
    "      --budget N          lower the levels of each mesh until it has at most N vertices,\n"   \
    "                          or all are at the lowest\n"                                         \
    "      --no-morph          round levels up instead of morphing\n"                              \
    "      --clip NAME         a moment of an animation clip; default: joints at rest\n"           \
    "      --time T            of the clip, in seconds; default 0\n"

typedef struct limni_frame_options {
    uint32_t given; ///< see limni_frame_given()
    bool live;      ///< what is shown moves: it has an eye without --eye, and without --clip the
                    ///< first clip of the file
    float eye[3], target[3], up[3];
    float fov;              ///< degrees
    uint32_t width, height; ///< of the viewport in pixels
    float near_plane, far_plane;
    float min_level, max_level;
    limn_lod_desc desc; ///< all but the limits
    const char *clip;
    float time;      ///< seconds
    char error[256]; ///< after a failure: what is wrong, with the option and its value
} limni_frame_options;

/// Reads the argument `text` of the option that getopt_long() returned as `key`, from
/// LIMNI_FRAME_FIRST to before LIMNI_FRAME_END.
bool limni_frame_option_parse(limni_frame_options *options, int key, const char *text);

/// To be called when all are read: sets defaults, and refuses options that contradict each other.
/// Without an eye the frame is uniform, at `desc.level` where no level was given.
bool limni_frame_options_check(limni_frame_options *options);

/// Records the error and returns false.
bool limni_frame_refuse(limni_frame_options *options, const char *format, ...) LIMNI_FRAME_PRINTF;

/// Whether the option LIMNI_FRAME_… was given.
bool limni_frame_given(const limni_frame_options *options, int key);

#endif
