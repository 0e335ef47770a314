/* SPDX-License-Identifier: MIT */
/* The program `limn`: arguments and exit codes only. */
#include "command.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *summary;
} commands[] = {
    {"bake", limni_command_bake, "turn meshes (.obj, .gltf, .fbx and others) into one .limn file"},
    {"convert", limni_command_convert, "write a mesh in another format (.obj, .off, .ply)"},
    {"info", limni_command_info, "say what is in a .limn file"},
    {"export", limni_command_export, "evaluate a .limn file into a dense mesh (.obj, .ply)"},
    {"verify", limni_command_verify, "compare a .limn file with OpenSubdiv"},
};

enum { COMMAND_COUNT = sizeof commands / sizeof *commands };

static void print_help(FILE *stream) {
    fprintf(stream, "Usage: limn COMMAND [OPTIONS]\n"
                    "  or:  limn COMMAND --help\n"
                    "  or:  limn --help | --version\n\n"
                    "Bakes subdivision surfaces for the Limn runtime.\n\n"
                    "Commands:\n");
    for (int c = 0; c < COMMAND_COUNT; c++)
        fprintf(stream, "  %-8s %s\n", commands[c].name, commands[c].summary);
    fprintf(stream, "\nExit status:\n"
                    "  0        success\n"
                    "  1        bad input or a file error\n"
                    "  2        wrong usage\n\n"
                    "Examples:\n"
                    "  $ limn bake hero.obj -o hero.limn\n"
                    "  $ limn info hero.limn\n"
                    "  $ limn export hero.limn --level 3 -o dense.obj\n");
}

static bool is_either(const char *text, const char *a, const char *b) {
    return strcmp(text, a) == 0 || strcmp(text, b) == 0;
}

/// A full disk under standard output is a failure, too.
static int finish(int status) {
    if (fflush(stdout) == 0 && !ferror(stdout)) return status;
    return limni_failure("cannot write to standard output");
}

int main(int argc, char **argv) {
    if (argc < 2) {
        print_help(stderr);
        return LIMNI_EXIT_USAGE;
    }
    if (is_either(argv[1], "--help", "-h")) {
        print_help(stdout);
        return LIMNI_EXIT_OK;
    }
    if (strcmp(argv[1], "--version") == 0) {
        const uint32_t version = limn_version();
        printf("limn %u.%u.%u\n", version >> 16, version >> 8 & 0xff, version & 0xff);
        return LIMNI_EXIT_OK;
    }
    for (int c = 0; c < COMMAND_COUNT; c++) {
        if (strcmp(argv[1], commands[c].name) != 0) continue;
        char name[32]; // for getopt's messages
        snprintf(name, sizeof name, "limn %s", commands[c].name);
        argv[1] = name;
        return finish(commands[c].run(argc - 1, argv + 1));
    }
    fprintf(stderr, "limn: there is no command '%s'; see limn --help\n", argv[1]);
    return LIMNI_EXIT_USAGE;
}
