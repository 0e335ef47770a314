/* SPDX-License-Identifier: MIT */
/*
 * A test is an executable: it calls CHECK… as it goes, and ends with `return check_report();`,
 * which is the exit status. A failed check prints its place and the test goes on.
 */
#ifndef CHECK_H
#define CHECK_H

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static unsigned long check_passed, check_failed;

static inline bool check_that(bool condition, const char *file, int line, const char *text) {
    if (condition) {
        check_passed++;
    } else if (++check_failed <= 20) {
        fprintf(stderr, "%s:%d: failed: %s\n", file, line, text);
    }
    return condition;
}

/// Each gives true when it passed, so that a test can stop early or say more.
#define CHECK(condition) check_that((condition), __FILE__, __LINE__, #condition)
#define CHECK_EQUAL(a, b)                                                                          \
    (CHECK((a) == (b)) ||                                                                          \
     (fprintf(stderr, "    %lld and %lld\n", (long long)(a), (long long)(b)), false))
#define CHECK_NEAR(a, b, tolerance)                                                                \
    (CHECK((a) - (b) <= (tolerance) && (b) - (a) <= (tolerance)) ||                                \
     (fprintf(stderr, "    %.9g and %.9g\n", (double)(a), (double)(b)), false))
#define CHECK_TEXT(a, b)                                                                           \
    (CHECK(strcmp((a), (b)) == 0) || (fprintf(stderr, "    \"%s\" and \"%s\"\n", (a), (b)), false))
#define CHECK_CONTAINS(text, part)                                                                 \
    (CHECK(strstr((text), (part)) != NULL) ||                                                      \
     (fprintf(stderr, "    \"%s\" without \"%s\"\n", (text), (part)), false))

static inline int check_report(void) {
    printf("%lu checks passed, %lu failed\n", check_passed, check_failed);
    return check_failed != 0 || check_passed == 0;
}

#endif
