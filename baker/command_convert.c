/* SPDX-License-Identifier: MIT */
#include "command.h"
#include "output_file.h"
#include "write_mesh.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>

static const char help[] =
    "Usage: limn convert IN OUT [OPTIONS]\n\n"
    "Writes a control mesh in another format: .obj, .off or .ply, as OUT ends. Floats stay the "
    "same\n"
    "to the last bit. OBJ has polygons and OpenSubdiv's tags; OFF and PLY have polygons alone, "
    "and\n"
    "the tags are lost, with a note.\n\n"
    "IN is .obj, .off, .ply, .gltf, .glb, .fbx or .dae. glTF, FBX and Collada must have one mesh.\n"
    "An .obj that begins with #SubdivisionSurfL is Lomont's.\n\n"
    "Options:\n"
    "  -f, --format NAME     obj, off, ply or lomont, whatever OUT ends with. lomont is Lomont's\n"
    "                        extended OBJ (#SubdivisionSurfL 0.1): triangles, half-edges and\n"
    "                        sharpness. Polygons are cut into triangles, and what his format has "
    "no\n"
    "                        entry for follows as OpenSubdiv's tags. It must be a manifold:\n"
    "      --non-manifold NAME  refuse (default), or split, as for limn bake; other formats do "
    "not\n"
    "                        mind\n"
    "  -q, --quiet           only errors\n"
    "  -h, --help            this text\n\n"
    "Examples:\n"
    "  $ limn convert hero.obj hero_lomont.obj --format lomont\n";

typedef enum mesh_format {
    FORMAT_UNKNOWN,
    FORMAT_OBJ,
    FORMAT_OFF,
    FORMAT_PLY,
    FORMAT_LOMONT
} mesh_format;

typedef struct arguments {
    const char *input, *output;
    mesh_format format;
    limn_non_manifold non_manifold;
    bool quiet, help;
} arguments;

enum { OPTION_NON_MANIFOLD = 256 };

static const struct option options[] = {
    {"format", required_argument, NULL, 'f'},
    {"non-manifold", required_argument, NULL, OPTION_NON_MANIFOLD},
    {"quiet", no_argument, NULL, 'q'},
    {"help", no_argument, NULL, 'h'},
    {0},
};

static mesh_format format_named(const char *name) {
    static const char *const names[] = {"obj", "off", "ply", "lomont"};
    for (int n = 0; n < 4; n++) {
        if (strcmp(name, names[n]) == 0) return (mesh_format)(FORMAT_OBJ + n);
    }
    return FORMAT_UNKNOWN;
}

static mesh_format format_of(const char *path) {
    static const char *const extensions[] = {".obj", ".off", ".ply"};
    for (int e = 0; e < 3; e++) {
        if (limni_has_extension(path, extensions[e])) return (mesh_format)(FORMAT_OBJ + e);
    }
    return FORMAT_UNKNOWN;
}

static int check(int argc, char **argv, arguments *given) {
    if (optind + 2 != argc) return limni_usage_error("convert", "give one input and one output");
    given->input = argv[optind];
    given->output = argv[optind + 1];
    if (given->format == FORMAT_UNKNOWN) given->format = format_of(given->output);
    if (given->format == FORMAT_UNKNOWN)
        return limni_usage_error("convert",
                                 "%s: the output must end in .obj, .off or .ply, or give --format",
                                 given->output);
    if (limni_is_same_file(given->input, given->output))
        return limni_usage_error("convert", "%s is input and output", given->input);
    return LIMNI_EXIT_OK;
}

static int parse(int argc, char **argv, arguments *given) {
    for (int option; (option = getopt_long(argc, argv, "f:qh", options, NULL)) != -1;) {
        switch (option) {
        case 'f':
            given->format = format_named(optarg);
            if (given->format == FORMAT_UNKNOWN)
                return limni_usage_error("convert", "there is no format '%s'", optarg);
            break;
        case OPTION_NON_MANIFOLD:
            if (!limni_parse_non_manifold(optarg, &given->non_manifold))
                return limni_usage_error("convert", "cannot '%s' what is not a manifold", optarg);
            break;
        case 'q':
            given->quiet = true;
            break;
        case 'h':
            given->help = true;
            return LIMNI_EXIT_OK;
        default:
            return limni_usage_error("convert", "wrong option");
        }
    }
    return check(argc, argv, given);
}

static void print_note(void *user, const char *text) {
    const arguments *const given = user;
    if (!given->quiet) fprintf(stderr, "note: %s\n", text);
}

static void note_lost(limni_context *context, const limni_source *source, const char *path) {
    const limni_tags *const tags = &source->tags;
    const bool asks =
        tags->boundary != LIMN_BOUNDARY_DEFAULT || tags->creasing != LIMN_CREASING_DEFAULT;
    if (tags->crease_count || tags->sharp_vertex_count || tags->hole_count || asks)
        limni_note(context,
                   "%s: lost, as the format has no tags: %u creases, %u corners, %u holes%s", path,
                   tags->crease_count, tags->sharp_vertex_count, tags->hole_count,
                   asks ? ", and rules for boundaries or creases" : "");
}

static void note_lost_channels(limni_context *context, const limni_source *source,
                               const char *path) {
    for (uint32_t c = 0; c < source->channel_count; c++)
        limni_note(context, "%s: lost, as the format has none: the texture coordinates '%s'", path,
                   source->channels[c].name);
}

static limn_bake_status write(limni_context *context, const arguments *given,
                              const limni_source *source, const limni_mesh *mesh) {
    limni_output_file file;
    if (!limni_output_open(&file, given->output))
        return limni_fail(context, LIMN_BAKE_IO, "%s: %s", given->output, file.error);
    switch (given->format) {
    case FORMAT_OFF:
        limni_write_off(source, file.stream);
        break;
    case FORMAT_PLY:
        limni_write_ply(source, file.stream);
        break;
    case FORMAT_LOMONT:
        limni_write_lomont(mesh, file.stream);
        break;
    default:
        limni_write_obj(source, file.stream);
    }
    if (limni_output_commit(&file)) return LIMN_BAKE_OK;
    return limni_fail(context, LIMN_BAKE_IO, "%s: %s", given->output, file.error);
}

static limn_bake_status convert(limni_context *context, const arguments *given) {
    limni_source source = {0};
    limni_mesh mesh = {0};
    LIMNI_TRY(limni_read_file(context, given->input, &source));
    if (given->format == FORMAT_LOMONT) {
        LIMNI_TRY(limni_mesh_build(context, &source, &mesh));
    } else {
        LIMNI_TRY(limni_check_tags(context, &source));
    }
    if (given->format == FORMAT_OFF || given->format == FORMAT_PLY)
        note_lost(context, &source, given->output);
    if (given->format != FORMAT_OBJ) note_lost_channels(context, &source, given->output);
    LIMNI_TRY(write(context, given, &source, &mesh));
    const bool built = given->format == FORMAT_LOMONT;
    if (!given->quiet)
        printf("%s: %u vertices, %u faces\n", given->output,
               built ? mesh.control_count : source.position_count,
               built ? mesh.face_count : source.face_count);
    return LIMN_BAKE_OK;
}

int limni_command_convert(int argc, char **argv) {
    arguments given = {0};
    const int status = parse(argc, argv, &given);
    if (status != LIMNI_EXIT_OK) return status;
    if (given.help) {
        fputs(help, stdout);
        return LIMNI_EXIT_OK;
    }
    limni_context context = {
        .desc = {.non_manifold = given.non_manifold, .note = print_note, .user = &given}};
    return limni_command_end(&context, convert(&context, &given));
}
