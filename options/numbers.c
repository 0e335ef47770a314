/* SPDX-License-Identifier: MIT */
#include "numbers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// strtoul() and strtof() also take blanks, and signs or words: what a number may start with is
// looked at first.

/// Reads digits and moves `text` behind them.
static bool scan_number(const char **text, uint32_t max, uint32_t *value) {
    if (**text < '0' || **text > '9') return false;
    char *end;
    const unsigned long number = strtoul(*text, &end, 10);
    if (number > max) return false;
    *text = end;
    *value = (uint32_t)number;
    return true;
}

/// Reads a finite number and moves `text` behind it.
static bool scan_real(const char **text, float *value) {
    if (**text == '\0' || !strchr("+-.0123456789", **text)) return false;
    char *end;
    const float number = strtof(*text, &end);
    if (end == *text || !isfinite(number)) return false;
    *text = end;
    *value = number;
    return true;
}

bool limni_parse_number(const char *text, uint32_t max, uint32_t *value) {
    uint32_t number;
    if (!scan_number(&text, max, &number) || *text) return false;
    *value = number;
    return true;
}

bool limni_parse_real(const char *text, float low, float high, float *value) {
    float number;
    if (!scan_real(&text, &number) || *text || number < low || number > high) return false;
    *value = number;
    return true;
}

bool limni_parse_point(const char *text, float point[3]) {
    float read[3];
    for (int axis = 0; axis < 3; axis++) {
        if (!scan_real(&text, &read[axis])) return false;
        if (*text++ != (axis < 2 ? ',' : '\0')) return false;
    }
    memcpy(point, read, sizeof read);
    return true;
}

bool limni_parse_size(const char *text, uint32_t max, uint32_t *width, uint32_t *height) {
    uint32_t read[2];
    if (!scan_number(&text, max, &read[0]) || *text++ != 'x') return false;
    if (!scan_number(&text, max, &read[1]) || *text) return false;
    if (read[0] == 0 || read[1] == 0) return false;
    *width = read[0];
    *height = read[1];
    return true;
}
