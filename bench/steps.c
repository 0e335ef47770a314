/* SPDX-License-Identifier: MIT */
#include "steps.h"

#include "arguments.h"
#include "bench.h"

static bool parse_option(int option, void *parsed) {
    bench_steps_options *const to = parsed;
    switch (option) {
    case 'i':
        return bench_parse_isa(optarg, &to->isa);
    case 'r':
        return bench_parse_range(optarg, 1, BENCH_ROUND_MAX, &to->rounds);
    case 'q':
        to->rounds = 3;
        to->sample_seconds = 3e-4;
        return true;
    case 'c':
        to->csv = optarg;
        return true;
    default:
        return false;
    }
}

static bool measure_all(const bench_steps *steps, const bench_steps_options *o, char **paths,
                        int path_count) {
    limni_output_file csv;
    if (!bench_results_open(&csv, o->csv)) return false;
    if (csv.stream) {
        fprintf(csv.stream, "# ");
        bench_print_conditions(csv.stream);
        fprintf(csv.stream, "%s\n", steps->columns);
    }
    bench_print_conditions(stdout);
    bool good = path_count > 0 || steps->measure(NULL, o, csv.stream);
    for (int p = 0; p < path_count; p++)
        good &= steps->measure(paths[p], o, csv.stream);
    return bench_results_close(&csv, o->csv, good);
}

int bench_steps_run(int argc, char **argv, const bench_steps *steps) {
    static const struct option names[] = {
        {"isa", required_argument, NULL, 'i'}, {"rounds", required_argument, NULL, 'r'},
        {"quick", no_argument, NULL, 'q'},     {"csv", required_argument, NULL, 'c'},
        {"help", no_argument, NULL, 'h'},      {0}};
    bench_steps_options o = {.isa = LIMN_ISA_ALL, .rounds = 15, .sample_seconds = 2e-3};
    const int status = bench_read_options(argc, argv, steps->help, names, parse_option, &o);
    if (status >= 0) return status;
    return measure_all(steps, &o, argv + optind, argc - optind) ? 0 : 1;
}
