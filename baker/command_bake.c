/* SPDX-License-Identifier: MIT */
#include "command.h"
#include "output_file.h"
#include "source.h"
#include "write_c_array.h"

#include "numbers.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static const char help[] =
    "Usage: limn bake IN... -o OUT.limn [OPTIONS]\n\n"
    "Bakes one or more meshes (.obj, .off, .ply, .gltf, .glb, .fbx, .dae) into one .limn file.\n"
    "The meshes share their stencil tables. Of glTF, FBX and Collada all meshes of the scene are\n"
    "baked, with skeleton, morph targets, clips and materials.\n\n"
    "Loop's scheme and the butterfly cut polygons into triangles, quads along the shorter "
    "diagonal;\n"
    "catmark and none take them as they are. Nothing is written unless all is well.\n\n"
    "Options:\n"
    "  -o, --output FILE     the file to write\n"
    "      --scheme NAME     loop (default), of triangles: other polygons are cut; catmark:\n"
    "                        Catmull-Clark, of any polygons; butterfly: the modified butterfly, "
    "of\n"
    "                        triangles, through the control points, without creases; or none: the\n"
    "                        faces as they are, with sharp edges, triangles flat, others bilinear\n"
    "      --tension W       of the butterfly, -0.25 to 0.25 (default 0): its stencil of ten "
    "points\n"
    "      --weights NAME    vertex weights: loop (default) or warren\n"
    "      --boundary NAME   edge-only: boundaries are smooth curves; edge-and-corner: boundary\n"
    "                        vertices of a single face stay in place (loop and catmark); none:\n"
    "                        faces at a boundary are left out. Default: what the mesh asks for\n"
    "                        (t interpolateboundary in OBJ), otherwise edge-only\n"
    "      --creases NAME    the rules for sharp edges, sharp vertices and boundaries: "
    "opensubdiv\n"
    "                        (default), or lomont, also for files in Lomont's format\n"
    "      --creasing NAME   how sharpness falls, with OpenSubdiv's rules: uniform, or chaikin.\n"
    "                        Default: what the mesh asks for (t creasemethod in OBJ), otherwise\n"
    "                        uniform\n"
    "      --normals NAME    none (default), or exact: store tangents of the limit surface\n"
    "      --isolate 0|1|auto  1: evaluate the points of one level of subdivision first, and "
    "patches\n"
    "                        in four pieces: few, small tables, of tens of kilobytes where "
    "creases\n"
    "                        and very high valences are rare. The butterfly's patches are then\n"
    "                        those of level 1. auto: each mesh whose tables would take more than\n"
    "                        256 KB, if bytes times time become less, never with the butterfly.\n"
    "                        Bytes are those of tables, patches and points; the time is counted,\n"
    "                        not measured (docs/performance.md), of positions at level 3; both\n"
    "                        are said. With tables in the caches a patch takes about twice as\n"
    "                        long at level 4, up to 5 times at lower ones, and level 1 6 to 18 ns\n"
    "                        a patch. Default: 0\n"
    "      --face-varying NAME  where texture coordinates are linear, as in OpenSubdiv: none,\n"
    "                        corners-only (default), corners-plus1, corners-plus2, boundaries,\n"
    "                        all. With --scheme butterfly the default is all, with none it is\n"
    "                        always\n"
    "      --no-channels     leave out texture coordinates\n"
    "      --images          store the images of materials, not only their names\n"
    "      --repair[=STEPS]  mend what would be refused, and say so; STEPS of, separated by "
    "commas:\n"
    "                        weld: merge control points whose positions are equal, and equal\n"
    "                        texture coordinates; drop: drop degenerate and repeated faces;\n"
    "                        all (default): both, in this order\n"
    "      --non-manifold NAME  edges that more than two faces share or whose faces are wound\n"
    "                        inconsistently, and vertices whose faces are not one chain: refuse\n"
    "                        (default), or split: as in OpenSubdiv, these edges are sharp and "
    "these\n"
    "                        vertices corners; each sheet gets control points of its own\n"
    "      --c-array NAME    write C source instead of a .limn file: an array NAME of its bytes\n"
    "  -q, --quiet           only errors\n"
    "  -h, --help            this text\n\n"
    "Examples:\n"
    "  $ limn bake body.obj head.obj -o hero.limn --weights warren\n";

typedef struct arguments {
    limn_bake_desc desc;
    const char *output;
    const char *array_name; ///< --c-array; NULL: a .limn file
    bool quiet, help;
    double next_progress; ///< seconds; 0: not yet set
    bool progress_shown;
} arguments;

static void print_note(void *user, const char *text) {
    const arguments *const given = user;
    if (!given->quiet) fprintf(stderr, "note: %s\n", text);
}

static double seconds_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// A line that is shown after a while, a few times a second, and removed at the end.
static void print_progress(void *user, const char *step, uint32_t done, uint32_t total) {
    arguments *const given = user;
    const double now = seconds_now();
    if (given->next_progress == 0) given->next_progress = now + 0.5;
    if (now < given->next_progress && !(done == total && given->progress_shown)) return;
    given->next_progress = now + 0.2;
    given->progress_shown = done < total;
    fprintf(stderr, "\r%s: %u of %u faces", step, done, total);
    if (done == total) fprintf(stderr, "\r\033[K");
    fflush(stderr);
}

enum {
    OPTION_SCHEME = 256,
    OPTION_WEIGHTS,
    OPTION_TENSION,
    OPTION_BOUNDARY,
    OPTION_CREASES,
    OPTION_CREASING,
    OPTION_NORMALS,
    OPTION_ISOLATE,
    OPTION_FACE_VARYING,
    OPTION_NO_CHANNELS,
    OPTION_IMAGES,
    OPTION_REPAIR,
    OPTION_NON_MANIFOLD,
    OPTION_C_ARRAY
};

static const struct option options[] = {
    {"output", required_argument, NULL, 'o'},
    {"scheme", required_argument, NULL, OPTION_SCHEME},
    {"weights", required_argument, NULL, OPTION_WEIGHTS},
    {"tension", required_argument, NULL, OPTION_TENSION},
    {"boundary", required_argument, NULL, OPTION_BOUNDARY},
    {"creases", required_argument, NULL, OPTION_CREASES},
    {"creasing", required_argument, NULL, OPTION_CREASING},
    {"normals", required_argument, NULL, OPTION_NORMALS},
    {"isolate", required_argument, NULL, OPTION_ISOLATE},
    {"face-varying", required_argument, NULL, OPTION_FACE_VARYING},
    {"no-channels", no_argument, NULL, OPTION_NO_CHANNELS},
    {"images", no_argument, NULL, OPTION_IMAGES},
    {"repair", optional_argument, NULL, OPTION_REPAIR},
    {"non-manifold", required_argument, NULL, OPTION_NON_MANIFOLD},
    {"c-array", required_argument, NULL, OPTION_C_ARRAY},
    {"quiet", no_argument, NULL, 'q'},
    {"help", no_argument, NULL, 'h'},
    {0},
};

/// The options that choose a name, and what is said when there is none such.
typedef struct choice {
    const char *names[7]; ///< up to a NULL
    int first;            ///< what the first stands for; the next for the next, and so on
    const char *error;
} choice;

static const choice schemes = {
    {"loop", "catmark", "butterfly", "none"}, LIMN_SCHEME_LOOP, "there is no scheme '%s'"};
static const choice weights = {{"loop", "warren"}, LIMN_WEIGHTS_LOOP, "there are no weights '%s'"};
static const choice boundaries = {{"edge-only", "edge-and-corner", "none"},
                                  LIMN_BOUNDARY_EDGE_ONLY,
                                  "there is no boundary rule '%s'"};
static const choice creases = {
    {"opensubdiv", "lomont"}, LIMN_CREASES_OPENSUBDIV, "there are no crease rules '%s'"};
static const choice creasings = {
    {"uniform", "chaikin"}, LIMN_CREASING_UNIFORM, "there is no creasing method '%s'"};
static const choice normals = {{"none", "exact"}, LIMN_NORMALS_NONE, "there are no normals '%s'"};
static const choice isolations = {{"0", "1", "auto"}, LIMN_ISOLATE_NEVER, "cannot isolate '%s'"};

static const choice face_varyings = {
    {"none", "corners-only", "corners-plus1", "corners-plus2", "boundaries", "all"},
    LIMN_FACE_VARYING_NONE,
    "there is no face-varying mode '%s'"};

/// What optarg stands for. Sets *status if it is none of the names.
static int choose(const choice *from, int *status) {
    for (int n = 0; from->names[n]; n++) {
        if (strcmp(optarg, from->names[n]) == 0) return from->first + n;
    }
    *status = limni_usage_error("bake", from->error, optarg);
    return 0;
}

/// The options that choose a name, and those that there are not.
static int parse_choice(int option, limn_bake_desc *desc) {
    int status = LIMNI_EXIT_OK;
    switch (option) {
    case OPTION_SCHEME:
        desc->scheme = (limn_scheme)choose(&schemes, &status);
        break;
    case OPTION_WEIGHTS:
        desc->weights = (limn_weights)choose(&weights, &status);
        break;
    case OPTION_BOUNDARY:
        desc->boundary = (limn_boundary)choose(&boundaries, &status);
        break;
    case OPTION_CREASES:
        desc->creases = (limn_creases)choose(&creases, &status);
        break;
    case OPTION_CREASING:
        desc->creasing = (limn_creasing)choose(&creasings, &status);
        break;
    case OPTION_NORMALS:
        desc->normals = (limn_normals)choose(&normals, &status);
        break;
    case OPTION_ISOLATE:
        desc->isolate = (limn_isolate)choose(&isolations, &status);
        break;
    case OPTION_FACE_VARYING:
        desc->face_varying = (limn_face_varying)choose(&face_varyings, &status);
        break;
    default: // getopt has said what is wrong
        fprintf(stderr, "see limn bake --help\n");
        return LIMNI_EXIT_USAGE;
    }
    return status;
}

static int parse_option(int option, arguments *given) {
    limn_bake_desc *const desc = &given->desc;
    switch (option) {
    case 'o':
        given->output = optarg;
        return LIMNI_EXIT_OK;
    case OPTION_TENSION:
        if (limni_parse_real(optarg, -0.25f, 0.25f, &desc->tension)) return LIMNI_EXIT_OK;
        return limni_usage_error("bake", "'%s' is not a tension between -0.25 and 0.25", optarg);
    case OPTION_IMAGES:
        desc->images = true;
        return LIMNI_EXIT_OK;
    case OPTION_NO_CHANNELS:
        desc->no_channels = true;
        return LIMNI_EXIT_OK;
    case OPTION_REPAIR:
        if (!limni_parse_repair(optarg, &desc->repair))
            return limni_usage_error("bake", "cannot repair '%s'", optarg);
        return LIMNI_EXIT_OK;
    case OPTION_NON_MANIFOLD:
        if (!limni_parse_non_manifold(optarg, &desc->non_manifold))
            return limni_usage_error("bake", "cannot '%s' what is not a manifold", optarg);
        return LIMNI_EXIT_OK;
    case OPTION_C_ARRAY:
        given->array_name = optarg;
        if (limni_is_c_name(optarg)) return LIMNI_EXIT_OK;
        return limni_usage_error("bake", "'%s' cannot be the name of an array in C", optarg);
    case 'q':
        given->quiet = true;
        return LIMNI_EXIT_OK;
    case 'h':
        given->help = true;
        return LIMNI_EXIT_OK;
    default:
        return parse_choice(option, desc);
    }
}

static int parse(int argc, char **argv, arguments *given) {
    for (int option; (option = getopt_long(argc, argv, "o:qh", options, NULL)) != -1;) {
        const int status = parse_option(option, given);
        if (status != LIMNI_EXIT_OK || given->help) return status;
    }
    if (optind == argc) return limni_usage_error("bake", "there is no input");
    if (!given->output || !given->output[0])
        return limni_usage_error("bake", "there is no output: -o OUT.limn");
    return LIMNI_EXIT_OK;
}

/// A mesh's name in the place of the output is a slip that would cost the mesh.
static bool is_mesh_name(const char *path) {
    static const char *const extensions[] = {".obj", ".off", ".ply", ".gltf",
                                             ".glb", ".fbx", ".dae"};
    for (size_t e = 0; e < sizeof extensions / sizeof *extensions; e++) {
        if (limni_has_extension(path, extensions[e])) return true;
    }
    return false;
}

static void print_summary(const char *path, const void *blob, size_t size) {
    limn_pack pack;
    if (limn_pack_open(&pack, blob, size) != LIMN_OK)
        return; // the caller has checked that it opens
    uint64_t faces = 0;
    for (uint32_t m = 0; m < pack.mesh_count; m++)
        faces += limn_pack_mesh(&pack, m).patch_count;
    printf("%s: %u %s, %llu faces, %u classes, %zu bytes\n", path, pack.mesh_count,
           pack.mesh_count == 1 ? "mesh" : "meshes", (unsigned long long)faces, pack.class_count,
           size);
}

/// Returns the exit status.
static int write_array(const arguments *given, const void *blob, size_t size) {
    limni_output_file file;
    bool written = limni_output_open(&file, given->output);
    if (written) {
        limni_write_c_array(file.stream, given->array_name, blob, size);
        written = limni_output_commit(&file);
    }
    return written ? LIMNI_EXIT_OK : limni_failure("%s: %s", given->output, file.error);
}

/// Returns the exit status.
static int bake(limn_baker *baker, const arguments *given, char **inputs) {
    limn_bake_status status = LIMN_BAKE_OK;
    for (; *inputs && status == LIMN_BAKE_OK; inputs++)
        status = limn_baker_add_file(baker, *inputs);
    const void *blob = NULL;
    size_t size = 0;
    if (status == LIMN_BAKE_OK) status = limn_baker_finish(baker, &blob, &size);
    if (status == LIMN_BAKE_OK && !given->array_name)
        status = limn_baker_write(baker, given->output);
    if (status != LIMN_BAKE_OK) return limni_failure("%s", limn_baker_error(baker));
    if (given->array_name && write_array(given, blob, size) != LIMNI_EXIT_OK)
        return LIMNI_EXIT_FAILED;
    if (!given->quiet) print_summary(given->output, blob, size);
    return LIMNI_EXIT_OK;
}

int limni_command_bake(int argc, char **argv) {
    arguments given = {0};
    const int status = parse(argc, argv, &given);
    if (status != LIMNI_EXIT_OK) return status;
    if (given.help) {
        fputs(help, stdout);
        return LIMNI_EXIT_OK;
    }
    if (is_mesh_name(given.output))
        return limni_usage_error("bake", "%s: the output is a .limn file, not a mesh",
                                 given.output);
    for (int i = optind; i < argc; i++) {
        if (limni_is_same_file(argv[i], given.output))
            return limni_usage_error("bake", "%s is input and output", argv[i]);
    }
    given.desc.note = print_note;
    given.desc.user = &given;
    if (!given.quiet && isatty(STDERR_FILENO)) given.desc.progress = print_progress;

    limn_baker *const baker = limn_baker_create(&given.desc);
    if (!baker) return limni_failure("out of memory");
    const char *const refused = limn_baker_error(baker); // options
    const int baked =
        *refused ? limni_usage_error("bake", "%s", refused) : bake(baker, &given, argv + optind);
    limn_baker_destroy(baker);
    return baked;
}
