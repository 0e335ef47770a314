/* SPDX-License-Identifier: MIT */
/* Numbers of a command line. All of the text must be the number; nothing is written otherwise. */
#ifndef LIMNI_NUMBERS_H
#define LIMNI_NUMBERS_H

#include <stdbool.h>
#include <stdint.h>

/// Digits only, of a number of at most `max`.
bool limni_parse_number(const char *text, uint32_t max, uint32_t *value);

/// A finite number from `low` to `high`.
bool limni_parse_real(const char *text, float low, float high, float *value);

/// "X,Y,Z", finite.
bool limni_parse_point(const char *text, float point[3]);

/// "WIDTHxHEIGHT", from 1 to `max` each.
bool limni_parse_size(const char *text, uint32_t max, uint32_t *width, uint32_t *height);

#endif
