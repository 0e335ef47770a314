/* SPDX-License-Identifier: MIT */
/*
 * Included where equal bits depend on arithmetic as it is written: refuses to be compiled with
 * flags that reorder sums (-Ofast, -ffast-math), or round to more than a float (x87).
 * What no macro shows is left to the build: -ffp-contract=off.
 */
#ifndef LIMNI_ROUNDING_H
#define LIMNI_ROUNDING_H

#include <float.h>

#if defined(__FAST_MATH__)
#error "fast-math reorders the sums that shared vertices depend on"
#endif
#if FLT_EVAL_METHOD != 0
#error "floats must be rounded to float (-msse2 -mfpmath=sse)"
#endif

#endif
