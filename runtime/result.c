/* SPDX-License-Identifier: MIT */
#include "limn/limn.h"

uint32_t limn_version(void) {
    return LIMN_VERSION_MAJOR << 16 | LIMN_VERSION_MINOR << 8 | LIMN_VERSION_PATCH;
}

const char *limn_result_text(limn_result result) {
    switch (result) {
#define RESULT_TEXT(name, text)                                                                    \
    case name:                                                                                     \
        return text;
        LIMN_RESULTS(RESULT_TEXT)
#undef RESULT_TEXT
    }
    return "not a limn_result";
}
