/* SPDX-License-Identifier: MIT */
/* The benchmarks. Each returns the exit status of the program. */
#ifndef BENCH_H
#define BENCH_H

int bench_bake(int argc, char **argv);

/// Seconds of a clock that only goes forward.
double bench_seconds(void);

/// The median; reorders the values.
double bench_median(double *values, int count);

/// One line on what ran where: version, compiler, flags, CPU.
void bench_print_conditions(void);

#endif
