/* SPDX-License-Identifier: MIT */
#include "command.h"
#include "dense.h"
#include "output_file.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>

static const char help[] =
    "usage: limn export FILE.limn --level N -o OUT.obj|OUT.ply [--weld]\n\n"
    "Evaluates the bind pose at a uniform level and writes a triangle mesh.\n\n"
    "  -l, --level N       0 (3 vertices per face) to 4 (153 vertices, 256 triangles per face)\n"
    "  -o, --output FILE   .obj (text) or .ply (binary)\n"
    "      --weld          merge the vertices that neighbouring patches share, only where all bits "
    "of\n"
    "                      their positions are equal; otherwise every patch has its own\n"
    "  -h, --help          this text\n\n"
    "All meshes of the file are written: as objects in OBJ, one after the other in PLY.\n";

typedef struct arguments {
    const char *input, *output;
    uint32_t level;
    bool has_level, weld, ply, help;
} arguments;

static const struct option options[] = {
    {"level", required_argument, NULL, 'l'},
    {"output", required_argument, NULL, 'o'},
    {"weld", no_argument, NULL, 'w'},
    {"help", no_argument, NULL, 'h'},
    {0},
};

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text), end_length = strlen(end);
    return length > end_length && strcmp(text + length - end_length, end) == 0;
}

static int check(int argc, char **argv, arguments *given) {
    if (optind + 1 != argc) return limni_usage_error("export", "give one .limn file");
    given->input = argv[optind];
    if (!given->has_level) return limni_usage_error("export", "there is no level: --level 0 to 4");
    if (!given->output)
        return limni_usage_error("export", "there is no output: -o OUT.obj or .ply");
    given->ply = ends_with(given->output, ".ply");
    if (!given->ply && !ends_with(given->output, ".obj"))
        return limni_usage_error("export", "%s: the output must end in .obj or .ply",
                                 given->output);
    return LIMNI_EXIT_OK;
}

static int parse(int argc, char **argv, arguments *given) {
    for (int option; (option = getopt_long(argc, argv, "l:o:h", options, NULL)) != -1;) {
        switch (option) {
        case 'l':
            if (!limni_parse_number(optarg, LIMN_LEVEL_MAX, &given->level))
                return limni_usage_error("export", "'%s' is not a level from 0 to 4", optarg);
            given->has_level = true;
            break;
        case 'o':
            given->output = optarg;
            break;
        case 'w':
            given->weld = true;
            break;
        case 'h':
            given->help = true;
            return LIMNI_EXIT_OK;
        default:
            return limni_usage_error("export", "wrong option");
        }
    }
    return check(argc, argv, given);
}

static limn_bake_status export_pack(limni_context *context, const limn_pack *pack,
                                    const arguments *given) {
    limni_dense *const meshes = limni_allocate(context, pack->mesh_count, sizeof *meshes);
    if (!meshes) return LIMN_BAKE_MEMORY;
    uint64_t vertex_count = 0;
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(pack, m);
        LIMNI_TRY(limni_dense_build(context, &mesh, given->level, given->weld, &meshes[m]));
        vertex_count += meshes[m].vertex_count;
    }
    if (vertex_count > UINT32_MAX)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: too many vertices for one file",
                          given->output);
    limni_output_file file;
    if (!limni_output_open(&file, given->output))
        return limni_fail(context, LIMN_BAKE_IO, "%s: %s", given->output, file.error);
    if (given->ply) {
        limni_dense_write_ply(meshes, pack->mesh_count, file.stream);
    } else {
        limni_dense_write_obj(meshes, pack->mesh_count, file.stream);
    }
    if (!limni_output_commit(&file))
        return limni_fail(context, LIMN_BAKE_IO, "%s: %s", given->output, file.error);
    for (uint32_t m = 0; m < pack->mesh_count; m++)
        printf("%s: %s: %u vertices, %llu triangles\n", given->output, meshes[m].name,
               meshes[m].vertex_count, (unsigned long long)(meshes[m].index_count / 3));
    return LIMN_BAKE_OK;
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
    const limn_bake_status exported = export_pack(&context, &file.pack, &given);
    if (exported != LIMN_BAKE_OK) limni_failure("%s", context.error);
    limni_release_all(&context);
    limni_pack_file_close(&file);
    return exported == LIMN_BAKE_OK ? LIMNI_EXIT_OK : LIMNI_EXIT_FAILED;
}
