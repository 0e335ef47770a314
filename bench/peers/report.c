/* SPDX-License-Identifier: MIT */
#include "report.h"

#include "../bench.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

static const char opensubdiv_note[] =
    "OpenSubdiv is the system's library; Debian builds it for SSE2 only";

static const char *output_name(peer_output output) {
    static const char *const names[] = {"position", "position+derivatives", "position+normal"};
    return names[output];
}

static const char *points_name(peer_points points) {
    return points == PEER_PATCH_POINTS ? "patch" : "unique";
}

// -------------------------------------------------------------------------------------------------
// The table

void report_print_head(void) {
    printf("%-18s %-20s %-6s %-12s %3s %12s %10s %7s %9s %9s %9s %8s\n", "peer", "output", "isa",
           "family", "thr", "points/face", "ns/face", "ratio", "B/face", "build ms", "load ms",
           "differ");
}

/// A number, or a dash where there is none.
static void print_number(const char *format, int width, double value) {
    if (isnan(value))
        printf(" %*s", width, "-");
    else
        printf(format, width, value);
}

void report_print(const peer_result *result) {
    const peer *const what = &result->what;
    printf("%-18s %-20s %-6s %-12s %3u %5.1f %-6s %10.1f", what->name, output_name(what->output),
           what->isa, what->family, what->threads, result->points_per_face,
           points_name(what->points), result->ns_per_face);
    print_number(" %*.2f", 7, result->ratio_to_limn);
    printf(" %9.1f %9.2f", result->bytes_per_face, what->build_ms);
    print_number(" %*.3f", 9, what->load_ms);
    printf(" %8.1e\n", result->difference);
}

void report_print_notes(void) {
    printf(
        "\nns/face: per base face, whatever the points: patch = all vertices of each patch, unique "
        "= each vertex of\n"
        "the refined mesh once. ratio: to limn's best kernels with the same output (derivatives "
        "count as normals),\n"
        "threads and start (bones or control points); median of the ratios within each round; "
        "-: limn has no such output.\n"
        "skin...: from %d bones, 4 a vertex. B/face: stored, without the bind pose where it is "
        "an input; of Bfr at least\n"
        "that. load ms: from stored bytes in memory to ready; -: has no stored form and is built "
        "instead, or needs none.\n"
        "differ: largest distance to the first peer's points over the diagonal. %s.\n",
        SCENE_BONE_COUNT, opensubdiv_note);
}

// -------------------------------------------------------------------------------------------------
// Files

static json_t *make_number(double value) {
    return isnan(value) ? json_null() : json_real(value);
}

static json_t *make_result(const peer_result *result) {
    const peer *const what = &result->what;
    return json_pack("{ss ss ss ss ss ss sb si si ss sf sf so sf sf so sf}", "peer", what->name,
                     "output", output_name(what->output), "isa", what->isa, "family", what->family,
                     "mesh", result->mesh, "scheme", result->scheme, "isolated",
                     (int)result->isolated, "level", (int)result->level, "threads",
                     (int)what->threads, "points", points_name(what->points), "points_per_face",
                     result->points_per_face, "ns_per_face", result->ns_per_face, "ratio_to_limn",
                     make_number(result->ratio_to_limn), "bytes_per_face", result->bytes_per_face,
                     "build_ms", what->build_ms, "load_ms", make_number(what->load_ms),
                     "largest_difference", result->difference);
}

static json_t *make_conditions(uint32_t rounds) {
    char cpu[128];
    bench_cpu_name(cpu, sizeof cpu);
    return json_pack("{ss ss ss ss si ss}", "commit", BENCH_COMMIT, "compiler", BENCH_COMPILER,
                     "flags", BENCH_FLAGS, "cpu", cpu, "rounds", (int)rounds, "note",
                     opensubdiv_note);
}

bool report_write_json(FILE *file, const peer_result *results, uint32_t count, uint32_t rounds) {
    json_t *const array = json_array();
    for (uint32_t r = 0; r < count; r++)
        json_array_append_new(array, make_result(&results[r]));
    json_t *const root =
        json_pack("{so so}", "conditions", make_conditions(rounds), "results", array);
    const bool good = root && json_dumpf(root, file, JSON_INDENT(2) | JSON_REAL_PRECISION(6)) == 0;
    json_decref(root);
    return good;
}

static void write_number(FILE *file, double value) {
    if (isnan(value))
        fputc(',', file);
    else
        fprintf(file, ",%.6g", value);
}

static void write_line(FILE *file, const peer_result *result) {
    const peer *const what = &result->what;
    fprintf(file, "%s,%s,%s,%s,%s,%u,%u,%s", what->name, output_name(what->output), what->isa,
            what->family, result->mesh, result->level, what->threads, points_name(what->points));
    const double numbers[] = {result->points_per_face, result->ns_per_face, result->ratio_to_limn,
                              result->bytes_per_face,  what->build_ms,      what->load_ms,
                              result->difference};
    for (size_t n = 0; n < sizeof numbers / sizeof *numbers; n++)
        write_number(file, numbers[n]);
    fprintf(file, ",%s,%d\n", result->scheme, result->isolated);
}

void report_write_csv(FILE *file, const peer_result *results, uint32_t count, uint32_t rounds) {
    char cpu[128];
    bench_cpu_name(cpu, sizeof cpu);
    fprintf(file, "# commit %s, %s, flags %s, CPU %s, %u rounds; %s\n", BENCH_COMMIT,
            BENCH_COMPILER, BENCH_FLAGS, cpu, rounds, opensubdiv_note);
    fprintf(file,
            "peer,output,isa,family,mesh,level,threads,points,points_per_face,ns_per_face,"
            "ratio_to_limn,bytes_per_face,build_ms,load_ms,largest_difference,scheme,isolated\n");
    for (uint32_t r = 0; r < count; r++)
        write_line(file, &results[r]);
}
