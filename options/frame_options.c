/* SPDX-License-Identifier: MIT */
#include "frame_options.h"

#include "numbers.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

static const char *const names[] = {
#define NAME(key, name, argument) name,
    LIMNI_FRAME_OPTIONS(NAME)
#undef NAME
};

static const struct {
    const char *name;
    limn_lod lod;
} modes[] = {{"length", LIMN_LOD_LENGTH}, {"error", LIMN_LOD_ERROR}, {"uniform", LIMN_LOD_UNIFORM}};

static const char mode_names[] = "length, error or uniform";

/// The options that are numbers: where they go and what is allowed.
static const struct {
    int key;
    size_t offset;
    float low, high;
    const char *expected;
} reals[] = {
#define MEMBER(name) offsetof(limni_frame_options, name)
    {LIMNI_FRAME_LEVEL, MEMBER(desc.level), 0, LIMN_LEVEL_MAX, "a level from 0 to 4"},
    {LIMNI_FRAME_MIN_LEVEL, MEMBER(min_level), 0, LIMN_LEVEL_MAX, "a level from 0 to 4"},
    {LIMNI_FRAME_MAX_LEVEL, MEMBER(max_level), 0, LIMN_LEVEL_MAX, "a level from 0 to 4"},
    {LIMNI_FRAME_FOV, MEMBER(fov), 0.01f, 179, "an angle from 0.01 to 179 degrees"},
    {LIMNI_FRAME_NEAR, MEMBER(near_plane), 1e-15f, 1e15f, "a distance above 0"},
    {LIMNI_FRAME_FAR, MEMBER(far_plane), 1e-15f, 1e15f, "a distance above 0"},
    {LIMNI_FRAME_TOLERANCE, MEMBER(desc.pixels), 1e-3f, 1e6f, "0.001 to 1000000 pixels"},
    {LIMNI_FRAME_BIAS, MEMBER(desc.bias), -16, 16, "a number from -16 to 16"},
    {LIMNI_FRAME_TIME, MEMBER(time), 0, 1e6f, "a time from 0 to 1000000 seconds"},
#undef MEMBER
};

static bool parse_mode(const char *text, limn_lod *lod) {
    for (size_t m = 0; m < sizeof modes / sizeof *modes; m++) {
        if (strcmp(text, modes[m].name) != 0) continue;
        *lod = modes[m].lod;
        return true;
    }
    return false;
}

static const char *mode_name(limn_lod lod) {
    size_t m = 0;
    while (modes[m].lod != lod)
        m++;
    return modes[m].name;
}

static bool parse_budget(const char *text, uint64_t *budget) {
    uint32_t number;
    if (!limni_parse_number(text, INT32_MAX, &number) || number == 0) return false;
    *budget = number;
    return true;
}

static bool parse_real(limni_frame_options *options, int key, const char *text,
                       const char **expected) {
    size_t r = 0;
    while (reals[r].key != key)
        r++;
    *expected = reals[r].expected;
    float *const value = (float *)(void *)((char *)options + reals[r].offset);
    return limni_parse_real(text, reals[r].low, reals[r].high, value);
}

static bool parse(limni_frame_options *options, int key, const char *text, const char **expected) {
    *expected = "a point X,Y,Z";
    switch (key) {
    case LIMNI_FRAME_EYE:
        return limni_parse_point(text, options->eye);
    case LIMNI_FRAME_TARGET:
        return limni_parse_point(text, options->target);
    case LIMNI_FRAME_UP:
        *expected = "a direction X,Y,Z";
        return limni_parse_point(text, options->up);
    case LIMNI_FRAME_VIEWPORT:
        *expected = "WIDTHxHEIGHT with 1 to 65535 pixels each";
        return limni_parse_size(text, UINT16_MAX, &options->width, &options->height);
    case LIMNI_FRAME_LOD:
        *expected = mode_names;
        return parse_mode(text, &options->desc.lod);
    case LIMNI_FRAME_BUDGET:
        *expected = "a number of vertices from 1 to 2147483647";
        return parse_budget(text, &options->desc.vertex_budget);
    case LIMNI_FRAME_NO_MORPH:
        return options->desc.no_morph = true;
    case LIMNI_FRAME_CLIP:
        options->clip = text;
        return true;
    case LIMNI_FRAME_CULL:
        return true;
    default:
        return parse_real(options, key, text, expected);
    }
}

bool limni_frame_option_parse(limni_frame_options *options, int key, const char *text) {
    const char *expected;
    options->given |= 1u << (key - LIMNI_FRAME_FIRST);
    return parse(options, key, text, &expected) ||
           limni_frame_refuse(options, "--%s '%s': not %s", names[key - LIMNI_FRAME_FIRST], text,
                              expected);
}

bool limni_frame_given(const limni_frame_options *options, int key) {
    return options->given >> (key - LIMNI_FRAME_FIRST) & 1;
}

bool limni_frame_refuse(limni_frame_options *options, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(options->error, sizeof options->error, format, arguments);
    va_end(arguments);
    return false;
}

/// --level is a mode of its own; --lod may repeat it.
static bool check_level(limni_frame_options *options) {
    const bool has_lod = limni_frame_given(options, LIMNI_FRAME_LOD);
    const bool is_uniform = has_lod && options->desc.lod == LIMN_LOD_UNIFORM;
    if (!limni_frame_given(options, LIMNI_FRAME_LEVEL))
        return !is_uniform || limni_frame_refuse(options, "--lod uniform: there is no --level");
    if (has_lod && !is_uniform)
        return limni_frame_refuse(options, "--lod %s: contradicts --level, which is uniform",
                                  mode_name(options->desc.lod));
    if (limni_frame_given(options, LIMNI_FRAME_TOLERANCE))
        return limni_frame_refuse(options, "--tolerance: contradicts --level, which is uniform");
    options->desc.lod = LIMN_LOD_UNIFORM;
    return true;
}

static bool check_eye(limni_frame_options *options) {
    static const int dependent[] = {LIMNI_FRAME_TARGET,   LIMNI_FRAME_UP,   LIMNI_FRAME_FOV,
                                    LIMNI_FRAME_VIEWPORT, LIMNI_FRAME_NEAR, LIMNI_FRAME_FAR,
                                    LIMNI_FRAME_CULL,     LIMNI_FRAME_LOD,  LIMNI_FRAME_TOLERANCE};
    if (limni_frame_given(options, LIMNI_FRAME_EYE) || options->live) return true;
    for (size_t d = 0; d < sizeof dependent / sizeof *dependent; d++) {
        if (!limni_frame_given(options, dependent[d])) continue;
        if (dependent[d] == LIMNI_FRAME_LOD && options->desc.lod == LIMN_LOD_UNIFORM) continue;
        return limni_frame_refuse(options, "--%s: there is no --eye",
                                  names[dependent[d] - LIMNI_FRAME_FIRST]);
    }
    options->desc.lod = LIMN_LOD_UNIFORM;
    return true;
}

static bool check_time(limni_frame_options *options) {
    return !limni_frame_given(options, LIMNI_FRAME_TIME) ||
           limni_frame_given(options, LIMNI_FRAME_CLIP) ||
           limni_frame_refuse(options, "--time: there is no --clip");
}

static bool check_limits(limni_frame_options *options) {
    return options->min_level <= options->max_level ||
           limni_frame_refuse(options, "--min-level %g: is above --max-level %g",
                              (double)options->min_level, (double)options->max_level);
}

/// Those that do not depend on what is seen.
static void set_defaults(limni_frame_options *options) {
    if (!limni_frame_given(options, LIMNI_FRAME_FOV)) options->fov = 45;
    if (!limni_frame_given(options, LIMNI_FRAME_MAX_LEVEL)) options->max_level = LIMN_LEVEL_MAX;
    if (limni_frame_given(options, LIMNI_FRAME_VIEWPORT)) return;
    options->width = 1280;
    options->height = 720;
}

bool limni_frame_options_check(limni_frame_options *options) {
    set_defaults(options);
    return check_level(options) && check_eye(options) && check_time(options) &&
           check_limits(options);
}
