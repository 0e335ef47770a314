/* SPDX-License-Identifier: MIT */
#include "script.h"

#include "../arguments.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WORD_MAX = 12, LINE_MAX_BYTES = 1024 };

/// A line of a scene, cut into words.
typedef struct line {
    const char *path;
    unsigned number;
    char *words[WORD_MAX];
    uint32_t count;
} line;

typedef bool read_fn(frame_script *script, const line *at);

// -------------------------------------------------------------------------------------------------
// Values

/// Numbers from word `first` on.
static bool read_numbers(const line *at, uint32_t first, uint32_t count, float low, float high,
                         float *out) {
    for (uint32_t i = 0; i < count; i++) {
        if (!limni_parse_real(at->words[first + i], low, high, &out[i])) return false;
    }
    return true;
}

/// The index of a word among others, which end with NULL.
static bool read_choice(const char *word, const char *const *names, int *index) {
    for (int i = 0; names[i]; i++) {
        if (strcmp(word, names[i]) != 0) continue;
        *index = i;
        return true;
    }
    return false;
}

static bool copy_word(char *to, size_t size, const char *word) {
    return (size_t)snprintf(to, size, "%s", word) < size;
}

// -------------------------------------------------------------------------------------------------
// Lines, in the order of FRAME_SCRIPT_LINES

static bool read_mesh(frame_script *script, const line *at) {
    script->mesh[0] = '\0';
    if (at->count == 3)
        return strcmp(at->words[1], "terrain") == 0 &&
               bench_parse_range(at->words[2], 1, 1024, &script->terrain_side);
    const char *const slash = at->words[1][0] == '/' ? NULL : strrchr(at->path, '/');
    const int folder = slash ? (int)(slash + 1 - at->path) : 0;
    return (size_t)snprintf(script->mesh, sizeof script->mesh, "%.*s%s", folder, at->path,
                            at->words[1]) < sizeof script->mesh;
}

static bool read_scheme(frame_script *script, const line *at) {
    return bench_parse_scheme(at->words[1], &script->scheme);
}

bool frame_script_set_isolate(frame_script *script, const char *number) {
    uint32_t on;
    if (!bench_parse_range(number, 0, 1, &on)) return false;
    script->isolate = on ? LIMN_ISOLATE_ALWAYS : LIMN_ISOLATE_NEVER;
    return true;
}

static bool read_isolate(frame_script *script, const line *at) {
    return frame_script_set_isolate(script, at->words[1]);
}

static bool read_clip(frame_script *script, const line *at) {
    return copy_word(script->clip, sizeof script->clip, at->words[1]);
}

static bool read_still(frame_script *script, const line *at) {
    (void)at;
    script->still = true;
    return true;
}

static bool read_count(frame_script *script, const line *at) {
    return bench_parse_range(at->words[1], 1, FRAME_COUNT_MAX, &script->count);
}

static bool read_area(frame_script *script, const line *at) {
    return read_numbers(at, 1, 2, 0, 1e4f, script->area);
}

bool frame_script_set_lod(frame_script *script, const char *kind, const char *number) {
    static const char *const names[] = {[LIMN_LOD_LENGTH] = "length",
                                        [LIMN_LOD_UNIFORM] = "uniform",
                                        [LIMN_LOD_ERROR] = "error",
                                        NULL};
    int lod;
    float value;
    if (!read_choice(kind, names, &lod)) return false;
    const bool uniform = lod == LIMN_LOD_UNIFORM;
    if (!limni_parse_real(number, uniform ? 0 : 1e-3f, uniform ? LIMN_LEVEL_MAX : 1e3f, &value))
        return false;
    script->lod = (limn_lod_desc){.lod = (limn_lod)lod};
    *(uniform ? &script->lod.level : &script->lod.pixels) = value;
    return true;
}

static bool read_lod(frame_script *script, const line *at) {
    return frame_script_set_lod(script, at->words[1], at->words[2]);
}

static bool read_viewport(frame_script *script, const line *at) {
    return read_numbers(at, 1, 2, 1, 65535, script->viewport);
}

static bool read_fov(frame_script *script, const line *at) {
    if (!read_numbers(at, 1, 1, 1, 170, &script->fov)) return false;
    script->fov *= 3.14159265f / 180;
    return true;
}

/// Times ascend, and the eye is not at the target.
static bool read_camera(frame_script *script, const line *at) {
    if (script->key_count == FRAME_KEY_MAX) return false;
    frame_key *const key = &script->keys[script->key_count++];
    return read_numbers(at, 1, 1, 0, 1, &key->time) &&
           read_numbers(at, 2, 3, -1e4f, 1e4f, key->eye) &&
           read_numbers(at, 5, 3, -1e4f, 1e4f, key->target) &&
           (script->key_count == 1 || key->time > key[-1].time) &&
           memcmp(key->eye, key->target, sizeof key->eye) != 0;
}

static bool read_output(frame_script *script, const line *at) {
    static const char *const names[] = {"float", "packed", NULL};
    int packed;
    if (!read_choice(at->words[1], names, &packed)) return false;
    script->packed = packed == 1;
    return true;
}

static bool read_normals(frame_script *script, const line *at) {
    static const char *const names[] = {"none", "all", NULL};
    int normals;
    if (!read_choice(at->words[1], names, &normals)) return false;
    script->normals = normals == 1;
    return true;
}

static bool read_light(frame_script *script, const line *at) {
    static const char *const names[] = {"none", "interpolated", "exact", NULL};
    int light;
    if (!read_choice(at->words[1], names, &light)) return false;
    script->light = (frame_light)light;
    return true;
}

static bool read_ambient(frame_script *script, const line *at) {
    return read_numbers(at, 1, 3, 0, 100, script->ambient);
}

static bool add_light(frame_script *script, const limn_light *light) {
    if (script->light_count == FRAME_LIGHT_MAX) return false;
    script->lights[script->light_count++] = *light;
    return true;
}

static bool read_sun(frame_script *script, const line *at) {
    limn_light sun = {.kind = LIMN_LIGHT_DIRECTIONAL};
    float *const way = sun.direction;
    if (!read_numbers(at, 1, 3, -1, 1, way) || !read_numbers(at, 4, 3, 0, 100, sun.colour))
        return false;
    const float length = sqrtf(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    for (int axis = 0; axis < 3; axis++)
        way[axis] /= length;
    return length > 0 && add_light(script, &sun);
}

static bool read_lamp(frame_script *script, const line *at) {
    limn_light lamp = {.kind = LIMN_LIGHT_POINT, .attenuation = {1, 0, 0}};
    return read_numbers(at, 1, 3, -1e4f, 1e4f, lamp.position) &&
           read_numbers(at, 4, 1, 0, 1e4f, &lamp.range) &&
           read_numbers(at, 5, 3, 0, 100, lamp.colour) && add_light(script, &lamp);
}

#define FRAME_SCRIPT_LINE(key, least, most, form, meaning) {#key, least, most, form, read_##key},

static const struct {
    const char *key;
    uint32_t least, most;
    const char *form;
    read_fn *read;
} kinds[] = {FRAME_SCRIPT_LINES(FRAME_SCRIPT_LINE)};

enum { KIND_COUNT = sizeof kinds / sizeof *kinds };

// -------------------------------------------------------------------------------------------------
// Files

/// Words up to a '#'; one more than fits is not looked at.
static void cut(char *text, line *at) {
    text[strcspn(text, "#\r\n")] = '\0';
    at->count = 0;
    while (at->count < WORD_MAX) {
        while (isspace((unsigned char)*text))
            *text++ = '\0';
        if (!*text) return;
        at->words[at->count++] = text;
        while (*text && !isspace((unsigned char)*text))
            text++;
    }
}

static bool read_line(frame_script *script, const line *at) {
    for (int k = 0; k < KIND_COUNT; k++) {
        if (strcmp(at->words[0], kinds[k].key) != 0) continue;
        const uint32_t given = at->count - 1;
        if (given >= kinds[k].least && given <= kinds[k].most && kinds[k].read(script, at))
            return true;
        fprintf(stderr, "limn-bench: %s:%u: not of the form '%s%s', or out of range\n", at->path,
                at->number, kinds[k].key, kinds[k].form);
        return false;
    }
    fprintf(stderr, "limn-bench: %s:%u: unknown key '%s'; see limn-bench frame --help\n", at->path,
            at->number, at->words[0]);
    return false;
}

static bool read_lines(frame_script *script, FILE *file, const char *path) {
    char text[LINE_MAX_BYTES];
    line at = {.path = path};
    while (fgets(text, sizeof text, file)) {
        at.number++;
        if (!strchr(text, '\n') && !feof(file)) {
            fprintf(stderr, "limn-bench: %s:%u: the line is too long\n", path, at.number);
            return false;
        }
        cut(text, &at);
        if (at.count > 0 && !read_line(script, &at)) return false;
    }
    if (ferror(file)) {
        fprintf(stderr, "limn-bench: %s: %s\n", path, strerror(errno));
        return false;
    }
    if ((script->mesh[0] || script->terrain_side) && script->key_count > 0) return true;
    fprintf(stderr, "limn-bench: %s: a scene needs a mesh and a camera\n", path);
    return false;
}

/// The file's name without its ending, as much as there is room for.
static void set_name(frame_script *script, const char *path) {
    const char *const slash = strrchr(path, '/');
    const char *const name = slash ? slash + 1 : path;
    snprintf(script->name, sizeof script->name, "%.*s", (int)strcspn(name, "."), name);
}

bool frame_script_read(frame_script *script, const char *name) {
    char path[1024];
    *script = (frame_script){.count = 1,
                             .viewport = {1280, 720},
                             .fov = 0.698f,
                             .lod = {.lod = LIMN_LOD_ERROR, .pixels = 1},
                             .packed = true,
                             .normals = true};
    const bool is_name = !strchr(name, '/') && !strchr(name, '.');
    snprintf(path, sizeof path, is_name ? BENCH_SCENES "/%s.scene" : "%s", name);
    FILE *const file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "limn-bench: %s: %s\n", path, strerror(errno));
        return false;
    }
    set_name(script, path);
    const bool good = read_lines(script, file, path);
    fclose(file);
    return good;
}
