/* SPDX-License-Identifier: MIT */
/*
 * A caller's mistake: aborts in debug builds, and returns harmlessly in release builds. Define
 * LIMN_ASSERT(condition) when compiling the library to do something else; it must return normally.
 */
#ifndef LIMNI_REQUIRE_H
#define LIMNI_REQUIRE_H

#ifndef LIMN_ASSERT
#include <assert.h>
#define LIMN_ASSERT(condition) assert(condition)
#endif

/// Asserts, and then leaves the function with `value` if the mistake was made all the same.
#define LIMNI_REQUIRE(condition, value)                                                            \
    do {                                                                                           \
        LIMN_ASSERT(condition);                                                                    \
        if (!(condition)) return value;                                                            \
    } while (0)

#endif
