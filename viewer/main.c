/* SPDX-License-Identifier: MIT */
/* limn-view: arguments and exit statuses. */
#include "limn/limn.h"
#include "picture.h"
#include "report.h"
#include "scene.h"
#include "target.h"
#include <ctype.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STATUS_OK = 0, STATUS_FAILED = 1, STATUS_USAGE = 2 };

static const char help_text[] =
    "Usage: limn-view FILE.limn --png OUT.png [OPTION]...\n"
    "Draws the meshes of a baked .limn file as a PNG picture. Needs no window system.\n"
    "\n"
    "  --png OUT.png   the picture to write; replaced only by a complete one\n"
    "  --level N       subdivision level, 0 (one triangle per patch) to 4 (256); default 4\n"
    "  --size WxH      width and height in pixels, up to 8192 each; default 1280x960\n"
    "  --wireframe     draw the level's triangles, and the borders of patches stronger\n"
    "  --control-mesh  draw the edges and points of the base mesh, faintly where hidden\n"
    "  --mesh N        draw mesh N of the file only, counted from 0; default all meshes\n"
    "  --help          print this and exit\n"
    "  --version       print the version and exit\n"
    "\n"
    "The camera looks at the surface from the front (+Z), the right and above (+Y), and frames it\n"
    "the same way at every level. The inside of an open surface is darker than its outside.\n"
    "The same command writes the same bytes on one machine.\n"
    "\n"
    "Exit status: 0 the picture was written; 1 the file or the machine does not allow it;\n"
    "2 the command line is wrong. In the last two cases nothing is written.\n"
    "\n"
    "Example: limn-view spot.limn --png spot.png --level 2 --wireframe --size 640x480\n";

static const char version_format[] = "limn-view %u.%u.%u\n";

/// A decimal number at the start of `text`, without sign or space; `end` is behind it.
static bool parse_number(const char *text, unsigned long maximum, unsigned long *number,
                         const char **end) {
    unsigned long value = 0;
    if (!isdigit((unsigned char)*text)) return false;
    for (; isdigit((unsigned char)*text); text++) {
        const unsigned long digit = (unsigned long)(*text - '0');
        if (digit > maximum || value > (maximum - digit) / 10) return false;
        value = value * 10 + digit;
    }
    *number = value;
    *end = text;
    return true;
}

static bool parse_level(view_picture *picture, const char *text) {
    unsigned long level;
    const char *end;
    if (!parse_number(text, LIMN_LEVEL_MAX, &level, &end) || *end)
        return view_fail("--level '%s': not a number from 0 to %d", text, LIMN_LEVEL_MAX);
    picture->level = (uint32_t)level;
    return true;
}

static bool parse_size(view_picture *picture, const char *text) {
    unsigned long width, height;
    const char *end;
    if (!parse_number(text, VIEW_TARGET_SIZE_MAX, &width, &end) || *end != 'x' ||
        !parse_number(end + 1, VIEW_TARGET_SIZE_MAX, &height, &end) || *end || width == 0 ||
        height == 0) {
        return view_fail("--size '%s': not WIDTHxHEIGHT with 1 to %d pixels each", text,
                         VIEW_TARGET_SIZE_MAX);
    }
    picture->width = (uint32_t)width;
    picture->height = (uint32_t)height;
    return true;
}

static bool parse_mesh(view_picture *picture, const char *text) {
    unsigned long mesh_index;
    const char *end;
    if (!parse_number(text, INT32_MAX, &mesh_index, &end) || *end)
        return view_fail("--mesh '%s': not a mesh number, counted from 0", text);
    picture->mesh_index = (long)mesh_index;
    return true;
}

enum option_key {
    KEY_PNG = 1,
    KEY_LEVEL,
    KEY_SIZE,
    KEY_WIREFRAME,
    KEY_CONTROL,
    KEY_MESH,
    KEY_HELP,
    KEY_VERSION
};

static const struct option long_options[] = {
    {"png", required_argument, NULL, KEY_PNG},
    {"level", required_argument, NULL, KEY_LEVEL},
    {"size", required_argument, NULL, KEY_SIZE},
    {"wireframe", no_argument, NULL, KEY_WIREFRAME},
    {"control-mesh", no_argument, NULL, KEY_CONTROL},
    {"mesh", required_argument, NULL, KEY_MESH},
    {"help", no_argument, NULL, KEY_HELP},
    {"version", no_argument, NULL, KEY_VERSION},
    {0},
};

static bool apply_option(view_picture *picture, int key) {
    switch (key) {
    case KEY_PNG:
        picture->png_path = optarg;
        return true;
    case KEY_LEVEL:
        return parse_level(picture, optarg);
    case KEY_SIZE:
        return parse_size(picture, optarg);
    case KEY_WIREFRAME:
        return picture->wireframe = true;
    case KEY_CONTROL:
        return picture->control_mesh = true;
    case KEY_MESH:
        return parse_mesh(picture, optarg);
    default:
        return false; // getopt_long has said why
    }
}

static bool check_paths(view_picture *picture, char *const *operands, int operand_count) {
    if (operand_count == 0) return view_fail("no .limn file given");
    if (operand_count > 1) return view_fail("'%s': one .limn file at a time", operands[1]);
    if (!picture->png_path) return view_fail("no output given: use --png OUT.png");
    if (!*picture->png_path) return view_fail("--png '': no file name");
    picture->limn_path = operands[0];
    return true;
}

static int print_version(void) {
    const uint32_t version = limn_version();
    printf(version_format, version >> 16, version >> 8 & 255, version & 255);
    return STATUS_OK;
}

static int usage_error(void) {
    fputs("Try 'limn-view --help'.\n", stderr);
    return STATUS_USAGE;
}

int main(int argument_count, char **arguments) {
    view_picture picture = {
        .level = LIMN_LEVEL_MAX, .width = 1280, .height = 960, .mesh_index = VIEW_ALL_MESHES};
    int key;
    while ((key = getopt_long(argument_count, arguments, "", long_options, NULL)) != -1) {
        if (key == KEY_VERSION) return print_version();
        if (key == KEY_HELP) {
            fputs(help_text, stdout);
            return STATUS_OK;
        }
        if (!apply_option(&picture, key)) return usage_error();
    }
    if (!check_paths(&picture, arguments + optind, argument_count - optind)) return usage_error();
    return view_picture_make(&picture) ? STATUS_OK : STATUS_FAILED;
}
