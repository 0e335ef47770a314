/* SPDX-License-Identifier: MIT */
#include "arguments.h"

#include "limn/limn.h"

#include <stdio.h>
#include <string.h>

int bench_read_options(int argc, char **argv, const char *help, const struct option *names,
                       bench_option_parser *parse, void *options) {
    int which = 0;
    for (int option; (option = getopt_long(argc, argv, "h", names, &which)) != -1;) {
        if (option == 'h') {
            fputs(help, stdout);
            return 0;
        }
        if (option != '?' && parse(option, options)) continue;
        if (option != '?')
            fprintf(stderr, "limn-bench: --%s: '%s' is out of range or unknown\n",
                    names[which].name, optarg ? optarg : "");
        fprintf(stderr, "see limn-bench %s --help\n", argv[0]);
        return 2;
    }
    return -1;
}

bool bench_parse_range(const char *text, uint32_t low, uint32_t high, uint32_t *value) {
    uint32_t number;
    if (!limni_parse_number(text, high, &number) || number < low) return false;
    *value = number;
    return true;
}

bool bench_parse_scheme(const char *text, limn_scheme *scheme) {
    for (int s = LIMN_SCHEME_LOOP; s <= LIMN_SCHEME_CATMARK; s++) {
        *scheme = (limn_scheme)s;
        if (strcmp(text, bench_scheme_name(*scheme)) == 0) return true;
    }
    return false;
}

const char *bench_scheme_name(limn_scheme scheme) {
    return scheme == LIMN_SCHEME_LOOP ? "loop" : "catmark";
}

bool bench_parse_isa(const char *name, uint32_t *isa) {
    for (uint32_t bit = LIMN_ISA_SCALAR; bit <= limn_isa_supported(); bit <<= 1) {
        const limn_kernels *const kernels = limn_kernels_select(bit, LIMN_FAMILY_REPRODUCIBLE);
        if (!(limn_isa_supported() & bit) || strcmp(limn_kernels_name(kernels), name) != 0)
            continue;
        *isa = bit;
        return true;
    }
    return false;
}
