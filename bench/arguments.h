/* SPDX-License-Identifier: MIT */
/* The command lines of the benchmarks. */
#ifndef BENCH_ARGUMENTS_H
#define BENCH_ARGUMENTS_H

#include "numbers.h"

#include "limn/bake.h"

#include <getopt.h>

/// What a benchmark does with one of its options, other than --help: takes it, with its argument in
/// `optarg`, or returns false.
typedef bool bench_option_parser(int option, void *options);

/// Reads all options; those that are wrong are named on standard error. `argv[0]` is the name of
/// the benchmark, and `names` has "help" for 'h'. Returns the exit status, or -1 to go on with
/// argv[optind].
int bench_read_options(int argc, char **argv, const char *help, const struct option *names,
                       bench_option_parser *parse, void *options);

/// A whole number from `low` to `high`; nothing is written otherwise.
bool bench_parse_range(const char *text, uint32_t low, uint32_t high, uint32_t *value);

/// Schemes are Loop's of triangles, "loop", or Catmull-Clark's, "catmark". False: neither.
bool bench_parse_scheme(const char *text, limn_scheme *scheme);
const char *bench_scheme_name(limn_scheme scheme);

/// The name of an instruction set that this CPU has; nothing is written otherwise.
bool bench_parse_isa(const char *name, uint32_t *isa);

#endif
