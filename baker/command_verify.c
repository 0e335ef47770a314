/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <getopt.h>
#include <stdio.h>

#ifdef LIMNI_WITH_OPENSUBDIV

#include "compare.h"
#include "numbers.h"

#include <float.h>

static const double default_tolerance = 3e-7, channel_tolerance = 1e-6;

static const char help[] =
    "Usage: limn verify FILE.limn --against IN.obj [OPTIONS]\n\n"
    "Evaluates a mesh at level 4 and compares every vertex with OpenSubdiv's limit position, in "
    "double\n"
    "precision. Prints the largest and the mean difference relative to the diagonal of the "
    "bounding\n"
    "box, and the tolerance. The file must have been baked from that mesh, as OpenSubdiv has it:\n"
    "--scheme loop with Loop's weights, catmark, or none of a mesh that is not of triangles "
    "alone;\n"
    "where it has creases, corners or boundaries, with OpenSubdiv's rules for them. OpenSubdiv "
    "has\n"
    "no butterfly, no Warren's weights, none of Lomont's rules, and nothing like --scheme none "
    "for\n"
    "meshes of triangles. Where two values of a channel alternate around a vertex, it counts the\n"
    "second twice, and Limn does not: there they differ (docs/mathematics.md).\n\n"
    "Options:\n"
    "      --against FILE   the mesh (.obj, .off, .ply, .gltf, .glb, .fbx, .dae) that was\n"
    "                       baked\n"
    "      --mesh N         which mesh of the file, from 0 (default 0)\n"
    "      --repair[=STEPS]  as for limn bake, if the mesh was repaired then\n"
    "      --non-manifold NAME  likewise\n"
    "      --tolerance X    fail when the largest difference is above X (default: 3e-7, and what\n"
    "                       rounding coordinates to floats adds far from the origin; of texture\n"
    "                       coordinates 1e-6 of their extent)\n"
    "  -h, --help           this text\n\n"
    "Examples:\n"
    "  $ limn verify hero.limn --against hero.obj\n";

typedef struct arguments {
    const char *input, *against;
    uint32_t mesh, repair;
    limn_non_manifold non_manifold;
    float tolerance; ///< negative: the default
    bool help;
} arguments;

enum { OPTION_AGAINST = 256, OPTION_MESH, OPTION_REPAIR, OPTION_NON_MANIFOLD, OPTION_TOLERANCE };

static const struct option options[] = {
    {"against", required_argument, NULL, OPTION_AGAINST},
    {"mesh", required_argument, NULL, OPTION_MESH},
    {"repair", optional_argument, NULL, OPTION_REPAIR},
    {"non-manifold", required_argument, NULL, OPTION_NON_MANIFOLD},
    {"tolerance", required_argument, NULL, OPTION_TOLERANCE},
    {"help", no_argument, NULL, 'h'},
    {0},
};

static int parse_option(int option, arguments *given) {
    switch (option) {
    case OPTION_AGAINST:
        given->against = optarg;
        return LIMNI_EXIT_OK;
    case OPTION_MESH:
        if (limni_parse_number(optarg, UINT32_MAX, &given->mesh)) return LIMNI_EXIT_OK;
        return limni_usage_error("verify", "'%s' is not the number of a mesh", optarg);
    case OPTION_REPAIR:
        if (limni_parse_repair(optarg, &given->repair)) return LIMNI_EXIT_OK;
        return limni_usage_error("verify", "cannot repair '%s'", optarg);
    case OPTION_NON_MANIFOLD:
        if (limni_parse_non_manifold(optarg, &given->non_manifold)) return LIMNI_EXIT_OK;
        return limni_usage_error("verify", "cannot '%s' what is not a manifold", optarg);
    case OPTION_TOLERANCE:
        if (limni_parse_real(optarg, 0, FLT_MAX, &given->tolerance)) return LIMNI_EXIT_OK;
        return limni_usage_error("verify", "'%s' is not a tolerance", optarg);
    case 'h':
        given->help = true;
        return LIMNI_EXIT_OK;
    default:
        return limni_usage_error("verify", "wrong option");
    }
}

static int parse(int argc, char **argv, arguments *given) {
    for (int option; (option = getopt_long(argc, argv, "h", options, NULL)) != -1;) {
        const int status = parse_option(option, given);
        if (status != LIMNI_EXIT_OK || given->help) return status;
    }
    if (optind + 1 != argc) return limni_usage_error("verify", "give one .limn file");
    if (!given->against) return limni_usage_error("verify", "there is no mesh: --against IN.obj");
    given->input = argv[optind];
    return LIMNI_EXIT_OK;
}

/// Texture coordinates, in their extent.
static int verify_channels(const arguments *given, const limn_pack *pack, const limn_mesh *mesh) {
    const double allowed = given->tolerance >= 0 ? (double)given->tolerance : channel_tolerance;
    for (uint32_t c = 0; c < mesh->channel_count; c++) {
        limni_context context = {
            .desc = {.repair = given->repair, .non_manifold = given->non_manifold}};
        limni_channel_comparison comparison;
        const int compared = limni_command_end(
            &context, limni_compare_channel(&context, pack, mesh, c, given->against, &comparison));
        if (compared != LIMNI_EXIT_OK) return compared;
        printf("%s, channel %u: %llu values; largest difference, relative to their extent %g: %.3g "
               "(face %u); tolerance %.3g\n",
               mesh->name, c, (unsigned long long)comparison.value_count, comparison.extent,
               comparison.largest, comparison.largest_face, allowed);
        if (!(comparison.largest <= allowed))
            return limni_failure("the largest difference in a channel is above %g", allowed);
    }
    return LIMNI_EXIT_OK;
}

static void print_comparison(const char *name, const limni_comparison *comparison,
                             uint32_t face_count, double allowed) {
    printf("%s: %llu vertices of %u faces; difference from OpenSubdiv's limit, relative to the "
           "diagonal %g: largest %.3g (face %u), mean %.3g; tolerance %.3g\n",
           name, (unsigned long long)comparison->vertex_count, face_count, comparison->diagonal,
           comparison->largest, comparison->largest_face, comparison->mean, allowed);
    if (comparison->normal_count)
        printf("%s: angle between normals in radians: largest %.3g (face %u), mean %.3g; "
               "%llu of %llu at degenerate points left out\n",
               name, comparison->largest_angle, comparison->largest_angle_face,
               comparison->mean_angle, (unsigned long long)comparison->degenerate_count,
               (unsigned long long)(comparison->normal_count + comparison->degenerate_count));
    fflush(stdout);
    if (comparison->rounding > default_tolerance)
        fprintf(stderr,
                "note: %s: so far from the origin, floats cannot hold the mesh to better than %.2g "
                "of its diagonal\n",
                name, comparison->rounding);
}

static int verify(const arguments *given, const limn_pack *pack) {
    if (given->mesh >= pack->mesh_count)
        return limni_failure("%s: there is no mesh %u; the file has %u", given->input, given->mesh,
                             pack->mesh_count);
    limni_context context = {
        .desc = {.repair = given->repair, .non_manifold = given->non_manifold}};
    const limn_mesh mesh = limn_pack_mesh(pack, given->mesh);
    limni_comparison comparison;
    const int compared = limni_command_end(
        &context, limni_compare(&context, pack, &mesh, given->against, &comparison));
    if (compared != LIMNI_EXIT_OK) return compared;
    const double allowed =
        given->tolerance >= 0 ? (double)given->tolerance : default_tolerance + comparison.rounding;
    print_comparison(mesh.name, &comparison, mesh.patch_count, allowed);
    const int channels = verify_channels(given, pack, &mesh);
    if (channels != LIMNI_EXIT_OK) return channels;
    if (!(comparison.largest <= allowed))
        return limni_failure("the largest difference is above %g", allowed);
    return LIMNI_EXIT_OK;
}

int limni_command_verify(int argc, char **argv) {
    arguments given = {.tolerance = -1};
    const int status = parse(argc, argv, &given);
    if (status != LIMNI_EXIT_OK) return status;
    if (given.help) {
        fputs(help, stdout);
        return LIMNI_EXIT_OK;
    }
    limni_pack_file file;
    if (!limni_pack_file_open(&file, given.input)) return LIMNI_EXIT_FAILED;
    const int verified = verify(&given, &file.pack);
    limni_pack_file_close(&file);
    return verified;
}

#else

int limni_command_verify(int argc, char **argv) {
    (void)argc;
    (void)argv;
    return limni_failure("this limn was built without OpenSubdiv, which verify needs");
}

#endif
