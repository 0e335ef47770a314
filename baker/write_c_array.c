/* SPDX-License-Identifier: MIT */
#include "write_c_array.h"

#include "limn/format.h"

#include <ctype.h>
#include <string.h>

static bool is_keyword(const char *name) {
    static const char *const keywords[] = {
        "auto",     "break",  "case",     "char",   "const",    "continue", "default",
        "do",       "double", "else",     "enum",   "extern",   "float",    "for",
        "goto",     "if",     "inline",   "int",    "long",     "return",   "register",
        "restrict", "short",  "signed",   "sizeof", "static",   "struct",   "switch",
        "typedef",  "union",  "unsigned", "void",   "volatile", "while"};
    for (size_t k = 0; k < sizeof keywords / sizeof keywords[0]; k++) {
        if (strcmp(name, keywords[k]) == 0) return true;
    }
    return false;
}

bool limni_is_c_name(const char *name) {
    if (!isalpha((unsigned char)name[0]) && name[0] != '_') return false;
    for (const char *c = name; *c; c++) {
        if (!isalnum((unsigned char)*c) && *c != '_') return false;
    }
    return !is_keyword(name);
}

void limni_write_c_array(FILE *stream, const char *name, const unsigned char *bytes, size_t size) {
    enum { bytes_per_line = 24 };
    fprintf(stream,
            "/* Written by limn bake. In other files:\n"
            " *     extern const unsigned char %s[];\n"
            " *     extern const size_t %s_size; */\n"
            "#include <stddef.h>\n\n"
            "const size_t %s_size = %zu;\n"
            "_Alignas(%u) const unsigned char %s[%zu] = {",
            name, name, name, size, LIMN_FORMAT_ALIGNMENT, name, size);
    for (size_t i = 0; i < size; i++)
        fprintf(stream, "%s%u,", i % bytes_per_line == 0 ? "\n" : "", bytes[i]);
    fputs("\n};\n", stream);
}
