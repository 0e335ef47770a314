/* SPDX-License-Identifier: MIT */
/* limn-view: arguments and exit statuses. */
#include "keys.h"
#include "numbers.h"
#include "output_file.h"
#include "picture.h"
#include "report.h"
#include "scene.h"
#include "script.h"
#include "target.h"
#include "window.h"
#include <getopt.h>
#include <stdio.h>
#include <string.h>

const char view_program_name[] = "limn-view";

enum { STATUS_OK = 0, STATUS_FAILED = 1, STATUS_USAGE = 2 };

static const char description_help[] =
    "Usage: limn-view FILE [OPTIONS]\n"
    "  or:  limn-view FILE --png OUT.png [OPTIONS]\n"
    "\n"
    "Shows the meshes of a baked .limn file, evaluated in every frame, in a window; or draws a\n"
    "PNG picture, which needs no window system. A mesh file (.obj, .off, .ply, .gltf, .glb,\n"
    ".fbx, .dae), and one that is dropped into the window, is first baked, as by `limn bake\n"
    "--normals exact --isolate auto --repair --non-manifold split`.\n"
    "\n"
    "The window begins with what the options say; its camera counts as an eye, and levels are by\n"
    "length unless something else is said. Drag with the left button to orbit, with the right one\n"
    "to look around, with the middle one to pan; the wheel zooms.\n"
    "\n"
    "Without an eye, a picture looks at the surface from the front (+Z), the right and above, and\n"
    "frames it the same way at every level. The inside of an open surface is darker than its\n"
    "outside. The same command writes the same bytes on one machine.\n"
    "\n";

static const char options_help[] =
    "Options:\n"
    "      --png OUT.png       the picture to write; replaced only by a complete one\n"
    "      --level L           0 (a triangle is one, a quad two) to 4 (256, 512 triangles); "
    "between\n"
    "                          whole numbers, the next level on its way (morphing); default 4\n"
    "      --size WxH          of the picture, in pixels, up to 8192 each; default 1280x960, or\n"
    "                          with an eye the viewport; of the window 1280x720\n"
    "      --colour WHAT       materials (default): base colours and textures, and clay where\n"
    "                          there are none; clay; uv: a chequered pattern in texture\n"
    "                          coordinates; normals; levels: of each patch the highest of its\n"
    "                          edges, 0 blue, 1 light blue, 2 green, 3 yellow, 4 orange, and in\n"
    "                          between while morphing; or classes: regular patches grey, those of\n"
    "                          each other class in a colour of their own\n"
    "      --shade HOW         smooth (default), or flat: each triangle by its own normal\n"
    "      --light HOW         the runtime's light on vertices, faint from the front, and a spot:\n"
    "                          interpolated or exact (limn_light_mode), or base: all light at the\n"
    "                          base vertices, for comparison; default: each pixel is lit\n"
    "      --spot X,Y,Z        where the spot is, in model units; default: there is none\n"
    "      --spot-target X,Y,Z  what it shines on; default the middle of the bounds\n"
    "      --spot-cone DEG     angle from its axis to its edge, 1 to 89 degrees; default 20\n"
    "      --wireframe         draw triangles, and the borders of patches stronger\n"
    "      --control-mesh      draw the edges and points of the base mesh, faintly where hidden\n"
    "      --mesh N            draw mesh N of the file only, counted from 0; default all meshes\n"
    "      --overview          look at the frame from where pictures without an eye are taken\n"
    "      --help              print this and exit\n"
    "      --version           print the version and exit\n"
    "\n" LIMNI_FRAME_HELP;

static const char end_help[] =
    "\n"
    "Exit status:\n"
    "  0        the picture was written, or the window closed\n"
    "  1        the file or the machine does not allow it; nothing is written\n"
    "  2        the command line is wrong; nothing is written\n"
    "\n"
    "Examples:\n"
    "  $ limn-view fox.glb\n"
    "  $ limn-view spot.limn --png spot.png --eye 0,1,3 --colour levels --wireframe\n";

static const char version_format[] = "limn-view %u.%u.%u\n";

enum option_key {
    KEY_PNG = 1,
    KEY_SIZE,
    KEY_COLOUR,
    KEY_SHADE,
    KEY_LIGHT,
    KEY_SPOT,
    KEY_SPOT_TARGET,
    KEY_SPOT_CONE,
    KEY_WIREFRAME,
    KEY_CONTROL,
    KEY_MESH,
    KEY_OVERVIEW,
    KEY_KEYS,
    KEY_HELP,
    KEY_VERSION
};

static bool parse_size(view_picture *picture, const char *text) {
    return limni_parse_size(text, VIEW_TARGET_SIZE_MAX, &picture->width, &picture->height) ||
           view_fail("--size '%s': not WIDTHxHEIGHT with 1 to %d pixels each", text,
                     VIEW_TARGET_SIZE_MAX);
}

static bool parse_keys(view_picture *picture, const char *text) {
    picture->keys = text;
    return view_script_check(text) || view_fail("--keys '%s': not names of keys", text);
}

static bool parse_mesh(view_picture *picture, const char *text) {
    uint32_t mesh_index;
    if (!limni_parse_number(text, INT32_MAX, &mesh_index))
        return view_fail("--mesh '%s': not a mesh number, counted from 0", text);
    picture->mesh_index = (long)mesh_index;
    return true;
}

static bool parse_colour(view_picture *picture, const char *text) {
    static const char *const names[] = {[VIEW_COLOURS_MATERIALS] = "materials",
                                        [VIEW_COLOURS_CLAY] = "clay",
                                        [VIEW_COLOURS_LEVELS] = "levels",
                                        [VIEW_COLOURS_CLASSES] = "classes",
                                        [VIEW_COLOURS_UV] = "uv",
                                        [VIEW_COLOURS_NORMALS] = "normals"};
    for (int colours = 0; colours < VIEW_COLOURS_COUNT; colours++) {
        picture->colours = (view_colours)colours;
        if (strcmp(text, names[colours]) == 0) return true;
    }
    return view_fail("--colour '%s': not materials, clay, levels, classes, uv or normals", text);
}

static bool parse_shade(view_picture *picture, const char *text) {
    picture->flat_shading = strcmp(text, "flat") == 0;
    return picture->flat_shading || strcmp(text, "smooth") == 0 ||
           view_fail("--shade '%s': not smooth or flat", text);
}

static bool parse_light(view_picture *picture, const char *text) {
    static const char *const names[] = {[VIEW_LIGHT_BASE] = "base",
                                        [VIEW_LIGHT_INTERPOLATED] = "interpolated",
                                        [VIEW_LIGHT_EXACT] = "exact"};
    picture->light.mode = VIEW_LIGHT_NONE;
    for (int mode = VIEW_LIGHT_BASE; mode <= VIEW_LIGHT_EXACT; mode++) {
        if (strcmp(text, names[mode]) == 0) picture->light.mode = (view_light_mode)mode;
    }
    return picture->light.mode != VIEW_LIGHT_NONE ||
           view_fail("--light '%s': not interpolated, exact or base", text);
}

static bool parse_spot(view_light *light, int key, const char *text) {
    switch (key) {
    case KEY_SPOT:
        light->has_spot = limni_parse_point(text, light->spot);
        return light->has_spot || view_fail("--spot '%s': not a point X,Y,Z", text);
    case KEY_SPOT_TARGET:
        light->has_target = limni_parse_point(text, light->target);
        return light->has_target || view_fail("--spot-target '%s': not a point X,Y,Z", text);
    default:
        return limni_parse_real(text, 1, 89, &light->cone) ||
               view_fail("--spot-cone '%s': not an angle of 1 to 89 degrees", text);
    }
}

static const struct option long_options[] = {
    {"png", required_argument, NULL, KEY_PNG},
    {"size", required_argument, NULL, KEY_SIZE},
    {"colour", required_argument, NULL, KEY_COLOUR},
    {"shade", required_argument, NULL, KEY_SHADE},
    {"light", required_argument, NULL, KEY_LIGHT},
    {"spot", required_argument, NULL, KEY_SPOT},
    {"spot-target", required_argument, NULL, KEY_SPOT_TARGET},
    {"spot-cone", required_argument, NULL, KEY_SPOT_CONE},
    {"wireframe", no_argument, NULL, KEY_WIREFRAME},
    {"control-mesh", no_argument, NULL, KEY_CONTROL},
    {"mesh", required_argument, NULL, KEY_MESH},
    {"overview", no_argument, NULL, KEY_OVERVIEW},
    {"keys", required_argument, NULL, KEY_KEYS}, // for tests
    {"help", no_argument, NULL, KEY_HELP},
    {"version", no_argument, NULL, KEY_VERSION},
    LIMNI_FRAME_OPTIONS(LIMNI_FRAME_LONG_OPTION) // with their commas
    {0},
};

static bool apply_option(view_picture *picture, int key) {
    switch (key) {
    case KEY_PNG:
        picture->png_path = optarg;
        return true;
    case KEY_SIZE:
        return parse_size(picture, optarg);
    case KEY_COLOUR:
        return parse_colour(picture, optarg);
    case KEY_SHADE:
        return parse_shade(picture, optarg);
    case KEY_LIGHT:
        return parse_light(picture, optarg);
    case KEY_SPOT:
    case KEY_SPOT_TARGET:
    case KEY_SPOT_CONE:
        return parse_spot(&picture->light, key, optarg);
    case KEY_WIREFRAME:
        return picture->wireframe = true;
    case KEY_CONTROL:
        return picture->control_mesh = true;
    case KEY_MESH:
        return parse_mesh(picture, optarg);
    case KEY_KEYS:
        return parse_keys(picture, optarg);
    case KEY_OVERVIEW:
        return picture->overview = true;
    default:
        if (key < LIMNI_FRAME_FIRST) return false; // getopt_long has said why
        return limni_frame_option_parse(&picture->frame, key, optarg) ||
               view_fail("%s", picture->frame.error);
    }
}

static bool check_paths(view_picture *picture, char *const *operands, int operand_count) {
    if (operand_count == 0) return view_fail("no file given");
    if (operand_count > 1) return view_fail("'%s': one file at a time", operands[1]);
    picture->limn_path = operands[0];
    if (!picture->png_path) return true;
    if (!*picture->png_path) return view_fail("--png '': no file name");
    if (picture->keys) return view_fail("--keys: there is no window");
    if (limni_is_same_file(picture->limn_path, picture->png_path))
        return view_fail("%s is input and output", picture->png_path);
    return true;
}

static bool check_light(const view_light *light) {
    if (light->has_spot && light->mode == VIEW_LIGHT_NONE)
        return view_fail("--spot: say how to --light");
    if ((light->has_target || light->cone > 0) && !light->has_spot)
        return view_fail("--spot-%s: there is no --spot", light->has_target ? "target" : "cone");
    return true;
}

/// A picture of a frame has the size of its viewport.
static bool check_frame(view_picture *picture) {
    limni_frame_options *const frame = &picture->frame;
    frame->live = !picture->png_path;
    if (!limni_frame_options_check(frame)) return view_fail("%s", frame->error);
    const bool has_eye = limni_frame_given(frame, LIMNI_FRAME_EYE);
    if (picture->overview && !has_eye) return view_fail("--overview: there is no --eye");
    if (picture->width) return true;
    picture->width = has_eye || frame->live ? frame->width : 1280;
    picture->height = has_eye || frame->live ? frame->height : 960;
    return (picture->width <= VIEW_TARGET_SIZE_MAX && picture->height <= VIEW_TARGET_SIZE_MAX) ||
           view_fail("--viewport %ux%u: a picture has at most %d pixels a side; give its --size",
                     frame->width, frame->height, VIEW_TARGET_SIZE_MAX);
}

/// What only pictures have.
static bool check_window(const view_picture *picture) {
    if (picture->png_path) return true;
    if (picture->overview) return view_fail("--overview: there is no --png");
    return picture->light.mode != VIEW_LIGHT_BASE || view_fail("--light base: there is no --png");
}

static int print_help(void) {
    static const char *const keys[][2] = {
#define KEY_HELP(key, code, name, help) {name, help},
        VIEW_KEYS(KEY_HELP)
#undef KEY_HELP
    };
    fputs(description_help, stdout);
    fputs(options_help, stdout);
    fputs("\nKeys of the window:\n", stdout);
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++)
        printf("  %-8s %s\n", keys[k][0], keys[k][1]);
    fputs(end_help, stdout);
    return STATUS_OK;
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
    view_picture picture = {.frame.desc.level = LIMN_LEVEL_MAX, .mesh_index = VIEW_ALL_MESHES};
    int key;
    while ((key = getopt_long(argument_count, arguments, "", long_options, NULL)) != -1) {
        if (key == KEY_VERSION) return print_version();
        if (key == KEY_HELP) return print_help();
        if (!apply_option(&picture, key)) return usage_error();
    }
    if (!check_paths(&picture, arguments + optind, argument_count - optind) ||
        !check_light(&picture.light) || !check_window(&picture) || !check_frame(&picture))
        return usage_error();
    const bool done =
        picture.png_path ? view_picture_make(&picture) : view_window_run(&picture, picture.keys);
    return done ? STATUS_OK : STATUS_FAILED;
}
