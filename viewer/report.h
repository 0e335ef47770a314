/* SPDX-License-Identifier: MIT */
/* Messages to the user. */
#ifndef VIEW_REPORT_H
#define VIEW_REPORT_H

#include <stdbool.h>

#if defined(__GNUC__)
#define VIEW_PRINTF_LIKE __attribute__((format(printf, 1, 2)))
#else
#define VIEW_PRINTF_LIKE
#endif

/// The name of the program, which it defines.
extern const char view_program_name[];

/// Prints one line to stderr, after the program's name. Returns false, so that a function that
/// fails can end with `return view_fail(…)`.
bool view_fail(const char *format, ...) VIEW_PRINTF_LIKE;

#endif
