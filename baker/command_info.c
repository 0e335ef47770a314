/* SPDX-License-Identifier: MIT */
#include "../runtime/edge_error.h"
#include "command.h"
#include "cost.h"
#include "info_character.h"
#include "limn/bake.h"
#include "limn/format.h"
#include "sizes.h"

#include <getopt.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: limn info FILE.limn [--json]\n\n"
    "Says what is in a .limn file: its meshes, the topology classes with their stencil tables,\n"
    "skeleton, clips and materials.\n\n"
    "Options:\n"
    "  --json       as JSON\n"
    "  -h, --help   this text\n\n"
    "Keys of the JSON:\n"
    "  file           version, size, table_size, columns_size, class_count, piece_count, bake\n"
    "  meshes[]       name, faces, control_points, patches, patch_size, bytes_per_face, points,\n"
    "                 points_size, normals_size, class_count, ns_per_face[],\n"
    "                 points_ns_per_face, edge_errors[], influences, morph_targets[],\n"
    "                 materials[].{material,patches}, channels[].{name,kind,components,\n"
    "                 face_varying,values,points,patch_size,runs}\n"
    "  classes[]      control_points, pairs, table_size, use_count, valences, boundary_corners\n"
    "  joints[]       name, parent\n"
    "  clips[]        name, duration, tracks\n"
    "  materials[]    name, base_colour, image, image_size\n\n"
    "What they count:\n"
    "  sizes          bytes\n"
    "  patch_size     what a mesh stores for its patches: runs, faces, control indices, slots,\n"
    "                 errors. The tables are shared by all meshes and counted in table_size\n"
    "  points         control points, in isolated meshes with those of level 1; points_size is\n"
    "                 what the latter and their stencils take. Classes are then made of pieces,\n"
    "                 which have the tables, and columns_size says how\n"
    "  ns_per_face    what positions take at levels 0 to 4; points_ns_per_face: what the points\n"
    "                 of level 1 take once a frame. Counted, not measured: ratios are what to\n"
    "                 trust (docs/performance.md, Counted time)\n"
    "  edge_errors    how far levels 0 to 3 are off the limit surface around an edge, in lengths\n"
    "                 of the edge: the medians of a mesh\n"
    "  channels       texture coordinates or colours: values are their control points, patches\n"
    "                 those of the mesh, in runs of one class\n"
    "  classes        topologies of a face's surroundings: use_count is in faces, pairs are of\n"
    "                 control points, where a class is its own mirror image\n";

static uint64_t table_size(const limn_file_class *class) {
    return limn_file_table_size(class) * sizeof(float);
}

static int compare_floats(const void *a, const void *b) {
    const float left = *(const float *)a, right = *(const float *)b;
    return (left > right) - (left < right);
}

/// By levels, over the edges of all patches; 0 where there are none, or no memory.
static void find_medians(const limn_mesh *mesh, double medians[LIMN_LEVEL_MAX]) {
    const size_t count = (size_t)mesh->patch_count * mesh->domain->corner_count;
    float *const errors = malloc((count ? count : 1) * sizeof *errors);
    memset(medians, 0, LIMN_LEVEL_MAX * sizeof *medians);
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX && errors && count; level++) {
        for (size_t e = 0; e < count; e++)
            errors[e] = limni_error_at(mesh->errors[e], level);
        qsort(errors, count, sizeof *errors, compare_floats);
        medians[level] = (double)errors[count / 2];
    }
    free(errors);
}

/// With several materials, a class may have several runs.
static uint32_t count_classes(const limn_mesh *mesh) {
    uint32_t count = 0;
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        uint32_t before = 0;
        while (before < r && mesh->runs[before].class_index != mesh->runs[r].class_index)
            before++;
        count += before == r;
    }
    return count;
}

static uint64_t use_in(const limn_mesh *mesh, uint32_t class_index) {
    uint64_t count = 0;
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        if (mesh->runs[r].class_index == class_index) count += mesh->runs[r].patch_count;
    }
    return count;
}

/// In patches of meshes and of channels.
static uint64_t use_count(const limn_pack *pack, uint32_t class_index) {
    uint64_t count = 0;
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(pack, m);
        count += use_in(&mesh, class_index);
        for (uint32_t c = 0; c < mesh.channel_count; c++) {
            const limn_channel channel = limn_mesh_channel(pack, &mesh, c);
            count += use_in(&channel.mesh, class_index);
        }
    }
    return count;
}

static const char *kind_name(limn_channel_kind kind) {
    return kind == LIMN_CHANNEL_UV ? "uv" : "colour";
}

static const char *face_varying_name(uint32_t face_varying) {
    static const char *const names[] = {[LIMN_FACE_VARYING_DEFAULT] = "default",
                                        [LIMN_FACE_VARYING_NONE] = "none",
                                        [LIMN_FACE_VARYING_CORNERS_ONLY] = "corners-only",
                                        [LIMN_FACE_VARYING_CORNERS_PLUS1] = "corners-plus1",
                                        [LIMN_FACE_VARYING_CORNERS_PLUS2] = "corners-plus2",
                                        [LIMN_FACE_VARYING_BOUNDARIES] = "boundaries",
                                        [LIMN_FACE_VARYING_ALL] = "all"};
    return face_varying <= LIMN_FACE_VARYING_ALL ? names[face_varying] : "unknown";
}

json_t *limni_json_text(const char *text) {
    json_t *const string = json_string(text);
    if (string) return string;
    char ascii[256];
    size_t length = 0;
    for (; length < sizeof ascii && text[length]; length++)
        ascii[length] = (unsigned char)text[length] < 0x80 ? text[length] : '?';
    return json_stringn(ascii, length);
}

static json_t *json_size(uint64_t value) {
    return json_integer((json_int_t)value);
}

static json_t *describe_file(const limn_pack *pack) {
    json_t *const file = json_object();
    json_object_set_new(file, "version", json_integer(LIMN_FORMAT_VERSION));
    json_object_set_new(file, "size", json_size(pack->blob_size));
    json_object_set_new(file, "table_size", json_size(limni_tables_size(pack)));
    json_object_set_new(file, "columns_size", json_size(limni_columns_size(pack)));
    json_object_set_new(file, "class_count", json_integer(pack->class_count));
    json_object_set_new(file, "piece_count", json_integer(pack->piece_count));
    json_object_set_new(file, "bake", limni_json_text(pack->info));
    return file;
}

static json_t *describe_channel(const limn_channel *channel) {
    json_t *const object = json_object();
    const limn_mesh *const mesh = &channel->mesh;
    json_object_set_new(object, "name", limni_json_text(mesh->name));
    json_object_set_new(object, "kind", json_string(kind_name(channel->kind)));
    json_object_set_new(object, "components", json_integer(channel->component_count));
    json_object_set_new(object, "face_varying",
                        json_string(face_varying_name(channel->face_varying)));
    json_object_set_new(object, "values", json_integer(mesh->control_count));
    json_object_set_new(object, "points", json_integer(mesh->point_count));
    json_object_set_new(object, "patch_size", json_size(limni_lists_size(mesh)));
    json_object_set_new(object, "runs", json_integer(mesh->run_count));
    return object;
}

static json_t *describe_channels(const limn_pack *pack, const limn_mesh *mesh) {
    json_t *const channels = json_array();
    for (uint32_t c = 0; c < mesh->channel_count; c++) {
        const limn_channel channel = limn_mesh_channel(pack, mesh, c);
        json_array_append_new(channels, describe_channel(&channel));
    }
    return channels;
}

static void describe_cost(const limn_pack *pack, const limn_mesh *mesh, json_t *object) {
    limni_cost cost;
    json_t *const levels = json_array();
    limni_cost_count(pack, mesh, &cost);
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
        json_array_append_new(
            levels, json_real(limni_cost_per_patch(cost.levels[level], mesh->patch_count)));
    json_object_set_new(object, "ns_per_face", levels);
    json_object_set_new(object, "points_ns_per_face",
                        json_real(limni_cost_per_patch(cost.points, mesh->patch_count)));
}

static json_t *describe_mesh(const limn_pack *pack, const limn_mesh *mesh) {
    json_t *const object = json_object();
    const uint64_t size = limni_patches_size(mesh);
    json_object_set_new(object, "name", limni_json_text(mesh->name));
    json_object_set_new(object, "faces", json_integer(mesh->face_count));
    json_object_set_new(object, "control_points", json_integer(mesh->control_count));
    json_object_set_new(object, "patches", json_integer(mesh->patch_count));
    json_object_set_new(object, "patch_size", json_size(size));
    json_object_set_new(object, "bytes_per_face",
                        json_real(mesh->patch_count ? (double)size / mesh->patch_count : 0));
    json_object_set_new(object, "points", json_integer(mesh->point_count));
    json_object_set_new(object, "points_size", json_size(limni_points_size(mesh)));
    json_object_set_new(object, "normals_size", json_size(limni_normals_size(mesh)));
    json_object_set_new(object, "class_count", json_integer(count_classes(mesh)));
    describe_cost(pack, mesh, object);
    double medians[LIMN_LEVEL_MAX];
    json_t *const errors = json_array();
    find_medians(mesh, medians);
    for (uint32_t level = 0; level < LIMN_LEVEL_MAX; level++)
        json_array_append_new(errors, json_real(medians[level]));
    json_object_set_new(object, "edge_errors", errors);
    json_object_set_new(object, "channels", describe_channels(pack, mesh));
    return object;
}

static json_t *describe_class(const limn_pack *pack, uint32_t class_index) {
    const limn_file_class *const class = &pack->classes[class_index];
    const limn_domain *const domain = limn_domain_get((limn_domain_kind) class->domain);
    json_t *const object = json_object(), *const valences = json_array(), *corners = json_array();
    for (uint32_t corner = 0; corner < domain->corner_count; corner++) {
        json_array_append_new(valences, json_integer(class->valences[corner]));
        if (class->boundary_corners >> corner & 1)
            json_array_append_new(corners, json_integer(corner));
    }
    json_object_set_new(object, "control_points", json_integer(class->control_count));
    json_object_set_new(object, "pairs", json_integer(class->pair_count));
    json_object_set_new(object, "table_size", json_size(table_size(class)));
    json_object_set_new(object, "use_count", json_size(use_count(pack, class_index)));
    json_object_set_new(object, "valences", valences);
    json_object_set_new(object, "boundary_corners", corners);
    return object;
}

static void print_json(const limn_pack *pack) {
    json_t *const root = json_object(), *const meshes = json_array(), *const classes = json_array();
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(pack, m);
        json_t *const object = describe_mesh(pack, &mesh);
        limni_json_rig(object, pack, m);
        json_array_append_new(meshes, object);
    }
    for (uint32_t c = 0; c < pack->class_count; c++)
        json_array_append_new(classes, describe_class(pack, c));
    json_object_set_new(root, "file", describe_file(pack));
    json_object_set_new(root, "meshes", meshes);
    json_object_set_new(root, "classes", classes);
    limni_json_character(root, pack);
    json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(6));
    json_decref(root);
    printf("\n");
}

static void print_class(const limn_pack *pack, uint32_t class_index) {
    const limn_file_class *const class = &pack->classes[class_index];
    char valences[64] = "";
    for (uint32_t corner = 0; corner < 4 && class->valences[corner]; corner++) {
        const size_t length = strlen(valences);
        snprintf(valences + length, sizeof valences - length, "%s%u%s", corner ? " " : "",
                 class->valences[corner], class->boundary_corners >> corner & 1 ? "b" : "");
    }
    printf("%6u  %-14s %14u %10llu %10llu\n", class_index, valences, class->control_count,
           (unsigned long long)table_size(class), (unsigned long long)use_count(pack, class_index));
}

static void print_costs(const limn_pack *pack) {
    printf("\n%-24s %10s %10s %10s %10s %10s %10s\n", "mesh, ns per face", "level 0", "level 1",
           "level 2", "level 3", "level 4", "points");
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(pack, m);
        limni_cost cost;
        limni_cost_count(pack, &mesh, &cost);
        printf("%-24s", mesh.name);
        for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++)
            printf(" %10.1f", limni_cost_per_patch(cost.levels[level], mesh.patch_count));
        printf(" %10.1f\n", limni_cost_per_patch(cost.points, mesh.patch_count));
    }
    printf("(of positions; counted, not measured)\n");
}

static void print_errors(const limn_pack *pack) {
    printf("\n%-24s %10s %10s %10s %10s\n", "mesh, median error", "level 0", "level 1", "level 2",
           "level 3");
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(pack, m);
        double medians[LIMN_LEVEL_MAX];
        find_medians(&mesh, medians);
        printf("%-24s %10.2g %10.2g %10.2g %10.2g\n", mesh.name, medians[0], medians[1], medians[2],
               medians[3]);
    }
    printf("(in lengths of an edge)\n");
}

static void print_channels(const limn_pack *pack) {
    bool any = false;
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(pack, m);
        for (uint32_t c = 0; c < mesh.channel_count; c++) {
            const limn_channel channel = limn_mesh_channel(pack, &mesh, c);
            if (!any)
                printf("\n%-24s %-12s %-7s %-14s %10s %12s %12s %8s\n", "mesh", "channel", "kind",
                       "face-varying", "values", "patch bytes", "point bytes", "runs");
            any = true;
            printf("%-24s %-12s %-7s %-14s %10u %12llu %12llu %8u\n", mesh.name, channel.mesh.name,
                   kind_name(channel.kind), face_varying_name(channel.face_varying),
                   channel.mesh.control_count, (unsigned long long)limni_lists_size(&channel.mesh),
                   (unsigned long long)limni_points_size(&channel.mesh), channel.mesh.run_count);
        }
    }
}

static void print_text(const char *path, const limn_pack *pack) {
    printf("%s: version %u, %zu bytes, of which %llu in the tables of %u classes\n", path,
           LIMN_FORMAT_VERSION, pack->blob_size, (unsigned long long)limni_tables_size(pack),
           pack->class_count);
    if (pack->piece_count)
        printf("which are made of %u pieces, with %llu bytes for their columns\n",
               pack->piece_count, (unsigned long long)limni_columns_size(pack));
    printf("baked with %s\n\n", pack->info);
    printf("%-24s %10s %10s %12s %10s %12s %8s\n", "mesh", "faces", "controls", "patch bytes",
           "bytes/face", "point bytes", "classes");
    for (uint32_t m = 0; m < pack->mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(pack, m);
        const uint64_t size = limni_patches_size(&mesh);
        printf("%-24s %10u %10u %12llu %10.1f %12llu %8u\n", mesh.name, mesh.face_count,
               mesh.control_count, (unsigned long long)size,
               mesh.patch_count ? (double)size / mesh.patch_count : 0,
               (unsigned long long)limni_points_size(&mesh), count_classes(&mesh));
    }
    print_channels(pack);
    print_costs(pack);
    print_errors(pack);
    limni_print_character(pack);
    printf("\n%6s  %-14s %14s %10s %10s\n", "class", "valences", "control points", "bytes",
           "faces");
    for (uint32_t c = 0; c < pack->class_count; c++)
        print_class(pack, c);
    printf("(b: on a boundary)\n");
}

int limni_command_info(int argc, char **argv) {
    static const struct option options[] = {
        {"json", no_argument, NULL, 'j'}, {"help", no_argument, NULL, 'h'}, {0}};
    bool json = false;
    for (int option; (option = getopt_long(argc, argv, "h", options, NULL)) != -1;) {
        if (option == 'h') {
            fputs(help, stdout);
            return LIMNI_EXIT_OK;
        }
        if (option != 'j') return limni_usage_error("info", "wrong option");
        json = true;
    }
    if (optind + 1 != argc) return limni_usage_error("info", "give one .limn file");

    limni_pack_file file;
    if (!limni_pack_file_open(&file, argv[optind])) return LIMNI_EXIT_FAILED;
    if (json) {
        print_json(&file.pack);
    } else {
        print_text(argv[optind], &file.pack);
    }
    limni_pack_file_close(&file);
    return LIMNI_EXIT_OK;
}
