/* SPDX-License-Identifier: MIT */
#include "command.h"
#include "dense.h"
#include "moment.h"
#include "output_file.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>

static const char help[] =
    "Usage: limn export FILE.limn --level L|--eye X,Y,Z -o OUT.obj|OUT.ply [OPTIONS]\n\n"
    "Writes the triangles that a frame draws: everything at one level, or with levels of detail\n"
    "for an eye; at rest, or in a moment of a clip. All meshes of the file are written: as "
    "objects\n"
    "in OBJ, one after the other in PLY. Of a closed mesh that is not culled, --weld makes a "
    "closed\n"
    "surface.\n\n"
    "Options:\n"
    "  -o, --output FILE       .obj (text) or .ply (binary)\n"
    "  -l, --level L           0 (of a triangle 3 vertices and 1 triangle, of a quad 4 and 2) to\n"
    "                          4 (153 and 256, 289 and 512); between whole numbers, the next "
    "level\n"
    "                          on its way (morphing)\n"
    "      --weld              merge the vertices that neighbouring patches share, only where\n"
    "                          all bits of their positions are equal; otherwise every patch has\n"
    "                          its own\n"
    "  -h, --help              this text\n\n" LIMNI_FRAME_HELP "\nExamples:\n"
    "  $ limn export hero.limn --level 4 --weld -o hero.obj\n"
    "  $ limn export hero.limn --eye 0,1,3 --tolerance 8 --weld -o frame.obj\n";

typedef struct arguments {
    const char *input, *output;
    limni_frame_options frame;
    bool weld, ply, help;
} arguments;

static const struct option options[] = {
    {"output", required_argument, NULL, 'o'},
    {"weld", no_argument, NULL, 'w'},
    {"help", no_argument, NULL, 'h'},
    LIMNI_FRAME_OPTIONS(LIMNI_FRAME_LONG_OPTION) // with their commas
    {0},
};

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text), end_length = strlen(end);
    return length > end_length && strcmp(text + length - end_length, end) == 0;
}

static int check(int argc, char **argv, arguments *given) {
    if (optind + 1 != argc) return limni_usage_error("export", "give one .limn file");
    given->input = argv[optind];
    if (!limni_frame_given(&given->frame, LIMNI_FRAME_LEVEL) &&
        !limni_frame_given(&given->frame, LIMNI_FRAME_EYE))
        return limni_usage_error("export",
                                 "there is no level and no eye: --level L or --eye X,Y,Z");
    if (!limni_frame_options_check(&given->frame))
        return limni_usage_error("export", "%s", given->frame.error);
    if (!given->output)
        return limni_usage_error("export", "there is no output: -o OUT.obj or .ply");
    given->ply = ends_with(given->output, ".ply");
    if (!given->ply && !ends_with(given->output, ".obj"))
        return limni_usage_error("export", "%s: the output must end in .obj or .ply",
                                 given->output);
    return LIMNI_EXIT_OK;
}

static int parse_frame_option(int option, arguments *given) {
    if (limni_frame_option_parse(&given->frame, option, optarg)) return LIMNI_EXIT_OK;
    return limni_usage_error("export", "%s", given->frame.error);
}

static int parse_option(int option, arguments *given) {
    switch (option) {
    case 'o':
        given->output = optarg;
        return LIMNI_EXIT_OK;
    case 'w':
        given->weld = true;
        return LIMNI_EXIT_OK;
    case 'h':
        given->help = true;
        return LIMNI_EXIT_OK;
    case 'l':
        return parse_frame_option(LIMNI_FRAME_LEVEL, given);
    default:
        if (option >= LIMNI_FRAME_FIRST) return parse_frame_option(option, given);
        return limni_usage_error("export", "wrong option");
    }
}

static int parse(int argc, char **argv, arguments *given) {
    for (int option; (option = getopt_long(argc, argv, "l:o:h", options, NULL)) != -1;) {
        const int status = parse_option(option, given);
        if (status != LIMNI_EXIT_OK || given->help) return status;
    }
    return check(argc, argv, given);
}

/// What was asked for and not found.
static void print_notes(const limni_dense *dense, uint64_t budget) {
    if (dense->index_count == 0)
        fprintf(stderr, "note: %s: nothing of it is in view\n", dense->name);
    if (budget > 0 && dense->evaluated_count > budget)
        fprintf(stderr, "note: %s: the lowest levels have %llu vertices, more than --budget %llu\n",
                dense->name, (unsigned long long)dense->evaluated_count,
                (unsigned long long)budget);
}

static limn_bake_status write_meshes(limni_context *context, const limni_dense *meshes,
                                     uint32_t mesh_count, const arguments *given) {
    limni_output_file file;
    if (!limni_output_open(&file, given->output))
        return limni_fail(context, LIMN_BAKE_IO, "%s: %s", given->output, file.error);
    if (given->ply) {
        limni_dense_write_ply(meshes, mesh_count, file.stream);
    } else {
        limni_dense_write_obj(meshes, mesh_count, file.stream);
    }
    if (limni_output_commit(&file)) return LIMN_BAKE_OK;
    return limni_fail(context, LIMN_BAKE_IO, "%s: %s", given->output, file.error);
}

static limn_bake_status export_moment(limni_context *context, const limni_moment *moment,
                                      arguments *given) {
    const limni_bounds bounds = limni_moment_bounds(moment);
    const uint32_t mesh_count = moment->mesh_count;
    limni_frame frame;
    if (!limni_frame_resolve(&given->frame, &bounds, &frame))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s", given->frame.error);
    limni_dense *const meshes = limni_allocate(context, mesh_count, sizeof *meshes);
    if (!meshes) return LIMN_BAKE_MEMORY;
    uint64_t vertex_count = 0;
    for (uint32_t m = 0; m < mesh_count; m++) {
        LIMNI_TRY(
            limni_dense_build(context, &moment->meshes[m].mesh, &frame, given->weld, &meshes[m]));
        vertex_count += meshes[m].vertex_count;
    }
    if (vertex_count > UINT32_MAX)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: too many vertices for one file",
                          given->output);
    LIMNI_TRY(write_meshes(context, meshes, mesh_count, given));
    for (uint32_t m = 0; m < mesh_count; m++) {
        printf("%s: %s: %u vertices, %llu triangles\n", given->output, meshes[m].name,
               meshes[m].vertex_count, (unsigned long long)(meshes[m].index_count / 3));
        print_notes(&meshes[m], frame.desc.vertex_budget);
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status export_pack(limni_context *context, const limn_pack *pack,
                                    arguments *given) {
    limni_moment moment;
    const limn_bake_status status =
        limni_moment_make(&moment, pack, 0, pack->mesh_count, &given->frame)
            ? export_moment(context, &moment, given)
            : limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s", given->frame.error);
    limni_moment_free(&moment);
    return status;
}

int limni_command_export(int argc, char **argv) {
    arguments given = {0};
    const int status = parse(argc, argv, &given);
    if (status != LIMNI_EXIT_OK) return status;
    if (given.help) {
        fputs(help, stdout);
        return LIMNI_EXIT_OK;
    }
    limni_pack_file file;
    if (!limni_pack_file_open(&file, given.input)) return LIMNI_EXIT_FAILED;
    limni_context context = {0};
    const int ended = limni_command_end(&context, export_pack(&context, &file.pack, &given));
    limni_pack_file_close(&file);
    return ended;
}
