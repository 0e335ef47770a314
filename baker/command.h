/* SPDX-License-Identifier: MIT */
/* The commands of the program `limn`. Each returns the exit status of the program. */
#ifndef LIMNI_COMMAND_H
#define LIMNI_COMMAND_H

#include "blob_file.h"
#include "context.h"
#include "limn/limn.h"

enum {
    LIMNI_EXIT_OK = 0,
    LIMNI_EXIT_FAILED = 1, ///< the input is bad, or a file cannot be read or written
    LIMNI_EXIT_USAGE = 2   ///< the command line is wrong
};

int limni_command_bake(int argc, char **argv);
int limni_command_convert(int argc, char **argv);
int limni_command_info(int argc, char **argv);
int limni_command_export(int argc, char **argv);
int limni_command_verify(int argc, char **argv);

/// Prints "limn COMMAND: message" to stderr, and how to get help. Returns LIMNI_EXIT_USAGE.
int limni_usage_error(const char *command, const char *format, ...) LIMNI_PRINTF(2, 3);

/// Prints "limn: message" to stderr. Returns LIMNI_EXIT_FAILED.
int limni_failure(const char *format, ...) LIMNI_PRINTF(1, 2);

/// Says what went wrong, if anything did, and releases all that the context holds. Returns the exit
/// status.
int limni_command_end(limni_context *context, limn_bake_status status);

/// An opened .limn file.
typedef struct limni_pack_file {
    limni_blob_file blob;
    limn_pack pack;
} limni_pack_file;

/// Opens a .limn file, or says on stderr why not.
bool limni_pack_file_open(limni_pack_file *file, const char *path);
void limni_pack_file_close(limni_pack_file *file);

/// Reads the argument of --non-manifold.
bool limni_parse_non_manifold(const char *text, limn_non_manifold *policy);

/// Reads the argument of --repair: names of steps separated by commas; NULL means all.
bool limni_parse_repair(const char *text, uint32_t *repair);

#endif
