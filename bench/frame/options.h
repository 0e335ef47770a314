/* SPDX-License-Identifier: MIT */
/* The command line of limn-bench frame. */
#ifndef FRAME_OPTIONS_H
#define FRAME_OPTIONS_H

#include "loop.h"

/// The ways that --peers names.
typedef struct frame_peer {
    const char *name;
    frame_ways_add *add;
} frame_peer;

extern const frame_peer frame_peers[];
extern const uint32_t frame_peer_count;

/// What the command line says.
typedef struct frame_options {
    const char *scene, *mesh, *clip, *lod, *isolate, *clock;
    const char *json, *csv, *html;
    uint32_t count; ///< 0: the scene's
    frame_length length;
    float budget; ///< ms
    uint32_t threads, isa;
    limn_family family;
    uint32_t peers; ///< bit p: frame_peers[p]
    bool finds_crowd;
    bool draws;
    const char *png;        ///< a picture instead of times
    uint32_t frame;         ///< of the picture
    uint32_t width, height; ///< of the picture; 0: the scene's
} frame_options;

/// Reads all options. Returns the exit status, or -1 to go on.
int frame_options_read(frame_options *options, int argc, char **argv);

/// The scene, with what the options put in its place. False after a message.
bool frame_options_script(const frame_options *options, frame_script *script);

#endif
